//! Long sums.

use crate::scalar::Scalar;

/// Sums, a few hundred terms at a time: the error of a long sum grows with its
/// length.
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
