//! Number of live values: values that are computed and still needed, which must be kept in
//! registers.

use super::{Definition, Entry, Op, Program, ValueId};

impl Program {
    /// Returns the largest number of live values in the code of an entry point, except inputs and
    /// constants. Linear in the length of the program.
    pub fn live(&self, entry: &Entry) -> usize {
        live(
            &self.definitions,
            &self.needed(&entry.outputs),
            &entry.outputs,
        )
    }
}

/// Returns true for inputs, numbers and constants, which need no register until they are used.
fn is_leaf(op: &Op) -> bool {
    matches!(op, Op::Input(..) | Op::Constant(_) | Op::Number(_))
}

/// Returns the largest number of live values, except inputs and constants, if they are computed in
/// the given order.
fn live(definitions: &[Definition], order: &[ValueId], outputs: &[ValueId]) -> usize {
    let mut last = vec![0; definitions.len()];
    for (place, id) in order.iter().enumerate() {
        for operand in definitions[id.0 as usize].op.operands() {
            last[operand.0 as usize] = place;
        }
    }
    for output in outputs {
        last[output.0 as usize] = order.len();
    }
    let (mut live, mut most) = (0_usize, 0);
    for (place, id) in order.iter().enumerate() {
        let definition = &definitions[id.0 as usize];
        let mut operands: Vec<ValueId> = definition.op.operands().collect();
        operands.dedup();
        for operand in operands {
            let formed = !is_leaf(&definitions[operand.0 as usize].op);
            if formed && last[operand.0 as usize] == place {
                live -= 1;
            }
        }
        if !is_leaf(&definition.op) {
            live += 1;
        }
        most = most.max(live);
    }
    most
}

#[cfg(test)]
mod tests {
    use crate::functions::{Argument, Purpose};
    use crate::program::builder::Builder;

    /// Checks that four products before three sums are all counted as live, but only two if each
    /// sum follows its products.
    #[test]
    fn what_waits_is_counted() {
        let [all_first, at_once] = [true, false].map(|all_first| {
            let mut builder = Builder::default();
            let inputs: [_; 5] = std::array::from_fn(|i| builder.input(Argument::Theta, i));
            let pairs: Vec<_> = inputs.windows(2).map(|pair| (pair[0], pair[1])).collect();
            let mut sum = builder.mul(pairs[0].0, pairs[0].1);
            let rest = &pairs[1..];
            if all_first {
                for &(a, b) in rest {
                    builder.mul(a, b);
                }
            }
            for &(a, b) in rest {
                let product = builder.mul(a, b);
                sum = builder.add(sum, product);
            }
            let program = builder.program(Purpose::KineticEnergy, vec![sum]);
            program.live(&program.entries[0])
        });
        assert_eq!((all_first, at_once), (4, 2));
    }
}
