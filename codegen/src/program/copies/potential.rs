//! The potential energy of a sector by Parseval (physics §5):
//! 1 − cos θ = |1 − e^{iθ}|²/2, and the symmetric coordinates are orthogonal,
//! so that U is a sum over sectors without interaction, with every part
//! 2π-periodic in every angle.

use super::field::{Copies, Field};
use super::motion::{Fields, Pose, Values};
use super::sector::Which;
use super::series::Series;
use crate::exact::Rational;
use std::collections::BTreeMap;

impl Copies<'_> {
    pub(super) fn half(&mut self) -> Series {
        let half = Rational::from_ratio(1, 2).unwrap_or_else(Rational::one);
        self.graded.number(half)
    }

    /// 1 − e^{iθ} of an orbit in a sector, real and imaginary part; the sign is
    /// left out where both parts share it.
    fn chord(&mut self, pose: &Pose, orbit: usize, which: Which) -> [Series; 2] {
        let direction = &pose.directions[orbit];
        let (cos, sin) = (
            direction.cos.component(which),
            direction.sin.component(which),
        );
        if which.is_some() {
            return [cos, sin];
        }
        let one = self.graded.integer(1);
        let less = self.graded.sub(&cos, &one);
        [less, sin]
    }

    /// V_s.
    pub(super) fn sector_potential(
        &mut self,
        values: &Values,
        pose: &Pose,
        which: Which,
    ) -> Series {
        let mut sum = Series::default();
        for orbit in self.orbits_of(which) {
            let constants = &values.orbits[orbit];
            let norm = self.sector_norm(orbit, which);
            let half = self.half();
            let share = self.graded.mul(&half, &norm);
            let [x, y] = self.chord(pose, orbit, which);
            let squares = [self.graded.mul(&x, &x), self.graded.mul(&y, &y)];
            let square = self.graded.add(&squares[0], &squares[1]);
            let weight = self.graded.mul(&share, &constants.gravity);
            let gravity = self.graded.mul(&weight, &square);
            sum = self.graded.add(&sum, &gravity);
            if !constants.spring.is_zero() {
                let relative = self.relative(&pose.angles, orbit).component(which);
                let square = self.graded.mul(&relative, &relative);
                let weight = self.graded.mul(&share, &constants.spring);
                let spring = self.graded.mul(&weight, &square);
                sum = self.graded.add(&sum, &spring);
            }
            if which.is_none() {
                let sine = self.projected(&pose.directions[orbit].sin, None);
                let lateral = self.graded.mul(&constants.lateral_gravity, &sine);
                sum = self.graded.add(&sum, &lateral);
            }
        }
        sum
    }

    /// dV_s/dt at these angular velocities, of gravity alone.
    pub(super) fn sector_weight_rate(
        &mut self,
        values: &Values,
        pose: &Pose,
        rates: &Fields,
        which: Which,
    ) -> Series {
        let mut sum = Series::default();
        for orbit in self.orbits_of(which) {
            let constants = &values.orbits[orbit];
            let [x, y] = self.chord(pose, orbit, which);
            let direction = pose.directions[orbit].clone();
            let down = self.mul(&direction.sin, &rates[orbit]);
            let across = self.mul(&direction.cos, &rates[orbit]);
            let down = self.projected(&down, which);
            let across = self.projected(&across, which);
            let products = [self.graded.mul(&y, &across), self.graded.mul(&x, &down)];
            let rate = self.graded.sub(&products[0], &products[1]);
            let gravity = self.graded.mul(&constants.gravity, &rate);
            sum = self.graded.add(&sum, &gravity);
            if which.is_none() {
                let lateral = self.graded.mul(&constants.lateral_gravity, &across);
                sum = self.graded.add(&sum, &lateral);
            }
        }
        sum
    }

    /// dV_s/dt at these angular velocities, of gravity and springs.
    pub(super) fn sector_potential_rate(
        &mut self,
        values: &Values,
        pose: &Pose,
        rates: &Fields,
        which: Which,
    ) -> Series {
        let weight = self.sector_weight_rate(values, pose, rates, which);
        let springs = self.spring_gradient(values, pose);
        let springs = self.projections(&springs, which);
        let rates = self.components(rates, which);
        let springs = self.inner(&rates, &springs);
        self.graded.add(&weight, &springs)
    }

    /// ∂V_s/∂q for the sector's own coordinates, of gravity alone.
    pub(super) fn sector_weight_gradient(
        &mut self,
        values: &Values,
        pose: &Pose,
        which: Which,
    ) -> BTreeMap<usize, Series> {
        let mut gradient = BTreeMap::new();
        for orbit in self.orbits_of(which) {
            let constants = &values.orbits[orbit];
            let [x, y] = self.chord(pose, orbit, which);
            let direction = pose.directions[orbit].clone();
            let down = self.weighted(&direction.sin, which);
            let across = self.weighted(&direction.cos, which);
            let products = [self.graded.mul(&y, &across), self.graded.mul(&x, &down)];
            let slope = self.graded.sub(&products[0], &products[1]);
            let mut total = self.graded.mul(&constants.gravity, &slope);
            if which.is_none() {
                let lateral = self.graded.mul(&constants.lateral_gravity, &across);
                total = self.graded.add(&total, &lateral);
            }
            gradient.insert(orbit, total);
        }
        gradient
    }

    /// ∂V_s/∂θ of every link, gravity and springs.
    pub(super) fn sector_potential_gradient(
        &mut self,
        values: &Values,
        pose: &Pose,
        which: Which,
    ) -> Fields {
        let mut gradient = self.zeros();
        for orbit in self.orbits_of(which) {
            let constants = &values.orbits[orbit];
            let direction = pose.directions[orbit].clone();
            let [x, y] = self.chord(pose, orbit, which);
            let part = |value: Series| {
                let mut field = Field::zero(orbit);
                field.set(which, value);
                field
            };
            let across = self.mul(&part(y), &direction.cos);
            let down = self.mul(&part(x), &direction.sin);
            let torque = self.sub(&across, &down);
            let torque = self.scale(&constants.gravity, &torque);
            self.accumulate(&mut gradient, &torque);
            if which.is_none() {
                let lateral = self.scale(&constants.lateral_gravity, &direction.cos);
                self.accumulate(&mut gradient, &lateral);
            }
            if !constants.spring.is_zero() {
                let relative = self.relative(&pose.angles, orbit).restricted(which);
                let torque = self.scale(&constants.spring, &relative);
                self.accumulate(&mut gradient, &torque);
                if let Some(parent) = self.orbits[orbit].parent {
                    let reaction = self.gather(&torque, parent);
                    let reaction = self.neg(&reaction);
                    self.accumulate(&mut gradient, &reaction);
                }
            }
        }
        gradient
    }

    /// ∂U/∂θ of the springs.
    pub(super) fn spring_gradient(&mut self, values: &Values, pose: &Pose) -> Fields {
        let mut gradient = self.zeros();
        self.in_joints(&mut gradient, &pose.angles, values, |constants| {
            &constants.spring
        });
        gradient
    }
}
