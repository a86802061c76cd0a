//! Entry points for the values and rates of observables.

use super::ValueId;
use super::entry_list::EntryList;
use super::lower::{Environment, Lowering};
use super::nested_observables::NestedObservables;
use crate::functions::{Argument, CANONICAL, EntryState, ObservableForm, Purpose};
use crate::mechanics::expression::{Expr, SymbolId};
use crate::mechanics::{Frame, LinearSystem, Mechanics, ObservableFrame};
use crate::scene::{Function, Scene};

impl Lowering<'_> {
    /// Returns the value of a symbol that occurs in observables only.
    pub(super) fn observed(
        &mut self,
        environment: &mut Environment<'_>,
        symbol: SymbolId,
    ) -> Option<ValueId> {
        let mechanics = self.mechanics;
        if let Some(call) = mechanics.observables.functions.get(&symbol) {
            let argument = self.expr(environment, &call.argument);
            return Some(match call.function {
                Function::Sin => self.builder.sin(argument),
                Function::Cos => self.builder.cos(argument),
                Function::Sqrt => self.builder.sqrt(argument),
            });
        }
        let definition = environment.observed?.definitions.get(&symbol)?;
        Some(self.expr(environment, definition))
    }

    /// Solves a system with the mass matrix and sets the values of its unknowns.
    fn solve_system(&mut self, environment: &mut Environment<'_>, system: &LinearSystem) {
        let matrix = self.mass_matrix(environment);
        let right = system
            .right
            .iter()
            .map(|right| self.expr(environment, right))
            .collect();
        let names = self.coordinate_names(environment.frame);
        let solution = self.builder.solve(matrix, right, &names);
        for (&symbol, &value) in system.unknowns.iter().zip(&solution) {
            let code = &self.mechanics.symbols.get(symbol).code;
            self.builder.name(value, code);
            environment.supply(symbol, value);
        }
    }
}

/// Environments of one frame, for the two sets of arguments.
struct Environments<'a> {
    /// Environment with coordinates and velocities as arguments.
    motion: Environment<'a>,
    /// Environment with coordinates and momenta as arguments.
    phase: Environment<'a>,
    /// Solver with the mass matrix, for nested copies.
    nested: Option<NestedObservables<'a>>,
}

impl EntryList<'_, '_> {
    /// Adds value and rate of every observable.
    pub(super) fn observables(&mut self, scene: &Scene, mechanics: &Mechanics) {
        use Argument::{AbsoluteMomenta, Coordinates, Momenta, Omega, Rates, Theta};
        let observables = &mechanics.observables;
        if observables.list.is_empty() {
            return;
        }
        let mut absolute = self.environments(
            &mechanics.absolute,
            &observables.absolute,
            Purpose::Accelerations,
            ([Theta, Omega], [Theta, AbsoluteMomenta]),
        );
        let asked = observables.list.iter().any(|o| o.symmetric);
        let symmetric = mechanics.symmetric.as_ref().filter(|_| asked);
        let mut symmetric = symmetric.map(|frame| {
            let used = &observables.symmetric;
            let mut environments = self.environments(
                frame,
                used,
                Purpose::SymmetricAccelerations,
                ([Coordinates, Rates], [Coordinates, Momenta]),
            );
            // In this case only the names of the frame are derived.
            if frame.mass.is_empty()
                && let Some(sectors) = &mechanics.sectors
            {
                let nested = NestedObservables::new(self.lowering, scene, sectors);
                nested.supply(
                    self.lowering,
                    used,
                    &mut environments.motion,
                    EntryState::Rates,
                );
                if scene.requests.momenta {
                    nested.supply(self.lowering, used, &mut environments.phase, CANONICAL);
                }
                environments.nested = Some(nested);
            }
            environments
        });
        for (number, observable) in observables.list.iter().enumerate() {
            let environments = match (&mut symmetric, observable.symmetric) {
                (Some(symmetric), true) => symmetric,
                _ => &mut absolute,
            };
            self.observable(mechanics, number, environments);
        }
    }

    fn environments<'a>(
        &mut self,
        frame: &'a Frame,
        used: &'a ObservableFrame,
        solved: Purpose,
        (velocities, momenta): ([Argument; 2], [Argument; 2]),
    ) -> Environments<'a> {
        let mut motion = Environment::new(frame, velocities[0], Some(velocities[1]), None);
        let mut phase = Environment::new(frame, momenta[0], None, Some(momenta[1]));
        motion.observed = Some(used);
        phase.observed = Some(used);
        // The accelerations are computed already.
        if let Some(entry) = self.entries.iter().find(|entry| entry.purpose == solved) {
            for (&symbol, &value) in used.accelerations.iter().zip(&entry.outputs) {
                motion.supply(symbol, value);
            }
        }
        if let Some(system) = &used.friction {
            self.lowering.solve_system(&mut motion, system);
        }
        Environments {
            motion,
            phase,
            nested: None,
        }
    }

    fn observable(
        &mut self,
        mechanics: &Mechanics,
        number: usize,
        environments: &mut Environments<'_>,
    ) {
        let observable = &mechanics.observables.list[number];
        use ObservableForm::{FrictionRate, FromMomenta, Rate, RateFromMomenta, Value};
        let motion = &mut environments.motion;
        self.form(number, Value, motion, &observable.value);
        self.form(number, Rate, motion, &observable.rate);
        if !observable.friction.is_zero() {
            self.form(number, FrictionRate, motion, &observable.friction);
        }
        if let Some(canonical) = &observable.canonical {
            let phase = &mut environments.phase;
            self.form(number, FromMomenta, phase, &observable.value);
            if let Some(system) = &canonical.adjoint {
                match &environments.nested {
                    Some(nested) => nested.solve(self.lowering, phase, system),
                    None => self.lowering.solve_system(phase, system),
                }
            }
            self.form(number, RateFromMomenta, phase, &canonical.rate);
        }
    }

    fn form(
        &mut self,
        number: usize,
        form: ObservableForm,
        environment: &mut Environment<'_>,
        expr: &Expr,
    ) {
        let value = self.lowering.expr(environment, expr);
        self.push(Purpose::Observable(number, form), vec![value]);
    }
}
