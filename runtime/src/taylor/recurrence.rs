//! State of the recurrences of an expansion, in packs of links.

use super::bias::{Bias, KnownState};
use super::buffer::{PackBuffer, PackColumn, SharedNumbers, collect, read};
use super::elimination::TaylorElimination;
use super::links::TreeLinks;
use super::reciprocal::{Divisors, Reciprocal};
use super::refine::Balance;
use super::series::{SUMS, SeriesRow, SeriesSums, sine_coefficients, store};
use super::start::{Constants, Origin, weights};
use crate::scalar::Scalar;
use crate::simd::Simd;

/// Largest number of links for which the sums of a single state are computed order by order. For
/// more links, two orders are computed at a time, because computing then takes longer than waiting
/// for results.
const IN_TURN: usize = 15;

/// Quantities that all orders take from the start, and quantities that each order takes from the
/// orders before, in packs `P`. The symbols are defined in [`orders`](super::orders).
pub(super) struct Recurrence<'a, T, P, R, L, B>
where
    T: Scalar,
    P: Simd<T>,
    R: PackBuffer<T>,
{
    pub(super) links: L,
    pub(super) system: TaylorElimination<'a, T, L>,
    pub(super) bias: B,
    pub(super) buffer: R,
    pub(super) rows: &'a mut [SeriesRow<T>],
    /// Number of orders stored for each group of four links.
    pub(super) count: usize,
    /// Angular velocities ω\[0\] at the start.
    pub(super) omega: R::OfPacks<P, 1>,
    /// Cosine and sine of the angles θ at the start.
    pub(super) turn: R::OfPacks<P, 2>,
    /// Weights along and across the links' directions at the start.
    pub(super) weight: R::OfPacks<P, 2>,
    /// Coefficients X, C, S and Y of the newest order.
    pub(super) x: R::OfPacks<P, 1>,
    pub(super) c: R::OfPacks<P, 1>,
    pub(super) s: R::OfPacks<P, 1>,
    pub(super) y: R::OfPacks<P, 1>,
    /// Difference S − α of the newest order.
    pub(super) s_rest: R::OfPacks<P, 1>,
    /// Coefficient X of the newest order without the torque of gravity.
    pub(super) force: R::OfPacks<P, 1>,
    /// Sums of products for the current order, and for the next order as far as they are known.
    pub(super) sums: R::OfPacks<P, SUMS>,
    pub(super) next_sums: R::OfPacks<P, SUMS>,
    /// Coefficients of the newest order of the angles and angular velocities of all links.
    pub(super) theta: R::Quads,
    pub(super) velocity: R::Quads,
    pub(super) sines: R::Quads,
    pub(super) cosines: R::Quads,
    /// Workspace of the elimination.
    pub(super) quads: R::Quads,
}

impl<T, P, R, L, B> Recurrence<'_, T, P, R, L, B>
where
    T: Scalar,
    P: Simd<T>,
    R: PackBuffer<T>,
    L: TreeLinks,
    B: Bias<T>,
{
    /// Computes order 0 of all series, and order 1 of ω, γ and σ.
    #[inline(always)]
    pub(super) fn start<V: Simd<T>>(
        &mut self,
        origin: &Origin<'_, T, impl SharedNumbers<T>>,
        constants: &Constants<'_, T>,
    ) {
        let zero = P::splat(T::from_f64(0.0));
        let size = [self.buffer.packs(), self.links.count()];
        let quads = self.quads.as_mut();
        read(origin.omega, quads, size, 0, &mut self.omega);
        read(origin.cosines, quads, size, 0, &mut self.turn);
        read(origin.sines, quads, size, 1, &mut self.turn);
        read(constants.weights, quads, size, 0, &mut self.weight);
        read(constants.lateral_weights, quads, size, 1, &mut self.weight);
        read(origin.bias, quads, size, 0, &mut self.x);
        for m in 0..self.buffer.packs() {
            let ([velocity], [first_bias]) = (self.omega.at(m), self.x.at(m));
            // The bias of order 0 includes the weight.
            self.x.put(m, [zero - first_bias]);
            self.c.put(m, [zero.minus_product(velocity, velocity)]);
            self.s_rest.put(m, [zero]);
            let (row, place) = self.row_of_pack(m, 0);
            store(
                [velocity, zero, velocity, zero, zero],
                &mut self.rows[row],
                place,
            );
        }
        self.solve_under::<V>(self.bias.acceleration_coefficients(0));
    }

    /// Refines S and Y of order 0 by one step of iterative refinement.
    #[inline(always)]
    pub(super) fn refine<V: Simd<T>, S: SharedNumbers<T>>(
        &mut self,
        origin: Origin<'_, T, S>,
        constants: Constants<'_, T>,
    ) {
        let balance = Balance {
            links: self.links,
            origin,
            constants,
            turn: &self.turn,
            weight: &self.weight,
            fall: self.bias.acceleration_coefficients(0),
        };
        let quads = self.quads.as_mut();
        balance.residual::<P, _>(&mut self.buffer.rest(), quads, &self.s, &mut self.force);
        let packs = self.buffer.packs();
        let mut buffer = self.buffer.rest();
        let mut none = buffer.of_packs::<P, 1>();
        let (mut more_s, mut more_y) = (buffer.of_packs::<P, 1>(), buffer.of_packs::<P, 1>());
        for m in 0..packs {
            none.put(m, [P::splat(T::from_f64(0.0))]);
        }
        let answers = [&mut more_s, &mut more_y];
        self.system
            .solve::<P, V>(buffer.rest(), &self.force, &none, answers);
        for m in 0..packs {
            let ([of_s], [of_y]) = (self.s.at(m), self.y.at(m));
            let ([more_s], [more_y]) = (more_s.at(m), more_y.at(m));
            self.s.put(m, [of_s + more_s]);
            self.y.put(m, [of_y + more_y]);
        }
    }

    /// Computes those terms of the sums of order k that do not depend on S\[k−1\] and α\[k−1\], so
    /// that both computations overlap.
    #[inline(always)]
    pub(super) fn add_up<const SEVERAL: bool>(&mut self, k: usize) {
        for m in 0..self.buffer.packs() {
            let (first, place) = self.row_of_pack(m, 0);
            let lower = &self.rows[first..][..k];
            let now = if !SEVERAL && self.links.count() <= IN_TURN {
                SeriesSums::of(&lower[1..], place)
            } else if k % 2 == 1 {
                let [now, next] = SeriesSums::pair(lower, place);
                self.next_sums.put(m, next.numbers());
                now
            } else {
                let mut now = SeriesSums::from_numbers(self.next_sums.at(m));
                now.complete(lower, place);
                now
            };
            self.sums.put(m, now.numbers());
        }
    }

    /// Stores the coefficients of X and Y of order k − 1; then computes those of order k of C, of S
    /// − α, and of X without the bias.
    #[inline(always)]
    pub(super) fn append(&mut self, k: usize, divisors: Divisors<P>) {
        let Divisors {
            next,
            over_k,
            over_both,
            ..
        } = divisors;
        for m in 0..self.buffer.packs() {
            let ([velocity_0], [of_s], [of_y]) = (self.omega.at(m), self.s.at(m), self.y.at(m));
            let ([of_c], [rest], [of_x]) = (self.c.at(m), self.s_rest.at(m), self.x.at(m));
            let sums = SeriesSums::from_numbers(self.sums.at(m));
            let alpha = of_s - rest;
            let (cos, sin) = (over_both.times(of_c), over_both.times(of_s));
            let rise = over_k.times(alpha);
            let (row, place) = self.row_of_pack(m, k);
            store([rise, cos, sin, of_x, of_y], &mut self.rows[row], place);
            rise.store_quad(self.velocity.as_mut(), m);
            over_both.times(alpha).store_quad(self.theta.as_mut(), m);

            // The products ω/k, ω (k+1)/k, ω (k+2)/k.
            let rate = over_k.times(velocity_0);
            let rate_1 = velocity_0 + rate;
            let slowing = rate_1 + rate;
            self.x.put(m, [sums.force().plus_product(velocity_0, of_y)]);
            let s_rest_next = (next * sums.omega_cos).plus_product(rate, of_c);
            let c_next = (rate_1 * rest)
                .minus_product(next, sums.omega_sin)
                .minus_product(slowing, of_s);
            self.c.put(m, [c_next]);
            self.s_rest.put(m, [s_rest_next]);
        }
    }

    /// Writes the coefficients of the angular velocities of order k and of the angles of order
    /// k + 1. Returns both rows of order k.
    #[inline(always)]
    pub(super) fn write_coefficients<'c>(
        &mut self,
        k: usize,
        coefficients: &'c mut [T],
    ) -> [&'c [T]; 2] {
        let n = self.links.count();
        let (lower, higher) = coefficients.split_at_mut((k + 1) * 2 * n);
        let (angles, velocities) = lower[k * 2 * n..].split_at_mut(n);
        collect(self.velocity.as_mut(), velocities);
        collect(self.theta.as_mut(), &mut higher[..n]);
        [angles, velocities]
    }

    /// Writes the coefficients of the angular velocities of the last order.
    #[inline(always)]
    pub(super) fn write_last_velocities(
        &mut self,
        last: usize,
        over_last: Reciprocal<P>,
        coefficients: &mut [T],
    ) {
        let n = self.links.count();
        for m in 0..self.buffer.packs() {
            let ([of_s], [rest]) = (self.s.at(m), self.s_rest.at(m));
            over_last
                .times(of_s - rest)
                .store_quad(self.velocity.as_mut(), m);
        }
        let velocities = &mut coefficients[(2 * last + 1) * n..][..n];
        collect(self.velocity.as_mut(), velocities);
    }

    /// Subtracts the bias of order k from X; `theta` and `omega` are the coefficients of order k.
    #[inline(always)]
    pub(super) fn take_bias(&mut self, k: usize, [theta, omega]: [&[T]; 2]) {
        if !self.bias.moves() {
            return;
        }
        if B::NEEDS_SINES {
            self.turn_back(k);
        }
        let known = KnownState {
            order: k,
            theta,
            omega,
            sines: self.sines.as_mut(),
            cosines: self.cosines.as_mut(),
        };
        let bias = self.quads.as_mut();
        self.bias.write(known, bias);
        for m in 0..self.buffer.packs() {
            let [of_x] = self.x.at(m);
            self.x.put(m, [of_x - P::load_quad(bias, m)]);
        }
    }

    /// Computes the coefficients of order k of sin θ and cos θ from γ and σ, which are relative to
    /// the angles at the start.
    #[inline(always)]
    fn turn_back(&mut self, k: usize) {
        for m in 0..self.buffer.packs() {
            let (row, place) = self.row_of_pack(m, k - 1);
            let [cos, sin] = sine_coefficients::<T, P>(&self.rows[row], place);
            let [c0, s0] = self.turn.at(m);
            let (upright, level) = (c0 * cos, c0 * sin);
            level
                .plus_product(s0, cos)
                .store_quad(self.sines.as_mut(), m);
            upright
                .minus_product(s0, sin)
                .store_quad(self.cosines.as_mut(), m);
        }
    }

    /// Computes the coefficients S and Y of order k.
    #[inline(always)]
    pub(super) fn solve<V: Simd<T>>(&mut self, k: usize) {
        if let Some(fall) = self.bias.acceleration_coefficients(k) {
            return self.solve_under::<V>(Some(fall));
        }
        let answers = [&mut self.s, &mut self.y];
        self.system
            .solve::<P, V>(self.buffer.rest(), &self.x, &self.c, answers);
    }

    /// Computes the coefficients S and Y of one order, given the coefficient `fall` of the
    /// acceleration of the root's pivot.
    #[inline(always)]
    fn solve_under<V: Simd<T>>(&mut self, fall: Option<[T; 2]>) {
        for m in 0..self.buffer.packs() {
            let [across, _] = pull(fall, self.weight.at(m), self.turn.at(m));
            let [of_x] = self.x.at(m);
            self.force.put(m, [of_x - across]);
        }
        let answers = [&mut self.s, &mut self.y];
        self.system
            .solve::<P, V>(self.buffer.rest(), &self.force, &self.c, answers);
        for m in 0..self.buffer.packs() {
            let [_, along] = pull(fall, self.weight.at(m), self.turn.at(m));
            let [of_links] = self.y.at(m);
            self.y.put(m, [of_links + along]);
        }
    }

    /// Returns the row that contains a pack of links in an order, and the index of the pack in that
    /// row.
    #[inline(always)]
    fn row_of_pack(&self, pack: usize, order: usize) -> (usize, usize) {
        let packs_of_four = 4 / P::LANES;
        (
            pack / packs_of_four * self.count + order,
            pack % packs_of_four,
        )
    }
}

/// Returns X and Y of order 0 that correspond to gravity: its torque (G s₀ + F c₀) γ + (G c₀ − F
/// s₀) σ, with s₀, c₀ of the angle at the start. The acceleration of the root's pivot, of any
/// order, has the same form.
#[inline(always)]
fn pull<T: Scalar, P: Simd<T>>(fall: Option<[T; 2]>, weight: [P; 2], [cos, sin]: [P; 2]) -> [P; 2] {
    let [of_sine, of_cosine] = weights(fall, weight);
    [
        (of_sine * sin).plus_product(of_cosine, cos),
        (of_cosine * sin).minus_product(of_sine, cos),
    ]
}
