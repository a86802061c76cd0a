//! Friction that is not viscous, order by order.

use super::sums::{rows, sums};
use crate::scalar::Scalar;
use crate::simd::Quad;

/// Friction of a link that is not viscous: −(C/s + q s) w at the rate w, with the speed
/// s = √(w² + ε²).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughFriction<T> {
    /// Number of the link.
    pub link: usize,
    /// The link relative to whose rate the link's is meant, which has the opposite torque; none
    /// for the link's own rate.
    pub other: Option<usize>,
    /// C.
    pub coulomb: T,
    /// q.
    pub quadratic: T,
    /// ε.
    pub width: T,
}

impl<T> RoughFriction<T> {
    /// Takes the constants through `convert`.
    pub(super) fn map<S>(&self, convert: impl Fn(T) -> S) -> RoughFriction<S>
    where
        T: Copy,
    {
        RoughFriction {
            link: self.link,
            other: self.other,
            coulomb: convert(self.coulomb),
            quadratic: convert(self.quadratic),
            width: convert(self.width),
        }
    }
}

/// Quads that a law of friction works in, in an expansion to order `order`: its values at the
/// start, and the factors of its four products.
pub(super) const fn law_room(order: usize) -> usize {
    1 + 2 * (order + 1)
}

impl<T: Scalar> RoughFriction<T> {
    /// Returns (C/s + q s) w at the start, and notes w, s, 1/s and C/s + q s.
    #[inline(always)]
    pub(super) fn start(&self, rate: T, room: &mut [Quad<T>]) -> T {
        let speed = (rate * rate + self.width * self.width).sqrt();
        let inverse = T::from_f64(1.0) / speed;
        let factor = self.coulomb * inverse + self.quadratic * speed;
        if let Some(start) = room.first_mut() {
            *start = Quad([rate, speed, inverse, factor]);
        }
        factor * rate
    }

    /// Returns the coefficient of order k of that, given that of w, by the products w w,
    /// s s = w w + ε², (1/s) s = 1 and (C/s + q s) w.
    #[inline(always)]
    pub(super) fn order(&self, k: usize, rate: T, room: &mut [Quad<T>]) -> T {
        let Some((start, room)) = room.split_first_mut() else {
            return T::from_f64(f64::NAN);
        };
        let (factors, _) = rows::<T, 1>(room, room.len() / 2);
        let [Quad([rates, speeds, ones, torques])] = sums(k, factors);
        let Quad([rate_0, speed_0, inverse_0, factor_0]) = *start;
        let square = rates + (rate_0 * rate + rate * rate_0);
        let speed = (square - speeds) / (speed_0 + speed_0);
        let inverse = -(ones + speed * inverse_0) * inverse_0;
        let factor = self.coulomb * inverse + self.quadratic * speed;
        if let Some(own) = k.checked_sub(1).and_then(|row| factors.get_mut(row)) {
            *own = [
                [Quad([rate, speed, inverse, factor])],
                [Quad([rate, speed, speed, rate])],
            ];
        }
        torques + (factor_0 * rate + factor * rate_0)
    }
}
