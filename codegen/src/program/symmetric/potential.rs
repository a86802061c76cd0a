//! Potential energy of a sector (a set of symmetric coordinates: all means, or one difference
//! between copies) by Parseval's identity (physics §5). 1 − cos θ = |1 − e^{iθ}|²/2, and the
//! symmetric coordinates are orthogonal. U is therefore a sum over sectors without interaction, and
//! each part is 2π-periodic in every angle.

use super::field::{SymmetricField, SymmetricTree};
use super::motion::{ConstantValues, Fields, Pose};
use super::series::TruncatedSeries;
use super::tree::SectorId;
use crate::exact::Rational;
use std::collections::BTreeMap;

impl SymmetricTree<'_> {
    pub(super) fn half(&mut self) -> TruncatedSeries {
        let half = Rational::from_ratio(1, 2).unwrap_or_else(Rational::one);
        self.series.number(half)
    }

    /// Returns the part of 1 − e^{iθ} of an orbit (set of equal copies of one link) in a sector,
    /// real and imaginary. Both parts may have the opposite sign, which does not matter in squares.
    fn chord(&mut self, pose: &Pose, orbit: usize, sector: SectorId) -> [TruncatedSeries; 2] {
        let direction = &pose.directions[orbit];
        let (cos, sin) = (
            direction.cos.component(sector),
            direction.sin.component(sector),
        );
        if sector.is_some() {
            return [cos, sin];
        }
        let one = self.series.integer(1);
        let less = self.series.sub(&cos, &one);
        [less, sin]
    }

    /// Computes the potential energy V_s of a sector.
    pub(super) fn sector_potential(
        &mut self,
        values: &ConstantValues,
        pose: &Pose,
        sector: SectorId,
    ) -> TruncatedSeries {
        let mut sum = TruncatedSeries::default();
        for orbit in self.orbits_of(sector) {
            let constants = &values.orbits[orbit];
            let norm = self.sector_norm(orbit, sector);
            let half = self.half();
            let share = self.series.mul(&half, &norm);
            let [x, y] = self.chord(pose, orbit, sector);
            let squares = [self.series.mul(&x, &x), self.series.mul(&y, &y)];
            let square = self.series.add(&squares[0], &squares[1]);
            let gravity = self.gravity_of(values, orbit, sector);
            let weight = self.series.mul(&share, &gravity);
            let gravity = self.series.mul(&weight, &square);
            sum = self.series.add(&sum, &gravity);
            if !constants.passive.spring.is_zero() {
                let strain = self.strain(values, &pose.angles, orbit);
                let strain = strain.component(sector);
                let square = self.series.mul(&strain, &strain);
                let weight = self.series.mul(&share, &constants.passive.spring);
                let spring = self.series.mul(&weight, &square);
                sum = self.series.add(&sum, &spring);
            }
            if sector.is_none() {
                let sine = self.projected(&pose.directions[orbit].sin, None);
                let lateral = self.series.mul(&constants.lateral_gravity, &sine);
                sum = self.series.add(&sum, &lateral);
            }
        }
        let between = self.pair_energy_of(values, &pose.angles, sector);
        self.series.add(&sum, &between)
    }

    /// Computes dV_s/dt of gravity and straight springs at the given angular velocities.
    pub(super) fn sector_weight_rate(
        &mut self,
        values: &ConstantValues,
        pose: &Pose,
        rates: &Fields,
        sector: SectorId,
    ) -> TruncatedSeries {
        let mut sum = TruncatedSeries::default();
        for orbit in self.orbits_of(sector) {
            let constants = &values.orbits[orbit];
            let [x, y] = self.chord(pose, orbit, sector);
            let direction = pose.directions[orbit].clone();
            let down = self.mul(&direction.sin, &rates[orbit]);
            let across = self.mul(&direction.cos, &rates[orbit]);
            let down = self.projected(&down, sector);
            let across = self.projected(&across, sector);
            let products = [self.series.mul(&y, &across), self.series.mul(&x, &down)];
            let rate = self.series.sub(&products[0], &products[1]);
            let gravity = self.gravity_of(values, orbit, sector);
            let gravity = self.series.mul(&gravity, &rate);
            sum = self.series.add(&sum, &gravity);
            if sector.is_none() {
                let lateral = self.series.mul(&constants.lateral_gravity, &across);
                sum = self.series.add(&sum, &lateral);
            }
        }
        sum
    }

    /// Computes dV_s/dt of gravity and springs at the given angular velocities.
    pub(super) fn sector_potential_rate(
        &mut self,
        values: &ConstantValues,
        pose: &Pose,
        rates: &Fields,
        sector: SectorId,
    ) -> TruncatedSeries {
        let weight = self.sector_weight_rate(values, pose, rates, sector);
        let springs = self.spring_gradient(values, pose);
        let springs = self.projections(&springs, sector);
        let rates = self.components(rates, sector);
        let springs = self.inner(&rates, &springs);
        self.series.add(&weight, &springs)
    }

    /// Computes ∂V_s/∂q of gravity and straight springs, for the sector's own coordinates.
    pub(super) fn sector_weight_gradient(
        &mut self,
        values: &ConstantValues,
        pose: &Pose,
        sector: SectorId,
    ) -> BTreeMap<usize, TruncatedSeries> {
        let mut gradient = BTreeMap::new();
        for orbit in self.orbits_of(sector) {
            let constants = &values.orbits[orbit];
            let [x, y] = self.chord(pose, orbit, sector);
            let direction = pose.directions[orbit].clone();
            let down = self.weighted(&direction.sin, sector);
            let across = self.weighted(&direction.cos, sector);
            let products = [self.series.mul(&y, &across), self.series.mul(&x, &down)];
            let slope = self.series.sub(&products[0], &products[1]);
            let gravity = self.gravity_of(values, orbit, sector);
            let mut total = self.series.mul(&gravity, &slope);
            if sector.is_none() {
                let lateral = self.series.mul(&constants.lateral_gravity, &across);
                total = self.series.add(&total, &lateral);
            }
            gradient.insert(orbit, total);
        }
        gradient
    }

    /// Computes ∂V_s/∂θ of gravity and springs, for every link.
    pub(super) fn sector_potential_gradient(
        &mut self,
        values: &ConstantValues,
        pose: &Pose,
        sector: SectorId,
    ) -> Fields {
        let mut gradient = self.zeros();
        for orbit in self.orbits_of(sector) {
            let constants = &values.orbits[orbit];
            let direction = pose.directions[orbit].clone();
            let [x, y] = self.chord(pose, orbit, sector);
            let part = |value: TruncatedSeries| {
                let mut field = SymmetricField::zero(orbit);
                field.set(sector, value);
                field
            };
            let across = self.mul(&part(y), &direction.cos);
            let down = self.mul(&part(x), &direction.sin);
            let torque = self.sub(&across, &down);
            let gravity = self.gravity_of(values, orbit, sector);
            let torque = self.scale(&gravity, &torque);
            self.accumulate(&mut gradient, &torque);
            if sector.is_none() {
                let lateral = self.scale(&constants.lateral_gravity, &direction.cos);
                self.accumulate(&mut gradient, &lateral);
            }
            if !constants.passive.spring.is_zero() {
                let strain = self.strain(values, &pose.angles, orbit);
                let strain = strain.restricted(sector);
                self.add_joint(&mut gradient, &constants.passive.spring, &strain);
            }
        }
        self.add_pair_springs(&mut gradient, values, &pose.angles, Some(sector));
        gradient
    }

    /// Computes ∂U/∂θ of the springs.
    pub(super) fn spring_gradient(&mut self, values: &ConstantValues, pose: &Pose) -> Fields {
        let mut gradient = self.zeros();
        self.add_springs(&mut gradient, values, &pose.angles);
        gradient
    }
}
