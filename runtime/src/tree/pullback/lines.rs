//! Virtual power of forces along lines between points of links, with its derivatives.

use core::cell::Cell;

use super::constants::{Slope, add_through};
use super::planar::{Vector, arm, arm_slopes, dot, scaled, sum, turned, turned_back};
use super::power::Derivatives;
use crate::scalar::{Dual, Scalar};
use crate::translational::TranslationalSpringDamper;

/// A line at one state: its vector d, the rate of d, and the rate of d along the virtual motion.
struct Line<T> {
    vector: Vector<T>,
    rate: Vector<T>,
    along: Vector<T>,
}

impl<T: Scalar> Derivatives<'_, T> {
    /// Adds the derivatives of one line's power −f d·u, where f is the force divided by the length
    /// and u the rate of d along the virtual motion. The arms belong to links whose indices are larger
    /// by `place` than the indices in `own`.
    pub(super) fn add_line(
        &mut self,
        own: &TranslationalSpringDamper<T>,
        place: usize,
        slopes: &[Slope<T>],
    ) {
        let Line {
            vector,
            rate,
            along,
        } = self.line(own, place);
        let at = |value: T, index: usize| Dual::<T, 4>::variable(value, index);
        let force = own.force_over_length(
            Dual::<T, 4>::constant,
            [at(vector[0], 0), at(vector[1], 1)],
            [at(rate[0], 2), at(rate[1], 3)],
        );
        let stretching = dot(vector, along);
        let [x, y, rate_x, rate_y] = force.tangents.map(|slope| -(slope * stretching));
        let by_vector = sum([x, y], scaled(-force.value, along));
        let by = [by_vector, [rate_x, rate_y], scaled(-force.value, vector)];
        let mut constant = 0;
        for arm in &own.arms {
            let by_arm = self.add_arm(arm.link + place, [arm.along, arm.lateral], by);
            let [_, _, parameters] = &mut self.by;
            add_through(slopes, constant, &by_arm, parameters);
            constant += by_arm.len();
        }
        let [_, _, parameters] = &mut self.by;
        add_through(slopes, constant, &by_vector, parameters);
        constant += by_vector.len();
        for slope in slopes {
            let varying = slope.constant;
            if varying >= constant {
                let [by_constant] = vary(own, [constant, varying], vector, rate).tangents;
                let by = [-(by_constant * stretching)];
                add_through(core::slice::from_ref(slope), varying, &by, parameters);
            }
        }
    }

    fn line(&self, own: &TranslationalSpringDamper<T>, place: usize) -> Line<T> {
        let zero = T::from_f64(0.0);
        let mut line = Line {
            vector: own.offset,
            rate: [zero; 2],
            along: [zero; 2],
        };
        for arm_of in &own.arms {
            let link = arm_of.link + place;
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
        let g = sum(by_vector, turned_back(turning));
        let (by_angle, by_point) = arm_slopes(point, axis, g);
        let [by_theta, by_omega, _] = &mut self.by;
        by_theta[link] = by_theta[link] + by_angle;
        by_omega[link] = by_omega[link] + dot(turned(arm(point, axis)), by_rate);
        by_point
    }
}

/// Returns the force of a line divided by its length, with the derivative by the constant that has
/// the index `varying` in the line; `first` is the index of the first constant of the force.
fn vary<T: Scalar>(
    own: &TranslationalSpringDamper<T>,
    [first, varying]: [usize; 2],
    vector: Vector<T>,
    rate: Vector<T>,
) -> Dual<T, 1> {
    let next = Cell::new(first);
    let convert = |number| {
        let varies = next.replace(next.get() + 1) == varying;
        match varies {
            true => Dual::variable(number, 0),
            false => Dual::constant(number),
        }
    };
    let [vector, rate] = [vector, rate].map(|own| own.map(Dual::constant));
    own.force_over_length(convert, vector, rate)
}
