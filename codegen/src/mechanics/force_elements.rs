//! Springs and friction that depend on the difference of two angles: in the pivots of links, and
//! between links that are not parent and child.

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::SymbolId;
use super::joint::JointQuantity;
use super::meaning::PairDifferences;
use crate::scene::{LinkId, LinkPair, PassiveTorques, Scene};

/// A force element: a spring and friction between two links, or between the root and the ground.
pub(super) struct ForceElement<'s> {
    pub(super) part: ElementLinks,
    pub(super) words: ElementWords,
    /// Coefficients of spring and friction; for a pivot also the drag of the link.
    pub(super) passive: &'s PassiveTorques,
}

/// Names of a force element for constants and for docs.
pub(super) struct ElementWords {
    /// Names that become part of the constants' names.
    pub(super) constants: Vec<String>,
    /// Owner of the spring, in words.
    pub(super) owner: String,
    /// Location of spring and friction, in words.
    pub(super) place: String,
}

/// Links of a force element.
#[derive(Clone, Copy)]
pub(super) enum ElementLinks {
    /// A link and its parent, by the index of the link.
    Pivot(usize),
    /// Two links, with the index of their pair.
    Pair(usize, LinkPair),
}

impl Scene {
    /// Returns the force elements in the pivots of all links and between pairs of links.
    pub(super) fn force_elements(&self) -> Vec<ForceElement<'_>> {
        let pivots = self.links.iter().enumerate().map(|(index, link)| {
            let orbit = &self.orbits[link.orbit.0].name;
            ForceElement {
                part: ElementLinks::Pivot(index),
                words: ElementWords {
                    constants: vec![orbit.clone()],
                    owner: format!("of `{orbit}`"),
                    place: format!("in the pivot of `{orbit}`"),
                },
                passive: &link.passive,
            }
        });
        let pairs = self.link_pairs().into_iter().enumerate();
        let pairs = pairs.map(|(number, pair)| ForceElement {
            part: ElementLinks::Pair(number, pair),
            words: self.words_of(pair.spring_damper),
            passive: &self.spring_dampers[pair.spring_damper].torques,
        });
        pivots.chain(pairs).collect()
    }

    /// Returns the names of a spring-damper for constants and for docs.
    pub(super) fn words_of(&self, spring_damper: usize) -> ElementWords {
        let what = format!("of `{}`", self.spring_dampers[spring_damper].what);
        ElementWords {
            constants: self.spring_damper_names(spring_damper),
            owner: what.clone(),
            place: what,
        }
    }
}

impl Derivation<'_> {
    /// Returns the difference of the two angles minus the spring's rest angle; `angles` are the
    /// symbols of all links.
    pub(super) fn element_angle(
        &mut self,
        part: ElementLinks,
        angles: &[SymbolId],
        rest: Formula,
    ) -> Formula {
        match part {
            ElementLinks::Pivot(link) => self.joint_of(JointQuantity::Angle, link, angles, rest),
            ElementLinks::Pair(number, pair) => {
                let angle = self.pair_difference(JointQuantity::PairAngle, pair, angles, rest);
                self.pairs[number].angle = Some(angle.clone());
                angle
            }
        }
    }

    /// Returns the difference of the two angular velocities.
    pub(super) fn element_rate(&mut self, part: ElementLinks, velocities: &[SymbolId]) -> Formula {
        match part {
            ElementLinks::Pivot(link) => self.joint_rate(link, velocities),
            ElementLinks::Pair(number, pair) => {
                let none = Formula::zero();
                let rate = self.pair_difference(JointQuantity::PairRate, pair, velocities, none);
                self.pairs[number].rate = Some(rate.clone());
                rate
            }
        }
    }

    /// Returns the names of the links, which distinguish the element from others with the same
    /// constants.
    pub(super) fn element_names(&self, part: ElementLinks) -> Vec<String> {
        match part {
            ElementLinks::Pivot(link) => vec![self.scene.links[link].name.clone()],
            ElementLinks::Pair(_, pair) => self.pair_names(pair),
        }
    }

    /// Allocates an entry for the relative angle and rate of every pair.
    pub(super) fn prepare_pairs(&mut self) {
        let pairs = self.scene.link_pairs();
        self.pairs = pairs.into_iter().map(PairDifferences::of).collect();
    }

    /// Returns the names of the two links. A number follows if an earlier spring-damper connects
    /// the same links.
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
