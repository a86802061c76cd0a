//! The acceleration at the start once more, to its last digit.
//!
//! At tolerances near rounding the rounding errors of the lowest orders are all that
//! is left. One step of iterative refinement removes them where they come from: the
//! equation of motion with the acceleration in it, in numbers of two parts, says
//! what is wrong (Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd
//! edition, SIAM 2002, section 12.1, with the residual in twice the precision).
//!
//! With U + iV = v (α + iω²), that is U = (sin θ)'' and V = −(cos θ)'', the pivots'
//! accelerations a_c = a + (ℓ + i w) (U + iV), the forces F = (h + i e) (U + iV) + Σ F_c
//! and the levers' product D + iE = (h − i e) a + Σ (ℓ − i w) F_c, sums over the
//! children c, what is left of a link's equation is
//!
//! −bias − M α − (F + D) cos θ − (G + E) sin θ

use super::links::TreeLinks;
use super::room::{PackColumn, PackRoom, SharedNumbers, read};
use super::start::{Constants, Origin, weights};
use crate::scalar::{Scalar, two_sum};
use crate::simd::{Quad, Simd};

/// The equation of motion at the start of an expansion.
pub(super) struct Balance<'a, T, L, S, C> {
    pub(super) links: L,
    pub(super) origin: Origin<'a, T, S>,
    pub(super) constants: Constants<'a, T>,
    /// cos θ, sin θ of each pack.
    pub(super) turn: &'a C,
    /// Weights of each pack, and the acceleration that they are multiplied by.
    pub(super) weight: &'a C,
    pub(super) fall: Option<[T; 2]>,
}

impl<T: Scalar, L: TreeLinks, S: SharedNumbers<T>, C> Balance<'_, T, L, S, C> {
    /// Writes what accelerations leave of the equation of motion, in the units of the
    /// tree's constants. `quads` are worked in.
    #[inline(always)]
    pub(super) fn residual<P: Simd<T>, R: PackRoom<T>>(
        &self,
        room: &mut R,
        quads: &mut [Quad<T>],
        accelerations: &impl PackColumn<P, 1>,
        rest: &mut impl PackColumn<P, 1>,
    ) where
        C: PackColumn<P, 2>,
    {
        let (zero, packs) = (P::splat(T::from_f64(0.0)), room.packs());
        // ω, bias and M
        let mut own = room.of_packs::<P, 3>();
        let size = [packs, self.links.count()];
        read(self.origin.omega, quads, size, 0, &mut own);
        read(self.origin.bias, quads, size, 1, &mut own);
        read(self.constants.inertias, quads, size, 2, &mut own);
        // U + iV
        let (mut u_column, mut v_column) =
            ([room.quads(), room.quads()], [room.quads(), room.quads()]);
        for m in 0..packs {
            let ([cos, sin], [omega, ..], [alpha]) =
                (self.turn.at(m), own.at(m), accelerations.at(m));
            let square = Parts::product(omega, omega);
            let u = Parts::product(cos, alpha).plus_product(zero - sin, square);
            let v = Parts::product(sin, alpha).plus_product(cos, square);
            u.store(&mut u_column, m);
            v.store(&mut v_column, m);
        }
        self.levers::<P::One, R>(room, [&mut u_column, &mut v_column]);
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

    /// Writes D + iE of all links in place of U + iV, along the tree.
    #[inline(always)]
    fn levers<P: Simd<T>, R: PackRoom<T>>(
        &self,
        room: &mut R,
        [u_column, v_column]: [&mut [R::Quads; 2]; 2],
    ) {
        let (zero, links) = ([P::splat(T::from_f64(0.0)); COMPLEX], self.links);
        let (moments, attachments) = (self.constants.moments, self.constants.attachments);
        let lateral = links.lateral();
        let mut fall = room.of_links::<P, COMPLEX>();
        // Σ F_c
        let mut pull = room.of_links::<P, COMPLEX>();
        let mut lever = room.of_links::<P, COMPLEX>();
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

/// `base` + (p + i q) x
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

/// Numbers in two parts. What products and sums lose is of the size of the second
/// part's last digits where products are fused with the sums they go into; elsewhere
/// products are rounded as they always are.
#[derive(Clone, Copy)]
struct Parts<P> {
    high: P,
    low: P,
}

/// Numbers of a complex number in two parts.
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

    /// a b
    #[inline(always)]
    fn product(a: P, b: P) -> Self {
        let (high, zero) = (a * b, P::from_f64(0.0));
        let low = (zero - high).plus_product(a, b);
        Self { high, low }
    }

    /// `self` + a x
    #[inline(always)]
    fn plus_product(self, a: P, x: Self) -> Self {
        let Self { high, low } = Self::product(a, x.high);
        let low = low.plus_product(a, x.low);
        self.plus(Self { high, low })
    }
}
