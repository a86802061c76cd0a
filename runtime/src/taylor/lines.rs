//! Taylor series of the forces of springs, repulsions and dampers along lines between points, order
//! by order.
//!
//! The arms (x, y) of a line obey x' = −ω y and y' = ω x. The line is d = d₀ + Σ (x, y), its square
//! q = d·d, and the moment of an arm d_y x − d_x y. The pull (force along the line) divided by the
//! length is a sum of constants, of powers p = ℓ⁻ᵐ = q^(−m/2), for which 2 q p' = −m q' p, and of
//! the damper's c (d·ḋ)/q. The torque on the link of an arm is the pull times its moment.

use super::sums::whole;
use crate::scalar::Scalar;
use crate::simd::Quad;
use crate::translational::{TranslationalSpringDamper, length_to};

/// Exponent m of the power ℓ⁻ᵐ of the length ℓ in the pull of a damper.
const DAMPER: u32 = 2;

/// Number of series for each arm: ω, x, y and the moment.
const OF_ARM: usize = 4;

/// Number of series for a line, in addition to those of its arms and powers: the two components of
/// d, q, d·ḋ and the pull.
const OF_LINE: usize = 5;

/// Quantities of a line that are stored as Taylor series.
#[derive(Clone, Copy)]
enum LineQuantity {
    Rate(usize),
    X(usize),
    Y(usize),
    Moment(usize),
    Offset(usize),
    Square,
    Stretching,
    Pull,
    Power(usize),
}

/// Returns the workspace length, in quads, of a line in an expansion to order `order`.
pub(super) fn line_buffer_len<T>(line: &TranslationalSpringDamper<T>, order: usize) -> usize {
    let powers = line.potentials.len() + 1;
    let series = OF_ARM * line.arms.len() + OF_LINE + powers;
    (series * columns(order)).div_ceil(4)
}

/// Returns the number of orders stored of each series: one more than `order`, because angles are
/// known one order further than rates.
const fn columns(order: usize) -> usize {
    order + 2
}

/// Taylor series of a line, up to the last order.
pub(super) struct LineSeries<'a, T> {
    pub(super) line: &'a TranslationalSpringDamper<T>,
    /// Workspace of [`line_buffer_len`] quads.
    pub(super) buffer: &'a mut [Quad<T>],
    /// Last order.
    pub(super) last: usize,
}

impl<T: Scalar> LineSeries<'_, T> {
    #[inline(always)]
    fn index(&self, series: LineQuantity, order: usize) -> usize {
        let line = OF_ARM * self.line.arms.len();
        let series = match series {
            LineQuantity::Rate(arm) => OF_ARM * arm,
            LineQuantity::X(arm) => OF_ARM * arm + 1,
            LineQuantity::Y(arm) => OF_ARM * arm + 2,
            LineQuantity::Moment(arm) => OF_ARM * arm + 3,
            LineQuantity::Offset(axis) => line + axis,
            LineQuantity::Square => line + 2,
            LineQuantity::Stretching => line + 3,
            LineQuantity::Pull => line + 4,
            LineQuantity::Power(number) => line + OF_LINE + number,
        };
        series * columns(self.last) + order
    }

    #[inline(always)]
    fn at(&self, series: LineQuantity, order: usize) -> T {
        let index = self.index(series, order);
        self.buffer[index / 4].0[index % 4]
    }

    #[inline(always)]
    fn put(&mut self, series: LineQuantity, order: usize, value: T) {
        let index = self.index(series, order);
        self.buffer[index / 4].0[index % 4] = value;
    }

    /// Returns the coefficient of order k of the product of two series.
    #[inline(always)]
    fn product(&self, one: LineQuantity, other: LineQuantity, k: usize) -> T {
        let terms = (0..=k).map(|j| self.at(one, j) * self.at(other, k - j));
        terms.fold(T::from_f64(0.0), |sum, term| sum + term)
    }

    /// Writes the coefficients of order k of all series, given those of the angles and rates.
    /// `START` must be true for order 0.
    #[inline(always)]
    pub(super) fn write<const START: bool>(&mut self, k: usize, [theta, omega]: [&[T]; 2]) {
        let line = self.line;
        if START {
            let rotated = |arm: usize| line.arms[arm].rotated(theta[line.arms[arm].link]);
            self.stretch(0, line.offset, |_, arm| rotated(arm));
        }
        for (number, arm) in line.arms.iter().enumerate() {
            self.put(LineQuantity::Rate(number), k, omega[arm.link]);
        }
        let next = whole::<T>(k + 1);
        self.stretch(k + 1, [T::from_f64(0.0); 2], |own, arm| {
            let [rate, x, y] = [
                LineQuantity::Rate(arm),
                LineQuantity::X(arm),
                LineQuantity::Y(arm),
            ];
            [
                -own.product(rate, y, k) / next,
                own.product(rate, x, k) / next,
            ]
        });
        let pull = self.pull::<START>(k);
        self.put(LineQuantity::Pull, k, pull);
        let [dx, dy] = [0, 1].map(LineQuantity::Offset);
        for arm in 0..line.arms.len() {
            let [x, y] = [LineQuantity::X(arm), LineQuantity::Y(arm)];
            let moment = self.product(dy, x, k) - self.product(dx, y, k);
            self.put(LineQuantity::Moment(arm), k, moment);
        }
    }

    /// Writes the coefficients of order k of the arms, of the line (whose constant part is
    /// `offset`) and of its squared length q.
    #[inline(always)]
    fn stretch(&mut self, k: usize, mut offset: [T; 2], rotated: impl Fn(&Self, usize) -> [T; 2]) {
        for arm in 0..self.line.arms.len() {
            let [x, y] = rotated(self, arm);
            self.put(LineQuantity::X(arm), k, x);
            self.put(LineQuantity::Y(arm), k, y);
            offset = [offset[0] + x, offset[1] + y];
        }
        let [dx, dy] = [0, 1].map(LineQuantity::Offset);
        self.put(dx, k, offset[0]);
        self.put(dy, k, offset[1]);
        let square = self.product(dx, dx, k) + self.product(dy, dy, k);
        self.put(LineQuantity::Square, k, square);
    }

    /// Returns the coefficient of order k of the pull divided by the length.
    #[inline(always)]
    fn pull<const START: bool>(&mut self, k: usize) -> T {
        let line = self.line;
        let mut pull = T::from_f64(0.0);
        if START {
            let offset = [0, 1].map(|axis| self.at(LineQuantity::Offset(axis), 0));
            pull = line.pull_of_energy(offset).unwrap_or(pull);
        }
        for (number, potential) in line.potentials.iter().enumerate() {
            if let Some((factor, exponent)) = potential.power_of_length() {
                let power = self.power::<START>(k, number, exponent);
                if !START {
                    pull = pull + factor * power;
                }
            }
        }
        match line.friction {
            Some(friction) => pull + friction * self.damping::<START>(k),
            None => pull,
        }
    }

    /// Returns the coefficient of order k of ℓ⁻ᵐ, where ℓ is the length, m is `exponent`, and
    /// `number` is the index of this power.
    #[inline(always)]
    fn power<const START: bool>(&mut self, k: usize, number: usize, exponent: u32) -> T {
        let own = LineQuantity::Power(number);
        let start = self.at(LineQuantity::Square, 0);
        let value = if START {
            let offset = [0, 1].map(|axis| self.at(LineQuantity::Offset(axis), 0));
            T::from_f64(1.0) / length_to(offset, exponent)
        } else {
            let half = 0.5 * f64::from(exponent);
            let weight = |j: usize| T::from_f64((1.0 - half) * j as f64 - k as f64);
            let terms = (1..=k)
                .map(|j| weight(j) * (self.at(LineQuantity::Square, j) * self.at(own, k - j)));
            let sum = terms.fold(T::from_f64(0.0), |sum, term| sum + term);
            sum / (whole::<T>(k) * start)
        };
        self.put(own, k, value);
        value
    }

    /// Returns the coefficient of order k of (d·ḋ)/q, where d·ḋ is half of the rate of q.
    #[inline(always)]
    fn damping<const START: bool>(&mut self, k: usize) -> T {
        let half = T::from_f64(0.5) * whole::<T>(k + 1);
        let stretching = half * self.at(LineQuantity::Square, k + 1);
        self.put(LineQuantity::Stretching, k, stretching);
        let number = self.line.potentials.len();
        self.power::<START>(k, number, DAMPER);
        self.product(LineQuantity::Stretching, LineQuantity::Power(number), k)
    }

    /// Returns the coefficient of order k of the torque on the link of an arm; it is positive if it
    /// acts against the link's rotation.
    #[inline(always)]
    pub(super) fn torque(&self, arm: usize, k: usize) -> T {
        self.product(LineQuantity::Pull, LineQuantity::Moment(arm), k)
    }
}
