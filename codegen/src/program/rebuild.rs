//! Rebuilds expressions from a program, so that tests can compare what is
//! emitted with what was derived, symbol by symbol.

use super::{Argument, ConstantId, ConstantOp, Op, Program, ValueId};
use crate::mechanics::expression::{Expr, SymbolId};
use crate::mechanics::{Mechanics, Trigonometric};

/// Expressions of a program's values in the symbols of its mechanics.
pub struct Rebuilt<'a> {
    program: &'a Program,
    mechanics: &'a Mechanics,
}

impl<'a> Rebuilt<'a> {
    /// Prepares the way back from `program` to the symbols of `mechanics`.
    pub fn new(program: &'a Program, mechanics: &'a Mechanics) -> Self {
        Self { program, mechanics }
    }

    /// The expression that a value stands for, in constants, sines and cosines
    /// of single coordinates, velocities and momenta. Written out in full: the
    /// size may be exponential in the depth, so this is for small scenes.
    pub fn value(&self, id: ValueId) -> Option<Expr> {
        Some(match &self.program.definition(id).op {
            Op::Input(argument, index) => Expr::Symbol(self.input(*argument, *index)?),
            Op::Constant(constant) => self.constant(*constant)?,
            Op::Number(number) => Expr::Number(number.clone()),
            Op::Sin(a) => self.trigonometric(*a, Trigonometric::Sin)?,
            Op::Cos(a) => self.trigonometric(*a, Trigonometric::Cos)?,
            // Square roots are no rational expressions.
            Op::Sqrt(_) => return None,
            Op::Neg(a) => minus(self.value(*a)?),
            Op::Add(a, b) => Expr::Sum(vec![self.value(*a)?, self.value(*b)?]),
            Op::Sub(a, b) => Expr::Sum(vec![self.value(*a)?, minus(self.value(*b)?)]),
            Op::Mul(a, b) => Expr::Product(vec![self.value(*a)?, self.value(*b)?]),
            Op::Div(a, b) => Expr::Product(vec![
                self.value(*a)?,
                Expr::Power(Box::new(self.value(*b)?), -1),
            ]),
        })
    }

    fn input(&self, argument: Argument, index: usize) -> Option<SymbolId> {
        let absolute = &self.mechanics.absolute;
        let symmetric = self.mechanics.symmetric.as_ref();
        let symbols = match argument {
            Argument::Theta | Argument::Absolute => &absolute.coordinates,
            Argument::Omega => &absolute.velocities,
            Argument::AbsoluteMomenta => &absolute.momenta,
            Argument::Coordinates | Argument::Symmetric => &symmetric?.coordinates,
            Argument::Rates => &symmetric?.velocities,
            Argument::Momenta => &symmetric?.momenta,
        };
        symbols.get(index).copied()
    }

    fn trigonometric(
        &self,
        angle: ValueId,
        function: fn(SymbolId) -> Trigonometric,
    ) -> Option<Expr> {
        let Op::Input(argument, index) = self.program.definition(angle).op else {
            return None;
        };
        let wanted = function(self.input(argument, index)?);
        let table = &self.mechanics.trigonometry;
        let (&symbol, _) = table.iter().find(|(_, meaning)| **meaning == wanted)?;
        Some(Expr::Symbol(symbol))
    }

    fn constant(&self, id: ConstantId) -> Option<Expr> {
        Some(match self.program.setup.get(id).op {
            ConstantOp::Number(ref number) => Expr::Number(number.clone()),
            ConstantOp::Parameter(index) => Expr::Symbol(*self.mechanics.parameters.get(index)?),
            ConstantOp::Named(index, _) => {
                Expr::Symbol(self.mechanics.constants.get(index)?.symbol)
            }
            ConstantOp::Product(ref number, ref powers) => {
                let mut factors = vec![Expr::Number(number.clone())];
                for &(id, power) in powers {
                    factors.push(Expr::Power(Box::new(self.constant(id)?), power));
                }
                Expr::Product(factors)
            }
            ConstantOp::Add(a, b) => Expr::Sum(vec![self.constant(a)?, self.constant(b)?]),
            ConstantOp::Sub(a, b) => Expr::Sum(vec![self.constant(a)?, minus(self.constant(b)?)]),
        })
    }
}

fn minus(expr: Expr) -> Expr {
    Expr::Product(vec![Expr::Number((-1).into()), expr])
}
