//! Copies that differ: `each(...)` gives every copy of a link its own value.

use quote::format_ident;

use super::coordinates::Coordinate;
use super::template::Template;
use super::{LinkId, Orbit, Scene};
use crate::description::{Node, Property, Value};
use crate::report::{Faults, ValueMessage};

/// Returns the copies of a node one by one, each with its own values, if the description gives them
/// by `each(...)`. Returns `None` otherwise, and after reporting a mistake in `each(...)`.
pub(super) fn unequal_copies(node: &Node, is_rule: bool, report: &mut Faults) -> Option<Vec<Node>> {
    let before = report.diagnostics().len();
    let copies = node.copies.map_or(1, |copies| copies.count as usize);
    let mut differ = false;
    for property in &node.properties {
        let Value::Each { values, span } = &property.value else {
            continue;
        };
        differ = true;
        let link = node.name.to_string();
        let message = match values.len() {
            _ if is_rule => ValueMessage::EachInRule { link },
            _ if copies < 2 => ValueMessage::EachWithoutCopies,
            values if values != copies => ValueMessage::EachCount {
                link,
                copies,
                values,
            },
            _ => continue,
        };
        report.error(*span, message);
    }
    let right = differ && report.diagnostics().len() == before;
    right.then(|| (0..copies).map(|copy| single(node, copy)).collect())
}

/// Returns one copy of a node, without its children.
fn single(node: &Node, copy: usize) -> Node {
    let properties = node.properties.iter().map(|property| {
        let own = match &property.value {
            Value::Each { values, .. } => values.get(copy),
            Value::Single(_) | Value::Pair(..) => None,
        };
        Property {
            value: own.unwrap_or(&property.value).clone(),
            ..property.clone()
        }
    });
    Node {
        name: format_ident!("{}_{}", node.name, copy + 1),
        shape: node.shape.clone(),
        properties: properties.collect(),
        children: Vec::new(),
        copies: node.copies,
        damaged: node.damaged,
    }
}

impl Template {
    /// Returns true if two copies of a node have equal values.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        let same_body = self.body == other.body && self.pivot == other.pivot;
        same_body && self.passive == other.passive
    }
}

/// A node whose copies differ, or hang from copies of another node that differ.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnequalNode {
    /// Name of the node in the description.
    pub name: String,
    /// All links that are copies of the node.
    pub links: Vec<LinkId>,
    /// Indices of the symmetric coordinates of these links, the mean first.
    pub coordinates: Vec<usize>,
}

impl Scene {
    /// Returns true if the copies of some node differ.
    pub fn has_unequal_copies(&self) -> bool {
        self.orbits.iter().any(Orbit::is_of_unequal)
    }

    /// Returns the nodes whose copies differ. `coordinates` are the scene's symmetric coordinates.
    pub fn unequal_nodes(&self, coordinates: &[Coordinate]) -> Vec<UnequalNode> {
        let mut nodes: Vec<UnequalNode> = Vec::new();
        for Orbit { node, links, .. } in self.orbits.iter().filter(|o| o.is_of_unequal()) {
            match nodes.iter_mut().find(|known| known.name == *node) {
                Some(known) => known.links.extend(links),
                None => nodes.push(UnequalNode {
                    name: node.clone(),
                    links: links.clone(),
                    coordinates: Vec::new(),
                }),
            }
        }
        for node in &mut nodes {
            node.links.sort_unstable();
            let own = |(index, coordinate): (usize, &Coordinate)| {
                let mut weights = coordinate.weights.iter();
                weights
                    .all(|(link, _)| node.links.contains(link))
                    .then_some(index)
            };
            // Means come before differences.
            node.coordinates = coordinates.iter().enumerate().filter_map(own).collect();
        }
        nodes
    }
}

impl Orbit {
    /// Returns true if the node of this orbit (set of equal copies of one link) also has copies in
    /// other orbits.
    pub fn is_of_unequal(&self) -> bool {
        self.name != self.node
    }
}
