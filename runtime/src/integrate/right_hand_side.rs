//! Equations in the form that the arithmetic of a step uses: for one state, or for one state in
//! each lane of a register.

// Users name the methods, and none of the types that their steps consist of.
#![allow(unreachable_pub)]

use crate::scalar::Scalar;

/// Largest number of stages of a step in any method, including the rates at the end.
pub(super) const MOST_STAGES: usize = 21;

/// Start time and length of a step; the length is negative in a run backwards.
#[derive(Clone, Copy, Debug)]
pub struct StepSpan<W> {
    pub(crate) time: W,
    pub(crate) step: W,
}

impl<W: Scalar> StepSpan<W> {
    /// Returns the time at the fraction `node` of the step.
    #[inline(always)]
    pub(super) fn node(&self, node: f64) -> W {
        W::from_f64(node).mul_add(self.step, self.time)
    }
}

/// Equations of one state, or of one state in each lane, so that the arithmetic of a step is
/// written once for both.
pub trait RightHandSide<W: Scalar> {
    /// Error that ends the evaluation of stages. With lanes, all stages are computed, because other
    /// lanes may be valid.
    type Failure;

    /// Returns the number of components of a state.
    fn dimension(&self) -> usize;

    /// Writes the rates of change of `state`, without checking that they are finite.
    fn write(&mut self, time: W, state: &[W], rates: &mut [W]);

    /// Writes the rates of change at `state` as stage `stage`, counted from 1, and checks that they
    /// are finite.
    fn evaluate(
        &mut self,
        stage: usize,
        time: W,
        state: &[W],
        rates: &mut [W],
    ) -> Result<(), Self::Failure>;
}
