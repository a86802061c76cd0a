//! The orders of an expansion, one after the other.
//!
//! In order k of the recurrences of [`expand`](super::expand), with γ\[0\] = 1,
//! σ\[0\] = γ\[1\] = 0 and σ\[1\] = ω\[0\],
//!
//! X\[k\] = Σ_{0<j≤k} (σ\[j\] Y\[k−j\] − γ\[j\] X\[k−j\]) − bias\[k\],
//! C\[k\] = −(k+1) Σ_{0≤j≤k} ω\[j\] σ\[k+1−j\],
//! α\[k\] = S\[k\] − (k+1) Σ_{0≤j<k} ω\[j\] γ\[k+1−j\],
//!
//! and S\[k\] and Y\[k\] follow by [`elimination`](super::elimination). Everything
//! on the right is of lower orders. What order k − 1 has to do with it is written
//! apart, so that the sums are ready when that is.

use super::bias::Bias;
use super::elimination::{LinkFactors, TaylorElimination};
use super::links::TreeLinks;
use super::reciprocal::{Divisors, Reciprocal};
use super::recurrence::Recurrence;
use super::room::{PackRoom, SharedNumbers};
use super::series::{SUMS, SeriesRow};
use super::start::{Constants, Origin};
use crate::scalar::Scalar;
use crate::simd::{Kernel, Simd};

/// From this order on the accelerations at the start are refined: the order for
/// tolerances of 1e-13, below which rounding is most of the error.
const REFINED: usize = 28;

/// The orders of an expansion from 1 on.
pub(super) struct Orders<'a, T, L, S, R, B> {
    pub(super) links: L,
    pub(super) room: R,
    pub(super) origin: Origin<'a, T, S>,
    pub(super) constants: Constants<'a, T>,
    /// Angles of all links, then angular velocities, order by order.
    pub(super) coefficients: &'a mut [T],
    /// Number of orders in them.
    pub(super) count: usize,
    pub(super) rows: &'a mut [SeriesRow<T>],
    pub(super) factors: &'a mut [LinkFactors<T>],
    pub(super) bias: B,
}

impl<T, L, S, R, B> Kernel<T> for Orders<'_, T, L, S, R, B>
where
    T: Scalar,
    L: TreeLinks,
    S: SharedNumbers<T>,
    R: PackRoom<T>,
    B: Bias<T>,
{
    type Output = ();

    #[inline(always)]
    fn run<P: Simd<T>>(self) {
        self.form::<P, P, false>();
    }
}

impl<T, L, S, R, B> Orders<'_, T, L, S, R, B>
where
    T: Scalar,
    L: TreeLinks,
    S: SharedNumbers<T>,
    R: PackRoom<T>,
    B: Bias<T>,
{
    /// Forms them, in packs of numbers that are `SEVERAL` states or one. No closure
    /// takes part but the caller's: what is not inlined is compiled without the
    /// registers. For the same reason the bias is asked for in one place.
    #[inline(always)]
    pub(super) fn form<P: Simd<T>, V: Simd<T>, const SEVERAL: bool>(self) {
        let (links, mut room) = (self.links, self.room);
        let n = links.count();
        let (origin, constants) = (self.origin.first_links(n), self.constants.first_links(n));
        let last = self.count.saturating_sub(1);
        let factors = self.factors;
        let system =
            TaylorElimination::new::<P::One, S>(links, &mut room, &origin, &constants, factors);
        let mut recurrence = Recurrence::<T, P, R, L, B> {
            system,
            bias: self.bias,
            rows: self.rows,
            count: self.count,
            quads: room.quads(),
            omega: room.of_packs::<P, 1>(),
            turn: room.of_packs::<P, 2>(),
            weight: room.of_packs::<P, 2>(),
            x: room.of_packs::<P, 1>(),
            c: room.of_packs::<P, 1>(),
            s: room.of_packs::<P, 1>(),
            y: room.of_packs::<P, 1>(),
            s_rest: room.of_packs::<P, 1>(),
            force: room.of_packs::<P, 1>(),
            sums: room.of_packs::<P, SUMS>(),
            next_sums: room.of_packs::<P, SUMS>(),
            theta: room.quads(),
            velocity: room.quads(),
            sines: room.quads(),
            cosines: room.quads(),
            room,
            links,
        };
        recurrence.start::<V>(&origin, &constants);
        if last >= REFINED {
            recurrence.refine::<V, S>(origin, constants);
        }
        let mut number = P::from_f64(1.0);
        let mut over_k = Reciprocal::of(number);
        for k in 1..last {
            let divisors = Divisors::of(number, over_k);
            (number, over_k) = (divisors.next, divisors.over_next);
            recurrence.add_up::<SEVERAL>(k);
            recurrence.append(k, divisors);
            let newest = recurrence.write_coefficients(k, self.coefficients);
            recurrence.take_bias(k, newest);
            recurrence.solve::<V>(k);
        }
        if last > 0 {
            recurrence.write_last_velocities(last, over_k, self.coefficients);
        }
    }
}
