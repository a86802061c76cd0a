//! Energies of all sectors, and the exact transfers of energy into them, computed from coordinates
//! and momenta.

use super::forces::NonConservative;
use super::memory::FreeMemory;
use super::motion::{MassEntries, TreeMotion, factors, workspace_len, write_kinetic_slopes};
use super::pattern::{multiply, write_slopes};
use super::sector::{self, Alone, Surroundings, TransferTerms};
use super::shape::BlockShape;
use super::{StateInput, SymmetricTree};
use crate::model::Transfer;
use crate::scalar::Scalar;
use crate::system::Workspace;

impl<T: Scalar> SymmetricTree<T> {
    /// Returns the length of the workspace of an evaluation, in numbers.
    pub(super) fn workspace_len(&self) -> usize {
        let shape = &*self.shape;
        let (links, entries) = (shape.links(), shape.pattern.entries());
        let matrices = 4 * entries + factors(links, entries);
        let own = sector::workspace_len(shape.largest_block(), links);
        workspace_len(links, entries) + 6 * links + matrices + own
    }

    /// Returns the mass matrix from which energies of sectors are computed: the matrix of the mean
    /// tree if copies differ, else the tree's own.
    #[inline]
    pub(super) fn energy_matrix<'w>(
        &self,
        motion: &TreeMotion<'w, T>,
        memory: &mut FreeMemory<'w, T>,
    ) -> MassEntries<'w, T> {
        match &self.mean {
            None => motion.matrix,
            Some(mean) => self.matrix(&mean.equal, [motion.sines, motion.cosines], memory),
        }
    }

    /// Computes the energy of each sector and its derivatives, and passes them to `write` with the
    /// sector's index.
    #[inline]
    fn for_each(
        &self,
        motion: &TreeMotion<'_, T>,
        matrix: MassEntries<'_, T>,
        mut memory: FreeMemory<'_, T>,
        mut write: impl FnMut(usize, &BlockShape, &Alone<'_, T>),
    ) {
        for (number, block) in self.shape.blocks.iter().enumerate() {
            let mut own = memory.lend();
            let alone = self.alone(block, self.equal(), matrix, motion, &mut own);
            write(number, block, &alone);
        }
    }

    /// Computes the terms of the transfer into each sector and passes them to `write` with the
    /// sector's index.
    #[inline]
    pub(super) fn for_each_transfer(
        &self,
        workspace: &mut Workspace<T>,
        given: StateInput<'_, T>,
        mut write: impl FnMut(usize, TransferTerms<T>),
    ) -> Option<()> {
        let mut memory = FreeMemory(workspace.numbers(self.workspace_len()));
        let motion = self.motion(given, &mut memory)?;
        let around = Surroundings {
            omega: motion.omega,
            slopes: self.slopes(&self.whole, motion.matrix, &motion, &mut memory),
        };
        let matrix = self.energy_matrix(&motion, &mut memory);
        self.for_each(&motion, matrix, memory, |number, block, own| {
            write(number, self.terms(block, own, &around));
        });
        Some(())
    }

    /// Writes the kinetic and potential energies T_s and V_s (J) of all sectors s, from their
    /// momenta and the block of the mass matrix at the current angles: their sum is the paper's H_d
    /// if a sector has one coordinate. NaN for slices of a wrong length.
    pub fn energies(
        &self,
        workspace: &mut Workspace<T>,
        given: StateInput<'_, T>,
        energies: &mut [[T; 2]],
    ) {
        energies.fill([T::from_f64(f64::NAN); 2]);
        let mut memory = FreeMemory(workspace.numbers(self.workspace_len()));
        let fits = energies.len() == self.shape.blocks.len();
        let Some(motion) = self.motion(given, &mut memory).filter(|_| fits) else {
            return;
        };
        let matrix = self.energy_matrix(&motion, &mut memory);
        self.for_each(&motion, matrix, memory, |number, _, own| {
            energies[number] = own.energy;
        });
    }

    /// Writes the energy transfers W_s = {E_s, H} (W) into all sectors without truncation; E_s =
    /// T_s + V_s is the energy from [`energies`](Self::energies). Forces other than springs and
    /// gravity are not included, see [`powers`](Self::powers). NaN for slices of a wrong length.
    pub fn exact_transfers(
        &self,
        workspace: &mut Workspace<T>,
        given: StateInput<'_, T>,
        transfers: &mut [Transfer<T>],
    ) {
        fill(transfers);
        if transfers.len() == self.shape.blocks.len() {
            self.for_each_transfer(workspace, given, |number, terms| {
                transfers[number] = terms.transfer();
            });
        }
    }

    /// Writes the growth: the energy transfers (W) into all sectors in the mean tree, at the same
    /// coordinates and momenta (physics (14.4)). If copies do not differ, it is the whole transfer.
    pub fn growth(
        &self,
        workspace: &mut Workspace<T>,
        given: StateInput<'_, T>,
        transfers: &mut [Transfer<T>],
    ) {
        let Some(mean) = &self.mean else {
            return self.exact_transfers(workspace, given, transfers);
        };
        fill(transfers);
        let mut memory = FreeMemory(workspace.numbers(self.workspace_len()));
        let fits = transfers.len() == self.shape.blocks.len();
        let Some(motion) = self.motion(given, &mut memory).filter(|_| fits) else {
            return;
        };
        let matrix = self.energy_matrix(&motion, &mut memory);
        // Velocities that belong to these momenta in the mean tree.
        let omega = memory.take(self.shape.links());
        self.write_absolute_momenta(&motion, omega);
        self.solve(&mean.equal, matrix, omega, memory.lend());
        let motion = TreeMotion { omega, ..motion };
        let around = Surroundings {
            omega,
            slopes: self.slopes(&mean.equal, matrix, &motion, &mut memory),
        };
        self.for_each(&motion, matrix, memory, |number, block, own| {
            transfers[number] = self.terms(block, own, &around).transfer();
        });
    }

    /// Writes the forcing: the energy transfer (W) that differences between copies add to the
    /// growth (physics (14.5)), zero without such differences. Each of its terms contains such a
    /// difference, so that a small forcing is not computed as the difference of two large numbers.
    pub fn forcing(
        &self,
        workspace: &mut Workspace<T>,
        given: StateInput<'_, T>,
        transfers: &mut [Transfer<T>],
    ) {
        fill(transfers);
        let (zero, half) = (T::from_f64(0.0), T::from_f64(0.5));
        let mut memory = FreeMemory(workspace.numbers(self.workspace_len()));
        let fits = transfers.len() == self.shape.blocks.len();
        let Some(motion) = self.motion(given, &mut memory).filter(|_| fits) else {
            return;
        };
        let Some(mean) = &self.mean else {
            return transfers.fill(Transfer {
                kinetic: zero,
                potential: zero,
            });
        };
        let (links, pattern) = (self.shape.links(), &self.shape.pattern);
        let matrix = self.energy_matrix(&motion, &mut memory);
        let turns = [motion.sines, motion.cosines];
        let beyond = self.matrix(&mean.beyond, turns, &mut memory);
        // M₀ u = −(M − M₀) ω.
        let added = memory.take(links);
        let inertia = &mean.beyond.inertia;
        multiply(pattern, inertia, beyond.beside, motion.omega, added);
        self.solve(&mean.equal, matrix, added, memory.lend());
        for velocity in &mut *added {
            *velocity = -*velocity;
        }
        // ½ ωᵀ ∂(M − M₀) ω + ½ uᵀ ∂M₀ (2 ω − u).
        let [kinetic, both, part] = [(); 3].map(|()| memory.take(links));
        write_kinetic_slopes(pattern, beyond.slopes, motion.omega, kinetic);
        for (both, (&omega, &added)) in both.iter_mut().zip(motion.omega.iter().zip(&*added)) {
            *both = omega + omega - added;
        }
        write_slopes(pattern, matrix.slopes, [added, both], part);
        for (kinetic, &part) in kinetic.iter_mut().zip(&*part) {
            *kinetic = *kinetic + half * part;
        }
        let fall = part;
        let constants = [&self.whole, &mean.equal, &mean.beyond];
        self.write_potential_slope_mismatch(constants, &motion, fall);
        let (added, kinetic, fall) = (&*added, &*kinetic, &*fall);
        self.for_each(&motion, matrix, memory, |number, block, own| {
            let [mut driven, mut potential] = [zero; 2];
            for (_, link, _) in block.links::<T>() {
                let x = own.velocities[link];
                driven = driven + x * kinetic[link] + own.fall[link] * added[link];
                potential = potential - x * fall[link];
            }
            transfers[number] = Transfer {
                kinetic: driven - self.turning(block, own, added),
                potential,
            };
        });
    }

    /// Writes the powers (W) of forces on the energies of all sectors: Σ ∂E_s/∂p Q. NaN for slices
    /// of a wrong length.
    pub fn powers(
        &self,
        workspace: &mut Workspace<T>,
        acting: NonConservative<'_, T>,
        given: StateInput<'_, T>,
        powers: &mut [T],
    ) {
        powers.fill(T::from_f64(f64::NAN));
        let mut memory = FreeMemory(workspace.numbers(self.workspace_len()));
        let fits = powers.len() == self.shape.blocks.len();
        let Some(motion) = self.motion(given, &mut memory).filter(|_| fits) else {
            return;
        };
        let forces = memory.take(self.shape.links());
        forces.fill(T::from_f64(0.0));
        self.add_forces(acting, &motion, forces);
        let matrix = self.energy_matrix(&motion, &mut memory);
        let forces = &*forces;
        self.for_each(&motion, matrix, memory, |number, block, own| {
            powers[number] = self.power(block, own, forces);
        });
    }
}

/// Fills the transfers with NaN, for input from which they cannot be computed.
pub(super) fn fill<T: Scalar>(transfers: &mut [Transfer<T>]) {
    let nan = T::from_f64(f64::NAN);
    transfers.fill(Transfer {
        kinetic: nan,
        potential: nan,
    });
}
