//! Growth rate of small differences between copies, over the plane of releases from
//! rest: the angle of the parent and the common angle of all that hangs from it.
//!
//! - [`arguments`]: the command line, [`scenes`]: the trees in phase,
//! - [`map`]: growth at every point of a plane,
//! - [`normal_modes`]: the nonlinear normal modes through it, [`tongues`]: tongues of
//!   instability, and their frequencies,
//! - [`output`]: words, table and chart.

pub mod arguments;
pub mod map;
pub mod normal_modes;
pub mod output;
pub mod scenes;
pub mod tongues;

pub use arguments::{Arguments, Plane, Scene};
pub use map::Map;

use self::scenes::{ArmsInPhase, HeavyChildren, HeavyChildrenParameters};
use crate::critical_angle::scene::{InPhase, InPhaseParameters};
use branched_pendulum_frame::Failure;
use branched_pendulum_frame::Job;

/// Computes the map asked for and writes it; Ctrl-C leaves the rows that are done.
///
/// # Errors
/// [`Failure`].
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    match (arguments.plane, arguments.scene) {
        (Plane::RatioEnergy, _) => {
            let map = map::over_ratios(arguments, job, |ratio| {
                Ok(HeavyChildren::new(HeavyChildrenParameters { ratio })?)
            })?;
            output::ratios(job, &map)
        }
        (Plane::Releases, Scene::Paper) => {
            let model = InPhase::new(InPhaseParameters { friction: 0.0 })?;
            let map = map::over_releases(arguments, job, &model)?;
            if map.is_empty() {
                return Ok(());
            }
            let modes = normal_modes::of(&model, map.largest())?;
            let mut tongues = Vec::new();
            for line in tongues::lines(arguments) {
                if !job.is_interrupted() {
                    tongues.extend(tongues::along(&line, arguments, &model, &modes)?);
                }
            }
            output::releases(arguments, job, &map, &modes, &tongues)
        }
        (Plane::Releases, Scene::Arms) => {
            let map = map::over_releases(arguments, job, &ArmsInPhase::new())?;
            output::releases(arguments, job, &map, &[], &[])
        }
    }
}
