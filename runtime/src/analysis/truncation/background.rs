//! Bounds of the coordinates that are not small differences, for random states.

use core::ops::ControlFlow;

use super::error::{TruncationError, check_length};
use super::{ComparedForms, small_coordinates};
use crate::integrate::{Integrator, Options, Verner98};
use crate::system::State;

/// Bounds of the background, the coordinates that are not small. In random states, each coordinate
/// and rate is uniformly distributed within its bounds. There is one bound per symmetric
/// coordinate; the bounds of small differences are not used.
#[derive(Clone, Debug, PartialEq)]
pub struct Background {
    /// Largest absolute values of the coordinates, rad.
    pub angles: Vec<f64>,
    /// Largest absolute values of the rates, rad/s.
    pub rates: Vec<f64>,
}

impl Background {
    /// Returns equal bounds for all coordinates of a model: `angle` in rad, `rate` in rad/s.
    #[must_use]
    pub fn uniform(model: &impl ComparedForms, angle: f64, rate: f64) -> Self {
        let n = model.coordinates();
        Self {
            angles: vec![angle; n],
            rates: vec![rate; n],
        }
    }

    /// Returns as bounds the largest absolute values, at the ends of integration steps, of the
    /// motion during `duration` (s) after a release from rest at the symmetric coordinates
    /// `release` (rad), where all small differences are set to zero.
    ///
    /// # Errors
    ///
    /// [`TruncationError::Length`] and [`TruncationError::Integration`].
    pub fn visited(
        model: &impl ComparedForms,
        release: &[f64],
        duration: f64,
    ) -> Result<Self, TruncationError> {
        let n = model.coordinates();
        check_length("coordinates of the release", n, release)?;
        let mut start = release.to_vec();
        for index in small_coordinates(model) {
            start[index] = 0.0;
        }
        let mut largest = start.iter().map(|value| value.abs()).collect::<Vec<_>>();
        largest.resize(2 * n, 0.0);
        Verner98::new(Options::with_tolerance(1e-10)).integrate(
            &model.motion(),
            &State::at_rest(0.0, &start),
            duration,
            |step| {
                for (largest, value) in largest.iter_mut().zip(step.end()) {
                    *largest = largest.max(value.abs());
                }
                ControlFlow::Continue(())
            },
        )?;
        let rates = largest.split_off(n);
        Ok(Self {
            angles: largest,
            rates,
        })
    }
}
