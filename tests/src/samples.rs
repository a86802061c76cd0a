//! How many random trees a test takes: a few in every run, and more of them in `.ci/more`.

use std::ops::Range;

/// Seeds of random trees: `few` of them, or `few` times the factor in the environment variable
/// `BRANCHED_PENDULUM_SAMPLES`, which `.ci/more` sets. A test that passes with more seeds passes
/// with the first of them, so that `few` is only a matter of time.
///
/// # Panics
/// If the variable is not a whole number of at least 1.
pub fn seeds(few: u64) -> Range<u64> {
    let factor = std::env::var("BRANCHED_PENDULUM_SAMPLES").map_or(1, |text| {
        let factor: u64 = text
            .parse()
            .expect("BRANCHED_PENDULUM_SAMPLES is a whole number");
        assert!(factor > 0, "BRANCHED_PENDULUM_SAMPLES is at least 1");
        factor
    });
    0..few * factor
}
