//! Meanings of functions of motion, of symmetric coordinates, and of H_d and W, as their docs
//! begin.

use super::Emission;
use crate::functions::{Cause, Counting, EntryState, Purpose};
use crate::mechanics::superscript;
use crate::scene::{CoordinateKind, Solve};

/// Meaning of w in formulas of transfers.
const IN_PHASE: &str = "In the formulas w are the angular velocities (in rad/s) of the in-phase motion: those that belong to the in-phase momenta where all differences vanish.";

impl Emission<'_> {
    /// Meaning of a function of motion in absolute angles.
    pub(super) fn motion_meaning(&self, purpose: Purpose) -> Vec<String> {
        match purpose {
            Purpose::AccelerationsUnder => vec![
                format!("Angular accelerations (in rad/s²) as [`accelerations`](Self::accelerations), with generalized `torques` Q (in N m) from outside: M(θ) θ̈ + b(θ, ω{}) = Q. Q_i is a couple on link i; forces have those of `centre_torques` and its like (`emit(positions)`).", self.and_time()),
                String::new(),
                "The power of the torques is Q·ω. In canonical variables they add to the rates of the momenta.".into(),
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
            _ => Vec::new(),
        }
    }

    /// Meaning of a function of symmetric coordinates.
    pub(super) fn symmetric_meaning(&self, purpose: Purpose) -> Vec<String> {
        match purpose {
            Purpose::ToSymmetric => vec![
                "Symmetric coordinates of absolute angles (in rad), or their velocities of angular velocities (in rad/s): means and differences of copies.".into(),
            ],
            Purpose::FromSymmetric => vec![
                "Absolute angles of symmetric coordinates (in rad), or angular velocities of their velocities (in rad/s).".into(),
            ],
            Purpose::SymmetricAccelerations => vec![
                format!("Second time derivatives (in rad/s²) of the symmetric coordinates at {}`coordinates` (in rad) and `rates` (in rad/s).", self.at_time()),
                String::new(),
                format!("Solves M̃(q) q̈ + b̃(q, q̇{}) = 0. {}{}", self.and_time(), self.fate_of_differences(), self.braking_note()),
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
            _ => Vec::new(),
        }
    }

    /// Meaning of a function of H_d or W, or of a power on H_d.
    pub(super) fn transfer_meaning(&self, purpose: Purpose) -> Vec<String> {
        let difference = |number: usize| self.difference_of_transfer(number);
        match purpose {
            Purpose::SubHamiltonian(n) => vec![format!(
                "Energy H_d (in J) of the antiphase coordinate `{}` by itself: the sub-Hamiltonian whose growth W explains (Toda and Ooshida, Eq. 12; for more than two copies, Parseval's share of the potential energy).{}",
                difference(n),
                match self.mechanics.mean_tree {
                    Some(_) => " Its constants are the means of those of the copies.",
                    None => "",
                }
            )],
            Purpose::TruncatedTransfer(n, counting, order) => {
                self.truncation_meaning(n, counting, order)
            }
            Purpose::QuadraticForm(n) => vec![
                format!(
                    "Coefficients a_pp, a_pq, a_qq of the quadratic form W ≈ a_pp p² + a_pq p θ + a_qq θ² for `{}`, at the in-phase state given; the difference's own coordinate and momentum are not read.",
                    difference(n)
                ),
                String::new(),
                IN_PHASE.into(),
            ],
            Purpose::ExactTransfer(n, EntryState::Momenta(_)) => vec![format!(
                "Energy transfer W = dH_d/dt (in W) into `{}` without truncation, from coordinates and momenta: the velocities are solved for, no inverse is expanded. Conservative part; {}.",
                difference(n),
                self.on_top()
            )],
            Purpose::ExactTransfer(n, _) => vec![format!(
                "Energy transfer W = dH_d/dt (in W) into `{}` without truncation, from coordinates and their velocities, as an experiment measures them. Conservative part; {}.",
                difference(n),
                self.on_top()
            )],
            Purpose::SplitTransfer(n, cause, _) => {
                let name = difference(n);
                let what = match cause {
                    Cause::MeanTree => format!(
                        "Growth: the part of the energy transfer W (in W) into `{name}` that equal copies with the mean constants would have at the same coordinates and momenta, {{H_d, H₀}}. Quadratic in the differences at leading order."
                    ),
                    Cause::Mismatch => format!(
                        "Forcing: the part of the energy transfer W (in W) into `{name}` that the mismatch of the copies adds, {{H_d, H − H₀}} with the Hamiltonian H₀ of equal copies that have the mean constants. Linear in the differences and in the mismatch at leading order; growth and forcing sum to W. In the formulas u are the velocities (in rad/s) that the mismatch adds, M̃₀ u = −(M̃ − M̃₀) q̇ with the mass matrices of H and H₀."
                    ),
                };
                vec![what]
            }
            Purpose::AntiphaseFrictionPower(..)
            | Purpose::AntiphaseDrivePower(..)
            | Purpose::AntiphaseOutsidePower(..) => self.antiphase_power_meaning(purpose),
            _ => Vec::new(),
        }
    }

    /// Meaning of a power on H_d.
    fn antiphase_power_meaning(&self, purpose: Purpose) -> Vec<String> {
        let difference = |number: usize| self.difference_of_transfer(number);
        match purpose {
            Purpose::AntiphaseFrictionPower(n, state) => vec![format!(
                "Power (in W) of friction and drag on H_d of `{}`{}.",
                difference(n),
                match state {
                    EntryState::Momenta(_) =>
                        ", from coordinates and momenta: the velocities are solved for",
                    EntryState::Absolute | EntryState::Rates => "",
                }
            )],
            Purpose::AntiphaseDrivePower(n, _) => vec![format!(
                "Power Σ ∂H_d/∂p Q (in W) of the drive on H_d of `{}` at `time` (in s), by the inertial forces of the moving pivot; a torque on the root has none.",
                difference(n)
            )],
            Purpose::AntiphaseOutsidePower(n, _) => vec![format!(
                "Power Σ ∂H_d/∂p Q (in W) of `torques` Q (in N m) from outside, on each link, on H_d of `{}`.",
                difference(n)
            )],
            _ => Vec::new(),
        }
    }

    /// Meaning of a truncated W.
    fn truncation_meaning(&self, n: usize, counting: Counting, order: u32) -> Vec<String> {
        let difference = self.difference_of_transfer(n);
        match (counting, order) {
            (Counting::Angle, 1) => vec![
                format!("Energy transfer W (in W) into `{}` to first order in the difference angles, momenta untouched: W_K and W_P as published (Toda and Ooshida, Eqs. 16b and 16c).", difference),
                String::new(),
                "Of first order in the angles only: for an oscillation, where momenta are as small as angles, two of four terms of the leading order are missing; `transfer_amplitude_2` has all four. Remainder O(θ_d) in W_K, O(θ_d³) in W_P.".into(),
                String::new(),
                IN_PHASE.into(),
            ],
            (Counting::Amplitude, 2) => vec![
                format!("Energy transfer W (in W) into `{}` to second order in the amplitude of the differences: the complete quadratic form in them and their momenta. {}", difference, self.remainder(n)),
                String::new(),
                format!("ε scales the differences and their momenta. {IN_PHASE}"),
            ],
            _ => {
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
                    format!("Energy transfer W (in W) into `{}` through order {order} in {what}. {remainder}", difference),
                    String::new(),
                    "`cargo branched-pendulum stage mechanics` shows the formulas.".into(),
                ]
            }
        }
    }

    /// The name of the difference that a transfer goes into.
    fn difference_of_transfer(&self, number: usize) -> &str {
        let coordinate = self.mechanics.transfers[number].coordinate;
        &self.mechanics.coordinates[coordinate].name
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
}
