//! Computation of the orders of an expansion, one after the other.
//!
//! In order k of the recurrences of [`expand`](super::expand), with γ\[0\] = 1, σ\[0\] = γ\[1\] = 0
//! and σ\[1\] = ω\[0\],
//!
//! X\[k\] = Σ_{0<j≤k} (σ\[j\] Y\[k−j\] − γ\[j\] X\[k−j\]) − bias\[k\],
//! C\[k\] = −(k+1) Σ_{0≤j≤k} ω\[j\] σ\[k+1−j\],
//! α\[k\] = S\[k\] − (k+1) Σ_{0≤j<k} ω\[j\] γ\[k+1−j\],
//!
//! and S\[k\] and Y\[k\] follow by [`elimination`](super::elimination). Everything on the right is
//! of lower orders. The terms with order k − 1 are separate, so that the other sums are ready when
//! order k − 1 is.

use super::bias::Bias;
use super::buffer::{PackBuffer, SharedNumbers};
use super::elimination::{LinkFactors, TaylorElimination};
use super::links::TreeLinks;
use super::reciprocal::{Divisors, Reciprocal};
use super::recurrence::Recurrence;
use super::series::{SUMS, SeriesRow};
use super::start::{Constants, Origin};
use crate::scalar::Scalar;
use crate::simd::{Kernel, Simd};

/// Order from which on the accelerations at the start are refined. It is the order for tolerances
/// of 1e-13; for smaller tolerances, rounding causes most of the error.
const REFINED: usize = 28;

/// Computation of the orders of an expansion, from order 1 on.
pub(super) struct Orders<'a, T, L, S, R, B> {
    pub(super) links: L,
    pub(super) buffer: R,
    pub(super) origin: Origin<'a, T, S>,
    pub(super) constants: Constants<'a, T>,
    /// For each order, the coefficients of all angles, then of all angular velocities.
    pub(super) coefficients: &'a mut [T],
    /// Number of orders in `coefficients`.
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
    R: PackBuffer<T>,
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
    R: PackBuffer<T>,
    B: Bias<T>,
{
    /// Computes the orders in packs. `SEVERAL` is true if a number holds several states. It calls
    /// only the caller's closure, and only at one point, because a function that is not inlined is
    /// compiled without vector registers.
    #[inline(always)]
    pub(super) fn form<P: Simd<T>, V: Simd<T>, const SEVERAL: bool>(self) {
        let (links, mut buffer) = (self.links, self.buffer);
        let n = links.count();
        let (origin, constants) = (self.origin.first_links(n), self.constants.first_links(n));
        let last = self.count.saturating_sub(1);
        let factors = self.factors;
        let system =
            TaylorElimination::new::<P::One, S>(links, &mut buffer, &origin, &constants, factors);
        let mut recurrence = Recurrence::<T, P, R, L, B> {
            system,
            bias: self.bias,
            rows: self.rows,
            count: self.count,
            quads: buffer.quads(),
            omega: buffer.of_packs::<P, 1>(),
            turn: buffer.of_packs::<P, 2>(),
            weight: buffer.of_packs::<P, 2>(),
            x: buffer.of_packs::<P, 1>(),
            c: buffer.of_packs::<P, 1>(),
            s: buffer.of_packs::<P, 1>(),
            y: buffer.of_packs::<P, 1>(),
            s_rest: buffer.of_packs::<P, 1>(),
            force: buffer.of_packs::<P, 1>(),
            sums: buffer.of_packs::<P, SUMS>(),
            next_sums: buffer.of_packs::<P, SUMS>(),
            theta: buffer.quads(),
            velocity: buffer.quads(),
            sines: buffer.quads(),
            cosines: buffer.quads(),
            buffer,
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
