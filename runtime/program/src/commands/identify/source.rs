//! Angles to identify from: read from a file, or simulated.

use branched_pendulum_data::Finding;
use branched_pendulum_measure::identification::AngleRecord;
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

use super::arguments::Arguments;
use super::unknowns::{Knowledge, Unknowns};
use crate::Failure;
use crate::measured_file::{MeasuredFile, MeasuredLinks};
use crate::motion::sample;

/// Assumed standard deviation of measured angles relative to neighbouring ones, in rad; it is the
/// same for all angles.
const DEVIATION: f64 = 1e-3;

/// Angles (rad) link by link; `None` for missing values.
pub type Angles = Vec<Vec<Option<f64>>>;

/// Angles of all links against time.
#[derive(Clone, Debug)]
pub struct Measurement {
    /// The whole record.
    pub record: AngleRecord,
    /// Angles of the links (rad), measured from the downward vertical.
    pub angles: Angles,
    /// Names of the links.
    pub links: Vec<String>,
    /// Measured angles (rad) of links whose true angle is 0; they are subtracted.
    pub offsets: Vec<f64>,
    /// Time (s) at which the links were released, if the file begins before; the record begins at
    /// this time.
    pub release: Option<f64>,
    /// End time of the fitted part, in s.
    pub until: f64,
    /// How the file was read.
    pub findings: Vec<Finding>,
    /// True values of all parameters, if the record is simulated.
    pub truth: Option<Vec<(String, f64)>>,
}

impl Measurement {
    /// Reads the file given in the arguments, or simulates the tree.
    ///
    /// # Errors
    /// Errors of [`MeasuredFile::read`]; for a simulation [`Failure::Tree`], [`Failure::Start`] or
    /// [`Failure::Motion`].
    pub fn new(arguments: &Arguments, unknowns: &Unknowns) -> Result<Self, Failure> {
        let measured = &arguments.measured;
        let links = unknowns.links();
        let (mut offsets, mut release) = (vec![0.0; links.len()], None);
        let (times, angles, findings, truth) = match &measured.file {
            Some(file) => {
                let mut read = measured.read(file, &measured_links(unknowns, measured)?)?;
                read.keep_longest_stretch();
                let recording = read.recording;
                let count = recording.times.len();
                let angles = recording.links.iter();
                let angles = angles.map(|link| (0..count).map(|index| link.angle(index)).collect());
                let angles: Vec<Vec<Option<f64>>> = angles.collect();
                (offsets, release) = (read.offsets, read.release);
                (recording.times, angles, recording.findings, None)
            }
            None => {
                let values = unknowns.simulated();
                let (times, angles) = simulate(arguments, unknowns, &values)?;
                let names = unknowns.parameters.iter().map(|own| own.name.clone());
                let truth = names.zip(values).collect();
                (times, angles, Vec::new(), Some(truth))
            }
        };
        let record = links.iter().zip(&angles);
        let record = record.fold(AngleRecord::new(&times), |record, (link, angles)| {
            record.with_link(link, angles, DEVIATION)
        });
        let (first, last) = match (times.first(), times.last()) {
            (Some(&first), Some(&last)) => (first, last),
            _ => (0.0, 0.0),
        };
        let until = first + arguments.fit.unwrap_or(0.75 * (last - first));
        Ok(Self {
            record,
            angles,
            links,
            offsets,
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

/// Returns the links of the tree, with their equilibrium angles if the file has a part in which
/// they hang at rest.
///
/// # Errors
/// Errors of [`MeasuredLinks::new`]; [`Failure::Lacking`] if the equilibrium depends on unknown
/// parameters, because the offsets would then depend on guesses.
fn measured_links(unknowns: &Unknowns, file: &MeasuredFile) -> Result<MeasuredLinks, Failure> {
    let links = |values: &[f64]| {
        let subject = unknowns.subject_as_given(values)?;
        MeasuredLinks::new(&subject, unknowns.offsets(), file)
    };
    let guesses = unknowns.guesses();
    let own = links(&guesses)?;
    for (index, parameter) in unknowns.parameters.iter().enumerate() {
        let is_guess = matches!(parameter.knowledge, Knowledge::Guess(_));
        if file.rest.is_none() || !is_guess {
            continue;
        }
        let mut others = guesses.clone();
        others[index] *= 1.1;
        if links(&others)?.rests_elsewhere(&own) {
            return Err(Failure::Lacking {
                what: format!(
                    "the rest position of the tree depends on the unknown parameter `{name}`: \
                     set it by `--set {name}=VALUE`, or give the measured angles of the \
                     resting links by --tilt instead of --rest",
                    name = parameter.name
                ),
            });
        }
    }
    Ok(own)
}

fn simulate(
    arguments: &Arguments,
    unknowns: &Unknowns,
    values: &[f64],
) -> Result<(Vec<f64>, Angles), Failure> {
    let subject = unknowns.subject(values)?;
    let start = arguments.release.state(&subject)?;
    let count = (arguments.duration * arguments.rate).round() as u32;
    let times = (0..=count).map(|picture| f64::from(picture) / arguments.rate);
    let motion = sample(&subject, &arguments.method, &start, times.collect())?;
    let mut random = Xoshiro256PlusPlus::seed_from_u64(arguments.seed);
    let mut noise = || {
        let normal: f64 = StandardNormal.sample(&mut random);
        arguments.noise * normal
    };
    let angles = (0..subject.parents().len())
        .map(|link| {
            let states = motion.states.iter();
            states.map(|state| Some(state[link] + noise())).collect()
        })
        .collect();
    Ok((motion.times, angles))
}
