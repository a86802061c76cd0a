//! Functions of one link for energies, powers and positions, as the attribute emits them.

use crate::scalar::Scalar;
use crate::tree::{LinkMotion, Row};

/// Functions of one link from which energies and powers of a tree are summed. A value `V` holds a
/// number of one link, or numbers of several links or states, one in each lane. SI units. Every
/// function is `#[inline(always)]`, and no product is fused with a sum, so that results have the
/// same bits in all registers.
///
/// The attribute emits the parts for friction, a spring and a drive only if the tree has them. The
/// power of a missing part is zero.
pub trait BodyEquations: Copy + Send + Sync + 'static {
    /// Constants of one link as a rigid body.
    type Body<V: Scalar>: Row<V>;

    /// Returns the velocity of a child's pivot, from the motion of the parent and the velocity of
    /// the parent's pivot. Joint angle and rate of the parent are not used.
    fn pivot_velocity<V: Scalar>(
        body: &Self::Body<V>,
        link: LinkMotion<V>,
        given: [V; 2],
    ) -> [V; 2];

    /// Returns the kinetic energy of the link, in J, given the velocity of its pivot. Joint angle
    /// and rate are not used.
    fn kinetic_energy<V: Scalar>(
        body: &Self::Body<V>,
        link: LinkMotion<V>,
        given: [V; 2],
    ) -> [V; 1];

    /// Returns the link's part of the potential energy, in J: the energy of the weight that it
    /// carries, and of the spring in its pivot. Velocities are not used.
    fn potential_energy<V: Scalar>(body: &Self::Body<V>, link: LinkMotion<V>) -> [V; 1];

    /// Returns the power that the link's friction and drag dissipate, in W. Angles are not used.
    #[inline(always)]
    fn friction_loss<V: Scalar>(_body: &Self::Body<V>, _link: LinkMotion<V>) -> [V; 1] {
        [V::from_f64(0.0)]
    }

    /// Returns the link's part of the power of the drive, in W, given the acceleration of the
    /// root's pivot and the torque of the drive on the link (`given`). Joint angle and rate are not
    /// used.
    #[inline(always)]
    fn drive_power<V: Scalar>(
        _body: &Self::Body<V>,
        _link: LinkMotion<V>,
        _given: [V; 3],
    ) -> [V; 1] {
        [V::from_f64(0.0)]
    }

    /// Returns the power of the external torque on the link, in W; NaN if the equations have no
    /// external torques. Angles are not used.
    #[inline(always)]
    fn outside_power<V: Scalar>(_body: &Self::Body<V>, _link: LinkMotion<V>) -> [V; 1] {
        [V::from_f64(f64::NAN)]
    }
}

/// Functions of a point of a link, at a given distance along the link and across it. x points to
/// the side to which positive angles move the link's end, y upwards, against the direction of links
/// at angle 0. Joint angle and rate are not used.
pub trait PointEquations: Copy + Send + Sync + 'static {
    /// Returns the position of the point relative to the link's pivot, in m.
    fn point<V: Scalar>(link: LinkMotion<V>, given: [V; 2]) -> [V; 2];

    /// Returns the velocity of the point relative to the link's pivot, in m/s.
    fn point_velocity<V: Scalar>(link: LinkMotion<V>, given: [V; 2]) -> [V; 2];

    /// Returns the torque about the link's pivot, in N m, of a force at the point; the force is the
    /// last two numbers of `given`.
    fn point_torque<V: Scalar>(link: LinkMotion<V>, given: [V; 4]) -> [V; 1];
}
