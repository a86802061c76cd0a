//! Energies of sectors from their momenta, and the energy transfer W into them without truncation
//! (physics (5.5), (9.5), (9.8), (14.5)).
//!
//! x are the angular velocities that belong to a sector's momenta alone, k the derivatives of K by
//! the angles at fixed velocities, and M_ij, with i below j, entries within the sector:
//! {E_s, K − T_s} = Σ x_i k_i + ∂V_s/∂θ_i (ω_i − x_i) − Σ (∂M_ij/∂θ_i) x_i x_j (ω_i − ω_j),
//! {E_s, U − V_s} = Σ x_i (∂V_s/∂θ_i − ∂U/∂θ_i). There is no inverse and no expansion.

use super::SymmetricTree;
use super::constants::MassConstants;
use super::memory::FreeMemory;
use super::motion::{MassEntries, SlopesOfEnergies, TreeMotion};
use super::shape::BlockShape;
use crate::model::Transfer;
use crate::scalar::Scalar;

/// Energy, velocities and derivatives of a single sector, computed with constants that are equal in
/// all copies.
pub(super) struct Alone<'w, T> {
    /// Kinetic energy T_s and potential energy V_s of the sector, in J.
    pub(super) energy: [T; 2],
    /// Derivatives ∂T_s/∂p, as angular velocities of the sector's links.
    pub(super) velocities: &'w [T],
    /// Derivatives ∂V_s/∂θ.
    pub(super) fall: &'w [T],
    /// Derivatives ∂M_ij/∂θ_i, if T_s depends on the angles.
    pub(super) slopes: Option<&'w [T]>,
}

/// Motion of the whole tree around a sector: angular velocities of all links, and derivatives of
/// the energies K and U by the angles.
pub(super) struct Surroundings<'w, T> {
    pub(super) omega: &'w [T],
    pub(super) slopes: SlopesOfEnergies<'w, T>,
}

/// Terms of the transfer W_s into a sector.
#[derive(Clone, Copy)]
pub(super) struct TransferTerms<T> {
    /// Term Σ x_i k_i of the transfer (see the module for x and k). If K is truncated at an order
    /// in the difference angles and then differentiated, this term has one order less.
    pub(super) driven: T,
    /// Remaining terms of the kinetic part {E_s, K − T_s} of the transfer.
    pub(super) kinetic: T,
    /// Potential part {E_s, U − V_s} of the transfer.
    pub(super) potential: T,
}

impl<T: Scalar> TransferTerms<T> {
    pub(super) fn transfer(self) -> Transfer<T> {
        Transfer {
            kinetic: self.driven + self.kinetic,
            potential: self.potential,
        }
    }
}

/// Returns the length of the workspace, in numbers, for a single sector.
pub(super) fn workspace_len([rows, entries]: [usize; 2], links: usize) -> usize {
    2 * links + 2 * rows + entries
}

impl<T: Scalar> SymmetricTree<T> {
    /// Computes the energy of one sector and its derivatives, with the block of the mass matrix at
    /// the current angles.
    #[inline]
    pub(super) fn alone<'w>(
        &self,
        block: &BlockShape,
        constants: &MassConstants<T>,
        matrix: MassEntries<'w, T>,
        motion: &TreeMotion<'_, T>,
        memory: &'w mut FreeMemory<'_, T>,
    ) -> Alone<'w, T> {
        let slopes = Some(matrix.slopes);
        let matrix = [&constants.inertia[..], matrix.beside];
        self.alone_of(block, constants, matrix, slopes, motion, memory)
    }

    /// Computes the energy of one sector and its derivatives, with the block of the mass matrix at
    /// equilibrium.
    #[inline]
    pub(super) fn alone_at_rest<'w>(
        &self,
        block: &BlockShape,
        motion: &TreeMotion<'_, T>,
        memory: &'w mut FreeMemory<'_, T>,
    ) -> Alone<'w, T> {
        let constants = self.equal();
        let matrix = [&constants.inertia[..], &constants.coupling];
        self.alone_of(block, constants, matrix, None, motion, memory)
    }

    fn alone_of<'w>(
        &self,
        block: &BlockShape,
        constants: &MassConstants<T>,
        matrix: [&[T]; 2],
        slopes: Option<&'w [T]>,
        motion: &TreeMotion<'_, T>,
        memory: &'w mut FreeMemory<'_, T>,
    ) -> Alone<'w, T> {
        let (shape, mut memory) = (&self.shape, memory.lend());
        let [velocities, fall] = [(); 2].map(|()| memory.take(shape.links()));
        let momenta = motion.momenta;
        let twice = block.write_velocities(&shape.pattern, matrix, momenta, memory, velocities);
        let turns = [motion.sines, motion.cosines];
        let (own, parents) = ((&self.springs, &self.chords), &shape.parents);
        let potential =
            block.write_potential_slopes(constants, own, parents, motion.theta, turns, fall);
        Alone {
            energy: [T::from_f64(0.5) * twice, potential],
            velocities,
            fall,
            slopes,
        }
    }

    /// Computes the transfer {E_s, H} into a sector, split into its terms.
    #[inline]
    pub(super) fn terms(
        &self,
        block: &BlockShape,
        own: &Alone<'_, T>,
        around: &Surroundings<'_, T>,
    ) -> TransferTerms<T> {
        let [mut driven, mut kinetic, mut potential] = [T::from_f64(0.0); 3];
        for (_, link, _) in block.links::<T>() {
            let (x, fall) = (own.velocities[link], own.fall[link]);
            driven = driven + x * around.slopes.kinetic[link];
            kinetic = kinetic + fall * (around.omega[link] - x);
            potential = potential + x * (fall - around.slopes.potential[link]);
        }
        TransferTerms {
            driven,
            kinetic: kinetic - self.turning(block, own, around.omega),
            potential,
        }
    }

    /// Computes Σ (∂M_ij/∂θ_i) x_i x_j (ω_i − ω_j) over the pairs of links i below j of a sector.
    #[inline(always)]
    pub(super) fn turning(&self, block: &BlockShape, own: &Alone<'_, T>, omega: &[T]) -> T {
        let zero = T::from_f64(0.0);
        let Some(slopes) = own.slopes else {
            return zero;
        };
        let x = own.velocities;
        let pairs = block.pairs(&self.shape.pattern);
        pairs.fold(zero, |sum, (place, link, above)| {
            sum + slopes[place] * (x[link] * x[above]) * (omega[link] - omega[above])
        })
    }

    /// Computes the power Σ x_i Q_i (W) that generalized forces Q give to a sector.
    #[inline(always)]
    pub(super) fn power(&self, block: &BlockShape, own: &Alone<'_, T>, forces: &[T]) -> T {
        let links = block.links::<T>();
        links.fold(T::from_f64(0.0), |sum, (_, link, _)| {
            sum + own.velocities[link] * forces[link]
        })
    }
}
