//! Evaluates a program in `f64`, operation by operation, in the order of the emitted code: the
//! results agree bit for bit.

use super::constants::{ConstantId, ConstantOp, Setup};
use super::{FusedSum, Op, Program, ValueId};
use crate::exact::Rational;
use crate::functions::Argument;

impl Setup {
    /// Returns the values of all constants for the given parameters of the scene. A constant
    /// without parameters is rounded once from its exact value.
    pub fn evaluate(&self, parameters: &[f64]) -> Vec<f64> {
        let mut values: Vec<f64> = Vec::with_capacity(self.definitions.len());
        for definition in &self.definitions {
            let at = |id: ConstantId| values[id.0 as usize];
            let value = match (&definition.exact, &definition.op) {
                (Some(exact), _) => exact.to_f64(),
                (None, ConstantOp::Number(number)) => number.to_f64(),
                (None, &ConstantOp::Parameter(index)) => parameters[index],
                (None, &ConstantOp::Named(_, a) | &ConstantOp::Called(a)) => at(a),
                (None, ConstantOp::Product(number, powers)) => product(number, powers, at),
                (None, &ConstantOp::Add(a, b)) => at(a) + at(b),
                (None, &ConstantOp::Sub(a, b)) => at(a) - at(b),
            };
            values.push(value);
        }
        values
    }
}

/// Computes number · a · a · b / (c · d), each product from left to right.
fn product(number: &Rational, powers: &[(ConstantId, i32)], at: impl Fn(ConstantId) -> f64) -> f64 {
    let mut above = number.to_f64();
    let mut below: Option<f64> = None;
    for &(id, power) in powers {
        for _ in 0..power.unsigned_abs() {
            if power > 0 {
                above *= at(id);
            } else {
                below = Some(below.map_or_else(|| at(id), |product| product * at(id)));
            }
        }
    }
    below.map_or(above, |divisor| above / divisor)
}

/// An entry point prepared for many evaluations: constants are rounded, and needed operations and
/// fused sums are determined, only once.
#[derive(Clone, Debug)]
pub struct Interpreter {
    /// One value per definition; numbers and constants are already computed.
    values: Vec<f64>,
    steps: Vec<(ValueId, Instruction)>,
    outputs: Vec<ValueId>,
}

#[derive(Clone, Debug)]
enum Instruction {
    Op(Op),
    /// A product and a sum in one operation, with the product's factors.
    Fused([ValueId; 2], FusedSum),
}

impl Interpreter {
    /// Returns the outputs, with each product and sum rounded.
    ///
    /// `sin_cos` returns the sine and cosine that emitted code would use, `input` the elements of
    /// the arguments. Linear in the length of the entry point.
    pub fn evaluate(
        &self,
        sin_cos: impl Fn(f64) -> (f64, f64),
        input: impl Fn(Argument, usize) -> f64,
    ) -> Vec<f64> {
        self.evaluate_fused(sin_cos, |x, y, z| x * y + z, input)
    }

    /// Evaluates the outputs like [`evaluate`](Self::evaluate), but uses the caller's multiply-add
    /// x · y + z wherever the emitted code has a fused one.
    pub fn evaluate_fused(
        &self,
        sin_cos: impl Fn(f64) -> (f64, f64),
        mul_add: impl Fn(f64, f64, f64) -> f64,
        input: impl Fn(Argument, usize) -> f64,
    ) -> Vec<f64> {
        let mut values = self.values.clone();
        for (id, step) in &self.steps {
            let at = |id: ValueId| values[id.0 as usize];
            values[id.0 as usize] = match *step {
                Instruction::Fused([x, y], sum) => {
                    let signed = |value: f64, minus: bool| if minus { -value } else { value };
                    let x = signed(at(x), sum.minus_product);
                    let addend = signed(at(sum.addend), sum.minus_addend);
                    mul_add(x, at(y), addend)
                }
                Instruction::Op(Op::Input(argument, index)) => input(argument, index),
                Instruction::Op(Op::Constant(_) | Op::Number(_)) => at(*id),
                Instruction::Op(Op::Sin(a)) => sin_cos(at(a)).0,
                Instruction::Op(Op::Cos(a)) => sin_cos(at(a)).1,
                Instruction::Op(Op::Sqrt(a)) => at(a).sqrt(),
                Instruction::Op(Op::Neg(a)) => -at(a),
                Instruction::Op(Op::Add(a, b)) => at(a) + at(b),
                Instruction::Op(Op::Sub(a, b)) => at(a) - at(b),
                Instruction::Op(Op::Mul(a, b)) => at(a) * at(b),
                Instruction::Op(Op::Div(a, b)) => at(a) / at(b),
            };
        }
        let outputs = self.outputs.iter().map(|id| values[id.0 as usize]);
        outputs.collect()
    }
}

impl Program {
    /// Returns the interpreter of an entry point for the given parameters, in the scene's order, or
    /// `None` if there is no such entry point.
    pub fn interpreter(&self, entry: &str, parameters: &[f64]) -> Option<Interpreter> {
        let entry = self.entry(entry)?;
        let fused = self.fused(entry);
        let constants = self.setup.evaluate(parameters);
        let mut values: Vec<f64> = vec![0.0; self.definitions.len()];
        let mut steps = Vec::new();
        for id in self.needed(&entry.outputs) {
            let op = &self.definition(id).op;
            let sum = fused.get(&id);
            let factors = sum.map(|sum| (&self.definition(sum.product).op, *sum));
            match (op, factors) {
                (_, Some((&Op::Mul(x, y), sum))) => {
                    steps.push((id, Instruction::Fused([x, y], sum)))
                }
                (Op::Constant(constant), _) => {
                    values[id.0 as usize] = constants[constant.0 as usize];
                }
                (Op::Number(number), _) => values[id.0 as usize] = number.to_f64(),
                _ => steps.push((id, Instruction::Op(op.clone()))),
            }
        }
        let outputs = entry.outputs.clone();
        Some(Interpreter {
            values,
            steps,
            outputs,
        })
    }

    /// Evaluates the outputs of an entry point once, by [`interpreter`](Self::interpreter) and
    /// [`Interpreter::evaluate`].
    pub fn evaluate(
        &self,
        sin_cos: impl Fn(f64) -> (f64, f64),
        entry: &str,
        parameters: &[f64],
        input: impl Fn(Argument, usize) -> f64,
    ) -> Option<Vec<f64>> {
        let interpreter = self.interpreter(entry, parameters)?;
        Some(interpreter.evaluate(sin_cos, input))
    }
}
