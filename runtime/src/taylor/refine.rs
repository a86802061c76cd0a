//! Iterative refinement of the accelerations at the start.
//!
//! At tolerances near rounding, the rounding errors of the lowest orders dominate. One step of
//! iterative refinement removes them at their source: the residual of the equation of motion is
//! computed in numbers of two parts (Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd
//! edition, SIAM 2002, section 12.1, with the residual in twice the precision).
//!
//! With U + iV = v (α + iω²), that is U = (sin θ)'' and V = −(cos θ)'', the pivots' accelerations
//! a_c = a + (ℓ + i w) (U + iV), the forces F = (h + i e) (U + iV) + Σ F_c and the levers' product
//! D + iE = (h − i e) a + Σ (ℓ − i w) F_c, sums over the children c, the residual of a link's
//! equation is
//!
//! −bias − M α − (F + D) cos θ − (G + E) sin θ

use super::buffer::{PackBuffer, PackColumn, SharedNumbers, read};
use super::links::TreeLinks;
use super::start::{Constants, Origin, weights};
use crate::scalar::{Scalar, two_sum};
use crate::simd::{Quad, Simd};

/// Equation of motion at the start of an expansion, whose residual is computed.
pub(super) struct Balance<'a, T, L, S, C> {
    pub(super) links: L,
    pub(super) origin: Origin<'a, T, S>,
    pub(super) constants: Constants<'a, T>,
    /// Cosine and sine of the angles θ of each pack of links.
    pub(super) turn: &'a C,
    /// Weights of each pack of links, and the acceleration that multiplies them.
    pub(super) weight: &'a C,
    pub(super) fall: Option<[T; 2]>,
}

impl<T: Scalar, L: TreeLinks, S: SharedNumbers<T>, C> Balance<'_, T, L, S, C> {
    /// Writes the residual of the equation of motion for the given accelerations, in the units of
    /// the tree's constants. `quads` is workspace.
    #[inline(always)]
    pub(super) fn residual<P: Simd<T>, R: PackBuffer<T>>(
        &self,
        buffer: &mut R,
        quads: &mut [Quad<T>],
        accelerations: &impl PackColumn<P, 1>,
        rest: &mut impl PackColumn<P, 1>,
    ) where
        C: PackColumn<P, 2>,
    {
        let (zero, packs) = (P::splat(T::from_f64(0.0)), buffer.packs());
        // Angular velocity ω, bias and M.
        let mut own = buffer.of_packs::<P, 3>();
        let size = [packs, self.links.count()];
        read(self.origin.omega, quads, size, 0, &mut own);
        read(self.origin.bias, quads, size, 1, &mut own);
        read(self.constants.inertias, quads, size, 2, &mut own);
        // The complex number U + iV.
        let (mut u_column, mut v_column) = (
            [buffer.quads(), buffer.quads()],
            [buffer.quads(), buffer.quads()],
        );
        for m in 0..packs {
            let ([cos, sin], [omega, ..], [alpha]) =
                (self.turn.at(m), own.at(m), accelerations.at(m));
            let square = Parts::product(omega, omega);
            let u = Parts::product(cos, alpha).plus_product(zero - sin, square);
            let v = Parts::product(sin, alpha).plus_product(cos, square);
            u.store(&mut u_column, m);
            v.store(&mut v_column, m);
        }
        self.levers::<P::One, R>(buffer, [&mut u_column, &mut v_column]);
        for m in 0..packs {
            let ([cos, sin], [_, bias, inertia], [alpha]) =
                (self.turn.at(m), own.at(m), accelerations.at(m));
            let [down, aside] = weights(self.fall, self.weight.at(m));
            let aside = Parts::load(&mut u_column, m).plus(Parts::whole(aside));
            let down = Parts::load(&mut v_column, m).plus(Parts::whole(down));
            let sum = Parts::whole(bias)
                .plus_product(inertia, Parts::whole(alpha))
                .plus_product(sin, down)
                .plus_product(cos, aside);
            rest.put(m, [zero - sum.high - sum.low]);
        }
    }

    /// Replaces U + iV of all links by D + iE, with one upward pass and one downward pass.
    #[inline(always)]
    fn levers<P: Simd<T>, R: PackBuffer<T>>(
        &self,
        buffer: &mut R,
        [u_column, v_column]: [&mut [R::Quads; 2]; 2],
    ) {
        let (zero, links) = ([P::splat(T::from_f64(0.0)); COMPLEX], self.links);
        let (moments, attachments) = (self.constants.moments, self.constants.attachments);
        let lateral = links.lateral();
        let mut fall = buffer.of_links::<P, COMPLEX>();
        // The sums Σ F_c.
        let mut pull = buffer.of_links::<P, COMPLEX>();
        let mut lever = buffer.of_links::<P, COMPLEX>();
        for i in 0..links.count() {
            fall.put(i, zero);
            pull.put(i, zero);
            lever.put(i, zero);
        }
        for (i, attachment) in attachments.iter().enumerate().take(links.count()).skip(1) {
            let parent = links.parent(i);
            let turning = [Parts::load(u_column, parent), Parts::load(v_column, parent)];
            let own = plus_turned(parts(fall.at(parent)), *attachment, turning, lateral);
            fall.put(i, numbers(own));
        }
        for i in (1..links.count()).rev() {
            let parent = links.parent(i);
            let ([h, e], [l, w]) = (moments[i], attachments[i]);
            let own = plus_turned(parts(lever.at(i)), [h, -e], parts(fall.at(i)), lateral);
            lever.put(i, numbers(own));
            let turning = [Parts::load(u_column, i), Parts::load(v_column, i)];
            let force = plus_turned(parts(pull.at(i)), [h, e], turning, lateral);
            let above = plus_turned(parts(lever.at(parent)), [l, -w], force, lateral);
            lever.put(parent, numbers(above));
            let [x, y] = parts(pull.at(parent));
            pull.put(parent, numbers([x.plus(force[0]), y.plus(force[1])]));
        }
        for i in 0..links.count() {
            let [x, y] = parts::<P>(lever.at(i));
            x.store(u_column, i);
            y.store(v_column, i);
        }
    }
}

/// Returns `base` + (p + i q) x, for complex numbers in two parts.
#[inline(always)]
fn plus_turned<T: Scalar, P: Simd<T>>(
    base: [Parts<P>; 2],
    [p, q]: [T; 2],
    x: [Parts<P>; 2],
    lateral: bool,
) -> [Parts<P>; 2] {
    let p = P::splat(p);
    let sum = [base[0].plus_product(p, x[0]), base[1].plus_product(p, x[1])];
    if !lateral {
        return sum;
    }
    [
        sum[0].plus_product(P::splat(-q), x[1]),
        sum[1].plus_product(P::splat(q), x[0]),
    ]
}

/// A number as the sum of two parts. With fused multiply–add, products and sums are exact except
/// for digits below the last ones of the second part; without it, products are rounded as usual.
#[derive(Clone, Copy)]
struct Parts<P> {
    high: P,
    low: P,
}

/// Number of values that a complex number in two parts takes.
const COMPLEX: usize = 4;

#[inline(always)]
fn numbers<P>([x, y]: [Parts<P>; 2]) -> [P; COMPLEX] {
    [x.high, x.low, y.high, y.low]
}

#[inline(always)]
fn parts<P>([x_high, x_low, y_high, y_low]: [P; COMPLEX]) -> [Parts<P>; 2] {
    let x = Parts {
        high: x_high,
        low: x_low,
    };
    let y = Parts {
        high: y_high,
        low: y_low,
    };
    [x, y]
}

impl<P: Scalar> Parts<P> {
    #[inline(always)]
    fn whole(high: P) -> Self {
        let low = P::from_f64(0.0);
        Self { high, low }
    }

    #[inline(always)]
    fn load<T: Scalar, Q: AsMut<[Quad<T>]>>([high, low]: &mut [Q; 2], i: usize) -> Self
    where
        P: Simd<T>,
    {
        Self {
            high: P::load_quad(high.as_mut(), i),
            low: P::load_quad(low.as_mut(), i),
        }
    }

    #[inline(always)]
    fn store<T: Scalar, Q: AsMut<[Quad<T>]>>(self, [high, low]: &mut [Q; 2], i: usize)
    where
        P: Simd<T>,
    {
        self.high.store_quad(high.as_mut(), i);
        self.low.store_quad(low.as_mut(), i);
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        let (high, rounding) = two_sum(self.high, other.high);
        let low = self.low + rounding + other.low;
        Self { high, low }
    }

    /// Returns the product a b.
    #[inline(always)]
    fn product(a: P, b: P) -> Self {
        let (high, zero) = (a * b, P::from_f64(0.0));
        let low = (zero - high).plus_product(a, b);
        Self { high, low }
    }

    /// Returns `self` + a x.
    #[inline(always)]
    fn plus_product(self, a: P, x: Self) -> Self {
        let Self { high, low } = Self::product(a, x.high);
        let low = low.plus_product(a, x.low);
        self.plus(Self { high, low })
    }
}
