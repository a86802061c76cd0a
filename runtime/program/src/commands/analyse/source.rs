//! Angles to analyse: read from a file, or recorded by a simulated camera.

use branched_pendulum_data::{Finding, Table};

use super::arguments::Arguments;
use super::camera::{Camera, Truth, motion};
use super::subject::MeasuredTree;
use crate::Failure;
use crate::measured_file::MeasuredLinks;
use crate::smoothed::AngleRows;
use crate::subject::Subject;

/// Distance between the two dots of a link in front of the simulated camera, in m.
const DOTS: f64 = 0.25;

/// Angles against time.
#[derive(Clone, Debug)]
pub struct Source {
    /// Times, s.
    pub times: Vec<f64>,
    /// Angles of the links, rad.
    pub angles: Vec<Vec<Option<f64>>>,
    /// Names of the columns or dots of the links, if a file was read.
    pub links: Vec<String>,
    /// How a file was read.
    pub findings: Vec<Finding>,
    /// Measured angles (rad) of links whose true angle is 0; they are subtracted.
    pub offsets: Vec<f64>,
    /// True motion, if a camera was simulated.
    pub truth: Vec<Truth>,
}

impl Source {
    /// Extracts the angles of the tree's links from the table of the given file.
    ///
    /// # Errors
    /// Errors of [`MeasuredFile::angles`](crate::measured_file::MeasuredFile::angles).
    pub fn read(
        table: &Table,
        arguments: &Arguments,
        hung: &MeasuredLinks,
    ) -> Result<Self, Failure> {
        let read = arguments.measured.angles(table, hung)?;
        let recording = read.recording;
        let row = |index: usize| {
            let links = recording.links.iter();
            links.map(|link| link.angle(index)).collect()
        };
        let rows = (0..recording.times.len()).step_by(arguments.every);
        Ok(Self {
            angles: rows.clone().map(row).collect(),
            times: rows.map(|index| recording.times[index]).collect(),
            links: recording.links.into_iter().map(|link| link.name).collect(),
            findings: recording.findings,
            offsets: read.offsets,
            truth: Vec::new(),
        })
    }

    /// Simulates a camera that records a tree, which may differ from the assumed one.
    ///
    /// # Errors
    /// [`Failure::Start`], [`Failure::NoLink`], [`Failure::Motion`], and those of
    /// [`MeasuredTree::new`].
    pub fn simulate(arguments: &Arguments, real: &Subject) -> Result<Self, Failure> {
        let subject = MeasuredTree::new(real, arguments.sector.as_deref())?;
        let mut start = arguments.release.state(real)?;
        let difference = subject.difference().unwrap_or_default();
        for (angle, weight) in start.values.iter_mut().zip(difference) {
            *angle += weight * arguments.difference;
        }
        let camera = Camera {
            rate: arguments.rate,
            noise: arguments.noise,
            distance: DOTS,
            turned: arguments.turned.to_radians(),
            seed: arguments.seed,
        };
        let span = [arguments.duration, camera.rate];
        let truth = motion(real, &subject, &arguments.method, &start, span)?;
        Ok(Self {
            times: truth.iter().map(|sample| sample.time).collect(),
            angles: camera.angles(&truth),
            links: Vec::new(),
            findings: Vec::new(),
            offsets: Vec::new(),
            truth,
        })
    }

    /// The angles with their times.
    pub fn record(&self) -> AngleRows<'_> {
        AngleRows {
            times: &self.times,
            angles: &self.angles,
        }
    }
}
