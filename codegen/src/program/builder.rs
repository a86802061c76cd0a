//! Builds a program value by value. Equal operations become one value, and
//! operations that change nothing are not recorded.

use super::{Choice, ConstantId, ConstantOp, Definition, Entry, Op, Pass, Program, Setup, ValueId};
use crate::exact::Rational;
use crate::scene::Scene;
use std::collections::BTreeMap;

/// A program in the making.
#[derive(Clone, Default)]
pub(super) struct Builder {
    pub(super) definitions: Vec<Definition>,
    known: BTreeMap<Op, ValueId>,
    pub(super) setup: Setup,
    /// What is left out, for comparison.
    pub(super) off: Option<Pass>,
}

impl Builder {
    pub(super) fn finish(self, entries: Vec<Entry>, choice: Choice) -> Program {
        Program {
            definitions: self.definitions,
            entries,
            setup: self.setup,
            choice,
        }
    }

    pub(super) fn op(&self, id: ValueId) -> &Op {
        &self.definitions[id.0 as usize].op
    }

    /// The values that `outputs` depend on, themselves included, in order.
    pub(super) fn needed(&self, outputs: &[ValueId]) -> Vec<ValueId> {
        super::needed(&self.definitions, outputs)
    }

    fn record(&mut self, op: Op) -> ValueId {
        let leaf = !op.operands().any(|_| true) || matches!(op, Op::Sin(_) | Op::Cos(_));
        if (leaf || self.off != Some(Pass::Sharing))
            && let Some(&id) = self.known.get(&op)
        {
            return id;
        }
        let id = ValueId(self.definitions.len() as u32);
        self.known.insert(op.clone(), id);
        self.definitions.push(Definition {
            op,
            name: None,
            hint: None,
        });
        id
    }

    /// Gives a value a name, unless it has one or is a leaf. A change of sign
    /// costs nothing where the value is used, so what it changes is named.
    pub(super) fn name(&mut self, id: ValueId, name: &str) -> ValueId {
        if let Op::Neg(inner) = *self.op(id) {
            self.name(inner, &format!("minus_{name}"));
            return id;
        }
        let definition = &mut self.definitions[id.0 as usize];
        if !is_leaf(&definition.op) && definition.name.is_none() {
            definition.name = Some(name.to_owned());
        }
        id
    }

    /// Says what a value is, without giving it a line of its own: code that
    /// needs a name for it takes this one. The first hint stays.
    pub(super) fn hint(&mut self, id: ValueId, name: &str) {
        if let Op::Neg(inner) = *self.op(id) {
            return self.hint(inner, &format!("minus_{name}"));
        }
        let definition = &mut self.definitions[id.0 as usize];
        if !is_leaf(&definition.op) && definition.hint.is_none() {
            definition.hint = Some(name.to_owned());
        }
    }

    pub(super) fn input(&mut self, argument: super::Argument, index: usize) -> ValueId {
        self.record(Op::Input(argument, index))
    }

    pub(super) fn number(&mut self, value: Rational) -> ValueId {
        self.record(Op::Number(value))
    }

    pub(super) fn integer(&mut self, value: i64) -> ValueId {
        self.number(Rational::from(value))
    }

    pub(super) fn constant(&mut self, id: ConstantId) -> ValueId {
        match &self.setup.get(id).op {
            ConstantOp::Number(number) => {
                let number = number.clone();
                self.number(number)
            }
            _ => self.record(Op::Constant(id)),
        }
    }

    pub(super) fn sin(&mut self, angle: ValueId) -> ValueId {
        self.record(Op::Sin(angle))
    }

    pub(super) fn cos(&mut self, angle: ValueId) -> ValueId {
        self.record(Op::Cos(angle))
    }

    /// The cosine that belongs to a sine, or the sine that belongs to a cosine,
    /// named after it; none for other values.
    pub(super) fn partner(&mut self, id: ValueId) -> Option<ValueId> {
        let (partner, from, to) = match *self.op(id) {
            Op::Sin(angle) => (self.cos(angle), "sin_", "cos_"),
            Op::Cos(angle) => (self.sin(angle), "cos_", "sin_"),
            _ => return None,
        };
        let name = self.definitions[id.0 as usize].name.clone();
        if let Some(rest) = name.as_deref().and_then(|name| name.strip_prefix(from)) {
            self.name(partner, &format!("{to}{rest}"));
        }
        Some(partner)
    }

    pub(super) fn sqrt(&mut self, a: ValueId) -> ValueId {
        self.record(Op::Sqrt(a))
    }

    pub(super) fn is(&self, id: ValueId, value: i64) -> bool {
        *self.op(id) == Op::Number(Rational::from(value))
    }

    /// What a change of sign is applied to.
    fn opposite(&self, id: ValueId) -> Option<ValueId> {
        match *self.op(id) {
            Op::Neg(inner) if self.off != Some(Pass::Signs) => Some(inner),
            _ => None,
        }
    }

    /// The value as a constant of the setup, if no input is involved.
    fn as_constant(&mut self, id: ValueId) -> Option<ConstantId> {
        match self.op(id).clone() {
            Op::Constant(constant) => Some(constant),
            Op::Number(number) => Some(self.setup.number(number)),
            _ => None,
        }
    }

    fn fold(
        &mut self,
        a: ValueId,
        b: ValueId,
        operation: fn(&mut Setup, ConstantId, ConstantId) -> ConstantId,
    ) -> Option<ValueId> {
        if self.off == Some(Pass::Folding) {
            return None;
        }
        let (a, b) = (self.as_constant(a)?, self.as_constant(b)?);
        let folded = operation(&mut self.setup, a, b);
        Some(self.constant(folded))
    }

    pub(super) fn neg(&mut self, a: ValueId) -> ValueId {
        if self.off == Some(Pass::Signs) && self.as_constant(a).is_none() {
            return self.record(Op::Neg(a));
        }
        match *self.op(a) {
            Op::Neg(inner) => inner,
            Op::Sub(x, y) => self.sub(y, x),
            Op::Number(ref number) => {
                let opposite = -number;
                self.number(opposite)
            }
            _ => match self.as_constant(a) {
                Some(constant) => {
                    let folded = self.setup.neg(constant);
                    self.constant(folded)
                }
                None => self.record(Op::Neg(a)),
            },
        }
    }

    pub(super) fn add(&mut self, a: ValueId, b: ValueId) -> ValueId {
        if self.is(a, 0) {
            return b;
        }
        if self.is(b, 0) {
            return a;
        }
        if let Some(inner) = self.opposite(b) {
            return self.sub(a, inner);
        }
        if let Some(inner) = self.opposite(a) {
            return self.sub(b, inner);
        }
        if a == b {
            let two = self.integer(2);
            return self.mul(two, a);
        }
        self.fold(a, b, Setup::add)
            .unwrap_or_else(|| self.record(Op::Add(a, b)))
    }

    pub(super) fn sub(&mut self, a: ValueId, b: ValueId) -> ValueId {
        if self.is(b, 0) {
            return a;
        }
        if self.is(a, 0) {
            return self.neg(b);
        }
        if a == b {
            return self.integer(0);
        }
        if let Some(inner) = self.opposite(b) {
            return self.add(a, inner);
        }
        if let Some(inner) = self.opposite(a) {
            let sum = self.add(inner, b);
            return self.neg(sum);
        }
        self.fold(a, b, Setup::sub)
            .unwrap_or_else(|| self.record(Op::Sub(a, b)))
    }

    /// Product. Signs move outwards and constants inwards, so that
    /// (μ cos) · (1/M) becomes (μ/M) · cos, with μ/M formed once.
    pub(super) fn mul(&mut self, a: ValueId, b: ValueId) -> ValueId {
        if self.is(a, 0) || self.is(b, 1) {
            return a;
        }
        if self.is(b, 0) || self.is(a, 1) {
            return b;
        }
        for (x, y) in [(a, b), (b, a)] {
            if self.is(x, -1) {
                return self.neg(y);
            }
            if let Some(inner) = self.opposite(x) {
                let product = self.mul(inner, y);
                return self.neg(product);
            }
        }
        if let Some(folded) = self.fold(a, b, Setup::mul) {
            return folded;
        }
        for (x, y) in [(a, b), (b, a)] {
            if self.as_constant(x).is_some() {
                // −(c · rest) is stored as Neg, so constants meet here only.
                if let Op::Mul(c, rest) = *self.op(y)
                    && let Some(folded) = self.fold(x, c, Setup::mul)
                {
                    return self.mul(folded, rest);
                }
                return self.record(Op::Mul(x, y));
            }
        }
        self.record(Op::Mul(a, b))
    }

    pub(super) fn div(&mut self, a: ValueId, b: ValueId) -> ValueId {
        if self.is(a, 0) || self.is(b, 1) {
            return a;
        }
        if let Some(inner) = self.opposite(a) {
            let quotient = self.div(inner, b);
            return self.neg(quotient);
        }
        if let Some(folded) = self.fold(a, b, Setup::div) {
            return folded;
        }
        if self.off != Some(Pass::Folding) && self.as_constant(b).is_some() {
            let one = self.integer(1);
            let inverse = self.div(one, b);
            return self.mul(a, inverse);
        }
        self.record(Op::Div(a, b))
    }
}

fn is_leaf(op: &Op) -> bool {
    matches!(op, Op::Input(..) | Op::Constant(_) | Op::Number(_))
}

/// Constants of the setup as values.
impl Builder {
    /// A constant under a name of its own, unless it is a whole number that
    /// operations drop or fold.
    pub(super) fn called(&mut self, value: ValueId, name: &str) -> ValueId {
        if [-1, 0, 1].iter().any(|&number| self.is(value, number)) {
            return value;
        }
        match self.as_constant(value) {
            Some(formed) => {
                let called = self.setup.called(formed, name);
                self.constant(called)
            }
            None => value,
        }
    }

    /// Whether a constant can be divided by, whatever the parameters of the
    /// scene.
    pub(super) fn is_never_zero(&self, value: ValueId, scene: &Scene) -> bool {
        match self.op(value) {
            Op::Number(number) => !number.is_zero(),
            Op::Constant(id) => match &self.setup.get(*id).exact {
                Some(exact) => !exact.is_zero(),
                None => self.setup.is_positive(*id, scene),
            },
            _ => false,
        }
    }
}
