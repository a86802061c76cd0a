//! Sectors: their share of a sum over links, their block of the mass matrix,
//! their part of the potential energy.

use super::field::{Copies, Field, Place};
use super::motion::{Entry, Fields, Pose, Values};
use super::series::Series;
use super::tree::{Branch, weight};
use std::collections::BTreeMap;

/// A sector: one difference, or the means.
pub(in crate::program) type Which = Option<Place>;

/// Lower triangle of a symmetric matrix of the orbits in a sector.
pub(super) type Block = BTreeMap<(usize, usize), Series>;

impl Field {
    /// The component in a sector.
    pub(super) fn component(&self, which: Which) -> Series {
        match which {
            None => self.mean.clone(),
            Some(place) => self.at(place),
        }
    }

    /// Sets the component in a sector.
    pub(in crate::program) fn set(&mut self, which: Which, value: Series) {
        match which {
            None => self.mean = value,
            Some(place) => self.put(place, value),
        }
    }

    /// The part of the field that lies in a sector.
    pub(super) fn restricted(&self, which: Which) -> Self {
        let mut part = Self::zero(self.orbit);
        part.set(which, self.component(which));
        part
    }
}

impl<'b> Copies<'b> {
    /// The branching of that group on the way to an orbit.
    fn find(&self, orbit: usize, group: usize) -> Option<&'b Branch> {
        let mut pending: Vec<&Branch> = self.orbits[orbit].branch.as_ref().into_iter().collect();
        while let Some(branch) = pending.pop() {
            if branch.group == group {
                return Some(branch);
            }
            pending.extend(branch.copies.iter().flatten());
        }
        None
    }

    /// The orbits that have a coordinate in the sector, parents first.
    pub(super) fn orbits_of(&self, which: Which) -> Vec<usize> {
        (0..self.orbits.len())
            .filter(|&orbit| which.is_none_or(|(group, _)| self.find(orbit, group).is_some()))
            .collect()
    }

    /// Σ of the squared weights of the sector's coordinate of an orbit.
    pub(super) fn sector_norm(&mut self, orbit: usize, which: Which) -> Series {
        let norm = match which {
            None => self.orbits[orbit].links as i64,
            Some(place) => self.norm(orbit, place),
        };
        self.graded.integer(norm)
    }

    /// Σ over the links of weight · value: what a sum of link torques is for
    /// the sector's coordinate.
    pub(in crate::program) fn projected(&mut self, field: &Field, which: Which) -> Series {
        let norm = self.sector_norm(field.orbit, which);
        self.graded.mul(&norm, &field.component(which))
    }

    /// The component of a field in a sector.
    pub(in crate::program) fn component(&mut self, field: &Field, which: Which) -> Series {
        field.component(which)
    }

    /// Momenta of the symmetric coordinates as momenta of the links: what
    /// [`projected`](Self::projected) undoes.
    pub(in crate::program) fn per_link(&mut self, momenta: &Fields) -> Fields {
        let mut fields = self.zeros();
        for (orbit, momentum) in momenta.iter().enumerate() {
            let sectors: Vec<Which> = std::iter::once(None)
                .chain(momentum.differences.keys().map(|&place| Some(place)))
                .collect();
            for which in sectors {
                let norm = self.sector_norm(orbit, which);
                let share = self.graded.reciprocal(&norm);
                let value = self.graded.mul(&share, &momentum.component(which));
                fields[orbit].set(which, value);
            }
        }
        fields
    }

    /// Σ over the links of weight² · value.
    pub(super) fn weighted(&mut self, field: &Field, which: Which) -> Series {
        let Some((group, index)) = which else {
            return self.projected(field, None);
        };
        let root = self.orbits[field.orbit].branch.as_ref();
        let Some((branch, mean)) =
            root.and_then(|root| self.mean_at(root, field, &field.mean.clone(), group))
        else {
            unreachable!("a sector without this orbit")
        };
        if branch.copies.len() == 2 {
            let links = self.graded.integer(2 * branch.links_per_copy as i64);
            return self.graded.mul(&links, &mean);
        }
        let means = self.means(branch, field, &mean);
        let mut sum = Series::default();
        for (copy, mean) in means.iter().enumerate() {
            let square = weight(index, copy).pow(2) * branch.links_per_copy as i64;
            let square = self.graded.integer(square);
            let term = self.graded.mul(&square, mean);
            sum = self.graded.add(&sum, &term);
        }
        sum
    }

    /// The mean of all copies of a group.
    fn mean_at<'t>(
        &mut self,
        branch: &'t Branch,
        field: &Field,
        mean: &Series,
        group: usize,
    ) -> Option<(&'t Branch, Series)> {
        if branch.group == group {
            return Some((branch, mean.clone()));
        }
        branch.copies.iter().enumerate().find_map(|(copy, inner)| {
            let inner = inner.as_ref()?;
            let offset = self.offset(branch, field, copy);
            let here = self.graded.add(mean, &offset);
            self.mean_at(inner, field, &here, group)
        })
    }

    /// The sector's block of M̃ for the coupling field of each entry.
    fn block_of(
        &mut self,
        pose: &Pose,
        which: Which,
        coupling: impl Fn(&mut Self, &Entry) -> Field,
    ) -> Block {
        let orbits = self.orbits_of(which);
        let mut block = Block::new();
        for entry in &pose.entries {
            if orbits.contains(&entry.row) && orbits.contains(&entry.column) {
                let field = coupling(self, entry);
                let value = self.weighted(&field, which);
                block.insert((entry.row, entry.column), value);
            }
        }
        block
    }

    fn with_diagonal(&mut self, values: &Values, which: Which, mut block: Block) -> Block {
        for orbit in self.orbits_of(which) {
            let norm = self.sector_norm(orbit, which);
            let moment = self.graded.mul(&norm, &values.orbits[orbit].moment);
            block.insert((orbit, orbit), moment);
        }
        block
    }

    /// The sector's block of the mass matrix at the configuration.
    pub(super) fn block(&mut self, values: &Values, pose: &Pose, which: Which) -> Block {
        let block = self.block_of(pose, which, |_, entry| entry.value.clone());
        self.with_diagonal(values, which, block)
    }

    /// The sector's block of the mass matrix with all angles zero.
    pub(super) fn block_at_rest(&mut self, values: &Values, pose: &Pose, which: Which) -> Block {
        let block = self.block_of(pose, which, |_, entry| {
            let coupling = values
                .couplings
                .iter()
                .find(|c| (c.row, c.column) == (entry.row, entry.column));
            let cosine = coupling.map(|c| c.cosine.clone()).unwrap_or_default();
            Field::uniform(entry.row, cosine)
        });
        self.with_diagonal(values, which, block)
    }

    /// The time derivative of the sector's block.
    pub(super) fn block_rate(&mut self, pose: &Pose, rates: &Fields, which: Which) -> Block {
        self.block_of(pose, which, |copies, entry| {
            let above = copies.lift(&rates[entry.column], entry.row);
            let relative = copies.sub(&rates[entry.row], &above);
            copies.mul(&entry.slope, &relative)
        })
    }

    /// xᵀ B x.
    pub(super) fn quadratic(&mut self, block: &Block, x: &BTreeMap<usize, Series>) -> Series {
        let mut sum = Series::default();
        for (&(row, column), value) in block {
            let product = self.graded.mul(&x[&row], &x[&column]);
            let mut term = self.graded.mul(value, &product);
            if row != column {
                term = self.graded.add(&term, &term.clone());
            }
            sum = self.graded.add(&sum, &term);
        }
        sum
    }

    /// xᵀ B y.
    pub(super) fn bilinear(
        &mut self,
        block: &Block,
        x: &BTreeMap<usize, Series>,
        y: &BTreeMap<usize, Series>,
    ) -> Series {
        let mut sum = Series::default();
        for (&(row, column), value) in block {
            let mut product = self.graded.mul(&x[&row], &y[&column]);
            if row != column {
                let other = self.graded.mul(&x[&column], &y[&row]);
                product = self.graded.add(&product, &other);
            }
            let term = self.graded.mul(value, &product);
            sum = self.graded.add(&sum, &term);
        }
        sum
    }

    /// Σ x y.
    pub(super) fn inner(
        &mut self,
        x: &BTreeMap<usize, Series>,
        y: &BTreeMap<usize, Series>,
    ) -> Series {
        let mut sum = Series::default();
        for (orbit, value) in x {
            let product = self.graded.mul(value, &y[orbit]);
            sum = self.graded.add(&sum, &product);
        }
        sum
    }

    /// x with B x = right, by the elimination of the mass matrix.
    pub(super) fn solve_block(
        &mut self,
        block: &Block,
        right: &BTreeMap<usize, Series>,
        which: Which,
    ) -> BTreeMap<usize, Series> {
        let name = |copies: &Self, orbit: usize| copies.orbits[orbit].name(which).to_owned();
        let orbits: Vec<usize> = right.keys().copied().collect();
        let mut block = block.clone();
        let mut solution = right.clone();
        let mut ratios = Vec::new();
        for &orbit in orbits.iter().rev() {
            let own = name(self, orbit);
            let pivot = block[&(orbit, orbit)].clone();
            self.graded.hint(&pivot, &format!("block_pivot_{own}"));
            let inverse = self.graded.reciprocal(&pivot);
            self.graded
                .hint(&inverse, &format!("inverse_block_pivot_{own}"));
            let row: Vec<(usize, Series)> = orbits
                .iter()
                .filter(|&&above| above < orbit)
                .filter_map(|&above| Some((above, block.get(&(orbit, above))?.clone())))
                .collect();
            for (above, value) in &row {
                let ratio = self.graded.mul(value, &inverse);
                let above_name = name(self, *above);
                self.graded
                    .hint(&ratio, &format!("block_ratio_{own}_{above_name}"));
                for (other, entry) in row.iter().filter(|(other, _)| other <= above) {
                    let product = self.graded.mul(&ratio, entry);
                    let old = block.remove(&(*above, *other)).unwrap_or_default();
                    let new = self.graded.sub(&old, &product);
                    block.insert((*above, *other), new);
                }
                let product = self.graded.mul(&ratio, &solution[&orbit]);
                let new = self.graded.sub(&solution[above], &product);
                self.graded
                    .hint(&new, &format!("reduced_momentum_{above_name}"));
                solution.insert(*above, new);
                ratios.push((orbit, *above, ratio));
            }
            let scaled = self.graded.mul(&solution[&orbit], &inverse);
            solution.insert(orbit, scaled);
        }
        for &orbit in &orbits {
            for (_, above, ratio) in ratios.iter().filter(|(o, ..)| *o == orbit) {
                let product = self.graded.mul(ratio, &solution[above]);
                let new = self.graded.sub(&solution[&orbit], &product);
                solution.insert(orbit, new);
            }
            let own = name(self, orbit);
            self.graded
                .hint(&solution[&orbit], &format!("own_omega_{own}"));
        }
        solution
    }

    /// For each orbit of the sector, the projection of a vector.
    pub(super) fn projections(&mut self, fields: &Fields, which: Which) -> BTreeMap<usize, Series> {
        let orbits = self.orbits_of(which);
        orbits
            .into_iter()
            .map(|orbit| (orbit, self.projected(&fields[orbit], which)))
            .collect()
    }

    /// For each orbit of the sector, the component of a vector.
    pub(super) fn components(&self, fields: &Fields, which: Which) -> BTreeMap<usize, Series> {
        let orbits = self.orbits_of(which);
        orbits
            .into_iter()
            .map(|orbit| (orbit, fields[orbit].component(which)))
            .collect()
    }
}
