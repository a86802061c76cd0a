//! Definition of an embedded pair: its table, step-size control and error estimate.

use super::stages::{ErrorScale, StepStages};
use crate::integrate::control::ControlConstants;
use crate::integrate::piece::Form;
use crate::scalar::Scalar;

/// Row of a table: pairs of a stage number (counted from 1) and its coefficient.
pub(crate) type TableRow<const N: usize> = [(usize, f64); N];

/// An embedded pair of explicit Runge–Kutta formulas with dense output.
///
/// Stages count from 1. Stage 1 is the last evaluation of the step before. The rates at the end of
/// the step are stage [`STAGES`](Self::STAGES) + 1. Later stages serve the dense output.
pub trait EmbeddedPair: Copy + core::fmt::Debug + Send + Sync + 'static {
    /// Constants of the step-size control. The order in them is the order of the solution from
    /// which the next step starts.
    const CONTROL: ControlConstants;
    /// Number of stages up to the end of the step, not counting the evaluation at the end.
    const STAGES: usize;
    /// Nodes of all stages, as fractions of the step.
    const NODES: &'static [f64];
    /// Rows of all stages from the second on. The row of stage [`STAGES`](Self::STAGES) + 1 holds
    /// the weights of the solution.
    const ROWS: &'static [&'static [(usize, f64)]];
    /// Form and rows of the dense output.
    const DENSE: DenseForm;
    /// True if the error estimate needs the rates at the end of the step.
    const ERROR_USES_END: bool;

    /// Returns the scaled error of a step of length `size`; 1 is the largest allowed error.
    fn error<W: Scalar, S: ErrorScale<W>>(stages: &StepStages<W>, system: &S, size: W) -> W;
}

/// Form of a dense output. Three of its coefficients come from the ends of the step; the others are
/// h · Σ (row · rates).
#[derive(Clone, Copy, Debug)]
pub enum DenseForm {
    /// y + s (Δy + r (d₁ + s (d₂ + r (d₃ + …)))) with r = 1 − s, d₁ = h k₁ − Δy and d₂ = Δy − h k −
    /// d₁, where y is the state and k₁ the rates at the start, Δy the increment, h the length of
    /// the step, and k the rates at its end. The rows give d₃ and later coefficients.
    Alternating(&'static [&'static [(usize, f64)]]),
    /// y + Σ_k d_k (8 over k) s^k r^(8 − k) with r = 1 − s, d₁ = h k₁/8, d₈ = Δy and d₇ = Δy − h
    /// k/8, where y is the state and k₁ the rates at the start, Δy the increment, h the length of
    /// the step, and k the rates at its end. The rows give d₂ to d₆.
    Bernstein(&'static [&'static [(usize, f64)]]),
}

impl DenseForm {
    /// Returns the form without its rows.
    pub(super) fn form(self) -> Form {
        match self {
            Self::Alternating(_) => Form::Alternating,
            Self::Bernstein(_) => Form::Bernstein,
        }
    }

    /// Returns all rows of the coefficient tables; each row contains the weights of a sum over
    /// stages.
    pub(super) const fn rows(self) -> &'static [&'static [(usize, f64)]] {
        match self {
            Self::Alternating(rows) | Self::Bernstein(rows) => rows,
        }
    }

    /// Returns the number of coefficients, not counting the start value.
    pub(super) const fn terms(self) -> usize {
        self.rows().len() + 3
    }

    /// Returns the number of coefficients that come before the first one with a row.
    pub(super) const fn terms_before_rows(self) -> usize {
        match self {
            Self::Alternating(_) => 3,
            Self::Bernstein(_) => 1,
        }
    }
}

/// Returns the row `weights` minus the row `other`. `N` is the number of stages in either.
pub(super) const fn difference<const N: usize>(
    weights: &[(usize, f64)],
    other: &[(usize, f64)],
) -> TableRow<N> {
    let mut row = [(0, 0.0); N];
    let mut i = 0;
    while i < weights.len() {
        row[i] = weights[i];
        i += 1;
    }
    let mut j = 0;
    while j < other.len() {
        let (stage, weight) = other[j];
        let mut i = 0;
        while row[i].0 != stage && row[i].0 != 0 {
            i += 1;
        }
        row[i] = (stage, row[i].1 - weight);
        j += 1;
    }
    row
}
