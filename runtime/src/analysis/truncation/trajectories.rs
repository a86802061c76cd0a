//! Computes errors along exact motions.

use super::curve::{ErrorCurve, SquareSums, curves};
use super::error::{TruncationError, check_amplitudes, check_length, check_positive};
use super::motion::{Powers, amplitude, sector_frequencies};
use super::{ComparedForms, small_coordinates};
use crate::ensemble::Ensemble;
use crate::integrate::{Integrator, Options, Tolerance, Verner98};
use crate::system::State;

/// Settings for the relative error of approximations of W along motions that are released from
/// rest. States are sorted by their amplitude.
///
/// Small differences grow by the same factors from any initial disturbance. With few disturbances,
/// each amplitude would be reached at a few states of the other coordinates only; therefore use
/// many disturbances in geometric progression ([`logarithmic`](super::logarithmic)). The motion
/// includes the friction and drive of the model.
///
/// The cost for each disturbance is an integration in symmetric coordinates by [`Verner98`] at the
/// tolerance 1e-12, and an evaluation of each form for each sample within the range of amplitudes.
/// The disturbances run on all cores.
#[derive(Clone, Debug, PartialEq)]
pub struct AlongTrajectories {
    /// Symmetric coordinates at the release, in rad. The small differences among them are replaced
    /// by the disturbances.
    pub release: Vec<f64>,
    /// Initial values of all small differences, in rad; one motion is computed for each.
    pub disturbances: Vec<f64>,
    /// Duration of the motion after each release, s.
    pub duration: f64,
    /// Number of samples per second.
    pub sampling: f64,
    /// Smallest and largest amplitude of the range, rad.
    pub amplitudes: [f64; 2],
    /// Number of bins in geometric progression within that range.
    pub bins: usize,
}

impl AlongTrajectories {
    /// Returns the errors of all truncated forms of W, one curve per receiving sector. Each point
    /// is at the geometric centre of its bin; bins without samples are left out.
    ///
    /// # Errors
    ///
    /// [`TruncationError`] if numbers are invalid, if the model lacks the exact form, if
    /// differences do not oscillate, or if the integration fails.
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
            // Preserves the relative accuracy of differences while they are small.
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
                // Is negative below the range; the cast to an index would turn that into zero.
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

    /// Returns the times at which the motions are sampled, in s.
    fn times(&self) -> Vec<f64> {
        let samples = (self.duration * self.sampling).floor() as u64;
        (0..=samples)
            .map(|sample| sample as f64 / self.sampling)
            .collect()
    }
}
