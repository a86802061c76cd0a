//! The steps of a motion, kept for the way back in bounded memory.

use alloc::vec;
use alloc::vec::Vec;

use super::reverse::{Reverse, StepAdjoint};
use crate::integrate::right_hand_side::StepSpan;
use crate::integrate::{DenseStep, IntegrationError};
use crate::scalar::Real;
use crate::system::PullbackOde;

/// Largest number of steps whose states are kept, for methods that can repeat steps.
const KEPT: usize = 4096;

/// The steps of a motion: time and length of each, and the states of every [`stride`](Self::stride)-th
/// one. The steps between are repeated on the way back, once each.
pub(super) struct Tape<T> {
    spans: Vec<StepSpan<T>>,
    states: Vec<Vec<T>>,
    stride: usize,
    /// Steps that the way back has not passed.
    left: usize,
    /// States of the steps from a kept one on, and the index of this one.
    repeated: Vec<Vec<T>>,
    first: Option<usize>,
}

impl<T: Real> Tape<T> {
    pub(super) fn new() -> Self {
        Self {
            spans: Vec::new(),
            states: Vec::new(),
            stride: 1,
            left: 0,
            repeated: Vec::new(),
            first: None,
        }
    }

    /// Returns the number of steps.
    pub(super) fn steps(&self) -> usize {
        self.spans.len()
    }

    /// Appends a step.
    pub(super) fn push<A: StepAdjoint<T>>(&mut self, adjoint: &A, step: &DenseStep<'_, T>) {
        if self.left.is_multiple_of(self.stride) {
            self.states.push(adjoint.keep(step));
        }
        self.spans.push(StepSpan {
            time: step.start_time(),
            step: step.end_time() - step.start_time(),
        });
        self.left += 1;
        if A::REPEATS && self.states.len() > KEPT {
            let mut index = 0;
            self.states.retain(|_| {
                index += 1;
                index % 2 == 1
            });
            self.stride *= 2;
        }
    }

    /// Takes the adjoint back until only the first `before` steps are left.
    pub(super) fn back_to<A: StepAdjoint<T>, O: PullbackOde<T> + ?Sized>(
        &mut self,
        before: usize,
        adjoint: &mut A,
        reverse: &mut Reverse<T>,
        ode: &O,
    ) -> Result<(), IntegrationError<T>> {
        while self.left > before {
            self.left -= 1;
            let (kept, behind) = (self.left / self.stride, self.left % self.stride);
            if self.first != Some(kept) {
                self.repeat(kept, adjoint, ode);
            }
            let states = &self.repeated[behind];
            adjoint.back(reverse, ode, self.spans[self.left], states)?;
            reverse.note_largest();
        }
        Ok(())
    }

    /// Computes the states of the steps from a kept one up to the next, or up to the last one left.
    fn repeat<A: StepAdjoint<T>, O: PullbackOde<T> + ?Sized>(
        &mut self,
        kept: usize,
        adjoint: &mut A,
        ode: &O,
    ) {
        let start = kept * self.stride;
        let end = (start + self.stride).min(self.left + 1);
        let mut states = vec![core::mem::take(&mut self.states[kept])];
        for span in &self.spans[start..end - 1] {
            let mut state = states.last().cloned().unwrap_or_default();
            adjoint.end(ode, *span, &mut state);
            states.push(state);
        }
        (self.repeated, self.first) = (states, Some(kept));
    }
}
