//! Integration of deviations from a motion, from which Lyapunov exponents are computed.

use core::ops::ControlFlow;

use nalgebra::DMatrix;

use super::error::LyapunovError;
use super::{Copies, Linearised, Variational};
use crate::integrate::{DenseStep, Integrator};
use crate::system::State;

/// Growth factor of a deviation after which all deviations are made orthonormal again, even before
/// the end of an interval.
const LARGEST_GROWTH: f64 = 1e3;

/// The kind of deviations that are followed: all, in-phase ones, or differences between copies.
#[derive(Clone, Copy)]
pub(super) enum Deviations<'a> {
    All,
    Within(&'a Copies),
    Transverse(&'a Copies),
}

impl Deviations<'_> {
    /// Returns the number of independent deviations of this kind in a system of `dimension`
    /// components.
    pub(super) fn count(self, dimension: usize) -> usize {
        match self {
            Self::All => dimension,
            Self::Within(copies) => dimension.saturating_sub(copies.differences()),
            Self::Transverse(copies) => copies.differences().min(dimension),
        }
    }

    /// Projects consecutive vectors of length `n` onto the deviations of this kind.
    pub(super) fn keep(self, vectors: &mut [f64], n: usize) {
        for vector in vectors.chunks_mut(n) {
            match self {
                Self::All => {}
                Self::Within(copies) => copies.keep_common(vector),
                Self::Transverse(copies) => {
                    let all = vector.to_vec();
                    copies.write_differences(&all, vector);
                }
            }
        }
    }

    /// Removes differences between copies that rounding has caused in an in-phase motion.
    pub(super) fn keep_motion(self, motion: &mut [f64]) {
        if let Self::Within(copies) | Self::Transverse(copies) = self {
            copies.keep_common(motion);
        }
    }

    /// Projects consecutive vectors of length `n` onto the deviations of this kind and makes them
    /// orthonormal. Returns the logarithms of the lengths by which they were divided.
    pub(super) fn orthonormalise(
        self,
        vectors: &mut [f64],
        time: f64,
        n: usize,
    ) -> Result<Vec<f64>, LyapunovError> {
        self.keep(vectors, n);
        let factors = DMatrix::from_column_slice(n, vectors.len() / n, vectors).qr();
        let lengths = factors.r().diagonal().map(f64::abs);
        let is_length = |length: &f64| length.is_finite() && *length > 0.0;
        if !lengths.iter().all(is_length) {
            return Err(LyapunovError::Degenerate { time });
        }
        vectors.copy_from_slice(factors.q().as_slice());
        Ok(lengths.iter().map(|length| length.ln()).collect())
    }

    /// Integrates a motion and orthonormal deviations from it to the time `end`, makes the
    /// deviations orthonormal again, and returns the logarithms of their growth factors. It also
    /// makes them orthonormal earlier if one has grown by [`LARGEST_GROWTH`]: otherwise the
    /// rounding of a large deviation would exceed the tolerance of small ones, and no step would be
    /// short enough.
    pub(super) fn grow<L, M>(
        self,
        method: &M,
        system: &Variational<'_, L>,
        motion: &State<f64>,
        vectors: &mut [f64],
        end: f64,
    ) -> Result<Vec<f64>, LyapunovError>
    where
        L: Linearised<f64>,
        M: for<'a> Integrator<f64, Variational<'a, L>>,
    {
        let dimension = motion.values.len();
        let mut growth = vec![0.0; vectors.len() / dimension];
        let mut both = State::new(motion.time, [&motion.values, &*vectors].concat());
        let has_grown = |step: &mut DenseStep<'_, f64>| {
            let deviations = step.end().get(dimension..).unwrap_or_default();
            match deviations.iter().any(|part| part.abs() > LARGEST_GROWTH) {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        };
        while both.time != end {
            both = method.integrate(system, &both, end, has_grown)?.state;
            let (beside, deviations) = both.values.split_at_mut(dimension);
            self.keep_motion(beside);
            let logarithms = self.orthonormalise(deviations, both.time, dimension)?;
            for (sum, logarithm) in growth.iter_mut().zip(logarithms) {
                *sum += logarithm;
            }
        }
        vectors.copy_from_slice(both.values.get(dimension..).unwrap_or_default());
        Ok(growth)
    }
}
