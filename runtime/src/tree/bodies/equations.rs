//! The functions of one link behind energies, powers and positions, as the attribute writes them.

use crate::scalar::Scalar;
use crate::tree::{LinkMotion, Row};

/// Functions of one link of a tree that energies and powers are formed of, for as many links
/// (or states) side by side as a value has lanes. SI units; every function is
/// `#[inline(always)]`, and none says where a product and a sum may be one operation: results
/// have the same bits in all registers.
///
/// A law of friction, a spring and a drive are written by the attribute where the tree has
/// them. What it lacks has no power.
pub trait BodyEquations: Copy + Send + Sync + 'static {
    /// Constants of a link as a body.
    type Body<V: Scalar>: Row<V>;

    /// Returns the velocity of a child's pivot, of the motion of the parent and the velocity of
    /// the parent's pivot. (Joint angle and rate of the parent are left open.)
    fn pivot_velocity<V: Scalar>(
        body: &Self::Body<V>,
        link: LinkMotion<V>,
        given: [V; 2],
    ) -> [V; 2];

    /// Returns the kinetic energy, of the velocity of the link's pivot. (Joint angle and rate
    /// are left open.)
    fn kinetic_energy<V: Scalar>(
        body: &Self::Body<V>,
        link: LinkMotion<V>,
        given: [V; 2],
    ) -> [V; 1];

    /// Returns the link's part of the potential energy: of the weight that it carries and of the
    /// spring in its pivot. (Velocities are left open.)
    fn potential_energy<V: Scalar>(body: &Self::Body<V>, link: LinkMotion<V>) -> [V; 1];

    /// Returns the power that friction and drag take. (Angles are left open.)
    #[inline(always)]
    fn friction_loss<V: Scalar>(_body: &Self::Body<V>, _link: LinkMotion<V>) -> [V; 1] {
        [V::from_f64(0.0)]
    }

    /// Returns the link's part of the power of the drive, of the acceleration of the root's
    /// pivot and the torque of the drive on the link. (Joint angle and rate are left open.)
    #[inline(always)]
    fn drive_power<V: Scalar>(
        _body: &Self::Body<V>,
        _link: LinkMotion<V>,
        _given: [V; 3],
    ) -> [V; 1] {
        [V::from_f64(0.0)]
    }

    /// Returns the power of the torque from outside, NaN of equations that read none. (Angles
    /// are left open.)
    #[inline(always)]
    fn outside_power<V: Scalar>(_body: &Self::Body<V>, _link: LinkMotion<V>) -> [V; 1] {
        [V::from_f64(f64::NAN)]
    }
}

/// Functions of a point of a link, given how far along the link and across it that is; x is
/// to the side in which positive angles move a link's end, y against the direction of links of
/// angle 0. (Joint angle and rate are left open.)
pub trait PointEquations: Copy + Send + Sync + 'static {
    /// Returns where the point is, from the link's pivot.
    fn point<V: Scalar>(link: LinkMotion<V>, given: [V; 2]) -> [V; 2];

    /// Returns the velocity of the point against the link's pivot.
    fn point_velocity<V: Scalar>(link: LinkMotion<V>, given: [V; 2]) -> [V; 2];

    /// Returns the torque about the link's pivot of a force there, the last two numbers.
    fn point_torque<V: Scalar>(link: LinkMotion<V>, given: [V; 4]) -> [V; 1];
}
