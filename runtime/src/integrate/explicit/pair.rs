//! An embedded pair: its table, its control and its estimate.

use super::stages::{ErrorScale, StepStages};
use crate::integrate::control::ControlConstants;
use crate::integrate::piece::Form;
use crate::scalar::Scalar;

/// One row of a table: numbers of stages, from 1, and their coefficients.
pub(crate) type TableRow<const N: usize> = [(usize, f64); N];

/// An embedded pair of explicit Runge–Kutta formulas with dense output.
///
/// Stages count from 1. Stage 1 is made by the step before; the rates at the
/// end of the step are stage [`STAGES`](Self::STAGES) + 1; stages beyond serve
/// the dense output.
pub trait EmbeddedPair: Copy + core::fmt::Debug + Send + Sync + 'static {
    /// Constants of the step-size control. Their order is that of the solution
    /// that is continued.
    const CONTROL: ControlConstants;
    /// Stages up to the end of the step, without the rates there.
    const STAGES: usize;
    /// Nodes of all stages, as fractions of the step.
    const NODES: &'static [f64];
    /// Rows of all stages from the second on, that of the solution in the place of
    /// the rates at the end.
    const ROWS: &'static [&'static [(usize, f64)]];
    /// The dense output.
    const DENSE: DenseForm;
    /// True if the error estimate needs the rates at the end of the step.
    const ERROR_USES_END: bool;

    /// Scaled error of a step of length `size`: one is the largest allowed.
    fn error<W: Scalar, S: ErrorScale<W>>(stages: &StepStages<W>, system: &S, size: W) -> W;
}

/// The form of a dense output: most of its coefficients are h (sum of row), three
/// come from the ends of the step.
#[derive(Clone, Copy, Debug)]
pub enum DenseForm {
    /// y + s (Δy + r (d₁ + s (d₂ + r (d₃ + …)))), r = 1 − s, with d₁ = h k₁ − Δy and
    /// d₂ = Δy − h k − d₁, k being the rates at the end; the rows are those of d₃
    /// and on.
    Alternating(&'static [&'static [(usize, f64)]]),
    /// y + Σ_k d_k (8 over k) s^k r^(8 − k), r = 1 − s, with d₁ = h k₁/8, d₈ = Δy and
    /// d₇ = Δy − h k/8; the rows are those of d₂ to d₆.
    Bernstein(&'static [&'static [(usize, f64)]]),
}

impl DenseForm {
    /// The form alone.
    pub(super) fn form(self) -> Form {
        match self {
            Self::Alternating(_) => Form::Alternating,
            Self::Bernstein(_) => Form::Bernstein,
        }
    }

    /// Rows of the coefficients that are sums over stages.
    pub(super) const fn rows(self) -> &'static [&'static [(usize, f64)]] {
        match self {
            Self::Alternating(rows) | Self::Bernstein(rows) => rows,
        }
    }

    /// Number of coefficients beyond the start value.
    pub(super) const fn terms(self) -> usize {
        self.rows().len() + 3
    }

    /// Number of coefficients before those of the rows.
    pub(super) const fn terms_before_rows(self) -> usize {
        match self {
            Self::Alternating(_) => 3,
            Self::Bernstein(_) => 1,
        }
    }
}

/// The row `weights` minus the row `other`; `N` counts the stages of both.
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
