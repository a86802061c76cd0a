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

use super::bias::{Bias, KnownState};
use super::elimination::{LinkFactors, TaylorElimination};
use super::links::TreeLinks;
use super::reciprocal::Reciprocal;
use super::refine::Balance;
use super::room::{PackColumn, PackRoom, SharedNumbers, collect, read};
use super::series::{SUMS, SeriesRow, SeriesSums, store, turned};
use super::start::{Constants, Origin, weights};
use crate::scalar::Scalar;
use crate::simd::{Kernel, Simd};

/// From this order on the accelerations at the start are refined: the order for
/// tolerances of 1e-13, below which rounding is most of the error.
const REFINED: usize = 28;

/// Number of links up to which one state has its sums formed order by order, from which
/// two orders at a time: for more links the machine computes more than it waits.
const IN_TURN: usize = 15;

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
        let Self {
            links,
            mut room,
            origin,
            constants,
            coefficients,
            count: orders,
            rows,
            factors,
            mut bias,
        } = self;
        let (packs, n) = (room.packs(), links.count());
        let (origin, constants) = (origin.first_links(n), constants.first_links(n));
        let last = orders.saturating_sub(1);
        // Packs of a quad.
        let packs_of_four = 4 / P::LANES;
        let system =
            TaylorElimination::new::<P::One, S>(links, &mut room, &origin, &constants, factors);

        // Order 0, and 1 of ω, γ, σ.
        let zero = P::splat(T::from_f64(0.0));
        let mut quads = room.quads();
        let mut omega = room.of_packs::<P, 1>();
        let mut turn = room.of_packs::<P, 2>();
        let mut weight = room.of_packs::<P, 2>();
        let (mut x, mut c) = (room.of_packs::<P, 1>(), room.of_packs::<P, 1>());
        let (mut s, mut y) = (room.of_packs::<P, 1>(), room.of_packs::<P, 1>());
        let (mut s_rest, mut force) = (room.of_packs::<P, 1>(), room.of_packs::<P, 1>());
        let size = [packs, n];
        read(origin.omega, quads.as_mut(), size, 0, &mut omega);
        read(origin.cosines, quads.as_mut(), size, 0, &mut turn);
        read(origin.sines, quads.as_mut(), size, 1, &mut turn);
        read(constants.weights, quads.as_mut(), size, 0, &mut weight);
        read(
            constants.lateral_weights,
            quads.as_mut(),
            size,
            1,
            &mut weight,
        );
        read(origin.bias, quads.as_mut(), size, 0, &mut x);
        for m in 0..packs {
            let ([velocity], [first_bias]) = (omega.at(m), x.at(m));
            // X with the weight in it.
            let own = zero - first_bias;
            let [across, _] = pull(bias.fall(0), weight.at(m), turn.at(m));
            x.put(m, [own]);
            force.put(m, [own - across]);
            c.put(m, [zero.minus_product(velocity, velocity)]);
            s_rest.put(m, [zero]);
            let (row, place) = (m / packs_of_four * orders, m % packs_of_four);
            store(
                [velocity, zero, velocity, zero, zero],
                &mut rows[row],
                place,
            );
        }
        system.solve::<P, V>(room.rest(), &force, &c, [&mut s, &mut y]);
        for m in 0..packs {
            let ([of_links], [_, along]) = (y.at(m), pull(bias.fall(0), weight.at(m), turn.at(m)));
            y.put(m, [of_links + along]);
        }
        if last >= REFINED {
            let balance = Balance {
                links,
                origin,
                constants,
                turn: &turn,
                weight: &weight,
                fall: bias.fall(0),
            };
            balance.residual::<P, _>(&mut room.rest(), quads.as_mut(), &s, &mut force);
            let mut room = room.rest();
            let mut none = room.of_packs::<P, 1>();
            let (mut more_s, mut more_y) = (room.of_packs::<P, 1>(), room.of_packs::<P, 1>());
            for m in 0..packs {
                none.put(m, [zero]);
            }
            system.solve::<P, V>(room.rest(), &force, &none, [&mut more_s, &mut more_y]);
            for m in 0..packs {
                let ([of_s], [of_y]) = (s.at(m), y.at(m));
                let ([more_s], [more_y]) = (more_s.at(m), more_y.at(m));
                s.put(m, [of_s + more_s]);
                y.put(m, [of_y + more_y]);
            }
        }

        let one = P::from_f64(1.0);
        let mut number = one;
        let mut over_next = Reciprocal::of(one);
        let (mut sums, mut next_sums) = (room.of_packs::<P, SUMS>(), room.of_packs::<P, SUMS>());
        let (mut theta, mut velocity) = (room.quads(), room.quads());
        let (mut sines, mut cosines) = (room.quads(), room.quads());
        for k in 1..last {
            let over_k = over_next;
            let over_both = Reciprocal::of(number * (number + one));
            number = number + one;
            over_next = Reciprocal::of(number);

            // X and C as far as they do not depend on S[k−1] and α[k−1]: there
            // was time for them while these were formed.
            for m in 0..packs {
                let lower = &rows[m / packs_of_four * orders..][..k];
                let place = m % packs_of_four;
                if !SEVERAL && n <= IN_TURN {
                    sums.put(m, SeriesSums::of(&lower[1..], place).numbers());
                } else if k % 2 == 1 {
                    let [now, next] = SeriesSums::pair(lower, place);
                    sums.put(m, now.numbers());
                    next_sums.put(m, next.numbers());
                } else {
                    let mut now = SeriesSums::from_numbers(next_sums.at(m));
                    now.complete(lower, place);
                    sums.put(m, now.numbers());
                }
            }
            for m in 0..packs {
                let ([velocity_0], [of_s], [of_y]) = (omega.at(m), s.at(m), y.at(m));
                let ([of_c], [rest], [of_x]) = (c.at(m), s_rest.at(m), x.at(m));
                let sums = SeriesSums::from_numbers(sums.at(m));
                let alpha = of_s - rest;
                let (cos, sin) = (over_both.times(of_c), over_both.times(of_s));
                let rise = over_k.times(alpha);
                let (row, place) = (m / packs_of_four * orders + k, m % packs_of_four);
                store([rise, cos, sin, of_x, of_y], &mut rows[row], place);
                rise.store_quad(velocity.as_mut(), m);
                over_both.times(alpha).store_quad(theta.as_mut(), m);

                // ω/k, ω (k+1)/k, ω (k+2)/k
                let rate = over_k.times(velocity_0);
                let rate_1 = velocity_0 + rate;
                let slowing = rate_1 + rate;
                x.put(m, [sums.force().plus_product(velocity_0, of_y)]);
                let s_rest_next = (number * sums.omega_cos).plus_product(rate, of_c);
                let c_next = (rate_1 * rest)
                    .minus_product(number, sums.omega_sin)
                    .minus_product(slowing, of_s);
                c.put(m, [c_next]);
                s_rest.put(m, [s_rest_next]);
            }
            let (lower, higher) = coefficients.split_at_mut((k + 1) * 2 * n);
            let (angles, velocities) = lower[k * 2 * n..].split_at_mut(n);
            collect(velocity.as_mut(), velocities);
            collect(theta.as_mut(), &mut higher[..n]);
            if bias.moves() {
                if B::TURNS {
                    for m in 0..packs {
                        let row = &rows[m / packs_of_four * orders + k - 1];
                        let [cos, sin] = turned::<T, P>(row, m % packs_of_four);
                        let [c0, s0] = turn.at(m);
                        let (upright, level) = (c0 * cos, c0 * sin);
                        level.plus_product(s0, cos).store_quad(sines.as_mut(), m);
                        upright
                            .minus_product(s0, sin)
                            .store_quad(cosines.as_mut(), m);
                    }
                }
                let known = KnownState {
                    order: k,
                    theta: angles,
                    omega: velocities,
                    sines: sines.as_mut(),
                    cosines: cosines.as_mut(),
                };
                bias.write(known, quads.as_mut());
                for m in 0..packs {
                    let [of_x] = x.at(m);
                    x.put(m, [of_x - P::load_quad(quads.as_mut(), m)]);
                }
            }
            let Some(fall) = bias.fall(k) else {
                system.solve::<P, V>(room.rest(), &x, &c, [&mut s, &mut y]);
                continue;
            };
            for m in 0..packs {
                let ([of_x], [across, _]) = (x.at(m), pull(Some(fall), weight.at(m), turn.at(m)));
                force.put(m, [of_x - across]);
            }
            system.solve::<P, V>(room.rest(), &force, &c, [&mut s, &mut y]);
            for m in 0..packs {
                let ([of_links], [_, along]) =
                    (y.at(m), pull(Some(fall), weight.at(m), turn.at(m)));
                y.put(m, [of_links + along]);
            }
        }
        if last > 0 {
            for m in 0..packs {
                let ([of_s], [rest]) = (s.at(m), s_rest.at(m));
                over_next
                    .times(of_s - rest)
                    .store_quad(velocity.as_mut(), m);
            }
            collect(
                velocity.as_mut(),
                &mut coefficients[(2 * last + 1) * n..][..n],
            );
        }
    }
}

/// Gravity is a constant force: its torque (G s₀ + F c₀) γ + (G c₀ − F s₀) σ, with
/// s₀, c₀ of the angle at the start, is that of an X and of a Y of order 0. So is the
/// acceleration of the root's pivot, of any order.
#[inline(always)]
fn pull<T: Scalar, P: Simd<T>>(fall: Option<[T; 2]>, weight: [P; 2], [cos, sin]: [P; 2]) -> [P; 2] {
    let [of_sine, of_cosine] = weights(fall, weight);
    [
        (of_sine * sin).plus_product(of_cosine, cos),
        (of_cosine * sin).minus_product(of_sine, cos),
    ]
}
