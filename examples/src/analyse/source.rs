//! The angles to be analysed: out of a file, or of a simulated camera.

use branched_pendulum_data::{AngleColumns, Finding, LinkMarkers, Markers, Table, TableOptions};

use super::arguments::Arguments;
use super::camera::{Camera, Release, motion};
use crate::branched_double::{Apparatus, Sample};
use crate::failure::Failure;

/// Distance of the two dots of a link before the simulated camera, m.
const DOTS: f64 = 0.25;

/// Angles against time.
#[derive(Clone, Debug)]
pub struct Source {
    /// Times, s.
    pub times: Vec<f64>,
    /// Angles of the links, rad.
    pub angles: Vec<[Option<f64>; 3]>,
    /// How a file was read.
    pub findings: Vec<Finding>,
    /// The motion as it is, of a simulated camera.
    pub truth: Vec<Sample>,
}

impl Source {
    /// Reads the file of the arguments, or simulates the camera.
    ///
    /// # Errors
    /// [`Failure::Reading`], [`Failure::Links`] or [`Failure::Integration`].
    pub fn new(arguments: &Arguments, apparatus: &Apparatus) -> Result<Self, Failure> {
        match &arguments.file {
            Some(file) => Self::read(&Table::read(file, &TableOptions::default())?, arguments),
            None => Self::simulate(arguments, apparatus),
        }
    }

    fn read(table: &Table, arguments: &Arguments) -> Result<Self, Failure> {
        let recording = if arguments.dots.is_empty() && table.tracks().is_empty() {
            let columns = AngleColumns {
                clock: arguments.clock(),
                columns: arguments.columns.clone(),
                unit: arguments.unit.map(Into::into),
                zero: arguments.zero.map(Into::into),
                ..AngleColumns::default()
            };
            columns.read(table)?
        } else {
            let links = arguments.dots.iter().cloned();
            let markers = Markers {
                clock: arguments.clock(),
                links: links
                    .map(|(upper, lower)| LinkMarkers { upper, lower })
                    .collect(),
                y_down: arguments.y_down.then_some(true),
                ..Markers::default()
            };
            markers.read(table)?
        };
        let [one, two, three] = recording.links.as_slice() else {
            return Err(Failure::Links {
                path: table.path().to_path_buf(),
                found: recording.links.len(),
                expected: 3,
            });
        };
        let row = |index: usize| [one, two, three].map(|link| link.angle(index));
        Ok(Self {
            angles: (0..recording.times.len()).map(row).collect(),
            times: recording.times,
            findings: recording.findings,
            truth: Vec::new(),
        })
    }

    fn simulate(arguments: &Arguments, apparatus: &Apparatus) -> Result<Self, Failure> {
        let release = Release {
            angle_deg: arguments.angle,
            difference: arguments.difference,
            duration: arguments.duration,
        };
        let camera = Camera {
            rate: arguments.rate,
            noise: arguments.noise,
            distance: DOTS,
            seed: arguments.seed,
        };
        let truth = motion(apparatus, release, camera.rate)?;
        Ok(Self {
            times: truth.iter().map(|sample| sample.time).collect(),
            angles: camera.angles(&truth),
            findings: Vec::new(),
            truth,
        })
    }
}
