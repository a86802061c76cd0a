//! Accurate sums of many terms.

use crate::scalar::{Lanes, Scalar};

/// Sum that is split into parts of a few hundred terms, because the rounding error of a long sum
/// grows with its length.
pub(super) struct Sum<T> {
    total: T,
    part: T,
    terms: usize,
}

impl<T: Scalar> Sum<T> {
    pub(super) fn new() -> Self {
        let zero = T::from_f64(0.0);
        Self {
            total: zero,
            part: zero,
            terms: 0,
        }
    }

    #[inline(always)]
    pub(super) fn add(&mut self, term: T) {
        self.part = self.part + term;
        self.terms += 1;
        if self.terms == 512 {
            *self = Self {
                total: self.total(),
                ..Self::new()
            };
        }
    }

    pub(super) fn total(&self) -> T {
        self.total + self.part
    }
}

/// Returns the sum of many terms. It is computed in several lanes, in the same order for all number
/// types.
#[inline(always)]
pub(super) fn total<T: Scalar>(terms: &[T]) -> T {
    let (rows, rest) = terms.as_chunks();
    let mut side_by_side = Sum::<Lanes<T, 8>>::new();
    for &row in rows {
        side_by_side.add(Lanes(row));
    }
    let mut sum = Sum::new();
    for &term in side_by_side.total().0.iter().chain(rest) {
        sum.add(term);
    }
    sum.total()
}
