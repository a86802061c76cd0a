//! The adjoint of one step of a Gauss–Legendre method.
//!
//! With the rates k_i at the states Y_i = y + h Σ_j a_ij k_j of the stages, the adjoints κ_i of the
//! rates solve κ_i = h (b_i w + Σ_j a_ji J_jᵀ κ_j), where w is the adjoint of the end of the step and
//! J_j the Jacobian matrix at Y_j. The adjoint of the start is w + Σ_j J_jᵀ κ_j.

use alloc::vec;
use alloc::vec::Vec;

use super::AdjointMethod;
use super::reverse::{Reverse, StepAdjoint, largest};
use crate::integrate::fixed::Gauss;
use crate::integrate::piece::{GaussOrder, GaussTable};
use crate::integrate::right_hand_side::StepSpan;
use crate::integrate::{DenseStep, IntegrationError, Report};
use crate::scalar::Real;
use crate::system::{PullbackOde, State};

/// Memory for the adjoint of one step.
pub struct GaussAdjoint<T> {
    order: GaussOrder,
    iteration_limit: u32,
    /// Adjoints κ of the rates of the stages, and their next values.
    rates: [Vec<T>; 2],
    /// Adjoints Jᵀ κ of the states of the stages.
    states: Vec<T>,
    /// Derivatives by the parameters, which count only at the last iteration.
    parameters: Vec<T>,
}

impl<T: Real> AdjointMethod<T> for Gauss<T> {
    type Step = GaussAdjoint<T>;

    fn step_adjoint(&self, dimension: usize) -> GaussAdjoint<T> {
        let zeros = vec![T::ZERO; self.order.table().nodes.len() * dimension];
        GaussAdjoint {
            order: self.order,
            iteration_limit: self.iteration_limit,
            rates: [zeros.clone(), zeros.clone()],
            states: zeros,
            parameters: Vec::new(),
        }
    }
}

impl<T: Real> GaussAdjoint<T> {
    /// Writes the adjoints of the rates for those of the states.
    fn rates(&mut self, table: &GaussTable, length: T, end: &[T]) {
        let (n, stages) = (end.len(), table.nodes.len());
        let [_, next] = &mut self.rates;
        for (i, &(large, small)) in table.weights.iter().enumerate() {
            let weight = T::from_f64(large) + T::from_f64(small);
            for (k, &end) in end.iter().enumerate() {
                let mut sum = weight * end;
                for j in 0..stages {
                    let (large, small) = table.matrix[j * stages + i];
                    let weight = T::from_f64(large) + T::from_f64(small);
                    sum += weight * self.states[j * n + k];
                }
                next[i * n + k] = length * sum;
            }
        }
    }

    /// Writes the adjoints of the states for those of the rates, and adds the derivatives by the
    /// parameters.
    fn states<O: PullbackOde<T> + ?Sized>(
        &mut self,
        reverse: &mut Reverse<T>,
        ode: &O,
        span: StepSpan<T>,
        states: &[T],
    ) {
        let n = reverse.adjoint.len();
        self.states.fill(T::ZERO);
        let nodes = self.order.table().nodes.iter();
        for (stage, &node) in nodes.enumerate() {
            let own = stage * n..(stage + 1) * n;
            let [rates, _] = &self.rates;
            ode.add_pullback(
                &mut reverse.pullback,
                span.node(node),
                &states[own.clone()],
                &rates[own.clone()],
                &mut self.states[own],
                &mut self.parameters,
            );
        }
    }
}

impl<T: Real> StepAdjoint<T> for GaussAdjoint<T> {
    // The equations of a step would have to be solved again.
    const REPEATS: bool = false;

    fn keep(&self, step: &DenseStep<'_, T>) -> Vec<T> {
        let piece = step.piece();
        let (n, nodes) = (piece.start.len(), self.order.table().nodes);
        let mut states = vec![T::ZERO; (1 + nodes.len()) * n];
        let (start, stages) = states.split_at_mut(n);
        start.copy_from_slice(piece.start);
        for (&node, state) in nodes.iter().zip(stages.chunks_exact_mut(n.max(1))) {
            // The polynomial of the step runs through the states of the stages.
            piece.value(T::from_f64(node), state);
        }
        states
    }

    fn end<O: PullbackOde<T> + ?Sized>(&mut self, _: &O, _: StepSpan<T>, state: &mut [T]) {
        state.fill(T::NAN);
    }

    fn back<O: PullbackOde<T> + ?Sized>(
        &mut self,
        reverse: &mut Reverse<T>,
        ode: &O,
        span: StepSpan<T>,
        states: &[T],
    ) -> Result<(), IntegrationError<T>> {
        let (start, stages) = states.split_at(reverse.adjoint.len());
        let (table, end) = (self.order.table(), reverse.adjoint.clone());
        self.states.fill(T::ZERO);
        let mut before = T::from_f64(f64::INFINITY);
        for iteration in 1.. {
            self.rates(table, span.step, &end);
            let [rates, next] = &mut self.rates;
            let changes = rates
                .iter()
                .zip(&*next)
                .map(|(old, new)| (*new - *old).abs());
            let size = largest(&*next);
            let change = match size > T::ZERO {
                true => changes.fold(T::ZERO, T::max) / size,
                false => T::ZERO,
            };
            rates.copy_from_slice(next);
            self.parameters.clear();
            self.parameters.resize(reverse.parameters.len(), T::ZERO);
            self.states(reverse, ode, span, stages);
            // Rounding stops the progress at the end.
            let few = T::from_f64(64.0) * T::EPSILON;
            if iteration > 1 && (change <= T::EPSILON || change < few && change >= before) {
                break;
            }
            if iteration > self.iteration_limit || !size.is_finite() {
                return Err(IntegrationError::NotSolved {
                    step: span.step,
                    iterations: iteration,
                    change,
                    last: State::new(span.time, start.to_vec()),
                    report: Report::new(),
                });
            }
            before = change;
        }
        for (sum, more) in reverse.parameters.iter_mut().zip(&self.parameters) {
            *sum += *more;
        }
        for stage in self.states.chunks_exact(end.len().max(1)) {
            for (adjoint, more) in reverse.adjoint.iter_mut().zip(stage) {
                *adjoint += *more;
            }
        }
        reverse.check_finite(span.time, start)
    }
}
