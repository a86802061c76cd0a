//! Scales: a scale combines all sectors whose copies branch in one generation.

use alloc::vec::Vec;

use crate::scalar::Scalar;
use crate::system::Workspace;

/// A tree described by `generations(…)`, with energies and energy transfers by scale.
///
/// Scale 0 is the sector of the means. Scale s ≥ 1 combines all sectors that branch into links of
/// generation s, where the root is generation 0. There are as many scales as generations. Energies
/// are defined by Parseval's identity and sum to K + U (`docs/physics.md`, section 18).
///
/// Slices have one number per link, in the order of the model's links; for slices of a wrong length
/// all results are NaN. On [`Lanes`](crate::scalar::Lanes) one call computes many states.
///
/// # Examples
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::sectors::{ScaleBudget, Scales};
/// use branched_pendulum::system::Workspace;
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     tree: generations(count = 5, branching = 2, shape = rod, mass = 0.2, length = 0.3,
///         mass_ratio = 0.5, length_ratio = 0.7, friction = 1e-4),
///     emit(energies, budget(parseval, scales)),
/// )]
/// struct Tree;
///
/// let tree = Tree::<f64>::new();
/// let theta: Vec<f64> = (0..31).map(|link| 0.05 * f64::from(link)).collect();
/// let omega: Vec<f64> = (0..31).map(|link| 1.0 - 0.1 * f64::from(link)).collect();
/// let (mut workspace, mut budget) = (Workspace::new(), ScaleBudget::new());
/// tree.budget_by_scale(&mut workspace, 0.0, &theta, &omega, &mut budget);
///
/// let energy: f64 = (0..5).map(|scale| budget.energy(scale)).sum();
/// let whole = tree.kinetic_energy(&theta, &omega) + tree.potential_energy(&theta);
/// assert!((energy - whole).abs() < 1e-13 * whole);
/// // What one scale gives another takes from it.
/// assert_eq!(budget.transfer(0, 1), -budget.transfer(1, 0));
/// let received: f64 = (0..5).map(|scale| budget.received(scale)).sum();
/// assert!(received.abs() < 1e-12 * whole);
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not know its scales",
    note = "a tree by rule knows them with `emit(budget(parseval, scales))` in its attribute"
)]
pub trait Scales<T: Scalar> {
    /// Number of copies of each generation under each link of the generation before; 1 for the
    /// root.
    const COPIES: &'static [usize];

    /// Computes energies (J), energy transfers and powers (W) by scale. Takes O(n) operations per
    /// scale for n links, and two products per link for each pair of scales. Allocates at the first
    /// call.
    fn budget_by_scale(
        &self,
        workspace: &mut Workspace<T>,
        time: T,
        theta: &[T],
        omega: &[T],
        budget: &mut ScaleBudget<T>,
    );

    /// Computes energies, energy transfers and powers by scale, including the power of external
    /// torques (N m, one per link).
    fn budget_by_scale_under(
        &self,
        workspace: &mut Workspace<T>,
        time: T,
        theta: &[T],
        omega: &[T],
        torques: &[T],
        budget: &mut ScaleBudget<T>,
    );

    /// Computes the energies (J) by scale only, in O(n) operations. Transfers and powers are set to
    /// zero.
    fn energies_by_scale(
        &self,
        workspace: &mut Workspace<T>,
        theta: &[T],
        omega: &[T],
        budget: &mut ScaleBudget<T>,
    );

    /// Writes the energies of single sectors, in J: first that of the means, then for each link
    /// with k children those of the k − 1 differences (Helmert's), in the order of the links. There
    /// are as many sectors as leaves; if the slice has another length, all energies are NaN. O(n).
    fn energies_by_sector(
        &self,
        workspace: &mut Workspace<T>,
        theta: &[T],
        omega: &[T],
        energies: &mut [T],
    );
}

/// Returns the number of degrees of freedom of a scale in a tree of N generations: N for the means,
/// and N − s for each difference at each branching into generation s.
#[must_use]
pub fn degrees_of_freedom(copies: &[usize], scale: usize) -> usize {
    let Some(below) = copies.len().checked_sub(scale) else {
        return 0;
    };
    match scale {
        0 => below,
        _ => {
            let nodes: usize = copies.iter().take(scale).product();
            let children = copies.get(scale).copied().unwrap_or(1);
            nodes * (children.max(1) - 1) * below
        }
    }
}

/// Kind of a power that does not come from other scales: friction, drag, drive or external torques.
#[derive(Clone, Copy, Debug)]
pub enum PowerKind {
    /// Friction in pivots and between siblings.
    Friction,
    /// Drag against the ground.
    Drag,
    /// Torque on the root and motion of its pivot.
    Drive,
    /// Torques from outside.
    Outside,
}

impl PowerKind {
    pub(crate) const ALL: [Self; 4] = [Self::Friction, Self::Drag, Self::Drive, Self::Outside];
}

/// Energies by scale and their rates: dE_s/dt is the power received from other scales plus the
/// power of friction, drag, drive and external torques.
///
/// Created once and written by the functions of [`Scales`]. For scales that do not exist every
/// result is NaN.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ScaleBudget<T> {
    scales: usize,
    /// Energies (J) by scale, then by generation.
    energies: Vec<T>,
    /// Transfers {E_s, E_r} (W) from scale r to scale s, by s, then by r.
    transfers: Vec<T>,
    /// Powers (W) of friction, drive and other forces on the scales: by kind of force, then by
    /// scale.
    powers: Vec<T>,
}

impl<T: Scalar> ScaleBudget<T> {
    /// Creates a budget without scales.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            scales: 0,
            energies: Vec::new(),
            transfers: Vec::new(),
            powers: Vec::new(),
        }
    }

    /// Returns the number of scales; zero before the budget is computed.
    #[must_use]
    pub fn scales(&self) -> usize {
        self.scales
    }

    /// Returns the energy E_s of a scale, in J.
    #[must_use]
    pub fn energy(&self, scale: usize) -> T {
        self.sum(scale, |generation| self.energy_of(scale, generation))
    }

    /// Returns the part of E_s (J) that belongs to the links of one generation: their kinetic
    /// energy, and the potential energy that their rotation gives to all links they carry.
    #[must_use]
    pub fn energy_of(&self, scale: usize, generation: usize) -> T {
        self.at(&self.energies, scale, generation)
    }

    /// Returns the transfer W(r→s) = {E_s, E_r} from one scale to another, in W. It is exactly
    /// antisymmetric.
    #[must_use]
    pub fn transfer(&self, from: usize, to: usize) -> T {
        self.at(&self.transfers, to, from)
    }

    /// Returns the power that a scale receives from all other scales, in W: Σ_r W(r→s).
    #[must_use]
    pub fn received(&self, scale: usize) -> T {
        self.sum(scale, |from| self.transfer(from, scale))
    }

    /// Returns the flux through a scale, in W: Π_j = Σ W(r→s) over r < j ≤ s, the power that all
    /// scales before it supply to this scale and the scales after it.
    #[must_use]
    pub fn flux(&self, scale: usize) -> T {
        self.sum(scale, |from| match from < scale {
            true => {
                (scale..self.scales).fold(T::from_f64(0.0), |sum, to| sum + self.transfer(from, to))
            }
            false => T::from_f64(0.0),
        })
    }

    /// Returns the power of friction in the pivots on the energy of a scale, in W. For a single
    /// scale it may have either sign.
    #[must_use]
    pub fn friction_power(&self, scale: usize) -> T {
        self.power_of(PowerKind::Friction, scale)
    }

    /// Returns the power of drag against the ground on the energy of a scale, in W.
    #[must_use]
    pub fn drag_power(&self, scale: usize) -> T {
        self.power_of(PowerKind::Drag, scale)
    }

    /// Returns the power of the drive on a scale, in W: of the torque on the root and of the motion
    /// of its pivot.
    #[must_use]
    pub fn drive_power(&self, scale: usize) -> T {
        self.power_of(PowerKind::Drive, scale)
    }

    /// Returns the power of external torques on a scale, in W.
    #[must_use]
    pub fn outside_power(&self, scale: usize) -> T {
        self.power_of(PowerKind::Outside, scale)
    }

    /// Returns the power of friction, drag, drive and external torques on a scale, in W.
    #[must_use]
    pub fn power(&self, scale: usize) -> T {
        let powers = PowerKind::ALL.map(|kind| self.power_of(kind, scale));
        (powers[0] + powers[1]) + (powers[2] + powers[3])
    }

    /// Adds an energy (J) to a scale; it is counted in the generation at which the scale branches.
    /// Does nothing for a scale that does not exist.
    pub fn add_energy(&mut self, scale: usize, energy: T) {
        let place = scale * self.scales + scale;
        if let (Some(own), true) = (self.energies.get_mut(place), scale < self.scales) {
            *own = *own + energy;
        }
    }

    fn power_of(&self, kind: PowerKind, scale: usize) -> T {
        self.at(&self.powers, kind as usize, scale)
    }

    fn at(&self, table: &[T], row: usize, column: usize) -> T {
        let number = table.get(row * self.scales + column);
        match number {
            Some(&number) if column < self.scales => number,
            _ => T::from_f64(f64::NAN),
        }
    }

    /// Returns the sum of `term` over all scales; NaN if `scale` does not exist.
    fn sum(&self, scale: usize, term: impl Fn(usize) -> T) -> T {
        match scale < self.scales {
            true => (0..self.scales).fold(T::from_f64(0.0), |sum, other| sum + term(other)),
            false => T::from_f64(f64::NAN),
        }
    }

    /// Resizes the budget to the given number of scales, and sets every number to `value`. With the
    /// functions below it, other crates write budgets of their own trees.
    pub fn fill(&mut self, scales: usize, value: T) {
        self.scales = scales;
        let kinds = PowerKind::ALL.len();
        for (table, length) in [
            (&mut self.energies, scales * scales),
            (&mut self.transfers, scales * scales),
            (&mut self.powers, kinds * scales),
        ] {
            table.clear();
            table.resize(length, value);
        }
    }

    /// Sets the part of a scale's energy in the links of one generation, in J. Does nothing for a
    /// scale or generation that does not exist.
    pub fn set_energy(&mut self, scale: usize, generation: usize, value: T) {
        if generation < self.scales {
            put(&mut self.energies, scale * self.scales + generation, value);
        }
    }

    /// Sets the transfer W(r→s) to `value`, and W(s→r) to its negative. Does nothing for a scale that
    /// does not exist.
    pub fn set_transfer(&mut self, from: usize, to: usize, value: T) {
        if from.max(to) < self.scales {
            put(&mut self.transfers, to * self.scales + from, value);
            put(&mut self.transfers, from * self.scales + to, -value);
        }
    }

    /// Adds a power (W) to those of its kind on a scale. Does nothing for a scale that does not exist.
    pub fn add_power(&mut self, kind: PowerKind, scale: usize, value: T) {
        let place = kind as usize * self.scales + scale;
        if let (Some(power), true) = (self.powers.get_mut(place), scale < self.scales) {
            *power = *power + value;
        }
    }
}

fn put<T>(table: &mut [T], index: usize, value: T) {
    if let Some(place) = table.get_mut(index) {
        *place = value;
    }
}

#[cfg(test)]
mod tests {
    use super::degrees_of_freedom;

    #[test]
    fn degrees_of_freedom_are_those_of_all_links() {
        for copies in [&[1, 2, 2, 2][..], &[1, 3, 3], &[1, 2, 5, 3]] {
            let (mut links, mut count) = (0, 1);
            for copies in copies {
                count *= copies;
                links += count;
            }
            let scales = 0..copies.len() + 2;
            let sum: usize = scales.map(|scale| degrees_of_freedom(copies, scale)).sum();
            assert_eq!(sum, links);
        }
        assert_eq!(degrees_of_freedom(&[1, 2, 2, 2], 2), 4);
    }
}
