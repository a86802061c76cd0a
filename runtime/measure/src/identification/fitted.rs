//! The unknowns at the end of a search, with what the data say of each.

use nalgebra::DMatrix;

use super::covariance::{Curvature, TimeBlocks};
use super::fit::{ParameterEstimate, Standing};
use super::identifiability::{OpenDirections, SHARE};
use super::ratios::Ratios;
use super::task::FitTask;

/// By how much an unknown that is held may be off, of its size.
const HELD: f64 = 0.3;

/// Globals that are fitted, and what their standard deviations follow from.
pub(super) struct FittedGlobals<'a> {
    pub(super) task: &'a FitTask<'a>,
    pub(super) globals: &'a [f64],
    pub(super) open: OpenDirections,
    /// Globals that are neither held nor at a bound.
    pub(super) free: Vec<usize>,
    pub(super) curvature: Curvature,
    /// Variance of the data, in those that were given.
    pub(super) variance: f64,
    pub(super) blocks: Option<TimeBlocks>,
}

impl FittedGlobals<'_> {
    /// The unknowns, one by one.
    pub(super) fn estimates(&self) -> Vec<ParameterEstimate> {
        let mut singles = DMatrix::zeros(self.free.len(), self.free.len());
        for (row, &global) in self.free.iter().enumerate() {
            singles[(row, row)] = self.task.scales[global];
        }
        let [naive, by_blocks] = self.deviations(&singles);
        let estimate = |(index, name): (usize, &String)| {
            let place = self.free.iter().position(|&own| own == index);
            let naive = place.map(|place| naive[place]);
            ParameterEstimate {
                name: name.clone(),
                value: self.globals[index],
                standing: self.standing(index, naive),
                naive,
                by_blocks: place
                    .filter(|_| self.has_blocks())
                    .map(|place| by_blocks[place]),
            }
        };
        self.task.names.iter().enumerate().map(estimate).collect()
    }

    /// Products of powers of those that the data leave open one by one.
    pub(super) fn ratios(&self, estimates: &[ParameterEstimate]) -> Vec<ParameterEstimate> {
        let (task, globals) = (self.task, self.globals);
        let ratios = Ratios::new(task, globals, estimates, &self.open.changes);
        let combinations = ratios.combinations(task, globals, &self.free);
        let [naive, by_blocks] = self.deviations(&combinations);
        let by_blocks = self.has_blocks().then_some(by_blocks.as_slice());
        ratios.estimates(task, globals, &naive, by_blocks)
    }

    /// Standard deviations of combinations of the free globals, a row each: by the curvature
    /// alone, and by blocks of time; infinite where there are none.
    fn deviations(&self, combinations: &DMatrix<f64>) -> [Vec<f64>; 2] {
        let none = || vec![f64::INFINITY; combinations.nrows()];
        let blocks = self.blocks.as_ref();
        let by_blocks = blocks.and_then(|blocks| blocks.variances(&self.free, combinations));
        let naive = self.curvature.variances(combinations, self.variance);
        [naive, by_blocks]
            .map(|variances| variances.unwrap_or_else(none))
            .map(|variances| variances.into_iter().map(f64::sqrt).collect())
    }

    fn has_blocks(&self) -> bool {
        !self.task.times.is_empty()
    }

    /// What is known of an unknown with this standard deviation.
    fn standing(&self, index: usize, naive: Option<f64>) -> Standing {
        let value = self.globals[index];
        let is_bound = self.task.is_at_bound(index, value);
        // What came to its bound before it was held did so by the data.
        if is_bound && value != self.task.start(index) {
            return Standing::AtBound;
        }
        if self.open.held.contains(&index) {
            return Standing::Held;
        }
        if is_bound {
            return Standing::AtBound;
        }
        let with = self.goes_with(index, naive);
        match with.is_empty() {
            true => Standing::Determined,
            false => Standing::GoesWith(with),
        }
    }

    /// The unknowns that are held with which this one changes.
    fn goes_with(&self, index: usize, naive: Option<f64>) -> Vec<String> {
        let with = self.open.held.iter().enumerate().filter(|&(column, _)| {
            // What is held may be off; it matters where the bar does not cover it.
            let change = self.open.changes[(index, column)].abs();
            let size = change * self.task.unit(self.globals, index);
            change > SHARE || naive.is_some_and(|bar| HELD * size > 0.5 * bar)
        });
        with.map(|(_, &held)| self.task.names[held].clone())
            .collect()
    }
}
