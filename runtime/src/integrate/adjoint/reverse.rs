//! The way back of a gradient: the adjoint of one step of an explicit Runge–Kutta pair.

use alloc::vec;
use alloc::vec::Vec;

use crate::integrate::explicit::EmbeddedPair;
use crate::integrate::{InputError, IntegrationError, Report};
use crate::scalar::Real;
use crate::system::{PullbackOde, PullbackWorkspace, State, Workspace};

/// A step of the motion.
pub(super) struct StepTaken<T> {
    pub(super) time: T,
    pub(super) length: T,
    pub(super) start: Vec<T>,
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

/// Adjoint of the state at the end of the steps that have not been passed yet, and memory for one
/// step.
pub(super) struct Reverse<T> {
    pub(super) adjoint: Vec<T>,
    /// Largest size of a component of the adjoint so far.
    pub(super) largest: T,
    pub(super) parameters: Vec<T>,
    /// States of the stages, one after the other.
    states: Vec<T>,
    /// Rates of the stages; on the way back their adjoints.
    rates: Vec<T>,
    weights: Vec<T>,
    stage_adjoint: Vec<T>,
    workspace: Workspace<T>,
    pullback: PullbackWorkspace<T>,
}

impl<T: Real> Reverse<T> {
    pub(super) fn new<M: EmbeddedPair>(dimension: usize, parameters: usize) -> Self {
        let zeros = |vectors: usize| vec![T::ZERO; vectors * dimension];
        Self {
            adjoint: zeros(1),
            largest: T::ZERO,
            parameters: vec![T::ZERO; parameters],
            states: zeros(M::STAGES),
            rates: zeros(M::STAGES),
            weights: zeros(1),
            stage_adjoint: zeros(1),
            workspace: Workspace::new(),
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

    /// Takes the adjoint back through the steps that are `left`, until only the first `before` of
    /// them are.
    pub(super) fn back_to<M: EmbeddedPair, O: PullbackOde<T> + ?Sized>(
        &mut self,
        ode: &O,
        left: &mut &[StepTaken<T>],
        before: usize,
    ) -> Result<(), IntegrationError<T>> {
        while left.len() > before {
            let Some((last, others)) = left.split_last() else {
                break;
            };
            *left = others;
            self.step::<M, O>(ode, last)?;
        }
        Ok(())
    }

    /// Takes the adjoint from the end of a step to its start.
    pub(super) fn step<M: EmbeddedPair, O: PullbackOde<T> + ?Sized>(
        &mut self,
        ode: &O,
        step: &StepTaken<T>,
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
            &self.adjoint,
        );
        for stage in (0..M::STAGES).rev() {
            let rates_adjoint = &self.rates[stage * n..(stage + 1) * n];
            self.weights.copy_from_slice(rates_adjoint);
            self.stage_adjoint.fill(T::ZERO);
            ode.add_pullback(
                &mut self.pullback,
                node(stage),
                &self.states[stage * n..(stage + 1) * n],
                &self.weights,
                &mut self.stage_adjoint,
                &mut self.parameters,
            );
            // The state of a stage is y + h Σ a k.
            spread(
                &mut self.rates,
                row::<M>(stage),
                step.length,
                &self.stage_adjoint,
            );
            for (adjoint, more) in self.adjoint.iter_mut().zip(&self.stage_adjoint) {
                *adjoint += *more;
            }
        }
        self.largest = self.largest.max(largest(&self.adjoint));
        match self.adjoint.iter().all(|adjoint| adjoint.is_finite()) {
            true => Ok(()),
            false => Err(non_finite(&State::new(step.time, step.start.clone()))),
        }
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
