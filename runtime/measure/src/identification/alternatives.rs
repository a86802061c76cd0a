//! Search for unknown parameters from frequencies only, which several sets of values may fit
//! equally well.

use nalgebra::DVector;

use super::error::IdentificationError;
use super::family::Family;
use super::fit::Fit;
use super::search::{Rung, Search};

/// Number of additional starting points besides the given one.
const MORE_STARTS: usize = 20;
/// Largest relative difference at which two sums of squares count as equal; data separate such sums
/// only by chance.
const TIE: f64 = 1e-3;
const AS_WELL: f64 = 1.0;
/// Distance in standard errors of the frequencies above which two sets of values count as
/// different.
const APART: f64 = 2.0;

impl<F: Family> Search<'_, F> {
    /// Searches from several starting points, using frequencies only. The result is the set of
    /// values that fits them best; among equally good ones, the one closest to the given starting
    /// point.
    pub(super) fn try_starts_at_rest(
        mut self,
        globals: &[f64],
    ) -> Result<Fit, IdentificationError> {
        self.identification.check_unknowns(&self.task, &[])?;
        // Number 1 would be the given starting point with shorter segments, of which there are
        // none.
        let numbers = (0..=1 + MORE_STARTS).filter(|&number| number != 1);
        let rungs: Vec<Rung> = numbers
            .filter_map(|number| self.scout(number, globals))
            .collect();
        let squares = |rung: &Rung| rung.solved.residuals.squares;
        let least = rungs.iter().map(squares).fold(f64::INFINITY, f64::min);
        let best = rungs.iter().find(|rung| squares(rung) <= least + TIE);
        let mut best = best.cloned().ok_or(IdentificationError::NoRest)?;
        let is_same = |rung: &&Rung| !self.is_apart(&best, rung);
        let agreed = rungs.iter().filter(is_same);
        let agreed = agreed.filter(|rung| squares(rung) <= least + TIE).count();
        let alternatives = self.alternatives(&best, &rungs, least + AS_WELL);
        (best.convergence.starts, best.convergence.agreed) = (rungs.len(), agreed);
        let fit = self.finish(best)?;
        Ok(Fit {
            alternatives,
            ..fit
        })
    }

    /// Returns the other physical sets of values whose sum of squares is below `bound`, each set
    /// once.
    fn alternatives(&self, best: &Rung, rungs: &[Rung], bound: f64) -> Vec<Vec<f64>> {
        let mut found: Vec<&Rung> = Vec::new();
        for rung in rungs {
            let values = self.task.parameters(&rung.stage.globals);
            let is_possible = self.identification.family.check(&values).is_ok();
            let mut others = found.iter().copied().chain([best]);
            let is_new = others.all(|other| self.is_apart(other, rung));
            if is_possible && is_new && rung.solved.residuals.squares <= bound {
                found.push(rung);
            }
        }
        let values = found.iter().map(|rung| rung.stage.globals.clone());
        values.collect()
    }

    /// Returns true if the values of two results differ. Results that differ only in what the data
    /// do not determine count as equal.
    fn is_apart(&self, rung: &Rung, other: &Rung) -> bool {
        let free = &rung.stage.free;
        if !rung.solved.held.is_empty() || !other.solved.held.is_empty() {
            return false;
        }
        let change = |&global: &usize| {
            let change = other.stage.globals[global] - rung.stage.globals[global];
            change / self.task.scales[global]
        };
        let changes = DVector::from_iterator(free.len(), free.iter().map(change));
        let rows = self.task.frequency_rows(&rung.stage.globals, free, 1.0);
        rows.is_some_and(|rows| {
            let slopes = rows.columns(0, free.len());
            (slopes * changes).norm() > APART
        })
    }
}
