//! The torque on the root.

use std::f64::consts::TAU;

use branched_pendulum::prelude::*;
use branched_pendulum::system::{Action, CastAction};
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::{Rng, SeedableRng};

use super::arguments::Arguments;

/// Lines of a random torque.
const LINES: usize = 16;

/// Torque on the root, as a sum of cosines.
#[derive(Clone, Debug)]
pub struct Motor<T = f64> {
    /// Amplitude (N m), angular frequency (rad/s) and phase (rad) of each cosine.
    lines: Vec<[T; 3]>,
}

impl Motor {
    /// Creates the torque for one start: a single cosine of amplitude `torque` (N m), or a random
    /// torque with a flat spectrum and the same mean square.
    pub fn new(arguments: &Arguments, torque: f64, random: &mut Random) -> Self {
        let Arguments {
            frequency,
            bandwidth,
            ..
        } = *arguments;
        if bandwidth == 0.0 {
            return Self {
                lines: vec![[torque, TAU * frequency, 0.0]],
            };
        }
        let size = torque / (LINES as f64).sqrt();
        let line = |_| {
            let pace = TAU * (frequency + random.within(bandwidth));
            [size, pace, random.within(0.5 * TAU)]
        };
        Self {
            lines: (0..LINES).map(line).collect(),
        }
    }
}

impl<T: Scalar> Motor<T> {
    /// Returns the torque at a time (s), in N m.
    #[inline(always)]
    pub fn torque(&self, time: T) -> T {
        let mut sum = T::from_f64(0.0);
        for &[size, pace, phase] in &self.lines {
            let (_, cosine) = (pace * time + phase).sin_cos();
            sum = sum + size * cosine;
        }
        sum
    }
}

impl<T: Scalar> Action<T> for Motor<T> {
    #[inline(always)]
    fn act(&self, time: T, _theta: &[T], _omega: &[T], torques: &mut [T]) {
        torques.fill(T::from_f64(0.0));
        if let Some(root) = torques.first_mut() {
            *root = self.torque(time);
        }
    }
}

impl<T: Scalar> CastAction<T> for Motor<T> {
    type Of<S: Scalar> = Motor<S>;

    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Motor<S> {
        let lines = self.lines.iter();
        Motor {
            lines: lines.map(|line| line.map(&convert)).collect(),
        }
    }
}

/// Normal random numbers for the kicks of one start in one window; they do not depend on the process
/// that computes the start.
#[derive(Debug)]
pub struct Kicks(Xoshiro256PlusPlus);

impl Kicks {
    /// Kicks of the start `index` in the window of this number.
    pub fn new(seed: u64, index: usize, window: usize) -> Self {
        let own = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ ((index as u64) << 32) ^ window as u64;
        Self(Xoshiro256PlusPlus::seed_from_u64(
            own ^ 0x6b1c_0000_0000_0000,
        ))
    }

    /// Draws the next normal number.
    pub fn draw(&mut self) -> f64 {
        StandardNormal.sample(&mut self.0)
    }
}

/// Random number generator of one start; its numbers do not depend on the process that computes the
/// start.
#[derive(Debug)]
pub struct Random(Xoshiro256PlusPlus);

impl Random {
    /// Creates the random number generator of the start with this index.
    pub fn of_start(seed: u64, index: usize) -> Self {
        let own = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ index as u64;
        Self(Xoshiro256PlusPlus::seed_from_u64(own))
    }

    /// Returns a random number between `-bound` and `bound`.
    pub fn within(&mut self, bound: f64) -> f64 {
        let unit = (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
        bound * (2.0 * unit - 1.0)
    }
}
