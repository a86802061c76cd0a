//! The equations of motion of one order, solved by elimination along the tree.
//!
//! This is the articulated recursion of physics §10, (10.4) to (10.8), where what
//! stands for ω̇ and −ω² are S and C: with v = e^(iθ) at the start, m = (h + i e) v
//! of each link, r = (ℓ + i w) v_parent, and a the acceleration of the link's pivot,
//!
//! a_c = a + (S − i C) r_c, F = (S − i C) m + Σ F_c,
//! X = M S + m·a + Σ r_c·F_c, Y = M C − m × a − Σ r_c × F_c,
//!
//! sums over the children c. What the matrix of this system becomes by elimination
//! depends on the angles at the start alone and serves all orders:
//!
//! b = m − Σ N_c r_c, g = i m − Σ N_c i r_c, N = Σ N_c + b bᵀ/J,
//! J = M − Σ r_c·N_c r_c, K = M − Σ r_c × N_c i r_c, q = Σ r_c × N_c r_c.
//!
//! With n = b/J, the forces f and the torques t that a link hands to its parent, and
//! their sums T and F over the children, an order takes one pass from the leaves to the
//! root and one back,
//!
//! τ = X − q C + T, f = F − g C + n τ, t = −r·f, e = −r × f,
//! S = τ/J − n·a, Y = K C + q τ/J − (g + q n)·a + Σ e_c.
//!
//! The share of a link alone in what it hands up, and all that comes after the passes, is
//! computed for several links at once; what goes from link to link is no more than the
//! sums of what they hand up, and a. A single state waits for that: it is written so that
//! few operations follow each other.

// One index into all arrays at once.
#![allow(clippy::needless_range_loop)]

use super::eliminated_link::EliminatedLink;
use super::expand::{Connectivity, LinkConstants, Start};
use super::linear::OrderSystem;
use crate::scalar::Scalar;
use crate::simd::{Quad, Simd};

/// A number of each link.
pub(super) type LinkColumn<T, const Q: usize> = [Quad<T>; Q];

/// A vector of each link.
type Vectors<T, const Q: usize> = [LinkColumn<T, Q>; 2];

/// The factors at a start.
pub(super) struct TaylorElimination<T, const Q: usize> {
    /// 1/J
    inverse_inertia: LinkColumn<T, Q>,
    /// K
    inertia_along: LinkColumn<T, Q>,
    /// q
    product: LinkColumn<T, Q>,
    /// n
    response: Vectors<T, Q>,
    /// g
    moment_along: Vectors<T, Q>,
    /// g + q n
    reduced_moment_along: Vectors<T, Q>,
    /// r
    reach: Vectors<T, Q>,
    /// r·n and r × n: of −t and −e, for each X and T.
    of_force: Vectors<T, Q>,
    /// r·(g + q n) and r × (g + q n): of t and e, for each C.
    of_cosine: Vectors<T, Q>,
}

impl<T: Scalar, const N: usize, const Q: usize> OrderSystem<T, N> for TaylorElimination<T, Q> {
    /// Eliminates from the leaves to the root, link by link.
    #[inline(always)]
    fn new<C: Connectivity<N>, W: Simd<T>>(
        start: &Start<'_, T, N>,
        constants: &LinkConstants<T, N>,
    ) -> Self {
        let empty = [Quad::splat(T::from_f64(0.0)); Q];
        let mut factors = Self {
            inverse_inertia: empty,
            inertia_along: empty,
            product: empty,
            response: [empty; 2],
            moment_along: [empty; 2],
            reduced_moment_along: [empty; 2],
            reach: [empty; 2],
            of_force: [empty; 2],
            of_cosine: [empty; 2],
        };
        let one = W::One::from_f64(1.0);
        let mut links = [EliminatedLink::<W::One>::none(); N];
        for i in 0..N {
            let inertia = W::One::splat(constants.inertias[i]);
            let turn = [start.cosines[i], start.sines[i]].map(W::One::splat);
            let moment = turned::<T, W::One>(constants.moments[i], turn, C::LATERAL);
            links[i] = EliminatedLink::alone(inertia, moment);
        }
        for i in (0..N).rev() {
            let mut link = links[i];
            let inverse = one / link.inertia;
            let response = link.moment.map(|b| b * inverse);
            let mut reduced = link.moment_along;
            for x in 0..2 {
                reduced[x] = reduced[x].plus_product(link.product, response[x]);
            }
            inverse.store_quad(&mut factors.inverse_inertia, i);
            link.inertia_along.store_quad(&mut factors.inertia_along, i);
            link.product.store_quad(&mut factors.product, i);
            store::<T, W::One, Q>(response, &mut factors.response, i);
            store::<T, W::One, Q>(link.moment_along, &mut factors.moment_along, i);
            store::<T, W::One, Q>(reduced, &mut factors.reduced_moment_along, i);
            if i > 0 {
                let parent = C::PARENTS[i];
                let turn = [start.cosines[parent], start.sines[parent]].map(W::One::splat);
                let reach = turned::<T, W::One>(constants.attachments[i], turn, C::LATERAL);
                store::<T, W::One, Q>(reach, &mut factors.reach, i);
                store::<T, W::One, Q>(products(reach, response), &mut factors.of_force, i);
                store::<T, W::One, Q>(products(reach, reduced), &mut factors.of_cosine, i);
                link.relieve(response);
                links[parent].carry(link.deficit, reach);
            }
        }
        factors
    }

    #[inline(always)]
    fn add_solution<C: Connectivity<N>, P: Simd<T>, const M: usize>(
        &self,
        [mut s, mut y]: [[P; M]; 2],
        force: &[P; M],
        cosine: &[P; M],
    ) -> [[P; M]; 2] {
        let empty = [Quad::splat(T::from_f64(0.0)); Q];
        let mut own = Handed {
            torque: empty,
            along: empty,
            pull: [empty; 2],
        };
        let (mut share, mut cosines) = (empty, empty);
        for m in 0..M {
            let (x, c) = (force[m], cosine[m]);
            let torque = x.minus_product(P::load_quad(&self.product, m), c);
            (torque * P::load_quad(&self.inverse_inertia, m)).store_quad(&mut share, m);
            c.store_quad(&mut cosines, m);
            for (side, handed) in [&mut own.torque, &mut own.along].into_iter().enumerate() {
                (P::load_quad(&self.of_cosine[side], m) * c)
                    .minus_product(P::load_quad(&self.of_force[side], m), x)
                    .store_quad(handed, m);
                (P::load_quad(&self.response[side], m) * torque)
                    .minus_product(P::load_quad(&self.moment_along[side], m), c)
                    .store_quad(&mut own.pull[side], m);
            }
        }
        let sums = self.to_root::<C, P::One, N>(&own);
        let fall = self.to_leaves::<C, P::One, N>(&share, &sums.torque, &cosines);

        for m in 0..M {
            let inverse = P::load_quad(&self.inverse_inertia, m);
            let share =
                P::load_quad(&share, m).plus_product(P::load_quad(&sums.torque, m), inverse);
            let [a_x, a_y] = load::<T, P, Q>(&fall, m);
            let [n_x, n_y] = load::<T, P, Q>(&self.response, m);
            let own_s = share.minus_product(n_x, a_x).minus_product(n_y, a_y);
            s[m] = s[m] + own_s;
            let [g_x, g_y] = load::<T, P, Q>(&self.reduced_moment_along, m);
            y[m] = (y[m] + P::load_quad(&sums.along, m))
                .plus_product(P::load_quad(&self.inertia_along, m), cosine[m])
                .plus_product(P::load_quad(&self.product, m), share)
                .minus_product(g_x, a_x)
                .minus_product(g_y, a_y);
        }
        [s, y]
    }
}

impl<T: Scalar, const Q: usize> TaylorElimination<T, Q> {
    /// From the leaves to the root: the sums of what the children of each link hand up,
    /// from what each would hand up without children.
    #[inline(always)]
    fn to_root<C: Connectivity<N>, P: Simd<T>, const N: usize>(
        &self,
        own: &Handed<T, Q>,
    ) -> Handed<T, Q> {
        let empty = [Quad::splat(T::from_f64(0.0)); Q];
        let mut sums = Handed {
            torque: empty,
            along: empty,
            pull: [empty; 2],
        };
        for i in (1..N).rev() {
            let mut torque = P::load_quad(&own.torque, i);
            let mut along = P::load_quad(&own.along, i);
            let [mut f_x, mut f_y] = load::<T, P, Q>(&own.pull, i);
            if C::CARRIES[i] {
                let sum = P::load_quad(&sums.torque, i);
                let [sum_x, sum_y] = load::<T, P, Q>(&sums.pull, i);
                let [r_x, r_y] = load::<T, P, Q>(&self.reach, i);
                let [n_x, n_y] = load::<T, P, Q>(&self.response, i);
                let [across, turn] = load::<T, P, Q>(&self.of_force, i);
                torque = torque
                    .minus_product(r_x, sum_x)
                    .minus_product(r_y, sum_y)
                    .minus_product(across, sum);
                along = along
                    .minus_product(r_x, sum_y)
                    .plus_product(r_y, sum_x)
                    .minus_product(turn, sum);
                f_x = (f_x + sum_x).plus_product(n_x, sum);
                f_y = (f_y + sum_y).plus_product(n_y, sum);
            }
            let parent = C::PARENTS[i];
            add::<T, P, Q>(&mut sums.torque, parent, torque);
            add::<T, P, Q>(&mut sums.along, parent, along);
            add::<T, P, Q>(&mut sums.pull[0], parent, f_x);
            add::<T, P, Q>(&mut sums.pull[1], parent, f_y);
        }
        sums
    }

    /// From the root to the leaves: the accelerations a.
    #[inline(always)]
    fn to_leaves<C: Connectivity<N>, P: Simd<T>, const N: usize>(
        &self,
        share: &LinkColumn<T, Q>,
        torque: &LinkColumn<T, Q>,
        cosines: &LinkColumn<T, Q>,
    ) -> Vectors<T, Q> {
        let zero = P::splat(T::from_f64(0.0));
        let mut fall = [[Quad::splat(T::from_f64(0.0)); Q]; 2];
        // Of links that have children.
        let mut sines = [zero; N];
        for i in 0..N {
            if i > 0 {
                let parent = C::PARENTS[i];
                let (s, c) = (sines[parent], P::load_quad(cosines, parent));
                let [r_x, r_y] = load::<T, P, Q>(&self.reach, i);
                let [a_x, a_y] = load::<T, P, Q>(&fall, parent);
                let a_x = a_x.plus_product(r_y, c).plus_product(r_x, s);
                let a_y = a_y.minus_product(r_x, c).plus_product(r_y, s);
                store::<T, P, Q>([a_x, a_y], &mut fall, i);
            }
            if C::CARRIES[i] {
                let inverse = P::load_quad(&self.inverse_inertia, i);
                let share = P::load_quad(share, i).plus_product(P::load_quad(torque, i), inverse);
                let [a_x, a_y] = load::<T, P, Q>(&fall, i);
                let [n_x, n_y] = load::<T, P, Q>(&self.response, i);
                sines[i] = share.minus_product(n_x, a_x).minus_product(n_y, a_y);
            }
        }
        fall
    }
}

/// Numbers that links hand to their parents, or the sums of those that they get.
struct Handed<T, const Q: usize> {
    /// t
    torque: LinkColumn<T, Q>,
    /// e
    along: LinkColumn<T, Q>,
    /// f
    pull: Vectors<T, Q>,
}

/// (p + i q) e^(iθ) of a link in this direction.
#[inline(always)]
fn turned<T: Scalar, P: Simd<T>>([p, q]: [T; 2], [cos, sin]: [P; 2], lateral: bool) -> [P; 2] {
    let p = P::splat(p);
    let [x, y] = [p * cos, p * sin];
    if lateral {
        let q = P::splat(q);
        [x.minus_product(q, sin), y.plus_product(q, cos)]
    } else {
        [x, y]
    }
}

/// u·w and u × w.
#[inline(always)]
fn products<P: Scalar>([u_x, u_y]: [P; 2], [w_x, w_y]: [P; 2]) -> [P; 2] {
    [
        (u_x * w_x).plus_product(u_y, w_y),
        (u_x * w_y).minus_product(u_y, w_x),
    ]
}

/// Adds to the number of a link.
#[inline(always)]
fn add<T: Scalar, P: Simd<T>, const Q: usize>(column: &mut LinkColumn<T, Q>, i: usize, value: P) {
    (P::load_quad(column, i) + value).store_quad(column, i);
}

#[inline(always)]
fn load<T: Scalar, P: Simd<T>, const Q: usize>(vectors: &Vectors<T, Q>, i: usize) -> [P; 2] {
    [P::load_quad(&vectors[0], i), P::load_quad(&vectors[1], i)]
}

#[inline(always)]
fn store<T: Scalar, P: Simd<T>, const Q: usize>(
    [x, y]: [P; 2],
    vectors: &mut Vectors<T, Q>,
    i: usize,
) {
    x.store_quad(&mut vectors[0], i);
    y.store_quad(&mut vectors[1], i);
}
