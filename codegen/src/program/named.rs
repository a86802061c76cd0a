//! Conversion of parameters and named constants of the derived mechanics to constants of the
//! program, which are computed once per model.

use super::ValueId;
use super::constants::{ConstantId, Setup};
use super::lower::Lowering;
use crate::exact::Rational;
use crate::mechanics::expression::{Expr, SymbolId};

impl Lowering<'_> {
    /// Returns the constant of the program that belongs to the symbol of a parameter, or of a
    /// constant of the mechanics.
    pub(super) fn constant(&mut self, symbol: SymbolId) -> ConstantId {
        if let Some(&id) = self.constants.get(&symbol) {
            return id;
        }
        let mechanics = self.mechanics;
        let code = &mechanics.symbols.get(symbol).code;
        let parameter = mechanics.parameters.iter().position(|&p| p == symbol);
        let constant = mechanics.constants.iter().position(|c| c.symbol == symbol);
        let id = match (parameter, constant) {
            (Some(index), _) => self.builder.setup.parameter(index, code),
            (None, Some(index)) => {
                // Equal constants share one representative.
                let own = mechanics.representative(index);
                let constant = &mechanics.constants[own];
                let code = &mechanics.symbols.get(constant.symbol).code;
                let formed = self.constant_expr(&constant.value);
                let id = self.builder.setup.named(own, formed, code);
                self.builder.setup.stand_ins.insert(index, id);
                id
            }
            (None, None) => unreachable!("{code} is neither parameter nor constant"),
        };
        self.constants.insert(symbol, id);
        id
    }

    /// Returns a property of a link; the existing constant of the mechanics if it equals one.
    pub(super) fn property(&mut self, value: &Expr, unit: &str) -> ValueId {
        let mechanics = self.mechanics;
        let mut constants = mechanics.constants.iter();
        let known = constants.find(|constant| constant.unit == unit && constant.value == *value);
        let constant = match (value, known) {
            (Expr::Number(_), _) | (_, None) => self.constant_expr(value),
            (_, Some(constant)) => self.constant(constant.symbol),
        };
        self.builder.constant(constant)
    }

    /// Returns an expression in parameters as a constant of the setup.
    fn constant_expr(&mut self, expr: &Expr) -> ConstantId {
        match expr {
            Expr::Number(number) => self.builder.setup.number(number.clone()),
            Expr::Symbol(symbol) => self.constant(*symbol),
            Expr::Sum(terms) => self.constant_fold(terms, Setup::add, 0),
            Expr::Product(factors) => self.constant_fold(factors, Setup::mul, 1),
            Expr::Power(base, exponent) => {
                let base = self.constant_expr(base);
                self.builder.setup.power(base, *exponent)
            }
        }
    }

    fn constant_fold(
        &mut self,
        parts: &[Expr],
        operation: fn(&mut Setup, ConstantId, ConstantId) -> ConstantId,
        start: i64,
    ) -> ConstantId {
        let start = self.builder.setup.number(Rational::from(start));
        parts.iter().fold(start, |total, part| {
            let value = self.constant_expr(part);
            operation(&mut self.builder.setup, total, value)
        })
    }
}
