//! A simulated camera before the paper's apparatus: data whose truth is known.

use branched_pendulum::integrate::Solution;
use branched_pendulum::prelude::{Dop853, Options, State, SymmetricCoordinates};
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

use super::scenes::{RealApparatus, RealApparatusParameters};
use crate::branched_double::Friction;
use branched_pendulum_program::Failure;

/// Pictures of the apparatus by a camera, each link by two dots.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Pictures a second.
    pub rate: f64,
    /// Standard deviation of a dot's place in each direction, m.
    pub noise: f64,
    /// Distance of the two dots of a link, m.
    pub distance: f64,
    /// Angle between the first child's dots and its line from pivot to centre of mass, rad.
    pub turned: f64,
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

/// Facts of an apparatus, whatever is assumed of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Real {
    /// Friction in the pivots.
    pub friction: Friction,
    /// Distance of the pivots beyond the published one, m.
    pub longer: f64,
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

/// Distance of the pivots, m.
const JOINT: f64 = 0.27;

impl Real {
    /// The motion as it is, at every picture.
    ///
    /// # Errors
    /// [`Failure::Parameter`] or [`Failure::Integration`].
    pub fn motion(&self, release: Release, rate: f64) -> Result<Vec<Truth<3>>, Failure> {
        let model = RealApparatus::new(RealApparatusParameters {
            joint: JOINT + self.longer,
            friction_root: self.friction.root,
            friction_children: self.friction.children,
        })?;
        let count = (release.duration * rate).round() as u32;
        let times: Vec<f64> = (0..=count)
            .map(|picture| f64::from(picture) / rate)
            .collect();
        let angles = [release.angle_deg.to_radians(), 0.0, release.difference];
        let start = State::at_rest(0.0, &angles);
        let method = Dop853::new(Options::with_tolerance(1e-13));
        let mut samples = Vec::with_capacity(times.len());
        let run: Result<Solution<f64>, _> = method.sample(
            &SymmetricCoordinates(&model),
            &start,
            &times,
            |time, state| {
                let &[a, b, c, d, e, f] = state else { return };
                let (coordinates, rates) = ([a, b, c], [d, e, f]);
                let momenta = model.symmetric_momenta(&coordinates, &rates);
                samples.push(Truth {
                    time,
                    links: model.from_symmetric(&coordinates),
                    rates,
                    energy: model.antiphase_energy(&coordinates, &momenta),
                    power: model
                        .transfer_exact_from_rates(&coordinates, &rates)
                        .total(),
                });
            },
        );
        run.map_err(|error| Failure::integration(release.angle_deg, error))?;
        Ok(samples)
    }
}

impl Camera {
    /// The links' angles (rad) as they follow from the dots.
    pub fn angles(&self, motion: &[Truth<3>]) -> Vec<[Option<f64>; 3]> {
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
                let [one, two, three] = sample.links;
                [one, two + self.turned, three].map(&mut seen)
            })
            .collect()
    }
}
