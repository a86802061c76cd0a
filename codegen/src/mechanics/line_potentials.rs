//! Potential energy of straight lines between points (physics §19), and the forces along them.
//!
//! ```text
//! U = ½ K s² + V      s = ℓ − L      V = A/ℓⁿ
//! ```
//!
//! K is the stiffness, L the rest length, ℓ the length |Δ|, A and n strength and exponent of a
//! repulsion. A spring with zero rest length has U = K q with q = ½ Δ·Δ, whose slopes are N_i =
//! Δ·∂Δ/∂θ_i, without a square root. The slopes of V are −f N_i with f = n A/ℓⁿ⁺², without a square
//! root if n is even.

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::SymbolId;
use super::laws::{inverse_power, stored};
use super::letters;
use super::meaning::{DerivedLine, LineMeaning};
use crate::scene::{DescribedLinePotential, Quantity, strength_unit};

/// A term of the potential energy of a line.
struct LineTerm {
    energy: Formula,
    /// Factors of the slopes of the energy by the angles: slope = pull times the slope of the
    /// length, or of the quantity that the energy depends on.
    pull: Formula,
    slopes: Vec<SymbolId>,
}

impl Derivation<'_> {
    /// Derives the energy of a line, and the factors (pulls) of the slopes of its terms.
    pub(super) fn pulls_of_potentials(&mut self, line: &mut DerivedLine) {
        for potential in &self.scene.translational[line.line.spring_damper].potentials {
            let LineTerm {
                energy,
                pull,
                slopes,
            } = match potential {
                DescribedLinePotential::Spring { stiffness, rest } => {
                    self.spring_of_line(line, [stiffness, rest])
                }
                DescribedLinePotential::InversePower { strength, exponent } => {
                    self.inverse_power_of_line(line, strength, *exponent)
                }
            };
            self.lines.energy = &self.lines.energy + &energy;
            line.pulls.push((pull, slopes));
        }
    }

    /// Derives the term ½ K s², or K q for zero rest length.
    fn spring_of_line(
        &mut self,
        line: &mut DerivedLine,
        [spring, rest_length]: [&Quantity; 2],
    ) -> LineTerm {
        let (scene, index) = (self.scene, line.line.spring_damper);
        let what = &scene.translational[index].what;
        let constants = scene.straight_names(index);
        let meaning = format!("stiffness of the straight spring of `{what}`");
        let value = self.quantity(spring);
        let stiffness = self.lettered(letters::STRAIGHT_SPRING, &constants, &meaning, value);
        let coordinates = line.coordinates.clone();
        let (strain, slopes) = match rest_length.is_zero() {
            true => {
                let half = &Formula::integer(2).pow(-1) * &square_of_length(line);
                (("half_square", "q", "q", half), line.moments.clone())
            }
            false => {
                let (length, slopes) = self.length(line);
                let meaning = format!("length at rest of the spring of `{what}`");
                let value = self.quantity(rest_length);
                let rest = self.lettered(letters::REST_LENGTH, &constants, &meaning, value);
                (
                    ("stretch", "s", "s", &Formula::symbol(length) - &rest),
                    slopes,
                )
            }
        };
        let (code, text, latex, strain) = strain;
        let strain = LineMeaning::Formula(strain);
        let strain = self.line_symbol([code, text, latex], &line.names, strain, &coordinates);
        self.give_slopes(
            strain,
            &coordinates,
            slopes.iter().copied().map(Formula::symbol),
        );
        let strain = Formula::symbol(strain);
        let (energy, pull) = match rest_length.is_zero() {
            true => (&stiffness * &strain, stiffness),
            false => (stored(&stiffness, &strain), &stiffness * &strain),
        };
        LineTerm {
            energy,
            pull,
            slopes,
        }
    }

    /// Derives the term V = A/ℓⁿ, with ∂V/∂θ_i = −f N_i and ∂f/∂θ_i = −(n + 2) f N_i/ℓ².
    fn inverse_power_of_line(
        &mut self,
        line: &mut DerivedLine,
        strength: &Quantity,
        exponent: u32,
    ) -> LineTerm {
        let (scene, index) = (self.scene, line.line.spring_damper);
        let meaning = format!(
            "strength of the repulsion of `{}`",
            scene.translational[index].what
        );
        let (constants, value) = (scene.straight_names(index), self.quantity(strength));
        let letter = letters::repulsion(strength_unit(exponent));
        let strength = self.lettered(letter, &constants, &meaning, value);
        // Even powers of ℓ are powers of ℓ² and need no square root.
        let (base, degree) = match exponent % 2 {
            0 => (square_of_length(line), 2),
            _ => (Formula::symbol(self.length(line).0), 1),
        };
        let distance_to = |power: i32| base.pow(power / degree);
        let n = exponent as i32;
        let [energy, push] = inverse_power(&strength, n, distance_to);
        let coordinates = line.coordinates.clone();
        let mut named = |letters, meaning| {
            let meaning = LineMeaning::Formula(meaning);
            self.line_symbol(letters, &line.names, meaning, &coordinates)
        };
        let energy = named(["repulsion_energy", "V", "V"], energy);
        let push = named(["push_over_length", "f", "f"], push);
        let pull = -Formula::symbol(push);
        let slopes = line.moments.clone();
        let own = slopes
            .iter()
            .map(|&moment| &pull * &Formula::symbol(moment));
        self.give_slopes(energy, &coordinates, own);
        let steeper = &(&Formula::integer((n + 2).into()) * &pull) * &distance_to(-2);
        let own = slopes
            .iter()
            .map(|&moment| &steeper * &Formula::symbol(moment));
        self.give_slopes(push, &coordinates, own);
        LineTerm {
            energy: Formula::symbol(energy),
            pull,
            slopes,
        }
    }
}

/// Returns ℓ² in the components of the line.
pub(super) fn square_of_length(line: &DerivedLine) -> Formula {
    let [dx, dy] = line
        .offset
        .map(|component| Formula::symbol(component).pow(2));
    &dx + &dy
}
