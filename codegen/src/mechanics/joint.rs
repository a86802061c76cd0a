//! Angles and rates of joints. Both are symbols of their own all through the derivation, and
//! are formed by one subtraction: of rounded products κ θ_i − κ θ_π(i) stiff springs would
//! keep few digits.

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::{Role, SymbolId};
use super::frame::DerivedFrame;
use super::meaning::JointDifference;
use super::mismatch::CopyConstants;
use crate::scene::{Coordinate, LinkId};

/// What joints have one of.
#[derive(Clone, Copy)]
pub(super) enum JointQuantity {
    Angle,
    Rate,
    /// Of small differences beside a motion.
    SmallAngle,
    SmallRate,
}

impl Derivation<'_> {
    /// The difference as a symbol, or what it is the same as.
    pub(super) fn joint(
        &mut self,
        quantity: JointQuantity,
        name: &str,
        difference: JointDifference<Formula>,
    ) -> Formula {
        if difference.parent.is_none() && difference.rest.is_zero() {
            return Formula::symbol(difference.own);
        }
        let (code, text, latex) = match quantity {
            // Without its rest it is the angle of the joint.
            JointQuantity::Angle if !difference.rest.is_zero() => ("deflection", "φ", "\\varphi"),
            JointQuantity::Angle => ("joint_angle", "φ", "\\varphi"),
            JointQuantity::Rate => ("joint_rate", "φ̇", "\\dot\\varphi"),
            JointQuantity::SmallAngle => ("joint_delta", "δφ", "\\delta\\varphi"),
            JointQuantity::SmallRate => ("joint_delta_rate", "δφ̇", "\\delta\\dot\\varphi"),
        };
        let symbol = self.indexed(Role::Joint, code, text, latex, name);
        self.joints.insert(symbol, difference);
        Formula::symbol(symbol)
    }

    /// The rate of a link's joint.
    pub(super) fn joint_rate(&mut self, link: usize, velocities: &[SymbolId]) -> Formula {
        self.joint_of(JointQuantity::Rate, link, velocities, Formula::zero())
    }

    /// The difference of a link in the symbols of all links.
    pub(super) fn joint_of(
        &mut self,
        quantity: JointQuantity,
        link: usize,
        symbols: &[SymbolId],
        rest: Formula,
    ) -> Formula {
        let scene = self.scene;
        let parent = scene.links[link].parent;
        let difference = JointDifference {
            own: symbols[link],
            parent: parent.map(|LinkId(parent)| symbols[parent]),
            rest,
        };
        self.joint(quantity, &scene.links[link].name, difference)
    }

    /// What stands for the differences of links in symmetric coordinates: that of a link is
    /// mean + Σ weight · difference, as its angle is.
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
                let mut joints = derivation.joints.iter();
                let (&symbol, joint) = joints.find(|(_, joint)| joint.own == own)?;
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
                let difference = JointDifference {
                    own: of_coordinates[index],
                    parent: self
                        .above(coordinates, coordinate)
                        .map(|parent| of_coordinates[parent]),
                    rest: rest.expand(),
                };
                let difference = self.joint(quantity, &coordinate.name, difference);
                for (LinkId(link), weight) in &coordinate.weights {
                    sums[*link] = &sums[*link] + &(&Formula::integer(*weight) * &difference);
                }
            }
            let joints = joints.into_iter().zip(sums);
            replacements.extend(joints.filter_map(|(joint, sum)| Some((joint?.0, sum))));
        }
        replacements
    }

    /// The coordinate that the parents of a coordinate's links have with the same weights.
    fn above(&self, coordinates: &[Coordinate], coordinate: &Coordinate) -> Option<usize> {
        let parent = |&(LinkId(link), weight): &_| Some((self.scene.links[link].parent?, weight));
        let parents: Option<Vec<(LinkId, i64)>> = coordinate.weights.iter().map(parent).collect();
        let parents = parents?;
        coordinates
            .iter()
            .position(|other| parents.iter().all(|pair| other.weights.contains(pair)))
    }

    /// What stands for differences of which these constants are taken for zero.
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

    /// A formula in which differences between copies that are at rest at several angles are
    /// written out, so that what cancels does.
    pub(super) fn with_rests(&self, formula: &Formula) -> Formula {
        let lone = |symbol: SymbolId| {
            let joint = self.joints.get(&symbol)?;
            joint
                .parent
                .is_none()
                .then(|| (symbol, joint.written_out()))
        };
        let replacements: Vec<_> = formula.symbols().into_iter().filter_map(lone).collect();
        formula.substitute(&replacements)
    }
}
