//! What a step sees of the equations: one state, or one in each lane of a register.

// Users name the methods, and nothing that their steps are made of.
#![allow(unreachable_pub)]

use crate::scalar::Scalar;

/// Most stages of a step in any method, the rates at the end among them.
pub(super) const MOST_STAGES: usize = 21;

/// A step from `time` of length `step` (negative when running backwards).
#[derive(Clone, Copy, Debug)]
pub struct StepSpan<W> {
    pub(crate) time: W,
    pub(crate) step: W,
}

impl<W: Scalar> StepSpan<W> {
    /// Time at the fraction `node` of the step.
    #[inline(always)]
    pub(super) fn node(&self, node: f64) -> W {
        W::from_f64(node).mul_add(self.step, self.time)
    }
}

/// The equations of one state, or of one state in each lane. The arithmetic of a step is
/// written once for both.
pub trait RightHandSide<W: Scalar> {
    /// Why no further stage is made. Lanes always go on, since the others may be
    /// well.
    type Failure;

    /// Number of components of a state.
    fn dimension(&self) -> usize;

    /// Writes the rates of `state`, finite or not.
    fn write(&mut self, time: W, state: &[W], rates: &mut [W]);

    /// Writes the rates of stage `stage`, counted from 1, whose state is `state`, and sees
    /// whether they are finite.
    fn evaluate(
        &mut self,
        stage: usize,
        time: W,
        state: &[W],
        rates: &mut [W],
    ) -> Result<(), Self::Failure>;
}
