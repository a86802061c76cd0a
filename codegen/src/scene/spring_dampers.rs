//! Spring-dampers: torsion springs and friction between links that are not parent and child.

use std::collections::BTreeMap;

use super::bodies::{COMMON, Dimension, GivenProperties};
use super::expand::ExpandedTree;
use super::layout::Layout;
use super::line_properties::{LineProperties, line_properties};
use super::link_pairs::{LinkPair, SpringDamperEnds};
use super::passive::{PassiveTorques, check_idle, known_once};
use super::prescribed::LinkNames;
use super::properties::evaluate;
use super::translational::DescribedTranslationalSpringDamper;
use super::values::Values;
use super::{
    Coordinate, CoordinateKind, FrictionLaw, LinkId, OrbitId, Quantity, Reduction, Scene, WholeNode,
};
use crate::description::{BETWEEN, Description, GUY, SIBLINGS, SpringDamperClause, Value};
use crate::report::{Faults, TreeMessage, ValueMessage, nearest};

/// A torsion spring and friction between two links, or between all copies of a node under one link.
/// The torques depend on the difference of the two angles.
#[derive(Debug, Clone, PartialEq)]
pub struct DescribedSpringDamper {
    /// The clause in words, for messages, as in `between(a, b)`.
    pub what: String,
    /// The connected links.
    pub ends: SpringDamperEnds,
    /// Coefficients of spring and friction; the drag is zero.
    pub torques: PassiveTorques,
}

impl Reduction {
    /// Returns the node of the given name if its copies move in phase.
    fn in_phase(&self, name: &str) -> Option<&WholeNode> {
        let mut orbits = self.orbits.iter();
        orbits.find(|orbit| orbit.name == name && orbit.in_phase && orbit.copies > 1)
    }

    /// Returns the number of links of the whole tree that are represented by the parent of this
    /// node.
    fn copies_of_parent(&self, name: &str) -> usize {
        let Some(index) = self.orbits.iter().position(|orbit| orbit.name == name) else {
            return 1;
        };
        let above = self.orbits[..index].iter();
        let above = above.filter(|above| above.end > index && above.in_phase);
        above.map(|above| above.copies).product()
    }
}

impl Scene {
    /// Returns the names of the connected links, which become part of the names of the constants. A
    /// number follows if an earlier spring-damper connects the same links.
    pub fn spring_damper_names(&self, index: usize) -> Vec<String> {
        let ends = |own: &DescribedSpringDamper| match &own.ends {
            SpringDamperEnds::Links(links) => {
                links.map(|LinkId(link)| self.links[link].name.clone())
            }
            SpringDamperEnds::Siblings(node) => [node.clone(), node.clone()],
        };
        let own = ends(&self.spring_dampers[index]);
        let before = self.spring_dampers[..index].iter();
        let number = 1 + before.filter(|other| ends(other) == own).count();
        let number = (number > 1).then(|| number.to_string());
        own.into_iter().chain(number).collect()
    }

    /// Returns springs, friction and drag of all links, and of spring-dampers between links.
    pub fn passive_torques(&self) -> impl Iterator<Item = &PassiveTorques> {
        let links = self.links.iter().map(|link| &link.passive);
        // Spring-dampers between copies in phase have no pairs: the copies are one link.
        let between = self.spring_dampers.iter();
        let between = between.filter(|own| !self.pair_runs(&own.ends).is_empty());
        links.chain(between.map(|own| &own.torques))
    }

    /// Returns the indices of the spring-dampers between the in-phase copies that this link
    /// represents.
    pub fn spring_dampers_in_phase(&self, link: LinkId) -> Vec<usize> {
        let OrbitId(orbit) = self.links[link.0].orbit;
        let node = &self.orbits[orbit].node;
        let is_in_phase =
            (self.reduction.as_ref()).is_some_and(|whole| whole.in_phase(node).is_some());
        let own = self.spring_dampers.iter().enumerate().filter(|(_, own)| {
            matches!(&own.ends, SpringDamperEnds::Siblings(name) if is_in_phase && name == node)
        });
        own.map(|(index, _)| index).collect()
    }

    /// Returns true if spring-dampers make differences between copies grow from zero: either one
    /// acts on several coordinates at once, or its spring is relaxed only if the copies differ.
    pub fn couples_differences(&self, coordinates: &[Coordinate]) -> bool {
        let couples = |pair: LinkPair| {
            let own = &self.spring_dampers[pair.spring_damper];
            let weights = pair.weights(coordinates);
            let is_mean = |&(index, _): &(usize, i64)| {
                matches!(coordinates[index].kind, CoordinateKind::Mean { .. })
            };
            match own.ends {
                SpringDamperEnds::Siblings(_) => false,
                SpringDamperEnds::Links(_) => {
                    !weights.iter().all(is_mean)
                        && (weights.len() > 1 || !own.torques.rest.is_zero())
                }
            }
        };
        self.link_pairs().into_iter().any(couples)
    }

    /// Returns the index of the first spring-damper whose spring couples sectors, or whose spring
    /// is relaxed only if the copies differ, so that the sectors have no separate energies. (A
    /// sector is a set of symmetric coordinates: all means, or one difference between copies.)
    /// Returns `None` if the sum of all springs couples no two sectors.
    pub fn coupling_spring(&self, coordinates: &[Coordinate]) -> Option<usize> {
        if let Layout::Generations { .. } = self.layout {
            // Here `coordinates` describe one link per generation only.
            return self.spring_dampers.iter().position(|own| {
                matches!(own.ends, SpringDamperEnds::Links(_)) && !own.torques.spring.is_zero()
            });
        }
        let sector = |index: usize| coordinates[index].kind.orbit_and_difference().1;
        let mut all: BTreeMap<[usize; 2], Vec<Quantity>> = BTreeMap::new();
        let mut first: BTreeMap<[usize; 2], usize> = BTreeMap::new();
        for pair in self.link_pairs() {
            let torques = &self.spring_dampers[pair.spring_damper].torques;
            if torques.spring.is_zero() {
                continue;
            }
            let weights = pair.weights(coordinates);
            if !torques.rest.is_zero() && weights.iter().any(|&(index, _)| sector(index).is_some())
            {
                return Some(pair.spring_damper);
            }
            for (place, &(i, own)) in weights.iter().enumerate() {
                let others = weights[place + 1..].iter();
                for &(j, other) in others.filter(|&&(j, _)| sector(j) != sector(i)) {
                    let share = [Quantity::integer(own * other), torques.spring.clone()];
                    all.entry([i, j])
                        .or_default()
                        .push(Quantity::product(share));
                    first.entry([i, j]).or_insert(pair.spring_damper);
                }
            }
        }
        let coupled = all
            .into_iter()
            .filter(|(_, shares)| !Quantity::sum(shares.clone()).is_zero());
        coupled
            .filter_map(|(key, _)| first.get(&key).copied())
            .min()
    }
}

/// Returns the properties that a spring-damper may have.
fn dimensions(word: &str) -> impl Iterator<Item = &'static Dimension> {
    // The spring between copies is at rest where they are equal.
    let rests = word == BETWEEN;
    COMMON.iter().filter(move |known| {
        let name = known.name;
        name.starts_with("friction") || name == "spring" || (name == "rest" && rests)
    })
}

/// Returns the clause in words.
fn in_words(clause: &SpringDamperClause) -> String {
    let links: Vec<String> = clause.links.iter().map(ToString::to_string).collect();
    format!("{}({})", clause.name, links.join(", "))
}

/// Springs and friction of a clause.
pub(super) enum ClauseForces {
    /// Torques that depend on the difference of two angles.
    Torsional(Box<PassiveTorques>),
    /// Forces along the line between two points.
    Translational(Box<LineProperties>),
}

/// Reads the springs and the friction of all clauses. Adds mistakes to `report`.
pub(super) fn forces_of_spring_dampers(
    clauses: &[SpringDamperClause],
    values: &mut Values,
    report: &mut Faults,
) -> Vec<ClauseForces> {
    let mut own = |clause: &SpringDamperClause| {
        let (word, what) = (clause.name.to_string(), in_words(clause));
        if clause.is_straight() {
            let line = line_properties(clause, &what, values, report);
            return ClauseForces::Translational(Box::new(line));
        }
        if !clause.damaged {
            check_idle(&clause.properties, &what, report);
        }
        let known: Vec<&Dimension> = dimensions(&word).collect();
        let mut given = GivenProperties::default();
        for (known, property) in known_once(&clause.properties, &known, format!("`{word}`"), report)
        {
            match &property.value {
                Value::Each { span, .. } => report.error(*span, ValueMessage::EachWithoutCopies),
                _ => {
                    let value = evaluate(known, property, &what, values, report);
                    given.0.extend(value.map(|value| (known.name, value)));
                }
            }
        }
        // A mistake is in the report; what follows does not depend on it.
        let _ = FrictionLaw::check(&given, &what, &clause.properties, values, report);
        if clause.properties.is_empty() && !clause.damaged {
            report.error(clause.name.span(), TreeMessage::IdleSpringDamper { what });
        }
        ClauseForces::Torsional(Box::new(PassiveTorques::of(&given)))
    };
    clauses.iter().map(&mut own).collect()
}

/// All spring-dampers of a scene.
#[derive(Default)]
pub(super) struct SceneSpringDampers {
    pub(super) torsional: Vec<DescribedSpringDamper>,
    pub(super) translational: Vec<DescribedTranslationalSpringDamper>,
}

/// Finds the links of all clauses and combines them with the given `forces`. Adds mistakes to
/// `report`.
pub(super) fn resolve_spring_dampers(
    description: &Description,
    forces: Vec<ClauseForces>,
    expansion: &ExpandedTree,
    reduction: Option<&Reduction>,
    names: &LinkNames<'_>,
    report: &mut Faults,
) -> SceneSpringDampers {
    let (clauses, reductions) = (&description.spring_dampers, &description.reductions);
    let mut found = SceneSpringDampers::default();
    for (clause, forces) in clauses.iter().zip(forces) {
        let what = in_words(clause);
        let mut torques = match forces {
            ClauseForces::Torsional(torques) => *torques,
            ClauseForces::Translational(line) => {
                let line = straight(clause, *line, description, (expansion, names), report);
                found.translational.extend(line);
                continue;
            }
        };
        let is_of_siblings = clause.name == SIBLINGS;
        let in_phase = [
            (!reductions.in_phase.is_empty(), "in_phase(...)"),
            (expansion.lineage.is_some(), "open"),
        ];
        let in_phase = in_phase.into_iter().find(|(is_given, _)| *is_given);
        if let (Some((_, setting)), false) = (in_phase, is_of_siblings) {
            report.error(
                clause.name.span(),
                TreeMessage::SpringDamperInPhase { what, setting },
            );
            continue;
        }
        if is_of_siblings && !reductions.locked.is_empty() {
            report.error(clause.name.span(), TreeMessage::SiblingsBesideLock { what });
            continue;
        }
        let ends = match is_of_siblings {
            true => siblings(clause, expansion, reduction, names.layout, report),
            false => two_links(clause, names, report),
        };
        if let (Some(SpringDamperEnds::Siblings(node)), Some(reduction)) = (&ends, reduction) {
            torques.times(reduction.copies_of_parent(node));
        }
        if let Some(ends) = ends {
            found.torsional.push(DescribedSpringDamper {
                what,
                ends,
                torques,
            });
        }
    }
    found
}

/// Finds the end points of a straight spring and damper.
fn straight(
    clause: &SpringDamperClause,
    line: LineProperties,
    description: &Description,
    (expansion, names): (&ExpandedTree, &LinkNames<'_>),
    report: &mut Faults,
) -> Option<DescribedTranslationalSpringDamper> {
    let (what, reductions) = (in_words(clause), &description.reductions);
    let merged = [
        (!reductions.in_phase.is_empty(), "in_phase(...)"),
        (!reductions.locked.is_empty(), "locked(...)"),
        (expansion.lineage.is_some(), "open"),
    ];
    if let Some((_, reduction)) = merged.into_iter().find(|(is_there, _)| *is_there) {
        let noun = line.noun();
        let message = TreeMessage::StraightSpringInReduction {
            what,
            noun,
            reduction,
        };
        report.error(clause.name.span(), message);
        return None;
    }
    if clause.name == GUY {
        let [link] = clause.links.as_slice() else {
            if !clause.damaged {
                report.error(clause.name.span(), TreeMessage::NotOneLink);
            }
            return None;
        };
        let mut motion = description.drive.iter().flat_map(|drive| &drive.parts);
        if motion.any(|part| part.name == "x" || part.name == "y") {
            let what = what.clone();
            report.error(clause.name.span(), TreeMessage::GuyBesideMotion { what });
        }
        return line.guy(what, names.find(link, report)?);
    }
    let ends = match clause.name == SIBLINGS {
        true => siblings(clause, expansion, None, names.layout, report),
        false => two_links(clause, names, report),
    };
    line.between(what, ends?)
}

fn two_links(
    clause: &SpringDamperClause,
    names: &LinkNames<'_>,
    report: &mut Faults,
) -> Option<SpringDamperEnds> {
    let found = clause
        .links
        .iter()
        .filter_map(|link| names.find(link, report));
    let found: Vec<LinkId> = found.collect();
    match (clause.links.as_slice(), found.as_slice()) {
        ([_, _], [a, b]) if a != b => Some(SpringDamperEnds::Links([*a, *b])),
        // An unknown link name has been reported.
        ([_, _], [] | [_]) => None,
        _ if clause.damaged => None,
        _ => {
            report.error(clause.name.span(), TreeMessage::NotTwoLinks);
            None
        }
    }
}

fn siblings(
    clause: &SpringDamperClause,
    expansion: &ExpandedTree,
    reduction: Option<&Reduction>,
    layout: Layout,
    report: &mut Faults,
) -> Option<SpringDamperEnds> {
    let [node] = clause.links.as_slice() else {
        if !clause.damaged {
            report.error(clause.name.span(), TreeMessage::NotOneNode);
        }
        return None;
    };
    let name = node.to_string();
    let orbits = &expansion.orbits;
    let Some(depth) = orbits
        .iter()
        .find(|orbit| orbit.node == name)
        .map(|own| own.depth)
    else {
        let names: Vec<&str> = orbits.iter().map(|orbit| orbit.node.as_str()).collect();
        let nearest = nearest(&name, &names).map(str::to_owned);
        report.error(node.span(), TreeMessage::UnknownNode { name, nearest });
        return None;
    };
    let has_copies = match layout {
        Layout::Generations { branching, .. } => branching > 1 && depth > 0,
        _ if reduction.is_some_and(|whole| whole.in_phase(&name).is_some()) => true,
        _ if expansion.lineage.is_some() => depth > 0,
        _ => expansion.groups.iter().any(|group| {
            let first = group
                .copies
                .first()
                .and_then(|&LinkId(link)| expansion.links.get(link));
            let orbit = first.and_then(|link| orbits.get(link.orbit.0));
            orbit.is_some_and(|orbit| orbit.node == name)
        }),
    };
    if !has_copies {
        report.error(node.span(), TreeMessage::NoSiblings { name });
        return None;
    }
    Some(SpringDamperEnds::Siblings(name))
}
