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

use super::elimination::LinkColumn;
use super::expand::{Connectivity, LinkConstants, Start};
use super::orders::packs;
use crate::scalar::{Scalar, two_sum};
use crate::simd::{Quad, Simd};

/// Returns what accelerations leave of the equation of motion, in the units of the
/// tree's constants.
#[inline(always)]
pub(super) fn residual<T, C, P, const N: usize, const Q: usize, const M: usize>(
    start: &Start<'_, T, N>,
    constants: &LinkConstants<T, N>,
    accelerations: &[P; M],
) -> [P; M]
where
    T: Scalar,
    C: Connectivity<N>,
    P: Simd<T>,
{
    let zero = P::splat(T::from_f64(0.0));
    let [sines, cosines] = [&start.sines, &start.cosines].map(packs::<T, P, N, Q, M>);
    let omega = packs::<T, P, N, Q, M>(start.omega);
    // U + iV
    let mut turning = empty::<T, Q>();
    for m in 0..M {
        let (sin, cos, alpha) = (sines[m], cosines[m], accelerations[m]);
        let square = Parts::product(omega[m], omega[m]);
        let u = Parts::product(cos, alpha).plus_product(zero - sin, square);
        let v = Parts::product(sin, alpha).plus_product(cos, square);
        u.store::<T, Q>(&mut turning[0], m);
        v.store::<T, Q>(&mut turning[1], m);
    }
    let lever = levers::<T, C, P::One, N, Q>(constants, &turning);
    let bias = packs::<T, P, N, Q, M>(&start.bias);
    let inertias = packs::<T, P, N, Q, M>(&constants.inertias);
    let weights = packs::<T, P, N, Q, M>(&constants.weights);
    let lateral = packs::<T, P, N, Q, M>(&constants.lateral_weights);
    let mut rest = *accelerations;
    for m in 0..M {
        let aside = Parts::load::<T, Q>(&lever[0], m).plus(Parts::whole(lateral[m]));
        let down = Parts::load::<T, Q>(&lever[1], m).plus(Parts::whole(weights[m]));
        let sum = Parts::whole(bias[m])
            .plus_product(inertias[m], Parts::whole(accelerations[m]))
            .plus_product(sines[m], down)
            .plus_product(cosines[m], aside);
        rest[m] = zero - sum.high - sum.low;
    }
    rest
}

/// D + iE of all links, along the tree.
#[inline(always)]
fn levers<T: Scalar, C: Connectivity<N>, P: Simd<T>, const N: usize, const Q: usize>(
    constants: &LinkConstants<T, N>,
    turning: &[PartsColumn<T, Q>; 2],
) -> [PartsColumn<T, Q>; 2] {
    let zero = Parts::whole(P::splat(T::from_f64(0.0)));
    // a, Σ F_c and D + iE.
    let [mut fall, mut pull, mut lever] = [[[zero; 2]; N]; 3];
    for i in 1..N {
        let parent = C::PARENTS[i];
        let turning = [0, 1].map(|x| Parts::load::<T, Q>(&turning[x], parent));
        fall[i] = plus_turned::<T, C, P, N>(fall[parent], constants.attachments[i], turning);
    }
    for i in (1..N).rev() {
        let parent = C::PARENTS[i];
        let ([h, e], [l, w]) = (constants.moments[i], constants.attachments[i]);
        lever[i] = plus_turned::<T, C, P, N>(lever[i], [h, -e], fall[i]);
        let turning = [0, 1].map(|x| Parts::load::<T, Q>(&turning[x], i));
        let force = plus_turned::<T, C, P, N>(pull[i], [h, e], turning);
        lever[parent] = plus_turned::<T, C, P, N>(lever[parent], [l, -w], force);
        for x in 0..2 {
            pull[parent][x] = pull[parent][x].plus(force[x]);
        }
    }
    let mut columns = empty::<T, Q>();
    for (i, lever) in lever.iter().enumerate() {
        for x in 0..2 {
            lever[x].store::<T, Q>(&mut columns[x], i);
        }
    }
    columns
}

/// First and second parts of a number of each link.
type PartsColumn<T, const Q: usize> = [LinkColumn<T, Q>; 2];

#[inline(always)]
fn empty<T: Scalar, const Q: usize>() -> [PartsColumn<T, Q>; 2] {
    [[[Quad::splat(T::from_f64(0.0)); Q]; 2]; 2]
}

/// `base` + (p + i q) x
#[inline(always)]
fn plus_turned<T: Scalar, C: Connectivity<N>, P: Simd<T>, const N: usize>(
    base: [Parts<P>; 2],
    [p, q]: [T; 2],
    x: [Parts<P>; 2],
) -> [Parts<P>; 2] {
    let p = P::splat(p);
    let sum = [base[0].plus_product(p, x[0]), base[1].plus_product(p, x[1])];
    if !C::LATERAL {
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

impl<P: Scalar> Parts<P> {
    #[inline(always)]
    fn whole(high: P) -> Self {
        let low = P::from_f64(0.0);
        Self { high, low }
    }

    #[inline(always)]
    fn load<T: Scalar, const Q: usize>(column: &PartsColumn<T, Q>, i: usize) -> Self
    where
        P: Simd<T>,
    {
        let [high, low] = column;
        Self {
            high: P::load_quad(high, i),
            low: P::load_quad(low, i),
        }
    }

    #[inline(always)]
    fn store<T: Scalar, const Q: usize>(self, column: &mut PartsColumn<T, Q>, i: usize)
    where
        P: Simd<T>,
    {
        let [high, low] = column;
        self.high.store_quad(high, i);
        self.low.store_quad(low, i);
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
