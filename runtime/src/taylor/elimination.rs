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
//! Let n = b/J and p = g + q n. A link hands a torque t, its share e in the parent's Y
//! and a force f to its parent; T, E, F are the sums of what it gets. In quads, with the
//! unit vectors of the last two places in H_x and H_y,
//!
//! (t, e, f) = (−r·n, −r × n, n) (X + T) + (r·p, r × p, −p) C + H_x F_x + H_y F_y,
//! (S, Y, a) = (1, q, 0) (X + T)/J + (−q/J, K − q²/J, 0) C + (0, E, 0)
//!   + (−r·n, −r·p, r) S' + (r × n, r × p, −i r) C' + A_x a'_x + A_y a'_y
//!
//! with S', C', a' of the parent. An order takes one pass from the leaves to the root
//! and one back, and in each a link takes four products of quads. The matrix of the
//! second pass is that of the first one, transposed, but for signs.

// One index into all arrays at once.
#![allow(clippy::needless_range_loop)]

use super::eliminated_link::EliminatedLink;
use super::expand::{Connectivity, LinkConstants, Start};
use crate::scalar::Scalar;
use crate::simd::{Quad, Simd};

/// A number of each link.
pub(super) type LinkColumn<T, const Q: usize> = [Quad<T>; Q];

/// The factors of a link at a start, in quads: of X + T and of C in what goes up; of F
/// there; of X + T and of C in the link's own share of S and Y; of the parent's S and C,
/// and of its a.
pub(super) type LinkFactors<T> = [[Quad<T>; 2]; 5];

/// Quads of [`LinkFactors`].
pub(super) const FACTORS: usize = 10;

/// The factors at a start, of each link.
pub(super) struct TaylorElimination<'a, T, const N: usize>(&'a mut [LinkFactors<T>; N]);

impl<'a, T: Scalar, const N: usize> TaylorElimination<'a, T, N> {
    /// Eliminates from the leaves to the root, link by link.
    #[inline(always)]
    pub(super) fn new<C: Connectivity<N>, P: Simd<T>>(
        start: &Start<'_, T, N>,
        constants: &LinkConstants<T, N>,
        factors: &'a mut [LinkFactors<T>; N],
    ) -> Self {
        let (zero, one) = (P::from_f64(0.0), P::from_f64(1.0));
        let mut links = [EliminatedLink::<P>::none(); N];
        for i in 0..N {
            let inertia = P::splat(constants.inertias[i]);
            let turn = [start.cosines[i], start.sines[i]].map(P::splat);
            let moment = turned::<T, P>(constants.moments[i], turn, C::LATERAL);
            links[i] = EliminatedLink::alone(inertia, moment);
        }
        for i in (0..N).rev() {
            let mut link = links[i];
            let inverse = one / link.inertia;
            let n = link.moment.map(|b| b * inverse);
            let mut p = link.moment_along;
            for x in 0..2 {
                p[x] = p[x].plus_product(link.product, n[x]);
            }
            let share = link.product * inverse;
            let along = link.inertia_along.minus_product(share, link.product);
            let [up, up_pull, own, down, down_fall] = &mut factors[i];
            *own = [
                quad([inverse, share, zero, zero]),
                quad([-share, along, zero, zero]),
            ];
            if i > 0 {
                let parent = C::PARENTS[i];
                let turn = [start.cosines[parent], start.sines[parent]].map(P::splat);
                let r = turned::<T, P>(constants.attachments[i], turn, C::LATERAL);
                let ([r_n, rxn], [r_p, rxp]) = (products(r, n), products(r, p));
                *up = [
                    quad([-r_n, -rxn, n[0], n[1]]),
                    quad([r_p, rxp, -p[0], -p[1]]),
                ];
                *up_pull = [
                    quad([-r[0], r[1], one, zero]),
                    quad([-r[1], -r[0], zero, one]),
                ];
                *down = [
                    quad([-r_n, -r_p, r[0], r[1]]),
                    quad([rxn, rxp, r[1], -r[0]]),
                ];
                *down_fall = [
                    quad([-n[0], -p[0], one, zero]),
                    quad([-n[1], -p[1], zero, one]),
                ];
                link.relieve(n);
                links[parent].carry(link.deficit, r);
            }
        }
        Self(factors)
    }

    /// Returns S and Y where X = `force` and C = `cosine`, in packs `P`. Quads are in `V`.
    /// No closure takes part: what is not inlined is compiled without the registers.
    #[inline(always)]
    pub(super) fn solution<
        C: Connectivity<N>,
        P: Simd<T>,
        V: Simd<T>,
        const Q: usize,
        const M: usize,
    >(
        &self,
        force: &[P; M],
        cosine: &[P; M],
    ) -> [[P; M]; 2] {
        let [mut forces, mut cosines] = [[[T::from_f64(0.0); 4]; Q]; 2];
        let (forces, cosines) = (forces.as_flattened_mut(), cosines.as_flattened_mut());
        for m in 0..M {
            force[m].store(&mut forces[m * P::LANES..]);
            cosine[m].store(&mut cosines[m * P::LANES..]);
        }
        // T, E, F, then S, Y, a. What is added to −0 is known to stay as it is: of few
        // links one sum less to wait for.
        let [mut sums, mut answers] = [[Quad::splat(T::from_f64(-0.0)); N]; 2];
        let (leaves, count) = const { &C::LEAVES };
        for &i in &leaves[..*count] {
            let [of_up, _, of_own, _, _] = &self.0[i];
            let (x, c) = (V::splat(forces[i]), V::splat(cosines[i]));
            let [of_torque, of_cosine] = load::<T, V>(of_own);
            (of_cosine * c)
                .plus_product(of_torque, x)
                .store_quad(&mut answers, i);
            let [of_torque, of_cosine] = load::<T, V>(of_up);
            let up = (of_cosine * c).plus_product(of_torque, x);
            let parent = C::PARENTS[i];
            (V::load_quad(&sums, parent) + up).store_quad(&mut sums, parent);
        }
        let (carriers, count) = const { &C::CARRIERS };
        for &i in &carriers[..*count] {
            let [of_up, of_pull, of_own, _, _] = &self.0[i];
            let (x, c) = (V::splat(forces[i]), V::splat(cosines[i]));
            let torque = V::splat(sums[i].0[0]);
            let [of_torque, of_cosine] = load::<T, V>(of_own);
            (of_cosine * c)
                .plus_product(of_torque, x)
                .plus_product(of_torque, torque)
                .store_quad(&mut answers, i);
            if i > 0 {
                let [of_torque, of_cosine] = load::<T, V>(of_up);
                let [of_x, of_y] = load::<T, V>(of_pull);
                let up = (of_cosine * c)
                    .plus_product(of_torque, x)
                    .plus_product(of_torque, torque)
                    .plus_product(of_x, V::splat(sums[i].0[2]))
                    .plus_product(of_y, V::splat(sums[i].0[3]));
                let parent = C::PARENTS[i];
                (V::load_quad(&sums, parent) + up).store_quad(&mut sums, parent);
            }
        }
        for i in 1..N {
            let [_, _, _, of_parent, of_fall] = &self.0[i];
            let parent = C::PARENTS[i];
            let [of_sine, of_cosine] = load::<T, V>(of_parent);
            let mut sum =
                V::load_quad(&answers, i).plus_product(of_cosine, V::splat(cosines[parent]));
            // The root's pivot does not move.
            if parent > 0 {
                let [of_x, of_y] = load::<T, V>(of_fall);
                sum = sum
                    .plus_product(of_x, V::splat(answers[parent].0[2]))
                    .plus_product(of_y, V::splat(answers[parent].0[3]));
            }
            sum.plus_product(of_sine, V::splat(answers[parent].0[0]))
                .store_quad(&mut answers, i);
        }
        let (mut s, mut y) = (*force, *force);
        for m in 0..M {
            let [mut of_s, mut of_y, mut along] = [[Quad::splat(T::from_f64(0.0))]; 3];
            let (first, place) = (m * P::LANES / 4 * 4, m % (4 / P::LANES));
            for l in 0..4 {
                if first + l < N {
                    let [own_s, own_y, _, _] = answers[first + l].0;
                    (of_s[0].0[l], of_y[0].0[l]) = (own_s, own_y);
                    along[0].0[l] = sums[first + l].0[1];
                }
            }
            s[m] = P::load_quad(&of_s, place);
            // E last, for which no link waits.
            y[m] = P::load_quad(&of_y, place) + P::load_quad(&along, place);
        }
        [s, y]
    }
}

#[inline(always)]
fn quad<T: Scalar, P: Simd<T>>(numbers: [P; 4]) -> Quad<T> {
    let mut quad = [Quad::splat(T::from_f64(0.0))];
    for (lane, number) in numbers.into_iter().enumerate() {
        number.store(&mut quad[0].0[lane..]);
    }
    quad[0]
}

#[inline(always)]
fn load<T: Scalar, V: Simd<T>>(quads: &[Quad<T>; 2]) -> [V; 2] {
    [V::load_quad(quads, 0), V::load_quad(quads, 1)]
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
