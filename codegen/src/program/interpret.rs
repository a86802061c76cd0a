//! Evaluates a program in f64, operation by operation, in the order in which
//! emitted code does: the two agree bit for bit.

use super::constants::{ConstantId, ConstantOp, Setup};
use super::{Argument, Op, Program, ValueId};
use crate::exact::Rational;

impl Setup {
    /// Values of all constants for given values of the scene's parameters.
    /// A constant without parameters is rounded once from its exact value.
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

/// number · a · a · b / (c · d), each product from the left.
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

impl Program {
    /// The outputs of an entry point.
    ///
    /// `parameters` are the scene's parameters in order, `input` supplies the
    /// elements of the arguments, and `sin_cos` is the sine and cosine that
    /// emitted code would use. Linear in the length of the program.
    pub fn evaluate(
        &self,
        sin_cos: impl Fn(f64) -> (f64, f64),
        entry: &str,
        parameters: &[f64],
        input: impl Fn(Argument, usize) -> f64,
    ) -> Option<Vec<f64>> {
        let unfused = |x: f64, y: f64, z: f64| x * y + z;
        self.evaluate_fused(sin_cos, unfused, entry, parameters, input)
    }

    /// As [`evaluate`](Self::evaluate), with a fused multiply-add `x * y + z`
    /// of the caller's wherever emitted code has one.
    pub fn evaluate_fused(
        &self,
        sin_cos: impl Fn(f64) -> (f64, f64),
        mul_add: impl Fn(f64, f64, f64) -> f64,
        entry: &str,
        parameters: &[f64],
        input: impl Fn(Argument, usize) -> f64,
    ) -> Option<Vec<f64>> {
        let entry = self.entry(entry)?;
        let fused = self.fused(entry);
        let constants = self.setup.evaluate(parameters);
        let mut values: Vec<f64> = vec![0.0; self.definitions.len()];
        for id in self.needed(&entry.outputs) {
            let at = |id: ValueId| values[id.0 as usize];
            if let Some(sum) = fused.get(&id)
                && let Op::Mul(x, y) = self.definition(sum.product).op
            {
                let signed = |value: f64, minus: bool| if minus { -value } else { value };
                let x = signed(at(x), sum.minus_product);
                let addend = signed(at(sum.addend), sum.minus_addend);
                values[id.0 as usize] = mul_add(x, at(y), addend);
                continue;
            }
            let value = match self.definition(id).op {
                Op::Input(argument, index) => input(argument, index),
                Op::Constant(constant) => constants[constant.0 as usize],
                Op::Number(ref number) => number.to_f64(),
                Op::Sin(a) => sin_cos(at(a)).0,
                Op::Cos(a) => sin_cos(at(a)).1,
                Op::Sqrt(a) => at(a).sqrt(),
                Op::Neg(a) => -at(a),
                Op::Add(a, b) => at(a) + at(b),
                Op::Sub(a, b) => at(a) - at(b),
                Op::Mul(a, b) => at(a) * at(b),
                Op::Div(a, b) => at(a) / at(b),
            };
            values[id.0 as usize] = value;
        }
        Some(
            entry
                .outputs
                .iter()
                .map(|id| values[id.0 as usize])
                .collect(),
        )
    }
}
