//! Energies of a table of links, from the root to the leaves.

use super::energy::Sum;
use super::vector::Vector;
use crate::scalar::Scalar;

/// How many numbers a link [`kinetic`] needs room for.
pub(super) const KINETIC: usize = 4;

/// How many numbers a link [`potential`] needs room for.
pub(super) const POTENTIAL: usize = 2;

fn parent(parents: &[u32], link: usize) -> usize {
    parents.get(link).map_or(0, |&parent| parent as usize)
}

/// K = Σ ½ m (V + d ω v)² + ½ I ω² over all links, V the velocity of a link's
/// pivot, v = (cos θ, sin θ); V = V_parent + ℓ ω_parent v_parent.
pub(super) fn kinetic<T: Scalar>(
    parents: &[u32],
    constants: &[[T; 7]],
    theta: &[T],
    omega: &[T],
    buffer: &mut [T],
) -> T {
    let n = theta.len();
    let zero = T::from_f64(0.0);
    // Velocities of pivots, and ω v.
    let (pivots_x, buffer) = buffer.split_at_mut(n);
    let (pivots_y, buffer) = buffer.split_at_mut(n);
    let (turns_x, turns_y) = buffer.split_at_mut(n);
    let mut sum = Sum::new();
    for (link, constants) in constants.iter().enumerate() {
        let &[half_mass, moment, half_inertia, lever, ..] = constants;
        let [x, y] = if link == 0 {
            [zero, zero]
        } else {
            let parent = parent(parents, link);
            [
                T::load(pivots_x, parent) + lever * T::load(turns_x, parent),
                T::load(pivots_y, parent) + lever * T::load(turns_y, parent),
            ]
        };
        let (sine, cosine) = T::load(theta, link).sin_cos();
        let rate = T::load(omega, link);
        let [turn_x, turn_y] = [rate * cosine, rate * sine];
        let own = half_mass * (x * x + y * y) + half_inertia * rate * rate;
        sum.add(own + moment * (x * turn_x + y * turn_y));
        x.store(pivots_x, link);
        y.store(pivots_y, link);
        turn_x.store(turns_x, link);
        turn_y.store(turns_y, link);
    }
    sum.total()
}

/// U = Σ m g H + m g d (1 − cos θ) + ½ κ (θ − θ_parent)² over all links, H the
/// height of a link's pivot above its lowest place:
/// H = H_parent + ℓ (1 − cos θ_parent).
pub(super) fn potential<T: Scalar>(
    parents: &[u32],
    constants: &[[T; 7]],
    theta: &[T],
    buffer: &mut [T],
) -> T {
    let (heights, rises) = buffer.split_at_mut(theta.len());
    let one = T::from_f64(1.0);
    let mut sum = Sum::new();
    for (link, constants) in constants.iter().enumerate() {
        let &[_, _, _, lever, weight, gravity, half_spring] = constants;
        let angle = T::load(theta, link);
        let (height, bend) = if link == 0 {
            (T::from_f64(0.0), angle)
        } else {
            let parent = parent(parents, link);
            (
                T::load(heights, parent) + lever * T::load(rises, parent),
                angle - T::load(theta, parent),
            )
        };
        let (_, cosine) = angle.sin_cos();
        let rise = one - cosine;
        sum.add(weight * height + gravity * rise + half_spring * bend * bend);
        height.store(heights, link);
        rise.store(rises, link);
    }
    sum.total()
}
