//! Formulas in docs, as text and as LaTeX.

use super::Emission;
use super::doc_text::broken;
use crate::mechanics;
use crate::mechanics::expression::{Expr, NamedFormula};
use crate::scene::PassiveTorques;

/// Largest number of formulas at which all of them are shown. It suffices for four links with
/// springs and friction.
const MOST_ROWS: usize = 24;
/// Number of formulas that are shown if there are more.
const ROWS: usize = 8;
/// Longest formula that is shown, in characters; the docs refer to `cargo branched-pendulum stage
/// mechanics` for longer ones.
const LONGEST_FORMULA: usize = 600;

impl Emission<'_> {
    pub(super) fn text(&self, expr: &Expr) -> String {
        mechanics::text(expr, &self.mechanics.symbols)
    }

    /// Returns true if some friction or drag is not viscous.
    pub(super) fn has_nonlinear_friction(&self) -> bool {
        let mut torques = self.scene.passive_torques();
        torques.any(|torques| !torques.is_viscous())
    }

    /// Returns a sentence that states whether differences that are zero remain zero.
    pub(super) fn fate_of_differences(&self) -> &'static str {
        match self.scene.couples_differences(&self.mechanics.coordinates) {
            false => "A difference stays exactly zero if it and its rate are zero.",
            true => "Forces between links couple the differences, so that they do not stay zero.",
        }
    }

    /// Explains the matrix D in formulas in symmetric coordinates.
    pub(super) fn braking_note(&self) -> &'static str {
        let mut links = self.scene.links.iter();
        match links.any(|link| !link.passive.is_viscous()) {
            true => {
                " In the formulas D are the means and differences of torques of friction that is not viscous."
            }
            false => "",
        }
    }

    /// Describes the rates of the momenta in words, with the torques that act in the scene.
    pub(super) fn momentum_rates_in_words(&self) -> String {
        let passive = || self.scene.passive_torques();
        let mut straight = self.scene.translational.iter();
        let dampers = straight.any(|own| !own.friction.is_zero());
        let friction = dampers || passive().any(PassiveTorques::has_friction);
        let present = [
            (friction, "friction"),
            (passive().any(PassiveTorques::has_drag), "drag"),
            (self.mechanics.drive.is_some(), "drive"),
        ];
        let present = present.into_iter().filter(|(present, _)| *present);
        let torques: Vec<&str> = present.map(|(_, name)| name).collect();
        match torques.split_last() {
            None => "∂L/∂θ".to_owned(),
            Some((last, [])) => format!("∂L/∂θ + Q with the torques Q of {last}"),
            Some((last, others)) => format!(
                "∂L/∂θ + Q with the torques Q of {} and {last}",
                others.join(", ")
            ),
        }
    }

    /// Adds formulas as a text block. Returns the number of formulas shown, which is 0 if one of
    /// them is too long.
    pub(super) fn show_text(
        &self,
        formulas: &[NamedFormula],
        most: usize,
        lines: &mut Vec<String>,
    ) -> usize {
        let texts: Vec<String> = formulas
            .iter()
            .map(|f| format!("{} = {}", f.left, self.text(&f.right)))
            .collect();
        if texts.is_empty() || texts.iter().any(|text| text.len() > LONGEST_FORMULA) {
            return 0;
        }
        let shown = texts.len().min(most);
        lines.push(String::new());
        lines.push("```text".into());
        lines.extend(texts[..shown].iter().flat_map(|text| broken(text)));
        if shown < texts.len() {
            lines.push(format!("… and {} more", texts.len() - shown));
        }
        lines.push("```".into());
        shown
    }

    /// Adds formulas as a text block, followed by LaTeX in a collapsed block.
    pub(super) fn show(&self, formulas: &[NamedFormula], lines: &mut Vec<String>) {
        let most = match formulas.len() <= MOST_ROWS {
            true => MOST_ROWS,
            false => ROWS,
        };
        let shown = self.show_text(formulas, most, lines);
        if shown == 0 {
            return;
        }
        lines.push(String::new());
        lines.push("<details><summary>LaTeX</summary>".into());
        lines.push(String::new());
        lines.push("```latex".into());
        lines.extend(formulas[..shown].iter().map(|f| {
            let right = mechanics::latex(&f.right, &self.mechanics.symbols);
            format!("{} = {right}", f.left_latex)
        }));
        lines.push("```".into());
        lines.push("</details>".into());
    }
}
