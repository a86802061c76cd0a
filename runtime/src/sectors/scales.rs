//! Scales: all sectors that branch in one generation, together.

use alloc::vec::Vec;

use crate::scalar::Scalar;
use crate::system::Workspace;

/// A tree by rule whose energies and transfers are known by scale.
///
/// Scale 0 is the sector of the means, scale s ≥ 1 are all sectors that branch into
/// links of generation s, the root being generation 0: as many scales as generations.
/// Energies are those by Parseval, which sum to K + U (`docs/physics.md`, section 18).
///
/// Slices have one number for each link, in the order of the model's links; all results
/// are NaN for slices of another length. On [`Lanes`](crate::scalar::Lanes) one call
/// computes many states.
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
    /// Copies of each generation under each link of the one before, 1 for the root.
    const COPIES: &'static [usize];

    /// Computes energies, transfers and powers by scale, with O(n) operations for each
    /// scale of n links and two products a link for each pair of scales. Allocates the
    /// first time.
    fn budget_by_scale(
        &self,
        workspace: &mut Workspace<T>,
        time: T,
        theta: &[T],
        omega: &[T],
        budget: &mut ScaleBudget<T>,
    );

    /// Computes the same with the power of torques from outside, N m, one for each link.
    fn budget_by_scale_under(
        &self,
        workspace: &mut Workspace<T>,
        time: T,
        theta: &[T],
        omega: &[T],
        torques: &[T],
        budget: &mut ScaleBudget<T>,
    );

    /// Computes the energies alone, in O(n) operations. Transfers and powers are zero
    /// then.
    fn energies_by_scale(
        &self,
        workspace: &mut Workspace<T>,
        theta: &[T],
        omega: &[T],
        budget: &mut ScaleBudget<T>,
    );

    /// Writes the energies of single sectors, J: of the means, then k − 1 for each link
    /// with k children, in the order of the links and of Helmert's differences. There
    /// are as many as leaves; all are NaN in a slice of another length. O(n).
    fn energies_by_sector(
        &self,
        workspace: &mut Workspace<T>,
        theta: &[T],
        omega: &[T],
        energies: &mut [T],
    );
}

/// Returns the degrees of freedom of a scale: N in N generations for the means, else
/// N − s for each difference of each branching into generation s.
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

/// Cause of a power that enters or leaves by itself.
#[derive(Clone, Copy, Debug)]
pub(crate) enum PowerKind {
    Friction,
    Drag,
    Drive,
    Outside,
}

impl PowerKind {
    pub(crate) const ALL: [Self; 4] = [Self::Friction, Self::Drag, Self::Drive, Self::Outside];
}

/// Energies by scale, and what changes them: dE_s/dt is what the scale receives from
/// others and the power of friction, drag, drive and torques from outside on it.
///
/// Made once and written by the functions of [`Scales`]. Beyond the scales that there
/// are, every answer is NaN.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ScaleBudget<T> {
    scales: usize,
    /// By scale, then by generation.
    energies: Vec<T>,
    /// {E_s, E_r} by s, then by r.
    transfers: Vec<T>,
    /// By kind, then by scale.
    powers: Vec<T>,
}

impl<T: Scalar> ScaleBudget<T> {
    /// A budget of no scales.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            scales: 0,
            energies: Vec::new(),
            transfers: Vec::new(),
            powers: Vec::new(),
        }
    }

    /// Number of scales, zero before the budget was computed.
    #[must_use]
    pub fn scales(&self) -> usize {
        self.scales
    }

    /// Energy E_s, J.
    #[must_use]
    pub fn energy(&self, scale: usize) -> T {
        self.sum(scale, |generation| self.energy_of(scale, generation))
    }

    /// Part of E_s in the links of one generation, J: kinetic energy of these links, and
    /// potential energy of all that they carry, as far as they turn.
    #[must_use]
    pub fn energy_of(&self, scale: usize, generation: usize) -> T {
        self.at(&self.energies, scale, generation)
    }

    /// Transfer W(r→s) = {E_s, E_r}, W: what one scale gives another. Antisymmetric to
    /// the last bit.
    #[must_use]
    pub fn transfer(&self, from: usize, to: usize) -> T {
        self.at(&self.transfers, to, from)
    }

    /// Returns the power that a scale receives from all others, W: Σ_r W(r→s).
    #[must_use]
    pub fn received(&self, scale: usize) -> T {
        self.sum(scale, |from| self.transfer(from, scale))
    }

    /// Flux through a scale, W: Π_j = Σ W(r→s) over r < j ≤ s, what the scales above
    /// give to this one and those below.
    #[must_use]
    pub fn flux(&self, scale: usize) -> T {
        self.sum(scale, |from| match from < scale {
            true => {
                (scale..self.scales).fold(T::from_f64(0.0), |sum, to| sum + self.transfer(from, to))
            }
            false => T::from_f64(0.0),
        })
    }

    /// Power of friction in the pivots on a scale, W. By scale it may have either sign.
    #[must_use]
    pub fn friction_power(&self, scale: usize) -> T {
        self.power_of(PowerKind::Friction, scale)
    }

    /// Power of drag against the ground on a scale, W.
    #[must_use]
    pub fn drag_power(&self, scale: usize) -> T {
        self.power_of(PowerKind::Drag, scale)
    }

    /// Power of the drive on a scale, W: of the torque on the root and of the motion of
    /// its pivot.
    #[must_use]
    pub fn drive_power(&self, scale: usize) -> T {
        self.power_of(PowerKind::Drive, scale)
    }

    /// Power of torques from outside on a scale, W.
    #[must_use]
    pub fn outside_power(&self, scale: usize) -> T {
        self.power_of(PowerKind::Outside, scale)
    }

    /// Power of friction, drag, drive and torques from outside on a scale, W.
    #[must_use]
    pub fn power(&self, scale: usize) -> T {
        let powers = PowerKind::ALL.map(|kind| self.power_of(kind, scale));
        (powers[0] + powers[1]) + (powers[2] + powers[3])
    }

    /// Adds an energy (J) that a scale has besides, in the links of the scale's own generation;
    /// none to a scale that there is not.
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

    /// A sum over all scales, of one that there is.
    fn sum(&self, scale: usize, term: impl Fn(usize) -> T) -> T {
        match scale < self.scales {
            true => (0..self.scales).fold(T::from_f64(0.0), |sum, other| sum + term(other)),
            false => T::from_f64(f64::NAN),
        }
    }

    /// Makes room for so many scales, with one number everywhere.
    pub(crate) fn fill(&mut self, scales: usize, value: T) {
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

    pub(crate) fn set_energy(&mut self, scale: usize, generation: usize, value: T) {
        put(&mut self.energies, scale * self.scales + generation, value);
    }

    /// Sets W(r→s), and −W(r→s) as W(s→r).
    pub(crate) fn set_transfer(&mut self, from: usize, to: usize, value: T) {
        put(&mut self.transfers, to * self.scales + from, value);
        put(&mut self.transfers, from * self.scales + to, -value);
    }

    pub(crate) fn add_power(&mut self, kind: PowerKind, scale: usize, value: T) {
        if let Some(power) = self.powers.get_mut(kind as usize * self.scales + scale) {
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
