//! Springs and friction between links that are not parent and child, computed on means and
//! differences.
//!
//! Each depends on the difference of two links' angles, a sum of symmetric coordinates with integer
//! weights. Zero differences between copies therefore remain zero.

use super::field::{SymmetricField, SymmetricTree};
use super::friction::LawValues;
use super::motion::{ConstantValues, Fields};
use super::series::TruncatedSeries;
use super::spring_dampers::{SpringDamperValues, WeightedSum};
use super::tree::SectorId;
use crate::exact::Rational;
use crate::scene::FrictionContact;

/// Returns true if all coordinates of a sum belong to one sector (a set of symmetric coordinates:
/// all means, or one difference between copies).
fn is_of(sum: &WeightedSum, sector: SectorId) -> bool {
    sum.iter().all(|((_, own), _)| *own == sector)
}

impl SymmetricTree<'_> {
    /// Returns the value of the sum for the given angles or rates.
    fn weighted_sum(&mut self, fields: &Fields, sum: &WeightedSum) -> TruncatedSeries {
        let mut total = TruncatedSeries::default();
        for &((orbit, sector), weight) in sum {
            let value = fields[orbit].component(sector);
            let term = self.series.scale(&Rational::from(weight), &value);
            total = self.series.add(&total, &term);
        }
        total
    }

    /// Converts a torque on the sum to torques on the links that do the same work, and adds them.
    fn add_to_links(&mut self, torques: &mut Fields, sum: &WeightedSum, torque: &TruncatedSeries) {
        for &((orbit, sector), weight) in sum {
            let norm = self.sector_norm(orbit, sector);
            let weight = self.series.integer(weight);
            let inverse = self.series.reciprocal(&norm);
            let share = self.series.mul(&weight, &inverse);
            let share = self.series.mul(&share, torque);
            let mut part = SymmetricField::zero(orbit);
            part.set(sector, share);
            self.accumulate(torques, &part);
        }
    }

    /// Returns the strain u − ρ.
    fn pair_strain(
        &mut self,
        own: &SpringDamperValues,
        angles: &Fields,
        sum: &WeightedSum,
    ) -> TruncatedSeries {
        let angle = self.weighted_sum(angles, sum);
        self.series.sub(&angle, &own.passive.rest)
    }

    /// Adds the slopes of the springs' energy, of one sector or of all.
    pub(super) fn add_pair_springs(
        &mut self,
        sums: &mut Fields,
        values: &ConstantValues,
        angles: &Fields,
        sector: Option<SectorId>,
    ) {
        for own in &values.spring_dampers {
            if own.passive.spring.is_zero() {
                continue;
            }
            for (number, sum) in &own.strains {
                if sector.is_some_and(|sector| !is_of(sum, sector)) {
                    continue;
                }
                let strain = self.pair_strain(own, angles, sum);
                let stiffness = self
                    .series
                    .scale(&Rational::from(*number), &own.passive.spring);
                let torque = self.series.mul(&stiffness, &strain);
                self.add_to_links(sums, sum, &torque);
            }
        }
    }

    /// Returns the energy of the springs for the strains that `among` accepts.
    fn pair_energy(
        &mut self,
        values: &ConstantValues,
        angles: &Fields,
        among: impl Fn(&WeightedSum) -> bool,
    ) -> TruncatedSeries {
        let mut energy = TruncatedSeries::default();
        for own in &values.spring_dampers {
            if own.passive.spring.is_zero() {
                continue;
            }
            for (number, sum) in own.strains.iter().filter(|(_, sum)| among(sum)) {
                let strain = self.pair_strain(own, angles, sum);
                let square = self.series.mul(&strain, &strain);
                let half = Rational::from_ratio(*number, 2).unwrap_or_else(Rational::one);
                let weight = self.series.scale(&half, &own.passive.spring);
                let term = self.series.mul(&weight, &square);
                energy = self.series.add(&energy, &term);
            }
        }
        energy
    }

    /// Returns the energy in one sector of the springs between links.
    pub(super) fn pair_energy_of(
        &mut self,
        values: &ConstantValues,
        angles: &Fields,
        sector: SectorId,
    ) -> TruncatedSeries {
        self.pair_energy(values, angles, |sum| is_of(sum, sector))
    }

    /// Returns the energy of the springs that couple sectors.
    pub(super) fn pair_energy_across(
        &mut self,
        values: &ConstantValues,
        angles: &Fields,
    ) -> TruncatedSeries {
        let couples = |sum: &WeightedSum| {
            let first = sum.first().map(|((_, sector), _)| *sector);
            first.is_some_and(|sector| !is_of(sum, sector))
        };
        self.pair_energy(values, angles, couples)
    }

    /// Adds the torques of friction between links.
    pub(super) fn add_pair_friction(
        &mut self,
        losses: &mut Fields,
        values: &ConstantValues,
        rates: &Fields,
    ) {
        for own in &values.spring_dampers {
            let passive = &own.passive;
            for (number, sum) in &own.slips {
                if passive.friction.is_zero() {
                    continue;
                }
                let rate = self.weighted_sum(rates, sum);
                let friction = self
                    .series
                    .scale(&Rational::from(*number), &passive.friction);
                let torque = self.series.mul(&friction, &rate);
                self.add_to_links(losses, sum, &torque);
            }
            let law = passive.law(FrictionContact::Joint);
            if !law.is_zero() {
                for pair in &own.pairs {
                    self.add_pair_braking(losses, law, rates, pair);
                }
            }
        }
    }

    fn add_pair_braking(
        &mut self,
        losses: &mut Fields,
        law: &LawValues,
        rates: &Fields,
        pair: &WeightedSum,
    ) {
        let Some(&((orbit, _), _)) = pair.first() else {
            return;
        };
        let rate = self.weighted_sum(rates, pair);
        if rate.is_zero() {
            return;
        }
        let rate = SymmetricField::uniform(orbit, rate);
        let torque = self.braking_torque(law, &rate);
        self.add_to_links(losses, pair, &torque.mean);
    }
}
