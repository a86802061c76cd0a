//! Docs of the emitted items: meaning, units, formulas, cost, source.

use super::Emission;
use super::doc_text::doc_lines;
use crate::functions::{Argument, Purpose};
use crate::program::{Entry, Rounding};
use crate::scene::{DescribedLinePotential, Reduction, Solve};
use proc_macro2::TokenStream;

impl Emission<'_> {
    /// Returns true if some spring has a rest angle other than zero, or a rest length.
    pub(super) fn has_rest_angles(&self) -> bool {
        let mut torques = self.scene.passive_torques();
        torques.any(|torques| !torques.rest.is_zero()) || !self.scene.translational.is_empty()
    }

    /// Describes the state in which the potential energy is zero.
    pub(super) fn zero_of_potential(&self) -> &'static str {
        let mut stored = self
            .scene
            .translational
            .iter()
            .flat_map(|own| &own.potentials);
        let repels = stored.any(|own| matches!(own, DescribedLinePotential::InversePower { .. }));
        match (self.has_rest_angles(), repels) {
            (_, true) => {
                "with gravity's part zero if all are zero, the springs' part zero if they are relaxed, \
                 and the repulsions' part zero at infinite distances"
            }
            (true, false) => {
                "with gravity's part zero if all are zero, and the springs' part zero if they are relaxed"
            }
            (false, false) => "zero if all are zero",
        }
    }

    /// Returns the docs of the model, which follow the docs that its author wrote on the struct.
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
            lines.push(format!("The model describes a motion of a tree of {links} links: `WHOLE` contains which of them move together, and their angles."));
        }
        if self.mechanics.drive.is_some() {
            lines.extend(self.drive_docs());
            self.show(&self.drive_formulas(), &mut lines);
        }
        if !scene.requests.energies && scene.requests.transfer.is_none() {
            lines.push(String::new());
            lines
                .push("Further functions can be requested with `emit(…)` in the attribute.".into());
        }
        lines.extend(self.example());
        lines
    }

    pub(super) fn entry_docs(&self, entry: &Entry) -> TokenStream {
        let mut lines = self.meaning(entry.purpose);
        let reported = lines.concat();
        let untold: Vec<&str> = entry
            .arguments
            .iter()
            .filter(|argument| !reported.contains(&format!("`{}`", argument.name())))
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
            count => format!("; {count} of the ± can be fused with a × if the scalar supports it"),
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
            Purpose::Accelerations => self.accelerations_meaning(),
            Purpose::AccelerationsUnder => self.accelerations_under_meaning(),
            Purpose::InverseDynamics => vec![
                format!("Generalized torques Q (in N m) that give the links the angular accelerations `alpha` (in rad/s²), in addition to gravity, springs, friction and drive: Q = M(θ) θ̈ + b(θ, ω{}). With these torques [`accelerations_under`](Self::accelerations_under) returns `alpha`; in a free motion they are zero.", self.and_time()),
                String::new(),
                "Their power is Q·ω. The cost is O(links) if that of the accelerations is (Featherstone, Rigid Body Dynamics Algorithms, 2008, chapter 5).".into(),
            ],
            Purpose::AccelerationsPullback => self.pullback_meaning(Purpose::Accelerations),
            Purpose::AccelerationsUnderPullback => self.pullback_meaning(Purpose::AccelerationsUnder),
            Purpose::Gradient(of) => self.gradient_meaning(of),
            Purpose::TaylorCoefficients => self.taylor_meaning(),
            Purpose::ToSymmetric => fixed([
                "Converts absolute angles (in rad) to symmetric coordinates (means and differences of copies), or angular velocities (in rad/s) to their velocities.",
            ]),
            Purpose::FromSymmetric => fixed([
                "Converts symmetric coordinates (in rad) to absolute angles, or their velocities (in rad/s) to angular velocities.",
            ]),
            Purpose::SymmetricAccelerations => self.symmetric_accelerations_meaning(),
            Purpose::SymmetricMomenta => fixed([
                "Generalized momenta p = M̃(q) q̇ (in kg m²/s) at symmetric `coordinates` (in rad) and their `rates` (in rad/s) (Toda and Ooshida, Eq. 10).",
            ]),
            Purpose::SymmetricVelocities => fixed([
                "Velocities q̇ (in rad/s) of the symmetric `coordinates` (in rad) at `momenta` p (in kg m²/s): solves M̃(q) q̇ = p with M̃ of [`symmetric_accelerations`](Self::symmetric_accelerations).",
            ]),
            Purpose::Hamiltonian => fixed([
                "Energy H = ½ pᵀ M̃⁻¹ p + U (in J) at symmetric `coordinates` (in rad) and `momenta` (in kg m²/s), with M̃ of [`symmetric_accelerations`](Self::symmetric_accelerations).",
            ]),
            Purpose::SubHamiltonian(transfer) => self.antiphase_energy_meaning(transfer),
            Purpose::TruncatedTransfer(transfer, counting, order) => {
                self.truncation_meaning(transfer, counting, order)
            }
            Purpose::QuadraticForm(transfer) => self.quadratic_form_meaning(transfer),
            Purpose::ExactTransfer(transfer, state) => self.exact_transfer_meaning(transfer, state),
            Purpose::SplitTransfer(transfer, cause, _) => {
                self.split_transfer_meaning(transfer, cause)
            }
            Purpose::AntiphaseFrictionPower(transfer, state) => {
                self.antiphase_friction_meaning(transfer, state)
            }
            Purpose::AntiphaseDrivePower(transfer, _) => self.antiphase_drive_meaning(transfer),
            Purpose::AntiphaseOutsidePower(transfer, _) => self.antiphase_outside_meaning(transfer),
            Purpose::KineticEnergy => self.kinetic_energy_meaning(),
            Purpose::PotentialEnergy => self.potential_energy_meaning(),
            Purpose::MassMatrix => fixed(MASS_MATRIX),
            Purpose::StiffnessMatrix => {
                fixed(["Stiffness matrix ∂²U/∂θ∂θ (in J) by rows, at angles `theta` (in rad)."])
            }
            Purpose::AbsoluteMomenta => fixed([
                "Generalized momenta p = M(θ) ω (in kg m²/s) of the absolute angles `theta` (in rad), at angular velocities `omega` (in rad/s).",
            ]),
            Purpose::AbsoluteVelocities => fixed([
                "Angular velocities ω (in rad/s) at angles `theta` (in rad) and `momenta` p (in kg m²/s): solves M(θ) ω = p with M of [`accelerations`](Self::accelerations).",
            ]),
            Purpose::CanonicalRates => self.canonical_rates_meaning(),
            Purpose::Drive => fixed([
                "The drive at `time` (in s): acceleration a_x, a_y (in m/s²) of the root's pivot, torque τ (in N m) on the root.",
            ]),
            Purpose::RootDrive => self.root_drive_meaning(),
            Purpose::DrivePullback => fixed([
                "Derivatives by the parameters of a sum of the components a_x, a_y and τ of [`drive`](Self::drive) at `time` (in s), each multiplied by its number in `given`.",
            ]),
            Purpose::DrivePower => fixed([
                "Power Σ Q_i ω_i (in W) of the drive on the whole tree at `time` (in s): dE/dt of E = K + U without friction.",
            ]),
            Purpose::OutsidePower => fixed([
                "Power Q·ω (in W) of external `torques` Q (in N m) at angular velocities `omega` (in rad/s). The rate dE/dt of E = K + U is the sum of this power and the powers of friction and drive.",
            ]),
            Purpose::TotalFrictionPower => self.friction_power_meaning(),
            Purpose::Prescribed(set) => self.prescribed_meaning(set),
            Purpose::Observable(n, form) => self.observable_meaning(n, form),
            Purpose::Budget(definition, _) => self.budget_meaning(definition, "friction and drive"),
            Purpose::BudgetUnder(definition) => {
                self.budget_meaning(definition, "friction, drive and external `torques`")
            }
            Purpose::SectorTransfers(_) => self.sector_transfers_meaning(None),
            Purpose::TruncatedSectorTransfers(counting, order) => {
                self.sector_transfers_meaning(Some((counting, order)))
            }
            Purpose::TransferMatrix(_) => self.matrix_meaning(),
            Purpose::Transverse(sector) => self.transverse_meaning(sector),
            Purpose::TransverseMotion(sector) => self.transverse_motion_meaning(sector),
            Purpose::TransverseEnergy(sector) => self.transverse_energy_meaning(sector),
            Purpose::TransverseTransfer(sector) => self.transverse_transfer_meaning(sector),
            Purpose::TransverseFriction(..) => {
                fixed(["Power (in W) of friction and drag on the energy of small differences."])
            }
            Purpose::SmallAccelerations => self.small_accelerations_meaning(),
            Purpose::SmallAccelerationsUnder => fixed(super::small::UNDER_TORQUES),
            Purpose::SmallEnergy => self.small_energy_meaning(),
            Purpose::NormalForm(function) => self.normal_form_meaning(function),
            Purpose::Positions(kind) => self.point_positions_meaning(kind),
            Purpose::PointVelocities(kind) => self.point_velocities_meaning(kind),
            Purpose::PointTorques(kind) => self.point_torques_meaning(kind),
            Purpose::LinkProperties => super::positions::link_properties_meaning(),
            Purpose::Link(function) => fixed([function.meaning()]),
            Purpose::Scale(function) => fixed([function.meaning()]),
            Purpose::Body(function) => fixed([function.meaning()]),
            Purpose::RootGravity => fixed(["Apparent gravity at the root's pivot, divided by l."]),
        }
    }

    /// Returns the documentation of the kinetic energy.
    fn kinetic_energy_meaning(&self) -> Vec<String> {
        vec![format!(
            "Kinetic energy K = ½ ωᵀ M(θ) ω (in J) at angles `theta` (in rad) and angular velocities `omega` (in rad/s).{}",
            self.frame_note()
        )]
    }

    /// Returns the documentation of the potential energy.
    fn potential_energy_meaning(&self) -> Vec<String> {
        let zero = self.zero_of_potential();
        vec![format!(
            "Potential energy U (in J) at angles `theta` (in rad), {zero}."
        )]
    }

    /// Returns the documentation of Hamilton's equations in absolute angles.
    fn canonical_rates_meaning(&self) -> Vec<String> {
        vec![
            format!("Hamilton's equations: velocities ω = ∂H/∂p (in rad/s), and rates of the momenta {} (in N m), at {}angles `theta` (in rad) and `momenta` (in kg m²/s).", self.momentum_rates_in_words(), self.at_time()),
            String::new(),
            "For methods in canonical variables, such as `integrate::Gauss` with `system::CanonicalVariables`.".into(),
        ]
    }

    /// Returns the documentation of the power of friction and drag on the whole tree.
    fn friction_power_meaning(&self) -> Vec<String> {
        let power = match self.has_nonlinear_friction() {
            true => "−2 R − Σ D w",
            false => "−2 R",
        };
        let others = self.other_powers();
        vec![format!(
            "Power {power} (in W) of friction and drag on the whole tree, never positive. The rate dE/dt of E = K + U is the sum of this power and {others}."
        )]
    }

    /// Returns the documentation of the drive's part of the root's apparent gravity, in a tree in
    /// loops.
    fn root_drive_meaning(&self) -> Vec<String> {
        let sign = if self.scene.stands() { "" } else { "−" };
        vec![format!(
            "Contribution of the drive to the apparent gravity at the root's pivot at `time` (in s), −a_x/l and {sign}a_y/l, and torque τ/(m l²) of the drive on the root."
        )]
    }
}

/// Documentation of the mass matrix.
const MASS_MATRIX: [&str; 3] = [
    "Mass matrix M(θ) (in kg m²) by rows, at angles `theta` (in rad); [`accelerations`](Self::accelerations) shows its elements. Zero between links of different branches.",
    "",
    "With K = [`stiffness_matrix`](Self::stiffness_matrix) at an equilibrium, linear modes v of frequency f (in Hz) solve K v = (2πf)² M v.",
];

/// Converts fixed lines of documentation to strings.
fn fixed<const N: usize>(lines: [&str; N]) -> Vec<String> {
    lines.map(str::to_owned).to_vec()
}

/// Describes an argument with its unit; returns `None` if the docs of the functions describe it
/// themselves.
fn argument_meaning(argument: Argument) -> Option<&'static str> {
    match argument {
        Argument::Time => Some("`time` (in s)"),
        Argument::Theta => Some("angles `theta` (in rad)"),
        Argument::Omega => Some("angular velocities `omega` (in rad/s)"),
        Argument::Coordinates => Some("symmetric `coordinates` (in rad)"),
        Argument::Rates => Some("their `rates` (in rad/s)"),
        Argument::Alpha => Some("angular accelerations `alpha` (in rad/s²)"),
        Argument::Actions => Some("`actions` (in J s)"),
        Argument::Difference(_) | Argument::SmallDifferences => {
            Some("differences `difference` (in rad)")
        }
        Argument::DifferenceRate(_) | Argument::SmallRates => {
            Some("their rates `difference_rate` (in rad/s)")
        }
        Argument::AbsoluteMomenta | Argument::Momenta => Some("`momenta` (in kg m²/s)"),
        Argument::Torques => Some("`torques` (in N m)"),
        Argument::SmallTorques => Some("`difference_torques` (in N m)"),
        Argument::Weights => Some("`weights`"),
        Argument::Prescribed(_) => Some("accelerations `prescribed` (in rad/s²)"),
        Argument::Forces
        | Argument::Absolute
        | Argument::Symmetric
        | Argument::Constants
        | Argument::Body
        | Argument::Motion
        | Argument::Response
        | Argument::Sums
        | Argument::Elimination
        | Argument::Carried
        | Argument::Pivot
        | Argument::Given(_) => None,
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
