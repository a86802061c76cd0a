//! Motion of the tree by orbits (sets of equal copies of one link): mass matrix, generalized forces
//! and linear solves, in fields instead of single links.

use super::direction::Direction;
use super::field::{SymmetricField, SymmetricTree};
use super::series::TruncatedSeries;
use super::spring_dampers::SpringDamperValues;
use crate::mechanics::{OrbitChord, OrbitCoupling};
use crate::scene::PassiveTorques;

/// Constants of one orbit as values; zero is an empty series.
pub(in crate::program) struct OrbitValues {
    pub(in crate::program) mass: TruncatedSeries,
    pub(in crate::program) inertia: TruncatedSeries,
    pub(in crate::program) com: [TruncatedSeries; 2],
    pub(in crate::program) pivot: [TruncatedSeries; 2],
    pub(in crate::program) moment: TruncatedSeries,
    pub(in crate::program) gravity: TruncatedSeries,
    pub(in crate::program) lateral_gravity: TruncatedSeries,
    pub(in crate::program) drive: [TruncatedSeries; 3],
    pub(in crate::program) passive: PassiveTorques<TruncatedSeries>,
}

/// Constants of a scene as values.
pub(in crate::program) struct ConstantValues {
    pub(in crate::program) orbits: Vec<OrbitValues>,
    pub(in crate::program) couplings: Vec<OrbitCoupling<TruncatedSeries>>,
    pub(in crate::program) chords: Vec<OrbitChord<TruncatedSeries>>,
    pub(in crate::program) spring_dampers: Vec<SpringDamperValues>,
}

/// One field per orbit: a vector with one component per link.
pub(in crate::program) type Fields = Vec<SymmetricField>;

/// A coupling at a configuration: the entry of the mass matrix and its derivative by the
/// descendant's angle.
pub(super) struct MassEntry {
    pub(in crate::program) row: usize,
    pub(in crate::program) column: usize,
    pub(super) value: SymmetricField,
    pub(super) slope: SymmetricField,
}

/// A configuration: quantities that depend only on the angles.
pub(in crate::program) struct Pose {
    pub(super) angles: Fields,
    pub(super) directions: Vec<Direction>,
    pub(super) entries: Vec<MassEntry>,
}

impl SymmetricTree<'_> {
    /// Computes the quantities of the configuration with the given angles.
    pub(in crate::program) fn pose(&mut self, values: &ConstantValues, angles: Fields) -> Pose {
        let directions: Vec<Direction> = angles
            .iter()
            .map(|angle| {
                let direction = self.direction(angle);
                self.named(&direction.cos, "cosine");
                self.named(&direction.sin, "sine");
                direction
            })
            .collect();
        let mut entries = Vec::new();
        for coupling in &values.couplings {
            let OrbitCoupling { row, column, .. } = *coupling;
            let own = directions[row].clone();
            let cos_above = self.lift(&directions[column].cos, row);
            let sin_above = self.lift(&directions[column].sin, row);
            let products = [
                self.mul(&own.cos, &cos_above),
                self.mul(&own.sin, &sin_above),
                self.mul(&own.sin, &cos_above),
                self.mul(&own.cos, &sin_above),
            ];
            let cos = self.add(&products[0], &products[1]);
            let sin = self.sub(&products[2], &products[3]);
            let above = self.orbits[column].name(None);
            self.hinted(&cos, &format!("cos_from_{above}"));
            self.hinted(&sin, &format!("sin_from_{above}"));
            let parts = [
                self.scale(&coupling.cosine, &cos),
                self.scale(&coupling.sine, &sin),
                self.scale(&coupling.sine, &cos),
                self.scale(&coupling.cosine, &sin),
            ];
            let value = self.add(&parts[0], &parts[1]);
            let slope = self.sub(&parts[2], &parts[3]);
            let above = self.orbits[column].name(None).to_owned();
            self.named(&value, &format!("mass_{above}"));
            self.named(&slope, &format!("slope_{above}"));
            entries.push(MassEntry {
                row,
                column,
                value,
                slope,
            });
        }
        Pose {
            angles,
            directions,
            entries,
        }
    }

    pub(in crate::program) fn zeros(&self) -> Fields {
        (0..self.orbits.len()).map(SymmetricField::zero).collect()
    }

    pub(super) fn accumulate(&mut self, sums: &mut Fields, term: &SymmetricField) {
        let orbit = term.orbit;
        sums[orbit] = self.add(&sums[orbit], term);
    }

    /// Computes the momenta M v.
    pub(in crate::program) fn momenta(
        &mut self,
        values: &ConstantValues,
        pose: &Pose,
        rates: &Fields,
    ) -> Fields {
        let mut momenta: Fields = rates
            .iter()
            .zip(&values.orbits)
            .map(|(rate, constants)| self.scale(&constants.moment, rate))
            .collect();
        for entry in &pose.entries {
            let above = self.lift(&rates[entry.column], entry.row);
            let down = self.mul(&entry.value, &above);
            self.accumulate(&mut momenta, &down);
            let up = self.mul(&entry.value, &rates[entry.row]);
            let up = self.gather(&up, entry.column);
            self.accumulate(&mut momenta, &up);
        }
        self.all_hinted(&momenta, "momentum");
        momenta
    }

    /// Computes the slopes ∂U/∂θ of gravity and springs.
    pub(in crate::program) fn potential_gradient(
        &mut self,
        values: &ConstantValues,
        pose: &Pose,
    ) -> Fields {
        let mut gradient = self.zeros();
        for (orbit, constants) in values.orbits.iter().enumerate() {
            let direction = &pose.directions[orbit];
            let along = self.scale(&constants.gravity, &direction.sin);
            let across = self.scale(&constants.lateral_gravity, &direction.cos);
            self.accumulate(&mut gradient, &along);
            self.accumulate(&mut gradient, &across);
        }
        self.add_chords(&mut gradient, values, pose);
        self.add_springs(&mut gradient, values, &pose.angles);
        self.all_hinted(&gradient, "potential_slope");
        gradient
    }

    /// Adds κ (θ − θ_parent − ρ) to each link and its opposite to the parent, and the corresponding
    /// terms between other links.
    pub(super) fn add_springs(
        &mut self,
        sums: &mut Fields,
        values: &ConstantValues,
        angles: &Fields,
    ) {
        for (orbit, constants) in values.orbits.iter().enumerate() {
            let spring = &constants.passive.spring;
            if !spring.is_zero() {
                let strain = self.strain(values, angles, orbit);
                self.hinted(&strain, "relative");
                self.add_joint(sums, spring, &strain);
            }
        }
        self.add_pair_springs(sums, values, angles, None);
    }

    /// Adds c (ω − ω_parent) to each link, and its opposite to the parent.
    fn add_friction(&mut self, sums: &mut Fields, values: &ConstantValues, rates: &Fields) {
        for (orbit, constants) in values.orbits.iter().enumerate() {
            let friction = &constants.passive.friction;
            if !friction.is_zero() {
                let relative = self.relative(rates, orbit);
                self.hinted(&relative, "relative");
                self.add_joint(sums, friction, &relative);
            }
        }
    }

    /// Adds coefficient · relative to the links of its orbit, and the opposite to their parents.
    pub(super) fn add_joint(
        &mut self,
        sums: &mut Fields,
        coefficient: &TruncatedSeries,
        relative: &SymmetricField,
    ) {
        let torque = self.scale(coefficient, relative);
        self.add_joint_torque(sums, &torque);
    }

    pub(super) fn add_joint_torque(&mut self, sums: &mut Fields, torque: &SymmetricField) {
        self.hinted(torque, "joint_torque");
        self.accumulate(sums, torque);
        if let Some(parent) = self.orbits[torque.orbit].parent {
            let reaction = self.gather(torque, parent);
            let reaction = self.neg(&reaction);
            self.accumulate(sums, &reaction);
        }
    }

    /// Returns θ − θ_parent − ρ, the strain of the springs of an orbit. The rest angle is the same
    /// for all links and therefore only part of the mean.
    pub(super) fn strain(
        &mut self,
        values: &ConstantValues,
        angles: &Fields,
        orbit: usize,
    ) -> SymmetricField {
        let relative = self.relative(angles, orbit);
        let rest = &values.orbits[orbit].passive.rest;
        if rest.is_zero() {
            return relative;
        }
        let rest = SymmetricField::uniform(orbit, rest.clone());
        self.sub(&relative, &rest)
    }

    /// Returns a link's value minus its parent's.
    pub(super) fn relative(&mut self, positions: &Fields, orbit: usize) -> SymmetricField {
        match self.orbits[orbit].parent {
            Some(parent) => {
                let above = self.lift(&positions[parent], orbit);
                self.sub(&positions[orbit], &above)
            }
            None => positions[orbit].clone(),
        }
    }

    /// Computes the generalized forces of friction and drag, Q = −∂R/∂ω, and of the drive.
    pub(in crate::program) fn other_forces(
        &mut self,
        values: &ConstantValues,
        pose: &Pose,
        rates: &Fields,
    ) -> Fields {
        let mut forces = self.friction_forces(values, rates);
        self.drive(&mut forces, values, pose);
        forces
    }

    /// Computes the generalized forces of friction and drag, Q = −∂R/∂ω.
    pub(in crate::program) fn friction_forces(
        &mut self,
        values: &ConstantValues,
        rates: &Fields,
    ) -> Fields {
        let mut losses = self.zeros();
        self.add_friction(&mut losses, values, rates);
        for (constants, rate) in values.orbits.iter().zip(rates) {
            let drag = self.scale(&constants.passive.drag, rate);
            self.accumulate(&mut losses, &drag);
        }
        self.add_braking(&mut losses, values, rates);
        self.add_pair_friction(&mut losses, values, rates);
        self.all_hinted(&losses, "loss");
        losses.iter().map(|loss| self.neg(loss)).collect()
    }

    /// Adds the generalized forces of the drive.
    pub(in crate::program) fn drive(
        &mut self,
        forces: &mut Fields,
        values: &ConstantValues,
        pose: &Pose,
    ) {
        for (orbit, constants) in values.orbits.iter().enumerate() {
            let [c, s, torque] = &constants.drive;
            let direction = &pose.directions[orbit];
            let along = self.scale(s, &direction.cos);
            let across = self.scale(c, &direction.sin);
            let pushed = self.sub(&along, &across);
            let turned = SymmetricField::uniform(orbit, torque.clone());
            self.accumulate(forces, &pushed);
            self.accumulate(forces, &turned);
        }
    }

    /// Computes ∂K/∂θ at fixed velocities.
    pub(in crate::program) fn kinetic_gradient(&mut self, pose: &Pose, rates: &Fields) -> Fields {
        let mut gradient = self.zeros();
        for entry in &pose.entries {
            let above = self.lift(&rates[entry.column], entry.row);
            let product = self.mul(&rates[entry.row], &above);
            let name = format!("omega_{}_omega", self.orbits[entry.column].name(None));
            self.hinted(&product, &name);
            self.turn_both(&mut gradient, entry, &product);
        }
        self.all_hinted(&gradient, "kinetic_slope");
        gradient
    }

    /// Computes Ṁ v.
    pub(in crate::program) fn mass_changes(&mut self, pose: &Pose, rates: &Fields) -> Fields {
        let mut changes = self.zeros();
        for entry in &pose.entries {
            let above = self.lift(&rates[entry.column], entry.row);
            let relative = self.sub(&rates[entry.row], &above);
            let change = self.mul(&entry.slope, &relative);
            let name = format!("mass_rate_{}", self.orbits[entry.column].name(None));
            self.hinted(&change, &name);
            let down = self.mul(&change, &above);
            self.accumulate(&mut changes, &down);
            let up = self.mul(&change, &rates[entry.row]);
            let up = self.gather(&up, entry.column);
            self.accumulate(&mut changes, &up);
        }
        self.all_hinted(&changes, "mass_change");
        changes
    }

    /// Computes the gradient ∂(aᵀ M b)/∂θ.
    pub(super) fn bilinear_gradient(&mut self, pose: &Pose, a: &Fields, b: &Fields) -> Fields {
        let mut gradient = self.zeros();
        for entry in &pose.entries {
            let a_above = self.lift(&a[entry.column], entry.row);
            let b_above = self.lift(&b[entry.column], entry.row);
            let first = self.mul(&a[entry.row], &b_above);
            let second = self.mul(&b[entry.row], &a_above);
            let product = self.add(&first, &second);
            let name = format!("mixed_{}", self.orbits[entry.column].name(None));
            self.hinted(&product, &name);
            self.turn_both(&mut gradient, entry, &product);
        }
        gradient
    }

    /// Adds the derivative of the entry times `product` to the descendants' torque, and subtracts
    /// it from the ancestors'.
    fn turn_both(&mut self, gradient: &mut Fields, entry: &MassEntry, product: &SymmetricField) {
        let own = self.mul(&entry.slope, product);
        let name = format!("turning_{}", self.orbits[entry.column].name(None));
        self.hinted(&own, &name);
        self.accumulate(gradient, &own);
        let above = self.gather(&own, entry.column);
        let above = self.neg(&above);
        self.accumulate(gradient, &above);
    }

    /// Computes the centrifugal terms, which are on the same side of the equation as M θ̈: for each
    /// coupling m(Δ), the term m′ ω² of the other link. There are no Coriolis terms.
    pub(super) fn centrifugal(&mut self, pose: &Pose, rates: &Fields) -> Fields {
        let squares: Fields = rates.iter().map(|rate| self.mul(rate, rate)).collect();
        self.all_hinted(&squares, "omega_squared");
        let mut forces = self.zeros();
        for entry in &pose.entries {
            let above = self.lift(&squares[entry.column], entry.row);
            let own = self.mul(&entry.slope, &above);
            self.accumulate(&mut forces, &own);
            let up = self.mul(&entry.slope, &squares[entry.row]);
            let up = self.gather(&up, entry.column);
            let up = self.neg(&up);
            self.accumulate(&mut forces, &up);
        }
        self.all_hinted(&forces, "centrifugal");
        forces
    }

    /// Computes the right side of M θ̈ = … without friction and drive.
    pub(super) fn conservative_forces(
        &mut self,
        values: &ConstantValues,
        pose: &Pose,
        rates: &Fields,
    ) -> Fields {
        let motion = self.centrifugal(pose, rates);
        let gradient = self.potential_gradient(values, pose);
        self.subtract(&motion, &gradient)
    }

    pub(in crate::program) fn subtract(&mut self, a: &Fields, b: &Fields) -> Fields {
        a.iter().zip(b).map(|(a, b)| self.sub(a, b)).collect()
    }

    pub(in crate::program) fn sum(&mut self, a: &Fields, b: &Fields) -> Fields {
        a.iter().zip(b).map(|(a, b)| self.add(a, b)).collect()
    }
}
