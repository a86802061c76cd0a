//! Spring-dampers: torsion springs and friction between links that are not parent and child.

use super::bodies::{COMMON, Dimension, GivenProperties};
use super::expand::ExpandedTree;
use super::layout::Layout;
use super::passive::{PassiveTorques, check_idle};
use super::prescribed::LinkNames;
use super::properties::evaluate;
use super::values::Values;
use super::{LinkId, Quantity};
use crate::description::{Description, Property, SpringDamperClause, Value};
use crate::report::{Faults, SyntaxMessage, TreeMessage, ValueMessage, nearest};

/// A torsion spring and friction between two links, or between all copies of a node under one
/// link, on the difference of their angles.
#[derive(Debug, Clone, PartialEq)]
pub struct DescribedSpringDamper {
    /// The clause in words, as in `between(a, b)`.
    pub what: String,
    /// The links.
    pub ends: SpringDamperEnds,
    /// Spring and friction; there is no drag.
    pub torques: PassiveTorques,
}

/// The links of a spring-damper.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SpringDamperEnds {
    /// Two links; where the code is loops over generations, by their index in the whole tree.
    Links([LinkId; 2]),
    /// All copies of the node of that name under one link, two by two.
    Siblings(String),
}

/// Word of the clause that names two links, and of the one that names a node.
const BETWEEN: &str = "between";
const SIBLINGS: &str = "siblings";

/// Properties of a spring-damper.
fn dimensions(word: &str) -> impl Iterator<Item = &'static Dimension> {
    // Copies do not differ where they are at rest.
    let rests = word == BETWEEN;
    COMMON.iter().filter(move |known| {
        let name = known.name;
        name.starts_with("friction") || name == "spring" || (name == "rest" && rests)
    })
}

/// The clause in words.
fn in_words(clause: &SpringDamperClause) -> String {
    let links: Vec<String> = clause.links.iter().map(ToString::to_string).collect();
    format!("{}({})", clause.name, links.join(", "))
}

/// Reads the springs and the friction of all clauses; what is wrong goes to `report`.
pub(super) fn torques_of_spring_dampers(
    clauses: &[SpringDamperClause],
    values: &mut Values,
    report: &mut Faults,
) -> Vec<PassiveTorques> {
    let mut own = |clause: &SpringDamperClause| {
        let (word, what) = (clause.name.to_string(), in_words(clause));
        if !clause.damaged {
            check_idle(&clause.properties, &what, report);
        }
        let mut given = GivenProperties::default();
        let mut seen: Vec<String> = Vec::new();
        for property in &clause.properties {
            let name = property.key();
            if seen.contains(&name) {
                let message = SyntaxMessage::duplicate_property(&name);
                report.error(property.name.span(), message);
                continue;
            }
            match (
                dimensions(&word).find(|known| known.name == name),
                &property.value,
            ) {
                (Some(_), Value::Each { span, .. }) => {
                    report.error(*span, ValueMessage::EachWithoutCopies);
                }
                (Some(known), _) => {
                    let value = evaluate(known, property, &what, values, report);
                    given.0.extend(value.map(|value| (known.name, value)));
                }
                (None, _) => report.error(property.name.span(), unknown(&word, property)),
            }
            seen.push(name);
        }
        if clause.properties.is_empty() && !clause.damaged {
            report.error(clause.name.span(), TreeMessage::IdleSpringDamper { what });
        }
        PassiveTorques::of(&given)
    };
    clauses.iter().map(&mut own).collect()
}

fn unknown(word: &str, property: &Property) -> TreeMessage {
    let known: Vec<&'static str> = dimensions(word).map(|known| known.name).collect();
    let name = property.key();
    TreeMessage::UnknownProperty {
        nearest: nearest(&name, &known),
        name,
        body: format!("`{word}`"),
        known,
    }
}

/// Finds the links of all clauses, whose torques are these; what is wrong goes to `report`.
pub(super) fn resolve_spring_dampers(
    description: &Description,
    torques: Vec<PassiveTorques<Quantity>>,
    expansion: &ExpandedTree,
    names: &LinkNames<'_>,
    report: &mut Faults,
) -> Vec<DescribedSpringDamper> {
    let (clauses, reductions) = (&description.spring_dampers, &description.reductions);
    let mut spring_dampers = Vec::new();
    for (clause, torques) in clauses.iter().zip(torques) {
        let what = in_words(clause);
        if !reductions.in_phase.is_empty() {
            report.error(
                clause.name.span(),
                TreeMessage::SpringDamperInPhase { what },
            );
            continue;
        }
        if clause.name == SIBLINGS && !reductions.locked.is_empty() {
            report.error(clause.name.span(), TreeMessage::SiblingsBesideLock { what });
            continue;
        }
        let ends = match clause.name == SIBLINGS {
            true => siblings(clause, expansion, names.layout, report),
            false => two_links(clause, names, report),
        };
        if let Some(ends) = ends {
            spring_dampers.push(DescribedSpringDamper {
                what,
                ends,
                torques,
            });
        }
    }
    spring_dampers
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
        // A name that no link has is reported.
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
