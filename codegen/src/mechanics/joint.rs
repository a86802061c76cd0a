//! Relative angles and rates of joints. Each is a separate symbol throughout the derivation and is
//! computed by one subtraction. Differences of rounded products such as κ θ_i − κ θ_π(i) would lose
//! digits for stiff springs (π(i) is the parent of i).

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::{Role, SymbolId};
use super::frame::DerivedFrame;
use super::meaning::JointDifference;
use super::mismatch::CopyConstants;
use crate::scene::{Coordinate, LinkId};

/// Kind of a relative quantity.
#[derive(Clone, Copy)]
pub(super) enum JointQuantity {
    Angle,
    Rate,
    /// Relative angle of two links that are not parent and child.
    PairAngle,
    PairRate,
    /// Relative angle of such a pair in symmetric coordinates.
    SymmetricPairAngle,
    SymmetricPairRate,
    /// Relative angle of small deviations from a motion.
    SmallAngle,
    SmallRate,
}

impl Derivation<'_> {
    /// Creates a symbol for the difference, or returns the existing symbol for an equal one.
    pub(super) fn joint(
        &mut self,
        quantity: JointQuantity,
        names: &[impl AsRef<str>],
        difference: JointDifference<Formula>,
    ) -> Formula {
        if let ([(own, 1)], true) = (difference.terms.as_slice(), difference.rest.is_zero()) {
            return Formula::symbol(*own);
        }
        let (code, text, latex) = match quantity {
            // With a rest angle the symbol is the spring's deflection, not the joint's angle.
            JointQuantity::Angle if !difference.rest.is_zero() => ("deflection", "φ", "\\varphi"),
            JointQuantity::Angle => ("joint_angle", "φ", "\\varphi"),
            JointQuantity::Rate => ("joint_rate", "φ̇", "\\dot\\varphi"),
            JointQuantity::PairAngle => ("relative_angle", "φ", "\\varphi"),
            JointQuantity::PairRate => ("relative_rate", "φ̇", "\\dot\\varphi"),
            JointQuantity::SymmetricPairAngle => ("symmetric_angle", "ψ", "\\psi"),
            JointQuantity::SymmetricPairRate => ("symmetric_rate", "ψ̇", "\\dot\\psi"),
            JointQuantity::SmallAngle => ("joint_delta", "δφ", "\\delta\\varphi"),
            JointQuantity::SmallRate => ("joint_delta_rate", "δφ̇", "\\delta\\dot\\varphi"),
        };
        let symbol = self.indexed_by(Role::Joint, [code, text, latex], names);
        self.joints.insert(symbol, difference);
        Formula::symbol(symbol)
    }

    /// Returns the relative rate of a link's joint.
    pub(super) fn joint_rate(&mut self, link: usize, velocities: &[SymbolId]) -> Formula {
        self.joint_of(JointQuantity::Rate, link, velocities, Formula::zero())
    }

    /// Returns the difference between a link and its parent in the symbols of all links.
    pub(super) fn joint_of(
        &mut self,
        quantity: JointQuantity,
        link: usize,
        symbols: &[SymbolId],
        rest: Formula,
    ) -> Formula {
        let scene = self.scene;
        let parent = scene.links[link].parent;
        let parent = parent.map(|LinkId(parent)| symbols[parent]);
        let difference = JointDifference::of_links(symbols[link], parent, rest);
        self.joint(quantity, &[&scene.links[link].name], difference)
    }

    /// Returns the replacements for relative angles or rates of links in symmetric coordinates.
    /// They transform like the angles: link = mean + Σ weight · difference.
    pub(super) fn symmetric_joints(
        &mut self,
        absolute: &DerivedFrame,
        coordinates: &[Coordinate],
        [angles, rates]: [&[SymbolId]; 2],
        constants: &CopyConstants,
    ) -> Vec<(SymbolId, Formula)> {
        let mut replacements = Vec::new();
        for (quantity, of_links, of_coordinates) in [
            (JointQuantity::Angle, &absolute.coordinates, angles),
            (JointQuantity::Rate, &absolute.velocities, rates),
        ] {
            let of_link = |derivation: &Self, &own: &SymbolId| {
                let (symbol, joint) = derivation.joint_in(own)?;
                Some((symbol, joint.rest.substitute(&constants.replacements)))
            };
            let joints: Vec<Option<(SymbolId, Formula)>> =
                of_links.iter().map(|own| of_link(self, own)).collect();
            let mut sums = vec![Formula::zero(); joints.len()];
            for (index, coordinate) in coordinates.iter().enumerate() {
                let known = coordinate.weights.iter();
                let rests = known.filter_map(|(link, weight)| {
                    let (_, rest) = joints[link.0].as_ref()?;
                    Some(&Formula::integer(*weight) * rest)
                });
                let rests: Vec<Formula> = rests.collect();
                if rests.is_empty() {
                    continue;
                }
                let rest =
                    &rests.into_iter().sum::<Formula>() / &Formula::integer(coordinate.norm());
                let above = self.parent_coordinate(coordinates, coordinate);
                let difference = JointDifference::of_links(
                    of_coordinates[index],
                    above.map(|parent| of_coordinates[parent]),
                    rest.expand(),
                );
                let difference = self.joint(quantity, &[&coordinate.name], difference);
                for (LinkId(link), weight) in &coordinate.weights {
                    sums[*link] = &sums[*link] + &(&Formula::integer(*weight) * &difference);
                }
            }
            let joints = joints.into_iter().zip(sums);
            replacements.extend(joints.filter_map(|(joint, sum)| Some((joint?.0, sum))));
        }
        replacements
    }

    /// Returns the joint of the link with this angle or rate, if the joint has its own symbol.
    pub(super) fn joint_in(&self, own: SymbolId) -> Option<(SymbolId, &JointDifference<Formula>)> {
        let joints = self.joints.iter().map(|(&symbol, joint)| (symbol, joint));
        let mut own = joints.filter(|(_, joint)| joint.own() == Some(own));
        own.find(|(symbol, _)| !self.is_of_pair(*symbol))
    }

    /// Returns the index of the coordinate in which the parents of this coordinate's links have the
    /// same weights.
    fn parent_coordinate(
        &self,
        coordinates: &[Coordinate],
        coordinate: &Coordinate,
    ) -> Option<usize> {
        let parent = |&(LinkId(link), weight): &_| Some((self.scene.links[link].parent?, weight));
        let parents: Option<Vec<(LinkId, i64)>> = coordinate.weights.iter().map(parent).collect();
        let parents = parents?;
        coordinates
            .iter()
            .position(|other| parents.iter().all(|pair| other.weights.contains(pair)))
    }

    /// Returns the replacements for relative angles and rates if the constants in `zero` are set to
    /// zero.
    pub(super) fn joints_without(&self, zero: &[(SymbolId, Formula)]) -> Vec<(SymbolId, Formula)> {
        let joints = self.joints.iter();
        let changed = joints.filter(|(_, joint)| {
            let mut symbols = joint.rest.symbols().into_iter();
            symbols.any(|symbol| zero.iter().any(|(constant, _)| *constant == symbol))
        });
        changed
            .map(|(&symbol, joint)| (symbol, joint.written_out().substitute(zero)))
            .collect()
    }

    /// Writes out the differences between copies whose springs have different rest angles, so that
    /// terms can cancel.
    pub(super) fn with_rests(&self, formula: &Formula) -> Formula {
        let lone = |symbol: SymbolId| {
            let joint = self.joints.get(&symbol)?;
            let is_lone = joint.terms.len() == 1;
            is_lone.then(|| (symbol, joint.written_out()))
        };
        let replacements: Vec<_> = formula.symbols().into_iter().filter_map(lone).collect();
        formula.substitute(&replacements)
    }
}
