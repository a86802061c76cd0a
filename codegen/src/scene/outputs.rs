//! Outputs that are asked for.

use crate::named_members::named_members;

named_members! {
    /// Method by which the accelerations in absolute angles are solved for.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Solve {
        /// The mass matrix factorised along the tree, M = LᵀDL.
        Factorization = "factorization",
        /// Articulated recursion from the leaves to the root and back.
        Recursion = "recursion",
    }
}

/// Outputs that are asked for beside the accelerations.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Requests {
    /// Solve for the accelerations; the one of fewer operations if nothing is
    /// said.
    pub solve: Option<Solve>,
    /// Kinetic and potential energy.
    pub energies: bool,
    /// Generalized momenta and the velocities that belong to them.
    pub momenta: bool,
    /// The matrices of the linear modes.
    pub modes: bool,
    /// Symmetric coordinates: means and differences of identical siblings.
    pub symmetric: bool,
    /// Energy transfer into the differences. Comes with `momenta` and
    /// `symmetric`.
    pub transfer: Option<TransferRequest>,
    /// Energies of all sectors and the transfers between them.
    pub budget: Option<BudgetRequest>,
    /// Taylor coefficients of the motion.
    pub taylor: bool,
    /// Positions and velocities of links, and the torques of forces on them.
    pub positions: bool,
    /// Equations of small differences between copies in phase.
    pub transverse: bool,
    /// Transverse sectors whose differences act back on the motion in phase, by number.
    /// Comes with `transverse`.
    pub small: Vec<usize>,
    /// Accelerations under torques that the caller hands over.
    pub forces: bool,
}

impl Requests {
    /// Returns true if budgets by scale are asked for.
    pub fn scales(&self) -> bool {
        self.budget.as_ref().is_some_and(|budget| budget.scales)
    }
}

/// Forms of the sectors' budget that are asked for; at least one. The forms
/// differ in the definition of a sector's kinetic energy.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct BudgetRequest {
    /// Energies from the momenta and the sector's block of the mass matrix at
    /// rest.
    pub rest: bool,
    /// Energies from the momenta and the block at the configuration.
    pub canonical: bool,
    /// Energies by Parseval from the velocities of the centres of mass.
    pub parseval: bool,
    /// Energies from the velocities and the block at the configuration.
    pub velocity: bool,
    /// Energy transfer from each sector to each other, by Parseval.
    pub matrix: bool,
    /// Energies and transfers by scale, in loops: all sectors that branch in one
    /// generation together, by Parseval.
    pub scales: bool,
    /// Orders in the amplitude of the differences through which the transfers
    /// are expanded. Comes with `momenta` and `symmetric`.
    pub amplitude_orders: Vec<u32>,
    /// Orders in the angles of the differences alone, momenta kept whole; 1 is
    /// the counting of the paper. Comes with `momenta` and `symmetric`.
    pub angle_orders: Vec<u32>,
    /// The sectors whose differences count as small in these orders, each by
    /// its group and the number of the difference; all if none is named.
    pub small: Vec<(usize, usize)>,
}

/// Forms of the energy transfer that are asked for; at least one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TransferRequest {
    /// Orders of the kinetic energy in the difference angles, momenta kept
    /// whole; 1 is the form of the paper.
    pub angle_orders: Vec<u32>,
    /// Orders in the amplitude of the differences, angles and momenta alike; 2
    /// is the complete quadratic form.
    pub amplitude_orders: Vec<u32>,
    /// The form without truncation.
    pub exact: bool,
}
