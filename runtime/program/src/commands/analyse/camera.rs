//! Simulated camera that records a tree: data whose true values are known.

use branched_pendulum::system::State;
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

use super::subject::MeasuredTree;
use crate::Failure;
use crate::motion::{MethodArguments, sample};
use crate::subject::Subject;

/// Settings of a camera that records two dots on each link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Pictures a second.
    pub rate: f64,
    /// Standard deviation of a dot's position in each direction, in m.
    pub noise: f64,
    /// Distance between the two dots of a link, in m.
    pub distance: f64,
    /// Angle between the line through the second link's dots and its line from pivot to centre of
    /// mass, in rad.
    pub turned: f64,
    /// Seed of the noise.
    pub seed: u64,
}

/// True motion at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct Truth {
    /// Time, s.
    pub time: f64,
    /// Angles of the links, rad.
    pub links: Vec<f64>,
    /// Rates of the coordinates, rad/s.
    pub rates: Vec<f64>,
    /// Energy, J.
    pub energy: f64,
    /// Power, W.
    pub power: f64,
}

/// Computes the true motion of a tree for `duration` seconds, with `rate` pictures per second.
///
/// # Errors
/// [`Failure::Motion`].
pub fn motion(
    described: &Subject,
    subject: &MeasuredTree,
    method: &MethodArguments,
    start: &State<f64>,
    [duration, rate]: [f64; 2],
) -> Result<Vec<Truth>, Failure> {
    let count = (duration * rate).round() as u32;
    let times = (0..=count).map(|picture| f64::from(picture) / rate);
    let samples = sample(described, method, start, times.collect())?;
    let truths = samples.times.iter().zip(&samples.states);
    let truths = truths.map(|(&time, state)| {
        let (links, omega) = state.split_at(state.len() / 2);
        let motion = [links, omega].map(|part| subject.coordinates(part));
        let (energy, power) = (subject.energy(&motion), subject.powers(time, &motion, &[]));
        let [_, rates] = motion;
        Truth {
            time,
            links: links.to_vec(),
            rates,
            energy,
            power: power.reported,
        }
    });
    Ok(truths.collect())
}

impl Camera {
    /// Returns the links' angles (rad) as computed from the recorded dots.
    pub fn angles(&self, motion: &[Truth]) -> Vec<Vec<Option<f64>>> {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(self.seed);
        let mut dot = || {
            let normal: f64 = StandardNormal.sample(&mut random);
            self.noise * normal
        };
        let mut seen = |angle: f64| {
            let right = self.distance * angle.sin() + dot() - dot();
            let down = self.distance * angle.cos() + dot() - dot();
            let seen = right.atan2(down);
            // The turn that the link has made is known.
            Some(angle + (seen - angle).sin().atan2((seen - angle).cos()))
        };
        let samples = motion.iter();
        samples
            .map(|sample| {
                let mut links = sample.links.clone();
                if let Some(second) = links.get_mut(1) {
                    *second += self.turned;
                }
                links.into_iter().map(&mut seen).collect()
            })
            .collect()
    }
}
