//! Docs of observables: meaning and formulas.

use super::Emission;
use crate::functions::ObservableForm;
use crate::mechanics::ObservableFormulas;
use crate::mechanics::expression::{Expr, NamedFormula, SymbolId};

impl Emission<'_> {
    pub(super) fn observable_meaning(&self, number: usize, form: ObservableForm) -> Vec<String> {
        let observable = &self.mechanics.observables.list[number];
        let name = &observable.name;
        let (state, canonical) = match observable.symmetric {
            true => (
                "`coordinates` (in rad) and their velocities `rates` (in rad/s)",
                "`coordinates` (in rad) and their momenta `momenta` (in kg m²/s)",
            ),
            false => (
                "angles `theta` (in rad) and angular velocities `omega` (in rad/s)",
                "angles `theta` (in rad) and momenta `momenta` (in kg m²/s)",
            ),
        };
        let written = self
            .scene
            .observables
            .iter()
            .find(|written| written.name == *name)
            .map(|written| written.value.display(&self.scene.parameters).to_string())
            .unwrap_or_default();
        let defined = || format!("Observable `{name}` = `{written}`");
        match form {
            ObservableForm::Value => vec![
                format!("{}, at {state}; SI units.", defined()),
                String::new(),
                format!("[`Self::{name}_rate`] is its rate of change."),
            ],
            ObservableForm::Rate => {
                let mut lines = vec![
                    format!(
                        "Rate of change of [`Self::{name}`] (in its unit per second) along the motion, at {state}."
                    ),
                    String::new(),
                    "Computed exactly by the chain rule: dF/dt = Σ ∂F/∂q q̇ + Σ ∂F/∂p (∂L/∂q + Q) + Σ ∂F/∂q̇ q̈; momenta count as M q̇, and accelerations follow from the equations of motion.".into(),
                ];
                if !observable.friction.is_zero() {
                    lines.push(String::new());
                    lines.push(format!(
                        "Friction and drag are included; their part is [`Self::{name}_friction_rate`]."
                    ));
                }
                lines
            }
            ObservableForm::FrictionRate => vec![format!(
                "The part of [`Self::{name}_rate`] caused by friction and drag Q, at {state}."
            )],
            ObservableForm::FromMomenta => vec![format!(
                "{}, at {canonical}. Velocities are found by solving a linear system; SI units.",
                defined()
            )],
            ObservableForm::RateFromMomenta => vec![
                format!(
                    "Rate of change of [`Self::{name}`] (in its unit per second) along the motion, at {canonical}."
                ),
                String::new(),
                "Computed from the Poisson bracket {F, H} and friction. Velocities in F count as M⁻¹ p; their chain rule uses the solution y of M y = ∂F/∂q̇.".into(),
            ],
        }
    }

    pub(super) fn observable_formulas(
        &self,
        number: usize,
        form: ObservableForm,
    ) -> Vec<NamedFormula> {
        let observable = &self.mechanics.observables.list[number];
        let named = |left: &str, left_latex: &str, right: &Expr| {
            let mut formulas = vec![NamedFormula::new(left, left_latex, right)];
            formulas.extend(self.definitions(observable, right));
            formulas
        };
        match (form, &observable.canonical) {
            (ObservableForm::Value | ObservableForm::FromMomenta, _) => {
                named("F", "F", &observable.value)
            }
            (ObservableForm::Rate, _) => named("dF/dt", "\\dot F", &observable.rate),
            (ObservableForm::FrictionRate, _) => {
                named("(dF/dt)_Q", "\\dot F_Q", &observable.friction)
            }
            (ObservableForm::RateFromMomenta, Some(canonical)) => {
                named("dF/dt", "\\dot F", &canonical.rate)
            }
            (ObservableForm::RateFromMomenta, None) => Vec::new(),
        }
    }

    /// Returns the definitions of the forces and other quantities that occur in the formula of a
    /// rate.
    fn definitions(&self, observable: &ObservableFormulas, rate: &Expr) -> Vec<NamedFormula> {
        let observables = &self.mechanics.observables;
        let used = match observable.symmetric {
            true => &observables.symmetric,
            false => &observables.absolute,
        };
        let mut symbols: Vec<SymbolId> = Vec::new();
        rate.for_each_symbol(&mut |symbol| {
            if !symbols.contains(&symbol) {
                symbols.push(symbol);
            }
        });
        symbols
            .iter()
            .filter_map(|symbol| Some((symbol, used.definitions.get(symbol)?)))
            .flat_map(|(symbol, value)| self.rows(&[*symbol], std::slice::from_ref(value)))
            .collect()
    }
}
