//! Removes operations with 0 and 1, and operations of a value with itself.
//!
//! x + 0, x · 1 and x / 1 become x; x · 0, 0 / x and x − x become 0; x + x becomes 2 x. All are
//! exact for finite x. This rule removes the terms that are zero by a scene's symmetry, so that
//! they are exactly zero.

use crate::program::builder::Builder;
use crate::program::{Op, ValueId};

pub(super) fn neutral(builder: &mut Builder, op: &Op) -> Option<ValueId> {
    match *op {
        Op::Add(a, b) if builder.is(a, 0) => Some(b),
        Op::Add(a, b) | Op::Sub(a, b) if builder.is(b, 0) => Some(a),
        Op::Sub(a, b) if builder.is(a, 0) => Some(builder.neg(b)),
        Op::Sub(a, b) if a == b => Some(builder.integer(0)),
        Op::Add(a, b) if a == b => {
            let two = builder.integer(2);
            Some(builder.mul(two, a))
        }
        Op::Mul(a, b) | Op::Div(a, b) if builder.is(a, 0) || builder.is(b, 1) => Some(a),
        Op::Mul(a, b) if builder.is(b, 0) || builder.is(a, 1) => Some(b),
        _ => None,
    }
}
