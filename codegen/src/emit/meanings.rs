//! First sentences of the docs of functions of motion, of symmetric coordinates, and of H_d (energy
//! of a difference) and W (transfer into it).

use super::Emission;
use crate::functions::{Cause, Counting, EntryState};
use crate::mechanics::superscript;
use crate::scene::{CoordinateKind, Solve};

/// Explanation of w in formulas of transfers.
const IN_PHASE: &str = "In the formulas w are the angular velocities (in rad/s) of the in-phase motion: those that belong to the in-phase momenta where all differences vanish.";

impl Emission<'_> {
    /// Returns the documentation of the accelerations of free motion.
    pub(super) fn accelerations_meaning(&self) -> Vec<String> {
        vec![
            format!(
                "Angular accelerations (in rad/s²) at {}angles `theta` (in rad) and angular velocities `omega` (in rad/s).",
                self.at_time()
            ),
            String::new(),
            format!(
                "Solves the Euler–Lagrange equations M(θ) θ̈ + b(θ, ω{}) = 0 by {}.",
                self.and_time(),
                match self.program.choice.solve {
                    Solve::Factorization =>
                        "elimination along the tree (Featherstone, Rigid Body Dynamics Algorithms, 2008, §6.5)",
                    Solve::Recursion =>
                        "articulated recursion, from the leaves to the root and back (Featherstone, Rigid Body Dynamics Algorithms, 2008, chapter 7), in O(n) operations",
                }
            ),
        ]
    }

    /// Returns the documentation of the accelerations under torques.
    pub(super) fn accelerations_under_meaning(&self) -> Vec<String> {
        vec![
                format!("Angular accelerations (in rad/s²) like [`accelerations`](Self::accelerations), but under external generalized `torques` Q (in N m): M(θ) θ̈ + b(θ, ω{}) = Q. Q_i is a couple on link i; `centre_torques` and similar functions (`emit(positions)`) return the torques of forces.", self.and_time()),
                String::new(),
                "The power of the torques is Q·ω. In canonical variables they add to the rates of the momenta.".into(),
            ]
    }

    /// Returns the documentation of the Taylor coefficients.
    pub(super) fn taylor_meaning(&self) -> Vec<String> {
        vec![
                format!("Taylor coefficients of the motion that passes through the angles `theta` (in rad) with the angular velocities `omega` (in rad/s){}.", match self.mechanics.drive {
                    Some(_) => " at `time` (in s)",
                    None => "",
                }),
                String::new(),
                "Row k of `coefficients` receives `θ[k]` (in rad/sᵏ), then `ω[k]` (in rad/sᵏ⁺¹), of `θ(t₀+τ) = Σ θ[k] τᵏ`: as many orders as there are rows. `work` is a buffer with arbitrary contents, of the length that `TaylorPendulum::taylor_workspace` returns for the highest order; if it is shorter, all coefficients are NaN.".into(),
                String::new(),
                "Let θ₀ be the angles at the start, γ + iσ = e^(i(θ−θ₀)), and C + iS its second derivative. X and Y are the force on each link times its lever, across and along the link at the start; they are linear in the C and S of all links. For the sums over j see Jorba and Zou, Experimental Mathematics 14 (2005) 99, proposition 2.1.".into(),
                String::new(),
                "```text".into(),
                "θ[k+1] = ω[k] / (k+1),  ω[k+1] = α[k] / (k+1)".into(),
                "C[k] = −(k+1) Σ ω[j] σ[k+1−j],  S[k] = (k+1) Σ ω[j] γ[k+1−j] with α[k] for (k+1) ω[k+1]".into(),
                "γ X − σ Y + … = 0".into(),
                "```".into(),
                String::new(),
                "S and Y follow from X and C by one pass along the tree, from the leaves to the root, and one back; the factors of these passes are computed only once. See `branched_pendulum::taylor`.".into(),
            ]
    }

    /// Returns the documentation of the accelerations in symmetric coordinates.
    pub(super) fn symmetric_accelerations_meaning(&self) -> Vec<String> {
        vec![
            format!(
                "Second time derivatives (in rad/s²) of the symmetric coordinates at {}`coordinates` (in rad) and `rates` (in rad/s).",
                self.at_time()
            ),
            String::new(),
            format!(
                "Solves M̃(q) q̈ + b̃(q, q̇{}) = 0. {}{}",
                self.and_time(),
                self.fate_of_differences(),
                self.braking_note()
            ),
        ]
    }

    /// Returns the documentation of H_d, the energy of the antiphase motion.
    pub(super) fn antiphase_energy_meaning(&self, n: usize) -> Vec<String> {
        vec![format!(
            "Energy H_d (in J) of the antiphase coordinate `{}` alone: the sub-Hamiltonian into which W transfers energy (Toda and Ooshida, Eq. 12; for more than two copies, Parseval's share of the potential energy).{}",
            self.difference_of_transfer(n),
            match self.mechanics.mean_tree {
                Some(_) => " Its constants are the means of the copies' constants.",
                None => "",
            }
        )]
    }

    /// Returns the documentation of the leading quadratic form of W.
    pub(super) fn quadratic_form_meaning(&self, n: usize) -> Vec<String> {
        vec![
            format!(
                "Coefficients a_pp, a_pq, a_qq of the quadratic form W ≈ a_pp p² + a_pq p θ + a_qq θ² for `{}`, at the given in-phase state; the coordinate and momentum of the difference itself are not read.",
                self.difference_of_transfer(n)
            ),
            String::new(),
            IN_PHASE.into(),
        ]
    }

    /// Returns the documentation of W without truncation.
    pub(super) fn exact_transfer_meaning(&self, n: usize, state: EntryState) -> Vec<String> {
        match state {
            EntryState::Momenta(_) => vec![format!(
                "Energy transfer W = dH_d/dt (in W) into `{}` without truncation, from coordinates and momenta: the velocities are found by solving a linear system, without expanding an inverse. Conservative part; {}.",
                self.difference_of_transfer(n),
                self.on_top()
            )],
            EntryState::Absolute | EntryState::Rates => vec![format!(
                "Energy transfer W = dH_d/dt (in W) into `{}` without truncation, from coordinates and their velocities, as an experiment measures them. Conservative part; {}.",
                self.difference_of_transfer(n),
                self.on_top()
            )],
        }
    }

    /// Returns the documentation of the part of W that has one cause.
    pub(super) fn split_transfer_meaning(&self, n: usize, cause: Cause) -> Vec<String> {
        let name = self.difference_of_transfer(n);
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

    /// Returns the documentation of the power of friction on H_d.
    pub(super) fn antiphase_friction_meaning(&self, n: usize, state: EntryState) -> Vec<String> {
        vec![format!(
            "Power (in W) of friction and drag on H_d of `{}`{}.",
            self.difference_of_transfer(n),
            match state {
                EntryState::Momenta(_) =>
                    ", from coordinates and momenta: the velocities are found by solving a linear system",
                EntryState::Absolute | EntryState::Rates => "",
            }
        )]
    }

    /// Returns the documentation of the power of the drive on H_d.
    pub(super) fn antiphase_drive_meaning(&self, n: usize) -> Vec<String> {
        vec![format!(
            "Power Σ ∂H_d/∂p Q (in W) of the drive on H_d of `{}` at `time` (in s), by the inertial forces of the moving pivot; a torque on the root has none.",
            self.difference_of_transfer(n)
        )]
    }

    /// Returns the documentation of the power of external torques on H_d.
    pub(super) fn antiphase_outside_meaning(&self, n: usize) -> Vec<String> {
        vec![format!(
            "Power Σ ∂H_d/∂p Q (in W) of external `torques` Q (in N m) on the links, on H_d of `{}`.",
            self.difference_of_transfer(n)
        )]
    }

    /// Returns the docs of a truncated W.
    pub(super) fn truncation_meaning(
        &self,
        n: usize,
        counting: Counting,
        order: u32,
    ) -> Vec<String> {
        let difference = self.difference_of_transfer(n);
        match (counting, order) {
            (Counting::Angle, 1) => vec![
                format!("Energy transfer W (in W) into `{}` to first order in the difference angles, without expansion in the momenta: W_K and W_P as published (Toda and Ooshida, Eqs. 16b and 16c).", difference),
                String::new(),
                "This form is of first order in the angles only. In an oscillation the momenta are as small as the angles, and two of the four terms of leading order are then missing; `transfer_amplitude_2` contains all four. The remainder is O(θ_d) in W_K and O(θ_d³) in W_P.".into(),
                String::new(),
                IN_PHASE.into(),
            ],
            (Counting::Amplitude, 2) => vec![
                format!("Energy transfer W (in W) into `{}` to second order in the amplitude of the differences: the complete quadratic form in them and their momenta. {}", difference, self.remainder(n)),
                String::new(),
                format!("ε scales the differences and their momenta. {IN_PHASE}"),
            ],
            (Counting::Angle | Counting::Amplitude, _) => {
                let (what, remainder) = match counting {
                    Counting::Angle => (
                        "the difference angles, without expansion in the momenta",
                        "It grows with the momenta of the differences, which are not counted as small.".to_owned(),
                    ),
                    // Between two copies only even orders are nonzero.
                    Counting::Amplitude => (
                        "the amplitude of the differences (both angles and momenta)",
                        format!("Remainder O(ε{}); for pairs one order higher.", superscript(order + 1)),
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

    /// Returns the name of the difference that a transfer belongs to.
    fn difference_of_transfer(&self, number: usize) -> &str {
        let coordinate = self.mechanics.transfers[number].coordinate;
        &self.mechanics.coordinates[coordinate].name
    }

    /// Describes the neglected orders. Exchanging two copies reverses the sign of their difference,
    /// so that odd orders vanish; between more copies there are cubic terms.
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
