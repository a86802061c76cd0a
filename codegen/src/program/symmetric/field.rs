//! Arithmetic on quantities of all links of an orbit (set of equal copies of one link), stored as
//! mean and Helmert differences (physics §3) instead of copy by copy.
//!
//! This justifies its operations: a difference that is exactly zero remains so, and a small one
//! keeps its relative accuracy, which subtracting copies would destroy. For nested copies the basis
//! is Haar's, whose products couple each branching to those below it.

use super::series::{SeriesArithmetic, TruncatedSeries};
use super::tree::{Branch, DifferenceId, OrbitLinks, structure, weight};
use crate::exact::Rational;
use std::collections::BTreeMap;

/// A quantity of every link of an orbit: link = mean + Σ weight · difference.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::program) struct SymmetricField {
    pub(super) orbit: usize,
    pub(in crate::program) mean: TruncatedSeries,
    /// The differences that are not zero.
    pub(super) differences: BTreeMap<DifferenceId, TruncatedSeries>,
}

impl SymmetricField {
    pub(super) fn zero(orbit: usize) -> Self {
        Self::uniform(orbit, TruncatedSeries::default())
    }

    /// Creates a field with the same value in every link.
    pub(super) fn uniform(orbit: usize, mean: TruncatedSeries) -> Self {
        Self {
            orbit,
            mean,
            differences: BTreeMap::new(),
        }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.mean.is_zero() && self.differences.is_empty()
    }

    pub(super) fn at(&self, id: DifferenceId) -> TruncatedSeries {
        self.differences.get(&id).cloned().unwrap_or_default()
    }

    pub(in crate::program) fn put(&mut self, id: DifferenceId, value: TruncatedSeries) {
        if value.is_zero() {
            self.differences.remove(&id);
        } else {
            self.differences.insert(id, value);
        }
    }

    /// Returns true if links within one copy of this branching have different values.
    pub(super) fn varies_below(&self, branch: Option<&Branch>) -> bool {
        branch.is_some_and(|branch| {
            (1..=branch.differences())
                .any(|index| self.differences.contains_key(&(branch.group, index)))
                || branch
                    .copies
                    .iter()
                    .any(|copy| self.varies_below(copy.as_ref()))
        })
    }
}

/// A tree in means and differences: its orbits, and the arithmetic on their fields.
pub(in crate::program) struct SymmetricTree<'b> {
    pub(in crate::program) series: SeriesArithmetic<'b>,
    pub(in crate::program) orbits: &'b [OrbitLinks],
}

impl<'b> SymmetricTree<'b> {
    pub(super) fn branch(&self, orbit: usize) -> Option<&'b Branch> {
        self.orbits[orbit].branch.as_ref()
    }

    fn termwise(
        &mut self,
        f: &SymmetricField,
        g: &SymmetricField,
        operation: fn(
            &mut SeriesArithmetic<'b>,
            &TruncatedSeries,
            &TruncatedSeries,
        ) -> TruncatedSeries,
    ) -> SymmetricField {
        debug_assert_eq!(f.orbit, g.orbit);
        let mean = operation(&mut self.series, &f.mean, &g.mean);
        let mut result = SymmetricField::uniform(f.orbit, mean);
        if self.series.builder.is_exceeded() {
            return result;
        }
        for &id in f.differences.keys().chain(g.differences.keys()) {
            if !result.differences.contains_key(&id) {
                let value = operation(&mut self.series, &f.at(id), &g.at(id));
                result.put(id, value);
            }
        }
        result
    }

    pub(super) fn add(&mut self, f: &SymmetricField, g: &SymmetricField) -> SymmetricField {
        self.termwise(f, g, SeriesArithmetic::add)
    }

    pub(super) fn sub(&mut self, f: &SymmetricField, g: &SymmetricField) -> SymmetricField {
        self.termwise(f, g, SeriesArithmetic::sub)
    }

    pub(in crate::program) fn neg(&mut self, f: &SymmetricField) -> SymmetricField {
        self.sub(&SymmetricField::zero(f.orbit), f)
    }

    /// Multiplies a field by a factor that is the same in every link.
    pub(super) fn scale(&mut self, factor: &TruncatedSeries, f: &SymmetricField) -> SymmetricField {
        let mean = self.series.mul(factor, &f.mean);
        let mut result = SymmetricField::uniform(f.orbit, mean);
        if self.series.builder.is_exceeded() {
            return result;
        }
        for (&id, value) in &f.differences {
            let value = self.series.mul(factor, value);
            result.put(id, value);
        }
        result
    }

    /// Returns a field of the parent links as a field of their child links in `orbit`.
    pub(super) fn lift(&self, f: &SymmetricField, orbit: usize) -> SymmetricField {
        SymmetricField { orbit, ..f.clone() }
    }

    /// Returns, for each link of `ancestor`, the sum over the links of the field's orbit below it.
    pub(super) fn gather(&mut self, f: &SymmetricField, ancestor: usize) -> SymmetricField {
        let mut ids = Vec::new();
        let mut pending: Vec<&Branch> = self.branch(ancestor).into_iter().collect();
        while let Some(branch) = pending.pop() {
            ids.extend((1..=branch.differences()).map(|index| (branch.group, index)));
            pending.extend(branch.copies.iter().flatten());
        }
        let count = self.orbits[f.orbit].links / self.orbits[ancestor].links;
        let count = self.series.integer(count as i64);
        let mut kept = SymmetricField::uniform(ancestor, f.mean.clone());
        for (&id, value) in &f.differences {
            if ids.contains(&id) {
                kept.put(id, value.clone());
            }
        }
        self.scale(&count, &kept)
    }

    /// Returns the sum over all links of the product of two fields; by Parseval's identity it has
    /// one term per coordinate.
    pub(super) fn dot(&mut self, f: &SymmetricField, g: &SymmetricField) -> TruncatedSeries {
        let parts = self.dot_by_sector(f, g);
        let mut sum = TruncatedSeries::default();
        for part in parts.values() {
            sum = self.series.add(&sum, part);
        }
        sum
    }

    /// Returns the terms of the sum [`dot`](Self::dot) by difference; the key of the mean is
    /// `None`.
    pub(super) fn dot_by_sector(
        &mut self,
        f: &SymmetricField,
        g: &SymmetricField,
    ) -> BTreeMap<Option<DifferenceId>, TruncatedSeries> {
        debug_assert_eq!(f.orbit, g.orbit);
        let mut parts = BTreeMap::new();
        let links = self.series.integer(self.orbits[f.orbit].links as i64);
        let product = self.series.mul(&f.mean, &g.mean);
        parts.insert(None, self.series.mul(&links, &product));
        for (&id, value) in &f.differences {
            if let Some(other) = g.differences.get(&id) {
                let norm = self.norm(f.orbit, id);
                let norm = self.series.integer(norm);
                let product = self.series.mul(value, other);
                parts.insert(Some(id), self.series.mul(&norm, &product));
            }
        }
        parts
    }

    /// Returns the sum of the squared weights of a difference.
    pub(super) fn norm(&self, orbit: usize, id: DifferenceId) -> i64 {
        let mut pending: Vec<&Branch> = self.branch(orbit).into_iter().collect();
        while let Some(branch) = pending.pop() {
            if branch.group == id.0 {
                return branch.norm(id.1);
            }
            pending.extend(branch.copies.iter().flatten());
        }
        unreachable!("a difference of another orbit")
    }

    /// Returns the mean within each copy of a branching, given the mean of the whole branching.
    pub(super) fn means(
        &mut self,
        branch: &Branch,
        f: &SymmetricField,
        mean: &TruncatedSeries,
    ) -> Vec<TruncatedSeries> {
        (0..branch.copies.len())
            .map(|copy| {
                let offset = self.offset(branch, f, copy);
                self.series.add(mean, &offset)
            })
            .collect()
    }

    /// Returns the deviation of a copy from the mean of all copies.
    pub(super) fn offset(
        &mut self,
        branch: &Branch,
        f: &SymmetricField,
        copy: usize,
    ) -> TruncatedSeries {
        let mut sum = TruncatedSeries::default();
        if self.series.builder.is_exceeded() {
            return sum;
        }
        for index in 1..=branch.differences() {
            let weight = weight(index, copy);
            if weight != 0 {
                let value = f.at((branch.group, index));
                let term = self.series.scale(&Rational::from(weight), &value);
                sum = self.series.add(&sum, &term);
            }
        }
        sum
    }

    /// Returns the Helmert differences of one value per copy, computed as sums of differences, so
    /// that equal copies give exactly zero.
    pub(super) fn differences(&mut self, values: &[TruncatedSeries]) -> Vec<TruncatedSeries> {
        (1..values.len())
            .map(|index| {
                let mut sum = TruncatedSeries::default();
                if self.series.builder.is_exceeded() {
                    return sum;
                }
                for value in &values[..index] {
                    let difference = self.series.sub(value, &values[index]);
                    sum = self.series.add(&sum, &difference);
                }
                let norm = Rational::from_ratio(1, (index * (index + 1)) as i64);
                self.series.scale(&norm.unwrap_or_else(Rational::one), &sum)
            })
            .collect()
    }

    pub(super) fn average(&mut self, values: &[TruncatedSeries]) -> TruncatedSeries {
        let mut sum = TruncatedSeries::default();
        for value in values {
            sum = self.series.add(&sum, value);
        }
        let share = Rational::from_ratio(1, values.len() as i64);
        self.series
            .scale(&share.unwrap_or_else(Rational::one), &sum)
    }

    /// Returns the product of two fields, link by link.
    pub(super) fn mul(&mut self, f: &SymmetricField, g: &SymmetricField) -> SymmetricField {
        debug_assert_eq!(f.orbit, g.orbit);
        let mut result = SymmetricField::zero(f.orbit);
        let product = self.series.mul(&f.mean, &g.mean);
        if self.series.builder.is_exceeded() {
            return SymmetricField::uniform(f.orbit, product);
        }
        let branch = self.branch(f.orbit);
        let excess = self.excess(branch, f, g, [&f.mean, &g.mean], &mut result);
        result.mean = self.series.add(&product, &excess);
        result
    }

    /// Returns the mean of a product minus the product of the means within a branching; adds its
    /// differences to `result`. Every term is a product of two small quantities.
    fn excess(
        &mut self,
        branch: Option<&Branch>,
        f: &SymmetricField,
        g: &SymmetricField,
        [f_mean, g_mean]: [&TruncatedSeries; 2],
        result: &mut SymmetricField,
    ) -> TruncatedSeries {
        let Some(branch) = branch else {
            return TruncatedSeries::default();
        };
        let (f_varies, g_varies) = (f.varies_below(Some(branch)), g.varies_below(Some(branch)));
        if !f_varies && !g_varies {
            return TruncatedSeries::default();
        }
        let count = branch.copies.len();
        let mut below = Vec::new();
        for (copy, inner) in branch.copies.iter().enumerate() {
            let inner = inner.as_ref();
            if !f.varies_below(inner) && !g.varies_below(inner) {
                below.push(TruncatedSeries::default());
                continue;
            }
            let offsets = [self.offset(branch, f, copy), self.offset(branch, g, copy)];
            let f_here = self.series.add(f_mean, &offsets[0]);
            let g_here = self.series.add(g_mean, &offsets[1]);
            below.push(self.excess(inner, f, g, [&f_here, &g_here], result));
        }
        let from_below = self.differences(&below);
        let mut excess = self.average(&below);
        for index in 1..count {
            if self.series.builder.is_exceeded() {
                break;
            }
            let id = (branch.group, index);
            let (f_own, g_own) = (f.at(id), g.at(id));
            let forward = self.series.mul(f_mean, &g_own);
            let backward = self.series.mul(&f_own, g_mean);
            let mut difference = self.series.add(&forward, &backward);
            for (i, l, ratio) in structure(count, index) {
                let parts = [f.at((branch.group, i)), g.at((branch.group, l))];
                let product = self.series.mul(&parts[0], &parts[1]);
                let term = self.series.scale(&ratio, &product);
                difference = self.series.add(&difference, &term);
            }
            difference = self.series.add(&difference, &from_below[index - 1]);
            result.put(id, difference);
            let square = self.series.mul(&f_own, &g_own);
            let share = Rational::from_ratio((index * (index + 1)) as i64, count as i64);
            let term = self
                .series
                .scale(&share.unwrap_or_else(Rational::one), &square);
            excess = self.series.add(&excess, &term);
        }
        excess
    }
}
