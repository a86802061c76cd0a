//! Arithmetic on quantities that every link of an orbit has, held as their
//! mean and Helmert differences (physics §3) instead of copy by copy.
//!
//! This is worth its operations: a difference that is exactly zero stays so,
//! and a small one keeps its own relative accuracy, which subtracting copies
//! would destroy. On a nested tree the basis is Haar's, with products that
//! couple each branching to those below it.

use super::series::{Graded, Series};
use super::tree::{Branch, Orbit, structure, weight};
use crate::exact::Rational;
use std::collections::BTreeMap;

/// A difference: index of the group, number of the difference from 1.
pub(in crate::program) type Place = (usize, usize);

/// One quantity of every link of an orbit: link = mean + Σ weight · difference.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::program) struct Field {
    pub(super) orbit: usize,
    pub(in crate::program) mean: Series,
    /// The differences that are not zero.
    pub(super) differences: BTreeMap<Place, Series>,
}

impl Field {
    pub(super) fn zero(orbit: usize) -> Self {
        Self::uniform(orbit, Series::default())
    }

    /// A field of one value in every link.
    pub(super) fn uniform(orbit: usize, mean: Series) -> Self {
        Self {
            orbit,
            mean,
            differences: BTreeMap::new(),
        }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.mean.is_zero() && self.differences.is_empty()
    }

    pub(super) fn at(&self, place: Place) -> Series {
        self.differences.get(&place).cloned().unwrap_or_default()
    }

    pub(in crate::program) fn put(&mut self, place: Place, value: Series) {
        if value.is_zero() {
            self.differences.remove(&place);
        } else {
            self.differences.insert(place, value);
        }
    }

    /// Returns true if links within one copy of this branching differ.
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

/// Arithmetic on fields.
pub(in crate::program) struct Copies<'b> {
    pub(in crate::program) graded: Graded<'b>,
    pub(in crate::program) orbits: &'b [Orbit],
}

impl<'b> Copies<'b> {
    pub(super) fn branch(&self, orbit: usize) -> Option<&'b Branch> {
        self.orbits[orbit].branch.as_ref()
    }

    fn termwise(
        &mut self,
        f: &Field,
        g: &Field,
        operation: fn(&mut Graded<'b>, &Series, &Series) -> Series,
    ) -> Field {
        debug_assert_eq!(f.orbit, g.orbit);
        let mean = operation(&mut self.graded, &f.mean, &g.mean);
        let mut result = Field::uniform(f.orbit, mean);
        for &place in f.differences.keys().chain(g.differences.keys()) {
            if !result.differences.contains_key(&place) {
                let value = operation(&mut self.graded, &f.at(place), &g.at(place));
                result.put(place, value);
            }
        }
        result
    }

    pub(super) fn add(&mut self, f: &Field, g: &Field) -> Field {
        self.termwise(f, g, Graded::add)
    }

    pub(super) fn sub(&mut self, f: &Field, g: &Field) -> Field {
        self.termwise(f, g, Graded::sub)
    }

    pub(in crate::program) fn neg(&mut self, f: &Field) -> Field {
        self.sub(&Field::zero(f.orbit), f)
    }

    /// A factor that is the same in every link.
    pub(super) fn scale(&mut self, factor: &Series, f: &Field) -> Field {
        let mean = self.graded.mul(factor, &f.mean);
        let mut result = Field::uniform(f.orbit, mean);
        for (&place, value) in &f.differences {
            let value = self.graded.mul(factor, value);
            result.put(place, value);
        }
        result
    }

    /// A parent's quantity as one of the links below it.
    pub(super) fn lift(&self, f: &Field, orbit: usize) -> Field {
        Field { orbit, ..f.clone() }
    }

    /// The sum over the links of an orbit below each link of `ancestor`.
    pub(super) fn gather(&mut self, f: &Field, ancestor: usize) -> Field {
        let mut places = Vec::new();
        let mut pending: Vec<&Branch> = self.branch(ancestor).into_iter().collect();
        while let Some(branch) = pending.pop() {
            places.extend((1..=branch.differences()).map(|index| (branch.group, index)));
            pending.extend(branch.copies.iter().flatten());
        }
        let count = self.orbits[f.orbit].links / self.orbits[ancestor].links;
        let count = self.graded.integer(count as i64);
        let mut kept = Field::uniform(ancestor, f.mean.clone());
        for (&place, value) in &f.differences {
            if places.contains(&place) {
                kept.put(place, value.clone());
            }
        }
        self.scale(&count, &kept)
    }

    /// Σ over all links of the product of two fields, by Parseval one term for
    /// each coordinate.
    pub(super) fn dot(&mut self, f: &Field, g: &Field) -> Series {
        let parts = self.dot_by_place(f, g);
        let mut sum = Series::default();
        for part in parts.values() {
            sum = self.graded.add(&sum, part);
        }
        sum
    }

    /// The terms of that sum; the mean's stands under `None`.
    pub(super) fn dot_by_place(&mut self, f: &Field, g: &Field) -> BTreeMap<Option<Place>, Series> {
        debug_assert_eq!(f.orbit, g.orbit);
        let mut parts = BTreeMap::new();
        let links = self.graded.integer(self.orbits[f.orbit].links as i64);
        let product = self.graded.mul(&f.mean, &g.mean);
        parts.insert(None, self.graded.mul(&links, &product));
        for (&place, value) in &f.differences {
            if let Some(other) = g.differences.get(&place) {
                let norm = self.norm(f.orbit, place);
                let norm = self.graded.integer(norm);
                let product = self.graded.mul(value, other);
                parts.insert(Some(place), self.graded.mul(&norm, &product));
            }
        }
        parts
    }

    /// Σ of the squared weights of a difference.
    pub(super) fn norm(&self, orbit: usize, place: Place) -> i64 {
        let mut pending: Vec<&Branch> = self.branch(orbit).into_iter().collect();
        while let Some(branch) = pending.pop() {
            if branch.group == place.0 {
                return branch.norm(place.1);
            }
            pending.extend(branch.copies.iter().flatten());
        }
        unreachable!("a difference of another orbit")
    }

    /// The mean in each copy of a branching whose mean is given.
    pub(super) fn means(&mut self, branch: &Branch, f: &Field, mean: &Series) -> Vec<Series> {
        (0..branch.copies.len())
            .map(|copy| {
                let offset = self.offset(branch, f, copy);
                self.graded.add(mean, &offset)
            })
            .collect()
    }

    /// Deviation of a copy from the mean of all copies.
    pub(super) fn offset(&mut self, branch: &Branch, f: &Field, copy: usize) -> Series {
        let mut sum = Series::default();
        for index in 1..=branch.differences() {
            let weight = weight(index, copy);
            if weight != 0 {
                let value = f.at((branch.group, index));
                let term = self.graded.scale(&Rational::from(weight), &value);
                sum = self.graded.add(&sum, &term);
            }
        }
        sum
    }

    /// Helmert differences of one value for each copy, written as sums of
    /// differences so that equal copies give exactly zero.
    pub(super) fn differences(&mut self, values: &[Series]) -> Vec<Series> {
        (1..values.len())
            .map(|index| {
                let mut sum = Series::default();
                for value in &values[..index] {
                    let difference = self.graded.sub(value, &values[index]);
                    sum = self.graded.add(&sum, &difference);
                }
                let norm = Rational::from_ratio(1, (index * (index + 1)) as i64);
                self.graded.scale(&norm.unwrap_or_else(Rational::one), &sum)
            })
            .collect()
    }

    pub(super) fn average(&mut self, values: &[Series]) -> Series {
        let mut sum = Series::default();
        for value in values {
            sum = self.graded.add(&sum, value);
        }
        let share = Rational::from_ratio(1, values.len() as i64);
        self.graded
            .scale(&share.unwrap_or_else(Rational::one), &sum)
    }

    /// Product, link by link.
    pub(super) fn mul(&mut self, f: &Field, g: &Field) -> Field {
        debug_assert_eq!(f.orbit, g.orbit);
        let mut result = Field::zero(f.orbit);
        let branch = self.branch(f.orbit);
        let product = self.graded.mul(&f.mean, &g.mean);
        let excess = self.excess(branch, f, g, [&f.mean, &g.mean], &mut result);
        result.mean = self.graded.add(&product, &excess);
        result
    }

    /// The mean of a product less the product of the means within a branching;
    /// its differences go to `result`. Bilinear in small quantities throughout.
    fn excess(
        &mut self,
        branch: Option<&Branch>,
        f: &Field,
        g: &Field,
        [f_mean, g_mean]: [&Series; 2],
        result: &mut Field,
    ) -> Series {
        let Some(branch) = branch else {
            return Series::default();
        };
        let (f_varies, g_varies) = (f.varies_below(Some(branch)), g.varies_below(Some(branch)));
        if !f_varies && !g_varies {
            return Series::default();
        }
        let count = branch.copies.len();
        let mut below = Vec::new();
        for (copy, inner) in branch.copies.iter().enumerate() {
            let inner = inner.as_ref();
            if !f.varies_below(inner) && !g.varies_below(inner) {
                below.push(Series::default());
                continue;
            }
            let offsets = [self.offset(branch, f, copy), self.offset(branch, g, copy)];
            let f_here = self.graded.add(f_mean, &offsets[0]);
            let g_here = self.graded.add(g_mean, &offsets[1]);
            below.push(self.excess(inner, f, g, [&f_here, &g_here], result));
        }
        let from_below = self.differences(&below);
        let mut excess = self.average(&below);
        for index in 1..count {
            let place = (branch.group, index);
            let (f_own, g_own) = (f.at(place), g.at(place));
            let forward = self.graded.mul(f_mean, &g_own);
            let backward = self.graded.mul(&f_own, g_mean);
            let mut difference = self.graded.add(&forward, &backward);
            for i in 1..count {
                for l in 1..count {
                    if let Some(ratio) = structure(count, index, i, l) {
                        let product = self
                            .graded
                            .mul(&f.at((branch.group, i)), &g.at((branch.group, l)));
                        let term = self.graded.scale(&ratio, &product);
                        difference = self.graded.add(&difference, &term);
                    }
                }
            }
            difference = self.graded.add(&difference, &from_below[index - 1]);
            result.put(place, difference);
            let square = self.graded.mul(&f_own, &g_own);
            let share = Rational::from_ratio((index * (index + 1)) as i64, count as i64);
            let term = self
                .graded
                .scale(&share.unwrap_or_else(Rational::one), &square);
            excess = self.graded.add(&excess, &term);
        }
        excess
    }
}
