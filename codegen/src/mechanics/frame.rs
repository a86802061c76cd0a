//! A Lagrangian in one set of generalized coordinates, and the Euler–Lagrange operator, which is
//! the same for all sets.

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::SymbolId;
use super::meaning::DerivedTorque;
use std::collections::BTreeMap;

/// Lower triangle of a sparse symmetric matrix.
#[derive(Clone, Default)]
pub(super) struct MassMatrix(BTreeMap<(usize, usize), Formula>);

impl MassMatrix {
    /// Adds `value` to the entry (row, column), with row ≥ column.
    pub(super) fn add(&mut self, row: usize, column: usize, value: Formula) {
        let entry = self.0.entry((row, column)).or_insert_with(Formula::zero);
        *entry = &*entry + &value;
    }

    /// Returns the entry (i, j), in either order of the indices; zero if it is absent.
    pub(super) fn get(&self, i: usize, j: usize) -> Formula {
        let key = (i.max(j), i.min(j));
        self.0.get(&key).cloned().unwrap_or_else(Formula::zero)
    }

    /// Iterates over the entries of the lower triangle, by row, then by column.
    pub(super) fn iter(&self) -> impl Iterator<Item = (usize, usize, &Formula)> {
        self.0
            .iter()
            .map(|(&(row, column), value)| (row, column, value))
    }

    /// Returns the matrix with `change` applied to every entry; zeros are dropped.
    pub(super) fn map(self, mut change: impl FnMut(usize, usize, Formula) -> Formula) -> Self {
        Self(
            self.0
                .into_iter()
                .map(|((row, column), value)| ((row, column), change(row, column, value)))
                .filter(|(_, value)| !value.is_zero())
                .collect(),
        )
    }
}

/// A Lagrangian in one set of generalized coordinates.
pub(super) struct DerivedFrame {
    pub(super) coordinates: Vec<SymbolId>,
    pub(super) velocities: Vec<SymbolId>,
    pub(super) momenta: Vec<SymbolId>,
    pub(super) mass: MassMatrix,
    pub(super) potential: Formula,
    /// Part of the potential energy that torsion springs store.
    pub(super) springs: Formula,
    /// Rayleigh's function R of viscous friction and drag, plus Σ D w over the torques D of all
    /// other friction at the rates w. D counts as constant here, so that the gradient by the
    /// velocities is the torques of both kinds.
    pub(super) dissipation: Formula,
    /// Torques D of friction that is not viscous.
    pub(super) torques: Vec<DerivedTorque>,
    /// Function whose gradient at fixed time is the generalized forces of the drive; zero without a
    /// drive.
    pub(super) drive: Formula,
}

impl DerivedFrame {
    /// Creates a frame of symbols without formulas. The program then computes the mechanics on
    /// means and differences.
    pub(super) fn of_symbols(frame: &super::Frame) -> Self {
        Self {
            coordinates: frame.coordinates.clone(),
            velocities: frame.velocities.clone(),
            momenta: frame.momenta.clone(),
            mass: MassMatrix::default(),
            potential: Formula::zero(),
            springs: Formula::zero(),
            dissipation: Formula::zero(),
            torques: Vec::new(),
            drive: Formula::zero(),
        }
    }

    /// Returns true if the frame consists only of symbols, without formulas.
    pub(super) fn has_symbols_alone(&self) -> bool {
        self.mass.iter().next().is_none()
    }

    /// Iterates over the terms of the kinetic energy ½ Σ M_ab v_a v_b, one per pair a ≥ b.
    pub(super) fn kinetic_terms(&self) -> impl Iterator<Item = (usize, usize, Formula)> {
        self.mass.iter().map(|(a, b, entry)| {
            let pair = &Formula::symbol(self.velocities[a]) * &Formula::symbol(self.velocities[b]);
            let weight = if a == b {
                Formula::integer(2).pow(-1)
            } else {
                Formula::integer(1)
            };
            (a, b, &weight * &(entry * &pair))
        })
    }

    /// Returns the generalized momenta p_i = ∂L/∂v_i.
    pub(super) fn momentum(&self) -> Vec<Formula> {
        let mut momenta = vec![Vec::new(); self.coordinates.len()];
        for (a, b, term) in self.kinetic_terms() {
            momenta[a].push(term.derivative(self.velocities[a]));
            if a != b {
                momenta[b].push(term.derivative(self.velocities[b]));
            }
        }
        summed(momenta)
    }

    /// Returns the index of a coordinate in this frame.
    pub(super) fn index(&self, coordinate: SymbolId) -> usize {
        match self.coordinates.iter().position(|&c| c == coordinate) {
            Some(index) => index,
            None => unreachable!("a formula of this frame depends on a foreign coordinate"),
        }
    }

    /// Returns the gradient ∂K/∂q_i of the kinetic energy at fixed velocities.
    pub(super) fn kinetic_gradient(&self, derivation: &Derivation<'_>) -> Vec<Formula> {
        let mut gradient = vec![Vec::new(); self.coordinates.len()];
        for (_, _, term) in self.kinetic_terms() {
            for coordinate in derivation.coordinates_of(&term) {
                gradient[self.index(coordinate)].push(derivation.partial(&term, coordinate));
            }
        }
        summed(gradient)
    }

    /// Returns the gradient ∂U/∂q_i of the potential energy.
    pub(super) fn potential_gradient(&self, derivation: &Derivation<'_>) -> Vec<Formula> {
        self.gradient(&self.potential, derivation)
    }

    /// Returns the generalized forces −∂R/∂v_i of friction and drag.
    pub(super) fn dissipative_forces(&self, derivation: &Derivation<'_>) -> Vec<Formula> {
        let torque = |&velocity| (-derivation.partial(&self.dissipation, velocity)).expand();
        self.velocities.iter().map(torque).collect()
    }

    /// Returns the generalized forces of the drive, at fixed time.
    pub(super) fn drive_forces(&self, derivation: &Derivation<'_>) -> Vec<Formula> {
        self.gradient(&self.drive, derivation)
    }

    /// Returns the partial derivatives of a function of the coordinates.
    fn gradient(&self, function: &Formula, derivation: &Derivation<'_>) -> Vec<Formula> {
        // Term by term: each term depends on few coordinates.
        let mut gradient = vec![Vec::new(); self.coordinates.len()];
        for term in function.terms() {
            for coordinate in derivation.coordinates_of(&term) {
                gradient[self.index(coordinate)].push(derivation.partial(&term, coordinate));
            }
        }
        summed(gradient)
    }

    /// Returns the terms of the Euler–Lagrange equations other than M q̈, so that d/dt ∂L/∂v_i −
    /// ∂L/∂q_i + ∂R/∂v_i − Q_i = Σ_j M_ij q̈_j + bias_i.
    pub(super) fn bias(&self, derivation: &Derivation<'_>) -> Vec<Formula> {
        let mut rows: Vec<Vec<Formula>> = vec![Vec::new(); self.coordinates.len()];
        for (a, b, term) in self.kinetic_terms() {
            for coordinate in derivation.coordinates_of(&term) {
                // ∂²T/∂q∂v from ∂T/∂q, the longer one to compute.
                let slope = derivation.partial(&term, coordinate);
                let velocity = Formula::symbol(self.velocities[self.index(coordinate)]);
                for i in if a == b { vec![a] } else { vec![a, b] } {
                    rows[i].push(&slope.derivative(self.velocities[i]) * &velocity);
                }
                rows[self.index(coordinate)].push(-slope);
            }
        }
        let forces = self
            .dissipative_forces(derivation)
            .into_iter()
            .zip(self.drive_forces(derivation));
        rows.into_iter()
            .zip(self.potential_gradient(derivation))
            .zip(forces)
            .map(|((mut row, potential), (dissipative, drive))| {
                row.push(potential);
                row.push(-dissipative);
                row.push(-drive);
                row.into_iter().sum::<Formula>().expand()
            })
            .collect()
    }
}

/// Returns the sums of the given terms, multiplied out.
fn summed(sums: Vec<Vec<Formula>>) -> Vec<Formula> {
    let sums = sums.into_iter();
    sums.map(|terms| terms.into_iter().sum::<Formula>().expand())
        .collect()
}
