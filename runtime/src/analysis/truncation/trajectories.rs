//! Errors along exact motions.

use super::curve::{ErrorCurve, SquareSums, curves};
use super::error::{TruncationError, check_amplitudes, check_length, check_positive};
use super::motion::{Powers, amplitude, sector_frequencies};
use super::{ComparedForms, small_coordinates};
use crate::ensemble::Ensemble;
use crate::integrate::{Integrator, Options, Tolerance, Verner98};
use crate::system::State;

/// Relative error along motions that are released from rest, by the amplitude
/// at the instant.
///
/// While differences are small they grow by the same factors from any
/// disturbance, so that few releases would show each amplitude at few instants
/// of the background: many disturbances with equal ratios
/// ([`logarithmic`](super::logarithmic)) show it everywhere. Friction and drive
/// of the model are part of the motion.
///
/// Cost: an integration in symmetric coordinates by [`Verner98`] at the
/// tolerance 1e-12 for each disturbance, and an evaluation of every form for
/// each sample within the range; the disturbances on all cores.
#[derive(Clone, Debug, PartialEq)]
pub struct AlongTrajectories {
    /// Symmetric coordinates at the release, rad. Small differences start from
    /// the disturbances instead.
    pub release: Vec<f64>,
    /// Value of every small difference at the start, rad, one motion each.
    pub disturbances: Vec<f64>,
    /// Time followed after each release, s.
    pub duration: f64,
    /// Samples per second.
    pub sampling: f64,
    /// Smallest and largest amplitude looked at, rad.
    pub amplitudes: [f64; 2],
    /// Number of bins with equal ratios between them.
    pub bins: usize,
}

impl AlongTrajectories {
    /// The error of every truncated form, one curve for each receiver. A point
    /// stands at the geometric centre of its bin; bins without samples are left
    /// out.
    ///
    /// # Errors
    ///
    /// [`TruncationError`]: numbers that make no sense, a model without the
    /// exact form, differences that do not oscillate, motions that cannot be
    /// followed.
    pub fn curves(
        &self,
        model: &(impl ComparedForms + Sync),
    ) -> Result<Vec<ErrorCurve>, TruncationError> {
        let (n, receivers) = (model.coordinates(), model.receivers());
        check_length("coordinates of the release", n, &self.release)?;
        check_positive("the duration", self.duration)?;
        check_positive("the number of samples per second", self.sampling)?;
        let [low, high] = self.amplitudes;
        check_amplitudes(&self.amplitudes)?;
        let frequencies = sector_frequencies(model)?;
        let per_bin = (high / low).ln() / self.bins as f64;
        let forms = Powers::new(model)?.forms();
        let empty = SquareSums::new(receivers.len(), forms.len());
        let times = self.times();
        let options = Options {
            // Differences keep their relative accuracy while they are small.
            absolute: Tolerance::Uniform(1e-15),
            ..Options::with_tolerance(1e-12)
        };
        let method = Verner98::new(options);
        let (sectors, small) = (model.truncated_sectors(), small_coordinates(model));
        let motions = Ensemble::new().map(&self.disturbances, |_, &disturbance| {
            let (mut powers, motion) = (Powers::new(model)?, model.motion());
            let mut bins = vec![empty.clone(); self.bins];
            let mut start = self.release.clone();
            for &index in &small {
                start[index] = disturbance;
            }
            let start = State::at_rest(0.0, &start);
            let visit = |_: f64, state: &[f64]| {
                let (coordinates, rates) = state.split_at(n);
                let size = amplitude(&sectors, &frequencies, coordinates, rates);
                let bin = ((size / low).ln() / per_bin).floor();
                // Below the range it is negative, which the cast would make zero.
                if bin >= 0.0
                    && let Some(sums) = bins.get_mut(bin as usize)
                {
                    powers.evaluate(coordinates, rates);
                    sums.add(&powers.exact, &powers.truncated);
                }
            };
            method.sample(&motion, &start, &times, visit)?;
            Ok::<_, TruncationError>(bins)
        });
        let mut bins = vec![empty.clone(); self.bins];
        for motion in motions {
            for (all, own) in bins.iter_mut().zip(motion?) {
                all.append(&own);
            }
        }
        let centre = |bin: usize| low * (per_bin * (bin as f64 + 0.5)).exp();
        let sums: Vec<_> = bins
            .into_iter()
            .enumerate()
            .map(|(bin, sums)| (centre(bin), sums))
            .collect();
        Ok(curves(&receivers, &forms, &sums))
    }

    /// Times of the samples.
    fn times(&self) -> Vec<f64> {
        let samples = (self.duration * self.sampling).floor() as u64;
        (0..=samples)
            .map(|sample| sample as f64 / self.sampling)
            .collect()
    }
}
