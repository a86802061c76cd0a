//! The angles: out of a file, or simulated.

use branched_pendulum::prelude::{AbsoluteAngles, Dop853, Integrator, Options, State};
use branched_pendulum_data::Finding;
use branched_pendulum_measure::identification::AngleRecord;
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

use super::arguments::Arguments;
use super::scene::{Described, simulated};
use branched_pendulum_program::Failure;

/// Pictures a second of a simulated record.
const RATE: f64 = 100.0;
/// Deviation of angles beside each other, rad: all are equally good.
const DEVIATION: f64 = 1e-3;

/// Angles link by link (rad); none where they are missing.
pub type Angles = Vec<Vec<Option<f64>>>;

/// Angles of all links against time.
#[derive(Clone, Debug)]
pub struct Measurement {
    /// All of the record.
    pub record: AngleRecord,
    /// Angles of the links (rad), from the downward vertical.
    pub angles: Angles,
    /// Names of the links.
    pub links: Vec<String>,
    /// The time until which the links were held, where the file begins before, s; the record
    /// begins there.
    pub release: Option<f64>,
    /// End of the part that is fitted, s.
    pub until: f64,
    /// How the file was read.
    pub findings: Vec<Finding>,
    /// Values of all parameters, of a simulated record.
    pub truth: Option<Vec<(&'static str, f64)>>,
}

impl Measurement {
    /// Reads the file of the arguments, or simulates a tree.
    ///
    /// # Errors
    /// [`Failure::Reading`], [`Failure::Links`] or [`Failure::Integration`].
    pub fn new<M: Described>(arguments: &Arguments) -> Result<Self, Failure> {
        let measured = &arguments.measured;
        // Names are the same whatever the values.
        let links = M::with_parameters::<f64>(|_| f64::NAN).link_names();
        let (times, angles, findings, truth) = match &measured.file {
            Some(file) => {
                let recording = measured.read(file, links.len())?;
                let count = recording.times.len();
                let angles = recording.links.iter();
                let angles = angles.map(|link| (0..count).map(|index| link.angle(index)).collect());
                let angles: Vec<Vec<Option<f64>>> = angles.collect();
                (recording.times, angles, recording.findings, None)
            }
            None => {
                let (times, angles) = simulate::<M>(arguments)?;
                let truth = M::PARAMETERS.iter().copied().zip(simulated::<M>());
                (times, angles, Vec::new(), Some(truth.collect()))
            }
        };
        let of = |times: &[f64], angles: &Angles| {
            let record = links.iter().zip(angles);
            record.fold(AngleRecord::new(times), |record, (link, angles)| {
                record.with_link(link, angles, DEVIATION)
            })
        };
        let release = of(&times, &angles).release();
        let held = times.partition_point(|&time| release.is_some_and(|release| time < release));
        let times = times[held..].to_vec();
        let angles: Angles = angles.iter().map(|link| link[held..].to_vec()).collect();
        let record = of(&times, &angles);
        let (first, last) = match (times.first(), times.last()) {
            (Some(&first), Some(&last)) => (first, last),
            _ => (0.0, 0.0),
        };
        let until = first + arguments.fit.unwrap_or(0.75 * (last - first));
        Ok(Self {
            record,
            angles,
            links,
            release,
            until,
            findings,
            truth,
        })
    }

    /// The part that is fitted.
    pub fn fitted(&self) -> AngleRecord {
        self.record.between(f64::NEG_INFINITY, self.until)
    }

    /// The part that is predicted.
    pub fn later(&self) -> AngleRecord {
        self.record.between(self.until, f64::INFINITY)
    }
}

fn simulate<M: Described>(arguments: &Arguments) -> Result<(Vec<f64>, Angles), Failure> {
    let values = simulated::<M>();
    let tree = M::with_parameters(|index| values[index]);
    let count = (arguments.duration * RATE).round() as u32;
    let times: Vec<f64> = (0..=count)
        .map(|picture| f64::from(picture) / RATE)
        .collect();
    let start = State::at_rest(0.0, M::RELEASE);
    let method = Dop853::new(Options::with_tolerance(1e-12));
    let motion = method.sample_to_vec(&AbsoluteAngles(&tree), &start, &times);
    let motion = motion.map_err(|error| Failure::integration(M::RELEASE[0].to_degrees(), error))?;
    let mut random = Xoshiro256PlusPlus::seed_from_u64(arguments.seed);
    let mut noise = || {
        let normal: f64 = StandardNormal.sample(&mut random);
        arguments.noise * normal
    };
    let angles = (0..tree.links())
        .map(|link| {
            motion
                .iter()
                .map(|state| Some(state.values[link] + noise()))
                .collect()
        })
        .collect();
    Ok((times, angles))
}
