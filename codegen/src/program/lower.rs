//! Conversion of expressions to values of the program.
//!
//! An [`Environment`] names the arguments of the function (angles and velocities, or coordinates
//! and momenta). Any other symbol is computed from them when it is first needed.

use super::ValueId;
use super::builder::Builder;
use super::constants::ConstantId;
use super::solve::Matrix;
use super::symmetric::OrbitLinks;
use crate::functions::Argument;
use crate::mechanics::expression::{Expr, Role, SymbolId};
use crate::mechanics::{
    Frame, JointDifference, LineMeaning, LinearSystem, MassExpansion, MatrixEntry, MeanTree,
    Mechanics, ObservableFrame,
};
use std::collections::BTreeMap;

/// State of the conversion of mechanics to a program.
#[derive(Clone)]
pub(super) struct Lowering<'a> {
    pub(super) mechanics: &'a Mechanics,
    pub(super) builder: Builder,
    pub(super) constants: BTreeMap<SymbolId, ConstantId>,
    /// Orbits (equal copies of one link) with their means and differences, if the scene has
    /// symmetric coordinates.
    pub(super) orbits: &'a [OrbitLinks],
}

/// Values of the symbols of one frame: arguments of the function, or values computed on demand.
#[derive(Clone)]
pub(super) struct Environment<'a> {
    pub(super) frame: &'a Frame,
    /// Argument that holds the coordinates.
    pub(super) coordinates: Argument,
    /// Argument that holds the velocities. Without one, they are computed from the momenta.
    pub(super) velocities: Option<Argument>,
    /// Argument that contains the momenta. Without one, they are computed from the velocities.
    pub(super) momenta: Option<Argument>,
    /// Argument that holds external torques, if there is one.
    pub(super) torques: Option<Argument>,
    /// Quantities that observables use, in addition to those of the frame.
    pub(super) observed: Option<&'a ObservableFrame>,
    values: BTreeMap<SymbolId, ValueId>,
}

impl<'a> Environment<'a> {
    pub(super) fn new(
        frame: &'a Frame,
        coordinates: Argument,
        velocities: Option<Argument>,
        momenta: Option<Argument>,
    ) -> Self {
        Self {
            frame,
            coordinates,
            velocities,
            momenta,
            torques: None,
            observed: None,
            values: BTreeMap::new(),
        }
    }

    /// Returns the value of a symbol, if it is known already.
    pub(super) fn supplied(&self, symbol: SymbolId) -> Option<ValueId> {
        self.values.get(&symbol).copied()
    }

    /// Sets the value of a symbol.
    pub(super) fn supply(&mut self, symbol: SymbolId, value: ValueId) {
        self.values.insert(symbol, value);
    }
}

fn position(symbols: &[SymbolId], symbol: SymbolId) -> usize {
    match symbols.iter().position(|&s| s == symbol) {
        Some(index) => index,
        None => unreachable!("a symbol of another frame reached this environment"),
    }
}

impl<'a> Lowering<'a> {
    pub(super) fn new(mechanics: &'a Mechanics, orbits: &'a [OrbitLinks]) -> Self {
        Self {
            mechanics,
            orbits,
            builder: Builder::default(),
            constants: BTreeMap::new(),
        }
    }

    /// Returns the value of a symbol in an environment.
    pub(super) fn symbol(
        &mut self,
        environment: &mut Environment<'_>,
        symbol: SymbolId,
    ) -> ValueId {
        if let Some(value) = environment.supplied(symbol) {
            return value;
        }
        let entry = self.mechanics.symbols.get(symbol).clone();
        let value = match entry.role {
            Role::Parameter | Role::Constant => {
                let constant = self.constant(symbol);
                self.builder.constant(constant)
            }
            Role::Temporal => self.temporal(environment, symbol),
            Role::Trigonometric => {
                let value = self.trigonometric(environment, symbol);
                self.builder.name(value, &entry.code)
            }
            Role::Coordinate => {
                let index = position(&environment.frame.coordinates, symbol);
                self.builder.input(environment.coordinates, index)
            }
            Role::Velocity => {
                let index = position(&environment.frame.velocities, symbol);
                match environment.velocities {
                    Some(argument) => self.builder.input(argument, index),
                    None => self.velocities(environment)[index],
                }
            }
            Role::Joint => {
                let value = self.joint_difference(environment, symbol);
                self.builder.name(value, &entry.code)
            }
            Role::Line => {
                let value = match &self.mechanics.lines[&symbol] {
                    LineMeaning::Formula(formula) => self.expr(environment, formula),
                    LineMeaning::Root { square, .. } => {
                        let square = self.expr(environment, square);
                        self.builder.sqrt(square)
                    }
                };
                self.builder.name(value, &entry.code)
            }
            Role::Momentum => self.momentum(environment, symbol),
            Role::Derived => match self.observed(environment, symbol) {
                Some(value) => self.builder.name(value, &entry.code),
                None => self.derived(environment, symbol),
            },
            Role::Acceleration | Role::Bookkeeping => {
                unreachable!("{} never leaves the derivation", entry.code)
            }
        };
        environment.values.insert(symbol, value);
        value
    }

    /// Computes the difference of two angles minus a rest angle, Σ w θ − ρ, or the difference of
    /// two angular velocities, Σ w ω, at the two ends of a spring.
    fn joint_difference(&mut self, environment: &mut Environment<'_>, symbol: SymbolId) -> ValueId {
        let JointDifference { terms, rest } = &self.mechanics.joints[&symbol];
        let mut value = self.builder.integer(0);
        for &(symbol, weight) in terms {
            let term = self.symbol(environment, symbol);
            let size = self.builder.integer(weight.abs());
            let term = self.builder.mul(size, term);
            value = match weight < 0 {
                true => self.builder.sub(value, term),
                false => self.builder.add(value, term),
            };
        }
        let rest = self.expr(environment, rest);
        self.builder.sub(value, rest)
    }

    /// Returns a momentum, from an argument or from angles and velocities.
    fn momentum(&mut self, environment: &mut Environment<'_>, symbol: SymbolId) -> ValueId {
        let index = position(&environment.frame.momenta, symbol);
        if let Some(argument) = environment.momenta {
            return self.builder.input(argument, index);
        }
        let code = &self.mechanics.symbols.get(symbol).code;
        let observed = environment.observed.map(|observed| &observed.momentum);
        let Some(momentum) = environment.frame.momentum.as_ref().or(observed) else {
            unreachable!("{code} is formed where momenta are asked for")
        };
        let value = self.expr(environment, &momentum[index]);
        self.builder.name(value, code)
    }

    /// Solves M q̇ = p for the velocities q̇.
    fn velocities(&mut self, environment: &mut Environment<'_>) -> Vec<ValueId> {
        let frame = environment.frame;
        let mass = self.mass_matrix(environment);
        let momenta = frame.momenta.clone();
        let right = momenta
            .iter()
            .map(|&p| self.symbol(environment, p))
            .collect();
        let names = self.coordinate_names(frame);
        let solution = self.builder.solve(mass, right, &names);
        for (&symbol, &value) in frame.velocities.iter().zip(&solution) {
            let code = &self.mechanics.symbols.get(symbol).code;
            self.builder.name(value, code);
            environment.values.insert(symbol, value);
        }
        solution
    }

    /// Computes a friction torque, or a velocity of the expansion: w with M⁽⁰⁾ w = p, or a
    /// correction to it.
    fn derived(&mut self, environment: &mut Environment<'_>, symbol: SymbolId) -> ValueId {
        let mechanics = self.mechanics;
        if let Some(torque) = self.braking(environment, symbol) {
            return torque;
        }
        let normal_form = mechanics.normal_form.as_ref();
        if let Some(definition) = normal_form.and_then(|form| form.definition(symbol)) {
            return self.of_normal_form(environment, definition);
        }
        if let Some(mean_tree) = &mechanics.mean_tree {
            let added = self.added(environment, mean_tree);
            let unknowns = &mean_tree.added.unknowns;
            return added[position(unknowns, symbol)];
        }
        let Some(expansion) = &mechanics.expansion else {
            unreachable!("derived velocities come with the expansion");
        };
        if let Some(place) = expansion.velocities.iter().position(|&s| s == symbol) {
            let right = expansion
                .in_phase
                .iter()
                .map(|&i| self.symbol(environment, environment.frame.momenta[i]))
                .collect();
            return self.solve_in_phase(environment, expansion, &expansion.velocities, right)
                [place];
        }
        for correction in &expansion.corrections {
            if let Some(place) = correction.in_phase.iter().position(|&s| s == symbol) {
                let right = correction
                    .right
                    .iter()
                    .map(|r| self.expr(environment, r))
                    .collect();
                return self.solve_in_phase(environment, expansion, &correction.in_phase, right)
                    [place];
            }
            if let Some((_, value)) = correction.differences.iter().find(|(s, _)| *s == symbol) {
                let value = self.expr(environment, value);
                let code = &mechanics.symbols.get(symbol).code;
                return self.builder.name(value, code);
            }
        }
        unreachable!("{} is defined nowhere", mechanics.symbols.get(symbol).code)
    }

    /// Computes the velocities that the mismatches of copies (deviations from their mean constants)
    /// add.
    pub(super) fn added(
        &mut self,
        environment: &mut Environment<'_>,
        mean_tree: &MeanTree,
    ) -> Vec<ValueId> {
        let LinearSystem { unknowns, right } = &mean_tree.added;
        let matrix = self.matrix(environment, &mean_tree.frame.mass);
        let right = right.iter();
        let right = right.map(|right| self.expr(environment, right)).collect();
        let names = self.coordinate_names(environment.frame);
        let names: Vec<String> = names.iter().map(|name| format!("mean_{name}")).collect();
        let solution = self.builder.solve(matrix, right, &names);
        for (&symbol, &value) in unknowns.iter().zip(&solution) {
            let code = &self.mechanics.symbols.get(symbol).code;
            self.builder.name(value, code);
            environment.values.insert(symbol, value);
        }
        solution
    }

    fn solve_in_phase(
        &mut self,
        environment: &mut Environment<'_>,
        expansion: &MassExpansion,
        symbols: &[SymbolId],
        right: Vec<ValueId>,
    ) -> Vec<ValueId> {
        let matrix = self.matrix(environment, &expansion.leading);
        let all = self.coordinate_names(environment.frame);
        let names: Vec<String> = expansion
            .in_phase
            .iter()
            .map(|&i| format!("in_phase_{}", all[i]))
            .collect();
        let solution = self.builder.solve(matrix, right, &names);
        for (&velocity, &value) in symbols.iter().zip(&solution) {
            let code = &self.mechanics.symbols.get(velocity).code;
            self.builder.name(value, code);
            environment.values.insert(velocity, value);
        }
        solution
    }

    /// Returns the names of a frame's coordinates, without `theta_`.
    pub(super) fn coordinate_names(&self, frame: &Frame) -> Vec<String> {
        frame
            .coordinates
            .iter()
            .map(|&c| {
                let code = &self.mechanics.symbols.get(c).code;
                code.strip_prefix("theta_").unwrap_or(code).to_owned()
            })
            .collect()
    }

    /// Returns the entries of the frame's mass matrix as named values.
    pub(super) fn mass_matrix(&mut self, environment: &mut Environment<'_>) -> Matrix {
        let names = self.coordinate_names(environment.frame);
        let matrix = self.matrix(environment, &environment.frame.mass);
        for (&(row, column), &value) in &matrix {
            let name = format!("mass_{}_{}", names[row], names[column]);
            self.builder.name(value, &name);
        }
        matrix
    }

    /// Returns the entries of a matrix as values.
    pub(super) fn matrix(
        &mut self,
        environment: &mut Environment<'_>,
        entries: &[MatrixEntry],
    ) -> Matrix {
        entries
            .iter()
            .map(|entry| {
                let value = self.expr(environment, &entry.value);
                ((entry.row, entry.column), value)
            })
            .collect()
    }

    /// Returns an expression as a value. Sums start with a positive term if they have one, so that
    /// no operation is spent on a sign.
    pub(super) fn expr(&mut self, environment: &mut Environment<'_>, expr: &Expr) -> ValueId {
        match expr {
            Expr::Number(number) => self.builder.number(number.clone()),
            Expr::Symbol(symbol) => self.symbol(environment, *symbol),
            Expr::Sum(terms) => {
                let terms: Vec<(bool, ValueId)> = terms
                    .iter()
                    .map(|term| self.term(environment, term))
                    .collect();
                let first = terms.iter().position(|&(negative, _)| !negative);
                let (negative, mut sum) = terms[first.unwrap_or(0)];
                for (index, &(minus, value)) in terms.iter().enumerate() {
                    if index == first.unwrap_or(0) {
                        continue;
                    }
                    sum = if minus == negative {
                        self.builder.add(sum, value)
                    } else {
                        self.builder.sub(sum, value)
                    };
                }
                if negative { self.builder.neg(sum) } else { sum }
            }
            term => {
                let (negative, value) = self.term(environment, term);
                if negative {
                    self.builder.neg(value)
                } else {
                    value
                }
            }
        }
    }
}
