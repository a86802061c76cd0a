//! Requested outputs.

use crate::named_members::named_members;

named_members! {
    /// Method of solving for the accelerations, in absolute angles.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Solve {
        /// Factorisation of the mass matrix along the tree, M = LᵀDL.
        Factorization = "factorization",
        /// Articulated-body recursion from the leaves to the root and back.
        Recursion = "recursion",
    }
}

/// Declares the outputs that can be requested. An output without a value is declared by its name in
/// `emit(…)`, the trees that support it, and optionally another output that it implies; outputs
/// with a value follow.
macro_rules! requests {
    (
        flags {
            $($(#[$docs:meta])* $flag:ident: $support:ident $(implies $implied:ident)?;)+
        }
        values { $($(#[$value_docs:meta])* $value:ident: $kind:ty;)+ }
    ) => {
        /// Requested outputs in addition to the accelerations.
        #[derive(Debug, Clone, PartialEq, Eq, Default)]
        pub struct Requests {
            $($(#[$docs])* pub $flag: bool,)+
            $($(#[$value_docs])* pub $value: $kind,)+
        }

        impl Requests {
            /// Names of the outputs that take no forms in parentheses, with the trees that support
            /// them.
            pub(super) const FLAGS: &[(&str, Support)] =
                &[$((stringify!($flag), Support::$support)),+];

            /// Returns the flag of an output that takes no forms in parentheses.
            pub(super) fn flag(&mut self, name: &str) -> Option<&mut bool> {
                $(if name == stringify!($flag) {
                    return Some(&mut self.$flag);
                })+
                None
            }

            /// Sets the flags that other flags imply.
            pub(super) fn complete(&mut self) {
                $($(self.$implied |= self.$flag;)?)+
            }

            /// Returns the names of the requested outputs that take no forms in parentheses.
            pub(super) fn named(&self) -> impl Iterator<Item = (&'static str, Support)> {
                let wanted = [$(self.$flag),+].into_iter().zip(Self::FLAGS);
                wanted.filter_map(|(wanted, flag)| wanted.then_some(*flag))
            }
        }
    };
}

/// Trees that support an output, in addition to compiled trees whose equations are written out for
/// each link.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Support {
    /// Compiled trees in loops, and trees described at run time, which always provide it.
    Everywhere,
    /// Trees described at run time, which always provide it.
    RunTime,
    /// Run-time trees with identical siblings.
    RunTimeCopies,
    /// No other trees: the output is derived for one particular tree.
    WrittenOut,
}

requests! {
    flags {
        /// Kinetic and potential energy.
        energies: Everywhere;
        /// Canonical momenta and the corresponding velocities.
        momenta: RunTime;
        /// Mass and stiffness matrices of the linear modes.
        modes: RunTime;
        /// Symmetric coordinates: means and differences of identical siblings.
        symmetric: RunTimeCopies;
        /// Taylor coefficients of the motion in time.
        taylor: RunTime;
        /// Positions and velocities of links, and the torques of external forces on them.
        positions: Everywhere;
        /// Linear equations for small differences between identical copies that move in phase.
        transverse: WrittenOut;
        /// Formulas of the resonant normal form of degree 4.
        normal_form: WrittenOut;
        /// Accelerations under external torques that the caller passes.
        forces: Everywhere;
        /// Generalized torques of a motion with given accelerations.
        inverse_dynamics: Everywhere implies forces;
    }
    values {
        /// Method of solving for the accelerations. Without one, the method with fewer operations is
        /// chosen.
        solve: Option<Solve>;
        /// Energy transfer into the differences between identical copies. Also sets `momenta` and
        /// `symmetric`.
        transfer: Option<TransferRequest>;
        /// Energies of all sectors (means, and each difference between copies) and the transfers
        /// between them.
        budget: Option<BudgetRequest>;
        /// Functions of which derivatives by arguments and parameters are requested.
        gradient: Option<GradientRequest>;
        /// Indices of the sectors (small differences between copies) that act back on the in-phase
        /// motion. Also sets `transverse`.
        small: Vec<usize>;
    }
}

impl Requests {
    /// Returns true if energy budgets by scale (by generation of the branching) are requested.
    pub fn scales(&self) -> bool {
        self.budget.as_ref().is_some_and(|budget| budget.scales)
    }
}

/// Requested forms of the energy budget of sectors; at least one. The forms differ in the
/// definition of a sector's kinetic energy.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct BudgetRequest {
    /// Kinetic energy computed from the momenta and the sector's block of the mass matrix at rest.
    pub rest: bool,
    /// Kinetic energy computed from the momenta and the sector's block of the mass matrix at the
    /// current angles.
    pub canonical: bool,
    /// Kinetic energy by Parseval's identity, from the velocities of the centres of mass.
    pub parseval: bool,
    /// Kinetic energy computed from the velocities and the sector's block of the mass matrix at the
    /// current angles.
    pub velocity: bool,
    /// Energy transfer from each sector to each other sector, with the kinetic energies of
    /// Parseval's form.
    pub matrix: bool,
    /// Energies and transfers by scale, computed by loops with the kinetic energies of Parseval's
    /// form. A scale consists of all sectors that branch in the same generation.
    pub scales: bool,
    /// Orders in the amplitude of the differences at which the transfers are truncated. Also sets
    /// `momenta` and `symmetric`.
    pub amplitude_orders: Vec<u32>,
    /// Orders in the difference angles at which the transfers are truncated, without expansion in
    /// the momenta; 1 is the paper's form. Also sets `momenta` and `symmetric`.
    pub angle_orders: Vec<u32>,
    /// Sectors whose differences are treated as small in these expansions, each given by its group
    /// and the number of the difference. If the list is empty, all sectors are.
    pub small: Vec<(usize, usize)>,
}

/// Functions of which derivatives by arguments and parameters are requested; at least one.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct GradientRequest {
    /// Accelerations, without and with external torques.
    pub accelerations: bool,
    /// Kinetic and potential energy.
    pub energies: bool,
    /// Energy of a difference, and all requested forms of the transfer into it.
    pub transfer: bool,
    /// Names of observables.
    pub observables: Vec<String>,
}

/// Requested forms of the energy transfer; at least one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TransferRequest {
    /// Orders of the kinetic energy in the difference angles, without expansion in the momenta; 1
    /// is the paper's form.
    pub angle_orders: Vec<u32>,
    /// Orders in the amplitude of the differences, that is in their angles and momenta together; 2
    /// is the complete quadratic form.
    pub amplitude_orders: Vec<u32>,
    /// The form without truncation.
    pub exact: bool,
}
