//! Springs and friction on the difference of two angles: in the pivots of links, and between
//! links that are not parent and child.

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::SymbolId;
use super::joint::JointQuantity;
use super::meaning::PairDifferences;
use crate::scene::{LinkId, LinkPair, PassiveTorques, Scene};

/// Two links, or the root and the ground, with a spring and friction between them.
pub(super) struct Hinge<'s> {
    pub(super) part: HingePart,
    pub(super) words: HingeWords,
    /// Spring and friction; drag of the link of a pivot besides.
    pub(super) passive: &'s PassiveTorques,
}

/// The hinge in constants and in words.
pub(super) struct HingeWords {
    /// Names of the constants.
    pub(super) constants: Vec<String>,
    /// What the spring is one of.
    pub(super) owner: String,
    /// Place of spring and friction.
    pub(super) place: String,
}

/// The links of a hinge.
#[derive(Clone, Copy)]
pub(super) enum HingePart {
    /// A link and what it hangs from.
    Pivot(usize),
    /// Two links, by the number of their pair.
    Pair(usize, LinkPair),
}

impl Scene {
    /// The pivots of all links, and the pairs of links with something between them.
    pub(super) fn hinges(&self) -> Vec<Hinge<'_>> {
        let pivots = self.links.iter().enumerate().map(|(index, link)| {
            let orbit = &self.orbits[link.orbit.0].name;
            Hinge {
                part: HingePart::Pivot(index),
                words: HingeWords {
                    constants: vec![orbit.clone()],
                    owner: format!("of `{orbit}`"),
                    place: format!("in the pivot of `{orbit}`"),
                },
                passive: &link.passive,
            }
        });
        let pairs = self.link_pairs().into_iter().enumerate();
        let pairs = pairs.map(|(number, pair)| Hinge {
            part: HingePart::Pair(number, pair),
            words: self.words_of(pair.spring_damper),
            passive: &self.spring_dampers[pair.spring_damper].torques,
        });
        pivots.chain(pairs).collect()
    }

    /// A spring-damper in constants and in words.
    pub(super) fn words_of(&self, spring_damper: usize) -> HingeWords {
        let what = format!("of `{}`", self.spring_dampers[spring_damper].what);
        HingeWords {
            constants: self.spring_damper_names(spring_damper),
            owner: what.clone(),
            place: what,
        }
    }
}

impl Derivation<'_> {
    /// The difference of the angles of a hinge in the symbols of all links, less the angle at
    /// which its spring is at rest.
    pub(super) fn hinge_angle(
        &mut self,
        part: HingePart,
        angles: &[SymbolId],
        rest: Formula,
    ) -> Formula {
        match part {
            HingePart::Pivot(link) => self.joint_of(JointQuantity::Angle, link, angles, rest),
            HingePart::Pair(number, pair) => {
                let angle = self.pair_difference(JointQuantity::PairAngle, pair, angles, rest);
                self.pairs[number].angle = Some(angle.clone());
                angle
            }
        }
    }

    /// The difference of the rates.
    pub(super) fn hinge_rate(&mut self, part: HingePart, velocities: &[SymbolId]) -> Formula {
        match part {
            HingePart::Pivot(link) => self.joint_rate(link, velocities),
            HingePart::Pair(number, pair) => {
                let none = Formula::zero();
                let rate = self.pair_difference(JointQuantity::PairRate, pair, velocities, none);
                self.pairs[number].rate = Some(rate.clone());
                rate
            }
        }
    }

    /// Names of the links, which tell the hinge from others of the same constants.
    pub(super) fn hinge_names(&self, part: HingePart) -> Vec<String> {
        match part {
            HingePart::Pivot(link) => vec![self.scene.links[link].name.clone()],
            HingePart::Pair(_, pair) => self.pair_names(pair),
        }
    }

    /// Makes room for the differences of all pairs.
    pub(super) fn prepare_pairs(&mut self) {
        let pairs = self.scene.link_pairs();
        self.pairs = pairs.into_iter().map(PairDifferences::of).collect();
    }

    /// Names of the links of a pair; a number besides where a spring-damper before acts
    /// between the same.
    pub(super) fn pair_names(&self, pair: LinkPair) -> Vec<String> {
        let names = pair
            .links
            .map(|LinkId(link)| self.scene.links[link].name.clone());
        let before = self.pairs.iter().filter(|known| {
            known.pair.links == pair.links && known.pair.spring_damper < pair.spring_damper
        });
        let number = 1 + before.count();
        let number = (number > 1).then(|| number.to_string());
        names.into_iter().chain(number).collect()
    }
}
