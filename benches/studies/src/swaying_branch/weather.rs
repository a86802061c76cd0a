//! Wind with gusts, and a hand that pulls.

use std::f64::consts::TAU;

use branched_pendulum::prelude::*;
use branched_pendulum::system::LinkPoint;
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::{Rng, SeedableRng};

use super::scene::{HELD, LINKS};

/// Number of simultaneous gusts, each of which rises and falls with its own period.
const GUSTS: usize = 8;

/// Half the density of air times the width of a link with its leaves, in kg/m².
const SAIL: f64 = 0.5 * 1.2 * 0.03;

/// Times at which the hand takes the branch and lets go, in s.
pub const PULL: (f64, f64) = (1.0, 3.0);

/// Wind and hand.
#[derive(Clone, Debug, PartialEq)]
pub struct Weather {
    mean: f64,
    pull: f64,
    /// Frequency (Hz), phase (rad) and amplitude (relative to the mean speed) of each gust.
    gusts: [[f64; 3]; GUSTS],
}

impl Weather {
    /// Creates a wind with a mean speed (m/s), and a hand with a force (N).
    pub fn new(mean: f64, pull: f64, seed: f64) -> Self {
        let mut random = SplitMix64::seed_from_u64(seed as u64);
        let mut share = || random.next_u64() as f64 / u64::MAX as f64;
        let gusts = std::array::from_fn(|index| {
            // From one in 16 s to two a second, the slow ones the strongest.
            let frequency = 0.06 * 1.6_f64.powi(index as i32) * (0.8 + 0.4 * share());
            [frequency, TAU * share(), 0.35 * 0.8_f64.powi(index as i32)]
        });
        Self { mean, pull, gusts }
    }

    /// Speed of the wind, m/s.
    pub fn speed(&self, time: f64) -> f64 {
        let gusts = self.gusts.iter();
        let sum: f64 = gusts
            .map(|[frequency, phase, share]| share * (TAU * frequency * time + phase).sin())
            .sum();
        self.mean * (1.0 + sum)
    }

    /// Returns the force of the hand in N, which increases gradually when it takes hold.
    pub fn hand(&self, time: f64) -> f64 {
        let (takes, lets_go) = PULL;
        if (takes..lets_go).contains(&time) {
            self.pull * ((time - takes) / 0.5).min(1.0)
        } else {
            0.0
        }
    }

    /// Writes the torques on the links of a branch in this state. The drag of the air acts at the
    /// middle of each link and is proportional to the square of the relative speed there.
    pub fn torques<T: Real, P: Positions<T>>(
        &self,
        branch: &P,
        time: f64,
        state: &[T],
        torques: &mut [T],
    ) {
        let zero = [T::ZERO; 2];
        let (mut forces, mut of_hand) = ([zero; LINKS], [T::ZERO; LINKS]);
        let (theta, omega) = state.split_at(LINKS);
        branch.point_velocities_into(LinkPoint::Centre, theta, omega, &mut forces);
        let wind = T::from_f64(self.speed(time));
        for (link, force) in forces.iter_mut().enumerate() {
            let [x, y] = [wind - force[0], -force[1]];
            let length = branch
                .properties_of(link)
                .map_or(T::ZERO, |link| link.length());
            let drag = T::from_f64(SAIL) * length * (x * x + y * y).sqrt();
            *force = [drag * x, drag * y];
        }
        branch.point_torques_into(LinkPoint::Centre, theta, &forces, torques);
        // Against the wind.
        forces = [zero; LINKS];
        forces[HELD] = [T::from_f64(-self.hand(time)), T::ZERO];
        branch.point_torques_into(LinkPoint::End, theta, &forces, &mut of_hand);
        for (torque, of_hand) in torques.iter_mut().zip(of_hand) {
            *torque += of_hand;
        }
    }
}
