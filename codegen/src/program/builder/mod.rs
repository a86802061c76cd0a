//! Builder of programs, value by value; [`RULES`] simplify each operation.

mod rules;

use super::{
    ConstantId, ConstantOp, Definition, Entry, MOST_VALUES, Op, Pass, Program, Setup, SolveChoice,
    TooManyValues, ValueId,
};
use crate::exact::Rational;
use crate::functions::Argument;
use crate::scene::Scene;
use rules::RULES;
use rules::sharing::KnownOperations;

/// A program under construction.
#[derive(Clone, Default)]
pub struct Builder {
    /// The values so far, in their order.
    pub definitions: Vec<Definition>,
    known: KnownOperations,
    /// The constants so far.
    pub setup: Setup,
    /// Pass that is left out, for comparison.
    pub(super) off: Option<Pass>,
    /// Value that replaces all further values once there are too many.
    stand_in: Option<ValueId>,
}

impl Builder {
    /// Creates a program without values, with the constants of another one.
    pub(super) fn on_constants_of(program: &Program) -> Self {
        Self {
            setup: program.setup.clone(),
            off: program.without,
            ..Self::default()
        }
    }

    /// Returns true if there would be more than [`MOST_VALUES`]. Further operations then cost next
    /// to nothing.
    pub(super) fn is_exceeded(&self) -> bool {
        self.stand_in.is_some()
    }

    /// Returns the finished program.
    ///
    /// # Errors
    /// [`TooManyValues`] if there would be more than [`MOST_VALUES`].
    pub fn finish(
        self,
        entries: Vec<Entry>,
        choice: SolveChoice,
    ) -> Result<Program, TooManyValues> {
        if self.is_exceeded() {
            return Err(TooManyValues);
        }
        Ok(Program {
            definitions: self.definitions,
            entries,
            setup: self.setup,
            choice,
            strips: None,
            without: self.off,
        })
    }

    /// Returns the operation of a value.
    pub fn op(&self, id: ValueId) -> &Op {
        &self.definitions[id.0 as usize].op
    }

    /// Returns the values that `outputs` depend on, including these, in the order of the program.
    pub(super) fn needed(&self, outputs: &[ValueId]) -> Vec<ValueId> {
        crate::program::dead::needed(&self.definitions, outputs)
    }

    /// Returns the value of an operation: simplified by the rules, or recorded as it is.
    fn form(&mut self, op: Op) -> ValueId {
        if let Some(stand_in) = self.stand_in {
            return stand_in;
        }
        for (pass, rule) in RULES {
            if (pass.is_none() || self.off != pass)
                && let Some(value) = rule(self, &op)
            {
                return value;
            }
        }
        self.record(op)
    }

    /// Returns the value of exactly this operation, and adds it if it is new.
    pub(super) fn record(&mut self, op: Op) -> ValueId {
        if let Some(stand_in) = self.stand_in {
            return stand_in;
        }
        let found = match self.off {
            Some(Pass::Sharing) => self.known.find_leaf(&op),
            _ => self.known.find(&op),
        };
        if let Some(id) = found {
            return id;
        }
        let id = ValueId(self.definitions.len() as u32);
        // An input rather than a constant, so that nothing is folded or removed, and callers find a
        // value where they expect one.
        let op = match self.definitions.len() >= MOST_VALUES {
            true => {
                self.stand_in = Some(id);
                Op::Input(Argument::Time, 0)
            }
            false => op,
        };
        self.known.insert(op.clone(), id);
        self.definitions.push(Definition {
            op,
            name: None,
            hint: None,
        });
        id
    }

    /// Names a value, unless it has a name or is an input or a constant; for a constant the name is
    /// a hint. A change of sign costs nothing in the operation that uses it, so its operand is
    /// named instead.
    pub fn name(&mut self, id: ValueId, name: &str) -> ValueId {
        if let Op::Constant(constant) = *self.op(id) {
            self.setup.hint(constant, name);
            return id;
        }
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

    /// Suggests a name for a value without giving it a separate line: the name is used if code
    /// needs one. The first hint is kept.
    pub(super) fn hint(&mut self, id: ValueId, name: &str) {
        if let Op::Constant(constant) = *self.op(id) {
            return self.setup.hint(constant, name);
        }
        if let Op::Neg(inner) = *self.op(id) {
            return self.hint(inner, &format!("minus_{name}"));
        }
        let definition = &mut self.definitions[id.0 as usize];
        if !is_leaf(&definition.op) && definition.hint.is_none() {
            definition.hint = Some(name.to_owned());
        }
    }

    /// Suggests a name for the adjoint of a value that has a name: `tangential_a_adjoint`.
    pub(super) fn hint_adjoint(&mut self, adjoint: ValueId, of: ValueId) {
        let Definition { name, hint, .. } = &self.definitions[of.0 as usize];
        if let Some(name) = name.as_ref().or(hint.as_ref()) {
            let name = format!("{name}_adjoint");
            self.hint(adjoint, &name);
        }
    }

    /// Returns an element of an argument.
    pub fn input(&mut self, argument: Argument, index: usize) -> ValueId {
        self.record(Op::Input(argument, index))
    }

    pub(super) fn number(&mut self, value: Rational) -> ValueId {
        self.record(Op::Number(value))
    }

    /// Returns a whole number.
    pub fn integer(&mut self, value: i64) -> ValueId {
        self.number(Rational::from(value))
    }

    /// Returns a constant of the model.
    pub fn constant(&mut self, id: ConstantId) -> ValueId {
        match &self.setup.get(id).op {
            ConstantOp::Number(number) => {
                let number = number.clone();
                self.number(number)
            }
            _ => self.record(Op::Constant(id)),
        }
    }

    /// Returns the sine of an angle.
    pub fn sin(&mut self, angle: ValueId) -> ValueId {
        self.record(Op::Sin(angle))
    }

    pub(super) fn cos(&mut self, angle: ValueId) -> ValueId {
        self.record(Op::Cos(angle))
    }

    /// Returns the cosine that has the same argument as a sine, or the sine that has the same
    /// argument as a cosine, with a corresponding name; `None` for other values.
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
        matches!(self.op(id), Op::Number(number) if *number == Rational::from(value))
    }

    pub(super) fn is_constant(&self, id: ValueId) -> bool {
        matches!(self.op(id), Op::Constant(_) | Op::Number(_))
    }

    /// Returns the value as a constant of the setup, or `None` if it depends on an input.
    pub fn as_constant(&mut self, id: ValueId) -> Option<ConstantId> {
        match self.op(id).clone() {
            Op::Constant(constant) => Some(constant),
            Op::Number(number) => Some(self.setup.number(number)),
            _ => None,
        }
    }

    /// Returns −a.
    pub fn neg(&mut self, a: ValueId) -> ValueId {
        self.form(Op::Neg(a))
    }

    /// Returns a + b.
    pub fn add(&mut self, a: ValueId, b: ValueId) -> ValueId {
        self.form(Op::Add(a, b))
    }

    /// Returns a − b.
    pub fn sub(&mut self, a: ValueId, b: ValueId) -> ValueId {
        self.form(Op::Sub(a, b))
    }

    /// Returns a b.
    pub fn mul(&mut self, a: ValueId, b: ValueId) -> ValueId {
        self.form(Op::Mul(a, b))
    }

    /// Returns a/b.
    pub fn div(&mut self, a: ValueId, b: ValueId) -> ValueId {
        self.form(Op::Div(a, b))
    }
}

fn is_leaf(op: &Op) -> bool {
    matches!(op, Op::Input(..) | Op::Constant(_) | Op::Number(_))
}

/// Methods that create constants of the model, as values of the program.
impl Builder {
    /// Creates a named constant, unless it is a whole number, which operations drop or fold.
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

    /// Returns the exact value of a constant, or `None` if it depends on a parameter.
    pub(super) fn exact(&self, value: ValueId) -> Option<Rational> {
        match self.op(value) {
            Op::Number(number) => Some(number.clone()),
            Op::Constant(id) => self.setup.get(*id).exact.clone(),
            _ => None,
        }
    }

    /// Returns true if a constant is nonzero for all parameters that the scene accepts.
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
