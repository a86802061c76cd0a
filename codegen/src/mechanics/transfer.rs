//! Energies H_d of the differences (sub-Hamiltonians), and the energy transfer W into them (physics
//! §5).

use super::EnergyParts;
use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::{Role, SymbolId};
use super::frame::DerivedFrame;
use super::inverse_mass::DerivedExpansion;
use crate::functions::Counting;
use crate::scene::{Coordinate, CoordinateKind, LinkId, OrbitId};

/// Energy H_d = T + V of a difference.
pub(super) struct SubHamiltonian {
    /// Index of the difference among the coordinates.
    pub(super) coordinate: usize,
    pub(super) kinetic: Formula,
    /// Potential part V, written with Λ = G + Γ (gravity plus straight springs).
    pub(super) potential: Formula,
    /// Potential part V, written with G and Γ, which are separate terms of U.
    pub(super) potential_apart: Formula,
}

impl Derivation<'_> {
    /// Derives H_d of one difference between leaves. T = p_d²/(2 M̃_dd). The potential part follows
    /// from Parseval's identity, V = G/(2n) |Σ_j w_j e^{iθ_j}|², with the weights w of the
    /// difference and n = Σ w². For a pair, T = p_d²/(4M) and V = G sin²θ_d. Torsion springs in the
    /// pivots add ½ κ n θ_d². Straight springs between the copies add their Γ to G, together Λ.
    pub(super) fn sub_hamiltonian(
        &mut self,
        frame: &DerivedFrame,
        coordinates: &[Coordinate],
        expansion: &DerivedExpansion,
        coordinate: usize,
    ) -> SubHamiltonian {
        let CoordinateKind::Difference { norm, orbit, .. } = coordinates[coordinate].kind else {
            unreachable!("sub-Hamiltonians belong to differences");
        };
        let momentum = Formula::symbol(frame.momenta[coordinate]);
        let inertia = expansion.orders[0].get(coordinate, coordinate);
        let kinetic = &momentum.pow(2) / &(&Formula::integer(2) * &inertia);

        let mut cosines = Vec::new();
        let mut sines = Vec::new();
        for &(link, weight) in &coordinates[coordinate].weights {
            let (cos, sin) = self.relative_rotation(frame, coordinates, link);
            let weight = Formula::integer(weight);
            cosines.push(&weight * &cos);
            sines.push(&weight * &sin);
        }
        // Kept as a sum of squares: multiplied out, small differences would be lost in the rounding
        // of terms that cancel.
        let square = |terms: Vec<Formula>| terms.into_iter().sum::<Formula>().expand().pow(2);
        let modulus = &square(cosines) + &square(sines);
        let reduced = self.reduce(&modulus, frame, &expansion.differences);
        let modulus = if reduced.is_term() { reduced } else { modulus };
        let gravity = self.gravity_of(orbit);
        let weights = self.restoring(&coordinates[coordinate], gravity);
        // Differences are orthogonal, so a spring in a pivot couples no two of them.
        let angle = frame.coordinates[coordinate];
        let stiffness = self.partial(&self.partial(&frame.springs, angle), angle);
        let half = Formula::integer(2).pow(-1);
        let spring = &(&half * &stiffness) * &Formula::symbol(angle).pow(2);
        let [potential, potential_apart] = weights.map(|weight| {
            let weight = &weight / &Formula::integer(2 * norm);
            &(&weight * &modulus) + &spring
        });
        SubHamiltonian {
            coordinate,
            kinetic,
            potential,
            potential_apart,
        }
    }

    /// Returns cos and sin of θ_link − θ_mean, the deviation of a link's angle from the mean, which
    /// is a sum of differences.
    fn relative_rotation(
        &mut self,
        frame: &DerivedFrame,
        coordinates: &[Coordinate],
        link: LinkId,
    ) -> (Formula, Formula) {
        let share: Vec<(SymbolId, i64)> = coordinates
            .iter()
            .zip(&frame.coordinates)
            .filter(|(coordinate, _)| matches!(coordinate.kind, CoordinateKind::Difference { .. }))
            .filter_map(|(coordinate, &id)| {
                let weight = coordinate.weights.iter().find(|(l, _)| *l == link)?.1;
                Some((id, weight))
            })
            .collect();
        let rotation = self.share(&share);
        (rotation.cos, rotation.sin)
    }

    /// Returns the constant G of the node of an orbit (set of equal copies of one link), or the
    /// mean over copies that differ; zero if no weight hangs off the pivot.
    fn gravity_of(&self, orbit: OrbitId) -> Formula {
        let name = &self.scene.orbits[orbit.0].node;
        match self.symbols.find(&format!("G_{name}")) {
            Some(id) if self.symbols.get(id).role == Role::Constant => Formula::symbol(id),
            _ => Formula::zero(),
        }
    }

    /// Replaces cos² by 1 − sin² for every difference, so that equal formulas become identical.
    pub(super) fn reduce(
        &self,
        formula: &Formula,
        frame: &DerivedFrame,
        coordinates: &[usize],
    ) -> Formula {
        let mut reduced = self.with_rests(formula).expand();
        for &index in coordinates {
            let cos = self.cos(frame.coordinates[index]);
            let sin = Formula::symbol(self.sin(frame.coordinates[index]));
            let square = &Formula::integer(1) - &sin.pow(2);
            reduced = reduced
                .coefficients(&[cos])
                .into_iter()
                .map(|(power, coefficient)| {
                    let odd = Formula::symbol(cos).pow((power[0] % 2) as i32);
                    &(&coefficient * &odd) * &square.pow((power[0] / 2) as i32)
                })
                .sum::<Formula>()
                .expand();
        }
        reduced
    }

    /// Returns the canonical pairs (coordinate, momentum) of the differences.
    pub(super) fn difference_pairs(
        frame: &DerivedFrame,
        expansion: &DerivedExpansion,
    ) -> Vec<(SymbolId, SymbolId)> {
        expansion
            .differences
            .iter()
            .map(|&d| (frame.coordinates[d], frame.momenta[d]))
            .collect()
    }

    /// Returns W to first order in the difference angles, without expansion in the momenta, as in
    /// the paper: {H_d, K − T} with K to that order, and {H_d, U − V}, both truncated at that
    /// order.
    pub(super) fn angle_transfer(
        &mut self,
        frame: &DerivedFrame,
        expansion: &DerivedExpansion,
        energy: &SubHamiltonian,
    ) -> EnergyParts<Formula> {
        let kinetic = expansion.first_order();
        self.truncated(frame, expansion, energy, &kinetic, Counting::Angle, 1)
    }

    /// Returns W to second order in the amplitude: the complete quadratic form in the differences
    /// and their momenta.
    pub(super) fn amplitude_transfer(
        &mut self,
        frame: &DerivedFrame,
        expansion: &DerivedExpansion,
        energy: &SubHamiltonian,
    ) -> EnergyParts<Formula> {
        let kinetic = expansion.second_order_in_amplitude();
        self.truncated(frame, expansion, energy, &kinetic, Counting::Amplitude, 2)
    }

    fn truncated(
        &mut self,
        frame: &DerivedFrame,
        expansion: &DerivedExpansion,
        energy: &SubHamiltonian,
        kinetic: &Formula,
        counting: Counting,
        order: u32,
    ) -> EnergyParts<Formula> {
        let pairs = Self::difference_pairs(frame, expansion);
        let whole = &energy.kinetic + &energy.potential;
        // K − T: the leading kinetic energy of the differences is Σ T. Of this sum only the
        // difference's own T does not commute with H_d.
        let from_kinetic = self.poisson_bracket(&pairs, &whole, kinetic);
        let others = self.other_kinetic(frame, expansion, energy.coordinate);
        let from_others = self.poisson_bracket(&pairs, &whole, &others);
        let rest = (&frame.potential - &energy.potential_apart).expand();
        let from_potential = self.poisson_bracket(&pairs, &energy.kinetic, &rest);
        let mut cut = |formula: Formula| -> Formula {
            let parts = self.orders(&formula, &pairs, counting, order);
            parts.into_iter().sum::<Formula>().expand()
        };
        EnergyParts {
            kinetic: cut(&from_kinetic + &from_others),
            potential: cut(from_potential),
        }
    }

    /// Returns Σ p_s²/(2 M_ss) over the differences other than `coordinate`.
    fn other_kinetic(
        &self,
        frame: &DerivedFrame,
        expansion: &DerivedExpansion,
        coordinate: usize,
    ) -> Formula {
        expansion
            .differences
            .iter()
            .filter(|&&d| d != coordinate)
            .map(|&d| {
                let inertia = expansion.orders[0].get(d, d);
                &Formula::symbol(frame.momenta[d]).pow(2) / &(&Formula::integer(2) * &inertia)
            })
            .sum()
    }

    /// Returns the exact W, given the velocities: dF/dt = Σ ∂F/∂q q̇ + ∂F/∂p ∂L/∂q. The kinetic
    /// part {H_d, K − T} is a sum over the differences s of ∂V/∂q_s (q̇_s − ∂T/∂p_s) and ∂T/∂p_s
    /// ∂K/∂q_s at fixed q̇. The potential part is {H_d, U − V}. Only conservative forces are
    /// included; friction is separate.
    pub(super) fn exact_transfer(
        &mut self,
        frame: &DerivedFrame,
        expansion: &DerivedExpansion,
        energy: &SubHamiltonian,
    ) -> EnergyParts<Formula> {
        let kinetic_gradient = frame.kinetic_gradient(self);
        let potential_gradient = frame.potential_gradient(self);
        let mut kinetic = Vec::new();
        let mut potential = Vec::new();
        for &s in &expansion.differences {
            let (q, p) = (frame.coordinates[s], frame.momenta[s]);
            let velocity = energy.kinetic.derivative(p);
            let slope = self.partial(&energy.potential, q);
            let excess = &Formula::symbol(frame.velocities[s]) - &velocity;
            kinetic.push(&slope * &excess);
            kinetic.push(&velocity * &kinetic_gradient[s]);
            let slope = self.partial(&energy.potential_apart, q);
            potential.push(&velocity * &(&slope - &potential_gradient[s]));
        }
        let short = |terms: Vec<Formula>| {
            let sum = terms.into_iter().sum::<Formula>();
            self.reduce(&sum, frame, &expansion.differences)
        };
        EnergyParts {
            kinetic: short(kinetic),
            potential: short(potential),
        }
    }

    /// Returns the power of friction on H_d: Σ ∂H_d/∂p_s Q_s with Q = −∂R/∂q̇.
    pub(super) fn friction_power(&self, frame: &DerivedFrame, energy: &SubHamiltonian) -> Formula {
        let s = energy.coordinate;
        let velocity = self.own_velocity(frame, energy);
        let torque = -self.partial(&frame.dissipation, frame.velocities[s]);
        (&velocity * &torque).expand()
    }

    /// Returns the power of the drive on H_d: Σ ∂H_d/∂p_s Q_s. A torque on the root does not act on
    /// differences.
    pub(super) fn drive_power(&self, frame: &DerivedFrame, energy: &SubHamiltonian) -> Formula {
        let s = energy.coordinate;
        let velocity = self.own_velocity(frame, energy);
        (&velocity * &frame.drive_forces(self)[s]).expand()
    }

    /// Returns the velocity ∂H_d/∂p_d.
    pub(super) fn own_velocity(&self, frame: &DerivedFrame, energy: &SubHamiltonian) -> Formula {
        energy.kinetic.derivative(frame.momenta[energy.coordinate])
    }
}
