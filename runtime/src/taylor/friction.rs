//! Taylor series of Coulomb, Stribeck and quadratic friction, order by order.

use super::sums::{rows, sums};
use crate::friction::FrictionLaw;
use crate::scalar::Scalar;
use crate::simd::Quad;

/// Non-viscous friction of a link: the torque −(A/s + q s) w of a [`FrictionLaw`] at the rate w.
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
/// its values at the start, and the factors of its six products.
pub(super) const fn law_buffer_len(order: usize) -> usize {
    2 + 4 * (order + 1)
}

impl<T: Scalar> NonViscousFriction<T> {
    /// Returns the friction torque (A/s + q s) w at the start, and stores w, s, 1/s, A/s + q s and g
    /// = 1/(ϖ² + w²).
    #[inline(always)]
    pub(super) fn start(&self, rate: T, buffer: &mut [Quad<T>]) -> T {
        let [zero, one] = [0.0, 1.0].map(T::from_f64);
        let speed = self.law.speed(rate);
        let inverse = one / speed;
        let ratio = one / (self.law.stribeck * self.law.stribeck + rate * rate);
        let factor = self.law.factor(speed, inverse, ratio * inverse);
        if let Some([first, second]) = buffer.first_chunk_mut() {
            *first = Quad([rate, speed, inverse, factor]);
            *second = Quad([ratio, zero, zero, zero]);
        }
        factor * rate
    }

    /// Returns the Taylor coefficient of order k of the friction torque (A/s + q s) w, from the
    /// coefficients of the rate w, by the products w w, s s = w w + ε², (1/s) s = 1, (ϖ² + w w) g =
    /// 1, g (1/s) and (A/s + q s) w.
    #[inline(always)]
    pub(super) fn order(&self, k: usize, rate: T, buffer: &mut [Quad<T>]) -> T {
        let zero = T::from_f64(0.0);
        let Some(([first, second], buffer)) = buffer.split_first_chunk_mut() else {
            return T::from_f64(f64::NAN);
        };
        let (factors, _) = rows::<T, 2>(buffer, buffer.len() / 4);
        let [
            Quad([rates, speeds, ones, torques]),
            Quad([ratios, products, _, _]),
        ] = sums(k, factors);
        let Quad([rate_0, speed_0, inverse_0, factor_0]) = *first;
        let Quad([ratio_0, ..]) = *second;
        let square = rates + (rate_0 * rate + rate * rate_0);
        let speed = (square - speeds) / (speed_0 + speed_0);
        let inverse = -(ones + speed * inverse_0) * inverse_0;
        let ratio = -(ratios + square * ratio_0) * ratio_0;
        let product = products + (ratio_0 * inverse + ratio * inverse_0);
        let factor = self.law.factor(speed, inverse, product);
        if let Some(own) = k.checked_sub(1).and_then(|row| factors.get_mut(row)) {
            let left = Quad([rate, speed, inverse, factor]);
            let right = Quad([rate, speed, speed, rate]);
            *own = [
                [left, Quad([square, ratio, zero, zero])],
                [right, Quad([ratio, inverse, zero, zero])],
            ];
        }
        torques + (factor_0 * rate + factor * rate_0)
    }
}
