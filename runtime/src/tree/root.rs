//! Motion of a tree in loops from outside, which enters at the root alone.

use crate::scalar::Scalar;

/// The drive of a tree at one time, in the frame of reference that moves with
/// the root's pivot, in the reduced units of the equations.
///
/// There the pivot's acceleration **a** acts on every link as gravity does: the
/// root's pivot has the apparent gravity −(0, g) − **a** instead of −(0, g). The torque
/// τ on the root is part of its bias torque (`docs/physics.md`, sections 7 and 10).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RootDrive<T> {
    /// Contribution of the pivot's acceleration to the apparent gravity: −**a** / l
    /// with the tree's unit of length l.
    pub pivot: [T; 2],
    /// Torque on the root against the ground, τ / (m l²) with the tree's unit of mass
    /// m. Read where the equations have a column for it
    /// ([`LinkEquations::TORQUE`](super::LinkEquations::TORQUE)).
    pub torque: T,
}

impl<T: Scalar> RootDrive<T> {
    /// Returns the drive on other scalars.
    #[inline(always)]
    pub fn map<S>(self, convert: impl Fn(T) -> S) -> RootDrive<S> {
        let [x, y] = self.pivot;
        RootDrive {
            pivot: [convert(x), convert(y)],
            torque: convert(self.torque),
        }
    }

    /// Returns the apparent gravity at the root's pivot.
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
