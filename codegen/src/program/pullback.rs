//! Pullbacks: derivatives of a weighted sum of outputs by all inputs and parameters, in one pass
//! from the outputs back to the inputs (reverse mode; Griewank and Walther, Evaluating Derivatives,
//! 2008, chapter 3).
//!
//! The adjoint of a value v is the derivative of the weighted sum by v. Each operation adds its
//! share to the adjoints of its operands: for c = a b these shares are c̅ b to a̅ and c̅ a to b̅. The
//! values that the function has computed anyway are used again, so that the derivatives by all
//! inputs cost about as much as the function.

use super::builder::Builder;
use super::entry_list::EntryList;
use super::{ConstantId, Entry, Op, ValueId};
use crate::functions::{Argument, Differentiated, Purpose};
use crate::scene::{GradientRequest, Scene};
use std::collections::{BTreeMap, BTreeSet};

impl EntryList<'_, '_> {
    /// Adds the pullbacks and gradients of the entry points that the scene asks to differentiate.
    pub(super) fn pullbacks(&mut self, scene: &Scene) {
        let Some(request) = &scene.requests.gradient else {
            return;
        };
        for entry in self.entries.clone() {
            if let Some(purpose) = requested(scene, request, entry.purpose) {
                let outputs = self.pullback(scene, &entry, purpose);
                self.push(purpose, outputs);
            }
        }
    }

    /// Returns the derivatives of an entry point: by its arguments except the time, then by the
    /// parameters.
    fn pullback(&mut self, scene: &Scene, entry: &Entry, purpose: Purpose) -> Vec<ValueId> {
        let builder = &mut self.lowering.builder;
        // Of the two parts of a transfer the sum is differentiated.
        let is_plain_sum = matches!(purpose, Purpose::Gradient(_));
        let weights = (0..entry.outputs.len()).map(|index| match is_plain_sum {
            true => builder.integer(1),
            false => builder.input(Argument::Weights, index),
        });
        let weights: Vec<ValueId> = weights.collect();
        let adjoints = Adjoints::of(builder, &entry.outputs, &weights);
        let arguments = entry.arguments.iter();
        let mut outputs = Vec::new();
        for &argument in arguments.filter(|argument| **argument != Argument::Time) {
            for index in 0..scene.links.len() {
                outputs.push(adjoints.of_op(builder, &Op::Input(argument, index)));
            }
        }
        for parameter in 0..scene.parameters.len() {
            outputs.push(adjoints.of_parameter(builder, parameter));
        }
        outputs
    }
}

/// Returns the purpose of the requested derivatives of a function; `None` if they are not requested.
fn requested(scene: &Scene, request: &GradientRequest, of: Purpose) -> Option<Purpose> {
    let pullbacks = [
        (Purpose::Accelerations, Purpose::AccelerationsPullback),
        (
            Purpose::AccelerationsUnder,
            Purpose::AccelerationsUnderPullback,
        ),
    ];
    if let Some((_, pullback)) = pullbacks.into_iter().find(|(function, _)| *function == of) {
        return request.accelerations.then_some(pullback);
    }
    let of = Differentiated::of(of)?;
    let wanted = match of {
        Differentiated::KineticEnergy | Differentiated::PotentialEnergy => request.energies,
        Differentiated::SubHamiltonian(_)
        | Differentiated::TruncatedTransfer(..)
        | Differentiated::ExactTransfer(..) => request.transfer,
        Differentiated::Observable(number, _) => {
            let name = &scene.observables[number].name;
            request.observables.contains(name)
        }
    };
    wanted.then_some(Purpose::Gradient(of))
}

/// Adjoints of the values of a program.
pub(super) struct Adjoints {
    values: BTreeMap<ValueId, ValueId>,
}

impl Adjoints {
    /// Computes the adjoints of all values on which the weighted sum of the outputs depends.
    pub(super) fn of(builder: &mut Builder, outputs: &[ValueId], weights: &[ValueId]) -> Self {
        let needed = builder.needed(outputs);
        let varying = varying(builder, &needed);
        // Names are for new values alone: the function itself keeps its own.
        let first_new = ValueId(builder.definitions.len() as u32);
        // A divisor of several quotients is inverted once.
        let mut divisors = BTreeMap::new();
        for &value in &needed {
            if let Op::Div(_, divisor) = *builder.op(value) {
                *divisors.entry(divisor).or_insert(0) += 1;
            }
        }
        let mut adjoints = Self {
            values: BTreeMap::new(),
        };
        for (&output, &weight) in outputs.iter().zip(weights) {
            adjoints.add(builder, output, weight);
        }
        for &value in needed.iter().rev() {
            let Some(&adjoint) = adjoints.values.get(&value) else {
                continue;
            };
            if adjoint >= first_new {
                builder.hint_adjoint(adjoint, value);
            }
            for (operand, share) in shares(builder, value, adjoint, (&varying, &divisors)) {
                adjoints.add(builder, operand, share);
            }
        }
        adjoints
    }

    fn add(&mut self, builder: &mut Builder, value: ValueId, share: ValueId) {
        let sum = match self.values.get(&value) {
            Some(&known) => builder.add(known, share),
            None => share,
        };
        self.values.insert(value, sum);
    }

    /// Returns the adjoint of an input or a constant, which is zero if nothing depends on it.
    fn of_op(&self, builder: &mut Builder, op: &Op) -> ValueId {
        let value = builder.record(op.clone());
        match self.values.get(&value) {
            Some(&adjoint) => adjoint,
            None => builder.integer(0),
        }
    }

    /// Returns the derivative by a parameter: the sum of c̅ ∂c/∂p over all constants c. The
    /// derivatives of constants are constants of the model themselves.
    pub(super) fn of_parameter(&self, builder: &mut Builder, parameter: usize) -> ValueId {
        let values = self.values.iter();
        let constants = values.filter_map(|(&value, &adjoint)| match *builder.op(value) {
            Op::Constant(constant) => Some((constant, adjoint)),
            _ => None,
        });
        let constants: Vec<(ConstantId, ValueId)> = constants.collect();
        let of = constants.iter().map(|&(constant, _)| constant);
        let slopes = builder.setup.derivatives(of, parameter);
        let mut sum = builder.integer(0);
        for (constant, adjoint) in constants {
            let slope = builder.constant(slopes[&constant]);
            let share = builder.mul(adjoint, slope);
            sum = builder.add(sum, share);
        }
        sum
    }
}

/// Returns the values that depend on a parameter or on an argument other than the time: the others
/// need no adjoints.
fn varying(builder: &Builder, needed: &[ValueId]) -> BTreeSet<ValueId> {
    let mut varying = BTreeSet::new();
    for &value in needed {
        let depends = match builder.op(value) {
            Op::Input(argument, _) => *argument != Argument::Time,
            Op::Number(_) => false,
            Op::Constant(constant) => builder.setup.get(*constant).exact.is_none(),
            op => op.operands().any(|operand| varying.contains(&operand)),
        };
        if depends {
            varying.insert(value);
        }
    }
    varying
}

/// Returns the shares that an operation with this adjoint adds to the adjoints of its operands.
fn shares(
    builder: &mut Builder,
    value: ValueId,
    adjoint: ValueId,
    (varying, divisors): (&BTreeSet<ValueId>, &BTreeMap<ValueId, usize>),
) -> Vec<(ValueId, ValueId)> {
    let varies = |operand: ValueId| varying.contains(&operand);
    let mut shares = Vec::new();
    match *builder.op(value) {
        Op::Input(..) | Op::Constant(_) | Op::Number(_) => {}
        Op::Sin(a) => {
            if let (true, Some(slope)) = (varies(a), builder.partner(value)) {
                shares.push((a, builder.mul(adjoint, slope)));
            }
        }
        Op::Cos(a) => {
            if let (true, Some(slope)) = (varies(a), builder.partner(value)) {
                let share = builder.mul(adjoint, slope);
                shares.push((a, builder.neg(share)));
            }
        }
        Op::Sqrt(a) => {
            if varies(a) {
                let twice = builder.add(value, value);
                shares.push((a, builder.div(adjoint, twice)));
            }
        }
        Op::Neg(a) => {
            if varies(a) {
                shares.push((a, builder.neg(adjoint)));
            }
        }
        Op::Add(a, b) => shares.extend([(a, adjoint), (b, adjoint)]),
        Op::Sub(a, b) => {
            shares.push((a, adjoint));
            if varies(b) {
                shares.push((b, builder.neg(adjoint)));
            }
        }
        Op::Mul(a, b) => {
            for (operand, factor) in [(a, b), (b, a)] {
                if varies(operand) {
                    shares.push((operand, builder.mul(adjoint, factor)));
                }
            }
        }
        Op::Div(a, b) => {
            let quotient = match divisors.get(&b) {
                Some(&count) if count > 1 || builder.is(a, 1) => {
                    let one = builder.integer(1);
                    let reciprocal = builder.div(one, b);
                    builder.mul(adjoint, reciprocal)
                }
                _ => builder.div(adjoint, b),
            };
            shares.push((a, quotient));
            // The share of the divisor is −(c̅ / b) c.
            if varies(b) {
                let share = builder.mul(quotient, value);
                shares.push((b, builder.neg(share)));
            }
        }
    }
    shares.retain(|(operand, _)| varying.contains(operand));
    shares
}
