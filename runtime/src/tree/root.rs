//! Drive of a tree that is computed in loops; it acts on the root only.

use crate::scalar::Scalar;

/// Drive of a tree at one time, in the frame of reference of the root's pivot and in the reduced
/// units of the equations.
///
/// In this frame the pivot's acceleration **a** acts on every link as gravity does: the apparent
/// gravity is −(0, g) − **a** instead of −(0, g). The torque τ on the root is part of its bias
/// torque (`docs/physics.md`, sections 7 and 10).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RootDrive<T> {
    /// Contribution of the pivot's acceleration to the apparent gravity: −**a** / l, where l is the
    /// tree's unit of length.
    pub pivot: [T; 2],
    /// Torque τ on the root against the ground, in reduced units: τ / (m l²), with the tree's units
    /// m of mass and l of length. Used if the equations have a column for it
    /// ([`LinkEquations::TORQUE`](super::LinkEquations::TORQUE)).
    pub torque: T,
}

impl<T: Scalar> RootDrive<T> {
    /// Returns the drive with numbers of another scalar type.
    #[inline(always)]
    pub fn map<S>(self, convert: impl Fn(T) -> S) -> RootDrive<S> {
        let [x, y] = self.pivot;
        RootDrive {
            pivot: [convert(x), convert(y)],
            torque: convert(self.torque),
        }
    }

    /// Returns the apparent gravity at the root's pivot: gravity [x, y] plus the contribution of
    /// the drive, if there is one.
    #[inline(always)]
    pub(super) fn apparent_gravity([x, y]: [T; 2], drive: Option<Self>) -> [T; 2] {
        match drive {
            None => [x, y],
            Some(Self {
                pivot: [pivot_x, pivot_y],
                ..
            }) => [x + pivot_x, y + pivot_y],
        }
    }
}
