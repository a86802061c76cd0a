//! How many random trees a test takes: a few in every run, and more of them in `.ci/more`.

use std::ops::Range;

/// Returns the seeds of random trees: `few` of them, or `few` times the factor in the environment
/// variable `BRANCHED_PENDULUM_SAMPLES`, which `.ci/more` sets.
///
/// # Panics
/// If the variable is set and is not a whole number of at least 1.
pub fn seeds(few: u64) -> Range<u64> {
    let factor = std::env::var_os("BRANCHED_PENDULUM_SAMPLES").map_or(1, |text| {
        let factor = text.to_str().and_then(|text| text.parse::<u64>().ok());
        factor
            .filter(|&factor| factor > 0)
            .expect("BRANCHED_PENDULUM_SAMPLES is a whole number of at least 1")
    });
    0..few * factor
}
