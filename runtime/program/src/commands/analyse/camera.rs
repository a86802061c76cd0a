//! A simulated camera before a tree: data whose truth is known.

use branched_pendulum::system::State;
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

use super::subject::MeasuredSubject;
use crate::Failure;
use crate::motion::{MethodArguments, sample};
use crate::subject::Subject;

/// Pictures of a tree by a camera, each link by two dots.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Pictures a second.
    pub rate: f64,
    /// Standard deviation of a dot's place in each direction, m.
    pub noise: f64,
    /// Distance of the two dots of a link, m.
    pub distance: f64,
    /// Angle between the second link's dots and its line from pivot to centre of mass, rad.
    pub turned: f64,
    /// Seed of the noise.
    pub seed: u64,
}

/// A motion as it is, at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Truth<const N: usize> {
    /// Time, s.
    pub time: f64,
    /// Angles of the links, rad.
    pub links: [f64; N],
    /// Rates of the coordinates, rad/s.
    pub rates: [f64; N],
    /// Energy, J.
    pub energy: f64,
    /// Power, W.
    pub power: f64,
}

/// The motion of a tree as it is, `rate` pictures in each second of `duration`.
///
/// # Errors
/// [`Failure::Motion`].
pub fn motion<const N: usize>(
    described: &Subject,
    subject: &dyn MeasuredSubject<N>,
    method: &MethodArguments,
    start: &State<f64>,
    [duration, rate]: [f64; 2],
) -> Result<Vec<Truth<N>>, Failure> {
    let count = (duration * rate).round() as u32;
    let times = (0..=count).map(|picture| f64::from(picture) / rate);
    let samples = sample(described, method, start, times.collect())?;
    let truths = samples.times.iter().zip(&samples.states);
    let truths = truths.map(|(&time, state)| {
        let part = |part: usize| std::array::from_fn(|link| state[part * N + link]);
        let (links, omega) = (part(0), part(1));
        let motion = [subject.coordinates(&links), subject.coordinates(&omega)];
        Truth {
            time,
            links,
            rates: motion[1],
            energy: subject.energy(&motion),
            power: subject.powers(time, &motion, &[]).told,
        }
    });
    Ok(truths.collect())
}

impl Camera {
    /// The links' angles (rad) as they follow from the dots.
    pub fn angles<const N: usize>(&self, motion: &[Truth<N>]) -> Vec<[Option<f64>; N]> {
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
                let mut links = sample.links;
                if let Some(second) = links.get_mut(1) {
                    *second += self.turned;
                }
                links.map(&mut seen)
            })
            .collect()
    }
}
