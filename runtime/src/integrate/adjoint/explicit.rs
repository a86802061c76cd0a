//! The adjoint of one step of an explicit Runge–Kutta pair.

use alloc::vec;
use alloc::vec::Vec;
use core::marker::PhantomData;

use super::AdjointMethod;
use super::reverse::{Reverse, StepAdjoint};
use crate::integrate::explicit::{EmbeddedPair, ExplicitRungeKutta};
use crate::integrate::{DenseStep, IntegrationError};
use crate::scalar::Real;
use crate::system::{PullbackOde, Workspace};

/// A step of the motion: it is made again on the way back.
pub struct ExplicitStep<T> {
    time: T,
    length: T,
    start: Vec<T>,
}

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

impl<M: EmbeddedPair, T: Real> StepAdjoint<T> for ExplicitAdjoint<M, T> {
    type Taken = ExplicitStep<T>;

    fn keep(&self, step: &DenseStep<'_, T>) -> ExplicitStep<T> {
        ExplicitStep {
            time: step.start_time(),
            length: step.end_time() - step.start_time(),
            start: step.start().to_vec(),
        }
    }

    fn back<O: PullbackOde<T> + ?Sized>(
        &mut self,
        reverse: &mut Reverse<T>,
        ode: &O,
        step: &ExplicitStep<T>,
    ) -> Result<(), IntegrationError<T>> {
        let n = step.start.len();
        let node = |stage: usize| step.time + T::from_f64(M::NODES[stage]) * step.length;
        for stage in 0..M::STAGES {
            let own = &mut self.states[stage * n..(stage + 1) * n];
            own.copy_from_slice(&step.start);
            for &(other, weight) in row::<M>(stage) {
                let factor = T::from_f64(weight) * step.length;
                let rates = &self.rates[(other - 1) * n..other * n];
                for (value, rate) in own.iter_mut().zip(rates) {
                    *value += factor * *rate;
                }
            }
            let rates = &mut self.rates[stage * n..(stage + 1) * n];
            ode.rates_with(&mut self.workspace, node(stage), own, rates);
        }
        // The end of the step is y + h Σ b k.
        self.rates.fill(T::ZERO);
        spread(
            &mut self.rates,
            row::<M>(M::STAGES),
            step.length,
            &reverse.adjoint,
        );
        for stage in (0..M::STAGES).rev() {
            let rates_adjoint = &self.rates[stage * n..(stage + 1) * n];
            self.weights.copy_from_slice(rates_adjoint);
            self.stage_adjoint.fill(T::ZERO);
            ode.add_pullback(
                &mut reverse.pullback,
                node(stage),
                &self.states[stage * n..(stage + 1) * n],
                &self.weights,
                &mut self.stage_adjoint,
                &mut reverse.parameters,
            );
            // The state of a stage is y + h Σ a k.
            spread(
                &mut self.rates,
                row::<M>(stage),
                step.length,
                &self.stage_adjoint,
            );
            for (adjoint, more) in reverse.adjoint.iter_mut().zip(&self.stage_adjoint) {
                *adjoint += *more;
            }
        }
        reverse.check_finite(step.time, &step.start)
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
