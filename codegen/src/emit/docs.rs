//! Rustdoc of the emitted items: meaning, units, formulas, cost, source.

use super::Emission;
use super::doc_text::doc_lines;
use crate::functions::{Argument, Purpose};
use crate::program::{Entry, Rounding};
use crate::scene::{DescribedLinePotential, Reduction, Solve};
use proc_macro2::TokenStream;

impl Emission<'_> {
    /// Returns true if a spring is at rest beside its parent's line, or along a line.
    pub(super) fn has_rest_angles(&self) -> bool {
        let mut torques = self.scene.passive_torques();
        torques.any(|torques| !torques.rest.is_zero()) || !self.scene.translational.is_empty()
    }

    /// The state of potential energy zero, for docs.
    pub(super) fn zero_of_potential(&self) -> &'static str {
        let mut stored = self
            .scene
            .translational
            .iter()
            .flat_map(|own| &own.potentials);
        let repels = stored.any(|own| matches!(own, DescribedLinePotential::InversePower { .. }));
        match (self.has_rest_angles(), repels) {
            (_, true) => {
                "that of gravity zero where all are zero, that of springs where they are at rest, \
                 that of repulsions at infinite distances"
            }
            (true, false) => {
                "that of gravity zero where all are zero, that of springs where they are at rest"
            }
            (false, false) => "zero where all are zero",
        }
    }

    /// Docs of the model beside its author's words.
    pub(super) fn model_docs(&self) -> Vec<String> {
        let scene = self.scene;
        if scene.in_loops() {
            return self.strip_docs();
        }
        let links: Vec<&str> = scene.links.iter().map(|link| link.name.as_str()).collect();
        let mut lines = vec![format!(
            "A planar tree of {} rigid {}; angles are absolute, from the {}, in the order {} SI units throughout, angles in radians.",
            links.len(),
            if links.len() == 1 { "link" } else { "links" },
            scene.vertical(),
            wrapped_names(&links),
        )];
        if let Some(frame) = &self.mechanics.symmetric {
            let names: Vec<&str> = frame
                .coordinates
                .iter()
                .map(|&id| self.mechanics.symbols.get(id).code.as_str())
                .collect();
            lines.push(String::new());
            lines.push(format!(
                "Symmetric coordinates, in the order {} `from_symmetric` shows how they form the angles.",
                wrapped_names(&names)
            ));
        }
        if scene.requests.transfer.is_some() {
            lines.push(String::new());
            lines.push("Transfers follow Y. Toda and T. Ooshida, *Experimental detection of energy transfer into the anti-phase mode in a branched double pendulum*.".into());
        }
        if let Some(Reduction { links, .. }) = &scene.reduction {
            lines.push(String::new());
            lines.push(format!("A motion of a tree of {links} links: `WHOLE` has which of them move alike, and their angles."));
        }
        if self.mechanics.drive.is_some() {
            lines.extend(self.drive_docs());
            self.show(&self.drive_formulas(), &mut lines);
        }
        if !scene.requests.energies && scene.requests.transfer.is_none() {
            lines.push(String::new());
            lines.push("More can be asked for with `emit(…)` in the attribute.".into());
        }
        lines.extend(self.example());
        lines
    }

    pub(super) fn entry_docs(&self, entry: &Entry) -> TokenStream {
        let mut lines = self.meaning(entry.purpose);
        let told = lines.concat();
        let untold: Vec<&str> = entry
            .arguments
            .iter()
            .filter(|argument| !told.contains(&format!("`{}`", argument.name())))
            .filter_map(|argument| argument_meaning(*argument))
            .collect();
        if !untold.is_empty() {
            lines.push(String::new());
            let untold = match untold.as_slice() {
                [others @ .., last] if !others.is_empty() => {
                    format!("{} and {last}", others.join(", "))
                }
                untold => untold.concat(),
            };
            lines.push(format!("At {untold}."));
        }
        let formulas = self.formulas(entry.purpose);
        self.show(&formulas, &mut lines);
        lines.push(String::new());
        let fused = match self.program.fused(entry).len() {
            0 => String::new(),
            count => format!("; {count} of the ± take a × along where the scalar fuses"),
        };
        let operations = self.program.operations(&entry.outputs);
        let mut cost = format!("Cost: {operations}{fused}.");
        let choice = &self.program.choice;
        if entry.purpose == Purpose::Accelerations
            && choice.solve == Solve::Recursion
            && let Some(factorization) = choice.factorization
        {
            cost += &format!(" By elimination: {factorization}.");
        }
        if let Some(Rounding { ulps, states }) = self.program.rounding(entry) {
            // Rounded up.
            let ulps = (10.0 * ulps).ceil() / 10.0;
            cost += &format!(
                " Rounding error: at most {ulps:.1} ulp of the largest result, at {states} states."
            );
        }
        lines.push(cost);
        doc_lines(&lines)
    }

    pub(super) fn meaning(&self, purpose: Purpose) -> Vec<String> {
        match purpose {
            Purpose::Accelerations | Purpose::AccelerationsUnder | Purpose::TaylorCoefficients => {
                self.motion_meaning(purpose)
            }
            Purpose::ToSymmetric
            | Purpose::FromSymmetric
            | Purpose::SymmetricAccelerations
            | Purpose::SymmetricMomenta
            | Purpose::SymmetricVelocities
            | Purpose::Hamiltonian => self.symmetric_meaning(purpose),
            Purpose::SubHamiltonian(_)
            | Purpose::TruncatedTransfer(..)
            | Purpose::QuadraticForm(_)
            | Purpose::ExactTransfer(..)
            | Purpose::SplitTransfer(..)
            | Purpose::AntiphaseFrictionPower(..)
            | Purpose::AntiphaseDrivePower(..)
            | Purpose::AntiphaseOutsidePower(..) => self.transfer_meaning(purpose),

            Purpose::KineticEnergy
            | Purpose::PotentialEnergy
            | Purpose::MassMatrix
            | Purpose::StiffnessMatrix => self.energy_meaning(purpose),
            Purpose::AbsoluteMomenta | Purpose::AbsoluteVelocities | Purpose::CanonicalRates => {
                self.canonical_meaning(purpose)
            }
            Purpose::Drive
            | Purpose::RootDrive
            | Purpose::DrivePower
            | Purpose::OutsidePower
            | Purpose::TotalFrictionPower => self.action_meaning(purpose),

            Purpose::Prescribed(set) => self.prescribed_meaning(set),
            Purpose::Observable(n, form) => self.observable_meaning(n, form),
            Purpose::Budget(..)
            | Purpose::BudgetUnder(_)
            | Purpose::SectorTransfers(_)
            | Purpose::TruncatedSectorTransfers(..)
            | Purpose::TransferMatrix(_) => self.sectors_meaning(purpose),
            Purpose::Transverse(_)
            | Purpose::TransverseMotion(_)
            | Purpose::TransverseEnergy(_)
            | Purpose::TransverseTransfer(_)
            | Purpose::TransverseFriction(..) => self.transverse_meaning(purpose),
            Purpose::SmallAccelerations
            | Purpose::SmallAccelerationsUnder
            | Purpose::SmallEnergy => self.small_meaning(purpose),
            Purpose::Positions(_)
            | Purpose::PointVelocities(_)
            | Purpose::PointTorques(_)
            | Purpose::LinkProperties => self.positions_meaning(purpose),
            Purpose::Link(function) => vec![function.meaning().into()],
            Purpose::Scale(function) => vec![function.meaning().into()],
            Purpose::Body(function) => vec![function.meaning().into()],
            Purpose::RootGravity => vec!["Apparent gravity at the root's pivot over l.".into()],
        }
    }

    /// Meaning of an energy, or of its matrix of second derivatives.
    fn energy_meaning(&self, purpose: Purpose) -> Vec<String> {
        match purpose {
            Purpose::KineticEnergy => vec![format!("Kinetic energy K = ½ ωᵀ M(θ) ω (in J) at angles `theta` (in rad) and angular velocities `omega` (in rad/s).{}", self.frame_note())],
            Purpose::PotentialEnergy => {
                let zero = self.zero_of_potential();
                vec![format!("Potential energy U (in J) at angles `theta` (in rad), {zero}.")]
            }
            Purpose::MassMatrix => vec![
                "Mass matrix M(θ) (in kg m²) by rows, at angles `theta` (in rad); [`accelerations`](Self::accelerations) shows its elements. Zero between links of different branches.".into(),
                String::new(),
                "With K = [`stiffness_matrix`](Self::stiffness_matrix) at an equilibrium, linear modes v of frequency f (in Hz) solve K v = (2πf)² M v.".into(),
            ],
            Purpose::StiffnessMatrix => {
                vec!["Stiffness matrix ∂²U/∂θ∂θ (in J) by rows, at angles `theta` (in rad).".into()]
            }
            _ => Vec::new(),
        }
    }

    /// Meaning of a function of canonical variables, in absolute angles.
    fn canonical_meaning(&self, purpose: Purpose) -> Vec<String> {
        match purpose {
            Purpose::AbsoluteMomenta => {
                vec!["Generalized momenta p = M(θ) ω (in kg m²/s) of the absolute angles `theta` (in rad), at angular velocities `omega` (in rad/s).".into()]
            }
            Purpose::AbsoluteVelocities => {
                vec!["Angular velocities ω (in rad/s) at angles `theta` (in rad) and `momenta` p (in kg m²/s): solves M(θ) ω = p with M of [`accelerations`](Self::accelerations).".into()]
            }
            Purpose::CanonicalRates => vec![
                format!("Hamilton's equations: velocities ω = ∂H/∂p (in rad/s), and rates of the momenta {} (in N m), at {}angles `theta` (in rad) and `momenta` (in kg m²/s).", self.momentum_rates_in_words(), self.at_time()),
                String::new(),
                "For methods in canonical variables, as `integrate::Gauss` with `system::CanonicalVariables`.".into(),
            ],
            _ => Vec::new(),
        }
    }

    /// Meaning of what acts on the whole tree, or of its power.
    fn action_meaning(&self, purpose: Purpose) -> Vec<String> {
        match purpose {
            Purpose::Drive => vec![
                "The drive at `time` (in s): acceleration a_x, a_y (in m/s²) of the root's pivot, torque τ (in N m) on the root.".into(),
            ],
            Purpose::DrivePower => vec![
                "Power Σ Q_i ω_i (in W) of the drive on the whole tree at `time` (in s): dE/dt of E = K + U without friction.".into(),
            ],
            Purpose::TotalFrictionPower => {
                let power = match self.has_nonlinear_friction() {
                    true => "−2 R − Σ D w",
                    false => "−2 R",
                };
                let others = self.other_powers();
                vec![format!("Power {power} (in W) of friction and drag on the whole tree, never positive: dE/dt of E = K + U is this and {others}.")]
            }
            Purpose::RootDrive => {
                let sign = if self.scene.stands() { "" } else { "−" };
                vec![format!("What the drive adds to the apparent gravity at the root's pivot at `time` (in s), −a_x/l and {sign}a_y/l, and its torque τ/(m l²) on the root.")]
            }
            Purpose::OutsidePower => vec![
                "Power Q·ω (in W) of `torques` Q (in N m) from outside at angular velocities `omega` (in rad/s): dE/dt of E = K + U is this with the powers of friction and drive.".into(),
            ],
            _ => Vec::new(),
        }
    }
}

/// An argument with its unit, as docs name it; `None` where a function's meaning
/// says it all.
fn argument_meaning(argument: Argument) -> Option<&'static str> {
    match argument {
        Argument::Time => Some("`time` (in s)"),
        Argument::Theta => Some("angles `theta` (in rad)"),
        Argument::Omega => Some("angular velocities `omega` (in rad/s)"),
        Argument::Coordinates => Some("symmetric `coordinates` (in rad)"),
        Argument::Rates => Some("their `rates` (in rad/s)"),
        Argument::Alpha => Some("angular accelerations `alpha` (in rad/s²)"),
        Argument::Difference(_) | Argument::SmallDifferences => {
            Some("differences `difference` (in rad)")
        }
        Argument::DifferenceRate(_) | Argument::SmallRates => {
            Some("their rates `difference_rate` (in rad/s)")
        }
        Argument::AbsoluteMomenta | Argument::Momenta => Some("`momenta` (in kg m²/s)"),
        Argument::Torques => Some("`torques` (in N m)"),
        Argument::SmallTorques => Some("`difference_torques` (in N m)"),
        Argument::Prescribed(_) => Some("accelerations `prescribed` (in rad/s²)"),
        _ => None,
    }
}

pub(super) fn wrapped_names(names: &[&str]) -> String {
    const MOST: usize = 16;
    let listed: Vec<String> = names
        .iter()
        .take(MOST)
        .map(|name| format!("`{name}`"))
        .collect();
    let rest = names.len().saturating_sub(MOST);
    if rest > 0 {
        format!("{}, … ({rest} more).", listed.join(", "))
    } else {
        format!("{}.", listed.join(", "))
    }
}
