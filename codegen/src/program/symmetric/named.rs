//! Names of the means and differences of fields in code, and conversion between fields and values
//! of single links.

use super::field::{SymmetricField, SymmetricTree};
use super::motion::Fields;
use super::series::TruncatedSeries;
use crate::program::ValueId;

impl SymmetricTree<'_> {
    /// Suggests names for the mean and the differences of a field, order by order: `slope_child_m`,
    /// `slope_child_m_order_2`.
    pub(super) fn hinted(&mut self, field: &SymmetricField, letter: &str) {
        let orbit = &self.orbits[field.orbit];
        let parts = field.differences.iter();
        let parts = parts.map(|(&id, value)| (Some(id), value));
        for (sector, value) in std::iter::once((None, &field.mean)).chain(parts) {
            let name = format!("{letter}_{}", orbit.name(sector));
            self.series.hint(value, &name);
        }
    }

    pub(super) fn all_hinted(&mut self, fields: &Fields, letter: &str) {
        for field in fields {
            self.hinted(field, letter);
        }
    }

    /// Names the mean and the differences of a field: `theta_child_m`.
    pub(in crate::program) fn named(&mut self, field: &SymmetricField, letter: &str) {
        let orbit = &self.orbits[field.orbit];
        let parts = field
            .differences
            .iter()
            .map(|(&id, value)| (Some(id), value));
        for (sector, value) in std::iter::once((None, &field.mean)).chain(parts) {
            if let Some(value) = value.coefficient(0) {
                let name = format!("{letter}_{}", orbit.name(sector));
                self.series.builder.name(value, &name);
            }
        }
        self.hinted(field, letter);
    }

    /// Converts the links' values, in the order of the links of the orbit (set of equal copies of
    /// one link), to a field.
    pub(in crate::program) fn analysed(
        &mut self,
        orbit: usize,
        links: &[ValueId],
        letter: &str,
    ) -> SymmetricField {
        let mut field = SymmetricField::zero(orbit);
        let mut next = 0;
        let branch = self.orbits[orbit].branch.as_ref();
        field.mean = self.analysed_below(branch, links, &mut next, &mut field, letter);
        self.named(&field, letter);
        field
    }

    fn analysed_below(
        &mut self,
        branch: Option<&super::tree::Branch>,
        links: &[ValueId],
        next: &mut usize,
        field: &mut SymmetricField,
        letter: &str,
    ) -> TruncatedSeries {
        let Some(branch) = branch else {
            *next += 1;
            return self.series.value(links[*next - 1]);
        };
        let means: Vec<TruncatedSeries> = branch
            .copies
            .iter()
            .map(|copy| self.analysed_below(copy.as_ref(), links, next, field, letter))
            .collect();
        for (index, value) in self.differences(&means).into_iter().enumerate() {
            field.put((branch.group, index + 1), value);
        }
        let mean = self.average(&means);
        // `theta_hand_1_m`, in addition to `theta_hand_1_d`.
        let name = self.orbits[field.orbit].name(Some((branch.group, 1)));
        if let Some((place, _)) = name.rsplit_once("_d") {
            let name = format!("{letter}_{place}_m");
            self.series.hint(&mean, &name);
        }
        mean
    }
}
