//! The angles: out of a file, or simulated.

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
    /// What the links show where they are at 0, rad, which is taken from the angles.
    pub offsets: Vec<f64>,
    /// The time until which the links were held, where the file begins before, s; the record
    /// begins there.
    pub release: Option<f64>,
    /// End of the part that is fitted, s.
    pub until: f64,
    /// How the file was read.
    pub findings: Vec<Finding>,
    /// Values of all parameters, of a simulated record.
    pub truth: Option<Vec<(String, f64)>>,
}

impl Measurement {
    /// Reads the file of the arguments, or simulates the tree.
    ///
    /// # Errors
    /// Errors of [`MeasuredFile::read`]; of a simulation [`Failure::Tree`],
    /// [`Failure::Start`] or [`Failure::Motion`].
    pub fn new(arguments: &Arguments, unknowns: &Unknowns) -> Result<Self, Failure> {
        let measured = &arguments.measured;
        let links = unknowns.links();
        let (mut offsets, mut release) = (vec![0.0; links.len()], None);
        let (times, angles, findings, truth) = match &measured.file {
            Some(file) => {
                let read = measured.read(file, &measured_links(unknowns, measured)?)?;
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

/// Returns the links of the tree, with its place of rest where the file has a stretch at rest.
///
/// # Errors
/// Errors of [`MeasuredLinks::new`]; [`Failure::Lacking`] where the place follows from what is
/// looked for, and offsets from it would be those of the guess.
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
                    "where the tree rests depends on `{name}`, which is looked for: set it by `--set \
                     {name}=VALUE`, or give what links show at rest by --tilt in place of --rest",
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
