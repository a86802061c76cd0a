//! The resonant normal form of degree 4: docs and formulas.

use super::Emission;
use crate::functions::NormalFormFunction;
use crate::mechanics::NormalFormFormulas;
use crate::mechanics::expression::{NamedFormula, SymbolId};

impl Emission<'_> {
    /// Returns the normal form, which every scene with such an entry has.
    fn normal_form(&self) -> &NormalFormFormulas {
        match &self.mechanics.normal_form {
            Some(form) => form,
            None => unreachable!("an entry of a normal form that was not derived"),
        }
    }

    /// Returns the number of actions.
    pub(super) fn action_count(&self) -> usize {
        self.normal_form().actions.len()
    }

    /// Returns the documentation of a function of the normal form.
    pub(super) fn normal_form_meaning(&self, function: NormalFormFunction) -> Vec<String> {
        let form = self.normal_form();
        let modes = match form.actions.len() {
            1 => "of the in-phase mode",
            _ => "of the in-phase modes, the slow one + and the fast one −,",
        };
        let letters = "Other letters are those of [`normal_form_frequencies`](Self::normal_form_frequencies).";
        let resonance = "by the resonance 2 ω_d ≈ ω_+ + ω_− in the normal form of degree 4, at `actions` (in J s)";
        let (first, second) = match function {
            NormalFormFunction::Actions => (
                format!(
                    "Actions I (in J s) {modes} of a release from rest at angles `theta` (in rad), to second order in the angles, with the amplitudes a (in rad) of the first link."
                ),
                letters.to_owned(),
            ),
            NormalFormFunction::Frequencies => {
                let difference = match form.growth {
                    Some(_) => ", followed by that of a small difference d between copies",
                    None => "",
                };
                (
                    format!(
                        "Frequencies ω = ∂H/∂I (in rad/s) {modes} at `actions` I (in J s){difference}, by the normal form of degree 4: linear frequencies Ω with shifts that are linear in the actions."
                    ),
                    "Friction and drive are neglected, and NaN is returned if the tree is not stable at rest, or if its links move independently. `analysis::normal_form` of the runtime computes higher degrees.".to_owned(),
                )
            }
            NormalFormFunction::Coupling => (
                format!(
                    "Coupling κ (in 1/s, of either sign) of a small difference between copies to the in-phase motion {resonance}."
                ),
                format!("It is the largest growth rate, which a difference has without detuning. {letters}"),
            ),
            NormalFormFunction::Growth => (
                format!(
                    "Square λ² of the growth rate (in 1/s²) of a small difference between copies {resonance}. The difference grows if it is positive: if the detuning δ is smaller than the coupling κ."
                ),
                format!("With viscous friction the rate is smaller by the decay rate of the difference. {letters}"),
            ),
            NormalFormFunction::Thresholds => (
                "Squares s² of the two factors by which a release from rest at angles `theta` (in rad) must be multiplied to be at the threshold of growth, |δ| = |κ|, by the normal form of degree 4 with actions to second order.".to_owned(),
                format!("A small difference between copies grows from releases between the two factors. If one of the squares is negative, it grows beyond the other factor; if both are, it does not grow. The critical angle of a link is its angle times a factor. The result holds for small angles and near the resonance only: `analysis::normal_form` of the runtime has higher degrees and error bars. {letters}"),
            ),
        };
        vec![first, String::new(), second]
    }

    /// Returns the formulas of a function of the normal form. Those of the linear modes are listed with
    /// the frequencies only.
    pub(super) fn normal_form_formulas(&self, function: NormalFormFunction) -> Vec<NamedFormula> {
        let form = self.normal_form();
        let actions = form.actions.iter().copied().collect();
        let symbols = &self.mechanics.symbols;
        let of_modes = form.needed(&form.frequencies, &actions).into_iter();
        let mut known = of_modes.collect::<std::collections::BTreeSet<SymbolId>>();
        let growth = form.growth.as_ref();
        let wanted: Vec<SymbolId> = match function {
            NormalFormFunction::Frequencies => {
                known = actions;
                form.frequencies.clone()
            }
            NormalFormFunction::Actions => form.actions.clone(),
            NormalFormFunction::Coupling => growth.map(|own| own.coupling).into_iter().collect(),
            NormalFormFunction::Growth => growth.map(|own| own.rate_squared).into_iter().collect(),
            NormalFormFunction::Thresholds => {
                growth.map_or_else(Vec::new, |own| own.thresholds.to_vec())
            }
        };
        if matches!(
            function,
            NormalFormFunction::Coupling | NormalFormFunction::Growth
        ) {
            known.extend(&form.actions);
        }
        form.formulas(symbols, &wanted, &known)
    }
}
