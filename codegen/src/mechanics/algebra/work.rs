//! Work of operations on formulas, counted before it is done.

use super::super::work_limit::spend;
use super::{Formula, integer};
use symbolica::atom::AtomView;

/// Work of one operation, and bytes of a formula that take as much as one term: found by
/// measuring, so that the limit is one of time on any formula.
pub(super) const CALL: u64 = 3;
pub(super) const BYTES: u64 = 16;
/// Bytes of a formula that is multiplied out.
pub(super) const TERM_READ: u64 = 1;
/// Terms that stand there already and take as long as one that is formed as a product.
const FORMED: u64 = 8;
/// Terms that take as long as the square of the machine words of one number.
const LONG_NUMBER: u64 = 2;

/// Counts an operation on a formula.
pub(super) fn spend_on(terms: u64, formula: &Formula, bytes: u64) {
    let size = formula.0.as_view().get_byte_size() as u64;
    spend(terms.saturating_add(size / bytes));
}

/// Size of a formula multiplied out, before like terms are collected.
pub(super) struct Expansion {
    terms: u64,
    /// Terms that are formed as products of others.
    formed: u64,
    /// Most machine words of the number in a term.
    words: u64,
}

impl Expansion {
    const ONE: Self = Self {
        terms: 1,
        formed: 0,
        words: 0,
    };

    pub(super) fn of(view: AtomView<'_>) -> Self {
        match view {
            AtomView::Num(_) => Self {
                words: view.get_byte_size() as u64 / 8,
                ..Self::ONE
            },
            AtomView::Var(_) | AtomView::Fun(_) => Self::ONE,
            AtomView::Add(sum) => {
                let empty = Self {
                    terms: 0,
                    ..Self::ONE
                };
                sum.iter().map(Self::of).fold(empty, |sum, part| Self {
                    terms: sum.terms.saturating_add(part.terms),
                    formed: sum.formed.saturating_add(part.formed),
                    words: sum.words.max(part.words),
                })
            }
            AtomView::Mul(product) => {
                let parts = product.iter().map(Self::of);
                let product = parts.fold(Self::ONE, |product, part| Self {
                    terms: product.terms.saturating_mul(part.terms),
                    formed: product.formed.saturating_add(part.formed),
                    words: product.words.saturating_add(part.words),
                });
                product.multiplied_out()
            }
            AtomView::Pow(power) => {
                let (base, exponent) = (Self::of(power.get_base()), integer(power.get_exp()));
                let positive = u64::from(exponent.max(0).unsigned_abs());
                let power = Self {
                    // A multinomial coefficient; negative powers stay as they are.
                    terms: (0..positive).fold(1, |count: u64, chosen| {
                        count.saturating_mul(base.terms.saturating_add(chosen)) / (chosen + 1)
                    }),
                    formed: base.formed,
                    words: base.words.saturating_mul(exponent.unsigned_abs().into()),
                };
                power.multiplied_out()
            }
        }
    }

    /// Counts the terms of a product or a power as formed, if there is more than one.
    fn multiplied_out(self) -> Self {
        let formed = if self.terms > 1 { self.terms } else { 0 };
        Self {
            formed: self.formed.saturating_add(formed),
            ..self
        }
    }

    /// Work in terms: products and common divisors of long numbers take the square of
    /// their length.
    pub(super) fn work(&self) -> u64 {
        let squared = self.words.saturating_mul(self.words);
        let long = self
            .terms
            .saturating_mul(squared)
            .saturating_mul(LONG_NUMBER);
        let formed = self.formed.saturating_mul(FORMED);
        self.terms.saturating_add(long).saturating_add(formed)
    }
}
