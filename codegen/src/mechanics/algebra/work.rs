//! Amount of work of operations on formulas, counted before it is done, in units of the time for
//! one term.

use super::super::work_limit::spend;
use super::{Formula, integer};
use symbolica::atom::AtomView;

/// Work of one operation, and number of bytes of a formula whose processing takes as long as one
/// term. All these factors are measured, so that the limit of work is a limit of time for any
/// formula.
pub(super) const CALL: u64 = 3;
pub(super) const BYTES: u64 = 16;
/// Number of bytes per term of a formula that is multiplied out.
pub(super) const TERM_READ: u64 = 1;
/// Work of a term that is computed as a product, compared with an existing term.
const FORMED: u64 = 8;
/// Work of a term per square of the machine words of its number.
const LONG_NUMBER: u64 = 2;

/// Counts an operation on a formula: `terms`, and one unit per `bytes` of the formula.
pub(super) fn spend_on(terms: u64, formula: &Formula, bytes: u64) {
    let size = formula.0.as_view().get_byte_size() as u64;
    spend(terms.saturating_add(size / bytes));
}

/// Size of a formula after multiplying out, before like terms are collected.
pub(super) struct Expansion {
    terms: u64,
    /// Number of terms that result from multiplying other terms.
    formed: u64,
    /// Largest number of machine words of the numeric factor of a term.
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
                    // A multinomial coefficient; negative powers are not multiplied out.
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

    /// Counts the terms of a product or a power as results of multiplication, if there are several.
    fn multiplied_out(self) -> Self {
        let formed = if self.terms > 1 { self.terms } else { 0 };
        Self {
            formed: self.formed.saturating_add(formed),
            ..self
        }
    }

    /// Returns the work in units of one term. Products and common divisors of long numbers take a
    /// time proportional to the square of their length.
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
