//! The recurrences of a tree.
//!
//! With S = (sin θ)'' and C = (cos θ)'' of each link, the equation of motion of
//! link i is linear in these second derivatives,
//!
//! A_ii α_i + c_i X_i − s_i Y_i + bias_i = 0,
//! X_i = Σ_j (A_ij S_j + B_ij C_j), Y_i = Σ_j (A_ij C_j − B_ij S_j),
//!
//! for a mass matrix M_ij = A_ij cos(θ_i − θ_j) + B_ij sin(θ_i − θ_j): X and Y
//! are the force, times its lever, that the links connected with i exert on it,
//! across and along the vertical. Four products of series a link are all there
//! is, for a tree of any shape and depth. In order k, S\[k\] = P + c\[0\] α\[k\]
//! where P is known, C\[k\] likewise, so that M(θ\[0\]) α\[k\] = −r with r of
//! known terms: one inverse, of order 0, serves all orders.

use super::lanes;
use super::levers::{Coupling, Levers};
use super::matrix::{Vector, invert_negative, numbers, packs, product};
use super::quad::{Kernel, Pack, Quad};
use super::rows::{SERIES, sums};
use crate::scalar::Scalar;

/// Where an expansion starts.
#[derive(Clone, Copy, Debug)]
pub struct Start<'a, T, const N: usize> {
    /// Angles θ, rad.
    pub theta: &'a [T; N],
    /// Angular velocities ω, rad/s.
    pub omega: &'a [T; N],
    /// sin θ.
    pub sines: [T; N],
    /// cos θ.
    pub cosines: [T; N],
    /// What else stands in the equation of motion, Σ M_ij α_j + … + bias_i = 0.
    pub bias: [T; N],
}

/// What stays the same in all expansions of a tree.
#[derive(Clone, Copy, Debug)]
pub struct Tree<'a, T, const N: usize> {
    /// Diagonal of the mass matrix, kg m².
    pub inertias: [T; N],
    /// The mass matrix outside the diagonal.
    pub couplings: &'a [Coupling<T>],
    /// G_i of the torque −G_i sin θ_i − F_i cos θ_i of gravity, J.
    pub weights: [T; N],
    /// F_i of the same, J.
    pub lateral_weights: [T; N],
}

/// Coefficients of one order of what a torque may depend on, of all links.
#[derive(Clone, Copy, Debug)]
pub struct Known<T, const N: usize> {
    /// Which order.
    pub order: usize,
    /// Of the angles.
    pub theta: [T; N],
    /// Of the angular velocities.
    pub omega: [T; N],
    /// Of their sines.
    pub sines: [T; N],
    /// Of their cosines.
    pub cosines: [T; N],
}

/// Quads that [`expand`] works in, for `links` links and polynomials of order
/// `order`.
#[must_use]
pub const fn workspace(links: usize, order: usize) -> usize {
    links.div_ceil(4) * (SERIES * (order + 1) + 4 * links)
}

/// Writes the Taylor coefficients of the motion from `start`, order by order:
/// those of the angles, then those of the angular velocities. `M` must be
/// ⌈N/4⌉.
///
/// `bias`, if there is one, returns the coefficient of an order of
/// [`Start::bias`]. It is called with every order from 1 on, in turn.
///
/// Where `M` or the length of `work` ([`workspace`]) does not fit, or a
/// coupling names a link that is not there, all coefficients are NaN.
///
/// Complexity: O(n² + n p) for each of p orders of n links, and O(n³) for the
/// inverse. Uses AVX2 and FMA for `f64` where the machine has them: results
/// there differ by rounding from those elsewhere.
#[inline(always)]
pub fn expand<T: Scalar, const N: usize, const M: usize, F>(
    start: &Start<'_, T, N>,
    tree: &Tree<'_, T, N>,
    coefficients: &mut [[[T; N]; 2]],
    work: &mut [Quad<T>],
    bias: Option<F>,
) where
    F: FnMut(&Known<T, N>) -> [T; N],
{
    let order = coefficients.len().saturating_sub(1);
    let (vectors, _) = work.as_chunks_mut::<M>();
    let mut links = tree.couplings.iter().flat_map(|coupling| coupling.links);
    let fits = M == N.div_ceil(4) && links.all(|link| link < N);
    if !fits || vectors.len() * M < workspace(N, order) {
        coefficients
            .as_flattened_mut()
            .as_flattened_mut()
            .fill(T::from_f64(f64::NAN));
        return;
    }
    let orders = coefficients.iter_mut();
    for (row, angles) in orders.zip([start.theta, start.omega]) {
        // Velocities of order 1 follow.
        *row = [*angles, *start.omega];
    }
    if T::SEVERAL {
        let (rows, _) = vectors.as_chunks_mut::<SERIES>();
        lanes::Orders {
            start,
            tree,
            coefficients,
            rows,
            bias,
        }
        .run();
        return;
    }
    T::run_packs(Orders {
        start,
        tree,
        coefficients,
        vectors,
        bias,
    });
}

/// The orders of an expansion from 1 on.
struct Orders<'a, T, F, const N: usize, const M: usize> {
    start: &'a Start<'a, T, N>,
    tree: &'a Tree<'a, T, N>,
    coefficients: &'a mut [[[T; N]; 2]],
    vectors: &'a mut [Vector<T, M>],
    bias: Option<F>,
}

impl<T: Scalar, F, const N: usize, const M: usize> Kernel<T> for Orders<'_, T, F, N, M>
where
    F: FnMut(&Known<T, N>) -> [T; N],
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
        let (turning, vectors) = vectors.split_at_mut(N);
        let (inverse, vectors) = vectors.split_at_mut(N);
        let (rows, _) = vectors.as_chunks_mut::<SERIES>();
        let levers = Levers::<T, N, M>::new(tree.couplings, along, across);
        levers.mass_matrix::<P>(start, &tree.inertias, inverse, turning);
        invert_negative::<T, P, N, M>(inverse);

        let zero = P::splat(T::from_f64(0.0));
        let c0: [P; M] = packs(&start.cosines);
        let s0: [P; M] = packs(&start.sines);
        let omega: [P; M] = packs(start.omega);
        let weights: [P; M] = packs(&tree.weights);
        let lateral_weights: [P; M] = packs(&tree.lateral_weights);

        // Order 1 of the series. X and Y stand two rows below their order, so
        // that all sums run over equal rows.
        let (mut c1, mut s1) = (c0, s0);
        // S and C of order 0 without their terms in α[0].
        let (mut s_known, mut c_known) = (c0, s0);
        for m in 0..M {
            c1[m] = zero.minus_product(s0[m], omega[m]);
            s1[m] = c0[m].times(omega[m]);
            let row = [omega[m], c1[m], s1[m], zero, zero];
            for (series, value) in rows[0].iter_mut().zip(row) {
                value.store(&mut series[m]);
            }
            s_known[m] = c1[m].times(omega[m]);
            c_known[m] = zero.minus_product(s1[m], omega[m]);
        }
        let mut torque: [P; M] = packs(&start.bias);
        let (x, y) = levers.forces(&s_known, &c_known);
        for m in 0..M {
            torque[m] = torque[m]
                .plus_product(weights[m], s0[m])
                .plus_product(lateral_weights[m], c0[m])
                .plus_product(c0[m], x[m])
                .minus_product(s0[m], y[m]);
        }
        let mut alpha = product::<T, P, N, M>(inverse, &torque);

        let last = coefficients.len().saturating_sub(1);
        let one = T::from_f64(1.0);
        let mut number = one;
        let mut over_next = Reciprocal::<P>::of(one);
        for k in 1..last {
            let over_k = over_next;
            let over_both = Reciprocal::<P>::of(number * (number + one));
            let ratio = P::splat((number + one + one) / number);
            number = number + one;
            over_next = Reciprocal::of(number);
            let factor = P::splat(number);

            // The torque of order k, and S, C, as far as they do not depend on
            // α[k−1]: there was time for them while that was formed.
            let (mut s_next, mut c_next) = (s_known, c_known);
            let mut torque = [zero; M];
            for m in 0..M {
                let sums = sums::<T, P, M>(&rows[1..k.max(1)], m);
                let omega_over_k = over_k.times(omega[m]);
                s_next[m] = factor
                    .times(sums.omega_cos)
                    .plus_product(omega_over_k, c_known[m]);
                c_next[m] = zero
                    .minus_product(factor, sums.omega_sin)
                    .minus_product(omega_over_k, s_known[m]);
                torque[m] = sums
                    .torque
                    .plus_product(weights[m], P::load(&rows[k - 1][2][m]))
                    .plus_product(lateral_weights[m], P::load(&rows[k - 1][1][m]));
            }
            let (x, y) = levers.forces(&s_next, &c_next);
            for m in 0..M {
                torque[m] = torque[m]
                    .plus_product(c0[m], x[m])
                    .minus_product(s0[m], y[m]);
            }

            // S, C, X, Y of order k − 1; cos, sin, θ of order k + 1, ω of k.
            let (mut s, mut c, mut turned) = (s_known, c_known, alpha);
            let mut theta = [Quad([T::from_f64(0.0); 4]); M];
            for m in 0..M {
                s[m] = s_known[m].plus_product(c0[m], alpha[m]);
                c[m] = c_known[m].minus_product(s0[m], alpha[m]);
                turned[m] = alpha[m].times(omega[m]);
                let rate = over_k.times(alpha[m]);
                let row = [rate, over_both.times(c[m]), over_both.times(s[m])];
                for (series, value) in rows[k].iter_mut().zip(row) {
                    value.store(&mut series[m]);
                }
                over_both.times(alpha[m]).store(&mut theta[m]);
            }
            numbers(&rows[k][0], &mut coefficients[k][1]);
            numbers(&theta, &mut coefficients[k + 1][0]);
            let (x, y) = levers.forces(&s, &c);
            let turned = product::<T, P, N, M>(turning, &turned);
            for m in 0..M {
                x[m].store(&mut rows[k][3][m]);
                y[m].store(&mut rows[k][4][m]);
                let newest = alpha[m].times(ratio);
                s_known[m] = s_next[m].plus_product(newest, c1[m]);
                c_known[m] = c_next[m].minus_product(newest, s1[m]);
                torque[m] = torque[m]
                    .plus_product(ratio, turned[m])
                    .plus_product(c1[m], x[m])
                    .minus_product(s1[m], y[m]);
            }
            if let Some(bias) = &mut bias {
                let [theta, omega] = coefficients[k];
                let (mut sines, mut cosines) = (theta, theta);
                numbers(&rows[k - 1][2], &mut sines);
                numbers(&rows[k - 1][1], &mut cosines);
                let others: [P; M] = packs(&bias(&Known {
                    order: k,
                    theta,
                    omega,
                    sines,
                    cosines,
                }));
                for m in 0..M {
                    torque[m] = torque[m].plus(others[m]);
                }
            }
            // M α[k] = −torque
            alpha = product::<T, P, N, M>(inverse, &torque);
        }
        if last > 0 {
            let mut omega = [Quad([T::from_f64(0.0); 4]); M];
            for m in 0..M {
                over_next.times(alpha[m]).store(&mut omega[m]);
            }
            numbers(&omega, &mut coefficients[last][1]);
        }
    }
}

/// 1/n in two parts: a rounded reciprocal would be wrong by the same amount in
/// every step of a run.
#[derive(Clone, Copy)]
struct Reciprocal<P> {
    high: P,
    /// Zero where products are not fused with the sums they go into.
    low: P,
}

impl<P> Reciprocal<P> {
    #[inline(always)]
    fn of<T: Scalar>(number: T) -> Self
    where
        P: Pack<T>,
    {
        let one = T::from_f64(1.0);
        let high = P::splat(one / number);
        let rest = P::splat(one).minus_product(P::splat(number), high);
        Self {
            high,
            low: rest.times(high),
        }
    }

    #[inline(always)]
    fn times<T: Scalar>(self, value: P) -> P
    where
        P: Pack<T>,
    {
        value.times(self.low).plus_product(value, self.high)
    }
}
