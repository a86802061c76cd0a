//! Rates of the momenta: forces from the Lagrangian, slopes of the Hamiltonian, and the change of
//! the mass matrix. No mass matrix is inverted, because the velocities represent M⁻¹ p.

use super::algebra::Formula;
use super::derivation::Derivation;
use super::frame::DerivedFrame;

impl DerivedFrame {
    /// Returns ∂L/∂q_i at fixed velocities.
    pub(super) fn forces(&self, derivation: &Derivation<'_>) -> Vec<Formula> {
        self.kinetic_gradient(derivation)
            .iter()
            .zip(&self.potential_gradient(derivation))
            .map(|(kinetic, potential)| kinetic - potential)
            .collect()
    }

    /// Returns ∂L/∂q_i + Q_i, with the generalized forces Q_i of friction, drag and drive.
    pub(super) fn momentum_rates(&self, derivation: &Derivation<'_>) -> Vec<Formula> {
        let others = self.dissipative_forces(derivation).into_iter();
        self.forces(derivation)
            .into_iter()
            .zip(others.zip(self.drive_forces(derivation)))
            .map(|(force, (loss, drive))| (&(&force + &loss) + &drive).expand())
            .collect()
    }

    /// Returns ∂H/∂q_i at fixed momenta. From ∂M⁻¹ = −M⁻¹ (∂M) M⁻¹ it is −½ Σ v_j (∂_i M_jk) v_k +
    /// ∂U/∂q_i.
    pub(super) fn hamiltonian_slopes(&self, derivation: &Derivation<'_>) -> Vec<Formula> {
        let mut slopes: Vec<Vec<Formula>> = self
            .potential_gradient(derivation)
            .into_iter()
            .map(|slope| vec![slope])
            .collect();
        let half = Formula::integer(2).pow(-1);
        for (j, k, entry) in self.mass.iter() {
            let pair = &Formula::symbol(self.velocities[j]) * &Formula::symbol(self.velocities[k]);
            let pair = if j == k { &half * &pair } else { pair };
            for coordinate in derivation.coordinates_of(entry) {
                let slope = derivation.partial(entry, coordinate);
                slopes[self.index(coordinate)].push(-(&slope * &pair));
            }
        }
        summed(slopes)
    }

    /// Returns (Ṁ v)_i = Σ (∂_k M_ij) v_k v_j.
    pub(super) fn mass_changes(&self, derivation: &Derivation<'_>) -> Vec<Formula> {
        let mut changes = vec![Vec::new(); self.coordinates.len()];
        for (i, j, entry) in self.mass.iter() {
            let velocity = |index: usize| Formula::symbol(self.velocities[index]);
            let change: Formula = derivation
                .coordinates_of(entry)
                .into_iter()
                .map(|c| &derivation.partial(entry, c) * &velocity(self.index(c)))
                .sum();
            changes[i].push(&change * &velocity(j));
            if i != j {
                changes[j].push(&change * &velocity(i));
            }
        }
        summed(changes)
    }
}

fn summed(rows: Vec<Vec<Formula>>) -> Vec<Formula> {
    rows.into_iter()
        .map(|terms| terms.into_iter().sum::<Formula>().expand())
        .collect()
}
