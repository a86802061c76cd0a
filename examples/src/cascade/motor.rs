//! The torque on the root.

use std::f64::consts::TAU;

use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::{Rng, SeedableRng};

use super::arguments::Arguments;

/// Lines of a random torque.
const LINES: usize = 16;

/// A torque on the root as a sum of cosines.
#[derive(Clone, Debug)]
pub struct Motor {
    /// Amplitude (N m), angular frequency (rad/s) and phase (rad) of each.
    lines: Vec<[f64; 3]>,
}

impl Motor {
    /// The torque on the tree of a start: one line, or a random one with a flat spectrum
    /// and the same mean square.
    pub fn new(arguments: &Arguments, random: &mut Random) -> Self {
        let Arguments {
            torque,
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

    /// The torque at a time, N m.
    pub fn torque(&self, time: f64) -> f64 {
        let lines = self.lines.iter();
        lines
            .map(|[size, pace, phase]| size * (pace * time + phase).cos())
            .sum()
    }
}

/// Random numbers of one start, whichever process computes it.
#[derive(Debug)]
pub struct Random(Xoshiro256PlusPlus);

impl Random {
    /// Random numbers of the start `index`.
    pub fn of_start(seed: u64, index: usize) -> Self {
        let own = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ index as u64;
        Self(Xoshiro256PlusPlus::seed_from_u64(own))
    }

    /// A number between `-bound` and `bound`.
    pub fn within(&mut self, bound: f64) -> f64 {
        let unit = (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
        bound * (2.0 * unit - 1.0)
    }
}
