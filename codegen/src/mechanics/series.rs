//! Energy transfer W to any order, from a series expansion of the velocities.
//!
//! With M̃ = Σ εᵏ M⁽ᵏ⁾ and p = Σ εⁿ p⁽ⁿ⁾, the equation M̃ q̇ = p gives order by order M⁽⁰⁾ q̇⁽ⁿ⁾ =
//! p⁽ⁿ⁾ − Σ_{k≥1} M⁽ᵏ⁾ q̇⁽ⁿ⁻ᵏ⁾. Each order takes one solve with the same matrix, and no inverse is
//! written out. The exact W, a polynomial in the velocities, is then truncated at the requested
//! order. At low orders the result equals that of the Poisson bracket with the expanded
//! Hamiltonian.

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::{Role, SymbolId};
use super::frame::DerivedFrame;
use super::inverse_mass::DerivedExpansion;
use super::print::latex_name;
use super::transfer::SubHamiltonian;
use super::{Correction, EnergyParts};
use crate::functions::Counting;
use crate::scene::Coordinate;

/// Velocities as a power series in ε (the size of the differences), expressed in the symbols of
/// `corrections`.
pub(super) struct VelocitySeries {
    pub(super) counting: Counting,
    pub(super) corrections: Vec<Correction<Formula>>,
    /// Terms q̇⁽ⁿ⁾, by order n and coordinate.
    orders: Vec<Vec<Formula>>,
}

impl Derivation<'_> {
    /// Expands the velocities up to `order`.
    pub(super) fn velocity_series(
        &mut self,
        frame: &DerivedFrame,
        coordinates: &[Coordinate],
        expansion: &DerivedExpansion,
        counting: Counting,
        order: u32,
    ) -> VelocitySeries {
        let n = coordinates.len();
        let mut series = VelocitySeries {
            counting,
            corrections: Vec::new(),
            orders: Vec::new(),
        };
        for level in 0..=order as usize {
            let small_momenta = usize::from(counting == Counting::Amplitude);
            let mut right = vec![Formula::zero(); n];
            for &d in &expansion.differences {
                if level == small_momenta {
                    right[d] = Formula::symbol(frame.momenta[d]);
                }
            }
            for (k, matrix) in expansion.orders.iter().enumerate().take(level + 1).skip(1) {
                for (i, row) in right.iter_mut().enumerate() {
                    let terms = (0..n).map(|j| &matrix.get(i, j) * &series.orders[level - k][j]);
                    *row = &*row - &terms.sum::<Formula>();
                }
            }
            let right: Vec<Formula> = right.iter().map(Formula::expand).collect();
            let velocities = self.solve_order(coordinates, expansion, &mut series, level, right);
            series.orders.push(velocities);
        }
        series
    }

    fn solve_order(
        &mut self,
        coordinates: &[Coordinate],
        expansion: &DerivedExpansion,
        series: &mut VelocitySeries,
        level: usize,
        right: Vec<Formula>,
    ) -> Vec<Formula> {
        let mut velocities = vec![Formula::zero(); coordinates.len()];
        let mut correction = Correction {
            in_phase: Vec::new(),
            right: Vec::new(),
            differences: Vec::new(),
        };
        let solved = expansion.in_phase.iter().any(|&i| !right[i].is_zero());
        for (place, &i) in expansion.in_phase.iter().enumerate() {
            if level == 0 {
                velocities[i] = Formula::symbol(expansion.velocity_symbols[place]);
            } else if solved {
                let symbol = self.correction_symbol(&coordinates[i].name, series.counting, level);
                correction.in_phase.push(symbol);
                correction.right.push(right[i].clone());
                velocities[i] = Formula::symbol(symbol);
            }
        }
        for &d in &expansion.differences {
            let value = (&right[d] / &expansion.orders[0].get(d, d)).expand();
            // The lowest order is short and needs no symbol.
            velocities[d] = if level <= 1 || value.is_zero() {
                value
            } else {
                let symbol = self.correction_symbol(&coordinates[d].name, series.counting, level);
                correction.differences.push((symbol, value));
                Formula::symbol(symbol)
            };
        }
        if !correction.in_phase.is_empty() || !correction.differences.is_empty() {
            series.corrections.push(correction);
        }
        velocities
    }

    fn correction_symbol(&mut self, name: &str, counting: Counting, level: usize) -> SymbolId {
        let (word, open, close) = match counting {
            Counting::Angle => ("angle", '[', ']'),
            Counting::Amplitude => ("amplitude", '(', ')'),
        };
        self.symbols.intern(
            Role::Derived,
            &format!("omega_{name}_{word}_{level}"),
            &format!("ω_{name}^{open}{level}{close}"),
            &format!(
                "\\omega_{{\\mathrm{{{}}}}}^{{{open}{level}{close}}}",
                latex_name(name)
            ),
        )
    }

    /// Returns the transfer W truncated at `order`: the parts of the exact W, in which the
    /// velocities are replaced by their series.
    ///
    /// With [`Counting::Angle`], K is truncated at that order and then differentiated, so that
    /// ∂K/∂q has one order less.
    pub(super) fn series_transfer(
        &mut self,
        frame: &DerivedFrame,
        expansion: &DerivedExpansion,
        energy: &SubHamiltonian,
        series: &VelocitySeries,
        order: u32,
    ) -> EnergyParts<Formula> {
        let pairs = Self::difference_pairs(frame, expansion);
        let kinetic_gradient = frame.kinetic_gradient(self);
        let potential_gradient = frame.potential_gradient(self);
        let own = energy.coordinate;
        let velocity = energy.kinetic.derivative(frame.momenta[own]);
        let mut exchange = Vec::new();
        let mut potential = Vec::new();
        for &s in &expansion.differences {
            let slope = self.partial(&energy.potential, frame.coordinates[s]);
            let mine = energy.kinetic.derivative(frame.momenta[s]);
            let excess = &Formula::symbol(frame.velocities[s]) - &mine;
            exchange.push(&slope * &excess);
            let slope = self.partial(&energy.potential_apart, frame.coordinates[s]);
            potential.push(&mine * &(&slope - &potential_gradient[s]));
        }
        let drive = &velocity * &kinetic_gradient[own];
        let before = match series.counting {
            Counting::Angle => order.saturating_sub(1),
            Counting::Amplitude => order,
        };
        let mut cut = |formula: Formula, order: u32| -> Formula {
            let velocities = series.replacements(self, frame, order);
            self.orders_with(&formula, &pairs, series.counting, order, velocities)
                .into_iter()
                .sum::<Formula>()
                .expand()
        };
        let kinetic = &cut(exchange.into_iter().sum(), order) + &cut(drive, before);
        let potential = cut(potential.into_iter().sum(), order);
        EnergyParts {
            kinetic: kinetic.expand(),
            potential,
        }
    }
}

impl VelocitySeries {
    /// Returns the replacements of the velocity symbols by Σ εⁿ q̇⁽ⁿ⁾.
    fn replacements(
        &self,
        derivation: &mut Derivation<'_>,
        frame: &DerivedFrame,
        order: u32,
    ) -> Vec<(SymbolId, Formula)> {
        let epsilon = Formula::symbol(derivation.epsilon());
        frame
            .velocities
            .iter()
            .enumerate()
            .map(|(index, &symbol)| {
                let sum = self
                    .orders
                    .iter()
                    .enumerate()
                    .take(order as usize + 1)
                    .map(|(n, velocities)| &epsilon.pow(n as i32) * &velocities[index])
                    .sum();
                (symbol, sum)
            })
            .collect()
    }
}
