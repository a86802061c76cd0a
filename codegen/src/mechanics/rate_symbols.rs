//! Symbols for the rates of observables.

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::{Role, SymbolId};
use super::frame::DerivedFrame;
use super::observables::EnergySymbols;
use super::print::latex_name;
use crate::scene::{Coordinate, LinkId};

/// Symbols for the rates of observables in one frame.
pub(super) struct RateSymbols {
    pub(super) accelerations: Vec<SymbolId>,
    pub(super) friction_accelerations: Vec<SymbolId>,
    /// Forces ∂L/∂q_i at fixed velocities.
    pub(super) forces: Vec<SymbolId>,
    /// Generalized forces Q_i of friction and drag.
    pub(super) torques: Vec<SymbolId>,
    /// Slopes ∂H/∂q_i at fixed momenta.
    pub(super) slopes: Vec<SymbolId>,
    /// Products (Ṁ v)_i of the mass matrix's rate and the velocities.
    pub(super) changes: Vec<SymbolId>,
    /// True for coordinates i with friction.
    pub(super) has_torque: Vec<bool>,
}

impl Derivation<'_> {
    /// Creates symbols for the energies K and U and their derivatives, in a frame without formulas.
    pub(super) fn energies(&mut self, frame: &DerivedFrame) -> EnergySymbols {
        if let Some(known) = &self.energies {
            return known.clone();
        }
        let mut energy = |code: &str, text: &str| {
            let symbol = self.symbols.intern(Role::Derived, code, text, text);
            let slopes = self.indexed_symbols(
                frame,
                Role::Derived,
                &format!("{code}_slope"),
                |name| format!("(∂{text}/∂θ_{name})"),
                |name| {
                    format!("\\frac{{\\partial {text}}}{{\\partial\\theta_{{\\mathrm{{{name}}}}}}}")
                },
            );
            for (&coordinate, &slope) in frame.coordinates.iter().zip(&slopes) {
                let slope = Formula::symbol(slope);
                self.given_slopes.insert((symbol, coordinate), slope);
            }
            (symbol, slopes)
        };
        let (kinetic, kinetic_slopes) = energy("kinetic_energy", "K");
        let (potential, potential_slopes) = energy("potential_energy", "U");
        // ∂K/∂v_i = p_i.
        for (&velocity, &momentum) in frame.velocities.iter().zip(&frame.momenta) {
            let momentum = Formula::symbol(momentum);
            self.given_slopes.insert((kinetic, velocity), momentum);
        }
        let energies = EnergySymbols {
            kinetic,
            potential,
            kinetic_slopes,
            potential_slopes,
        };
        self.energies = Some(energies.clone());
        energies
    }

    pub(super) fn rate_symbols(
        &mut self,
        absolute: &DerivedFrame,
        frame: &DerivedFrame,
        coordinates: Option<&[Coordinate]>,
    ) -> RateSymbols {
        let indexed = |derivation: &mut Self, role, code: &str, text: &str, latex: &str| {
            let (before, after) = text.split_once('#').unwrap_or((text, ""));
            let (latex_before, latex_after) = latex.split_once('#').unwrap_or((latex, ""));
            derivation.indexed_symbols(
                frame,
                role,
                code,
                |name| format!("{before}{name}{after}"),
                |name| format!("{latex_before}\\mathrm{{{name}}}{latex_after}"),
            )
        };
        use Role::{Acceleration, Derived};
        RateSymbols {
            accelerations: indexed(self, Acceleration, "alpha", "α_#", "\\alpha_{#}"),
            friction_accelerations: indexed(
                self,
                Derived,
                "friction_alpha",
                "α_#^Q",
                "\\alpha_{#}^{Q}",
            ),
            forces: indexed(
                self,
                Derived,
                "force",
                "(∂L/∂θ_#)",
                "\\frac{\\partial L}{\\partial\\theta_{#}}",
            ),
            torques: indexed(self, Derived, "friction_torque", "Q_#", "Q_{#}"),
            slopes: indexed(
                self,
                Derived,
                "hamiltonian_slope",
                "(∂H/∂θ_#)",
                "\\frac{\\partial H}{\\partial\\theta_{#}}",
            ),
            changes: indexed(
                self,
                Derived,
                "mass_change",
                "(Ṁ ω)_#",
                "(\\dot M\\omega)_{#}",
            ),
            has_torque: self.has_torque(absolute, frame, coordinates),
        }
    }

    /// Returns, for each coordinate, true if friction acts on it.
    fn has_torque(
        &self,
        absolute: &DerivedFrame,
        frame: &DerivedFrame,
        coordinates: Option<&[Coordinate]>,
    ) -> Vec<bool> {
        let resisted = |frame: &DerivedFrame, index: usize| {
            let velocity = frame.velocities[index];
            !self
                .partial(&frame.dissipation, velocity)
                .expand()
                .is_zero()
        };
        match coordinates {
            Some(coordinates) if frame.has_symbols_alone() => {
                let of_link = |&(LinkId(link), _): &_| resisted(absolute, link);
                let of_coordinate = |c: &Coordinate| c.weights.iter().any(of_link);
                coordinates.iter().map(of_coordinate).collect()
            }
            _ => (0..frame.velocities.len())
                .map(|index| resisted(frame, index))
                .collect(),
        }
    }

    /// Creates one symbol for each coordinate of a frame.
    pub(super) fn indexed_symbols(
        &mut self,
        frame: &DerivedFrame,
        role: Role,
        code: &str,
        text: impl Fn(&str) -> String,
        latex: impl Fn(&str) -> String,
    ) -> Vec<SymbolId> {
        let names: Vec<String> = frame
            .coordinates
            .iter()
            .map(|&id| {
                let code = &self.symbols.get(id).code;
                code.strip_prefix("theta_").unwrap_or(code).to_owned()
            })
            .collect();
        names
            .iter()
            .map(|name| {
                let (text, latex) = (text(name), latex(&latex_name(name)));
                self.symbols
                    .intern(role, &format!("{code}_{name}"), &text, &latex)
            })
            .collect()
    }
}

impl RateSymbols {
    /// Returns Σ slope_i Q_i over the coordinates on which friction acts.
    pub(super) fn torque(&self, slopes: &[Formula]) -> Formula {
        slopes
            .iter()
            .zip(&self.torques)
            .zip(&self.has_torque)
            .filter(|(_, has_torque)| **has_torque)
            .map(|((slope, &torque), _)| slope * &Formula::symbol(torque))
            .sum()
    }
}
