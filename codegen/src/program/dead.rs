//! Removal of dead code: an entry point contains only the operations that it needs.
//!
//! Exact: the removed operations have no effect. Linear in the number of needed values, plus one
//! bit per value of the program.

use super::{Definition, Op, Program, ValueId};

impl Program {
    /// Returns the values that `outputs` depend on, including these, in the order of the program.
    /// Linear in their number, plus one bit per value of the program.
    pub fn needed(&self, outputs: &[ValueId]) -> Vec<ValueId> {
        needed(&self.definitions, outputs)
    }

    /// Removes the operations that no entry point needs. A sine or cosine is kept if its partner is
    /// needed.
    #[doc(hidden)]
    pub fn without_dead_code(mut self) -> Self {
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

/// Finds the values as [`Program::needed`] does.
pub(super) fn needed(definitions: &[Definition], outputs: &[ValueId]) -> Vec<ValueId> {
    // One bit per value, so that a short function of a long program costs little.
    let mut wanted = vec![0_u64; definitions.len().div_ceil(64)];
    let mut open: Vec<ValueId> = Vec::new();
    let mut want = |id: ValueId, open: &mut Vec<ValueId>| {
        let (word, bit) = (&mut wanted[id.0 as usize / 64], 1 << (id.0 % 64));
        if *word & bit == 0 {
            *word |= bit;
            open.push(id);
        }
    };
    for &output in outputs {
        want(output, &mut open);
    }
    let mut count = 0;
    while let Some(id) = open.pop() {
        count += 1;
        for operand in definitions[id.0 as usize].op.operands() {
            want(operand, &mut open);
        }
    }
    let mut needed = Vec::with_capacity(count);
    for (mut word, first) in wanted.into_iter().zip((0..).step_by(64)) {
        while word != 0 {
            needed.push(ValueId(first + word.trailing_zeros()));
            word &= word - 1;
        }
    }
    needed
}
