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
