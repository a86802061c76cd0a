//! Springs, repulsions and dampers along lines between points, order by order.
//!
//! With the arms (x, y) of a line, x' = −ω y and y' = ω x. The line is d = d₀ + Σ (x, y), its
//! square q = d·d, and the moment of an arm d_y x − d_x y. The pull over the length is a sum of
//! constants, of powers p = ℓ⁻ᵐ = q^(−m/2), for which 2 q p' = −m q' p, and of the damper's
//! c (d·ḋ)/q. The torque on the link of an arm is the pull times its moment.

use super::sums::whole;
use crate::scalar::Scalar;
use crate::simd::Quad;
use crate::translational::{TranslationalSpringDamper, length_to};

/// m of the power ℓ⁻ᵐ in the pull of a damper.
const DAMPER: u32 = 2;

/// Series of each arm: ω, x, y and the moment.
const OF_ARM: usize = 4;

/// Series of a line beside those of its arms and powers: the components of d and of its rate,
/// q, d·ḋ and the pull.
const OF_LINE: usize = 7;

/// The series of a line.
#[derive(Clone, Copy)]
enum Place {
    Rate(usize),
    X(usize),
    Y(usize),
    Moment(usize),
    Offset(usize),
    Moving(usize),
    Square,
    Stretching,
    Pull,
    Power(usize),
}

/// Quads that a line works in, in an expansion to order `order`.
pub(super) fn line_room<T>(line: &TranslationalSpringDamper<T>, order: usize) -> usize {
    let powers = line.potentials.len() + 1;
    let series = OF_ARM * line.arms.len() + OF_LINE + powers;
    (series * (order + 1)).div_ceil(4)
}

/// The series of a line up to some order.
pub(super) struct LineSeries<'a, T> {
    pub(super) line: &'a TranslationalSpringDamper<T>,
    /// As [`line_room`] says.
    pub(super) room: &'a mut [Quad<T>],
    /// Number of orders that there is room for.
    pub(super) orders: usize,
}

impl<T: Scalar> LineSeries<'_, T> {
    #[inline(always)]
    fn index(&self, series: Place, order: usize) -> usize {
        let line = OF_ARM * self.line.arms.len();
        let series = match series {
            Place::Rate(arm) => OF_ARM * arm,
            Place::X(arm) => OF_ARM * arm + 1,
            Place::Y(arm) => OF_ARM * arm + 2,
            Place::Moment(arm) => OF_ARM * arm + 3,
            Place::Offset(axis) => line + axis,
            Place::Moving(axis) => line + 2 + axis,
            Place::Square => line + 4,
            Place::Stretching => line + 5,
            Place::Pull => line + 6,
            Place::Power(number) => line + OF_LINE + number,
        };
        series * self.orders + order
    }

    #[inline(always)]
    fn at(&self, series: Place, order: usize) -> T {
        let index = self.index(series, order);
        self.room[index / 4].0[index % 4]
    }

    #[inline(always)]
    fn put(&mut self, series: Place, order: usize, value: T) {
        let index = self.index(series, order);
        self.room[index / 4].0[index % 4] = value;
    }

    /// Order k of a product.
    #[inline(always)]
    fn product(&self, one: Place, other: Place, k: usize) -> T {
        let terms = (0..=k).map(|j| self.at(one, j) * self.at(other, k - j));
        terms.fold(T::from_f64(0.0), |sum, term| sum + term)
    }

    /// Writes order k of all series, given that of angles and rates; of order 0 `START` is true.
    #[inline(always)]
    pub(super) fn write<const START: bool>(&mut self, k: usize, [theta, omega]: [&[T]; 2]) {
        let line = self.line;
        let zero = T::from_f64(0.0);
        let mut offset = if START { line.offset } else { [zero; 2] };
        for (number, arm) in line.arms.iter().enumerate() {
            let [rate, x, y] = [Place::Rate(number), Place::X(number), Place::Y(number)];
            let turned = match k.checked_sub(1) {
                None => arm.turned(theta[arm.link]),
                Some(before) => [
                    -self.product(rate, y, before) / whole(k),
                    self.product(rate, x, before) / whole(k),
                ],
            };
            self.put(rate, k, omega[arm.link]);
            self.put(x, k, turned[0]);
            self.put(y, k, turned[1]);
            offset = [offset[0] + turned[0], offset[1] + turned[1]];
        }
        let [dx, dy] = [0, 1].map(Place::Offset);
        self.put(dx, k, offset[0]);
        self.put(dy, k, offset[1]);
        let square = self.product(dx, dx, k) + self.product(dy, dy, k);
        self.put(Place::Square, k, square);
        let mut pull = zero;
        if START {
            pull = line.pull_of_energy(offset).unwrap_or(zero);
        }
        for (number, potential) in line.potentials.iter().enumerate() {
            if let Some((factor, exponent)) = potential.power_of_length() {
                let power = self.power::<START>(k, number, exponent);
                if !START {
                    pull = pull + factor * power;
                }
            }
        }
        if let Some(friction) = line.friction {
            pull = pull + friction * self.damping::<START>(k);
        }
        self.put(Place::Pull, k, pull);
        for arm in 0..line.arms.len() {
            let [x, y] = [Place::X(arm), Place::Y(arm)];
            let moment = self.product(dy, x, k) - self.product(dx, y, k);
            self.put(Place::Moment(arm), k, moment);
        }
    }

    /// Order k of ℓ⁻ᵐ, the power of this number.
    #[inline(always)]
    fn power<const START: bool>(&mut self, k: usize, number: usize, exponent: u32) -> T {
        let own = Place::Power(number);
        let start = self.at(Place::Square, 0);
        let value = if START {
            let offset = [0, 1].map(|axis| self.at(Place::Offset(axis), 0));
            T::from_f64(1.0) / length_to(offset, exponent)
        } else {
            let half = 0.5 * f64::from(exponent);
            let weight = |j: usize| T::from_f64((1.0 - half) * j as f64 - k as f64);
            let terms =
                (1..=k).map(|j| weight(j) * (self.at(Place::Square, j) * self.at(own, k - j)));
            let sum = terms.fold(T::from_f64(0.0), |sum, term| sum + term);
            sum / (whole::<T>(k) * start)
        };
        self.put(own, k, value);
        value
    }

    /// Order k of (d·ḋ)/q.
    #[inline(always)]
    fn damping<const START: bool>(&mut self, k: usize) -> T {
        let zero = T::from_f64(0.0);
        let mut moving = [zero; 2];
        for arm in 0..self.line.arms.len() {
            let [rate, x, y] = [Place::Rate(arm), Place::X(arm), Place::Y(arm)];
            moving = [
                moving[0] - self.product(rate, y, k),
                moving[1] + self.product(rate, x, k),
            ];
        }
        for (axis, value) in moving.into_iter().enumerate() {
            self.put(Place::Moving(axis), k, value);
        }
        let along = |axis: usize| self.product(Place::Offset(axis), Place::Moving(axis), k);
        let stretching = along(0) + along(1);
        self.put(Place::Stretching, k, stretching);
        let number = self.line.potentials.len();
        self.power::<START>(k, number, DAMPER);
        self.product(Place::Stretching, Place::Power(number), k)
    }

    /// Returns order k of the torque on the link of an arm, against its turning.
    #[inline(always)]
    pub(super) fn torque(&self, arm: usize, k: usize) -> T {
        self.product(Place::Pull, Place::Moment(arm), k)
    }
}
