//! Converts observables (expressions of the user) to formulas in the symbols of one frame.

use super::algebra::{AlgebraError, Formula};
use super::derivation::Derivation;
use super::expression::{Role, SymbolId};
use super::frame::DerivedFrame;
use super::meaning::CompositeObservable;
use super::print;
use crate::scene::{
    Coordinate, CoordinateIndex, Function, LinkId, Observed, ObservedAtom, Variable, VariableKind,
};

/// Frame in which an observable is expressed; all its variables are those of this frame.
pub(super) struct Setting<'a> {
    pub(super) frame: &'a DerivedFrame,
    /// Symmetric coordinates, if the frame uses them.
    pub(super) coordinates: Option<&'a [Coordinate]>,
    /// Name of the observable, for messages.
    pub(super) name: &'a str,
}

impl Setting<'_> {
    /// Returns the divisor, or an error if it is zero.
    fn divisor(&self, formula: Formula) -> Result<Formula, AlgebraError> {
        if formula.expand().is_zero() {
            let observable = self.name.to_owned();
            return Err(AlgebraError::DivisionByZero { observable });
        }
        Ok(formula)
    }

    /// Expresses a variable in the variables of the frame. With θ = J q also ω = J q̇; momenta
    /// transform as p_θ = J (JᵀJ)⁻¹ p, where JᵀJ is diagonal.
    fn variable(&self, variable: &Variable) -> Formula {
        let symbols = match variable.kind {
            VariableKind::Angle => &self.frame.coordinates,
            VariableKind::Velocity => &self.frame.velocities,
            VariableKind::Momentum => &self.frame.momenta,
        };
        let (link, coordinates) = match (variable.coordinate, self.coordinates) {
            (CoordinateIndex::Absolute(link), Some(coordinates)) => (link, coordinates),
            (CoordinateIndex::Absolute(index) | CoordinateIndex::Symmetric(index), _) => {
                return Formula::symbol(symbols[index]);
            }
        };
        coordinates
            .iter()
            .zip(symbols)
            .filter_map(|(coordinate, &symbol)| {
                let &(_, weight) = coordinate
                    .weights
                    .iter()
                    .find(|(l, _)| *l == LinkId(link))?;
                let norm = match variable.kind {
                    VariableKind::Momentum => coordinate.norm(),
                    VariableKind::Angle | VariableKind::Velocity => 1,
                };
                let weight = &Formula::integer(weight) / &Formula::integer(norm);
                Some(&weight * &Formula::symbol(symbol))
            })
            .sum()
    }
}

impl Derivation<'_> {
    /// Returns the formula of an observable without multiplying it out, which would make it longer
    /// and could lose digits.
    ///
    /// # Errors
    /// [`AlgebraError::DivisionByZero`].
    pub(super) fn observed(
        &mut self,
        setting: &Setting<'_>,
        observed: &Observed,
    ) -> Result<Formula, AlgebraError> {
        let divisor = |below: Formula| setting.divisor(below);
        Formula::of(
            observed,
            &mut |atom| self.observed_atom(setting, atom),
            &divisor,
        )
    }

    fn observed_atom(
        &mut self,
        setting: &Setting<'_>,
        atom: &ObservedAtom,
    ) -> Result<Formula, AlgebraError> {
        Ok(match atom {
            ObservedAtom::Known(quantity) => self.quantity(quantity),
            ObservedAtom::Variable(variable) => setting.variable(variable),
            ObservedAtom::Constant(name) => self.constant_called(name),
            ObservedAtom::KineticEnergy if setting.frame.has_symbols_alone() => {
                Formula::symbol(self.energies(setting.frame).kinetic)
            }
            ObservedAtom::PotentialEnergy if setting.frame.has_symbols_alone() => {
                Formula::symbol(self.energies(setting.frame).potential)
            }
            ObservedAtom::KineticEnergy => {
                let terms = setting.frame.kinetic_terms().map(|(_, _, term)| term);
                terms.sum::<Formula>().expand()
            }
            ObservedAtom::PotentialEnergy => setting.frame.potential.clone(),
            ObservedAtom::Call(function, argument) => {
                let argument = self.observed(setting, argument)?;
                self.call(setting, *function, argument)
            }
        })
    }

    /// Returns the model's constant with this name; zero if the model does not have it.
    fn constant_called(&self, name: &str) -> Formula {
        let found = self
            .symbols
            .iter()
            .find(|(_, symbol)| symbol.role == Role::Constant && symbol.code == name);
        found.map_or_else(Formula::zero, |(id, _)| Formula::symbol(id))
    }

    /// Returns a function of a formula. Sines and cosines that the mechanics already has are
    /// reused.
    fn call(&mut self, setting: &Setting<'_>, function: Function, argument: Formula) -> Formula {
        if argument.is_zero() {
            return match function {
                Function::Sin | Function::Sqrt => argument,
                Function::Cos => Formula::integer(1),
            };
        }
        if let Some(known) = self.known_call(setting, function, &argument) {
            return known;
        }
        let known = self
            .composites
            .iter()
            .find(|(_, known)| known.function == function && known.argument == argument);
        if let Some((&symbol, _)) = known {
            return Formula::symbol(symbol);
        }
        match function {
            Function::Sqrt => {
                let root = self.composite_symbol(setting, function, &argument);
                self.record_composite(root, function, argument, root);
                Formula::symbol(root)
            }
            Function::Sin | Function::Cos => {
                let sin = self.composite_symbol(setting, Function::Sin, &argument);
                let cos = self.composite_symbol(setting, Function::Cos, &argument);
                self.record_composite(sin, Function::Sin, argument.clone(), cos);
                self.record_composite(cos, Function::Cos, argument, sin);
                Formula::symbol(if function == Function::Sin { sin } else { cos })
            }
        }
    }

    /// Returns the existing sine or cosine of a coordinate, or of a difference of two in the mass
    /// matrix.
    fn known_call(
        &self,
        setting: &Setting<'_>,
        function: Function,
        argument: &Formula,
    ) -> Option<Formula> {
        let choose = |cos: Formula, sin: Formula| match function {
            Function::Sin => Some(sin),
            Function::Cos => Some(cos),
            Function::Sqrt => None,
        };
        for &coordinate in &setting.frame.coordinates {
            if *argument == Formula::symbol(coordinate) {
                return choose(
                    self.cosine(coordinate),
                    Formula::symbol(self.sin(coordinate)),
                );
            }
        }
        for (&(a, b), &(cos, sin)) in &self.of_two {
            let difference = &Formula::symbol(a) - &Formula::symbol(b);
            if *argument == difference {
                return choose(Formula::symbol(cos), Formula::symbol(sin));
            }
            if *argument == -difference {
                return choose(Formula::symbol(cos), -Formula::symbol(sin));
            }
        }
        None
    }

    fn composite_symbol(
        &mut self,
        setting: &Setting<'_>,
        function: Function,
        argument: &Formula,
    ) -> SymbolId {
        let argument = argument.to_expr(&self.symbols);
        let inside = print::text(&argument, &self.symbols);
        let inside_latex = print::latex(&argument, &self.symbols);
        let (mut text, latex) = match function {
            Function::Sqrt => (format!("√({inside})"), format!("\\sqrt{{{inside_latex}}}")),
            Function::Sin | Function::Cos => (
                format!("{}({inside})", function.name()),
                format!("\\{}\\left({inside_latex}\\right)", function.name()),
            ),
        };
        // A parameter may have the spelling of another symbol.
        while self.symbols.find(&text).is_some() {
            text.push('′');
        }
        let code = format!("{}_{}", function.name(), setting.name);
        self.symbols.intern(Role::Derived, &code, &text, &latex)
    }

    fn record_composite(
        &mut self,
        symbol: SymbolId,
        function: Function,
        argument: Formula,
        partner: SymbolId,
    ) {
        let composite = CompositeObservable {
            function,
            argument,
            partner,
        };
        self.composites.insert(symbol, composite);
    }

    /// Returns the derivative of a function of an expression, by the chain rule.
    pub(super) fn composite_slope(
        &self,
        symbol: SymbolId,
        composite: &CompositeObservable,
        variable: SymbolId,
    ) -> Formula {
        let inner = self.partial(&composite.argument, variable);
        let outer = match composite.function {
            Function::Sin => Formula::symbol(composite.partner),
            Function::Cos => -Formula::symbol(composite.partner),
            Function::Sqrt => (&Formula::integer(2) * &Formula::symbol(symbol)).pow(-1),
        };
        &outer * &inner
    }
}
