//! What tells one embedded pair from another.

use super::arithmetic::{NonFiniteRates, Span};
use super::memory::Memory;
use crate::integrate::control::ControlConstants;
use crate::scalar::Real;
use crate::system::Ode;

/// An embedded pair of explicit Runge–Kutta formulas with dense output.
///
/// Stages count from 1. Stage 1 is made by the step before; the rates at the
/// end of the step are stage [`STAGES`](Self::STAGES) + 1; stages beyond serve
/// the dense output.
pub trait Pair: Copy + core::fmt::Debug + Send + Sync + 'static {
    /// Constants of the step-size control.
    const CONTROL: ControlConstants;
    /// Order of the solution that is continued.
    const ORDER: u32;
    /// Stages up to the end of the step, without the rates there.
    const STAGES: usize;
    /// All stages.
    const STAGES_DENSE: usize;
    /// Vectors that the dense output keeps.
    const DENSE_TERMS: usize;
    /// Whether the error estimate needs the rates at the end of the step.
    const ERROR_USES_END: bool;

    /// Stages 2 to [`STAGES`](Self::STAGES), from stage 1 in place.
    fn stages<T: Real, O: Ode<T> + ?Sized>(
        memory: &mut Memory<T>,
        ode: &O,
        span: Span<T>,
    ) -> Result<(), NonFiniteRates<T>>;

    /// The state at the end of the step.
    fn finish<T: Real>(memory: &mut Memory<T>, span: Span<T>, compensated: bool);

    /// Scaled error of the step: one is the largest allowed.
    fn error<T: Real>(memory: &Memory<T>, span: Span<T>) -> T;

    /// The stages and coefficients of the dense output of an accepted step.
    fn prepare_dense<T: Real, O: Ode<T> + ?Sized>(
        memory: &mut Memory<T>,
        ode: &O,
        span: Span<T>,
    ) -> Result<(), NonFiniteRates<T>>;

    /// Evaluates the dense output at the fraction `s` of the step.
    fn dense_output<T: Real>(memory: &Memory<T>, s: T, out: &mut [T]);
}
