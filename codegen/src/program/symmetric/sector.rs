//! Quantities of a sector (a set of symmetric coordinates: all means, or one difference between
//! copies): its part of a sum over links, its block of the mass matrix, and its part of the
//! potential energy.

use super::field::{SymmetricField, SymmetricTree};
use super::motion::{ConstantValues, Fields, MassEntry, Pose};
use super::series::TruncatedSeries;
use super::tree::{Branch, SectorId, weight};
use std::collections::BTreeMap;

/// Lower triangle of a symmetric matrix; indices are orbits (sets of equal copies of one link) with
/// a coordinate in the sector.
pub(super) type SectorMatrix = BTreeMap<(usize, usize), TruncatedSeries>;

impl SymmetricField {
    /// Returns the component in a sector.
    pub(super) fn component(&self, sector: SectorId) -> TruncatedSeries {
        match sector {
            None => self.mean.clone(),
            Some(id) => self.at(id),
        }
    }

    /// Sets the component in a sector.
    pub(in crate::program) fn set(&mut self, sector: SectorId, value: TruncatedSeries) {
        match sector {
            None => self.mean = value,
            Some(id) => self.put(id, value),
        }
    }

    /// Returns the part of the field in a sector.
    pub(super) fn restricted(&self, sector: SectorId) -> Self {
        let mut part = Self::zero(self.orbit);
        part.set(sector, self.component(sector));
        part
    }
}

impl<'b> SymmetricTree<'b> {
    /// Returns the branching of the given group on the path from the root to an orbit.
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

    /// Returns the orbits that have a coordinate in the sector, parents first.
    pub(super) fn orbits_of(&self, sector: SectorId) -> Vec<usize> {
        (0..self.orbits.len())
            .filter(|&orbit| sector.is_none_or(|(group, _)| self.find(orbit, group).is_some()))
            .collect()
    }

    /// Returns the sum of the squared weights of an orbit's coordinate in the sector.
    pub(super) fn sector_norm(&mut self, orbit: usize, sector: SectorId) -> TruncatedSeries {
        let norm = match sector {
            None => self.orbits[orbit].links as i64,
            Some(id) => self.norm(orbit, id),
        };
        self.series.integer(norm)
    }

    /// Returns Σ weight · value over the links: the generalized force on the sector's coordinate,
    /// if the values are torques on the links.
    pub(in crate::program) fn projected(
        &mut self,
        field: &SymmetricField,
        sector: SectorId,
    ) -> TruncatedSeries {
        let norm = self.sector_norm(field.orbit, sector);
        self.series.mul(&norm, &field.component(sector))
    }

    /// Returns the component of a field in a sector.
    pub(in crate::program) fn component(
        &mut self,
        field: &SymmetricField,
        sector: SectorId,
    ) -> TruncatedSeries {
        field.component(sector)
    }

    /// Converts momenta of the symmetric coordinates to momenta of the links, the inverse of
    /// [`projected`](Self::projected).
    pub(in crate::program) fn per_link(&mut self, momenta: &Fields) -> Fields {
        let mut fields = self.zeros();
        for (orbit, momentum) in momenta.iter().enumerate() {
            let sectors: Vec<SectorId> = std::iter::once(None)
                .chain(momentum.differences.keys().map(|&id| Some(id)))
                .collect();
            for sector in sectors {
                let norm = self.sector_norm(orbit, sector);
                let share = self.series.reciprocal(&norm);
                let value = self.series.mul(&share, &momentum.component(sector));
                fields[orbit].set(sector, value);
            }
        }
        fields
    }

    /// Returns Σ weight² · value over the links.
    pub(super) fn weighted(&mut self, field: &SymmetricField, sector: SectorId) -> TruncatedSeries {
        let Some((group, index)) = sector else {
            return self.projected(field, None);
        };
        let root = self.orbits[field.orbit].branch.as_ref();
        let Some((branch, mean)) =
            root.and_then(|root| self.mean_at(root, field, &field.mean.clone(), group))
        else {
            unreachable!("a sector without this orbit")
        };
        if branch.copies.len() == 2 {
            let links = self.series.integer(2 * branch.links_per_copy as i64);
            return self.series.mul(&links, &mean);
        }
        let means = self.means(branch, field, &mean);
        let mut sum = TruncatedSeries::default();
        for (copy, mean) in means.iter().enumerate() {
            let square = weight(index, copy).pow(2) * branch.links_per_copy as i64;
            let square = self.series.integer(square);
            let term = self.series.mul(&square, mean);
            sum = self.series.add(&sum, &term);
        }
        sum
    }

    /// Returns the mean over all copies of a group.
    fn mean_at<'t>(
        &mut self,
        branch: &'t Branch,
        field: &SymmetricField,
        mean: &TruncatedSeries,
        group: usize,
    ) -> Option<(&'t Branch, TruncatedSeries)> {
        if branch.group == group {
            return Some((branch, mean.clone()));
        }
        branch.copies.iter().enumerate().find_map(|(copy, inner)| {
            let inner = inner.as_ref()?;
            let offset = self.offset(branch, field, copy);
            let here = self.series.add(mean, &offset);
            self.mean_at(inner, field, &here, group)
        })
    }

    /// Returns the sector's block of the mass matrix M̃, given the coupling field of each entry.
    fn block_of(
        &mut self,
        pose: &Pose,
        sector: SectorId,
        coupling: impl Fn(&mut Self, &MassEntry) -> SymmetricField,
    ) -> SectorMatrix {
        let orbits = self.orbits_of(sector);
        let mut block = SectorMatrix::new();
        for entry in &pose.entries {
            if orbits.contains(&entry.row) && orbits.contains(&entry.column) {
                let field = coupling(self, entry);
                let value = self.weighted(&field, sector);
                block.insert((entry.row, entry.column), value);
            }
        }
        block
    }

    fn with_diagonal(
        &mut self,
        values: &ConstantValues,
        sector: SectorId,
        mut block: SectorMatrix,
    ) -> SectorMatrix {
        for orbit in self.orbits_of(sector) {
            let norm = self.sector_norm(orbit, sector);
            let moment = self.series.mul(&norm, &values.orbits[orbit].moment);
            block.insert((orbit, orbit), moment);
        }
        block
    }

    /// Returns the sector's block of the mass matrix at the current angles.
    pub(super) fn block(
        &mut self,
        values: &ConstantValues,
        pose: &Pose,
        sector: SectorId,
    ) -> SectorMatrix {
        let block = self.block_of(pose, sector, |_, entry| entry.value.clone());
        self.with_diagonal(values, sector, block)
    }

    /// Returns the sector's block of the mass matrix at zero angles.
    pub(super) fn block_at_rest(
        &mut self,
        values: &ConstantValues,
        pose: &Pose,
        sector: SectorId,
    ) -> SectorMatrix {
        let block = self.block_of(pose, sector, |_, entry| {
            let coupling = values
                .couplings
                .iter()
                .find(|c| (c.row, c.column) == (entry.row, entry.column));
            let cosine = coupling.map(|c| c.cosine.clone()).unwrap_or_default();
            SymmetricField::uniform(entry.row, cosine)
        });
        self.with_diagonal(values, sector, block)
    }

    /// Returns the time derivative of the sector's block.
    pub(super) fn block_rate(
        &mut self,
        pose: &Pose,
        rates: &Fields,
        sector: SectorId,
    ) -> SectorMatrix {
        self.block_of(pose, sector, |tree, entry| {
            let above = tree.lift(&rates[entry.column], entry.row);
            let relative = tree.sub(&rates[entry.row], &above);
            tree.mul(&entry.slope, &relative)
        })
    }

    /// Returns the quadratic form xᵀ B x.
    pub(super) fn quadratic(
        &mut self,
        block: &SectorMatrix,
        x: &BTreeMap<usize, TruncatedSeries>,
    ) -> TruncatedSeries {
        let mut sum = TruncatedSeries::default();
        for (&(row, column), value) in block {
            let product = self.series.mul(&x[&row], &x[&column]);
            let mut term = self.series.mul(value, &product);
            if row != column {
                term = self.series.add(&term, &term.clone());
            }
            sum = self.series.add(&sum, &term);
        }
        sum
    }

    /// Returns the bilinear form xᵀ B y.
    pub(super) fn bilinear(
        &mut self,
        block: &SectorMatrix,
        x: &BTreeMap<usize, TruncatedSeries>,
        y: &BTreeMap<usize, TruncatedSeries>,
    ) -> TruncatedSeries {
        let mut sum = TruncatedSeries::default();
        for (&(row, column), value) in block {
            let mut product = self.series.mul(&x[&row], &y[&column]);
            if row != column {
                let other = self.series.mul(&x[&column], &y[&row]);
                product = self.series.add(&product, &other);
            }
            let term = self.series.mul(value, &product);
            sum = self.series.add(&sum, &term);
        }
        sum
    }

    /// Returns the inner product Σ x y.
    pub(super) fn inner(
        &mut self,
        x: &BTreeMap<usize, TruncatedSeries>,
        y: &BTreeMap<usize, TruncatedSeries>,
    ) -> TruncatedSeries {
        let mut sum = TruncatedSeries::default();
        for (orbit, value) in x {
            let product = self.series.mul(value, &y[orbit]);
            sum = self.series.add(&sum, &product);
        }
        sum
    }

    /// Solves B x = right for x, by the same elimination as for the mass matrix.
    pub(super) fn solve_block(
        &mut self,
        block: &SectorMatrix,
        right: &BTreeMap<usize, TruncatedSeries>,
        sector: SectorId,
    ) -> BTreeMap<usize, TruncatedSeries> {
        let name = |tree: &Self, orbit: usize| tree.orbits[orbit].name(sector).to_owned();
        let orbits: Vec<usize> = right.keys().copied().collect();
        let mut block = block.clone();
        let mut solution = right.clone();
        let mut ratios = Vec::new();
        for &orbit in orbits.iter().rev() {
            let own = name(self, orbit);
            let reduced = block[&(orbit, orbit)].clone();
            self.series
                .hint(&reduced, &format!("block_reduced_inertia_{own}"));
            let inverse = self.series.reciprocal(&reduced);
            self.series
                .hint(&inverse, &format!("inverse_block_reduced_inertia_{own}"));
            let row: Vec<(usize, TruncatedSeries)> = orbits
                .iter()
                .filter(|&&above| above < orbit)
                .filter_map(|&above| Some((above, block.get(&(orbit, above))?.clone())))
                .collect();
            for (above, value) in &row {
                let ratio = self.series.mul(value, &inverse);
                let above_name = name(self, *above);
                self.series
                    .hint(&ratio, &format!("block_ratio_{own}_{above_name}"));
                for (other, entry) in row.iter().filter(|(other, _)| other <= above) {
                    let product = self.series.mul(&ratio, entry);
                    let old = block.remove(&(*above, *other)).unwrap_or_default();
                    let new = self.series.sub(&old, &product);
                    let other_name = name(self, *other);
                    let reduced = format!("block_reduced_mass_{above_name}_{other_name}");
                    self.series.hint(&new, &reduced);
                    block.insert((*above, *other), new);
                }
                let product = self.series.mul(&ratio, &solution[&orbit]);
                let new = self.series.sub(&solution[above], &product);
                self.series
                    .hint(&new, &format!("reduced_momentum_{above_name}"));
                solution.insert(*above, new);
                ratios.push((orbit, *above, ratio));
            }
            let scaled = self.series.mul(&solution[&orbit], &inverse);
            solution.insert(orbit, scaled);
        }
        for &orbit in &orbits {
            for (_, above, ratio) in ratios.iter().filter(|(o, ..)| *o == orbit) {
                let product = self.series.mul(ratio, &solution[above]);
                let new = self.series.sub(&solution[&orbit], &product);
                solution.insert(orbit, new);
            }
            let own = name(self, orbit);
            self.series
                .hint(&solution[&orbit], &format!("own_omega_{own}"));
        }
        solution
    }

    /// Returns the projection of a vector for each orbit of the sector.
    pub(super) fn projections(
        &mut self,
        fields: &Fields,
        sector: SectorId,
    ) -> BTreeMap<usize, TruncatedSeries> {
        let orbits = self.orbits_of(sector);
        orbits
            .into_iter()
            .map(|orbit| (orbit, self.projected(&fields[orbit], sector)))
            .collect()
    }

    /// Returns the component of a vector for each orbit of the sector.
    pub(super) fn components(
        &self,
        fields: &Fields,
        sector: SectorId,
    ) -> BTreeMap<usize, TruncatedSeries> {
        let orbits = self.orbits_of(sector);
        orbits
            .into_iter()
            .map(|orbit| (orbit, fields[orbit].component(sector)))
            .collect()
    }
}
