//! Operations on constants become constants of the model, in exact arithmetic.
//!
//! Constants move to the left of a product and are combined there. A division by one becomes a
//! product with its inverse: (μ cos) / M becomes (μ/M) · cos. A constant without parameters is
//! rounded once, from its exact value, so that a folded program has at most as many roundings as
//! the original. Only x · (1/c) for x / c rounds twice instead of once, because 1/c is rounded when
//! it is stored.

use crate::program::builder::Builder;
use crate::program::{ConstantId, Op, Setup, ValueId};

fn fold(
    builder: &mut Builder,
    a: ValueId,
    b: ValueId,
    operation: fn(&mut Setup, ConstantId, ConstantId) -> ConstantId,
) -> Option<ValueId> {
    let (a, b) = (builder.as_constant(a)?, builder.as_constant(b)?);
    let folded = operation(&mut builder.setup, a, b);
    Some(builder.constant(folded))
}

pub(super) fn folding(builder: &mut Builder, op: &Op) -> Option<ValueId> {
    match *op {
        Op::Neg(a) => {
            if let Op::Number(number) = builder.op(a) {
                let opposite = -number;
                return Some(builder.number(opposite));
            }
            let constant = builder.as_constant(a)?;
            let folded = builder.setup.neg(constant);
            Some(builder.constant(folded))
        }
        Op::Add(a, b) => fold(builder, a, b, Setup::add),
        Op::Sub(a, b) => fold(builder, a, b, Setup::sub),
        Op::Mul(a, b) => fold(builder, a, b, Setup::mul).or_else(|| scaled(builder, a, b)),
        Op::Div(a, b) => {
            if let Some(folded) = fold(builder, a, b, Setup::div) {
                return Some(folded);
            }
            builder.as_constant(b)?;
            let one = builder.integer(1);
            let inverse = builder.div(one, b);
            Some(builder.mul(a, inverse))
        }
        _ => None,
    }
}

/// Simplifies the product of a constant and a value: the constant comes first, and is multiplied
/// with a constant factor that the value already has.
fn scaled(builder: &mut Builder, a: ValueId, b: ValueId) -> Option<ValueId> {
    for (x, y) in [(a, b), (b, a)] {
        if builder.as_constant(x).is_some() {
            // −(c · rest) is stored as Neg, so constants are combined only here.
            if let Op::Mul(c, rest) = *builder.op(y)
                && let Some(folded) = fold(builder, x, c, Setup::mul)
            {
                return Some(builder.mul(folded, rest));
            }
            return Some(builder.record(Op::Mul(x, y)));
        }
    }
    None
}
