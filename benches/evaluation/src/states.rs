//! Random states, in the two memory layouts that the implementations read.

use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::{Rng, SeedableRng};

/// Seeds of the angles and of the velocities.
pub const SEEDS: [u64; 2] = [1, 2];

/// Angles or angular velocities of many states.
#[derive(Clone, Debug, PartialEq)]
pub struct Layouts {
    /// One state after the other, each with all of its links.
    pub by_state: Vec<Vec<f64>>,
    /// One link after the other, each with its values in all states.
    pub by_link: Vec<Vec<f64>>,
}

/// Creates `count` states of `links` links, with values between `-bound` and `bound`.
#[must_use]
pub fn random(seed: u64, links: usize, count: usize, bound: f64) -> Layouts {
    let mut random = SplitMix64::seed_from_u64(seed);
    let mut within = || {
        // The upper 53 bits are a whole number that f64 holds exactly.
        let unit = (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
        bound * (2.0 * unit - 1.0)
    };
    let by_state: Vec<Vec<f64>> = (0..count)
        .map(|_| (0..links).map(|_| within()).collect())
        .collect();
    let by_link = (0..links)
        .map(|link| by_state.iter().map(|state| state[link]).collect())
        .collect();
    Layouts { by_state, by_link }
}
