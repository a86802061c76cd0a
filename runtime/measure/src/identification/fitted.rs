//! Estimates of the unknowns at the end of a search, with their uncertainties.

use nalgebra::DMatrix;

use super::covariance::{Curvature, TimeBlocks};
use super::fit::{ParameterEstimate, Standing};
use super::identifiability::{OpenDirections, SHARE};
use super::ratios::Ratios;
use super::task::FitTask;

/// Relative error that is assumed for an unknown that is held fixed.
const HELD: f64 = 0.3;

/// Fitted globals, with the matrices from which their standard deviations are computed.
pub(super) struct FittedGlobals<'a> {
    pub(super) task: &'a FitTask<'a>,
    pub(super) globals: &'a [f64],
    pub(super) open: OpenDirections,
    /// Indices of the globals that are neither held fixed nor at a bound.
    pub(super) free: Vec<usize>,
    pub(super) curvature: Curvature,
    /// Variance of the data, in units of the squared standard deviations given for them.
    pub(super) variance: f64,
    pub(super) blocks: Option<TimeBlocks>,
}

impl FittedGlobals<'_> {
    /// Returns the estimates of all unknowns.
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

    /// Returns estimates of products of powers of those unknowns that the data do not determine
    /// individually.
    pub(super) fn ratios(&self, estimates: &[ParameterEstimate]) -> Vec<ParameterEstimate> {
        let (task, globals) = (self.task, self.globals);
        let ratios = Ratios::new(task, globals, estimates, &self.open.changes);
        let combinations = ratios.combinations(task, globals, &self.free);
        let [naive, by_blocks] = self.deviations(&combinations);
        let by_blocks = self.has_blocks().then_some(by_blocks.as_slice());
        ratios.estimates(task, globals, &naive, by_blocks)
    }

    /// Returns two standard deviations for each of the combinations (rows) of the free globals:
    /// from the curvature only, and from blocks of time. Infinite if they cannot be computed.
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

    /// Returns how an unknown with this naive standard deviation was determined.
    fn standing(&self, index: usize, naive: Option<f64>) -> Standing {
        let value = self.globals[index];
        let is_bound = self.task.is_at_bound(index, value);
        // An unknown that reached its bound before it was held got there by the data.
        if is_bound && value != self.task.start(index) {
            return Standing::AtBound;
        }
        if self.open.held.contains(&index) {
            return Standing::Held;
        }
        if is_bound {
            return Standing::AtBound;
        }
        let with = self.fixed_partners(index, naive);
        match with.is_empty() {
            true => Standing::Determined,
            false => Standing::GoesWith(with),
        }
    }

    /// Returns the names of the fixed unknowns whose values affect this one.
    fn fixed_partners(&self, index: usize, naive: Option<f64>) -> Vec<String> {
        let with = self.open.held.iter().enumerate().filter(|&(column, _)| {
            // A held unknown may be wrong; this matters where the error bar does not cover the
            // effect.
            let change = self.open.changes[(index, column)].abs();
            let size = change * self.task.unit(self.globals, index);
            change > SHARE || naive.is_some_and(|bar| HELD * size > 0.5 * bar)
        });
        with.map(|(_, &held)| self.task.names[held].clone())
            .collect()
    }
}
