//! Energies of sectors by each definition, and what changes them (physics (9.4) to (9.9)).

use alloc::vec::Vec;

use super::forces::NonConservative;
use super::memory::FreeMemory;
use super::motion::{MassEntries, TreeMotion, factors, room};
use super::parseval::{CENTRES, Centres, FORMED, KEPT};
use super::pattern::write_slopes;
use super::sector::{self, Alone, Surroundings};
use super::shape::BlockShape;
use super::{Given, SymmetricTree};
use crate::scalar::Scalar;
use crate::system::Workspace;

/// Kinetic energy of a sector, by what is known of its motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EnergyDefinition {
    /// ½ p_sᵀ B_s(0)⁻¹ p_s, from its momenta and its block of the mass matrix at rest.
    Rest,
    /// ½ p_sᵀ B_s(θ)⁻¹ p_s, with the block at the configuration: the paper's H_d where the
    /// sector has one coordinate.
    Canonical,
    /// By Parseval, from the velocities of the centres of mass: the energies sum to H.
    Parseval,
    /// ½ ω_sᵀ B_s(θ) ω_s, from its velocities.
    Velocity,
}

/// Energies of sectors and what changes them: dE/dt = transfer + power.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SectorBudget<T> {
    /// E_s, in joules.
    pub energies: Vec<T>,
    /// W_s, what other sectors give, in watts.
    pub transfers: Vec<T>,
    /// P_s, what other forces give, in watts; negative where they take.
    pub powers: Vec<T>,
}

impl<T> SectorBudget<T> {
    /// A budget of no sectors.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            energies: Vec::new(),
            transfers: Vec::new(),
            powers: Vec::new(),
        }
    }

    /// Makes room for so many sectors, of which nothing is known.
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

/// A sector's energy, transfer and power.
type Entry<T> = [T; 3];

/// What the shares of all sectors are formed of.
struct Around<'a, T> {
    surroundings: Surroundings<'a, T>,
    /// Accelerations that conservative forces give, and what the others add to them.
    accelerations: [&'a [T]; 2],
    forces: &'a [T],
}

impl<T: Scalar> SymmetricTree<T> {
    /// Computes the energies of all sectors, transfers into them and the powers of what acts
    /// besides, without truncation. Of a tree whose copies differ, energies from momenta or
    /// velocities are those of the mean tree (physics section 14); there are none by Parseval.
    ///
    /// NaN for slices of another length than there are links. Allocates the first time.
    pub fn budget(
        &self,
        workspace: &mut Workspace<T>,
        definition: EnergyDefinition,
        acting: &[NonConservative<'_, T>],
        given: Given<'_, T>,
        budget: &mut SectorBudget<T>,
    ) {
        let shape = &*self.shape;
        let (links, entries) = (shape.links(), shape.pattern.entries());
        let kept = (5 + CENTRES + KEPT + FORMED) * links;
        let others = 2 * entries + sector::room(shape.largest_block(), links);
        let length = room(links, entries) + kept + others + factors(links, entries);
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

    /// Writes the transfer matrix (W) row by row: entry (s, r) is what sector r gives sector s,
    /// energies by Parseval. Antisymmetric to the last bit; row s sums to the transfer into s.
    /// NaN for other lengths, and for a tree whose copies differ.
    pub fn transfer_matrix(
        &self,
        workspace: &mut Workspace<T>,
        given: Given<'_, T>,
        matrix: &mut [T],
    ) {
        let shape = &*self.shape;
        let sectors = shape.blocks.len();
        let (links, entries) = (shape.links(), shape.pattern.entries());
        matrix.fill(T::from_f64(f64::NAN));
        let all = 2 * sectors * links;
        let kept = (1 + CENTRES + KEPT + FORMED) * links + all;
        let length = room(links, entries) + kept + factors(links, entries);
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
            // The derivatives of E_s by momenta, u, and by angles at fixed momenta.
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
            self.write_own_fall(block, &motion, fall);
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

    /// Writes the torques that turn momenta: ∂L/∂θ − Ṁ ω.
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

    /// Writes the slopes of V_s, and returns V_s.
    fn write_own_fall(&self, block: &BlockShape, motion: &TreeMotion<'_, T>, fall: &mut [T]) -> T {
        let turns = [motion.sines, motion.cosines];
        let (own, parents) = ((&self.springs, &self.chords), &self.shape.parents);
        block.write_fall(self.equal(), own, parents, motion.theta, turns, fall)
    }

    /// E, W and P of a sector from its momenta.
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

    /// E, W and P of a sector by Parseval, from the velocities of the centres of mass.
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
        let potential = self.write_own_fall(block, motion, fall);
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

    /// E, W and P of a sector from its velocities z: T = ½ zᵀ M z.
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
        let potential = self.write_own_fall(block, motion, fall);
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

/// a·b.
fn product<T: Scalar>(a: &[T], b: &[T]) -> T {
    let pairs = a.iter().zip(b);
    pairs.fold(T::from_f64(0.0), |sum, (&a, &b)| sum + a * b)
}
