//! The angles to be analysed: out of a file, or of a simulated camera.

use branched_pendulum_data::{Finding, Table};

use super::arguments::Arguments;
use super::camera::{Camera, Real, Release, Truth};
use branched_pendulum_program::Failure;
use branched_pendulum_program::smoothed::Record;

/// Distance of the two dots of a link before the simulated camera, m.
const DOTS: f64 = 0.25;

/// Angles against time.
#[derive(Clone, Debug)]
pub struct Source<const N: usize> {
    /// Times, s.
    pub times: Vec<f64>,
    /// Angles of the links, rad.
    pub angles: Vec<[Option<f64>; N]>,
    /// Columns or dots of the links, of a file.
    pub links: Vec<String>,
    /// How a file was read.
    pub findings: Vec<Finding>,
    /// The motion as it is, of a simulated camera.
    pub truth: Vec<Truth<N>>,
}

impl<const N: usize> Source<N> {
    /// Takes the angles out of the table of the arguments' file.
    ///
    /// # Errors
    /// [`Failure::Reading`] or [`Failure::Links`].
    pub fn read(table: &Table, arguments: &Arguments) -> Result<Self, Failure> {
        // Links of both pendulums hang on the first.
        let parents: [Option<usize>; N] = std::array::from_fn(|link| (link > 0).then_some(0));
        let recording = arguments.measured.angles(table, &parents)?;
        let row =
            |index: usize| std::array::from_fn(|link: usize| recording.links[link].angle(index));
        let rows = (0..recording.times.len()).step_by(arguments.every);
        Ok(Self {
            angles: rows.clone().map(row).collect(),
            times: rows.map(|index| recording.times[index]).collect(),
            links: recording.links.into_iter().map(|link| link.name).collect(),
            findings: recording.findings,
            truth: Vec::new(),
        })
    }

    /// The angles with their times.
    pub fn record(&self) -> Record<'_, N> {
        Record {
            times: &self.times,
            angles: &self.angles,
        }
    }
}

impl Source<3> {
    /// Simulates a camera before the paper's apparatus.
    ///
    /// # Errors
    /// [`Failure::Parameter`] or [`Failure::Integration`].
    pub fn simulate(arguments: &Arguments) -> Result<Self, Failure> {
        let release = Release {
            angle_deg: arguments.angle,
            difference: arguments.difference,
            duration: arguments.duration,
        };
        let camera = Camera {
            rate: arguments.rate,
            noise: arguments.noise,
            distance: DOTS,
            turned: arguments.turned.to_radians(),
            seed: arguments.seed,
        };
        let real = Real {
            friction: arguments.real_friction(),
            longer: arguments.longer,
        };
        let truth = real.motion(release, camera.rate)?;
        Ok(Self {
            times: truth.iter().map(|sample| sample.time).collect(),
            angles: camera.angles(&truth),
            links: Vec::new(),
            findings: Vec::new(),
            truth,
        })
    }
}
