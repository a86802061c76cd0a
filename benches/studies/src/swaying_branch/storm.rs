//! A storm that gives the branch strong blows at random times.

use branched_pendulum::integrate::{Frames, longest_sub_step};
use branched_pendulum::prelude::*;
use branched_pendulum::system::UnderTorques;
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::{Rng, SeedableRng};

use super::scene::{Branch, LINKS};
use super::weather::Weather;
use branched_pendulum_frame::Failure;

/// Mean speed of the wind (m/s) in the storm, and force of a blow (N).
const WIND: f64 = 30.0;
const HIT: f32 = 1e6;

/// Mean number of frames between two blows.
const FRAMES_BETWEEN: u64 = 600;

/// Effects of a storm on the branch.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Storm {
    /// Frames of it.
    pub frames: u64,
    /// Hits.
    pub hits: u64,
    /// States that were not finite.
    pub not_finite: u64,
    /// Number of sub-steps in which angular velocities were limited.
    pub limited: u64,
    /// Largest angular velocity after a frame, in rad/s.
    pub largest_rate: f64,
}

impl Storm {
    /// Returns names and values of the counters, for the record of the run.
    pub fn account(&self) -> [(&'static str, u64); 4] {
        [
            ("storm frames", self.frames),
            ("storm hits", self.hits),
            ("states not finite", self.not_finite),
            ("limited sub-steps", self.limited),
        ]
    }
}

/// Simulates the branch in single precision in a storm of `seconds`, with blows of a million
/// newtons on random links.
///
/// # Errors
/// [`Failure::Frames`].
pub fn run(branch: &Branch<f32>, seconds: f64, frame: f64) -> Result<Storm, Failure> {
    let weather = Weather::new(WIND, 0.0, 7.0);
    let mut random = SplitMix64::seed_from_u64(11);
    let start = State::at_rest(0.0, &[0.0; LINKS]);
    let sub_step = longest_sub_step(branch);
    let frames = Frames::new(UnderTorques::of(branch, vec![0.0; LINKS]), &start, sub_step);
    let mut frames = frames.map_err(|error| Failure::Frames(Box::new(error)))?;
    let mut storm = Storm::default();
    let mut torques = [0.0; LINKS];
    for number in 0..(seconds / frame) as u64 {
        weather.torques(branch, number as f64 * frame, frames.state(), &mut torques);
        if random.next_u64() % FRAMES_BETWEEN == 0 {
            // At the middle of the shortest link, about.
            torques[(random.next_u64() % LINKS as u64) as usize] += 0.1 * HIT;
            storm.hits += 1;
        }
        frames.ode_mut().torques_mut().copy_from_slice(&torques);
        frames.advance(frame as f32);
        let finite = frames.state().iter().all(|value| value.is_finite());
        storm.not_finite += u64::from(!finite);
        let rates = frames.state().iter().skip(LINKS);
        storm.largest_rate = rates.fold(storm.largest_rate, |largest, rate| {
            largest.max(f64::from(rate.abs()))
        });
        storm.frames += 1;
    }
    storm.limited = frames.limited();
    Ok(storm)
}
