//! Random states, in the two layouts that the contenders read.

use super::random::Random;

/// Angles or angular velocities of many states.
#[derive(Clone, Debug, PartialEq)]
pub struct Layouts {
    /// State by state, each with all of its links.
    pub by_state: Vec<Vec<f64>>,
    /// Link by link, each in all states.
    pub by_link: Vec<Vec<f64>>,
}

/// `count` states of `links` links, between `-bound` and `bound`.
#[must_use]
pub fn random(seed: u64, links: usize, count: usize, bound: f64) -> Layouts {
    let mut random = Random::new(seed);
    let by_state: Vec<Vec<f64>> = (0..count)
        .map(|_| (0..links).map(|_| random.within(bound)).collect())
        .collect();
    let by_link = (0..links)
        .map(|link| by_state.iter().map(|state| state[link]).collect())
        .collect();
    Layouts { by_state, by_link }
}
