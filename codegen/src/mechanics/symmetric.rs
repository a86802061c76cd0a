//! The Lagrangian in symmetric coordinates (physics §3), by substitution into the one in absolute
//! angles.

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::SymbolId;
use super::frame::{DerivedFrame, MassMatrix};
use super::meaning::{DerivedSource, DerivedTorque};
use super::mismatch::CopyConstants;
use crate::scene::{Coordinate, CoordinateKind, Group, LinkId};
use std::collections::BTreeMap;

/// Cosine and sine of an integer combination of angles, by angle addition.
#[derive(Clone)]
pub(super) struct Rotation {
    pub(super) cos: Formula,
    pub(super) sin: Formula,
}

impl Rotation {
    fn identity() -> Self {
        Self {
            cos: Formula::integer(1),
            sin: Formula::zero(),
        }
    }

    fn then(&self, other: &Self) -> Self {
        Self {
            cos: (&(&self.cos * &other.cos) - &(&self.sin * &other.sin)).expand(),
            sin: (&(&self.sin * &other.cos) + &(&self.cos * &other.sin)).expand(),
        }
    }

    fn inverse(&self) -> Self {
        Self {
            cos: self.cos.clone(),
            sin: -self.sin.clone(),
        }
    }
}

impl Derivation<'_> {
    /// Derives the Lagrangian in symmetric coordinates q by substituting θ = J q into the one in
    /// absolute angles: M̃ = Jᵀ M J.
    pub(super) fn symmetric_frame(
        &mut self,
        absolute: &DerivedFrame,
        coordinates: &[Coordinate],
        constants: &CopyConstants,
    ) -> DerivedFrame {
        let ids: Vec<SymbolId> = coordinates
            .iter()
            .map(|c| self.coordinate(&c.name))
            .collect();
        let velocities: Vec<SymbolId> =
            coordinates.iter().map(|c| self.velocity(&c.name)).collect();
        let momenta: Vec<SymbolId> = coordinates.iter().map(|c| self.momentum(&c.name)).collect();

        let rows = transformation(coordinates, absolute.coordinates.len());
        for (coordinate, &id) in coordinates.iter().zip(&ids) {
            if let CoordinateKind::Difference { group, .. } = coordinate.kind {
                self.groups_of.insert(id, group);
            }
        }
        let mut replacements = self.substitution(absolute, &ids, &rows);
        replacements.extend(constants.replacements.iter().cloned());
        let mass = transformed_mass(&absolute.mass, &rows, &replacements);
        // Velocities transform like angles: θ = J q, ω = J q̇.
        let angles = transformed(&absolute.coordinates, &ids, &rows);
        let rates = transformed(&absolute.velocities, &velocities, &rows);
        let mut joints =
            self.symmetric_joints(absolute, coordinates, [&ids, &velocities], constants);
        joints.extend(self.symmetric_pairs(coordinates, [&ids, &velocities]));
        let with_constants = |linear: &[(SymbolId, Formula)]| {
            let others = joints.iter().chain(&constants.replacements);
            linear.iter().chain(others).cloned().collect::<Vec<_>>()
        };
        let springs = absolute
            .springs
            .substitute(&with_constants(&angles))
            .expand();
        let gravity = self.symmetric_sum(absolute, &absolute.potential, &replacements);
        // The work of a torque is linear in the root's angle, which is itself a coordinate.
        let moment = self.symmetric_sum(absolute, &absolute.drive, &replacements);
        let torque: Formula = angles
            .iter()
            .map(|(angle, value)| &absolute.drive.derivative(*angle) * value)
            .sum();
        let mut in_rates = with_constants(&rates);
        let torques = self.transformed_torques(absolute, coordinates, &mut in_rates);
        let mut frame = DerivedFrame {
            mass,
            potential: &gravity + &springs,
            springs,
            dissipation: absolute.dissipation.substitute(&in_rates).expand(),
            torques,
            drive: &moment + &torque,
            coordinates: ids,
            velocities,
            momenta,
        };
        frame.potential = &frame.potential + &self.chord_energy(&frame, coordinates);
        frame
    }

    /// Expresses the friction torques, and the rates on which they depend, in the new coordinates.
    /// Torques of equal copies are transformed together; their replacements are added to
    /// `in_rates`.
    fn transformed_torques(
        &mut self,
        absolute: &DerivedFrame,
        coordinates: &[Coordinate],
        in_rates: &mut Vec<(SymbolId, Formula)>,
    ) -> Vec<DerivedTorque> {
        if self.scene.has_unequal_copies() {
            let torques = absolute.torques.iter();
            return torques.map(|torque| torque.substitute(in_rates)).collect();
        }
        let (torques, of_links) = self.symmetric_torques(&absolute.torques, coordinates);
        in_rates.extend(of_links);
        let is_of_pair =
            |torque: &&DerivedTorque| matches!(torque.source, DerivedSource::Pair { .. });
        let pairs = absolute.torques.iter().filter(is_of_pair);
        let pairs = pairs.map(|torque| torque.substitute(in_rates));
        torques.into_iter().chain(pairs).collect()
    }

    /// Returns cos and sin of every absolute angle, and of every difference in the mass matrix, in
    /// the new coordinates.
    fn substitution(
        &mut self,
        absolute: &DerivedFrame,
        ids: &[SymbolId],
        rows: &[Vec<(usize, i64)>],
    ) -> Vec<(SymbolId, Formula)> {
        let mut replacements = Vec::new();
        let known: Vec<_> = self.trigonometry.iter().map(|(k, v)| (*k, *v)).collect();
        for (symbol, meaning) in known {
            use super::derivation::Trigonometric::{
                Cos, CosBetween, Sin, SinBetween, SineOf, VersineOf,
            };
            let (i, j) = match meaning {
                VersineOf(_) | SineOf(_) => continue,
                Cos(a) | Sin(a) => (a, None),
                CosBetween(a, b) | SinBetween(a, b) => (a, Some(b)),
            };
            let position = |id| absolute.coordinates.iter().position(|&c| c == id);
            let Some(link) = position(i) else { continue };
            let rotation = match j {
                None => self.rotation(ids, &rows[link], None),
                Some(j) => {
                    let Some(other) = position(j) else { continue };
                    self.rotation(ids, &rows[link], Some(&rows[other]))
                }
            };
            let value = match meaning {
                Cos(_) | CosBetween(..) => rotation.cos,
                _ => rotation.sin,
            };
            replacements.push((symbol, value));
        }
        replacements
    }

    /// Returns the rotation by a link's angle, or by the difference of two links' angles. Means
    /// enter as one difference, so that cos(θ_m − θ_1) stays a single symbol in code and formulas.
    fn rotation(
        &mut self,
        ids: &[SymbolId],
        link: &[(usize, i64)],
        other: Option<&[(usize, i64)]>,
    ) -> Rotation {
        let (mean, differences) = split(link);
        let start = match other {
            None => self.single(ids[mean]),
            Some(other) => {
                let (other_mean, _) = split(other);
                let (cos, sin) = self.between(ids[mean], ids[other_mean]);
                Rotation {
                    cos: Formula::symbol(cos),
                    sin: Formula::symbol(sin),
                }
            }
        };
        let mut total: BTreeMap<usize, i64> = differences.iter().copied().collect();
        if let Some(other) = other {
            for &(coordinate, weight) in split(other).1 {
                *total.entry(coordinate).or_default() -= weight;
            }
        }
        total.retain(|_, weight| *weight != 0);
        let share: Vec<(SymbolId, i64)> = total
            .into_iter()
            .map(|(coordinate, weight)| (ids[coordinate], weight))
            .collect();
        start.then(&self.share(&share))
    }

    /// Returns the rotation by a sum of differences, group by group.
    ///
    /// It is written with 1 − vers. A quantity that vanishes while the copies of a group are in
    /// phase then consists of terms that vanish one by one, for any motion of other groups: the ones
    /// cancel exactly, before any number is rounded. Cosines would have to cancel by rounding, and
    /// would leave a remainder between more than two copies (2 cos + cos − 3 cos) and between the
    /// cosines of different groups. Where neither occurs cosines are kept, as short as on paper.
    pub(super) fn share(&mut self, share: &[(SymbolId, i64)]) -> Rotation {
        let mut by_group: BTreeMap<usize, Vec<(SymbolId, i64)>> = BTreeMap::new();
        for &(coordinate, weight) in share {
            let group = self.groups_of[&coordinate];
            by_group
                .entry(group)
                .or_default()
                .push((coordinate, weight));
        }
        let plain = self.has_plain_cosines();
        by_group
            .into_values()
            .fold(Rotation::identity(), |turned, combination| {
                turned.then(&self.group_share(&combination, plain))
            })
    }

    /// Returns true if all groups have two copies and none is inside another.
    fn has_plain_cosines(&self) -> bool {
        let groups = &self.scene.groups;
        let nested = |group: &Group| {
            let mut at = group.parent;
            while let Some(link) = at {
                if groups.iter().any(|outer| outer.copies.contains(&link)) {
                    return true;
                }
                at = self.scene.links[link.0].parent;
            }
            false
        };
        groups
            .iter()
            .all(|group| group.copies.len() == 2 && !nested(group))
    }

    fn group_share(&mut self, share: &[(SymbolId, i64)], plain: bool) -> Rotation {
        let (first, weight) = share[0];
        if let ([_], 1 | -1, true) = (share, weight, plain) {
            let single = self.single(first);
            return if weight < 0 { single.inverse() } else { single };
        }
        let turned = weight < 0;
        let combination = share
            .iter()
            .map(|&(c, w)| (c, if turned { -w } else { w }))
            .collect();
        let (versine, sine) = self.combination(&combination);
        let rotation = Rotation {
            cos: &Formula::integer(1) - &Formula::symbol(versine),
            sin: Formula::symbol(sine),
        };
        if turned { rotation.inverse() } else { rotation }
    }

    fn single(&self, coordinate: SymbolId) -> Rotation {
        Rotation {
            cos: Formula::symbol(self.cos(coordinate)),
            sin: Formula::symbol(self.sin(coordinate)),
        }
    }

    /// Transforms a sum of multiples of 1 − cos θ and sin θ, such as the gravitational energy. Each
    /// node contributes G (n − Σ cos θ), with the number n and the mean G of its links: the sum of
    /// cosines simplifies, and the difference from the value at rest stays explicit. Copies that
    /// differ add multiples of mismatches (deviations from the mean constants).
    fn symmetric_sum(
        &self,
        absolute: &DerivedFrame,
        sum: &Formula,
        replacements: &[(SymbolId, Formula)],
    ) -> Formula {
        let mut nodes: Vec<(&str, Vec<LinkId>)> = Vec::new();
        for orbit in &self.scene.orbits {
            match nodes.iter_mut().find(|(node, _)| *node == orbit.node) {
                Some((_, links)) => links.extend(&orbit.links),
                None => nodes.push((&orbit.node, orbit.links.clone())),
            }
        }
        let mut terms = Vec::new();
        for (_, links) in nodes {
            let count = Formula::integer(links.len() as i64);
            let differ = links
                .iter()
                .any(|link| self.scene.links[link.0].orbit != self.scene.links[links[0].0].orbit);
            let mut parts = |function: fn(&Self, SymbolId) -> SymbolId| {
                let symbol = |link: &LinkId| function(self, absolute.coordinates[link.0]);
                let value = |link: &LinkId| Formula::symbol(symbol(link)).substitute(replacements);
                let total = links.iter().map(value).sum::<Formula>().expand();
                if !differ {
                    return (sum.derivative(symbol(&links[0])), total);
                }
                let weight = |link: &LinkId| sum.derivative(symbol(link)).substitute(replacements);
                let weights: Vec<Formula> = links.iter().map(weight).collect();
                let mean = (&weights.iter().cloned().sum::<Formula>() / &count).expand();
                let rest = links.iter().zip(&weights);
                let rest = rest.map(|(link, weight)| &(weight - &mean) * &value(link));
                terms.push(rest.sum::<Formula>().expand());
                (mean, total)
            };
            let (weight, cosines) = parts(Self::cos);
            let (lateral, sines) = parts(Self::sin);
            terms.push(&-weight * &(&count - &cosines));
            terms.push(&lateral * &sines);
        }
        terms.into_iter().sum()
    }
}

/// Returns J of θ = J q: for each link its coordinates and their weights.
fn transformation(coordinates: &[Coordinate], links: usize) -> Vec<Vec<(usize, i64)>> {
    let mut rows = vec![Vec::new(); links];
    for (column, coordinate) in coordinates.iter().enumerate() {
        for &(LinkId(link), weight) in &coordinate.weights {
            rows[link].push((column, weight));
        }
    }
    rows
}

/// Returns M̃ = Jᵀ M J, with the entries of M transformed by `replacements`.
fn transformed_mass(
    mass: &MassMatrix,
    rows: &[Vec<(usize, i64)>],
    replacements: &[(SymbolId, Formula)],
) -> MassMatrix {
    let mut transformed = MassMatrix::default();
    for (i, j, entry) in mass.iter() {
        let entry = entry.substitute(replacements).expand();
        let pairs: &[(usize, usize)] = if i == j { &[(i, i)] } else { &[(i, j), (j, i)] };
        for &(i, j) in pairs {
            for &(a, weight_a) in &rows[i] {
                for &(b, weight_b) in rows[j].iter().filter(|(b, _)| *b <= a) {
                    transformed.add(a, b, &Formula::integer(weight_a * weight_b) * &entry);
                }
            }
        }
    }
    transformed.map(|_, _, sum| sum.expand())
}

/// Returns the replacement of each `old` symbol: the row of J times the `new` ones.
fn transformed(
    old: &[SymbolId],
    new: &[SymbolId],
    rows: &[Vec<(usize, i64)>],
) -> Vec<(SymbolId, Formula)> {
    let sum = |row: &Vec<(usize, i64)>| {
        let terms = row.iter();
        let terms = terms.map(|&(c, w)| &Formula::integer(w) * &Formula::symbol(new[c]));
        terms.sum()
    };
    old.iter()
        .zip(rows)
        .map(|(&id, row)| (id, sum(row)))
        .collect()
}

/// Splits a link's row into its mean and its differences. Means come before differences in the
/// order of coordinates.
fn split(row: &[(usize, i64)]) -> (usize, &[(usize, i64)]) {
    match row.split_first() {
        Some((&(mean, _), differences)) => (mean, differences),
        None => unreachable!("every link has the mean of its node among its coordinates"),
    }
}
