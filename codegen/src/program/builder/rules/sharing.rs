//! Equal operations on equal operands are one value (hash-consing). Values are looked up alone,
//! never walked, so that no order depends on hashes.
//!
//! Exact: a value has the same bits wherever it is formed, and sums and products do not
//! depend on the order of their two operands.

use crate::program::{Op, ValueId};
use std::collections::HashMap;

/// The operations that are formed already, operands in order where that makes no difference.
#[derive(Clone, Default)]
pub(in crate::program) struct KnownOperations(HashMap<Op, ValueId>);

impl KnownOperations {
    /// The value that is formed by this operation, or by the same with its operands
    /// exchanged where that makes no difference.
    pub(in crate::program) fn find(&self, op: &Op) -> Option<ValueId> {
        let found = match ordered(op) {
            Some(ordered) => self.0.get(&ordered),
            None => self.0.get(op),
        };
        found.copied()
    }

    /// As [`find`](Self::find), for operations that are one value in programs
    /// without sharing too: inputs, constants, sines and cosines.
    pub(in crate::program) fn find_leaf(&self, op: &Op) -> Option<ValueId> {
        let leaf = !op.operands().any(|_| true) || matches!(op, Op::Sin(_) | Op::Cos(_));
        if leaf { self.find(op) } else { None }
    }

    pub(in crate::program) fn insert(&mut self, op: Op, id: ValueId) {
        self.0.insert(ordered(&op).unwrap_or(op), id);
    }
}

/// A sum or product with its operands exchanged, if they are not in order.
fn ordered(op: &Op) -> Option<Op> {
    match *op {
        Op::Add(a, b) if a > b => Some(Op::Add(b, a)),
        Op::Mul(a, b) if a > b => Some(Op::Mul(b, a)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use crate::functions::Argument;
    use crate::program::builder::Builder;

    #[test]
    fn equal_operations_are_one_value() {
        let mut builder = Builder::default();
        let [x, y] = [0, 1].map(|index| builder.input(Argument::Theta, index));
        assert_eq!(builder.add(x, y), builder.add(y, x));
        assert_eq!(builder.mul(x, y), builder.mul(y, x));
        assert_eq!(builder.sub(x, y), builder.sub(x, y));
        assert_ne!(builder.sub(x, y), builder.sub(y, x));
        assert_ne!(builder.div(x, y), builder.div(y, x));
    }
}
