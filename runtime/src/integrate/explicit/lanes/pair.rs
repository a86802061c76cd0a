//! What tells one pair from another in lanes.

use super::memory::Memory;
use crate::integrate::explicit::Span;
use crate::integrate::explicit::pair::Pair;
use crate::integrate::lanes::Models;
use crate::scalar::register::Register;
use crate::system::Cast;

/// A pair whose steps are made in lanes. Numbers of stages as in [`Pair`].
pub trait LanePair: Pair {
    /// Nodes of all stages, as fractions of the step.
    const NODES: &'static [f64];
    /// Rows of all stages from the second on, that of the solution in the place of
    /// the rates at the end: numbers of stages and their coefficients.
    const ROWS: &'static [&'static [(usize, f64)]];

    /// Stages 2 to [`STAGES`](Pair::STAGES), from stage 1 in place.
    fn stages_in_lanes<P: Cast<R::Lane>, R: Register>(
        memory: &mut Memory<R>,
        models: &Models<P, R>,
        span: Span<R>,
    );

    /// Scaled errors of the steps of `n` components, whose lengths are `size`: one
    /// is the largest allowed.
    fn errors<R: Register>(memory: &Memory<R>, n: usize, size: R) -> R;

    /// The stages and coefficients of the dense output.
    fn prepare_dense_in_lanes<P: Cast<R::Lane>, R: Register>(
        memory: &mut Memory<R>,
        models: &Models<P, R>,
        span: Span<R>,
    );

    /// Evaluates the dense output at the fractions `s` of the steps.
    fn dense_outputs<R: Register>(memory: &Memory<R>, s: R, out: &mut [R]);
}
