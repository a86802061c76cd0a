//! Energies of the sectors (sets of symmetric coordinates: all means, or one difference between
//! copies) and their rates (physics §5): dE_s/dt = W_s + P_s. W_s is the transfer from other
//! sectors, P_s the power of friction and drive.

use super::field::SymmetricTree;
use super::motion::{ConstantValues, Fields, Pose};
use super::series::TruncatedSeries;
use super::tree::SectorId;
use std::collections::BTreeMap;

/// A state of motion, with the momenta and forces that belong to it.
pub(in crate::program) struct SymmetricMotion {
    pub(in crate::program) pose: Pose,
    /// Angular velocities in symmetric form: means and differences.
    pub(in crate::program) rates: Fields,
    /// Generalized momenta M ω in symmetric form.
    pub(in crate::program) momenta: Fields,
    /// Generalized forces of friction, drag and drive.
    pub(in crate::program) forces: Fields,
}

/// Energy E_s, transfer W_s and power P_s of one sector.
pub(in crate::program) struct Share {
    pub(in crate::program) energy: TruncatedSeries,
    pub(in crate::program) transfer: TruncatedSeries,
    pub(in crate::program) power: TruncatedSeries,
}

/// Transfer W_s, split into the parts of kinetic and potential energy: {E_s, K − T_s} and {E_s, U −
/// V_s}.
pub(in crate::program) struct TransferSeries {
    /// Term −∂T_s/∂p ∂K/∂q of the kinetic part.
    pub(in crate::program) slopes: TruncatedSeries,
    /// Remaining terms of {E_s, K − T_s}.
    pub(in crate::program) kinetic: TruncatedSeries,
    pub(in crate::program) potential: TruncatedSeries,
}

impl SymmetricTree<'_> {
    /// Computes the sector's own velocities u from its momenta p and its block B of the mass
    /// matrix: B u = p.
    fn own_velocities(
        &mut self,
        values: &ConstantValues,
        motion: &SymmetricMotion,
        sector: SectorId,
        at_rest: bool,
    ) -> BTreeMap<usize, TruncatedSeries> {
        let block = if at_rest {
            self.block_at_rest(values, &motion.pose, sector)
        } else {
            self.block(values, &motion.pose, sector)
        };
        let momenta = self.projections(&motion.momenta, sector);
        self.solve_block(&block, &momenta, sector)
    }

    /// Computes −½ uᵀ Ḃ u, the rate of ½ pᵀ B⁻¹ p caused by the change of the sector's block B.
    fn by_change_of_block(
        &mut self,
        motion: &SymmetricMotion,
        sector: SectorId,
        velocities: &BTreeMap<usize, TruncatedSeries>,
    ) -> TruncatedSeries {
        let rate = self.block_rate(&motion.pose, &motion.rates, sector);
        let change = self.quadratic(&rate, velocities);
        let half = self.half();
        let change = self.series.mul(&half, &change);
        self.series.neg(&change)
    }

    /// Computes energy, transfer and power of a sector for the energy ½ p_sᵀ B_s⁻¹ p_s + V_s, with
    /// the block B_s at the current angles (definition A1) or at rest (A0).
    pub(in crate::program) fn canonical_share(
        &mut self,
        values: &ConstantValues,
        motion: &SymmetricMotion,
        sector: SectorId,
        at_rest: bool,
    ) -> Share {
        let velocities = self.own_velocities(values, motion, sector, at_rest);
        let momenta = self.projections(&motion.momenta, sector);
        let twice = self.inner(&momenta, &velocities);
        let half = self.half();
        let kinetic = self.series.mul(&half, &twice);
        let potential = self.sector_potential(values, &motion.pose, sector);
        let slopes = self.kinetic_gradient(&motion.pose, &motion.rates);
        let gradient = self.potential_gradient(values, &motion.pose);
        let slopes = self.subtract(&slopes, &gradient);
        let slopes = self.projections(&slopes, sector);
        let mut transfer = self.inner(&velocities, &slopes);
        if !at_rest {
            let change = self.by_change_of_block(motion, sector, &velocities);
            transfer = self.series.add(&transfer, &change);
        }
        let stored = self.sector_potential_rate(values, &motion.pose, &motion.rates, sector);
        let forces = self.projections(&motion.forces, sector);
        Share {
            energy: self.series.add(&kinetic, &potential),
            transfer: self.series.add(&transfer, &stored),
            power: self.inner(&velocities, &forces),
        }
    }

    /// Computes the transfer of [`canonical_share`](Self::canonical_share) for definition A1, split
    /// into the parts of kinetic and potential energy.
    pub(in crate::program) fn transfer_parts(
        &mut self,
        values: &ConstantValues,
        motion: &SymmetricMotion,
        sector: SectorId,
    ) -> TransferSeries {
        let velocities = self.own_velocities(values, motion, sector, false);
        let slopes = self.kinetic_gradient(&motion.pose, &motion.rates);
        let slopes = self.projections(&slopes, sector);
        let slopes = self.inner(&velocities, &slopes);
        let mut kinetic = self.by_change_of_block(motion, sector, &velocities);
        let weight = self.sector_weight_rate(values, &motion.pose, &motion.rates, sector);
        kinetic = self.series.add(&kinetic, &weight);
        let own = self.sector_weight_gradient(values, &motion.pose, sector);
        let swing = self.inner(&velocities, &own);
        kinetic = self.series.sub(&kinetic, &swing);
        // Springs have quadratic energy: U and V_s have the same slope in the sector.
        let springs = self.spring_gradient(values, &motion.pose);
        let projected = self.projections(&springs, sector);
        let rates = self.components(&motion.rates, sector);
        let stored = self.inner(&rates, &projected);
        let swing_of_springs = self.inner(&velocities, &projected);
        let stored = self.series.sub(&stored, &swing_of_springs);
        kinetic = self.series.add(&kinetic, &stored);
        let gradient = self.potential_gradient(values, &motion.pose);
        let gradient = self.subtract(&gradient, &springs);
        let gradient = self.projections(&gradient, sector);
        let pull = self.inner(&velocities, &gradient);
        TransferSeries {
            slopes,
            kinetic,
            potential: self.series.sub(&swing, &pull),
        }
    }

    /// Computes energy, transfer and power of a sector for the energy ½ ω_sᵀ B_s ω_s + V_s
    /// (definition C), from the accelerations caused by the conservative and by the other forces.
    pub(in crate::program) fn velocity_share(
        &mut self,
        values: &ConstantValues,
        motion: &SymmetricMotion,
        sector: SectorId,
        [conservative, other]: [&Fields; 2],
    ) -> Share {
        let block = self.block(values, &motion.pose, sector);
        let rates = self.components(&motion.rates, sector);
        let half = self.half();
        let twice = self.quadratic(&block, &rates);
        let kinetic = self.series.mul(&half, &twice);
        let potential = self.sector_potential(values, &motion.pose, sector);
        let accelerations = self.components(conservative, sector);
        let mut transfer = self.bilinear(&block, &rates, &accelerations);
        let change = self.block_rate(&motion.pose, &motion.rates, sector);
        let change = self.quadratic(&change, &rates);
        let change = self.series.mul(&half, &change);
        transfer = self.series.add(&transfer, &change);
        let stored = self.sector_potential_rate(values, &motion.pose, &motion.rates, sector);
        let other = self.components(other, sector);
        Share {
            energy: self.series.add(&kinetic, &potential),
            transfer: self.series.add(&transfer, &stored),
            power: self.bilinear(&block, &rates, &other),
        }
    }

    /// Computes the accelerations caused by the conservative forces, and those that the other
    /// forces add.
    pub(in crate::program) fn accelerations(
        &mut self,
        values: &ConstantValues,
        motion: &SymmetricMotion,
    ) -> [Fields; 2] {
        let factors = self.factors(values, &motion.pose);
        let forces = self.conservative_forces(values, &motion.pose, &motion.rates);
        for force in &forces {
            self.named(force, "torque");
        }
        let conservative = self.solve(&factors, &forces);
        for acceleration in &conservative {
            self.named(acceleration, "alpha");
        }
        let other = if motion
            .forces
            .iter()
            .all(super::field::SymmetricField::is_zero)
        {
            self.zeros()
        } else {
            self.solve(&factors, &motion.forces)
        };
        [conservative, other]
    }

    /// Computes the kinetic energy K = ½ p·ω.
    pub(in crate::program) fn kinetic_energy(
        &mut self,
        motion: &SymmetricMotion,
    ) -> TruncatedSeries {
        let mut twice = TruncatedSeries::default();
        for (momentum, rate) in motion.momenta.iter().zip(&motion.rates) {
            let product = self.dot(momentum, rate);
            twice = self.series.add(&twice, &product);
        }
        let half = self.half();
        self.series.mul(&half, &twice)
    }

    /// Computes the Hamiltonian H = K + U.
    pub(in crate::program) fn hamiltonian(
        &mut self,
        values: &ConstantValues,
        motion: &SymmetricMotion,
    ) -> TruncatedSeries {
        let kinetic = self.kinetic_energy(motion);
        self.with_potential(kinetic, values, &motion.pose)
    }

    /// Computes the potential energy U.
    pub(in crate::program) fn potential_energy(
        &mut self,
        values: &ConstantValues,
        pose: &Pose,
    ) -> TruncatedSeries {
        self.with_potential(TruncatedSeries::default(), values, pose)
    }

    fn with_potential(
        &mut self,
        mut energy: TruncatedSeries,
        values: &ConstantValues,
        pose: &Pose,
    ) -> TruncatedSeries {
        let mut sectors: Vec<SectorId> = vec![None];
        for orbit in &pose.angles {
            sectors.extend(orbit.differences.keys().map(|&id| Some(id)));
        }
        sectors.sort_unstable();
        sectors.dedup();
        for sector in sectors {
            let potential = self.sector_potential(values, pose, sector);
            energy = self.series.add(&energy, &potential);
        }
        let across = self.pair_energy_across(values, &pose.angles);
        self.series.add(&energy, &across)
    }
}
