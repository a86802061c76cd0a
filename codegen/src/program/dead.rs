//! Dead code: an entry point holds nothing that it does not need.
//!
//! Exact: the operations that are left out have no effect. Linear in the
//! program's length.

use super::{Definition, Op, Program, ValueId};

impl Program {
    /// The values that `outputs` depend on, themselves included, in order:
    /// the program pruned to them. Linear in the program's length.
    pub fn needed(&self, outputs: &[ValueId]) -> Vec<ValueId> {
        needed(&self.definitions, outputs)
    }

    /// The program without the operations that no entry point needs. Sines and cosines stay,
    /// since each comes with its partner.
    pub(super) fn without_dead_code(mut self) -> Self {
        let outputs = self.entries.iter().flat_map(|entry| &entry.outputs);
        let mut kept: Vec<ValueId> = outputs.copied().collect();
        let turned = self.definitions.iter().zip(0..);
        let turned =
            turned.filter(|(definition, _)| matches!(definition.op, Op::Sin(_) | Op::Cos(_)));
        kept.extend(turned.map(|(_, index)| ValueId(index)));
        let kept = self.needed(&kept);
        let mut places = vec![ValueId(0); self.definitions.len()];
        for (&id, place) in kept.iter().zip(0..) {
            places[id.0 as usize] = ValueId(place);
        }
        let place = |id: ValueId| places[id.0 as usize];
        self.definitions = kept
            .iter()
            .map(|id| {
                let Definition { op, name, hint } = self.definition(*id).clone();
                let op = op.with_operands(place);
                Definition { op, name, hint }
            })
            .collect();
        for output in self.entries.iter_mut().flat_map(|entry| &mut entry.outputs) {
            *output = place(*output);
        }
        self
    }
}

/// See [`Program::needed`].
pub(super) fn needed(definitions: &[Definition], outputs: &[ValueId]) -> Vec<ValueId> {
    let mut wanted = vec![false; definitions.len()];
    for output in outputs {
        wanted[output.0 as usize] = true;
    }
    for index in (0..wanted.len()).rev() {
        if wanted[index] {
            for operand in definitions[index].op.operands() {
                wanted[operand.0 as usize] = true;
            }
        }
    }
    (0..wanted.len() as u32)
        .map(ValueId)
        .filter(|id| wanted[id.0 as usize])
        .collect()
}

#[cfg(test)]
mod tests {
    use crate::functions::{Argument, Purpose};
    use crate::program::Op;
    use crate::program::builder::Builder;

    #[test]
    fn what_nothing_uses_is_left_out() {
        let mut builder = Builder::default();
        let [x, y] = [0, 1].map(|index| builder.input(Argument::Theta, index));
        let unused = builder.mul(x, y);
        builder.sin(unused);
        builder.sub(x, y);
        let sum = builder.add(x, y);
        let program = builder.program(Purpose::KineticEnergy, vec![sum]);
        assert_eq!(program.needed(&[sum]), [x, y, sum]);
        let pruned = program.without_dead_code();
        assert_eq!(pruned.verify(), Ok(()));
        let ops = pruned.definitions.iter().map(|definition| &definition.op);
        assert!(ops.clone().all(|op| !matches!(op, Op::Sub(..))));
        assert_eq!(ops.filter(|op| matches!(op, Op::Sin(_))).count(), 1);
        assert_eq!(
            *pruned
                .definition(pruned.entries[0].outputs[0])
                .op
                .operands()
                .collect::<Vec<_>>(),
            [x, y]
        );
    }
}
