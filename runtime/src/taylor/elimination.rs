//! Solution of the equations of motion for the Taylor coefficients of one order, by elimination
//! along the tree.
//!
//! This is the articulated recursion of physics §10, (10.4) to (10.8), with S and C instead of ω̇
//! and −ω². With v = e^(iθ) at the start, m = (h + i e) v of each link, r = (ℓ + i w) v_parent, and
//! a the acceleration of the link's pivot,
//!
//! a_c = a + (S − i C) r_c, F = (S − i C) m + Σ F_c,
//! X = M S + m·a + Σ r_c·F_c, Y = M C − m × a − Σ r_c × F_c,
//!
//! sums over the children c. The eliminated matrix of this system depends only on the angles at the
//! start and serves all orders:
//!
//! b = m − Σ N_c r_c, g = i m − Σ N_c i r_c, N = Σ N_c + b bᵀ/J,
//! J = M − Σ r_c·N_c r_c, K = M − Σ r_c × N_c i r_c, q = Σ r_c × N_c r_c.
//!
//! Let n = b/J and p = g + q n. A link passes a torque t, its contribution e to the parent's Y and
//! a force f to its parent; T, E, F are the sums that a link receives. In quads, with the unit
//! vectors of the last two components in H_x and H_y,
//!
//! (t, e, f) = (−r·n, −r × n, n) (X + T) + (r·p, r × p, −p) C + H_x F_x + H_y F_y,
//! (S, Y, a) = (1, q, 0) (X + T)/J + (−q/J, K − q²/J, 0) C + (0, E, 0)
//!   + (−r·n, −r·p, r) S' + (r × n, r × p, −i r) C' + A_x a'_x + A_y a'_y
//!
//! with S', C', a' of the parent. An order takes one upward pass (leaves to root) and one downward
//! pass, and a link takes four products of quads in each. The matrix of the downward pass is the
//! transpose of the upward one, except for signs.

// One index runs through several arrays at once.
#![allow(clippy::needless_range_loop)]

use super::buffer::{OfLinks, PackBuffer, PackColumn, SharedNumbers, WritableNumbers};
use super::eliminated_link::{ELIMINATED, EliminatedLink};
use super::links::TreeLinks;
use super::start::{Constants, Origin};
use crate::scalar::Scalar;
use crate::simd::{Quad, Simd};

/// Factors of a link at the start of the expansion, as five pairs of quads: those of X + T and of C
/// in the values passed up; those of F in these values; those of X + T and of C in the link's own
/// part of S and Y; those of the parent's S and C; those of the parent's a.
pub(super) type LinkFactors<T> = [[Quad<T>; 2]; 5];

/// Number of quads in [`LinkFactors`].
pub(super) const FACTORS: usize = 10;

/// Factors of all links at the start of the expansion, which serve all orders.
pub(super) struct TaylorElimination<'a, T, L> {
    links: L,
    factors: &'a [LinkFactors<T>],
}

impl<'a, T: Scalar, L: TreeLinks> TaylorElimination<'a, T, L> {
    /// Computes the factors by eliminating link by link from the leaves to the root.
    #[inline(always)]
    pub(super) fn new<P: Simd<T>, S: SharedNumbers<T>>(
        links: L,
        buffer: &mut impl PackBuffer<T>,
        origin: &Origin<'_, T, S>,
        constants: &Constants<'_, T>,
        factors: &'a mut [LinkFactors<T>],
    ) -> Self {
        let (zero, one) = (P::from_f64(0.0), P::from_f64(1.0));
        let (factors, _) = factors.split_at_mut(links.count());
        let mut eliminated = buffer.rest().of_links::<P, ELIMINATED>();
        for i in 0..links.count() {
            let inertia = P::splat(constants.inertias[i]);
            let moment = rotated::<T, P>(
                constants.moments[i],
                cos_sin::<T, P, S>(origin, i),
                links.lateral(),
            );
            eliminated.put(i, EliminatedLink::alone(inertia, moment).numbers());
        }
        for i in (0..links.count()).rev() {
            let mut link = EliminatedLink::of(eliminated.at(i));
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
                let parent = links.parent(i);
                let r = rotated::<T, P>(
                    constants.attachments[i],
                    cos_sin::<T, P, S>(origin, parent),
                    links.lateral(),
                );
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
                let mut above = EliminatedLink::of(eliminated.at(parent));
                above.carry(link.deficit, r);
                eliminated.put(parent, above.numbers());
            }
        }
        Self { links, factors }
    }

    /// Writes S and Y for X = `force` and C = `cosine`, in packs `P`; quads are vectors of type
    /// `V`. It uses no closures, because a closure that is not inlined is compiled without vector
    /// registers.
    #[inline(always)]
    pub(super) fn solve<P: Simd<T>, V: Simd<T>>(
        &self,
        mut buffer: impl PackBuffer<T>,
        force: &impl PackColumn<P, 1>,
        cosine: &impl PackColumn<P, 1>,
        [s, y]: [&mut impl PackColumn<P, 1>; 2],
    ) {
        let (mut forces, mut cosines) = (buffer.numbers(), buffer.numbers());
        let packs = buffer.packs();
        for m in 0..packs {
            let ([force], [cosine]) = (force.at(m), cosine.at(m));
            forces.write(m, force);
            cosines.write(m, cosine);
        }
        // First T, E, F, then S, Y, a. The compiler knows that adding to −0 changes nothing, which
        // saves a sum if a tree has few links.
        let (mut sums, mut answers) = (buffer.link_quads(), buffer.link_quads());
        let (sums, answers) = (sums.as_mut(), answers.as_mut());
        sums.fill(Quad::splat(T::from_f64(-0.0)));
        if V::APART {
            self.rise_apart([&forces, &cosines], sums, answers);
            self.downward_pass_apart(&cosines, answers);
        } else {
            self.rise::<V>([&forces, &cosines], sums, answers);
            self.downward_pass::<V>(&cosines, answers);
        }
        for m in 0..packs {
            if P::LANES == 1 {
                let ([own_s, own_y, _, _], [_, along, _, _]) = (answers[m].0, sums[m].0);
                s.put(m, [P::splat(own_s)]);
                y.put(m, [P::splat(own_y) + P::splat(along)]);
                continue;
            }
            let [mut of_s, mut of_y, mut along] = [[Quad::splat(T::from_f64(0.0))]; 3];
            let (first, place) = (m * P::LANES / 4 * 4, m % (4 / P::LANES));
            for l in 0..4 {
                // The memory may be larger than the tree; the rest is zero.
                if first + l < answers.len() {
                    let [own_s, own_y, _, _] = answers[first + l].0;
                    (of_s[0].0[l], of_y[0].0[l]) = (own_s, own_y);
                    along[0].0[l] = sums[first + l].0[1];
                }
            }
            s.put(m, [P::load_quad(&of_s, place)]);
            // E is added last, since no link waits for it.
            y.put(
                m,
                [P::load_quad(&of_y, place) + P::load_quad(&along, place)],
            );
        }
    }

    /// Upward pass of the solution: adds to T, E and F of each parent, and writes each link's own
    /// part of S, Y and a.
    #[inline(always)]
    fn rise<V: Simd<T>>(
        &self,
        [forces, cosines]: [&impl OfLinks<T>; 2],
        sums: &mut [Quad<T>],
        answers: &mut [Quad<T>],
    ) {
        let links = self.links;
        let factors = &self.factors[..links.count()];
        for &i in links.leaves() {
            let [of_up, _, of_own, _, _] = &factors[i];
            let (x, c) = (V::splat(forces.of(i)), V::splat(cosines.of(i)));
            let [of_torque, of_cosine] = load::<T, V>(of_own);
            (of_cosine * c)
                .plus_product(of_torque, x)
                .store_quad(answers, i);
            if i > 0 {
                let [of_torque, of_cosine] = load::<T, V>(of_up);
                let up = (of_cosine * c).plus_product(of_torque, x);
                let parent = links.parent(i);
                (V::load_quad(sums, parent) + up).store_quad(sums, parent);
            }
        }
        for &i in links.carriers() {
            let [of_up, of_pull, of_own, _, _] = &factors[i];
            let (x, c) = (V::splat(forces.of(i)), V::splat(cosines.of(i)));
            let torque = V::splat(sums[i].0[0]);
            let [of_torque, of_cosine] = load::<T, V>(of_own);
            (of_cosine * c)
                .plus_product(of_torque, x)
                .plus_product(of_torque, torque)
                .store_quad(answers, i);
            if i > 0 {
                let [of_torque, of_cosine] = load::<T, V>(of_up);
                let [of_x, of_y] = load::<T, V>(of_pull);
                let up = (of_cosine * c)
                    .plus_product(of_torque, x)
                    .plus_product(of_torque, torque)
                    .plus_product(of_x, V::splat(sums[i].0[2]))
                    .plus_product(of_y, V::splat(sums[i].0[3]));
                let parent = links.parent(i);
                (V::load_quad(sums, parent) + up).store_quad(sums, parent);
            }
        }
    }

    /// Downward pass of the solution: adds the parent's part to S, Y and a of each link.
    #[inline(always)]
    fn downward_pass<V: Simd<T>>(&self, cosines: &impl OfLinks<T>, answers: &mut [Quad<T>]) {
        let (links, count) = (self.links, self.links.count());
        let factors = &self.factors[..count];
        for i in 1..count {
            let [_, _, _, of_parent, of_fall] = &factors[i];
            let parent = links.parent(i);
            let [of_sine, of_cosine] = load::<T, V>(of_parent);
            let mut sum =
                V::load_quad(answers, i).plus_product(of_cosine, V::splat(cosines.of(parent)));
            // The root's pivot does not move.
            if parent > 0 {
                let [of_x, of_y] = load::<T, V>(of_fall);
                sum = sum
                    .plus_product(of_x, V::splat(answers[parent].0[2]))
                    .plus_product(of_y, V::splat(answers[parent].0[3]));
            }
            sum.plus_product(of_sine, V::splat(answers[parent].0[0]))
                .store_quad(answers, i);
        }
    }

    /// Upward pass for numbers that hold several states each. A product with a quad then takes four
    /// operations, where a register of one state takes one. This pass leaves out products with the
    /// zeros and ones of the factors, and numbers that no link reads: the force on the root's pivot.
    #[inline(always)]
    fn rise_apart(
        &self,
        columns: [&impl OfLinks<T>; 2],
        sums: &mut [Quad<T>],
        answers: &mut [Quad<T>],
    ) {
        for &i in self.links.leaves() {
            self.raise::<true>(i, columns, sums, answers);
        }
        for &i in self.links.carriers() {
            self.raise::<false>(i, columns, sums, answers);
        }
    }

    /// Computes link `i` in the upward pass.
    #[inline(always)]
    fn raise<const LEAF: bool>(
        &self,
        i: usize,
        [forces, cosines]: [&impl OfLinks<T>; 2],
        sums: &mut [Quad<T>],
        answers: &mut [Quad<T>],
    ) {
        let [of_up, of_pull, of_own, _, _] = &self.factors[i];
        let [torque, _, f_x, f_y] = sums[i].0;
        let c = cosines.of(i);
        let x = if LEAF {
            forces.of(i)
        } else {
            forces.of(i) + torque
        };
        let none = T::from_f64(-0.0);
        answers[i] = Quad([none; 4]);
        for l in 0..2 {
            answers[i].0[l] = combined(of_own, l, [x, c]);
        }
        if i == 0 {
            return;
        }
        let parent = self.links.parent(i);
        let sum = &mut sums[parent].0;
        for l in 0..2 {
            let mut up = combined(of_up, l, [x, c]);
            if !LEAF {
                up = plus_combined(up, of_pull, l, [f_x, f_y]);
            }
            sum[l] = sum[l] + up;
        }
        if parent > 0 {
            let [mut up_x, mut up_y] = [combined(of_up, 2, [x, c]), combined(of_up, 3, [x, c])];
            if !LEAF {
                (up_x, up_y) = (up_x + f_x, up_y + f_y);
            }
            (sum[2], sum[3]) = (sum[2] + up_x, sum[3] + up_y);
        }
    }

    /// Downward pass for numbers that hold several states each. It leaves out the accelerations of
    /// leaves, which no link reads.
    #[inline(always)]
    fn downward_pass_apart(&self, cosines: &impl OfLinks<T>, answers: &mut [Quad<T>]) {
        for &i in self.links.carriers().iter().rev() {
            self.lower::<false>(i, cosines, answers);
        }
        for &i in self.links.leaves() {
            self.lower::<true>(i, cosines, answers);
        }
    }

    /// Computes link `i` in the downward pass.
    #[inline(always)]
    fn lower<const LEAF: bool>(
        &self,
        i: usize,
        cosines: &impl OfLinks<T>,
        answers: &mut [Quad<T>],
    ) {
        if i == 0 {
            return;
        }
        let [_, _, _, of_parent, of_fall] = &self.factors[i];
        let parent = self.links.parent(i);
        let ([sine, _, a_x, a_y], cosine) = (answers[parent].0, cosines.of(parent));
        let own = &mut answers[i].0;
        for l in 0..if LEAF { 2 } else { 4 } {
            own[l] = plus_combined(own[l], of_parent, l, [sine, cosine]);
        }
        // The root's pivot does not move.
        if parent > 0 {
            for l in 0..2 {
                own[l] = plus_combined(own[l], of_fall, l, [a_x, a_y]);
            }
            if !LEAF {
                (own[2], own[3]) = (own[2] + a_x, own[3] + a_y);
            }
        }
    }
}

/// Returns component `l` of the sum of two quads, each multiplied by a number.
#[inline(always)]
fn combined<T: Scalar>(quads: &[Quad<T>; 2], l: usize, [first, second]: [T; 2]) -> T {
    (quads[1].0[l] * second).plus_product(quads[0].0[l], first)
}

/// Adds component `l` of the sum of two quads, each multiplied by a number.
#[inline(always)]
fn plus_combined<T: Scalar>(sum: T, quads: &[Quad<T>; 2], l: usize, [first, second]: [T; 2]) -> T {
    sum.plus_product(quads[1].0[l], second)
        .plus_product(quads[0].0[l], first)
}

/// Returns cos θ and sin θ of a link's angle θ at the start.
#[inline(always)]
fn cos_sin<T: Scalar, P: Simd<T>, S: SharedNumbers<T>>(
    origin: &Origin<'_, T, S>,
    link: usize,
) -> [P; 2] {
    [
        P::splat(origin.cosines.of(link)),
        P::splat(origin.sines.of(link)),
    ]
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

/// Returns (p + i q) e^(iθ) for the direction (cos θ, sin θ) of a link.
#[inline(always)]
fn rotated<T: Scalar, P: Simd<T>>([p, q]: [T; 2], [cos, sin]: [P; 2], lateral: bool) -> [P; 2] {
    let p = P::splat(p);
    let [x, y] = [p * cos, p * sin];
    if lateral {
        let q = P::splat(q);
        [x.minus_product(q, sin), y.plus_product(q, cos)]
    } else {
        [x, y]
    }
}

/// Returns the scalar product u·w and the cross product u × w.
#[inline(always)]
fn products<P: Scalar>([u_x, u_y]: [P; 2], [w_x, w_y]: [P; 2]) -> [P; 2] {
    [
        (u_x * w_x).plus_product(u_y, w_y),
        (u_x * w_y).minus_product(u_y, w_x),
    ]
}
