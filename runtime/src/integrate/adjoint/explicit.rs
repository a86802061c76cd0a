//! The adjoint of one step of an explicit Runge–Kutta pair.

use alloc::vec;
use alloc::vec::Vec;
use core::marker::PhantomData;

use super::AdjointMethod;
use super::reverse::{Reverse, StepAdjoint};
use crate::integrate::explicit::{EmbeddedPair, ExplicitRungeKutta};
use crate::integrate::right_hand_side::StepSpan;
use crate::integrate::{DenseStep, IntegrationError};
use crate::scalar::Real;
use crate::system::{PullbackOde, Workspace};

/// Memory for the adjoint of one step.
pub struct ExplicitAdjoint<M, T> {
    /// States of the stages, one after the other.
    states: Vec<T>,
    /// Rates of the stages; on the way back their adjoints.
    rates: Vec<T>,
    weights: Vec<T>,
    stage_adjoint: Vec<T>,
    workspace: Workspace<T>,
    pair: PhantomData<M>,
}

impl<M: EmbeddedPair, T: Real> AdjointMethod<T> for ExplicitRungeKutta<M, T> {
    type Step = ExplicitAdjoint<M, T>;

    fn step_adjoint(&self, dimension: usize) -> ExplicitAdjoint<M, T> {
        let zeros = |vectors: usize| vec![T::ZERO; vectors * dimension];
        ExplicitAdjoint {
            states: zeros(M::STAGES),
            rates: zeros(M::STAGES),
            weights: zeros(1),
            stage_adjoint: zeros(1),
            workspace: Workspace::new(),
            pair: PhantomData,
        }
    }
}

impl<M: EmbeddedPair, T: Real> ExplicitAdjoint<M, T> {
    /// Computes the states and the rates of all stages of a step.
    fn stages<O: PullbackOde<T> + ?Sized>(&mut self, ode: &O, span: StepSpan<T>, start: &[T]) {
        let n = start.len();
        for stage in 0..M::STAGES {
            let own = &mut self.states[stage * n..(stage + 1) * n];
            own.copy_from_slice(start);
            add_rates(own, row::<M>(stage), span.step, &self.rates);
            let rates = &mut self.rates[stage * n..(stage + 1) * n];
            ode.rates_with(&mut self.workspace, span.node(M::NODES[stage]), own, rates);
        }
    }
}

impl<M: EmbeddedPair, T: Real> StepAdjoint<T> for ExplicitAdjoint<M, T> {
    const REPEATS: bool = true;

    fn keep(&self, step: &DenseStep<'_, T>) -> Vec<T> {
        step.start().to_vec()
    }

    fn end<O: PullbackOde<T> + ?Sized>(&mut self, ode: &O, span: StepSpan<T>, state: &mut [T]) {
        self.stages(ode, span, state);
        add_rates(state, row::<M>(M::STAGES), span.step, &self.rates);
    }

    fn back<O: PullbackOde<T> + ?Sized>(
        &mut self,
        reverse: &mut Reverse<T>,
        ode: &O,
        span: StepSpan<T>,
        states: &[T],
    ) -> Result<(), IntegrationError<T>> {
        let n = states.len();
        self.stages(ode, span, states);
        // The end of the step is y + h Σ b k.
        self.rates.fill(T::ZERO);
        spread(
            &mut self.rates,
            row::<M>(M::STAGES),
            span.step,
            &reverse.adjoint,
        );
        for stage in (0..M::STAGES).rev() {
            let rates_adjoint = &self.rates[stage * n..(stage + 1) * n];
            self.weights.copy_from_slice(rates_adjoint);
            self.stage_adjoint.fill(T::ZERO);
            ode.add_pullback(
                &mut reverse.pullback,
                span.node(M::NODES[stage]),
                &self.states[stage * n..(stage + 1) * n],
                &self.weights,
                &mut self.stage_adjoint,
                &mut reverse.parameters,
            );
            // The state of a stage is y + h Σ a k.
            spread(
                &mut self.rates,
                row::<M>(stage),
                span.step,
                &self.stage_adjoint,
            );
            for (adjoint, more) in reverse.adjoint.iter_mut().zip(&self.stage_adjoint) {
                *adjoint += *more;
            }
        }
        reverse.check_finite(span.time, states)
    }
}

/// Returns the row of the table for a stage, counted from 0; the row of the stage after the last one
/// holds the weights of the solution.
fn row<M: EmbeddedPair>(stage: usize) -> &'static [(usize, f64)] {
    match stage {
        0 => &[],
        _ => M::ROWS[stage - 1],
    }
}

/// Adds h Σ a k, with the step length h and the rates k, to a state.
fn add_rates<T: Real>(state: &mut [T], row: &[(usize, f64)], length: T, rates: &[T]) {
    let n = state.len();
    for &(stage, weight) in row {
        let factor = T::from_f64(weight) * length;
        let rates = &rates[(stage - 1) * n..stage * n];
        for (value, rate) in state.iter_mut().zip(rates) {
            *value += factor * *rate;
        }
    }
}

/// Adds the adjoint of y + h Σ a k, times h a, to the adjoint of each of the rates k.
fn spread<T: Real>(rates: &mut [T], row: &[(usize, f64)], length: T, adjoint: &[T]) {
    let n = adjoint.len();
    for &(stage, weight) in row {
        let factor = T::from_f64(weight) * length;
        let rates = &mut rates[(stage - 1) * n..stage * n];
        for (rate, adjoint) in rates.iter_mut().zip(adjoint) {
            *rate += factor * *adjoint;
        }
    }
}
