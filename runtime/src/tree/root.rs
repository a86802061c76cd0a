//! What moves a tree in loops from outside: it enters at the root alone.

use crate::scalar::Scalar;

/// The drive of a tree at one time, in the frame of reference that moves with
/// the root's pivot.
///
/// There the pivot's acceleration **a** acts on every link as gravity does, so
/// that the root takes **a** + (0, g) from above instead of (0, g), and the
/// torque τ is a block of the root's κ (`docs/physics.md`, sections 7 and 10).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RootDrive<T> {
    /// What the acceleration of the pivot adds to what the root takes from above:
    /// −**a** / ℓ with the root's unit of length ℓ, the distance of its children.
    pub pivot: [T; 2],
    /// Torque τ on the root against the ground, N m. Read where the equations
    /// have a column for it ([`Recursion::TORQUE`](super::Recursion::TORQUE)).
    pub torque: T,
}

impl<T: Scalar> RootDrive<T> {
    /// The same on other scalars.
    #[inline(always)]
    pub(super) fn map<S>(self, convert: impl Fn(T) -> S) -> RootDrive<S> {
        let [x, y] = self.pivot;
        RootDrive {
            pivot: [convert(x), convert(y)],
            torque: convert(self.torque),
        }
    }

    /// What the root takes from above.
    #[inline(always)]
    pub(super) fn above([x, y]: [T; 2], drive: Option<Self>) -> [T; 2] {
        match drive {
            None => [x, y],
            Some(Self {
                pivot: [pivot_x, pivot_y],
                ..
            }) => [x + pivot_x, y + pivot_y],
        }
    }
}
