//! The acceleration at the start once more, to its last digit.
//!
//! At tolerances near rounding the rounding errors of the lowest orders are all that
//! is left. One step of iterative refinement removes them where they come from: the
//! equation of motion with the acceleration in it, in numbers of two parts, says
//! what is wrong (Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd
//! edition, SIAM 2002, section 12.1, with the residual in twice the precision).
//!
//! With U = (sin θ)'' = α cos θ − ω² sin θ and V = −(cos θ)'' = α sin θ + ω² cos θ,
//! what is left of the equation of link i is
//!
//! −bias_i − D_i α_i − (G_i + Σ_j A_ij V_j + B_ij U_j) sin θ_i
//!   − (F_i + Σ_j A_ij U_j − B_ij V_j) cos θ_i.

use super::expand::{Start, Tree};
use super::levers::Levers;
use super::matrix::{Vector, packs};
use super::quad::{Pack, two_sum};
use crate::scalar::Scalar;

/// What accelerations leave of the equation of motion, N m in the units of the
/// tree's constants.
#[inline(always)]
pub(super) fn residual<T: Scalar, P: Pack<T>, const N: usize, const M: usize>(
    start: &Start<'_, T, N>,
    tree: &Tree<'_, T, N>,
    levers: &Levers<'_, T, N, M>,
    accelerations: &[P; M],
) -> [P; M] {
    let zero = P::splat(T::from_f64(0.0));
    let sines: [P; M] = packs(&start.sines);
    let cosines: [P; M] = packs(&start.cosines);
    let omega: [P; M] = packs(start.omega);
    let weights: [P; M] = packs(&tree.weights);
    let lateral: [P; M] = packs(&tree.lateral_weights);
    let nothing = Parts {
        high: zero,
        low: zero,
    };
    let (mut u, mut v, mut minus_v) = ([nothing; M], [nothing; M], [nothing; M]);
    let (mut down, mut aside) = ([nothing; M], [nothing; M]);
    for m in 0..M {
        let (sin, cos, alpha) = (sines[m], cosines[m], accelerations[m]);
        let square = product(omega[m], omega[m]);
        u[m] = plus_product(product(cos, alpha), zero.minus(sin), square);
        v[m] = plus_product(product(sin, alpha), cos, square);
        minus_v[m] = Parts {
            high: zero.minus(v[m].high),
            low: zero.minus(v[m].low),
        };
        down[m] = Parts {
            high: weights[m],
            low: zero,
        };
        aside[m] = Parts {
            high: lateral[m],
            low: zero,
        };
    }
    add_products::<T, P, N, M>(&mut down, levers.along, &v);
    add_products::<T, P, N, M>(&mut aside, levers.along, &u);
    if let Some(across) = levers.across {
        add_products::<T, P, N, M>(&mut down, across, &u);
        add_products::<T, P, N, M>(&mut aside, across, &minus_v);
    }
    let inertias: [P; M] = packs(&tree.inertias);
    let bias: [P; M] = packs(&start.bias);
    let mut rest = [zero; M];
    for m in 0..M {
        let own = Parts {
            high: bias[m],
            low: zero,
        };
        let alpha = Parts {
            high: accelerations[m],
            low: zero,
        };
        let own = plus_product(own, inertias[m], alpha);
        let own = plus_product(own, sines[m], down[m]);
        let sum = plus_product(own, cosines[m], aside[m]);
        rest[m] = zero.minus(sum.high).minus(sum.low);
    }
    rest
}

/// Adds the matrix with these columns times x.
#[inline(always)]
fn add_products<T: Scalar, P: Pack<T>, const N: usize, const M: usize>(
    sums: &mut [Parts<P>; M],
    columns: &[Vector<T, M>],
    x: &[Parts<P>; M],
) {
    for (columns, x) in columns[..N].chunks(4).zip(x) {
        let (high, low) = (x.high, x.low);
        let lanes = [
            (high.broadcast::<0>(), low.broadcast::<0>()),
            (high.broadcast::<1>(), low.broadcast::<1>()),
            (high.broadcast::<2>(), low.broadcast::<2>()),
            (high.broadcast::<3>(), low.broadcast::<3>()),
        ];
        for (column, (high, low)) in columns.iter().zip(lanes) {
            for (sum, entries) in sums.iter_mut().zip(column) {
                *sum = plus_product(*sum, P::load(entries), Parts { high, low });
            }
        }
    }
}

/// Numbers in two parts. What products and sums lose is of the size of the second
/// part's last digits where products are fused with the sums they go into; elsewhere
/// products are rounded as they always are.
#[derive(Clone, Copy)]
struct Parts<P> {
    high: P,
    low: P,
}

/// a b
#[inline(always)]
fn product<T: Scalar, P: Pack<T>>(a: P, b: P) -> Parts<P> {
    let (high, zero) = (a.times(b), P::splat(T::from_f64(0.0)));
    let low = zero.minus(high).plus_product(a, b);
    Parts { high, low }
}

/// `base` + a x
#[inline(always)]
fn plus_product<T: Scalar, P: Pack<T>>(base: Parts<P>, a: P, x: Parts<P>) -> Parts<P> {
    let term = product(a, x.high);
    let (high, rounding) = two_sum(base.high, term.high);
    let low = base
        .low
        .plus(rounding)
        .plus(term.low.plus_product(a, x.low));
    Parts { high, low }
}
