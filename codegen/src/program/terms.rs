//! Terms of sums: order in which the factors of a product are multiplied.

use super::ValueId;
use super::lower::{Environment, Lowering};
use crate::exact::Rational;
use crate::mechanics::expression::{Expr, Role, SymbolId};

impl Lowering<'_> {
    /// Returns a term's sign and magnitude: constants first, then the other factors, then one
    /// quotient.
    pub(super) fn term(
        &mut self,
        environment: &mut Environment<'_>,
        term: &Expr,
    ) -> (bool, ValueId) {
        if let Some(value) = self.centrifugal(environment, term) {
            return value;
        }
        let mut negative = false;
        let mut constant = self.builder.integer(1);
        let mut above: Option<ValueId> = None;
        let mut below: Option<ValueId> = None;
        for factor in term.factors() {
            let (base, exponent) = match factor {
                Expr::Power(base, exponent) => (base.as_ref(), *exponent),
                Expr::Number(number) if number.is_negative() => {
                    negative = !negative;
                    let size: Rational = -number;
                    let size = self.builder.number(size);
                    constant = self.builder.mul(constant, size);
                    continue;
                }
                other => (other, 1),
            };
            let value = match base {
                Expr::Product(_) | Expr::Power(..) => self.expr(environment, base),
                Expr::Sum(_) => self.expr(environment, base),
                Expr::Number(number) => self.builder.number(number.clone()),
                Expr::Symbol(symbol) => self.symbol(environment, *symbol),
            };
            let is_constant = self.builder.is_constant(value);
            for _ in 0..exponent.unsigned_abs() {
                match (is_constant, exponent > 0) {
                    (true, true) => constant = self.builder.mul(constant, value),
                    (true, false) => constant = self.builder.div(constant, value),
                    (false, up) => {
                        let side = if up { &mut above } else { &mut below };
                        *side = Some(match *side {
                            Some(product) => self.builder.mul(product, value),
                            None => value,
                        });
                    }
                }
            }
        }
        let one = self.builder.integer(1);
        let mut value = match above {
            Some(product) => self.builder.mul(constant, product),
            None => constant,
        };
        if let Some(divisor) = below {
            let value_or_one = if above.is_some() || !self.builder.is(constant, 1) {
                value
            } else {
                one
            };
            value = self.builder.div(value_or_one, divisor);
        }
        (negative, value)
    }

    /// Builds ±μ sin ω² as (μ sin) · ω²: a pair of links shares the first factor, all pairs of a
    /// link the second.
    fn centrifugal(
        &mut self,
        environment: &mut Environment<'_>,
        term: &Expr,
    ) -> Option<(bool, ValueId)> {
        let mechanics = self.mechanics;
        let role = |symbol: &SymbolId| mechanics.symbols.get(*symbol).role;
        let mut negative = false;
        let (mut constants, mut sine, mut velocity) = (Vec::new(), None, None);
        for factor in term.factors() {
            match factor {
                Expr::Number(number) => {
                    negative ^= number.is_negative();
                    let size = if number.is_negative() {
                        -number
                    } else {
                        number.clone()
                    };
                    constants.push(self.builder.number(size));
                }
                Expr::Symbol(symbol) if role(symbol) == Role::Constant => {
                    constants.push(self.symbol(environment, *symbol));
                }
                Expr::Symbol(symbol) if role(symbol) == Role::Trigonometric && sine.is_none() => {
                    sine = Some(*symbol);
                }
                Expr::Power(base, 2) => match base.as_ref() {
                    Expr::Symbol(symbol)
                        if role(symbol) == Role::Velocity && velocity.is_none() =>
                    {
                        velocity = Some(*symbol);
                    }
                    _ => return None,
                },
                _ => return None,
            }
        }
        let (sine, velocity) = (sine?, velocity?);
        let mut scaled = self.symbol(environment, sine);
        for constant in constants {
            scaled = self.builder.mul(constant, scaled);
        }
        let code = &mechanics.symbols.get(sine).code;
        self.builder.name(scaled, &format!("coupled_{code}"));
        let velocity = self.symbol(environment, velocity);
        let square = self.builder.mul(velocity, velocity);
        Some((negative, self.builder.mul(scaled, square)))
    }
}
