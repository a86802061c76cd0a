//! Taylor series of Coulomb and quadratic friction, order by order.

use super::sums::{rows, sums};
use crate::friction::FrictionLaw;
use crate::scalar::Scalar;
use crate::simd::Quad;

/// Non-viscous friction of a link: the torque −(C/s + q s) w at the rate w, with the smoothed speed
/// s = √(w² + ε²), Coulomb torque C and quadratic coefficient q.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NonViscousFriction<T> {
    /// Index of the link.
    pub link: usize,
    /// Link relative to which the rate is measured, and on which the opposite torque acts; `None`
    /// for the absolute rate.
    pub other: Option<usize>,
    /// Law of the friction.
    pub law: FrictionLaw<T>,
}

impl<T> NonViscousFriction<T> {
    /// Converts the constants with `convert`.
    pub(super) fn map<S>(&self, convert: impl Fn(T) -> S) -> NonViscousFriction<S>
    where
        T: Copy,
    {
        NonViscousFriction {
            link: self.link,
            other: self.other,
            law: self.law.map(convert),
        }
    }
}

/// Returns the workspace length, in quads, of one friction law in an expansion to order `order`:
/// its values at the start, and the factors of its four products.
pub(super) const fn law_buffer_len(order: usize) -> usize {
    1 + 2 * (order + 1)
}

impl<T: Scalar> NonViscousFriction<T> {
    /// Returns the friction torque (C/s + q s) w at the start, and stores w, s, 1/s and C/s + q s.
    #[inline(always)]
    pub(super) fn start(&self, rate: T, buffer: &mut [Quad<T>]) -> T {
        let speed = self.law.speed(rate);
        let inverse = T::from_f64(1.0) / speed;
        let factor = self.law.factor(inverse, speed);
        if let Some(start) = buffer.first_mut() {
            *start = Quad([rate, speed, inverse, factor]);
        }
        factor * rate
    }

    /// Returns the Taylor coefficient of order k of the friction torque (C/s + q s) w, from the
    /// coefficients of the rate w, by the products w w, s s = w w + ε², (1/s) s = 1 and (C/s + q s)
    /// w.
    #[inline(always)]
    pub(super) fn order(&self, k: usize, rate: T, buffer: &mut [Quad<T>]) -> T {
        let Some((start, buffer)) = buffer.split_first_mut() else {
            return T::from_f64(f64::NAN);
        };
        let (factors, _) = rows::<T, 1>(buffer, buffer.len() / 2);
        let [Quad([rates, speeds, ones, torques])] = sums(k, factors);
        let Quad([rate_0, speed_0, inverse_0, factor_0]) = *start;
        let square = rates + (rate_0 * rate + rate * rate_0);
        let speed = (square - speeds) / (speed_0 + speed_0);
        let inverse = -(ones + speed * inverse_0) * inverse_0;
        let factor = self.law.factor(inverse, speed);
        if let Some(own) = k.checked_sub(1).and_then(|row| factors.get_mut(row)) {
            *own = [
                [Quad([rate, speed, inverse, factor])],
                [Quad([rate, speed, speed, rate])],
            ];
        }
        torques + (factor_0 * rate + factor * rate_0)
    }
}
