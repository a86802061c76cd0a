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

use super::elimination::Column;
use super::expand::{Connectivity, LinkConstants, Start};
use super::quad::{Pack, two_sum};
use crate::scalar::Scalar;

/// Returns what accelerations leave of the equation of motion, in the units of the
/// tree's constants, link by link.
#[inline(always)]
pub(super) fn residual<T, C, P, const N: usize, const Q: usize>(
    start: &Start<'_, T, N>,
    constants: &LinkConstants<T, N>,
    accelerations: &Column<T, Q>,
) -> Column<T, Q>
where
    T: Scalar,
    C: Connectivity<N>,
    P: Pack<T>,
{
    let zero = Parts::whole::<T>(P::splat(T::from_f64(0.0)));
    // U + iV, a, Σ F_c and D + iE.
    let [mut turning, mut fall, mut pull, mut lever] = [[[zero; 2]; N]; 4];
    for i in 0..N {
        let alpha = P::load(accelerations, i);
        let (cos, sin) = (P::splat(start.cosines[i]), P::splat(start.sines[i]));
        let omega = P::splat(start.omega[i]);
        let square = Parts::product::<T>(omega, omega);
        turning[i] = [
            Parts::product::<T>(cos, alpha).plus_product::<T>(zero.high.minus(sin), square),
            Parts::product::<T>(sin, alpha).plus_product::<T>(cos, square),
        ];
        if i > 0 {
            let parent = C::PARENTS[i];
            let attachment = constants.attachments[i];
            fall[i] = plus_turned::<T, C, P, N>(fall[parent], attachment, turning[parent]);
        }
    }
    let mut rest = *accelerations;
    for i in (0..N).rev() {
        let [h, e] = constants.moments[i];
        let [aside, down] = plus_turned::<T, C, P, N>(lever[i], [h, -e], fall[i]);
        let number = |value: T| Parts::whole::<T>(P::splat(value));
        let (cos, sin) = (P::splat(start.cosines[i]), P::splat(start.sines[i]));
        let alpha = Parts::whole::<T>(P::load(accelerations, i));
        let sum = number(start.bias[i])
            .plus_product::<T>(P::splat(constants.inertias[i]), alpha)
            .plus_product::<T>(sin, down.plus::<T>(number(constants.weights[i])))
            .plus_product::<T>(cos, aside.plus::<T>(number(constants.lateral_weights[i])));
        let left = zero.high.minus(sum.high).minus(sum.low);
        left.store(&mut rest, i);
        if i > 0 {
            let parent = C::PARENTS[i];
            let force = plus_turned::<T, C, P, N>(pull[i], [h, e], turning[i]);
            let [l, w] = constants.attachments[i];
            lever[parent] = plus_turned::<T, C, P, N>(lever[parent], [l, -w], force);
            for x in 0..2 {
                pull[parent][x] = pull[parent][x].plus::<T>(force[x]);
            }
        }
    }
    rest
}

/// `base` + (p + i q) x
#[inline(always)]
fn plus_turned<T: Scalar, C: Connectivity<N>, P: Pack<T>, const N: usize>(
    base: [Parts<P>; 2],
    [p, q]: [T; 2],
    x: [Parts<P>; 2],
) -> [Parts<P>; 2] {
    let p = P::splat(p);
    let sum = [
        base[0].plus_product::<T>(p, x[0]),
        base[1].plus_product::<T>(p, x[1]),
    ];
    if !C::LATERAL {
        return sum;
    }
    [
        sum[0].plus_product::<T>(P::splat(-q), x[1]),
        sum[1].plus_product::<T>(P::splat(q), x[0]),
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

impl<P: Copy> Parts<P> {
    #[inline(always)]
    fn whole<T: Scalar>(high: P) -> Self
    where
        P: Pack<T>,
    {
        let low = P::splat(T::from_f64(0.0));
        Self { high, low }
    }

    #[inline(always)]
    fn plus<T: Scalar>(self, other: Self) -> Self
    where
        P: Pack<T>,
    {
        let (high, rounding) = two_sum(self.high, other.high);
        let low = self.low.plus(rounding).plus(other.low);
        Self { high, low }
    }

    /// a b
    #[inline(always)]
    fn product<T: Scalar>(a: P, b: P) -> Self
    where
        P: Pack<T>,
    {
        let (high, zero) = (a.times(b), P::splat(T::from_f64(0.0)));
        let low = zero.minus(high).plus_product(a, b);
        Self { high, low }
    }

    /// `self` + a x
    #[inline(always)]
    fn plus_product<T: Scalar>(self, a: P, x: Self) -> Self
    where
        P: Pack<T>,
    {
        let Self { high, low } = Self::product::<T>(a, x.high);
        let low = low.plus_product(a, x.low);
        self.plus::<T>(Self { high, low })
    }
}
