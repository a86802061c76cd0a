//! The functions of one link behind energies by scale, as the attribute writes them.

use crate::scalar::Scalar;
use crate::tree::{LinkEquations, LinkMotion};

/// Functions of one link of a tree by rule that energies by scale are formed of, for as
/// many links (or states) side by side as a value has lanes. Every function is
/// `#[inline(always)]`; what `given` holds stands in the docs of emitted code.
///
/// `docs/physics.md`, section 18.
pub trait ScaleEquations: LinkEquations {
    /// A joint has a spring.
    const SPRINGS: bool;
    /// A joint has friction.
    const FRICTION: bool;
    /// A link has drag against the ground.
    const DRAG: bool;
    /// The root's pivot is moved.
    const MOVED: bool;

    /// Returns the strain of the spring, and the torques of spring, friction and drag.
    /// Only here joint angle and rate of the motion are read.
    fn scale_torques<V: Scalar>(constants: &Self::Constants<V>, link: LinkMotion<V>) -> [V; 4];

    /// Returns velocities of the centre of mass and of the children's pivot, of that of
    /// the link's own.
    fn scale_velocity<V: Scalar>(
        constants: &Self::Constants<V>,
        link: LinkMotion<V>,
        given: [V; 2],
    ) -> [V; 4];

    /// Returns the moment of momenta and the momentum that is handed to the parent, of
    /// the velocity of the centre of mass and the momentum of what hangs there.
    fn scale_moment<V: Scalar>(
        constants: &Self::Constants<V>,
        link: LinkMotion<V>,
        given: [V; 4],
    ) -> [V; 4];

    /// Returns the energy of the parts of velocity, angular velocity, 1 − cos θ, sin θ
    /// and strain in a scale; the last number is 1 for the means, 0 for others.
    fn scale_energy<V: Scalar>(
        constants: &Self::Constants<V>,
        link: LinkMotion<V>,
        given: [V; 7],
    ) -> [V; 1];

    /// Returns the deficit of the subtree's articulated inertia, gain and inverse joint
    /// inertia, of the deficit of what hangs there.
    fn scale_factor<V: Scalar>(
        constants: &Self::Constants<V>,
        link: LinkMotion<V>,
        given: [V; 3],
    ) -> [V; 6];

    /// Returns the bias force of the subtree and the link's offset, of its gain and
    /// inverse joint inertia, the parts of moment and angular velocity, and the bias
    /// force of what hangs there.
    fn scale_eliminate<V: Scalar>(
        constants: &Self::Constants<V>,
        link: LinkMotion<V>,
        given: [V; 8],
    ) -> [V; 3];

    /// Returns the angular velocity along the flow, what the children take of it, and
    /// the changes of velocities of the centre of mass and of the children's pivot; of
    /// gain and offset, and what the parent hands down of both.
    fn scale_flow<V: Scalar>(
        constants: &Self::Constants<V>,
        link: LinkMotion<V>,
        given: [V; 7],
    ) -> [V; 7];

    /// Returns the slope of the energy in the angle, with what the flow changes in
    /// momenta; of the parts of moment, 1 − cos θ, sin θ and springs' torques, the number
    /// for the means, and the moment of the changes of velocities.
    fn scale_slope<V: Scalar>(
        constants: &Self::Constants<V>,
        link: LinkMotion<V>,
        given: [V; 8],
    ) -> [V; 1];

    /// Returns the torque of inertial forces under an acceleration of the root's pivot.
    fn scale_inertial<V: Scalar>(
        constants: &Self::Constants<V>,
        link: LinkMotion<V>,
        given: [V; 2],
    ) -> [V; 1];
}
