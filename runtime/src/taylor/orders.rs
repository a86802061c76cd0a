//! The orders of an expansion, one after the other.

use super::bias::Bias;
use super::expand::{Known, Start, Tree};
use super::levers::Levers;
use super::matrix::{Vector, add_product, invert, numbers, packs, product};
use super::quad::{Kernel, Pack, Quad};
use super::reciprocal::Reciprocal;
use super::rows::{SERIES, sums};
use crate::scalar::Scalar;

/// Matrices that the orders share, each of so many columns as there are links.
pub(super) const MATRICES: usize = 7;

/// The orders of an expansion from 1 on.
pub(super) struct Orders<'a, T, B, const N: usize, const M: usize> {
    pub(super) start: &'a Start<'a, T, N>,
    pub(super) tree: &'a Tree<'a, T, N>,
    pub(super) coefficients: &'a mut [[[T; N]; 2]],
    pub(super) vectors: &'a mut [Vector<T, M>],
    pub(super) bias: B,
}

impl<T: Scalar, B: Bias<T, N>, const N: usize, const M: usize> Kernel<T> for Orders<'_, T, B, N, M> {
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
        let (turning, vectors) = vectors.split_at_mut(N);
        let (inverse, vectors) = vectors.split_at_mut(N);
        let (leaning, vectors) = vectors.split_at_mut(N);
        let (swinging, vectors) = vectors.split_at_mut(N);
        let (rows, _) = vectors.as_chunks_mut::<SERIES>();

        let zero = P::splat(T::from_f64(0.0));
        let c0: [P; M] = packs(&start.cosines);
        let s0: [P; M] = packs(&start.sines);
        let omega: [P; M] = packs(start.omega);

        let levers = Levers::<T, N, M>::new(tree.couplings, along, across);
        levers.mass_matrix::<P>(start, &tree.inertias, mass, turning);
        inverse.copy_from_slice(mass);
        invert::<T, P, N, M>(inverse);
        // Order 0
        let weights: [P; M] = packs(&tree.weights);
        let lateral_weights: [P; M] = packs(&tree.lateral_weights);
        let bias_0: [P; M] = packs(&start.bias);
        let (mut x, mut c, mut s_known) = ([zero; M], [zero; M], [zero; M]);
        for m in 0..M {
            x[m] = zero.minus(bias_0[m]).minus_product(weights[m], s0[m]).minus_product(lateral_weights[m], c0[m]);
            c[m] = zero.minus_product(omega[m], omega[m]);
        }
        let t = add_product::<T, P, N, M>(&x, turning, &c);
        let mut s = product::<T, P, N, M>(inverse, &t);
        // with gravity folded
        let mut fold = [zero; M];
        for m in 0..M {
            x[m] = zero.minus(bias_0[m]);
            fold[m] = lateral_weights[m].times(s0[m]).minus_product(weights[m], c0[m]);
            for (series, value) in rows[0].iter_mut().zip([omega[m], zero, omega[m], zero, zero]) {
                value.store(&mut series[m]);
            }
        }

        let mut mass_c = add_product::<T, P, N, M>(&fold, mass, &c);

        let last = coefficients.len().saturating_sub(1);
        let one = T::from_f64(1.0);
        let mut number = one;
        let mut over_next = Reciprocal::<P>::of(one);
        for k in 1..last {
            let over_k = over_next;
            let over_both = Reciprocal::<P>::of(number * (number + one));
            number = number + one;
            over_next = Reciprocal::of(number);
            let factor = P::splat(number);
            let (done, new) = rows.split_at_mut(k);
            let Some((row, _)) = new.split_first_mut() else { return };

            let (mut x_next, mut x_known, mut c_next, mut s_next, mut rate_2) =
                ([zero; M], [zero; M], [zero; M], [zero; M], [zero; M]);
            for m in 0..M {
                let sums = sums::<T, P, M>(&done[1..], m);
                let rate = over_k.times(omega[m]);
                let rate_1 = omega[m].plus(rate);
                rate_2[m] = rate_1.plus(rate);
                s_next[m] = factor.times(sums.omega_cos).plus_product(rate, c[m]);
                c_next[m] = rate_1
                    .times(s_known[m])
                    .minus_product(factor, sums.omega_sin);
                x_next[m] = sums.force;
            }
            // s
            let y = add_product::<T, P, N, M>(&mass_c, turning, &s);
            for m in 0..M {
                c_next[m] = c_next[m].minus_product(rate_2[m], s[m]);
                x_known[m] = x_next[m].plus_product(omega[m], y[m]);
            }
            let leant = product::<T, P, N, M>(turning, &c_next);
            mass_c = product::<T, P, N, M>(mass, &c_next);
            let mut theta = [Quad([T::from_f64(0.0); 4]); M];
            for m in 0..M {
                let alpha = s[m].minus(s_known[m]);
                let new = [over_k.times(alpha), over_both.times(c[m]), over_both.times(s[m]), x[m], y[m]];
                for (series, value) in row.iter_mut().zip(new) {
                    value.store(&mut series[m]);
                }
                over_both.times(alpha).store(&mut theta[m]);
            }
            numbers(&row[0], &mut coefficients[k][1]);
            numbers(&theta, &mut coefficients[k + 1][0]);
            for m in 0..M {
                x[m] = x_known[m];
            }
            if B::MOVES {
                let [theta, omega] = coefficients[k];
                let (mut sines, mut cosines) = (theta, theta);
                let previous = &done[k - 1];
                let (mut sine, mut cosine) = ([Quad([T::from_f64(0.0); 4]); M], [Quad([T::from_f64(0.0); 4]); M]);
                for m in 0..M {
                    let (a, b) = (P::load(&previous[1][m]), P::load(&previous[2][m]));
                    s0[m].times(a).plus_product(c0[m], b).store(&mut sine[m]);
                    c0[m].times(a).minus_product(s0[m], b).store(&mut cosine[m]);
                }
                numbers(&sine, &mut sines);
                numbers(&cosine, &mut cosines);
                let others: [P; M] = packs(&bias.at(&Known {
                    order: k,
                    theta,
                    omega,
                    sines,
                    cosines,
                }));
                for m in 0..M {
                    x[m] = x[m].minus(others[m]);
                }
            }
            let mut sum = x;
            for m in 0..M { sum[m] = sum[m].plus(leant[m]); }
            s = product::<T, P, N, M>(inverse, &sum);
            c = c_next;
            s_known = s_next;
        }
        if last > 0 {
            let mut omega = [Quad([T::from_f64(0.0); 4]); M];
            for m in 0..M {
                over_next.times(s[m].minus(s_known[m])).store(&mut omega[m]);
            }
            numbers(&omega, &mut coefficients[last][1]);
        }
    }
}
