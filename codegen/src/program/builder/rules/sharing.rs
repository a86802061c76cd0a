//! Equal operations on equal operands become one value (hash-consing). The table is only looked up,
//! never iterated, so that no order depends on hashes.
//!
//! Exact: a value has the same bits wherever it is computed, and sums and products do not depend on
//! the order of their two operands.

use crate::program::{Op, ValueId};
use std::collections::HashMap;

/// The operations computed so far; operands of sums and products are sorted.
#[derive(Clone, Default)]
pub(in crate::program) struct KnownOperations(HashMap<Op, ValueId>);

impl KnownOperations {
    /// Returns the value of this operation, or of the same sum or product with exchanged operands,
    /// if it exists.
    pub(in crate::program) fn find(&self, op: &Op) -> Option<ValueId> {
        let found = match ordered(op) {
            Some(ordered) => self.0.get(&ordered),
            None => self.0.get(op),
        };
        found.copied()
    }

    /// Finds the operation like [`find`](Self::find), but only inputs, constants, sines and
    /// cosines, which are shared even if the pass is left out.
    pub(in crate::program) fn find_leaf(&self, op: &Op) -> Option<ValueId> {
        let leaf = !op.operands().any(|_| true) || matches!(op, Op::Sin(_) | Op::Cos(_));
        if leaf { self.find(op) } else { None }
    }

    pub(in crate::program) fn insert(&mut self, op: Op, id: ValueId) {
        self.0.insert(ordered(&op).unwrap_or(op), id);
    }
}

/// Returns a sum or product with exchanged operands, if they are not sorted.
fn ordered(op: &Op) -> Option<Op> {
    match *op {
        Op::Add(a, b) if a > b => Some(Op::Add(b, a)),
        Op::Mul(a, b) if a > b => Some(Op::Mul(b, a)),
        _ => None,
    }
}
