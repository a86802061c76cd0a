//! Virtual power of forces along lines between points of links, with its derivatives.

use std::cell::Cell;

use branched_pendulum::scalar::{Dual, Scalar};
use branched_pendulum::translational::TranslationalSpringDamper;

use super::constants::{Slopes, numbers_of_line};
use super::links::VirtualPower;
use super::planar::{Vector, arm, arm_slopes, dot, scaled, sum, turned};

/// A line at one state: its vector d, the rate of d, and the rate of d along the virtual motion.
struct Line<T> {
    vector: Vector<T>,
    rate: Vector<T>,
    along: Vector<T>,
}

impl<T: Scalar> VirtualPower<'_, T> {
    /// Adds the derivatives of the forces along lines.
    pub(super) fn add_lines(&mut self) {
        for (own, slopes) in self.constants.lines.iter().zip(&self.slopes.lines) {
            let by_constants = self.add_line(own, slopes);
            let [_, _, parameters] = &mut self.by;
            slopes.add(&by_constants, parameters);
        }
    }

    /// Adds the derivatives of one line's power −f d·u, where f is the force divided by the length
    /// and u the rate of d along the virtual motion. Returns the derivatives by the constants of the
    /// line, in the order of [`numbers_of_line`]; those by the constants of the force only if some
    /// constant depends on a parameter.
    fn add_line(&mut self, own: &TranslationalSpringDamper<T>, slopes: &Slopes<T>) -> Vec<T> {
        let Line {
            vector,
            rate,
            along,
        } = self.line(own);
        let at = |value: T, index: usize| Dual::<T, 4>::variable(value, index);
        let force = own.map(Dual::<T, 4>::constant).force_over_length(
            [at(vector[0], 0), at(vector[1], 1)],
            [at(rate[0], 2), at(rate[1], 3)],
        );
        let stretching = dot(vector, along);
        let [x, y, rate_x, rate_y] = force.tangents.map(|slope| -(slope * stretching));
        let by_vector = sum([x, y], scaled(-force.value, along));
        let by = [by_vector, [rate_x, rate_y], scaled(-force.value, vector)];
        let mut by_constants = Vec::new();
        for arm in &own.arms {
            by_constants.extend(self.add_arm(arm.link, [arm.along, arm.lateral], by));
        }
        by_constants.extend(by_vector);
        if slopes.is_empty() {
            return by_constants;
        }
        for index in by_constants.len()..numbers_of_line(own).len() {
            let [slope] = vary(own, index)
                .force_over_length(vector.map(Dual::constant), rate.map(Dual::constant))
                .tangents;
            by_constants.push(-(slope * stretching));
        }
        by_constants
    }

    fn line(&self, own: &TranslationalSpringDamper<T>) -> Line<T> {
        let zero = T::from_f64(0.0);
        let mut line = Line {
            vector: own.offset,
            rate: [zero; 2],
            along: [zero; 2],
        };
        for arm_of in &own.arms {
            let link = arm_of.link;
            let arm = arm([arm_of.along, arm_of.lateral], self.axes[link]);
            line.vector = sum(line.vector, arm);
            line.rate = sum(line.rate, scaled(self.motion.omega[link], turned(arm)));
            line.along = sum(line.along, scaled(self.motion.lambda[link], turned(arm)));
        }
        line
    }

    /// Adds the derivatives by angle and angular velocity of the link of one arm, given those by the
    /// line's vector and its two rates. Returns the derivatives by the components of the arm.
    fn add_arm(
        &mut self,
        link: usize,
        point: [T; 2],
        [by_vector, by_rate, by_along]: [Vector<T>; 3],
    ) -> [T; 2] {
        let axis = self.axes[link];
        let [omega, lambda] = [self.motion.omega[link], self.motion.lambda[link]];
        let turning = sum(scaled(omega, by_rate), scaled(lambda, by_along));
        let g = sum(by_vector, scaled(T::from_f64(-1.0), turned(turning)));
        let (by_angle, by_point) = arm_slopes(point, axis, g);
        let [by_theta, by_omega, _] = &mut self.by;
        by_theta[link] = by_theta[link] + by_angle;
        by_omega[link] = by_omega[link] + dot(turned(arm(point, axis)), by_rate);
        by_point
    }
}

/// Returns a line of dual numbers in which the constant with this index varies, in the order of
/// [`numbers_of_line`].
fn vary<T: Scalar>(
    own: &TranslationalSpringDamper<T>,
    index: usize,
) -> TranslationalSpringDamper<Dual<T, 1>> {
    let next = Cell::new(0);
    own.map(|number| {
        let varies = next.replace(next.get() + 1) == index;
        match varies {
            true => Dual::variable(number, 0),
            false => Dual::constant(number),
        }
    })
}
