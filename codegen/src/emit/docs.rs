//! Rustdoc of the emitted items: meaning, units, formulas, cost, source.

use super::Emission;
use super::doc_text::doc_lines;
use crate::functions::{Argument, Cause, Counting, EntryState, Purpose};
use crate::mechanics::superscript;
use crate::program::{Entry, Rounding};
use crate::scene::{CoordinateKind, Reduction, Solve};
use proc_macro2::TokenStream;

/// Meaning of w in formulas of transfers.
const IN_PHASE: &str = "In the formulas w are the angular velocities (in rad/s) of the in-phase motion: those that belong to the in-phase momenta where all differences vanish.";

impl Emission<'_> {
    /// Returns true if a spring is at rest beside its parent's line.
    pub(super) fn has_rest_angles(&self) -> bool {
        let mut links = self.scene.links.iter();
        links.any(|link| !link.passive.rest.is_zero())
    }

    /// The state of potential energy zero, for docs.
    pub(super) fn zero_of_potential(&self) -> &'static str {
        match self.has_rest_angles() {
            true => {
                "that of gravity zero where all are zero, that of springs where they are at rest"
            }
            false => "zero where all are zero",
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

    /// Exchanging two copies turns the sign of their difference, which leaves no
    /// odd orders; between more copies there are cubic terms.
    fn remainder(&self, transfer: usize) -> &'static str {
        let coordinate = self.mechanics.transfers[transfer].coordinate;
        match self.mechanics.coordinates[coordinate].kind {
            CoordinateKind::Difference { group, .. }
                if self.scene.groups[group].copies.len() > 2 =>
            {
                "Remainder O(ε³)."
            }
            _ => "Remainder O(ε⁴).",
        }
    }

    pub(super) fn meaning(&self, purpose: Purpose) -> Vec<String> {
        let difference = |number: usize| {
            let coordinate = self.mechanics.transfers[number].coordinate;
            self.mechanics.coordinates[coordinate].name.clone()
        };
        let lines: Vec<String> = match purpose {
            Purpose::AccelerationsUnder => vec![
                format!("Angular accelerations (in rad/s²) as [`accelerations`](Self::accelerations), with generalized `torques` Q (in N m) from outside: M(θ) θ̈ + b(θ, ω{}) = Q. Q_i is a couple on link i; forces have those of `centre_torques` and its like (`emit(positions)`).", self.and_time()),
                String::new(),
                "The power of the torques is Q·ω. In canonical variables they add to the rates of the momenta.".into(),
            ],
            Purpose::Prescribed(set) => self.prescribed_meaning(set),
            Purpose::OutsidePower => vec![
                "Power Q·ω (in W) of `torques` Q (in N m) from outside at angular velocities `omega` (in rad/s): dE/dt of E = K + U is this with the powers of friction and drive.".into(),
            ],
            Purpose::AntiphaseOutsidePower(n, _) => vec![
                format!("Power Σ ∂H_d/∂p Q (in W) of `torques` Q (in N m) from outside, on each link, on H_d of `{}`.", difference(n)),
            ],
            Purpose::Accelerations => vec![
                format!("Angular accelerations (in rad/s²) at {}angles `theta` (in rad) and angular velocities `omega` (in rad/s).", self.at_time()),
                String::new(),
                format!("Solves the Euler–Lagrange equations M(θ) θ̈ + b(θ, ω{}) = 0 by {}.", self.and_time(), match self.program.choice.solve {
                    Solve::Factorization => "elimination along the tree (Featherstone, Rigid Body Dynamics Algorithms, 2008, §6.5)",
                    Solve::Recursion => "articulated recursion, from the leaves to the root and back (Featherstone, Rigid Body Dynamics Algorithms, 2008, chapter 7), in O(n) operations",
                }),
            ],
            Purpose::TaylorCoefficients => vec![
                format!("Taylor coefficients of the motion that passes through the angles `theta` (in rad) with the angular velocities `omega` (in rad/s){}.", match self.mechanics.drive {
                    Some(_) => " at `time` (in s)",
                    None => "",
                }),
                String::new(),
                "Row k of `coefficients` gets `θ[k]` (in rad/sᵏ), then `ω[k]` (in rad/sᵏ⁺¹), of `θ(t₀+τ) = Σ θ[k] τᵏ`: as many orders as there are rows. They are formed in `work`, of any content: `TaylorPendulum::taylor_workspace` of the highest order; if there is less, all coefficients are NaN.".into(),
                String::new(),
                "With the angles θ₀ at the start, γ + iσ = e^(i(θ−θ₀)) and C + iS its second derivative, the force times its lever on each link, across and along the link at the start, is X and Y, linear in the C and S of all links (Jorba and Zou, Experimental Mathematics 14 (2005) 99, proposition 2.1, for the sums over j):".into(),
                String::new(),
                "```text".into(),
                "θ[k+1] = ω[k] / (k+1),  ω[k+1] = α[k] / (k+1)".into(),
                "C[k] = −(k+1) Σ ω[j] σ[k+1−j],  S[k] = (k+1) Σ ω[j] γ[k+1−j] with α[k] for (k+1) ω[k+1]".into(),
                "γ X − σ Y + … = 0".into(),
                "```".into(),
                String::new(),
                "S and Y follow from X and C by one pass along the tree, from the leaves to the root, and one back, with factors formed once. See `branched_pendulum::taylor`.".into(),
            ],
            Purpose::KineticEnergy => vec![format!("Kinetic energy K = ½ ωᵀ M(θ) ω (in J) at angles `theta` (in rad) and angular velocities `omega` (in rad/s).{}", self.frame_note())],
            Purpose::PotentialEnergy => {
                let zero = self.zero_of_potential();
                vec![format!("Potential energy U (in J) at angles `theta` (in rad), {zero}.")]
            }
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
            Purpose::MassMatrix => vec![
                "Mass matrix M(θ) (in kg m²) by rows, at angles `theta` (in rad); [`accelerations`](Self::accelerations) shows its elements. Zero between links of different branches.".into(),
                String::new(),
                "With K = [`stiffness_matrix`](Self::stiffness_matrix) at an equilibrium, linear modes v of frequency f (in Hz) solve K v = (2πf)² M v.".into(),
            ],
            Purpose::StiffnessMatrix => {
                vec!["Stiffness matrix ∂²U/∂θ∂θ (in J) by rows, at angles `theta` (in rad).".into()]
            }
            Purpose::ToSymmetric => vec![
                "Symmetric coordinates of absolute angles (in rad), or their velocities of angular velocities (in rad/s): means and differences of copies.".into(),
            ],
            Purpose::FromSymmetric => vec![
                "Absolute angles of symmetric coordinates (in rad), or angular velocities of their velocities (in rad/s).".into(),
            ],
            Purpose::SymmetricAccelerations => vec![
                format!("Second time derivatives (in rad/s²) of the symmetric coordinates at {}`coordinates` (in rad) and `rates` (in rad/s).", self.at_time()),
                String::new(),
                format!("Solves M̃(q) q̈ + b̃(q, q̇{}) = 0. A difference that is zero with its rate stays exactly zero.{}", self.and_time(), self.braking_note()),
            ],
            Purpose::SymmetricMomenta => {
                vec!["Generalized momenta p = M̃(q) q̇ (in kg m²/s) at symmetric `coordinates` (in rad) and their `rates` (in rad/s) (Toda and Ooshida, Eq. 10).".into()]
            }
            Purpose::SymmetricVelocities => {
                vec!["Velocities q̇ (in rad/s) of the symmetric `coordinates` (in rad) at `momenta` p (in kg m²/s): solves M̃(q) q̇ = p with M̃ of [`symmetric_accelerations`](Self::symmetric_accelerations).".into()]
            }
            Purpose::Hamiltonian => {
                vec!["Energy H = ½ pᵀ M̃⁻¹ p + U (in J) at symmetric `coordinates` (in rad) and `momenta` (in kg m²/s), with M̃ of [`symmetric_accelerations`](Self::symmetric_accelerations).".into()]
            }
            Purpose::SubHamiltonian(n) => vec![
                format!("Energy H_d (in J) of the antiphase coordinate `{}` by itself: the sub-Hamiltonian whose growth W explains (Toda and Ooshida, Eq. 12; for more than two copies, Parseval's share of the potential energy).{}", difference(n), match self.mechanics.mean_tree {
                    Some(_) => " Its constants are the means of those of the copies.",
                    None => "",
                }),
            ],
            Purpose::TruncatedTransfer(n, Counting::Angle, 1) => vec![
                format!("Energy transfer W (in W) into `{}` to first order in the difference angles, momenta untouched: W_K and W_P as published (Toda and Ooshida, Eqs. 16b and 16c).", difference(n)),
                String::new(),
                "Of first order in the angles only: for an oscillation, where momenta are as small as angles, two of four terms of the leading order are missing; `transfer_amplitude_2` has all four. Remainder O(θ_d) in W_K, O(θ_d³) in W_P.".into(),
                String::new(),
                IN_PHASE.into(),
            ],
            Purpose::TruncatedTransfer(n, Counting::Amplitude, 2) => vec![
                format!("Energy transfer W (in W) into `{}` to second order in the amplitude of the differences: the complete quadratic form in them and their momenta. {}", difference(n), self.remainder(n)),
                String::new(),
                format!("ε scales the differences and their momenta. {IN_PHASE}"),
            ],
            Purpose::TruncatedTransfer(n, counting, order) => {
                let (what, remainder) = match counting {
                    Counting::Angle => (
                        "the difference angles, momenta untouched",
                        "It grows with the momenta of the differences, which are not counted as small.".to_owned(),
                    ),
                    // Between two copies only even orders occur.
                    Counting::Amplitude => (
                        "the amplitude of the differences, angles and momenta alike",
                        format!("Remainder O(ε{}), at pairs one order better.", superscript(order + 1)),
                    ),
                };
                vec![
                    format!("Energy transfer W (in W) into `{}` through order {order} in {what}. {remainder}", difference(n)),
                    String::new(),
                    "`cargo branched-pendulum stage mechanics` shows the formulas.".into(),
                ]
            }
            Purpose::QuadraticForm(n) => vec![
                format!("Coefficients a_pp, a_pq, a_qq of the quadratic form W ≈ a_pp p² + a_pq p θ + a_qq θ² for `{}`, at the in-phase state given; the difference's own coordinate and momentum are not read.", difference(n)),
                String::new(),
                IN_PHASE.into(),
            ],
            Purpose::ExactTransfer(n, EntryState::Momenta(_)) => vec![
                format!("Energy transfer W = dH_d/dt (in W) into `{}` without truncation, from coordinates and momenta: the velocities are solved for, no inverse is expanded. Conservative part; {}.", difference(n), self.on_top()),
            ],
            Purpose::ExactTransfer(n, _) => vec![
                format!("Energy transfer W = dH_d/dt (in W) into `{}` without truncation, from coordinates and their velocities, as an experiment measures them. Conservative part; {}.", difference(n), self.on_top()),
            ],
            Purpose::SplitTransfer(n, cause, _) => {
                let name = difference(n);
                let what = match cause {
                    Cause::MeanTree => format!("Growth: the part of the energy transfer W (in W) into `{name}` that equal copies with the mean constants would have at the same coordinates and momenta, {{H_d, H₀}}. Quadratic in the differences at leading order."),
                    Cause::Mismatch => format!("Forcing: the part of the energy transfer W (in W) into `{name}` that the mismatch of the copies adds, {{H_d, H − H₀}} with the Hamiltonian H₀ of equal copies that have the mean constants. Linear in the differences and in the mismatch at leading order; growth and forcing sum to W. In the formulas u are the velocities (in rad/s) that the mismatch adds, M̃₀ u = −(M̃ − M̃₀) q̇ with the mass matrices of H and H₀."),
                };
                vec![what]
            }
            Purpose::Observable(n, form) => self.observable_meaning(n, form),
            Purpose::AntiphaseFrictionPower(n, state) => vec![
                format!("Power (in W) of friction and drag on H_d of `{}`{}.", difference(n), match state {
                    EntryState::Momenta(_) => ", from coordinates and momenta: the velocities are solved for",
                    EntryState::Absolute | EntryState::Rates => "",
                }),
            ],
            Purpose::Budget(definition, _) => self.budget_meaning(definition, "friction and drive"),
            Purpose::BudgetUnder(definition) => {
                self.budget_meaning(definition, "friction, drive and the `torques` from outside")
            }
            Purpose::SectorTransfers(_) => self.sector_transfers_meaning(None),
            Purpose::TruncatedSectorTransfers(counting, order) => {
                self.sector_transfers_meaning(Some((counting, order)))
            }
            Purpose::TransferMatrix(_) => self.matrix_meaning(),
            Purpose::AntiphaseDrivePower(n, _) => vec![
                format!("Power Σ ∂H_d/∂p Q (in W) of the drive on H_d of `{}` at `time` (in s), by the inertial forces of the moving pivot; a torque on the root has none.", difference(n)),
            ],
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
            Purpose::RootDrive => {
                let sign = if self.scene.stands() { "" } else { "−" };
                vec![format!("What the drive adds to the apparent gravity at the root's pivot at `time` (in s), −a_x/l and {sign}a_y/l, and its torque τ/(m l²) on the root.")]
            }
        };
        lines
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
