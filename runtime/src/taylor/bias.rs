//! Bias terms of the equation of motion, order by order.

use super::expand::KnownOrder;

/// The coefficients of the bias.
pub(super) trait Bias<T, const N: usize> {
    /// True if there are any beyond order 0.
    const MOVES: bool;

    /// Returns those of one order.
    fn at(&mut self, known: &KnownOrder<T, N>) -> [T; N];
}

/// The bias that a function gives.
pub(super) struct MovingBias<F>(pub(super) F);

impl<T, F: FnMut(&KnownOrder<T, N>) -> [T; N], const N: usize> Bias<T, N> for MovingBias<F> {
    const MOVES: bool = true;

    #[inline(always)]
    fn at(&mut self, known: &KnownOrder<T, N>) -> [T; N] {
        (self.0)(known)
    }
}

/// None: a type of its own, so that nothing of it is left in the loop.
pub(super) struct ConstantBias;

impl<T: Copy, const N: usize> Bias<T, N> for ConstantBias {
    const MOVES: bool = false;

    #[inline(always)]
    fn at(&mut self, known: &KnownOrder<T, N>) -> [T; N] {
        known.theta
    }
}
