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
/// Square of the machine words of a number that takes as long as one term more.
const LONG_NUMBER: u64 = 2;

/// Counts an operation on a formula.
pub(super) fn spend_on(terms: u64, formula: &Formula, bytes: u64) {
    let size = formula.0.as_view().get_byte_size() as u64;
    spend(terms.saturating_add(size / bytes));
}

/// Size of a formula multiplied out, before like terms are collected.
pub(super) struct Expansion {
    terms: u64,
    /// Most machine words of the number in a term.
    words: u64,
}

impl Expansion {
    pub(super) fn of(view: AtomView<'_>) -> Self {
        match view {
            AtomView::Num(_) => Self {
                terms: 1,
                words: view.get_byte_size() as u64 / 8,
            },
            AtomView::Var(_) | AtomView::Fun(_) => Self { terms: 1, words: 0 },
            AtomView::Add(sum) => {
                let empty = Self { terms: 0, words: 0 };
                sum.iter().map(Self::of).fold(empty, |sum, part| Self {
                    terms: sum.terms.saturating_add(part.terms),
                    words: sum.words.max(part.words),
                })
            }
            AtomView::Mul(product) => {
                let one = Self { terms: 1, words: 0 };
                product
                    .iter()
                    .map(Self::of)
                    .fold(one, |product, part| Self {
                        terms: product.terms.saturating_mul(part.terms),
                        words: product.words.saturating_add(part.words),
                    })
            }
            AtomView::Pow(power) => {
                let (base, exponent) = (Self::of(power.get_base()), integer(power.get_exp()));
                let positive = u64::from(exponent.max(0).unsigned_abs());
                Self {
                    // A multinomial coefficient; negative powers stay as they are.
                    terms: (0..positive).fold(1, |count: u64, chosen| {
                        count.saturating_mul(base.terms.saturating_add(chosen)) / (chosen + 1)
                    }),
                    words: base.words.saturating_mul(exponent.unsigned_abs().into()),
                }
            }
        }
    }

    /// Work in terms: products and common divisors of long numbers take the square of
    /// their length.
    pub(super) fn work(&self) -> u64 {
        let squared = self.words.saturating_mul(self.words);
        let long = self.terms.saturating_mul(squared) / LONG_NUMBER;
        self.terms.saturating_add(long)
    }
}
