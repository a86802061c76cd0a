//! The way back of a gradient: the adjoint of the state, and its sums.

use alloc::vec;
use alloc::vec::Vec;

use crate::integrate::right_hand_side::StepSpan;
use crate::integrate::{DenseStep, InputError, IntegrationError, Report};
use crate::scalar::Real;
use crate::system::{PullbackOde, PullbackWorkspace, State};

/// Adjoint of one step of a method, with the memory that it needs.
pub trait StepAdjoint<T: Real> {
    /// True if [`end`](Self::end) computes the end of a step again.
    const REPEATS: bool;

    /// Returns the states of a step that the way back needs: its start, and for some methods the
    /// states of its stages.
    fn keep(&self, step: &DenseStep<'_, T>) -> Vec<T>;

    /// Writes the state at the end of a step in place of that at its start; NaN if the method does
    /// not [repeat](Self::REPEATS) steps.
    fn end<O: PullbackOde<T> + ?Sized>(&mut self, ode: &O, span: StepSpan<T>, state: &mut [T]);

    /// Takes the adjoint of the state from the end of a step to its start, and adds the derivatives
    /// by the parameters. `states` are those that [`keep`](Self::keep) returned.
    fn back<O: PullbackOde<T> + ?Sized>(
        &mut self,
        reverse: &mut Reverse<T>,
        ode: &O,
        span: StepSpan<T>,
        states: &[T],
    ) -> Result<(), IntegrationError<T>>;
}

/// Returns the largest magnitude.
pub(super) fn largest<'a, T: Real>(values: impl IntoIterator<Item = &'a T>) -> T {
    values
        .into_iter()
        .fold(T::ZERO, |largest, value| largest.max(value.abs()))
}

/// Error for derivatives that are not finite at a state of the motion.
pub(super) fn non_finite<T: Real>(at: &State<T>) -> IntegrationError<T> {
    IntegrationError::NonFinite {
        time: at.time,
        values: at.values.clone(),
        last: at.clone(),
        report: Report::new(),
    }
}

/// Adjoint of the state at the end of the steps that have not been passed yet, and derivatives by
/// the parameters.
pub struct Reverse<T> {
    pub(super) adjoint: Vec<T>,
    /// Largest size of a component of the adjoint so far.
    pub(super) largest: T,
    pub(super) parameters: Vec<T>,
    pub(super) pullback: PullbackWorkspace<T>,
}

impl<T: Real> Reverse<T> {
    pub(super) fn new(dimension: usize, parameters: usize) -> Self {
        Self {
            adjoint: vec![T::ZERO; dimension],
            largest: T::ZERO,
            parameters: vec![T::ZERO; parameters],
            pullback: PullbackWorkspace::new(),
        }
    }

    /// Checks the number of parameters: for a wrong one all derivatives are NaN.
    pub(super) fn check_parameters(
        &mut self,
        ode: &(impl PullbackOde<T> + ?Sized),
        start: &State<T>,
    ) -> Result<(), InputError<T>> {
        let zeros = vec![T::ZERO; start.values.len()];
        let (mut by_state, mut by_parameters) = (zeros.clone(), self.parameters.clone());
        ode.add_pullback(
            &mut self.pullback,
            start.time,
            &start.values,
            &zeros,
            &mut by_state,
            &mut by_parameters,
        );
        // Where the equations have no derivatives, some of them are NaN.
        let mut all = by_state.iter().chain(&by_parameters);
        match all.all(|slope| slope.to_f64().is_nan()) {
            true => Err(InputError::Parameters {
                found: self.parameters.len(),
            }),
            false => Ok(()),
        }
    }

    /// Updates the largest size of a component.
    pub(super) fn note_largest(&mut self) {
        self.largest = self.largest.max(largest(&self.adjoint));
    }

    /// Returns the error that derivatives are not finite, unless they are.
    pub(super) fn check_finite(&self, time: T, start: &[T]) -> Result<(), IntegrationError<T>> {
        match self.adjoint.iter().all(|adjoint| adjoint.is_finite()) {
            true => Ok(()),
            false => Err(non_finite(&State::new(time, start.to_vec()))),
        }
    }
}
