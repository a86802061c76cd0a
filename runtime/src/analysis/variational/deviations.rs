//! Deviations from a motion that are followed for its exponents.

use core::ops::ControlFlow;

use nalgebra::DMatrix;

use super::error::LyapunovError;
use super::{Copies, Linearised, Variational};
use crate::integrate::{DenseStep, Integrator};
use crate::system::State;

/// Growth of a deviation after which all are made orthonormal again, within an interval too.
const LARGEST_GROWTH: f64 = 1e3;

/// Deviations that are looked at.
#[derive(Clone, Copy)]
pub(super) enum Deviations<'a> {
    All,
    Within(&'a Copies),
    Transverse(&'a Copies),
}

impl Deviations<'_> {
    /// Number of independent ones, in a system of a dimension.
    pub(super) fn count(self, dimension: usize) -> usize {
        match self {
            Self::All => dimension,
            Self::Within(copies) => dimension.saturating_sub(copies.differences()),
            Self::Transverse(copies) => copies.differences().min(dimension),
        }
    }

    /// Takes from vectors of length `n` that follow each other what is no such deviation.
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

    /// Takes from the motion the difference that rounding has made between copies in phase.
    pub(super) fn keep_motion(self, motion: &mut [f64]) {
        if let Self::Within(copies) | Self::Transverse(copies) = self {
            copies.keep_common(motion);
        }
    }

    /// Takes from vectors of length `n` that follow each other what is no such deviation and
    /// makes them orthonormal; returns the logarithms of the lengths that this takes out.
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

    /// Follows orthonormal deviations from a motion to a time, where they are made orthonormal
    /// again; returns the logarithms of their growth. Before that time too, wherever one has grown
    /// by [`LARGEST_GROWTH`]: the rounding of a large part would pass the tolerance of those
    /// beside it that are small, and no step would be short enough.
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
