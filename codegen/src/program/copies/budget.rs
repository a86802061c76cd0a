//! Energies of the sectors and what feeds them (physics §5): dE_s/dt =
//! W_s + P_s, the transfer from other sectors and the power of friction and
//! drive.

use super::field::Copies;
use super::motion::{Fields, Pose, Values};
use super::sector::Which;
use super::series::Series;
use std::collections::BTreeMap;

/// A state of motion and what follows from it.
pub(in crate::program) struct Motion {
    pub(in crate::program) pose: Pose,
    /// Angular velocities.
    pub(in crate::program) rates: Fields,
    /// Generalized momenta M ω.
    pub(in crate::program) momenta: Fields,
    /// Generalized forces of friction, drag and drive.
    pub(in crate::program) forces: Fields,
}

/// E_s, W_s and P_s of one sector.
pub(in crate::program) struct Share {
    pub(in crate::program) energy: Series,
    pub(in crate::program) transfer: Series,
    pub(in crate::program) power: Series,
}

/// W_s by what does it: {E_s, K − T_s} and {E_s, U − V_s}.
pub(in crate::program) struct TransferParts {
    /// −∂T_s/∂p ∂K/∂q.
    pub(in crate::program) slopes: Series,
    /// The rest of {E_s, K − T_s}.
    pub(in crate::program) kinetic: Series,
    pub(in crate::program) potential: Series,
}

impl Copies<'_> {
    /// Velocities of the sector by itself: B u = p.
    fn own_velocities(
        &mut self,
        values: &Values,
        motion: &Motion,
        which: Which,
        at_rest: bool,
    ) -> BTreeMap<usize, Series> {
        let block = if at_rest {
            self.block_at_rest(values, &motion.pose, which)
        } else {
            self.block(values, &motion.pose, which)
        };
        let momenta = self.projections(&motion.momenta, which);
        self.solve_block(&block, &momenta, which)
    }

    /// −½ uᵀ Ḃ u: what the change of the sector's block does to ½ pᵀ B⁻¹ p.
    fn by_change_of_block(
        &mut self,
        motion: &Motion,
        which: Which,
        velocities: &BTreeMap<usize, Series>,
    ) -> Series {
        let rate = self.block_rate(&motion.pose, &motion.rates, which);
        let change = self.quadratic(&rate, velocities);
        let half = self.half();
        let change = self.graded.mul(&half, &change);
        self.graded.neg(&change)
    }

    /// ½ p_sᵀ B_s⁻¹ p_s + V_s with the block at the configuration (definition
    /// A1) or at rest (A0).
    pub(in crate::program) fn canonical_share(
        &mut self,
        values: &Values,
        motion: &Motion,
        which: Which,
        at_rest: bool,
    ) -> Share {
        let velocities = self.own_velocities(values, motion, which, at_rest);
        let momenta = self.projections(&motion.momenta, which);
        let twice = self.inner(&momenta, &velocities);
        let half = self.half();
        let kinetic = self.graded.mul(&half, &twice);
        let potential = self.sector_potential(values, &motion.pose, which);
        let slopes = self.kinetic_gradient(&motion.pose, &motion.rates);
        let gradient = self.potential_gradient(values, &motion.pose);
        let slopes = self.subtract(&slopes, &gradient);
        let slopes = self.projections(&slopes, which);
        let mut transfer = self.inner(&velocities, &slopes);
        if !at_rest {
            let change = self.by_change_of_block(motion, which, &velocities);
            transfer = self.graded.add(&transfer, &change);
        }
        let stored = self.sector_potential_rate(values, &motion.pose, &motion.rates, which);
        let forces = self.projections(&motion.forces, which);
        Share {
            energy: self.graded.add(&kinetic, &potential),
            transfer: self.graded.add(&transfer, &stored),
            power: self.inner(&velocities, &forces),
        }
    }

    /// The transfer of [`canonical_share`](Self::canonical_share) by definition
    /// A1, in the parts of kinetic and potential energy.
    pub(in crate::program) fn transfer_parts(
        &mut self,
        values: &Values,
        motion: &Motion,
        which: Which,
    ) -> TransferParts {
        let velocities = self.own_velocities(values, motion, which, false);
        let slopes = self.kinetic_gradient(&motion.pose, &motion.rates);
        let slopes = self.projections(&slopes, which);
        let slopes = self.inner(&velocities, &slopes);
        let mut kinetic = self.by_change_of_block(motion, which, &velocities);
        let weight = self.sector_weight_rate(values, &motion.pose, &motion.rates, which);
        kinetic = self.graded.add(&kinetic, &weight);
        let own = self.sector_weight_gradient(values, &motion.pose, which);
        let swing = self.inner(&velocities, &own);
        kinetic = self.graded.sub(&kinetic, &swing);
        // Springs are quadratic: U and V_s have the same slope in the sector.
        let springs = self.spring_gradient(values, &motion.pose);
        let projected = self.projections(&springs, which);
        let rates = self.components(&motion.rates, which);
        let stored = self.inner(&rates, &projected);
        let swing_of_springs = self.inner(&velocities, &projected);
        let stored = self.graded.sub(&stored, &swing_of_springs);
        kinetic = self.graded.add(&kinetic, &stored);
        let gradient = self.potential_gradient(values, &motion.pose);
        let gradient = self.subtract(&gradient, &springs);
        let gradient = self.projections(&gradient, which);
        let pull = self.inner(&velocities, &gradient);
        TransferParts {
            slopes,
            kinetic,
            potential: self.graded.sub(&swing, &pull),
        }
    }

    /// ½ ω_sᵀ B_s ω_s + V_s (definition C), with the accelerations that the
    /// conservative forces and the others give.
    pub(in crate::program) fn velocity_share(
        &mut self,
        values: &Values,
        motion: &Motion,
        which: Which,
        [conservative, other]: [&Fields; 2],
    ) -> Share {
        let block = self.block(values, &motion.pose, which);
        let rates = self.components(&motion.rates, which);
        let half = self.half();
        let twice = self.quadratic(&block, &rates);
        let kinetic = self.graded.mul(&half, &twice);
        let potential = self.sector_potential(values, &motion.pose, which);
        let accelerations = self.components(conservative, which);
        let mut transfer = self.bilinear(&block, &rates, &accelerations);
        let change = self.block_rate(&motion.pose, &motion.rates, which);
        let change = self.quadratic(&change, &rates);
        let change = self.graded.mul(&half, &change);
        transfer = self.graded.add(&transfer, &change);
        let stored = self.sector_potential_rate(values, &motion.pose, &motion.rates, which);
        let other = self.components(other, which);
        Share {
            energy: self.graded.add(&kinetic, &potential),
            transfer: self.graded.add(&transfer, &stored),
            power: self.bilinear(&block, &rates, &other),
        }
    }

    /// Accelerations that the conservative forces give, and what the others
    /// add to them.
    pub(in crate::program) fn accelerations(
        &mut self,
        values: &Values,
        motion: &Motion,
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
        let other = if motion.forces.iter().all(super::field::Field::is_zero) {
            self.zeros()
        } else {
            self.solve(&factors, &motion.forces)
        };
        [conservative, other]
    }

    /// K = ½ p·ω.
    pub(in crate::program) fn kinetic_energy(&mut self, motion: &Motion) -> Series {
        let mut twice = Series::default();
        for (momentum, rate) in motion.momenta.iter().zip(&motion.rates) {
            let product = self.dot(momentum, rate);
            twice = self.graded.add(&twice, &product);
        }
        let half = self.half();
        self.graded.mul(&half, &twice)
    }

    /// H = K + U.
    pub(in crate::program) fn hamiltonian(&mut self, values: &Values, motion: &Motion) -> Series {
        let kinetic = self.kinetic_energy(motion);
        self.with_potential(kinetic, values, &motion.pose)
    }

    /// U.
    pub(in crate::program) fn potential_energy(&mut self, values: &Values, pose: &Pose) -> Series {
        self.with_potential(Series::default(), values, pose)
    }

    fn with_potential(&mut self, mut energy: Series, values: &Values, pose: &Pose) -> Series {
        let mut sectors: Vec<Which> = vec![None];
        for orbit in &pose.angles {
            sectors.extend(orbit.differences.keys().map(|&place| Some(place)));
        }
        sectors.sort_unstable();
        sectors.dedup();
        for which in sectors {
            let potential = self.sector_potential(values, pose, which);
            energy = self.graded.add(&energy, &potential);
        }
        energy
    }
}
