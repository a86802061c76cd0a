//! Lyapunov exponents.

use core::ops::ControlFlow;

use nalgebra::DMatrix;

use super::{Linearised, Variational};
use crate::analysis::statistics::Estimate;
use crate::errors::errors;
use crate::integrate::{IntegrationError, Integrator};
use crate::system::State;

/// Computation of the exponents of a motion.
///
/// Deviations are integrated beside the motion over equal intervals, after each
/// of which they are made orthonormal again; the mean logarithms of what that
/// takes are the exponents, the largest first. Source: G. Benettin, L. Galgani,
/// A. Giorgilli, J.-M. Strelcyn, *Lyapunov characteristic exponents for smooth
/// dynamical systems*, Meccanica 15 (1980) 9–30.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lyapunov {
    /// Number of exponents, from the largest on: at most the dimension.
    pub count: usize,
    /// Time between two orthonormalisations, some inverse exponents at most;
    /// negative for a run backwards.
    pub interval: f64,
    /// Intervals before the logarithms count: deviations turn into the
    /// directions of growth meanwhile.
    pub settling: u32,
    /// Intervals whose logarithms count.
    pub intervals: u32,
}

/// The exponents of a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct LyapunovSpectrum {
    /// Exponents, in 1/s, the largest first.
    pub exponents: Vec<f64>,
    /// Standard error of each, from the spread of ten equal parts of the run:
    /// what a longer run would narrow, if the parts were independent. NaN for
    /// fewer than ten intervals.
    pub standard_errors: Vec<f64>,
    /// State at the end of the run.
    pub end: State<f64>,
}

impl LyapunovSpectrum {
    /// Time in which an error grows from `error` to `allowed` at the mean rate
    /// of the largest exponent; none if it does not grow.
    pub fn horizon(&self, error: f64, allowed: f64) -> Option<f64> {
        let largest = *self.exponents.first()?;
        (largest > 0.0).then(|| (allowed / error).ln() / largest)
    }
}

errors! {
    /// Why there are no exponents.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    pub enum LyapunovError {
        /// None, or more than the system has directions.
        Count {
            /// Exponents asked for.
            count: usize,
            /// Dimension of the system.
            dimension: usize,
        } => "{count} exponents asked for of a system of dimension {dimension}",
        /// The interval is zero or not finite, or no interval counts.
        Interval {
            /// The interval given.
            interval: f64,
            /// The number of intervals given.
            intervals: u32,
        } => "{intervals} intervals of {interval} s make no mean",
        /// A deviation vanished, or left the range of numbers, between two
        /// orthonormalisations: the interval is too long.
        Degenerate {
            /// End of the interval.
            time: f64,
        } => "a deviation has no direction any more at t = {time}: the interval is too long",
        /// The integration failed.
        Integration(error: IntegrationError<f64>) => "{error}",
    }
}

impl std::error::Error for LyapunovError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Integration(error) => error.source(),
            _ => None,
        }
    }
}

impl From<IntegrationError<f64>> for LyapunovError {
    fn from(error: IntegrationError<f64>) -> Self {
        Self::Integration(error)
    }
}

/// Parts of a run whose spread gives the standard error.
const PARTS: usize = 10;

impl Lyapunov {
    /// The exponents of the motion of `system` from `start`.
    ///
    /// # Errors
    ///
    /// [`LyapunovError`]: a request that makes no sense, an interval that is
    /// too long, a failed integration.
    pub fn spectrum<L, M>(
        &self,
        method: &M,
        system: &L,
        start: &State<f64>,
    ) -> Result<LyapunovSpectrum, LyapunovError>
    where
        L: Linearised<f64>,
        M: for<'a> Integrator<f64, Variational<'a, L>>,
    {
        let Self {
            count,
            interval,
            settling,
            intervals,
        } = *self;
        let dimension = system.dimension();
        if count == 0 || count > dimension {
            return Err(LyapunovError::Count { count, dimension });
        }
        if !(interval.is_finite() && interval != 0.0 && intervals > 0) {
            return Err(LyapunovError::Interval {
                interval,
                intervals,
            });
        }
        super::check_dimension(system, start)?;
        let all = Variational::new(system, count);
        let mut state = start.clone();
        for direction in 0..count {
            let unit = (0..dimension).map(|i| f64::from(u8::from(i == direction)));
            state.values.extend(unit);
        }
        // One row of logarithms for each interval that counts.
        let mut logarithms: Vec<Vec<f64>> = Vec::new();
        for number in 0..settling + intervals {
            let end = start.time + f64::from(number + 1) * interval;
            let solution = method.integrate(&all, &state, end, |_| ControlFlow::Continue(()))?;
            state = solution.state;
            let row = orthonormalise(&mut state.values[dimension..], dimension)
                .ok_or(LyapunovError::Degenerate { time: end })?;
            if number >= settling {
                logarithms.push(row);
            }
        }
        state.values.truncate(dimension);
        let mean = |rows: &[Vec<f64>], index: usize| {
            let sum: f64 = rows.iter().map(|row| row[index]).sum();
            sum / (rows.len() as f64 * interval.abs())
        };
        let standard_error = |index: usize| {
            let length = logarithms.len() / PARTS;
            if length == 0 {
                return f64::NAN;
            }
            let parts = logarithms.chunks_exact(length).take(PARTS);
            let means: Vec<f64> = parts.map(|rows| mean(rows, index)).collect();
            Estimate::of_independent(&means).error
        };
        Ok(LyapunovSpectrum {
            exponents: (0..count).map(|index| mean(&logarithms, index)).collect(),
            standard_errors: (0..count).map(standard_error).collect(),
            end: state,
        })
    }
}

/// Makes vectors of length `n` that follow each other orthonormal; returns the logarithms of
/// the lengths that this takes out, none if one is zero or not finite.
fn orthonormalise(vectors: &mut [f64], n: usize) -> Option<Vec<f64>> {
    let factors = DMatrix::from_column_slice(n, vectors.len() / n, vectors).qr();
    let lengths = factors.r().diagonal().map(f64::abs);
    let is_length = |length: &f64| length.is_finite() && *length > 0.0;
    lengths.iter().all(is_length).then(|| {
        vectors.copy_from_slice(factors.q().as_slice());
        lengths.iter().map(|length| length.ln()).collect()
    })
}
