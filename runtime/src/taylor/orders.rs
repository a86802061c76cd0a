//! The orders of an expansion, one after the other.
//!
//! In order k of the recurrences of [`expand`](super::expand), with γ\[0\] = 1,
//! σ\[0\] = γ\[1\] = 0 and σ\[1\] = ω\[0\],
//!
//! X\[k\] = Σ_{0<j≤k} (σ\[j\] Y\[k−j\] − γ\[j\] X\[k−j\]) − bias\[k\],
//! C\[k\] = −(k+1) Σ_{0≤j≤k} ω\[j\] σ\[k+1−j\],
//! S\[k\] = M⁻¹ (X\[k\] + T C\[k\]), Y\[k\] = M C\[k\] + T S\[k\],
//! α\[k\] = S\[k\] − (k+1) Σ_{0≤j<k} ω\[j\] γ\[k+1−j\].
//!
//! Everything on the right is of lower orders. What order k − 1 has to do with it
//! is written apart, so that the sums are ready when that is.

use super::bias::Bias;
use super::expand::{Known, Start, Tree};
use super::levers::Levers;
use super::matrix::{Vector, add_product, invert, numbers, packs, product};
use super::quad::{Kernel, Pack, Quad};
use super::reciprocal::Reciprocal;
use super::refine::residual;
use super::rows::{SERIES, sums};
use crate::scalar::Scalar;

/// Matrices that the orders share, each of as many columns as there are links.
pub(super) const MATRICES: usize = 5;

/// From this order on the accelerations at the start are refined: the order for
/// tolerances of 1e-13, below which rounding is most of the error.
const REFINED: usize = 28;

/// The orders of an expansion from 1 on.
pub(super) struct Orders<'a, T, B, const N: usize, const M: usize> {
    pub(super) start: &'a Start<'a, T, N>,
    pub(super) tree: &'a Tree<'a, T, N>,
    pub(super) coefficients: &'a mut [[[T; N]; 2]],
    pub(super) vectors: &'a mut [Vector<T, M>],
    pub(super) bias: B,
}

impl<T: Scalar, B: Bias<T, N>, const N: usize, const M: usize> Kernel<T>
    for Orders<'_, T, B, N, M>
{
    // One index into all vectors at once.
    #[allow(clippy::needless_range_loop)]
    #[inline(always)]
    fn run<P: Pack<T>>(self) {
        let Self {
            start,
            tree,
            coefficients,
            vectors,
            mut bias,
        } = self;
        let (along, vectors) = vectors.split_at_mut(N);
        let (across, vectors) = vectors.split_at_mut(N);
        let (mass, vectors) = vectors.split_at_mut(N);
        let (inverse, vectors) = vectors.split_at_mut(N);
        let (turning, vectors) = vectors.split_at_mut(N);
        let (rows, _) = vectors.as_chunks_mut::<SERIES>();
        let levers = Levers::<T, N, M>::new(tree.couplings, along, across);
        levers.matrices::<P>(start, &tree.inertias, [mass, inverse, turning]);
        invert::<T, P, N, M>(inverse);

        // Order 0, and 1 of ω, γ, σ.
        let zero = P::splat(T::from_f64(0.0));
        let omega: [P; M] = packs(start.omega);
        let first_bias: [P; M] = packs(&start.bias);
        let weight = Weight::<P, M>::new(start, tree);
        let (mut x, mut c, mut s_rest) = ([zero; M], [zero; M], [zero; M]);
        let mut sum = [zero; M];
        for m in 0..M {
            // X with the weight in it.
            x[m] = zero.minus(first_bias[m]);
            sum[m] = x[m].minus(weight.across[m]);
            c[m] = zero.minus_product(omega[m], omega[m]);
            let row = [omega[m], zero, omega[m], zero, zero];
            for (series, value) in rows[0].iter_mut().zip(row) {
                value.store(&mut series[m]);
            }
        }
        let sum = add_product::<T, P, N, M>(&sum, turning, &c);
        let mut s = product::<T, P, N, M>(inverse, &sum);
        let last = coefficients.len().saturating_sub(1);
        if last >= REFINED {
            let rest = residual::<T, P, N, M>(start, tree, &levers, &s);
            s = add_product::<T, P, N, M>(&s, inverse, &rest);
        }
        // M C, and the weight that belongs to Y.
        let mut mass_c = add_product::<T, P, N, M>(&weight.along, mass, &c);

        let one = T::from_f64(1.0);
        let mut number = one;
        let mut over_next = Reciprocal::<P>::of(one);
        for k in 1..last {
            let over_k = over_next;
            let over_both = Reciprocal::<P>::of(number * (number + one));
            number = number + one;
            over_next = Reciprocal::of(number);
            let factor = P::splat(number);
            let (lower, new) = rows.split_at_mut(k);
            let Some(row) = new.first_mut() else { return };

            // X and C as far as they do not depend on S[k−1] and α[k−1]: there
            // was time for them while these were formed.
            let (mut x_next, mut c_next, mut s_rest_next) = ([zero; M], [zero; M], [zero; M]);
            let mut slowing = [zero; M];
            for m in 0..M {
                let sums = sums::<T, P, M>(&lower[1..], m);
                x_next[m] = sums.force;
                // ω/k, ω (k+1)/k, ω (k+2)/k
                let rate = over_k.times(omega[m]);
                let rate_1 = omega[m].plus(rate);
                slowing[m] = rate_1.plus(rate);
                s_rest_next[m] = factor.times(sums.omega_cos).plus_product(rate, c[m]);
                c_next[m] = rate_1
                    .times(s_rest[m])
                    .minus_product(factor, sums.omega_sin);
            }

            let mut y = product::<T, P, N, M>(turning, &s);
            for m in 0..M {
                y[m] = y[m].plus(mass_c[m]);
                x_next[m] = x_next[m].plus_product(omega[m], y[m]);
                c_next[m] = c_next[m].minus_product(slowing[m], s[m]);
            }
            mass_c = product::<T, P, N, M>(mass, &c_next);
            let mut theta = [Quad([T::from_f64(0.0); 4]); M];
            for m in 0..M {
                let alpha = s[m].minus(s_rest[m]);
                let (cos, sin) = (over_both.times(c[m]), over_both.times(s[m]));
                let new = [over_k.times(alpha), cos, sin, x[m], y[m]];
                for (series, value) in row.iter_mut().zip(new) {
                    value.store(&mut series[m]);
                }
                over_both.times(alpha).store(&mut theta[m]);
            }
            numbers(&row[0], &mut coefficients[k][1]);
            numbers(&theta, &mut coefficients[k + 1][0]);
            if B::MOVES {
                let known = known::<T, P, N, M>(k, start, &coefficients[k], &lower[k - 1]);
                let others: [P; M] = packs(&bias.at(&known));
                for m in 0..M {
                    x_next[m] = x_next[m].minus(others[m]);
                }
            }
            let sum = add_product::<T, P, N, M>(&x_next, turning, &c_next);
            s = product::<T, P, N, M>(inverse, &sum);
            (x, c, s_rest) = (x_next, c_next, s_rest_next);
        }
        if last > 0 {
            let mut omega = [Quad([T::from_f64(0.0); 4]); M];
            for m in 0..M {
                let alpha = s[m].minus(s_rest[m]);
                over_next.times(alpha).store(&mut omega[m]);
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
    fn new<T: Scalar, const N: usize>(start: &Start<'_, T, N>, tree: &Tree<'_, T, N>) -> Self
    where
        P: Pack<T>,
    {
        let cosines: [P; M] = packs(&start.cosines);
        let sines: [P; M] = packs(&start.sines);
        let weights: [P; M] = packs(&tree.weights);
        let lateral: [P; M] = packs(&tree.lateral_weights);
        let (mut across, mut along) = (cosines, sines);
        for m in 0..M {
            across[m] = weights[m]
                .times(sines[m])
                .plus_product(lateral[m], cosines[m]);
            along[m] = lateral[m]
                .times(sines[m])
                .minus_product(weights[m], cosines[m]);
        }
        Self { across, along }
    }
}

/// What a torque may depend on, in order k; `row` has γ and σ of that order.
#[inline(always)]
fn known<T: Scalar, P: Pack<T>, const N: usize, const M: usize>(
    k: usize,
    start: &Start<'_, T, N>,
    [theta, omega]: &[[T; N]; 2],
    row: &[Vector<T, M>; SERIES],
) -> Known<T, N> {
    let c0: [P; M] = packs(&start.cosines);
    let s0: [P; M] = packs(&start.sines);
    let (mut sine, mut cosine) = (row[2], row[1]);
    for m in 0..M {
        let (cos, sin) = (P::load(&row[1][m]), P::load(&row[2][m]));
        let (upright, level) = (c0[m].times(cos), c0[m].times(sin));
        level.plus_product(s0[m], cos).store(&mut sine[m]);
        upright.minus_product(s0[m], sin).store(&mut cosine[m]);
    }
    let (mut sines, mut cosines) = (*theta, *theta);
    numbers(&sine, &mut sines);
    numbers(&cosine, &mut cosines);
    Known {
        order: k,
        theta: *theta,
        omega: *omega,
        sines,
        cosines,
    }
}
