//! Cancelling of quotients of constants. For example the diagonal entry M of the mass matrix of a
//! rod with a bob is 1 / 30 + m / 4, although its centre of mass is a quotient.

use super::work::{BYTES, spend_on};
use super::{Formula, integer};
use crate::exact::Rational;
use crate::mechanics::expression::{Expr, Symbols};
use symbolica::atom::{Atom, AtomCore, AtomView};

/// Largest number of terms of a numerator, times those of its denominator, for which common factors
/// are cancelled. Longer formulas stay as they were written.
const MOST_TERMS: u64 = 2_000;

impl Formula {
    /// Returns the formula as plain data, in canonical order. If no divisor remains after
    /// cancelling common factors, the formula is multiplied out; otherwise the shorter of a sum of
    /// quotients and a single quotient is chosen.
    pub fn cancelled(&self, symbols: &Symbols) -> Expr {
        let expanded = self.expand();
        let quotient = Quotient::of(expanded.0.as_view());
        let work = quotient.above.saturating_mul(quotient.divisor_terms());
        if quotient.below.is_empty() || work > MOST_TERMS {
            return expanded.to_expr(symbols);
        }
        spend_on(work, &expanded, BYTES);
        let lowest = Self(expanded.0.together());
        let Some((above, below)) = lowest.parts() else {
            return lowest.expand().to_expr(symbols);
        };
        // `together` returns whole numbers. Divide by the number in the divisor's last term, so
        // that this term is a symbol, or a product of symbols, without a number.
        let unit = last_number(&below.expand().to_expr(symbols));
        let scaled = |part: &Self| (part / &Self::number(&unit)).expand();
        let one = &scaled(&above) / &scaled(&below);
        let [one, sum] = [one, expanded].map(|formula| formula.to_expr(symbols));
        match size(&one) <= size(&sum) {
            true => one,
            false => sum,
        }
    }

    /// Returns numerator and denominator; `None` if the formula has no divisor.
    fn parts(&self) -> Option<(Self, Self)> {
        let factors = match self.0.as_view() {
            AtomView::Mul(product) => product.iter().collect(),
            other => vec![other],
        };
        let is_divisor = |factor: &AtomView<'_>| match factor {
            AtomView::Pow(power) => integer(power.get_exp()) < 0,
            _ => false,
        };
        let (below, above): (Vec<_>, Vec<_>) = factors.into_iter().partition(is_divisor);
        let product = |factors: Vec<AtomView<'_>>| {
            let factors: Vec<Atom> = factors
                .into_iter()
                .map(|factor| factor.to_owned())
                .collect();
            Self(Atom::mul_many(factors.iter()))
        };
        let below = (!below.is_empty()).then(|| product(below).pow(-1))?;
        Some((product(above), below))
    }
}

/// Returns the numeric factor of the last term.
fn last_number(expr: &Expr) -> Rational {
    let number = expr.terms().last().and_then(|term| match term.factors() {
        [Expr::Number(number), ..] => Some(number.clone()),
        _ => None,
    });
    number.unwrap_or_else(Rational::one)
}

/// Counts the numbers and symbols of an expression.
fn size(expr: &Expr) -> usize {
    match expr {
        Expr::Number(_) | Expr::Symbol(_) => 1,
        Expr::Sum(parts) | Expr::Product(parts) => parts.iter().map(size).sum(),
        Expr::Power(base, exponent) => size(base) * exponent.unsigned_abs() as usize,
    }
}

/// Size of a formula over one common denominator, before cancelling.
struct Quotient {
    /// Number of terms of the numerator.
    above: u64,
    /// Divisors: each with its power and its number of terms.
    below: Vec<(Atom, u32, u64)>,
}

impl Quotient {
    fn of(view: AtomView<'_>) -> Self {
        let mut whole = Self {
            above: 1,
            below: Vec::new(),
        };
        match view {
            AtomView::Num(_) | AtomView::Var(_) | AtomView::Fun(_) => {}
            AtomView::Mul(product) => {
                for factor in product.iter() {
                    let Self { above, below } = Self::of(factor);
                    whole.above = whole.above.saturating_mul(above);
                    for (base, power, terms) in below {
                        let known = whole.power(&base);
                        whole.divide(base, known + power, terms);
                    }
                }
            }
            AtomView::Pow(power) => {
                let (base, exponent) = (power.get_base(), integer(power.get_exp()));
                let Self { above, below } = Self::of(base);
                let size = exponent.unsigned_abs();
                if exponent > 0 {
                    whole.above = above.saturating_pow(size);
                    let powers = below.into_iter();
                    whole.below = powers
                        .map(|(base, power, terms)| (base, power.saturating_mul(size), terms))
                        .collect();
                } else {
                    // A divisor's own divisors move to the numerator.
                    let inner = Self { above: 1, below };
                    whole.above = inner.divisor_terms().saturating_pow(size);
                    whole.divide(base.to_owned(), size, above);
                }
            }
            AtomView::Add(sum) => {
                let parts: Vec<Self> = sum.iter().map(Self::of).collect();
                for (base, power, terms) in parts.iter().flat_map(|part| &part.below) {
                    whole.divide(base.clone(), *power, *terms);
                }
                let missing = |part: &Self| {
                    let divisors = whole.below.iter();
                    divisors.fold(part.above, |terms, (base, power, own)| {
                        let rest = power.saturating_sub(part.power(base));
                        terms.saturating_mul(own.saturating_pow(rest))
                    })
                };
                whole.above = parts.iter().map(missing).fold(0, u64::saturating_add);
            }
        }
        whole
    }

    /// Returns the power of the divisor `base`; 0 if it is not a divisor.
    fn power(&self, base: &Atom) -> u32 {
        let found = self.below.iter().find(|(own, ..)| own == base);
        found.map_or(0, |(_, power, _)| *power)
    }

    /// Raises the power of the divisor `base` to at least `power`.
    fn divide(&mut self, base: Atom, power: u32, terms: u64) {
        match self.below.iter_mut().find(|(own, ..)| *own == base) {
            Some((_, known, _)) => *known = power.max(*known),
            None => self.below.push((base, power, terms)),
        }
    }

    /// Returns the number of terms of the denominator.
    fn divisor_terms(&self) -> u64 {
        let divisors = self.below.iter();
        divisors.fold(1, |product, (_, power, terms)| {
            product.saturating_mul(terms.saturating_pow(*power))
        })
    }
}
