//! Linear systems with the mass matrix, solved for all copies of an orbit (set of equal copies of
//! one link) at once.

use super::field::{SymmetricField, SymmetricTree};
use super::motion::{ConstantValues, Fields, Pose};
use std::collections::BTreeMap;

/// Lower triangle of a symmetric matrix by orbits. The entry (row, column) belongs to the links of
/// orbit `row` and their ancestors in orbit `column`.
type OrbitMatrix = BTreeMap<(usize, usize), SymmetricField>;

/// Factors L and D of the mass matrix M = LᵀDL. On a tree there is no fill-in.
pub(in crate::program) struct MassFactors {
    inverses: Vec<SymmetricField>,
    /// Orbits of descendant and ancestor, and the multiplier.
    ratios: Vec<(usize, usize, SymmetricField)>,
}

impl SymmetricTree<'_> {
    fn mass_matrix(&mut self, values: &ConstantValues, pose: &Pose) -> OrbitMatrix {
        let mut matrix = OrbitMatrix::new();
        for (orbit, constants) in values.orbits.iter().enumerate() {
            matrix.insert(
                (orbit, orbit),
                SymmetricField::uniform(orbit, constants.moment.clone()),
            );
        }
        for entry in &pose.entries {
            matrix.insert((entry.row, entry.column), entry.value.clone());
        }
        matrix
    }

    /// Factorises the mass matrix from the leaves to the root (Featherstone, Rigid Body Dynamics
    /// Algorithms, 2008, §6.5), for all copies of an orbit at once.
    pub(in crate::program) fn factors(
        &mut self,
        values: &ConstantValues,
        pose: &Pose,
    ) -> MassFactors {
        let mut matrix = self.mass_matrix(values, pose);
        let mut inverses = Vec::new();
        let mut ratios = Vec::new();
        for orbit in (0..self.orbits.len()).rev() {
            let reduced = matrix[&(orbit, orbit)].clone();
            self.named(&reduced, "reduced_inertia");
            let inverse = self.reciprocal(&reduced);
            self.named(&inverse, "inverse_reduced_inertia");
            let row: Vec<(usize, SymmetricField)> = (0..orbit)
                .filter_map(|above| Some((above, matrix.get(&(orbit, above))?.clone())))
                .collect();
            for (above, value) in &row {
                let ratio = self.mul(value, &inverse);
                let name = format!("ratio_{}", self.orbits[*above].name(None));
                self.named(&ratio, &name);
                for (other, entry) in row.iter().filter(|(other, _)| other <= above) {
                    let product = self.mul(&ratio, entry);
                    let product = self.gather(&product, *above);
                    let old = matrix.remove(&(*above, *other));
                    let old = old.unwrap_or_else(|| SymmetricField::zero(*above));
                    let new = self.sub(&old, &product);
                    let name = format!("reduced_mass_{}", self.orbits[*other].name(None));
                    self.hinted(&new, &name);
                    matrix.insert((*above, *other), new);
                }
                ratios.push((orbit, *above, ratio));
            }
            inverses.push(inverse);
        }
        inverses.reverse();
        MassFactors { inverses, ratios }
    }

    /// Solves M x = right for x.
    pub(in crate::program) fn solve(&mut self, factors: &MassFactors, right: &Fields) -> Fields {
        let mut solution = right.clone();
        for (orbit, above, ratio) in &factors.ratios {
            let product = self.mul(ratio, &solution[*orbit]);
            let product = self.gather(&product, *above);
            solution[*above] = self.sub(&solution[*above], &product);
            self.hinted(&solution[*above], "reduced");
        }
        for (orbit, inverse) in factors.inverses.iter().enumerate() {
            solution[orbit] = self.mul(&solution[orbit], inverse);
            for (_, above, ratio) in factors.ratios.iter().filter(|(o, ..)| *o == orbit) {
                let above = self.lift(&solution[*above], orbit);
                let product = self.mul(ratio, &above);
                solution[orbit] = self.sub(&solution[orbit], &product);
            }
            self.hinted(&solution[orbit], "solved");
        }
        solution
    }
}
