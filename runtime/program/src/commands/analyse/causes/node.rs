//! An interpretation of a table with the motion that is estimated from it.

use super::super::arguments::Arguments;
use super::super::estimate::{Draws, Estimate, Measured};
use super::super::source::Source;
use super::super::verdict::Verdict;
use super::Unclosed;
use super::change::{Change, Kind};
use crate::Failure;
use crate::measured_file::MeasuredFile;

/// Number of draws for an interpretation that obviously does not close the budget.
const FEW: usize = 8;
/// Ratio of a gap by smoothness to the allowed one, up to which the equations of motion are tried
/// across rows that are left out.
const NEAR: f64 = 4.0;

/// An interpretation of the table, with the results that follow from it.
#[derive(Clone, Debug)]
pub(super) struct Node {
    /// The changes that led to this interpretation.
    pub(super) changes: Vec<Change>,
    pub(super) file: MeasuredFile,
    pub(super) source: Source,
    /// The motion estimated by smoothness only, unless equations of motion are used and it closes
    /// the budget.
    pub(super) estimate: Estimate,
    /// Number of draws from which its standard deviations are computed.
    pub(super) draws: usize,
    /// True if only the equations of motion, which were not requested, close the budget: smoothness
    /// bridges long gaps with too small error bars.
    pub(super) needs_model: bool,
    pub(super) verdict: Verdict,
}

impl Node {
    /// The gap in its deviations.
    pub(super) fn gap(&self) -> f64 {
        let squares = |part: usize| -> f64 {
            self.verdict
                .closure
                .iter()
                .map(|row| row[part] * row[part])
                .sum()
        };
        match squares(0) / squares(1) {
            ratio if ratio.is_finite() => ratio.sqrt(),
            _ => f64::INFINITY,
        }
    }

    pub(super) fn has(&self, kind: Kind) -> bool {
        self.changes.iter().any(|own| own.kind == kind)
    }
}

impl Unclosed<'_> {
    /// Returns the original interpretation of the record, estimated by smoothness.
    pub(super) fn root(&self) -> Result<Node, Failure> {
        let measured = Measured {
            subject: self.subject,
            record: self.source.record(),
        };
        let draws = self.arguments.draws as usize;
        let estimate = measured.by_smoothness(self.draws(draws))?;
        Ok(Node {
            changes: Vec::new(),
            file: self.arguments.measured.clone(),
            source: self.source.clone(),
            verdict: Verdict::of(&self.source.times, &estimate, draws),
            estimate,
            draws,
            needs_model: false,
        })
    }

    /// Returns an interpretation after one more change. `None` if the table cannot be read in this
    /// way or the change has no effect; the inner `None` if no motion can be estimated from it.
    pub(super) fn changed(&self, node: &Node, change: Change) -> Option<Option<Node>> {
        let source = self.read(&change.file)?;
        if source.angles == node.source.angles {
            return None;
        }
        let file = change.file.clone();
        let changes = [&node.changes[..], &[change]].concat();
        let Some((estimate, draws)) = self.estimate(&source) else {
            return Some(None);
        };
        let bridged = self.bridged(&source, &changes, &estimate, draws);
        let needs_model = bridged.is_some();
        let (estimate, draws) = bridged.unwrap_or((estimate, draws));
        Some(Some(Node {
            changes,
            file,
            verdict: Verdict::of(&source.times, &estimate, draws),
            source,
            estimate,
            draws,
            needs_model,
        }))
    }

    /// Returns the estimate by the equations of motion, with its number of draws, if it closes the
    /// budget of a record of which rows are left out and smoothness does not: smoothness bridges
    /// these rows with too small error bars. `None` otherwise.
    fn bridged(
        &self,
        source: &Source,
        changes: &[Change],
        smooth: &Estimate,
        draws: usize,
    ) -> Option<(Estimate, usize)> {
        let verdict = Verdict::of(&source.times, smooth, draws);
        let leaves_out = changes.iter().any(|own| own.kind.leaves_out());
        // Lost dots are tried anyway, since the equations also find friction.
        let is_likely = match changes {
            [
                Change {
                    kind: Kind::Lost, ..
                },
            ] => true,
            _ => verdict.bars < NEAR * verdict.allowed,
        };
        if verdict.closes() || !leaves_out || !is_likely || self.arguments.model {
            return None;
        }
        let measured = Measured {
            subject: self.subject,
            record: source.record(),
        };
        let all = self.arguments.draws as usize;
        let found = measured.by_model(smooth, self.draws(all)).ok()?;
        let closes = Verdict::of(&source.times, &found, all).closes();
        closes.then_some((found, all))
    }

    /// Returns an interpretation with the friction that comes nearest to closing the budget, with
    /// as many draws as needed.
    pub(super) fn with_friction(&self, node: &Node) -> Option<Node> {
        let braked = self.friction(node)?;
        let draws = self.arguments.draws as usize;
        if !braked.verdict.closes() || node.draws >= draws {
            return Some(braked);
        }
        let estimate = self.measured(node).by_smoothness(self.draws(draws)).ok()?;
        self.friction(&Node {
            estimate,
            draws,
            ..node.clone()
        })
    }

    pub(super) fn measured<'n>(&'n self, node: &'n Node) -> Measured<'n> {
        Measured {
            subject: self.subject,
            record: node.source.record(),
        }
    }

    pub(super) fn draws(&self, count: usize) -> Draws {
        Draws {
            count,
            seed: self.arguments.seed,
        }
    }

    /// Reads the table with other options.
    pub(super) fn read(&self, reading: &MeasuredFile) -> Option<Source> {
        let arguments = Arguments {
            measured: reading.clone(),
            ..self.arguments.clone()
        };
        Source::read(self.table, &arguments, self.hung).ok()
    }

    /// Estimates the motion as for the original record, and returns the number of draws. If it is
    /// obvious that the budget does not close, it uses smoothness only, and few draws.
    pub(super) fn estimate(&self, source: &Source) -> Option<(Estimate, usize)> {
        let measured = Measured {
            subject: self.subject,
            record: source.record(),
        };
        let smooth = |draws| measured.by_smoothness(self.draws(draws)).ok();
        let closes = |found: &Estimate, draws| Verdict::of(&source.times, found, draws).closes();
        let few = smooth(FEW)?;
        if !closes(&few, FEW) {
            return Some((few, FEW));
        }
        let all = self.arguments.draws as usize;
        let smooth = smooth(all)?;
        let found = match self.arguments.model && closes(&smooth, all) {
            true => measured.by_model(&smooth, self.draws(all)).ok()?,
            false => smooth,
        };
        Some((found, all))
    }
}
