//! Sums of Taylor polynomials and the sizes of their last terms, computed with the vector
//! instructions of the machine.

use crate::scalar::{Real, two_sum};
use crate::simd::{Kernel, Quad, Simd};

/// Operation that evaluates a Taylor polynomial: writes `start` + Σ y\[k\] τᵏ over k ≥ 1 to `end`.
pub(in crate::integrate) struct Ahead<'a, T> {
    /// Coefficients y\[k\], order by order.
    pub(in crate::integrate) coefficients: &'a [T],
    pub(in crate::integrate) tau: T,
    pub(in crate::integrate) start: &'a [T],
    pub(in crate::integrate) end: &'a mut [T],
    /// Rounding errors of `start` and of `end`, for compensated sums.
    pub(in crate::integrate) residues: Option<(&'a [T], &'a mut [T])>,
}

impl<T: Real> Kernel<T> for Ahead<'_, T> {
    type Output = ();

    #[inline(always)]
    fn run<P: Simd<T>>(mut self) {
        let n = self.start.len();
        let mut first = 0;
        while first + 4 <= n {
            self.block::<P, 4>(first);
            first += 4;
        }
        while first + 2 <= n {
            self.block::<P, 2>(first);
            first += 2;
        }
        while first < n {
            self.block::<P, 1>(first);
            first += 1;
        }
    }
}

impl<T: Real> Ahead<'_, T> {
    /// Sums the components from `first` on by Horner's rule in τ², separately for even and odd
    /// k > 1. With residues, the rounding errors of the sum with y\[1\] and of the product with τ
    /// are kept.
    #[inline(always)]
    fn block<P: Simd<T>, const W: usize>(&mut self, first: usize) {
        let n = self.start.len();
        let zero = P::splat(T::ZERO);
        let (tau, square) = (P::splat(self.tau), P::splat(self.tau * self.tau));
        let (mut odd, mut even) = (zero, zero);
        let linear = load::<T, P, W>(self.coefficients, n + first);
        let rows = self.coefficients.get(2 * n..).unwrap_or_default();
        // Pairs of an even and an odd order; the highest even order may have no partner.
        let (pairs, alone) = rows.split_at(rows.len() / (2 * n) * (2 * n));
        if !alone.is_empty() {
            even = load::<T, P, W>(alone, first);
        }
        for pair in pairs.chunks_exact(2 * n).rev() {
            even = load::<T, P, W>(pair, first).plus_product(even, square);
            odd = load::<T, P, W>(pair, n + first).plus_product(odd, square);
        }
        // The sum Σ y[k] τᵏ⁻¹ over k ≥ 2.
        let rest = even.plus_product(odd, tau) * tau;
        let start = load::<T, P, W>(self.start, first);
        let end = match &mut self.residues {
            Some((residue, rounding)) => {
                let (slope, slope_error) = two_sum(linear, rest);
                let increment = slope * tau;
                let (sum, sum_error) = two_sum(start, increment);
                let error = (zero - increment)
                    .plus_product(slope, tau)
                    .plus_product(slope_error, tau);
                let error = error + load::<T, P, W>(residue, first) + sum_error;
                let end = sum + error;
                store::<T, P, W>(error - (end - sum), rounding, first);
                end
            }
            None => start + (linear + rest) * tau,
        };
        store::<T, P, W>(end, self.end, first);
    }
}

/// Operation that returns, for each of the last two orders, the largest ratio of a Taylor
/// coefficient to its tolerance.
pub(in crate::integrate) struct LastTerms<'a, T> {
    /// Taylor coefficients of the last two orders.
    pub(in crate::integrate) coefficients: &'a [T],
    pub(in crate::integrate) start: &'a [T],
    pub(in crate::integrate) relative: &'a [T],
    pub(in crate::integrate) absolute: &'a [T],
    pub(in crate::integrate) ratios: &'a mut [T; 2],
}

impl<T: Real> Kernel<T> for LastTerms<'_, T> {
    type Output = ();

    #[inline(always)]
    fn run<P: Simd<T>>(self) {
        let mut largest = [[T::ZERO; 4]; 2];
        let n = self.start.len();
        let mut first = 0;
        while first + 4 <= n {
            self.block::<4>(first, &mut largest);
            first += 4;
        }
        while first + 2 <= n {
            self.block::<2>(first, &mut largest);
            first += 2;
        }
        while first < n {
            self.block::<1>(first, &mut largest);
            first += 1;
        }
        for (ratio, [a, b, c, d]) in self.ratios.iter_mut().zip(largest) {
            *ratio = a.max(b).max(c.max(d));
        }
    }
}

impl<T: Real> LastTerms<'_, T> {
    #[inline(always)]
    fn block<const W: usize>(&self, first: usize, largest: &mut [[T; 4]; 2]) {
        let n = self.start.len();
        let start = window::<T, W>(self.start, first);
        let relative = window::<T, W>(self.relative, first);
        let absolute = window::<T, W>(self.absolute, first);
        for (order, largest) in largest.iter_mut().enumerate() {
            let coefficients = window::<T, W>(self.coefficients, order * n + first);
            for i in 0..W {
                let tolerance = absolute[i] + relative[i] * start[i].abs();
                let ratio = coefficients[i].abs() / tolerance;
                // A component that is exactly zero by symmetry has no error at any tolerance, not
                // 0/0.
                let counts = coefficients[i] != T::ZERO;
                largest[i] = largest[i].max(if counts { ratio } else { T::ZERO });
            }
        }
    }
}

/// Returns the `W` values from index `first` on.
#[inline(always)]
fn window<T: Real, const W: usize>(values: &[T], first: usize) -> [T; W] {
    let rest = values.get(first..).unwrap_or_default();
    rest.first_chunk().copied().unwrap_or([T::NAN; W])
}

#[inline(always)]
fn load<T: Real, P: Simd<T>, const W: usize>(values: &[T], first: usize) -> P {
    let values = window::<T, W>(values, first);
    let mut quad = [Quad([T::ZERO; 4])];
    quad[0].0[..W].copy_from_slice(&values);
    P::load_quad(&quad, 0)
}

#[inline(always)]
fn store<T: Real, P: Simd<T>, const W: usize>(pack: P, values: &mut [T], first: usize) {
    let mut quad = [Quad([T::ZERO; 4])];
    pack.store_quad(&mut quad, 0);
    if let Some(place) = values
        .get_mut(first..)
        .and_then(<[T]>::first_chunk_mut::<W>)
    {
        place.copy_from_slice(&quad[0].0[..W]);
    }
}
