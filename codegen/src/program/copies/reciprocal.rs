//! One over a quantity of every link, which keeps small differences accurate.

use super::field::{Copies, Field};
use super::series::Series;
use super::tree::Branch;

impl Copies<'_> {
    /// One over a field, link by link.
    pub(super) fn reciprocal(&mut self, f: &Field) -> Field {
        let branch = self.branch(f.orbit);
        if !f.varies_below(branch) {
            let mean = self.graded.reciprocal(&f.mean);
            return Field::uniform(f.orbit, mean);
        }
        let leading = self.leading(f);
        let start = self.reciprocal_of_leading(&leading);
        let rest = self.sub(f, &leading);
        let mut result = start.clone();
        // The residual is small: each round gains one order.
        for _ in 0..self.graded.truncation.unwrap_or(0) {
            let product = self.mul(&rest, &result);
            let correction = self.mul(&start, &product);
            result = self.sub(&start, &correction);
        }
        result
    }

    /// The part of order 0.
    pub(super) fn leading(&mut self, f: &Field) -> Field {
        let mean = self.graded.leading(&f.mean);
        let mut result = Field::uniform(f.orbit, mean);
        for (&place, value) in &f.differences {
            let value = self.graded.leading(value);
            result.put(place, value);
        }
        result
    }

    /// One over a field without higher orders.
    fn reciprocal_of_leading(&mut self, f: &Field) -> Field {
        let branch = self.branch(f.orbit);
        match branch {
            _ if !f.varies_below(branch) => {
                let mean = self.graded.reciprocal(&f.mean);
                Field::uniform(f.orbit, mean)
            }
            Some(branch) if is_pair_of_links(branch) => self.reciprocal_of_pair(branch, f),
            _ => {
                let estimate = self.reciprocal_by_copies(f);
                self.refined(f, &estimate)
            }
        }
    }

    /// 1/(m ± d) = (m ∓ d)/((m + d)(m − d)).
    fn reciprocal_of_pair(&mut self, branch: &Branch, f: &Field) -> Field {
        let place = (branch.group, 1);
        let difference = f.at(place);
        let values = self.means(branch, f, &f.mean);
        let product = self.graded.mul(&values[0], &values[1]);
        let inverse = self.graded.reciprocal(&product);
        let mut result = Field::uniform(f.orbit, self.graded.mul(&f.mean, &inverse));
        let quotient = self.graded.mul(&difference, &inverse);
        result.put(place, self.graded.neg(&quotient));
        result
    }

    fn reciprocal_by_copies(&mut self, f: &Field) -> Field {
        let mut result = Field::zero(f.orbit);
        result.mean = self.inverted(self.branch(f.orbit), f, &f.mean.clone(), &mut result);
        result
    }

    fn inverted(
        &mut self,
        branch: Option<&Branch>,
        f: &Field,
        mean: &Series,
        result: &mut Field,
    ) -> Series {
        let Some(branch) = branch.filter(|branch| f.varies_below(Some(branch))) else {
            return self.graded.reciprocal(mean);
        };
        let means = self.means(branch, f, mean);
        let inverses: Vec<Series> = branch
            .copies
            .iter()
            .zip(&means)
            .map(|(inner, mean)| self.inverted(inner.as_ref(), f, mean, result))
            .collect();
        for (index, value) in self.differences(&inverses).into_iter().enumerate() {
            result.put((branch.group, index + 1), value);
        }
        self.average(&inverses)
    }

    /// One step of Newton's: x + x (1 − f x). Copies subtracted from one
    /// another lose the digits of small differences; this brings them back.
    fn refined(&mut self, f: &Field, estimate: &Field) -> Field {
        let one = self.graded.integer(1);
        let one = Field::uniform(f.orbit, one);
        let product = self.mul(f, estimate);
        let defect = self.sub(&one, &product);
        let correction = self.mul(estimate, &defect);
        self.add(estimate, &correction)
    }
}

fn is_pair_of_links(branch: &Branch) -> bool {
    branch.copies.len() == 2 && branch.links_per_copy == 1
}
