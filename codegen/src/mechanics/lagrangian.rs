//! Derivation of the Lagrangian and of the Euler–Lagrange equations from positions (physics §1), in
//! absolute angles.

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::{Role, SymbolId};
use super::force_elements::ElementLinks;
use super::frame::{DerivedFrame, MassMatrix};
use super::laws::{dissipated, stored};
use super::letters;
use super::meaning::DerivedTorque;
use crate::scene::{Link, LinkId, Offset, Quantity, QuantityAtom};
use std::convert::Infallible;

impl Derivation<'_> {
    /// Derives the Lagrangian in absolute angles: the mass matrix from the velocities of the
    /// centres of mass, the potential energy from their heights, and the dissipation function from
    /// the joints.
    pub(super) fn absolute_frame(&mut self) -> DerivedFrame {
        let names: Vec<String> = self.scene.links.iter().map(|l| l.name.clone()).collect();
        let coordinates: Vec<SymbolId> = names.iter().map(|n| self.coordinate(n)).collect();
        let velocities: Vec<SymbolId> = names.iter().map(|n| self.velocity(n)).collect();
        let momenta: Vec<SymbolId> = names.iter().map(|n| self.momentum(n)).collect();
        self.prepare_pairs();
        self.prepare_lines(&coordinates, &velocities);
        let mass = self.mass_matrix(&coordinates);
        let potential = self.potential(&coordinates);
        let springs = self.springs(&coordinates);
        let mut dissipation = self.dissipation(&velocities);
        dissipation.extend(self.lines.losses.iter().cloned());
        let torques = self.braking_torques(&velocities);
        let work: Vec<Formula> = torques.iter().filter_map(DerivedTorque::work).collect();
        self.drive.note_friction(&dissipation, &work);
        let drive = self.drive_work(&coordinates);
        DerivedFrame {
            coordinates,
            velocities,
            momenta,
            mass,
            potential: &(&potential + &springs) + &self.lines.energy,
            springs,
            dissipation: dissipation.into_iter().chain(work).sum(),
            torques,
            drive,
        }
    }

    /// Returns the row `∂(x, y)/∂θ_i` of the point `offset` = (a, b) on link `i`: x = a sin θ + b
    /// cos θ, y = −a cos θ + b sin θ.
    fn lever(&self, offset: &Offset, angle: SymbolId) -> (Formula, Formula) {
        let (along, lateral) = (self.quantity(&offset.along), self.quantity(&offset.lateral));
        let [x, y] = self.point_at(&along, &lateral, angle);
        (self.partial(&x, angle), self.partial(&y, angle))
    }

    /// Returns, for each link, the points at which it carries weight, with that weight: its centre
    /// of mass, and the pivots of its children with the weight of their subtrees.
    fn carried(&self, weight: impl Fn(&Self, &Link) -> Formula) -> Vec<Vec<(Formula, &Offset)>> {
        let links = &self.scene.links;
        let mut carried: Vec<Vec<(Formula, &Offset)>> = links
            .iter()
            .map(|link| vec![(weight(self, link), &link.com)])
            .collect();
        // Parents come before their children, so the reverse order visits children first.
        for (index, link) in links.iter().enumerate().rev() {
            if let Some(LinkId(parent)) = link.parent {
                let weights = carried[index].iter().map(|(weight, _)| weight.clone());
                let whole = weights.sum::<Formula>().expand();
                carried[parent].push((whole, &link.pivot));
            }
        }
        carried
    }

    /// Returns the second derivatives of the kinetic energy K in the angular velocities. The
    /// velocity of a centre of mass is linear in them, so that ∂²K/∂ω_i∂ω_j = Σ_l m_l ∂ṙ_l/∂ω_i ·
    /// ∂ṙ_l/∂ω_j (+ I_l for i = j = l), summed over the links l that both i and j carry. If j is an
    /// ancestor of i, all of these hang from one point of j, whose ∂ṙ/∂ω_j is a common factor.
    fn mass_matrix(&mut self, angles: &[SymbolId]) -> MassMatrix {
        let mut sums: MassMatrix = MassMatrix::default();
        let carried = self.carried(|derivation, link| derivation.quantity(&link.mass));
        let pivots: Vec<Option<(Formula, Formula)>> = self
            .scene
            .links
            .iter()
            .map(|link| {
                let LinkId(parent) = link.parent?;
                Some(self.lever(&link.pivot, angles[parent]))
            })
            .collect();
        for (index, points) in carried.iter().enumerate() {
            let (mut moments_x, mut moments_y) = (Vec::new(), Vec::new());
            for (mass, offset) in points {
                let (x, y) = self.lever(offset, angles[index]);
                sums.add(index, index, mass * &(&(&x * &x) + &(&y * &y)));
                moments_x.push(mass * &x);
                moments_y.push(mass * &y);
            }
            let inertia = self.quantity(&self.scene.links[index].inertia);
            sums.add(index, index, inertia);
            let moment_x: Formula = moments_x.into_iter().sum();
            let moment_y: Formula = moments_y.into_iter().sum();
            let mut below = index;
            while let (Some(LinkId(above)), Some((x, y))) =
                (self.scene.links[below].parent, &pivots[below])
            {
                sums.add(index, above, &(&moment_x * x) + &(&moment_y * y));
                below = above;
            }
        }
        sums.map(|row, column, sum| self.named_entry(angles, row, column, &sum))
    }

    /// Finds the constants in one entry of the mass matrix and names them. A diagonal entry is A
    /// (cos² + sin²); an entry between ancestor j and descendant i is A cos(θ_i − θ_j) + B sin(θ_i
    /// − θ_j). Checks, coefficient by coefficient, that the entry is a polynomial of this form.
    fn named_entry(
        &mut self,
        angles: &[SymbolId],
        row: usize,
        column: usize,
        sum: &Formula,
    ) -> Formula {
        let (i, j) = (angles[row], angles[column]);
        let (orbit_i, orbit_j) = (self.orbit_name(row), self.orbit_name(column));
        if row == column {
            let table = sum.coefficients(&[self.cos(i), self.sin(i)]);
            let coefficient = |c: u32, s: u32| {
                table
                    .get(&vec![c, s])
                    .cloned()
                    .unwrap_or_else(Formula::zero)
            };
            let square = coefficient(2, 0);
            let accounted =
                usize::from(table.contains_key(&vec![0, 0])) + 2 * usize::from(!square.is_zero());
            assert!(
                coefficient(0, 2) == square && table.len() == accounted,
                "diagonal entry of {orbit_i} is not constant: {sum:?}"
            );
            let value = (&square + &coefficient(0, 0)).expand();
            let meaning = format!(
                "moment of inertia of `{orbit_i}` about its pivot, with what hangs from it as point masses at their pivots"
            );
            return self.lettered(letters::INERTIA, &[&orbit_i], &meaning, value);
        }
        let table = sum.coefficients(&[self.cos(i), self.sin(i), self.cos(j), self.sin(j)]);
        let coefficient = |key: [u32; 4]| {
            table
                .get(key.as_slice())
                .cloned()
                .unwrap_or_else(Formula::zero)
        };
        let cosine = coefficient([1, 0, 1, 0]);
        let sine = coefficient([0, 1, 1, 0]);
        let accounted = 2 * usize::from(!cosine.is_zero()) + 2 * usize::from(!sine.is_zero());
        assert!(
            coefficient([0, 1, 0, 1]) == cosine
                && (&coefficient([1, 0, 0, 1]) + &sine).expand().is_zero()
                && table.len() == accounted,
            "entry {orbit_i}, {orbit_j} does not depend on the difference of angles alone: {sum:?}"
        );
        let (cos, sin) = self.between(i, j);
        let orbits = [orbit_i.as_str(), &orbit_j];
        let meaning = format!("inertial coupling of `{orbit_i}` to `{orbit_j}`");
        let a = self.lettered(letters::COUPLING, &orbits, &meaning, cosine);
        let meaning = format!("{meaning} by lateral offsets");
        let b = self.lettered(letters::LATERAL_COUPLING, &orbits, &meaning, sine);
        &(&a * &Formula::symbol(cos)) + &(&b * &Formula::symbol(sin))
    }

    /// Returns Σ weight_l (height of link l), in cosines and sines.
    pub(super) fn heights(
        &self,
        angles: &[SymbolId],
        weight: impl Fn(&Self, &Link) -> Formula,
    ) -> Formula {
        let mut heights = Vec::new();
        for (points, &angle) in self.carried(weight).iter().zip(angles) {
            let cos = Formula::symbol(self.cos(angle));
            let sin = Formula::symbol(self.sin(angle));
            for (weight, offset) in points {
                let height = &(&self.quantity(&offset.lateral) * &sin)
                    - &(&self.quantity(&offset.along) * &cos);
                heights.push(weight * &height);
            }
        }
        heights.into_iter().sum::<Formula>().expand()
    }

    /// Returns the potential energy U = g Σ m_l (height of link l), zero if all angles are zero.
    fn potential(&mut self, angles: &[SymbolId]) -> Formula {
        let total = self.heights(angles, |derivation, link| {
            &derivation.quantity(&derivation.scene.gravity) * &derivation.quantity(&link.mass)
        });
        let mut potential = Vec::new();
        for (index, &angle) in angles.iter().enumerate() {
            let orbit = self.orbit_name(index);
            let (cos, sin) = (self.cos(angle), self.sin(angle));
            let slope = |function| total.derivative(function).expand();
            let (along, lateral) = (-slope(cos), slope(sin));
            let meaning = format!("weight that `{orbit}` carries times its lever");
            let along = self.lettered(letters::GRAVITY, &[&orbit], &meaning, along);
            let meaning = format!("weight that `{orbit}` carries times its lateral lever");
            let lateral = self.lettered(letters::LATERAL_GRAVITY, &[&orbit], &meaning, lateral);
            // Kept as G (1 − cos θ): multiplied out, it would lose digits at small θ.
            potential.push(&along * &(&Formula::integer(1) - &Formula::symbol(cos)));
            potential.push(&lateral * &Formula::symbol(sin));
        }
        potential.into_iter().sum()
    }

    /// Returns the terms of Rayleigh's dissipation function R = ½ Σ c_i (ω_i − ω_π(i))² + ½ Σ k_i
    /// ω_i² of friction in the pivots and drag against the ground, and ½ Σ c (ω_a − ω_b)² of
    /// friction between links; π(i) is the parent of i. The generalized torque of all friction is
    /// −∂R/∂ω_i.
    fn dissipation(&mut self, velocities: &[SymbolId]) -> Vec<Formula> {
        let (scene, mut terms) = (self.scene, Vec::new());
        for element in scene.force_elements() {
            let (words, passive) = (&element.words, element.passive);
            if !passive.friction.is_zero() {
                let meaning = format!("viscous friction {}", words.place);
                let relative = self.element_rate(element.part, velocities);
                let value = self.quantity(&passive.friction);
                let c = self.lettered(letters::FRICTION, &words.constants, &meaning, value);
                terms.push(dissipated(&c, &relative));
            }
            if let (ElementLinks::Pivot(index), false) = (element.part, passive.drag.is_zero()) {
                let meaning = format!("viscous drag {} against the ground", words.owner);
                let value = self.quantity(&passive.drag);
                let k = self.lettered(letters::DRAG, &words.constants, &meaning, value);
                terms.push(dissipated(&k, &Formula::symbol(velocities[index])));
            }
        }
        terms
    }

    /// Returns the energy of the torsion springs: ½ Σ κ_i (θ_i − θ_π(i) − ρ_i)² in the pivots, with
    /// the parent π(i), and ½ Σ κ (θ_a − θ_b − ρ)² between links.
    fn springs(&mut self, angles: &[SymbolId]) -> Formula {
        let (scene, mut terms) = (self.scene, Vec::new());
        for element in scene.force_elements() {
            let (words, passive) = (&element.words, element.passive);
            if passive.spring.is_zero() {
                continue;
            }
            let meaning = format!(
                "angle at which the torsion spring {} is at rest",
                words.owner
            );
            let value = self.quantity(&passive.rest);
            let rest = self.lettered(letters::REST, &words.constants, &meaning, value);
            let strain = self.element_angle(element.part, angles, rest);
            let meaning = format!("stiffness of the torsion spring {}", words.place);
            let value = self.quantity(&passive.spring);
            let stiffness = self.lettered(letters::SPRING, &words.constants, &meaning, value);
            terms.push(stored(&stiffness, &strain));
        }
        terms.into_iter().sum::<Formula>()
    }

    pub(super) fn orbit_name(&self, link: usize) -> String {
        let orbit = self.scene.links[link].orbit;
        self.scene.orbits[orbit.0].name.clone()
    }

    /// Converts a quantity of the description to a formula in its parameters.
    pub(super) fn quantity(&self, quantity: &Quantity) -> Formula {
        let atom = |atom: &QuantityAtom| match atom {
            QuantityAtom::Exact(number) => Formula::number(number),
            QuantityAtom::Parameter(id) => Formula::symbol(self.parameters[id.0]),
        };
        let Ok(formula) = Formula::of(quantity, &mut |own| Ok(atom(own)), &Ok::<_, Infallible>);
        formula
    }

    /// Names a constant of the model and returns its symbol. Zero stays zero and gets no name, so
    /// that the code contains nothing that does not occur in the scene.
    pub(super) fn constant(
        &mut self,
        code: &str,
        text: &str,
        latex: &str,
        meaning: &str,
        unit: &'static str,
        value: Formula,
    ) -> Formula {
        if value.is_zero() {
            return value;
        }
        let known = self.symbols.find(text);
        let id = self.symbols.intern(Role::Constant, code, text, latex);
        match known {
            Some(_) => assert!(
                (&self.constants[&id].value - &value).expand().is_zero(),
                "copies of one description node differ in {code}"
            ),
            None => self.record_constant(id, value, meaning, unit),
        }
        Formula::symbol(id)
    }
}
