//! A simulated camera before the paper's apparatus: data whose truth is known.

use branched_pendulum::integrate::Solution;
use branched_pendulum::prelude::{Dop853, Options, State, SymmetricCoordinates};
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

use crate::branched_double::{Apparatus, Sample};
use crate::failure::Failure;

/// What a camera sees of the apparatus, each link by two dots.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Pictures a second.
    pub rate: f64,
    /// Standard deviation of a dot's place in each direction, m.
    pub noise: f64,
    /// Distance of the two dots of a link, m.
    pub distance: f64,
    /// Seed of the noise.
    pub seed: u64,
}

/// A release at rest: the parent at an angle, the children vertical but for θ_d.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Release {
    /// Angle of the parent, degrees.
    pub angle_deg: f64,
    /// θ_d(0), rad.
    pub difference: f64,
    /// Length of the record, s.
    pub duration: f64,
}

/// The motion as it is, at every picture.
///
/// # Errors
/// [`Failure::Integration`].
pub fn motion(apparatus: &Apparatus, release: Release, rate: f64) -> Result<Vec<Sample>, Failure> {
    let count = (release.duration * rate).round() as u32;
    let times: Vec<f64> = (0..=count)
        .map(|picture| f64::from(picture) / rate)
        .collect();
    let angles = [release.angle_deg.to_radians(), 0.0, release.difference];
    let start = State::at_rest(0.0, &angles);
    let method = Dop853::new(Options::with_tolerance(1e-13));
    let mut samples = Vec::with_capacity(times.len());
    let measure = |time: f64, state: &[f64]| {
        if let ([a, b, c], [d, e, f]) = (&state[..3], &state[3..]) {
            samples.push(apparatus.measure(time, [*a, *b, *c], [*d, *e, *f]));
        }
    };
    let run: Result<Solution<f64>, _> = match apparatus.damped() {
        Some(model) => method.sample(&SymmetricCoordinates(model), &start, &times, measure),
        None => method.sample(
            &SymmetricCoordinates(apparatus.ideal()),
            &start,
            &times,
            measure,
        ),
    };
    run.map_err(|error| Failure::integration(release.angle_deg, error))?;
    Ok(samples)
}

impl Camera {
    /// Standard deviation of a link's angle, rad: that of a dot across the link, twice.
    pub fn angle_noise(&self) -> f64 {
        self.noise * 2.0_f64.sqrt() / self.distance
    }

    /// The links' angles (rad) as they follow from the dots.
    pub fn angles(&self, motion: &[Sample]) -> Vec<[Option<f64>; 3]> {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(self.seed);
        let mut dot = || {
            let normal: f64 = StandardNormal.sample(&mut random);
            self.noise * normal
        };
        let angle = |angle: f64, dot: &mut dyn FnMut() -> f64| {
            let right = self.distance * angle.sin() + dot() - dot();
            let down = self.distance * angle.cos() + dot() - dot();
            let seen = right.atan2(down);
            // The turn that the link has made is known.
            Some(angle + (seen - angle).sin().atan2((seen - angle).cos()))
        };
        let samples = motion.iter();
        samples
            .map(|sample| sample.theta.map(|theta| angle(theta, &mut dot)))
            .collect()
    }
}
