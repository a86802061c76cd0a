//! Signs move outwards, and into sums and differences, where they cost nothing.
//!
//! a + (−b) becomes a − b, (−a) b becomes −(a b), −(a − b) becomes b − a. A change of sign is exact
//! and rounding is symmetric, so that every value keeps its bits, except for the sign of a zero.

use crate::program::builder::Builder;
use crate::program::{Op, ValueId};

/// Returns the operand of a change of sign; `None` for other values.
fn opposite(builder: &Builder, id: ValueId) -> Option<ValueId> {
    match *builder.op(id) {
        Op::Neg(inner) => Some(inner),
        _ => None,
    }
}

pub(super) fn signs(builder: &mut Builder, op: &Op) -> Option<ValueId> {
    match *op {
        Op::Neg(a) => match *builder.op(a) {
            Op::Neg(inner) => Some(inner),
            Op::Sub(x, y) => Some(builder.sub(y, x)),
            _ => None,
        },
        Op::Add(a, b) => {
            if let Some(inner) = opposite(builder, b) {
                return Some(builder.sub(a, inner));
            }
            let inner = opposite(builder, a)?;
            Some(builder.sub(b, inner))
        }
        Op::Sub(a, b) => {
            if let Some(inner) = opposite(builder, b) {
                return Some(builder.add(a, inner));
            }
            let inner = opposite(builder, a)?;
            let sum = builder.add(inner, b);
            Some(builder.neg(sum))
        }
        Op::Mul(a, b) => {
            for (x, y) in [(a, b), (b, a)] {
                if builder.is(x, -1) {
                    return Some(builder.neg(y));
                }
                if let Some(inner) = opposite(builder, x) {
                    let product = builder.mul(inner, y);
                    return Some(builder.neg(product));
                }
            }
            None
        }
        Op::Div(a, b) => {
            let inner = opposite(builder, a)?;
            let quotient = builder.div(inner, b);
            Some(builder.neg(quotient))
        }
        _ => None,
    }
}
