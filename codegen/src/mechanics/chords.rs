//! Straight springs between copies, in symmetric coordinates (physics (19.10)).
//!
//! In absolute angles these springs are treated as lines. In symmetric coordinates their energy is
//! ½ Γ |[e^{iθ}]_s|² in each sector s (a set of symmetric coordinates: all means, or one difference
//! between copies) of the copies' differences, where [·]_s is the part in that sector. For k copies
//! Γ = k κ r², which adds to gravity's constant G.

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::SymbolId;
use super::frame::DerivedFrame;
use super::letters;
use super::sectors::OrbitChord;
use super::symmetric::Rotation;
use crate::scene::{Coordinate, CoordinateKind, DescribedChordSpring, LinkId};

impl Derivation<'_> {
    /// Returns the restoring constant in the sector of a coordinate, in two forms: one symbol Λ for
    /// gravity's G plus the springs' Γ, which keeps the energy transfer as short as without
    /// springs, and the sum G + Γ. Without springs both are G.
    pub(super) fn restoring(&mut self, coordinate: &Coordinate, gravity: Formula) -> [Formula; 2] {
        let Some(own) = self.chord(coordinate) else {
            return [gravity.clone(), gravity];
        };
        let sum = &gravity + &self.chord_of(&own);
        if gravity.is_zero() {
            return [sum.clone(), sum];
        }
        let group = &self.scene.groups[own.group];
        let meaning = format!(
            "gravity's G and Γ of the straight springs of `{}`, together",
            group.name
        );
        let known = self.constants.iter();
        let known: Vec<_> = known.map(|(&id, own)| (id, own.value.clone())).collect();
        let value = sum.substitute(&known);
        [
            self.lettered(letters::RESTORING, &[&group.name], &meaning, value),
            sum,
        ]
    }

    /// Returns the springs in the sector of a coordinate, if they connect the coordinate's links.
    fn chord(&self, coordinate: &Coordinate) -> Option<DescribedChordSpring> {
        let CoordinateKind::Difference { group, .. } = coordinate.kind else {
            return None;
        };
        // Coordinates of links below the copies belong to the same sector.
        let copies = &self.scene.groups[group].copies;
        let mut links = coordinate.weights.iter();
        let are_copies = links.all(|(link, _)| copies.contains(link));
        let own = self.chords.iter().find(|own| own.group == group);
        own.filter(|_| are_copies).cloned()
    }

    fn chord_of(&mut self, own: &DescribedChordSpring) -> Formula {
        let group = &self.scene.groups[own.group];
        let count = group.copies.len();
        let meaning = format!(
            "{count} times the stiffness of the straight springs between every two copies of `{}`, \
             by the square of their distance from the pivot",
            group.name
        );
        let value = &Formula::integer(count as i64) * &self.quantity(&own.strength);
        self.lettered(letters::CHORD, &[&group.name], &meaning, value)
    }

    /// Returns the energy of all these springs in the symmetric coordinates of a frame.
    pub(super) fn chord_energy(
        &mut self,
        frame: &DerivedFrame,
        coordinates: &[Coordinate],
    ) -> Formula {
        let chords = self.chords.clone();
        let energy = chords.iter().map(|own| {
            let squares = self.half_squares(frame, coordinates, own.group);
            &self.chord_of(own) * &squares
        });
        energy.sum()
    }

    /// Returns ½ Σ |[e^{iθ}]_s|² over the differences s of a group of k copies. φ are the angles of
    /// the copies minus their mean. The result is Σ vers φ − ((Σ vers φ)² + (Σ sin φ)²)/(2 k), or
    /// sin² φ for two copies, with vers φ = 1 − cos φ. Each term vanishes with the differences.
    fn half_squares(
        &mut self,
        frame: &DerivedFrame,
        coordinates: &[Coordinate],
        group: usize,
    ) -> Formula {
        let copies = &self.scene.groups[group].copies;
        let (mut versines, mut sines) = (Vec::new(), Vec::new());
        for &link in copies {
            let share = coordinates.iter().zip(&frame.coordinates);
            let share = share.filter_map(|(coordinate, &id)| match coordinate.kind {
                CoordinateKind::Difference { group: own, .. } if own == group => {
                    let mut weights = coordinate.weights.iter();
                    let (_, weight) = weights.find(|(known, _)| *known == link)?;
                    Some((id, *weight))
                }
                _ => None,
            });
            let share: Vec<(SymbolId, i64)> = share.collect();
            let Rotation { cos, sin } = self.share(&share);
            versines.push(&Formula::integer(1) - &cos);
            sines.push(sin);
        }
        if let [sine, _] = sines.as_slice() {
            return sine.pow(2);
        }
        let twice = Formula::integer(2 * sines.len() as i64);
        let [versine, sine] =
            [versines, sines].map(|own| own.into_iter().sum::<Formula>().expand());
        let squares = &versine.pow(2) + &sine.pow(2);
        &versine - &(&squares / &twice)
    }

    /// Returns the springs' constant Γ of each group of copies as plain data.
    pub(super) fn orbit_chords(&mut self) -> Vec<OrbitChord> {
        let chords = self.chords.clone();
        let plain = chords.iter().map(|own| {
            let LinkId(first) = self.scene.groups[own.group].copies[0];
            let weight = self.chord_of(own);
            OrbitChord {
                group: own.group,
                orbit: self.scene.links[first].orbit.0,
                weight: weight.to_expr(&self.symbols),
            }
        });
        plain.collect()
    }
}
