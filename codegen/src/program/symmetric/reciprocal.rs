//! Reciprocal of a field, which keeps small differences accurate.

use super::field::{SymmetricField, SymmetricTree};
use super::series::{SeriesArithmetic, TruncatedSeries};
use super::tree::Branch;

/// A function applied to the value of one copy.
type CopyFunction = fn(&mut SeriesArithmetic<'_>, &TruncatedSeries) -> TruncatedSeries;

impl SymmetricTree<'_> {
    /// Returns 1/f, link by link.
    pub(super) fn reciprocal(&mut self, f: &SymmetricField) -> SymmetricField {
        let branch = self.branch(f.orbit);
        if !f.varies_below(branch) {
            let mean = self.series.reciprocal(&f.mean);
            return SymmetricField::uniform(f.orbit, mean);
        }
        let leading = self.leading(f);
        let start = self.reciprocal_of_leading(&leading);
        let rest = self.sub(f, &leading);
        let mut result = start.clone();
        // The residual is small: each round corrects one further order.
        for _ in 0..self.series.truncation.unwrap_or(0) {
            let product = self.mul(&rest, &result);
            let correction = self.mul(&start, &product);
            result = self.sub(&start, &correction);
        }
        result
    }

    /// Returns the part of order 0.
    pub(super) fn leading(&mut self, f: &SymmetricField) -> SymmetricField {
        let mean = self.series.leading(&f.mean);
        let mut result = SymmetricField::uniform(f.orbit, mean);
        for (&id, value) in &f.differences {
            let value = self.series.leading(value);
            result.put(id, value);
        }
        result
    }

    /// Returns the reciprocal of a field that has order 0 only.
    fn reciprocal_of_leading(&mut self, f: &SymmetricField) -> SymmetricField {
        let branch = self.branch(f.orbit);
        match branch {
            _ if !f.varies_below(branch) => {
                let mean = self.series.reciprocal(&f.mean);
                SymmetricField::uniform(f.orbit, mean)
            }
            Some(branch) if is_pair_of_links(branch) => self.reciprocal_of_pair(branch, f),
            _ => {
                let estimate = self.by_copies(f, |series, value| series.reciprocal(value));
                self.refined(f, &estimate)
            }
        }
    }

    /// Computes 1/(m ± d) = (m ∓ d)/((m + d)(m − d)).
    fn reciprocal_of_pair(&mut self, branch: &Branch, f: &SymmetricField) -> SymmetricField {
        let id = (branch.group, 1);
        let difference = f.at(id);
        let values = self.means(branch, f, &f.mean);
        let product = self.series.mul(&values[0], &values[1]);
        let inverse = self.series.reciprocal(&product);
        let mut result = SymmetricField::uniform(f.orbit, self.series.mul(&f.mean, &inverse));
        let quotient = self.series.mul(&difference, &inverse);
        result.put(id, self.series.neg(&quotient));
        result
    }

    /// Applies a function copy by copy. The result is an estimate, because differences are computed
    /// by subtracting copies.
    pub(super) fn by_copies(
        &mut self,
        f: &SymmetricField,
        function: CopyFunction,
    ) -> SymmetricField {
        let mut result = SymmetricField::zero(f.orbit);
        let branch = self.branch(f.orbit);
        result.mean = self.of_copies(branch, f, &f.mean, &mut result, function);
        result
    }

    fn of_copies(
        &mut self,
        branch: Option<&Branch>,
        f: &SymmetricField,
        mean: &TruncatedSeries,
        result: &mut SymmetricField,
        function: CopyFunction,
    ) -> TruncatedSeries {
        let Some(branch) = branch.filter(|branch| f.varies_below(Some(branch))) else {
            return function(&mut self.series, mean);
        };
        let means = self.means(branch, f, mean);
        let inverses: Vec<TruncatedSeries> = branch
            .copies
            .iter()
            .zip(&means)
            .map(|(inner, mean)| self.of_copies(inner.as_ref(), f, mean, result, function))
            .collect();
        for (index, value) in self.differences(&inverses).into_iter().enumerate() {
            result.put((branch.group, index + 1), value);
        }
        self.average(&inverses)
    }

    /// Computes one Newton step: x + x (1 − f x). It restores the digits of small differences that
    /// subtracting copies has lost.
    fn refined(&mut self, f: &SymmetricField, estimate: &SymmetricField) -> SymmetricField {
        let one = self.series.integer(1);
        let one = SymmetricField::uniform(f.orbit, one);
        let product = self.mul(f, estimate);
        let defect = self.sub(&one, &product);
        let correction = self.mul(estimate, &defect);
        self.add(estimate, &correction)
    }
}

fn is_pair_of_links(branch: &Branch) -> bool {
    branch.copies.len() == 2 && branch.links_per_copy == 1
}
