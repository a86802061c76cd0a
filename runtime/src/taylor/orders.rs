//! The orders of an expansion, one after the other.
//!
//! In order k of the recurrences of [`expand`](super::expand), with γ\[0\] = 1,
//! σ\[0\] = γ\[1\] = 0 and σ\[1\] = ω\[0\],
//!
//! X\[k\] = Σ_{0<j≤k} (σ\[j\] Y\[k−j\] − γ\[j\] X\[k−j\]) − bias\[k\],
//! C\[k\] = −(k+1) Σ_{0≤j≤k} ω\[j\] σ\[k+1−j\],
//! α\[k\] = S\[k\] − (k+1) Σ_{0≤j<k} ω\[j\] γ\[k+1−j\],
//!
//! and S\[k\] and Y\[k\] follow by [`elimination`](super::elimination). Everything
//! on the right is of lower orders. What order k − 1 has to do with it is written
//! apart, so that the sums are ready when that is.

use super::bias::Bias;
use super::elimination::{LinkColumn, LinkFactors, TaylorElimination};
use super::expand::{Connectivity, KnownOrder, LinkConstants, Start};
use super::reciprocal::Reciprocal;
use super::refine::residual;
use super::series::{SeriesRow, SeriesSums, store, turned};
use crate::scalar::Scalar;
use crate::simd::{Kernel, Quad, Simd};
use core::marker::PhantomData;

/// From this order on the accelerations at the start are refined: the order for
/// tolerances of 1e-13, below which rounding is most of the error.
const REFINED: usize = 28;

/// Number of links up to which one state has its sums formed order by order, from which
/// two orders at a time: for more links the machine computes more than it waits.
const IN_TURN: usize = 15;

/// The orders of an expansion from 1 on, of N links in Q quads of memory and M packs.
pub(super) struct Orders<'a, T, C, B, const N: usize, const Q: usize, const M: usize> {
    start: &'a Start<'a, T, N>,
    constants: &'a LinkConstants<T, N>,
    coefficients: &'a mut [[[T; N]; 2]],
    rows: &'a mut [SeriesRow<T>],
    factors: &'a mut [LinkFactors<T>; N],
    bias: B,
    connectivity: PhantomData<C>,
}

impl<T, C, B, const N: usize, const Q: usize, const M: usize> Kernel<T>
    for Orders<'_, T, C, B, N, Q, M>
where
    T: Scalar,
    C: Connectivity<N>,
    B: Bias<T, N>,
{
    type Output = ();

    #[inline(always)]
    fn run<P: Simd<T>>(self) {
        self.form::<P, P, false>();
    }
}

impl<'a, T, C, B, const N: usize, const Q: usize, const M: usize> Orders<'a, T, C, B, N, Q, M>
where
    T: Scalar,
    C: Connectivity<N>,
    B: Bias<T, N>,
{
    #[inline(always)]
    pub(super) fn new(
        start: &'a Start<'a, T, N>,
        constants: &'a LinkConstants<T, N>,
        coefficients: &'a mut [[[T; N]; 2]],
        rows: &'a mut [SeriesRow<T>],
        factors: &'a mut [LinkFactors<T>; N],
        bias: B,
    ) -> Self {
        Self {
            start,
            constants,
            coefficients,
            rows,
            factors,
            bias,
            connectivity: PhantomData,
        }
    }

    /// Forms them, in M packs, of numbers that are `SEVERAL` states or one. No closure
    /// takes part but the caller's: what is not inlined is compiled without the
    /// registers. For the same reason the bias is asked for in one place.
    // One index into all vectors at once.
    #[allow(clippy::needless_range_loop)]
    #[inline(always)]
    pub(super) fn form<P: Simd<T>, V: Simd<T>, const SEVERAL: bool>(self) {
        let Self {
            start,
            constants,
            coefficients,
            rows,
            factors,
            mut bias,
            connectivity: _,
        } = self;
        let orders = coefficients.len();
        let last = orders.saturating_sub(1);
        // Packs of a quad.
        let packs_of_four = 4 / P::LANES;
        let system = TaylorElimination::new::<C, P::One>(start, constants, factors);

        // Order 0, and 1 of ω, γ, σ.
        let zero = P::splat(T::from_f64(0.0));
        let omega: [P; M] = packs::<T, P, N, Q, M>(start.omega);
        let first_bias: [P; M] = packs::<T, P, N, Q, M>(&start.bias);
        let weight = Weight::<P, M>::new::<T, N, Q>(start, constants);
        let (mut x, mut c, mut s_rest) = ([zero; M], [zero; M], [zero; M]);
        let mut force = [zero; M];
        for m in 0..M {
            // X with the weight in it.
            x[m] = zero - first_bias[m];
            force[m] = x[m] - weight.across[m];
            c[m] = zero.minus_product(omega[m], omega[m]);
            let (row, place) = (m / packs_of_four * orders, m % packs_of_four);
            store(
                [omega[m], zero, omega[m], zero, zero],
                &mut rows[row],
                place,
            );
        }
        let [mut s, mut y] = system.solution::<C, P, V, Q, M>(&force, &c);
        for m in 0..M {
            y[m] = y[m] + weight.along[m];
        }
        if last >= REFINED {
            let rest = residual::<T, C, P, N, Q, M>(start, constants, &s);
            let [more_s, more_y] = system.solution::<C, P, V, Q, M>(&rest, &[zero; M]);
            for m in 0..M {
                (s[m], y[m]) = (s[m] + more_s[m], y[m] + more_y[m]);
            }
        }

        let one = P::from_f64(1.0);
        let mut number = one;
        let mut over_next = Reciprocal::of(one);
        let [mut sums, mut next_sums] = [[SeriesSums::<P>::none(); M]; 2];
        for k in 1..last {
            let over_k = over_next;
            let over_both = Reciprocal::of(number * (number + one));
            number = number + one;
            over_next = Reciprocal::of(number);

            // X and C as far as they do not depend on S[k−1] and α[k−1]: there
            // was time for them while these were formed.
            for m in 0..M {
                let lower = &rows[m / packs_of_four * orders..][..k];
                let place = m % packs_of_four;
                if !SEVERAL && N <= IN_TURN {
                    sums[m] = SeriesSums::of(&lower[1..], place);
                } else if k % 2 == 1 {
                    [sums[m], next_sums[m]] = SeriesSums::pair(lower, place);
                } else {
                    sums[m] = next_sums[m];
                    sums[m].complete(lower, place);
                }
            }
            let [mut theta, mut velocity] = [[Quad::splat(T::from_f64(0.0)); Q]; 2];
            for m in 0..M {
                let alpha = s[m] - s_rest[m];
                let (cos, sin) = (over_both.times(c[m]), over_both.times(s[m]));
                let rise = over_k.times(alpha);
                let (row, place) = (m / packs_of_four * orders + k, m % packs_of_four);
                store([rise, cos, sin, x[m], y[m]], &mut rows[row], place);
                rise.store_quad(&mut velocity, m);
                over_both.times(alpha).store_quad(&mut theta, m);

                // ω/k, ω (k+1)/k, ω (k+2)/k
                let rate = over_k.times(omega[m]);
                let rate_1 = omega[m] + rate;
                let slowing = rate_1 + rate;
                x[m] = sums[m].force().plus_product(omega[m], y[m]);
                let s_rest_next = (number * sums[m].omega_cos).plus_product(rate, c[m]);
                c[m] = (rate_1 * s_rest[m])
                    .minus_product(number, sums[m].omega_sin)
                    .minus_product(slowing, s[m]);
                s_rest[m] = s_rest_next;
            }
            numbers(&velocity, &mut coefficients[k][1]);
            numbers(&theta, &mut coefficients[k + 1][0]);
            if B::MOVES {
                let known = known::<T, P, N, Q, M>(k, start, &coefficients[k], rows, orders);
                let others: [P; M] = packs::<T, P, N, Q, M>(&bias.at(&known));
                for m in 0..M {
                    x[m] = x[m] - others[m];
                }
            }
            [s, y] = system.solution::<C, P, V, Q, M>(&x, &c);
        }
        if last > 0 {
            let mut omega = [Quad::splat(T::from_f64(0.0)); Q];
            for m in 0..M {
                let alpha = s[m] - s_rest[m];
                over_next.times(alpha).store_quad(&mut omega, m);
            }
            numbers(&omega, &mut coefficients[last][1]);
        }
    }
}

/// Gravity is a constant force: its torque (G s₀ + F c₀) γ + (G c₀ − F s₀) σ, with
/// s₀, c₀ of the angle at the start, is that of an X and of a Y of order 0.
struct Weight<P, const M: usize> {
    across: [P; M],
    along: [P; M],
}

impl<P, const M: usize> Weight<P, M> {
    #[inline(always)]
    fn new<T: Scalar, const N: usize, const Q: usize>(
        start: &Start<'_, T, N>,
        constants: &LinkConstants<T, N>,
    ) -> Self
    where
        P: Simd<T>,
    {
        let cosines: [P; M] = packs::<T, P, N, Q, M>(&start.cosines);
        let sines: [P; M] = packs::<T, P, N, Q, M>(&start.sines);
        let weights: [P; M] = packs::<T, P, N, Q, M>(&constants.weights);
        let lateral: [P; M] = packs::<T, P, N, Q, M>(&constants.lateral_weights);
        let (mut across, mut along) = (cosines, sines);
        for m in 0..M {
            across[m] = (weights[m] * sines[m]).plus_product(lateral[m], cosines[m]);
            along[m] = (lateral[m] * sines[m]).minus_product(weights[m], cosines[m]);
        }
        Self { across, along }
    }
}

/// State that a torque may depend on, in order k.
#[inline(always)]
fn known<T: Scalar, P: Simd<T>, const N: usize, const Q: usize, const M: usize>(
    k: usize,
    start: &Start<'_, T, N>,
    [theta, omega]: &[[T; N]; 2],
    rows: &[SeriesRow<T>],
    orders: usize,
) -> KnownOrder<T, N> {
    let c0: [P; M] = packs::<T, P, N, Q, M>(&start.cosines);
    let s0: [P; M] = packs::<T, P, N, Q, M>(&start.sines);
    let [mut sine, mut cosine] = [[Quad::splat(T::from_f64(0.0)); Q]; 2];
    for m in 0..M {
        let packs_of_four = 4 / P::LANES;
        let row = &rows[m / packs_of_four * orders + k - 1];
        let [cos, sin] = turned::<T, P>(row, m % packs_of_four);
        let (upright, level) = (c0[m] * cos, c0[m] * sin);
        level.plus_product(s0[m], cos).store_quad(&mut sine, m);
        upright.minus_product(s0[m], sin).store_quad(&mut cosine, m);
    }
    let (mut sines, mut cosines) = (*theta, *theta);
    numbers(&sine, &mut sines);
    numbers(&cosine, &mut cosines);
    KnownOrder {
        order: k,
        theta: *theta,
        omega: *omega,
        sines,
        cosines,
    }
}

/// Numbers of all links as packs, zero where there is no link.
#[inline(always)]
pub(super) fn packs<T: Scalar, P: Simd<T>, const N: usize, const Q: usize, const M: usize>(
    numbers: &[T; N],
) -> [P; M] {
    let mut column = [Quad::splat(T::from_f64(0.0)); Q];
    for (i, number) in numbers.iter().enumerate() {
        column[i / 4].0[i % 4] = *number;
    }
    let mut packs = [P::splat(T::from_f64(0.0)); M];
    for (m, pack) in packs.iter_mut().enumerate() {
        *pack = P::load_quad(&column, m);
    }
    packs
}

/// The numbers of all links.
#[inline(always)]
fn numbers<T: Scalar, const N: usize, const Q: usize>(column: &LinkColumn<T, Q>, out: &mut [T; N]) {
    for (i, out) in out.iter_mut().enumerate() {
        *out = column[i / 4].0[i % 4];
    }
}
