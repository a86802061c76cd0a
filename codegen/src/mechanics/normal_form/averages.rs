//! Terms of fourth degree of the Hamiltonian, and their averages over the phases of the modes.

use super::modes::Mode;
use crate::mechanics::algebra::Formula;
use crate::mechanics::derivation::Derivation;
use crate::mechanics::frame::DerivedFrame;
use std::collections::BTreeMap;

/// Coefficients of H₄ by the powers of all X, then of all Y.
pub(super) struct Averages {
    table: BTreeMap<Vec<u32>, Formula>,
    modes: usize,
}

impl Averages {
    /// Sorts the terms of H₄ by their powers of the variables of the modes.
    pub(super) fn of(fourth_degree: Formula, modes: &[Mode]) -> Self {
        let [x, y] = [0, 1].map(|part| modes.iter().map(move |mode| mode.variables[part]));
        Self {
            table: fourth_degree.coefficients(&x.chain(y).collect::<Vec<_>>()),
            modes: modes.len(),
        }
    }

    /// Returns the coefficient of a product of four variables. `x` lists the modes whose X is a factor,
    /// `y` those whose Y is one.
    fn coefficient(&self, x: &[usize], y: &[usize]) -> Formula {
        let mut powers = vec![0; 2 * self.modes];
        let factors = x
            .iter()
            .copied()
            .chain(y.iter().map(|own| own + self.modes));
        factors.for_each(|factor| powers[factor] += 1);
        let found = self.table.get(&powers).cloned();
        found.unwrap_or_else(Formula::zero)
    }

    /// Returns J_j J_k A_jk with A_jk = ∂²⟨H₄⟩/∂I_j∂I_k (20.9): ⟨x⁴⟩ = 3/2 I², ⟨x² y²⟩ = ½ I² in
    /// one mode, and ⟨x²⟩ = ⟨y²⟩ = I.
    pub(super) fn shift(&self, j: usize, k: usize) -> Formula {
        if j == k {
            let fourth = &Formula::integer(3) * &self.coefficient(&[j; 4], &[]);
            return (&fourth + &self.coefficient(&[j; 2], &[j; 2])).expand();
        }
        let mixed = &self.coefficient(&[j; 2], &[k; 2]) + &self.coefficient(&[k; 2], &[j; 2]);
        (&self.coefficient(&[j, j, k, k], &[]) + &mixed).expand()
    }

    /// Returns √(J_0 J_1) J_2 C with C = 2 h of the term h z₀ z₁ z̄₂² (20.10): with
    /// x = (z + z̄)/√2 and y = (z − z̄)/(i√2) each product of four variables has ±¼ of it.
    pub(super) fn resonant(&self) -> Formula {
        let positive = [
            self.coefficient(&[0, 1, 2, 2], &[]),
            self.coefficient(&[0, 2], &[1, 2]),
            self.coefficient(&[1, 2], &[0, 2]),
        ];
        let negative = [
            self.coefficient(&[2, 2], &[0, 1]),
            self.coefficient(&[0, 1], &[2, 2]),
        ];
        let sum = |all: &[Formula]| all.iter().cloned().sum::<Formula>();
        let twice = &sum(&positive) - &sum(&negative);
        (&Formula::integer(2).pow(-1) * &twice).expand()
    }
}

impl Derivation<'_> {
    /// Returns H₄ in the variables of the modes (20.8): a cosine of an angle x has the term x⁴/24,
    /// and one in the mass matrix −x²/2.
    pub(super) fn fourth_degree(&self, frame: &DerivedFrame, modes: &[Mode]) -> Formula {
        let sum = |of_mode: &dyn Fn(&Mode) -> Formula| modes.iter().map(of_mode).sum::<Formula>();
        let angle =
            |link: usize| sum(&|mode| &mode.shape[link] * &Formula::symbol(mode.variables[0]));
        let joint =
            |link: usize| sum(&|mode| &mode.joints[link] * &Formula::symbol(mode.variables[0]));
        let rate = |link: usize| {
            let rate = |mode: &Mode| &mode.frequency * &Formula::symbol(mode.variables[1]);
            sum(&|mode| &mode.shape[link] * &rate(mode))
        };
        let mut terms = Vec::new();
        for (link, &coordinate) in frame.coordinates.iter().enumerate() {
            let weight = frame.potential.derivative(self.cos(coordinate));
            terms.push(&weight * &(&angle(link).pow(4) / &Formula::integer(24)));
        }
        for (row, column, entry) in frame.mass.iter() {
            if row == column {
                continue;
            }
            let (cos, _) = self.known_between(frame.coordinates[row], frame.coordinates[column]);
            let rates = &rate(row) * &rate(column);
            let change = &joint(row).pow(2) / &Formula::integer(2);
            terms.push(&entry.derivative(cos) * &(&change * &rates));
        }
        terms.into_iter().sum::<Formula>().expand()
    }
}
