//! Energies of sectors in each definition, and their rates (physics (9.4) to (9.9)).

use alloc::vec::Vec;

use super::forces::NonConservative;
use super::memory::FreeMemory;
use super::motion::{MassEntries, TreeMotion, factors, workspace_len};
use super::parseval::{CENTRES, Centres, FORMED, KEPT};
use super::pattern::write_slopes;
use super::sector::{self, Alone, Surroundings};
use super::shape::BlockShape;
use super::{StateInput, SymmetricTree};
use crate::scalar::Scalar;
use crate::system::Workspace;

/// Definition of the kinetic energy of a sector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EnergyDefinition {
    /// Computed from the sector's momenta p_s and its block B_s of the mass matrix at rest: ½ p_sᵀ
    /// B_s(0)⁻¹ p_s.
    Rest,
    /// Computed from the sector's momenta p_s and its block B_s of the mass matrix at the current
    /// angles: ½ p_sᵀ B_s(θ)⁻¹ p_s. It is the paper's H_d if the sector has one coordinate.
    Canonical,
    /// Computed from the velocities of the centres of mass by Parseval's identity: the energies of
    /// all sectors sum to H.
    Parseval,
    /// Computed from the sector's velocities ω_s and its block B_s of the mass matrix: ½ ω_sᵀ
    /// B_s(θ) ω_s.
    Velocity,
}

/// Energies E of all sectors and their rates of change: dE/dt = transfer + power.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SectorBudget<T> {
    /// Energies E_s, in J.
    pub energies: Vec<T>,
    /// Energy transfers W_s from all other sectors into each sector, in W.
    pub transfers: Vec<T>,
    /// Powers P_s of non-conservative forces on each sector, in W; negative if they remove energy.
    pub powers: Vec<T>,
}

impl<T> SectorBudget<T> {
    /// Creates a budget without sectors.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            energies: Vec::new(),
            transfers: Vec::new(),
            powers: Vec::new(),
        }
    }

    /// Resizes the budget to the given number of sectors, and sets all numbers to NaN.
    fn reset(&mut self, sectors: usize)
    where
        T: Scalar,
    {
        for list in [&mut self.energies, &mut self.transfers, &mut self.powers] {
            list.clear();
            list.resize(sectors, T::from_f64(f64::NAN));
        }
    }
}

/// Energy, transfer and power of a sector.
type Entry<T> = [T; 3];

/// Quantities of the whole tree from which the entries of all sectors are computed.
struct Around<'a, T> {
    surroundings: Surroundings<'a, T>,
    /// Accelerations caused by springs and gravity, and those that the other forces add.
    accelerations: [&'a [T]; 2],
    forces: &'a [T],
}

impl<T: Scalar> SymmetricTree<T> {
    /// Computes the energies of all sectors, the transfers into them and the powers of the `acting`
    /// forces, without truncation. If copies differ, energies from momenta or velocities are those
    /// of the mean tree (physics section 14), and those by Parseval are NaN.
    ///
    /// NaN if a slice does not have one number per link. Allocates at the first call.
    pub fn budget(
        &self,
        workspace: &mut Workspace<T>,
        definition: EnergyDefinition,
        acting: &[NonConservative<'_, T>],
        given: StateInput<'_, T>,
        budget: &mut SectorBudget<T>,
    ) {
        let shape = &*self.shape;
        let (links, entries) = (shape.links(), shape.pattern.entries());
        let kept = (5 + CENTRES + KEPT + FORMED) * links;
        let others = 2 * entries + sector::workspace_len(shape.largest_block(), links);
        let length = workspace_len(links, entries) + kept + others + factors(links, entries);
        let mut memory = FreeMemory(workspace.numbers(length));
        budget.reset(shape.blocks.len());
        let is_uneven = self.mean.is_some() && definition == EnergyDefinition::Parseval;
        let Some(motion) = self.motion(given, &mut memory).filter(|_| !is_uneven) else {
            return;
        };
        let forces = memory.take(links);
        forces.fill(T::from_f64(0.0));
        for &acting in acting {
            self.add_forces(acting, &motion, forces);
        }
        let slopes = self.slopes(&self.whole, motion.matrix, &motion, &mut memory);
        let [free, added] = [(); 2].map(|()| memory.take(links));
        let by_momenta = matches!(
            definition,
            EnergyDefinition::Rest | EnergyDefinition::Canonical
        );
        if !by_momenta {
            self.write_accelerations(&motion, [slopes.kinetic, slopes.potential], free);
            self.solve(&self.whole, motion.matrix, free, memory.lend());
            added.copy_from_slice(forces);
            self.solve(&self.whole, motion.matrix, added, memory.lend());
        }
        let around = Around {
            surroundings: Surroundings {
                omega: motion.omega,
                slopes,
            },
            accelerations: [free, added],
            forces,
        };
        let energy_matrix = self.energy_matrix(&motion, &mut memory);
        let centres = self.centres(&motion, &mut memory);
        let results = budget.energies.iter_mut();
        let results = results.zip(budget.transfers.iter_mut().zip(&mut budget.powers));
        for (block, (energy, (transfer, power))) in shape.blocks.iter().zip(results) {
            let mut own = memory.lend();
            [*energy, *transfer, *power] = match definition {
                EnergyDefinition::Rest => {
                    let own = self.alone_at_rest(block, &motion, &mut own);
                    self.by_momenta(block, &own, &around)
                }
                EnergyDefinition::Canonical => {
                    let own = self.alone(block, self.equal(), energy_matrix, &motion, &mut own);
                    self.by_momenta(block, &own, &around)
                }
                EnergyDefinition::Velocity => {
                    self.by_velocities(block, energy_matrix, &motion, &around, own)
                }
                EnergyDefinition::Parseval => {
                    self.by_parseval(block, &centres, &motion, &around, own)
                }
            };
        }
    }

    /// Writes the transfer matrix (W) row by row: entry (s, r) is the power that sector r supplies
    /// to sector s, with energies by Parseval's identity. It is exactly antisymmetric; row s sums
    /// to the transfer into s. All entries are NaN if a slice has a wrong length or if copies of
    /// the tree differ.
    pub fn transfer_matrix(
        &self,
        workspace: &mut Workspace<T>,
        given: StateInput<'_, T>,
        matrix: &mut [T],
    ) {
        let shape = &*self.shape;
        let sectors = shape.blocks.len();
        let (links, entries) = (shape.links(), shape.pattern.entries());
        matrix.fill(T::from_f64(f64::NAN));
        let all = 2 * sectors * links;
        let kept = (1 + CENTRES + KEPT + FORMED) * links + all;
        let length = workspace_len(links, entries) + kept + factors(links, entries);
        let mut memory = FreeMemory(workspace.numbers(length));
        let fits = matrix.len() == sectors * sectors && self.mean.is_none();
        let Some(motion) = self.motion(given, &mut memory).filter(|_| fits) else {
            return;
        };
        let [flows, pushes] = [(); 2].map(|()| memory.take(sectors * links));
        let centres = self.centres(&motion, &mut memory);
        let rows = flows
            .chunks_exact_mut(links)
            .zip(pushes.chunks_exact_mut(links));
        for (block, (flow, push)) in shape.blocks.iter().zip(rows) {
            // Derivatives of E_s by momenta, u, and by angles at fixed momenta.
            let mut own = memory.lend();
            let share = self.share(block, &motion, &centres, &mut own);
            flow.copy_from_slice(share.by_omega);
            self.solve(&self.whole, motion.matrix, flow, own.lend());
            let turned = own.take(links);
            let pattern = &shape.pattern;
            write_slopes(pattern, motion.matrix.slopes, [flow, motion.omega], turned);
            for (link, push) in push.iter_mut().enumerate() {
                *push = share.by_theta[link] - turned[link];
            }
            let fall = turned;
            self.write_sector_potential_slopes(block, &motion, fall);
            for (_, link, _) in block.links::<T>() {
                push[link] = push[link] + fall[link];
            }
        }
        for (into, row) in matrix.chunks_exact_mut(sectors).enumerate() {
            for (from, entry) in row.iter_mut().enumerate() {
                let places = |sector: usize| sector * links..(sector + 1) * links;
                let pairs = places(into).zip(places(from));
                *entry = pairs.fold(T::from_f64(0.0), |sum, (own, other)| {
                    sum + (pushes[own] * flows[other] - pushes[other] * flows[own])
                });
            }
        }
    }

    /// Writes the torques ∂L/∂θ − Ṁ ω, from which M⁻¹ gives the accelerations (L is the Lagrangian,
    /// M the mass matrix).
    fn write_accelerations(
        &self,
        motion: &TreeMotion<'_, T>,
        [kinetic, potential]: [&[T]; 2],
        torques: &mut [T],
    ) {
        let omega = motion.omega;
        for (link, torque) in torques.iter_mut().enumerate() {
            *torque = kinetic[link] - potential[link];
        }
        for (place, link, above) in self.shape.pattern.iter() {
            let rate = motion.matrix.slopes[place] * (omega[link] - omega[above]);
            torques[link] = torques[link] - rate * omega[above];
            torques[above] = torques[above] - rate * omega[link];
        }
    }

    /// Writes the derivatives of the sector's potential energy V_s by the angles; returns V_s.
    fn write_sector_potential_slopes(
        &self,
        block: &BlockShape,
        motion: &TreeMotion<'_, T>,
        fall: &mut [T],
    ) -> T {
        let turns = [motion.sines, motion.cosines];
        let (own, parents) = ((&self.springs, &self.chords), &self.shape.parents);
        block.write_potential_slopes(self.equal(), own, parents, motion.theta, turns, fall)
    }

    /// Computes energy, transfer and power of a sector from its momenta.
    fn by_momenta(
        &self,
        block: &BlockShape,
        own: &Alone<'_, T>,
        around: &Around<'_, T>,
    ) -> Entry<T> {
        let transfer = self.terms(block, own, &around.surroundings).transfer();
        [
            own.energy[0] + own.energy[1],
            transfer.total(),
            self.power(block, own, around.forces),
        ]
    }

    /// Computes energy, transfer and power of a sector by Parseval's identity, from the velocities
    /// of the centres of mass.
    fn by_parseval(
        &self,
        block: &BlockShape,
        centres: &Centres<'_, T>,
        motion: &TreeMotion<'_, T>,
        around: &Around<'_, T>,
        mut memory: FreeMemory<'_, T>,
    ) -> Entry<T> {
        let share = self.share(block, motion, centres, &mut memory);
        let fall = memory.take(self.shape.links());
        let potential = self.write_sector_potential_slopes(block, motion, fall);
        let [free, added] = around.accelerations;
        let stored = block.links::<T>();
        let stored = stored.fold(T::from_f64(0.0), |sum, (_, link, _)| {
            sum + fall[link] * motion.omega[link]
        });
        [
            share.kinetic + potential,
            product(share.by_omega, free) + product(share.by_theta, motion.omega) + stored,
            product(share.by_omega, added),
        ]
    }

    /// Computes energy, transfer and power of a sector from its velocities z and the mass matrix M:
    /// T = ½ zᵀ M z.
    fn by_velocities(
        &self,
        block: &BlockShape,
        matrix: MassEntries<'_, T>,
        motion: &TreeMotion<'_, T>,
        around: &Around<'_, T>,
        mut memory: FreeMemory<'_, T>,
    ) -> Entry<T> {
        let (pattern, zero) = (&self.shape.pattern, T::from_f64(0.0));
        let links = self.shape.links();
        let [own, product, fall] = [(); 3].map(|()| memory.take(links));
        for column in &block.columns {
            let mean = column.sum(|link| motion.omega[link]) / T::from_f64(column.norm);
            for (link, weight) in column.iter() {
                let weight: T = weight;
                own[link] = weight * mean;
                product[link] = self.equal().inertia[link] * own[link];
            }
        }
        let mut turning = zero;
        for (place, link, above) in block.pairs(pattern) {
            let entry = matrix.beside[place];
            product[link] = product[link] + entry * own[above];
            product[above] = product[above] + entry * own[link];
            let rate = motion.omega[link] - motion.omega[above];
            turning = turning + matrix.slopes[place] * (own[link] * own[above]) * rate;
        }
        let potential = self.write_sector_potential_slopes(block, motion, fall);
        let [free, added] = around.accelerations;
        let [mut twice, mut transfer, mut power] = [zero, turning, zero];
        for column in &block.columns {
            let momentum = column.sum(|link| product[link]) / T::from_f64(column.norm);
            for (link, weight) in column.iter() {
                let weight: T = weight;
                twice = twice + own[link] * product[link];
                transfer = transfer + fall[link] * motion.omega[link];
                transfer = transfer + weight * momentum * free[link];
                power = power + weight * momentum * added[link];
            }
        }
        [T::from_f64(0.5) * twice + potential, transfer, power]
    }
}

/// Returns the scalar product a·b.
fn product<T: Scalar>(a: &[T], b: &[T]) -> T {
    let pairs = a.iter().zip(b);
    pairs.fold(T::from_f64(0.0), |sum, (&a, &b)| sum + a * b)
}
