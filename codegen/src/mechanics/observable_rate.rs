//! Rates of change of observables, in two forms (docs/physics.md §7).
//!
//! The first form uses coordinates and velocities and applies the chain rule along the motion:
//!
//! ```text
//! dF/dt = Σ ∂F/∂q_i v_i + Σ ∂F/∂p_i (∂L/∂q_i + Q_i) + Σ ∂F/∂v_i a_i
//! ```
//!
//! with the accelerations a from the equations of motion, and friction and drag Q. The second form
//! uses coordinates and momenta and takes the Poisson bracket of F(q, p, v(q, p)) with H. Because M
//! v = p, a velocity in F has the derivatives ∂v/∂p = M⁻¹ and ∂v/∂q_i = −M⁻¹ (∂_i M) v. With M y =
//! ∂F/∂v follows
//!
//! ```text
//! {F, H} = Σ ∂F/∂q_i v_i − Σ (∂F/∂p_i + y_i) ∂H/∂q_i − Σ y_i (Ṁ v)_i
//! ∂H/∂q_i = −½ vᵀ (∂_i M) v + ∂U/∂q_i
//! ```
//!
//! and friction adds Σ (∂F/∂p_i + y_i) Q_i. This takes one solve with the mass matrix of the
//! velocities and no acceleration; M is never inverted in a formula. The drive's forces are added
//! to ∂L/∂q and subtracted from ∂H/∂q. For nested copies in symmetric coordinates, forces, slopes
//! and energies remain symbols, whose values the program computes on means and differences.

use super::algebra::{AlgebraError, Formula};
use super::derivation::Derivation;
use super::expression::{Role, SymbolId};
use super::frame::DerivedFrame;
use super::observable::Setting;
use super::observables::{
    AppliedFunction, CanonicalRate, LinearSystem, NestedSymbols, ObservableFormulas,
    ObservableFrame, Observables,
};
use super::print::latex_name;
use super::rate_symbols::RateSymbols;
use crate::scene::Coordinate;
use std::collections::{BTreeMap, BTreeSet};

/// Gradients of an observable, in the order of the coordinates.
struct Gradients {
    coordinates: Vec<Formula>,
    velocities: Vec<Formula>,
    momenta: Vec<Formula>,
}

impl Derivation<'_> {
    /// Derives all observables of the scene.
    ///
    /// # Errors
    /// [`AlgebraError::DivisionByZero`].
    pub(super) fn observables(
        &mut self,
        absolute: &DerivedFrame,
        symmetric: Option<(&DerivedFrame, &[Coordinate])>,
    ) -> Result<Observables, AlgebraError> {
        let scene = self.scene;
        let mut observables = Observables::default();
        for wants_symmetric in [false, true] {
            let (frame, coordinates) = match (wants_symmetric, symmetric) {
                (false, _) => (absolute, None),
                (true, Some((frame, coordinates))) => (frame, Some(coordinates)),
                (true, None) => continue,
            };
            let chosen: Vec<_> = scene
                .observables
                .iter()
                .filter(|observable| observable.value.is_symmetric() == wants_symmetric)
                .collect();
            if chosen.is_empty() {
                continue;
            }
            let symbols = self.rate_symbols(absolute, frame, coordinates);
            let mut list = Vec::new();
            for observable in chosen {
                let setting = Setting {
                    frame,
                    coordinates,
                    name: &observable.name,
                };
                let value = self.observed(&setting, &observable.value)?;
                list.push(self.observable(&setting, &symbols, &value));
            }
            let used = self.observable_frame(frame, &symbols, &list);
            match wants_symmetric {
                false => observables.absolute = used,
                true => observables.symmetric = used,
            }
            observables.list.extend(list);
        }
        let place = |name: &String| scene.observables.iter().position(|o| o.name == *name);
        observables
            .list
            .sort_by_key(|observable| place(&observable.name));
        observables.functions = self
            .composites
            .iter()
            .map(|(&symbol, composite)| {
                let argument = self.expr(&composite.argument);
                let function = composite.function;
                (symbol, AppliedFunction { function, argument })
            })
            .collect();
        Ok(observables)
    }

    fn observable(
        &mut self,
        setting: &Setting<'_>,
        symbols: &RateSymbols,
        value: &Formula,
    ) -> ObservableFormulas {
        let frame = setting.frame;
        let along = |derivation: &Self, symbols: &[SymbolId]| -> Vec<Formula> {
            symbols
                .iter()
                .map(|&symbol| derivation.partial(value, symbol))
                .collect()
        };
        let gradients = Gradients {
            coordinates: along(self, &frame.coordinates),
            velocities: along(self, &frame.velocities),
            momenta: along(self, &frame.momenta),
        };
        let drift = dot(&gradients.coordinates, &frame.velocities);
        let torque = symbols.torque(&gradients.momenta);
        let force = dot(&gradients.momenta, &symbols.forces);
        let acceleration = dot(&gradients.velocities, &symbols.accelerations);
        let rate = [drift, force, torque.clone(), acceleration];
        let friction = match symbols.has_torque.contains(&true) {
            true => &torque + &dot(&gradients.velocities, &symbols.friction_accelerations),
            false => torque,
        };
        ObservableFormulas {
            name: setting.name.to_owned(),
            symmetric: setting.coordinates.is_some(),
            value: self.expr(value),
            rate: self.expr(&rate.into_iter().sum()),
            friction: self.expr(&friction),
            canonical: self
                .scene
                .requests
                .momenta
                .then(|| self.canonical(setting, symbols, &gradients)),
        }
    }

    /// Returns the rate {F, H} + Σ (∂F/∂p_i + y_i) Q_i.
    fn canonical(
        &mut self,
        setting: &Setting<'_>,
        symbols: &RateSymbols,
        gradients: &Gradients,
    ) -> CanonicalRate {
        let frame = setting.frame;
        let moving = gradients.velocities.iter().any(|slope| !slope.is_zero());
        let adjoint: Vec<SymbolId> = match moving {
            true => self.indexed_symbols(
                frame,
                Role::Derived,
                &format!("adjoint_{}", setting.name),
                |name| format!("y_{},{name}", setting.name),
                |name| format!("y_{{\\mathrm{{{},{name}}}}}", latex_name(setting.name)),
            ),
            false => Vec::new(),
        };
        let unknowns: Vec<Formula> = adjoint.iter().map(|&y| Formula::symbol(y)).collect();
        let mut momenta = gradients.momenta.clone();
        for (slope, y) in momenta.iter_mut().zip(&unknowns) {
            *slope = &*slope + y;
        }
        let rate = [
            dot(&gradients.coordinates, &frame.velocities),
            dot(&opposite(&momenta), &symbols.slopes),
            dot(&opposite(&unknowns), &symbols.changes),
            symbols.torque(&momenta),
        ];
        CanonicalRate {
            rate: self.expr(&rate.into_iter().sum()),
            adjoint: moving.then(|| LinearSystem {
                unknowns: adjoint,
                right: self.exprs(&gradients.velocities),
            }),
        }
    }

    /// Returns those symbols used by observables whose values the program computes without a
    /// formula.
    fn nested_symbols(
        &self,
        symbols: &RateSymbols,
        uses: impl Fn(&[SymbolId]) -> bool,
    ) -> NestedSymbols {
        let formed = |symbols: &[SymbolId]| match uses(symbols) {
            true => symbols.to_vec(),
            false => Vec::new(),
        };
        NestedSymbols {
            forces: formed(&symbols.forces),
            torques: formed(&symbols.torques),
            friction_accelerations: formed(&symbols.friction_accelerations),
            slopes: formed(&symbols.slopes),
            changes: formed(&symbols.changes),
            energies: self.energies.clone(),
        }
    }

    /// Returns the symbols and definitions that the observables of a frame use.
    fn observable_frame(
        &self,
        frame: &DerivedFrame,
        symbols: &RateSymbols,
        list: &[ObservableFormulas],
    ) -> ObservableFrame {
        let used = self.symbols_of_observables(list);
        let uses = |symbols: &[SymbolId]| symbols.iter().any(|symbol| used.contains(symbol));
        let accelerations = match uses(&symbols.accelerations) {
            true => symbols.accelerations.clone(),
            false => Vec::new(),
        };
        if frame.has_symbols_alone() {
            return ObservableFrame {
                accelerations,
                nested: self.nested_symbols(symbols, uses),
                ..ObservableFrame::default()
            };
        }
        let mut definitions = BTreeMap::new();
        let mut define = |symbols: &[SymbolId], values: &dyn Fn() -> Vec<Formula>| {
            if !uses(symbols) {
                return;
            }
            for (&symbol, value) in symbols.iter().zip(values()) {
                if used.contains(&symbol) {
                    definitions.insert(symbol, self.expr(&value));
                }
            }
        };
        let torques = || -> Vec<Formula> { frame.dissipative_forces(self) };
        // At fixed time the drive acts like a force of the Lagrangian.
        let with_drive = |forces: Vec<Formula>, sign: i64| -> Vec<Formula> {
            let drive = frame.drive_forces(self);
            let both = forces.iter().zip(&drive);
            both.map(|(force, drive)| force + &(&Formula::integer(sign) * drive))
                .collect()
        };
        define(&symbols.forces, &|| with_drive(frame.forces(self), 1));
        define(&symbols.torques, &torques);
        define(&symbols.slopes, &|| {
            with_drive(frame.hamiltonian_slopes(self), -1)
        });
        define(&symbols.changes, &|| frame.mass_changes(self));
        ObservableFrame {
            accelerations,
            nested: NestedSymbols::default(),
            friction: uses(&symbols.friction_accelerations).then(|| LinearSystem {
                unknowns: symbols.friction_accelerations.clone(),
                right: self.exprs(&torques()),
            }),
            definitions,
            momentum: match uses(&frame.momenta) {
                true => self.exprs(&frame.momentum()),
                false => Vec::new(),
            },
        }
    }

    /// Returns the symbols that occur in observables and their rates.
    fn symbols_of_observables(&self, list: &[ObservableFormulas]) -> BTreeSet<SymbolId> {
        let mut used = BTreeSet::new();
        let mut note = |symbol| {
            used.insert(symbol);
        };
        for observable in list {
            for expr in [&observable.value, &observable.rate, &observable.friction] {
                expr.for_each_symbol(&mut note);
            }
            if let Some(canonical) = &observable.canonical {
                canonical.rate.for_each_symbol(&mut note);
                for right in canonical.adjoint.iter().flat_map(|system| &system.right) {
                    right.for_each_symbol(&mut note);
                }
            }
        }
        for composite in self.composites.values() {
            composite.argument.symbols().into_iter().for_each(&mut note);
        }
        used
    }
}

fn opposite(formulas: &[Formula]) -> Vec<Formula> {
    formulas.iter().map(|formula| -formula.clone()).collect()
}

/// Returns Σ slope_i symbol_i.
fn dot(slopes: &[Formula], symbols: &[SymbolId]) -> Formula {
    slopes
        .iter()
        .zip(symbols)
        .map(|(slope, &symbol)| slope * &Formula::symbol(symbol))
        .sum()
}
