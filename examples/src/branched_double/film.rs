//! Film of all releases, one next to the other.

use branched_pendulum_charts::{Film, FilmLink};

use super::scenes::BranchedDouble;
use super::{Arguments, Run};
use branched_pendulum_frame::Failure;
use branched_pendulum_frame::Job;

/// Pictures per second of the film; browsers interpolate between them.
const RATE: f64 = 20.0;

/// Distance from the root at which the children hang, in m.
const JOINT: f64 = 0.27;

/// Writes the film. A child is drawn as long as the simple pendulum with the same period, (I + m
/// d²)/(m d); the parent is drawn as long as the distance from its pivot to the joint.
///
/// # Errors
/// [`Failure::Chart`] or [`Failure::File`].
pub fn write(job: &Job, arguments: &Arguments, runs: &[Run]) -> Result<(), Failure> {
    let stride = (arguments.rate / RATE).round().max(1.0) as usize;
    let model = BranchedDouble::<f64>::new();
    let child = model.inertia_child() * GRAVITY / model.gravity_child();
    let link = |parent: Option<usize>, end: f64| FilmLink {
        parent,
        pivot: [parent.map_or(0.0, |_| JOINT), 0.0],
        end: [end, 0.0],
    };
    let links = [
        link(None, JOINT),
        link(Some(0), child),
        link(Some(0), child),
    ];
    let title = "Releases of the branched double pendulum";
    let mut film = Film::new(title, stride as f64 / arguments.rate);
    for run in runs {
        let pictures: Vec<[f64; 3]> = run
            .samples
            .iter()
            .step_by(stride)
            .map(|s| s.theta)
            .collect();
        film = film.tree(format!("θ_1(0) = {}°", run.angle_deg), &links, &pictures)?;
    }
    job.film("releases", &film)
}

/// As in the scene, m/s².
const GRAVITY: f64 = 9.80665;
