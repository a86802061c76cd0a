//! Entry points of observables: values and rates.

use super::ValueId;
use super::entry_list::EntryList;
use super::lower::{Environment, Lowering};
use super::nested_observables::NestedObservables;
use crate::functions::{Argument, CANONICAL, EntryState, ObservableForm, Purpose};
use crate::mechanics::expression::{Expr, SymbolId};
use crate::mechanics::{Frame, LinearSystem, Mechanics, ObservableFrame};
use crate::scene::{Function, Scene};

impl Lowering<'_> {
    /// The value of a symbol that only observables have.
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

    /// Solves a system with the mass matrix and hands its unknowns over.
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

/// The arguments and environments of one frame.
struct Ways<'a> {
    /// Supply from coordinates and velocities.
    motion: Environment<'a>,
    /// Supply from coordinates and momenta.
    phase: Environment<'a>,
    /// The solver with the mass matrix, on nested trees.
    nested: Option<NestedObservables<'a>>,
}

impl EntryList<'_, '_> {
    /// Value and rate of every observable.
    pub(super) fn observables(&mut self, scene: &Scene, mechanics: &Mechanics) {
        use Argument::{AbsoluteMomenta, Coordinates, Momenta, Omega, Rates, Theta};
        let observables = &mechanics.observables;
        if observables.list.is_empty() {
            return;
        }
        let mut absolute = self.ways(
            &mechanics.absolute,
            &observables.absolute,
            Purpose::Accelerations,
            ([Theta, Omega], [Theta, AbsoluteMomenta]),
        );
        let asked = observables.list.iter().any(|o| o.symmetric);
        let symmetric = mechanics.symmetric.as_ref().filter(|_| asked);
        let mut symmetric = symmetric.map(|frame| {
            let used = &observables.symmetric;
            let mut ways = self.ways(
                frame,
                used,
                Purpose::SymmetricAccelerations,
                ([Coordinates, Rates], [Coordinates, Momenta]),
            );
            // Only the names of the frame are derived then.
            if frame.mass.is_empty()
                && let Some(sectors) = &mechanics.sectors
            {
                let nested = NestedObservables::new(self.lowering, scene, sectors);
                nested.supply(self.lowering, used, &mut ways.motion, EntryState::Rates);
                if scene.requests.momenta {
                    nested.supply(self.lowering, used, &mut ways.phase, CANONICAL);
                }
                ways.nested = Some(nested);
            }
            ways
        });
        for (number, observable) in observables.list.iter().enumerate() {
            let ways = match (&mut symmetric, observable.symmetric) {
                (Some(symmetric), true) => symmetric,
                _ => &mut absolute,
            };
            self.observable(mechanics, number, ways);
        }
    }

    fn ways<'a>(
        &mut self,
        frame: &'a Frame,
        used: &'a ObservableFrame,
        solved: Purpose,
        (velocities, momenta): ([Argument; 2], [Argument; 2]),
    ) -> Ways<'a> {
        let mut motion = Environment::new(frame, velocities[0], Some(velocities[1]), None);
        let mut phase = Environment::new(frame, momenta[0], None, Some(momenta[1]));
        motion.observed = Some(used);
        phase.observed = Some(used);
        // The accelerations are solved for anyway.
        if let Some(entry) = self.entries.iter().find(|entry| entry.purpose == solved) {
            for (&symbol, &value) in used.accelerations.iter().zip(&entry.outputs) {
                motion.supply(symbol, value);
            }
        }
        if let Some(system) = &used.friction {
            self.lowering.solve_system(&mut motion, system);
        }
        Ways {
            motion,
            phase,
            nested: None,
        }
    }

    fn observable(&mut self, mechanics: &Mechanics, number: usize, ways: &mut Ways<'_>) {
        let observable = &mechanics.observables.list[number];
        use ObservableForm::{FrictionRate, FromMomenta, Rate, RateFromMomenta, Value};
        let motion = &mut ways.motion;
        self.form(number, Value, motion, &observable.value);
        self.form(number, Rate, motion, &observable.rate);
        if !observable.friction.is_zero() {
            self.form(number, FrictionRate, motion, &observable.friction);
        }
        if let Some(canonical) = &observable.canonical {
            let phase = &mut ways.phase;
            self.form(number, FromMomenta, phase, &observable.value);
            if let Some(system) = &canonical.adjoint {
                match &ways.nested {
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
