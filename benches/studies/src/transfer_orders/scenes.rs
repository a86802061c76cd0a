//! The trees looked at.
//!
//! One more tree is a description that asks for truncated forms of W beside the
//! exact one (`transfer(…, exact)` where copies are single links,
//! `budget(canonical, …)` for any tree) and two lines in [`run`](super::run).

use branched_pendulum::analysis::truncation::Background;
use branched_pendulum::branched_pendulum;

use super::study::Settings;
use crate::scenes::BranchedDouble;
use branched_pendulum_frame::Failure;

/// Two jointed arms on a body: a sector of two coordinates.
#[branched_pendulum(
    gravity = 9.80665,
    body: rod(mass = 0.2, length = 0.3) [
        arm: rod(mass = 0.1, length = 0.2) [hand: rod(mass = 0.05, length = 0.15)] * 2
    ],
    emit(budget(
        canonical, angle = 1, amplitude = 2, amplitude = 4, amplitude = 6, amplitude = 8
    )),
)]
pub struct Arms;

/// Released as the paper does, from the angle of the two it compares from which
/// θ_d grows.
///
/// # Errors
/// [`Failure::Truncation`].
pub fn apparatus(states: usize) -> Result<Settings, Failure> {
    let release = [47.8_f64.to_radians(), 0.0, 0.0];
    let mut settings = Settings::released(
        "paper",
        "the paper's apparatus, released from 47.8°",
        &BranchedDouble::new(),
        &release,
        states,
    )?;
    // Rounded from what the apparatus goes through after such a release.
    settings.phase_average.background = Background {
        angles: vec![0.8, 2.0, 0.0],
        rates: vec![4.0, 10.0, 0.0],
    };
    Ok(settings)
}

/// Released with the body at 45° and the rest vertical.
///
/// # Errors
/// [`Failure::Truncation`].
pub fn arms(states: usize) -> Result<Settings, Failure> {
    let release = [45.0_f64.to_radians(), 0.0, 0.0, 0.0, 0.0];
    let title = "two jointed arms on a body, released from 45°";
    Settings::released("arms", title, &Arms::new(), &release, states)
}
