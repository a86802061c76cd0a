//! All releases as a film, side by side.

use branched_pendulum_charts::{Film, FilmLink};

use super::scenes::BranchedDouble;
use super::{Arguments, Run};
use branched_pendulum_frame::Failure;
use branched_pendulum_frame::Job;

/// Pictures in a second, between which browsers interpolate.
const RATE: f64 = 20.0;

/// Where the children hang on the parent, m.
const JOINT: f64 = 0.27;

/// Writes the film. Links are drawn to where their mass would swing alike as a point: (I + m
/// d²)/(m d) from the pivot for the children, the joint for the parent.
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
