//! The paper's pendulum with its children in phase, and releases of trees in phase.

use branched_pendulum::Transverse;
use branched_pendulum::prelude::*;
use branched_pendulum::system::TransverseOde;

use branched_pendulum_frame::Failure;

/// The apparatus of the paper, whose children move alike, with the equations of small
/// differences between them.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3, friction = friction) * 2
    ],
    in_phase(child),
    emit(transverse, modes),
)]
pub struct InPhase;

/// The equations of the first pair.
///
/// # Errors
/// [`Failure::NoPair`].
pub fn first_sector<P: Transverse<f64>>(model: P) -> Result<TransverseOde<P>, Failure> {
    TransverseOde::new(model, 0).ok_or(Failure::NoPair)
}

/// A release from rest, all links but the parent at one angle, with a difference of one of all
/// its links alike; angles in degrees.
pub fn at_rest<P: Transverse<f64>>(model: &P, parent: f64, children: f64) -> State<f64> {
    let mut angles = vec![children.to_radians(); model.links()];
    angles[0] = parent.to_radians();
    let links = P::TRANSVERSE.first().map_or(0, |sector| sector.links);
    angles.resize(model.links() + links, 1.0);
    State::at_rest(0.0, &angles)
}
