//! Tongues of growth, predicted by the normal form along lines across a plane of releases.

use std::fmt::Write;

use branched_pendulum::analysis::normal_form::{
    NormalFormOptions, Prediction, Refusal, Tongue, Tongues,
};
use branched_pendulum::analysis::variational::Copies;
use branched_pendulum_trees::{PendulumTree, TreeNormalForm};

use super::differences::differences_of;
use super::plane::{MapPlane, Point};
use crate::Failure;

/// Normal forms of the trees in a plane, for predictions.
pub(super) struct Theory<'a> {
    pub(super) options: NormalFormOptions,
    pub(super) copies: &'a Copies,
    /// Name of the tree.
    pub(super) name: &'a str,
    /// Smallest growth rate that counts as a tongue, in addition to the decay by friction, in 1/s.
    pub(super) least: f64,
}

/// Tongues along one line.
pub(super) struct PredictedLine {
    /// Value of the quantity that is constant along the line.
    pub(super) value: f64,
    /// Decay rate of small differences caused by friction, in 1/s.
    pub(super) decay: f64,
    pub(super) tongues: Tongues,
}

impl Theory<'_> {
    /// Derives the normal form of the in-phase motion of a tree.
    ///
    /// # Errors
    /// [`Failure::Tree`].
    pub(super) fn form(&self, tree: &PendulumTree) -> Result<TreeNormalForm, Failure> {
        let form = tree.normal_form(self.copies, self.options.clone());
        form.map_err(|source| Failure::tree(self.name, source))
    }

    /// Predicts the tongues on a line that runs along one axis of the plane (0 is `--x`).
    ///
    /// # Errors
    /// [`Failure`].
    pub(super) fn along(
        &self,
        plane: &MapPlane<'_>,
        line: &[Point],
        axis: usize,
    ) -> Result<PredictedLine, Failure> {
        let first = line.first().copied().unwrap_or([f64::NAN; 2]);
        let samples: Vec<f64> = line.iter().map(|point| point[axis]).collect();
        let tree = plane.tree_at(&first)?;
        let shared = match plane.is_parameter(axis) {
            true => None,
            false => Some(self.form(&tree)?),
        };
        let decay = differences_of(&tree, self.copies, Vec::new(), 1.0)?.decay();
        let predict = |value: f64| -> Result<Prediction, Refusal> {
            let mut point = first;
            point[axis] = value;
            let start = plane.start_at(&point);
            if let Some(form) = &shared {
                return form.predict(&start);
            }
            let failed = |error: Failure| Refusal::Failed {
                reason: error.to_string(),
            };
            let tree = plane.tree_at(&point).map_err(failed)?;
            self.form(&tree).map_err(failed)?.predict(&start)
        };
        Ok(PredictedLine {
            value: first[1 - axis],
            decay,
            tongues: Tongues::along(&samples, self.least + decay, predict),
        })
    }
}

impl PredictedLine {
    /// Appends the predicted tongues on the line along an axis, and its parts without predictions,
    /// to the text.
    pub(super) fn write(&self, text: &mut String, plane: &MapPlane<'_>, axis: usize) {
        let words = |value: f64| plane.words(axis, value);
        write_tongues(text, &self.tongues, self.decay, &words);
    }
}

/// Appends tongues, and parts without predictions, to the text. `words` formats a value on the
/// line; the decay by friction, `decay` (1/s), is subtracted from growth rates.
pub(super) fn write_tongues(
    text: &mut String,
    tongues: &Tongues,
    decay: f64,
    words: &dyn Fn(f64) -> String,
) {
    for tongue in &tongues.tongues {
        let [from, to] = [0, 1].map(|side| edge(tongue, side));
        let rate = tongue.largest.growth_rate;
        let resonance = tongue
            .resonance()
            .map_or(String::new(), ToString::to_string);
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "  {from} to {to}: {:.4} ± {:.4} 1/s at {}, by {resonance}",
            rate.value - decay,
            rate.error(),
            words(tongue.at)
        );
    }
    if tongues.tongues.is_empty() {
        text.push_str("  no tongue is predicted\n");
    }
    for ([from, to], refusal) in &tongues.refused {
        let [from, to] = [from, to].map(|value| words(*value));
        let _ = writeln!(text, "  no prediction from {from} to {to}: {refusal}");
    }
}

/// Returns an edge in words.
fn edge(tongue: &Tongue, side: usize) -> String {
    let edge = tongue.edges[side];
    match tongue.is_cut[side] {
        true => "open".to_owned(),
        false => format!("{:.2} ± {:.2}", edge.value, edge.error()),
    }
}
