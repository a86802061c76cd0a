//! Straight springs between copies (physics (19.10)): their constant Γ adds to gravity's G in the
//! sectors of the copies' differences.

use super::field::{SymmetricField, SymmetricTree};
use super::motion::{ConstantValues, Fields, Pose};
use super::series::TruncatedSeries;
use super::tree::SectorId;

impl SymmetricTree<'_> {
    /// Returns gravity's constant G of an orbit (set of equal copies of one link) in a sector, plus
    /// Γ if straight springs connect the copies of that sector.
    pub(super) fn gravity_of(
        &mut self,
        values: &ConstantValues,
        orbit: usize,
        sector: SectorId,
    ) -> TruncatedSeries {
        let gravity = &values.orbits[orbit].gravity;
        let mut chords = values.chords.iter();
        let own = |group: usize| sector.is_some_and(|(known, _)| known == group);
        match chords.find(|chord| chord.orbit == orbit && own(chord.group)) {
            Some(chord) => self.series.add(gravity, &chord.weight),
            None => gravity.clone(),
        }
    }

    /// Adds the derivatives ∂U/∂θ by the angles of the links, Γ (\[sin θ\] cos θ − \[cos θ\] sin
    /// θ). Brackets denote the part in the differences of the copies.
    pub(super) fn add_chords(
        &mut self,
        gradient: &mut Fields,
        values: &ConstantValues,
        pose: &Pose,
    ) {
        for chord in &values.chords {
            let direction = pose.directions[chord.orbit].clone();
            let [sines, cosines] =
                [&direction.sin, &direction.cos].map(|own| own.within(chord.group));
            let across = self.mul(&sines, &direction.cos);
            let down = self.mul(&cosines, &direction.sin);
            // The torques between copies sum to zero.
            let torque = self.sub(&across, &down).within(chord.group);
            let torque = self.scale(&chord.weight, &torque);
            self.accumulate(gradient, &torque);
        }
    }
}

impl SymmetricField {
    /// Returns the part of the field in the differences of a group.
    fn within(&self, group: usize) -> Self {
        let mut part = Self::zero(self.orbit);
        let own = self
            .differences
            .iter()
            .filter(|((known, _), _)| *known == group);
        part.differences = own.map(|(id, value)| (*id, value.clone())).collect();
        part
    }
}
