//! Functions of one link for energies by scale, in the form in which the attribute emits them.

use crate::scalar::Scalar;
use crate::tree::{LinkEquations, LinkMotion};

/// Functions of one link of a rule-based tree, from which energies by scale are computed. A value
/// `V` holds a number of one link, or numbers of several links or states, one in each lane. Every
/// function is `#[inline(always)]`. The docs of the emitted code list the entries of `given`.
///
/// See `docs/physics.md`, section 18.
pub trait ScaleEquations: LinkEquations {
    /// True if any joint has a spring.
    const SPRINGS: bool;
    /// True if any joint has friction.
    const FRICTION: bool;
    /// True if any link has drag against the ground.
    const DRAG: bool;
    /// True if the root's pivot is driven.
    const DRIVEN: bool;

    /// Returns the strain of the spring, and the torques of spring, friction and drag. Only this
    /// function uses the joint angle and rate of the motion.
    fn scale_torques<V: Scalar>(constants: &Self::Constants<V>, link: LinkMotion<V>) -> [V; 4];

    /// Returns the velocities of the link's centre of mass and of its children's pivot, given the
    /// velocity of the link's own pivot.
    fn scale_velocity<V: Scalar>(
        constants: &Self::Constants<V>,
        link: LinkMotion<V>,
        given: [V; 2],
    ) -> [V; 4];

    /// Returns the moment of the momenta that the link carries, and the momentum passed to the
    /// parent, given the velocity of the centre of mass and the momentum of the subtrees below.
    fn scale_moment<V: Scalar>(
        constants: &Self::Constants<V>,
        link: LinkMotion<V>,
        given: [V; 4],
    ) -> [V; 4];

    /// Returns the link's energy in one scale, given the parts in that scale of velocity, angular
    /// velocity, 1 − cos θ, sin θ and strain; the last number of `given` is 1 for the means and 0
    /// for other scales.
    fn scale_energy<V: Scalar>(
        constants: &Self::Constants<V>,
        link: LinkMotion<V>,
        given: [V; 7],
    ) -> [V; 1];

    /// Returns the deficit of the subtree's articulated inertia, the gain and the inverse joint
    /// inertia, given the deficit of the subtrees below.
    fn scale_factor<V: Scalar>(
        constants: &Self::Constants<V>,
        link: LinkMotion<V>,
        given: [V; 3],
    ) -> [V; 6];

    /// Returns the bias force of the subtree and the link's offset, given its gain and inverse
    /// joint inertia, the parts of moment and angular velocity, and the bias force of the subtrees
    /// below.
    fn scale_eliminate<V: Scalar>(
        constants: &Self::Constants<V>,
        link: LinkMotion<V>,
        given: [V; 8],
    ) -> [V; 3];

    /// Returns the angular velocity along the flow, the part passed to the children, and the
    /// changes of velocities of the centre of mass and of the children's pivot; given gain and
    /// offset, and the numbers passed by the parent.
    fn scale_flow<V: Scalar>(
        constants: &Self::Constants<V>,
        link: LinkMotion<V>,
        given: [V; 7],
    ) -> [V; 7];

    /// Returns the derivative of a scale's energy by the angle, including the change of momenta
    /// along the flow, given the parts of moment, 1 − cos θ, sin θ and spring torques, the number
    /// that is 1 for the means, and the moment of the changes of velocities.
    fn scale_slope<V: Scalar>(
        constants: &Self::Constants<V>,
        link: LinkMotion<V>,
        given: [V; 8],
    ) -> [V; 1];

    /// Returns the torque of inertial forces on the link caused by an acceleration of the root's
    /// pivot.
    fn scale_inertial<V: Scalar>(
        constants: &Self::Constants<V>,
        link: LinkMotion<V>,
        given: [V; 2],
    ) -> [V; 1];
}
