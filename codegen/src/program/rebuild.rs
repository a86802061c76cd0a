//! Converts values of a program back to expressions, so that tests can compare emitted code with
//! the derivation, symbol by symbol.

use crate::functions::Argument;

use super::{ConstantId, ConstantOp, Op, Program, ValueId};
use crate::mechanics::expression::{Expr, SymbolId};
use crate::mechanics::{Mechanics, Temporal, Trigonometric};
use std::collections::BTreeMap;

/// Expressions of a program's values, in the symbols of the mechanics from which it was built.
pub struct Rebuilt<'a> {
    program: &'a Program,
    mechanics: &'a Mechanics,
    given: BTreeMap<(Argument, usize), SymbolId>,
}

impl<'a> Rebuilt<'a> {
    /// Prepares the conversion from `program` to the symbols of `mechanics`.
    pub fn new(program: &'a Program, mechanics: &'a Mechanics) -> Self {
        Self {
            program,
            mechanics,
            given: BTreeMap::new(),
        }
    }

    /// Adds symbols for elements of the arguments of link functions.
    pub fn with_symbols(self, given: BTreeMap<(Argument, usize), SymbolId>) -> Self {
        Self { given, ..self }
    }

    /// Returns the expression of a value in constants, sines and cosines of single coordinates,
    /// velocities and momenta. It is written out in full and may have a size exponential in the
    /// depth, so use it for small scenes only.
    pub fn value(&self, id: ValueId) -> Option<Expr> {
        Some(match &self.program.definition(id).op {
            Op::Input(argument, index) => Expr::Symbol(self.input(*argument, *index)?),
            Op::Constant(constant) => self.constant(*constant)?,
            Op::Number(number) => Expr::Number(number.clone()),
            Op::Sin(a) => self.trigonometric(*a, Trigonometric::Sin)?,
            Op::Cos(a) => self.trigonometric(*a, Trigonometric::Cos)?,
            // A square root is not a rational expression.
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
        let transverse = self.mechanics.transverse.as_ref();
        let symbols = match argument {
            Argument::Time => return self.mechanics.drive.as_ref()?.time(),
            Argument::Theta | Argument::Absolute => &absolute.coordinates,
            Argument::Omega => &absolute.velocities,
            Argument::AbsoluteMomenta => &absolute.momenta,
            Argument::Coordinates | Argument::Symmetric => &symmetric?.coordinates,
            Argument::Rates => &symmetric?.velocities,
            Argument::Momenta => &symmetric?.momenta,
            Argument::Alpha => &transverse?.accelerations,
            Argument::Actions => &self.mechanics.normal_form.as_ref()?.actions,
            Argument::Difference(sector) => &transverse?.sectors.get(sector)?.differences,
            Argument::DifferenceRate(sector) => &transverse?.sectors.get(sector)?.rates,
            Argument::SmallDifferences => {
                return transverse?.small_symbol(index, |of| &of.differences);
            }
            Argument::SmallRates => return transverse?.small_symbol(index, |of| &of.rates),
            // The caller supplies the symbols of elements of rows.
            Argument::Forces
            | Argument::Torques
            | Argument::Weights
            | Argument::SmallTorques
            | Argument::Prescribed(_)
            | Argument::Constants
            | Argument::Body
            | Argument::Motion
            | Argument::Response
            | Argument::Sums
            | Argument::Elimination
            | Argument::Carried
            | Argument::Pivot
            | Argument::Given(_) => return self.given.get(&(argument, index)).copied(),
        };
        symbols.get(index).copied()
    }

    fn trigonometric(
        &self,
        angle: ValueId,
        function: fn(SymbolId) -> Trigonometric,
    ) -> Option<Expr> {
        let Op::Input(argument, index) = self.program.definition(angle).op else {
            return self.rotation_in_time(angle, function);
        };
        let wanted = function(self.input(argument, index)?);
        let table = &self.mechanics.trigonometry;
        let (&symbol, _) = table.iter().find(|(_, meaning)| **meaning == wanted)?;
        Some(Expr::Symbol(symbol))
    }

    /// Returns the symbol of the sine or cosine of a function of time.
    fn rotation_in_time(
        &self,
        angle: ValueId,
        function: fn(SymbolId) -> Trigonometric,
    ) -> Option<Expr> {
        let symbols = &self.mechanics.symbols;
        let argument = flat(self.value(angle)?).canonical(symbols);
        let drive = self.mechanics.drive.as_ref()?;
        let is_sine = matches!(function(SymbolId(0)), Trigonometric::Sin(_));
        let (&symbol, _) = drive.temporal.iter().find(|(_, meaning)| match meaning {
            Temporal::Sin(known) => is_sine && *known == argument,
            Temporal::Cos(known) => !is_sine && *known == argument,
            _ => false,
        })?;
        Some(Expr::Symbol(symbol))
    }

    fn constant(&self, id: ConstantId) -> Option<Expr> {
        Some(match self.program.setup.get(id).op {
            ConstantOp::Number(ref number) => Expr::Number(number.clone()),
            ConstantOp::Parameter(index) => Expr::Symbol(*self.mechanics.parameters.get(index)?),
            ConstantOp::Named(index, _) => {
                Expr::Symbol(self.mechanics.constants.get(index)?.symbol)
            }
            ConstantOp::Called(a) => self.constant(a)?,
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

/// Flattens nested sums and products, and removes terms 0 and factors 1.
fn flat(expr: Expr) -> Expr {
    match expr {
        Expr::Sum(parts) => {
            let parts = parts.into_iter().map(flat);
            Expr::Sum(parts.flat_map(|part| part.terms().to_vec()).collect())
        }
        Expr::Product(parts) => {
            let parts = parts.into_iter().map(flat);
            let mut factors: Vec<Expr> = parts.flat_map(|part| part.factors().to_vec()).collect();
            factors.retain(|factor| !matches!(factor, Expr::Number(number) if number.is_one()));
            match factors.pop() {
                Some(only) if factors.is_empty() => only,
                last => {
                    factors.extend(last);
                    Expr::Product(factors)
                }
            }
        }
        Expr::Power(base, 1) => flat(*base),
        Expr::Power(base, exponent) => Expr::Power(Box::new(flat(*base)), exponent),
        leaf => leaf,
    }
}
