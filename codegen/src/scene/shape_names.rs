//! Shapes by name, and links that were meant to have one.

use super::bodies::{BodyShape, SHAPES};
use crate::description::Node;
use crate::report::{TreeMessage, nearest};

/// Other words for shapes.
const SYNONYMS: &[(&str, &str)] = &[
    ("sphere", "ball"),
    ("bar", "rod"),
    ("stick", "rod"),
    ("mass", "point"),
    ("bob", "point"),
    ("hoop", "ring"),
];

fn synonym(name: &str) -> Option<&'static str> {
    let meant = SYNONYMS.iter().find(|(other, _)| *other == name);
    meant.map(|(_, shape)| *shape)
}

/// A shape by its name.
pub(super) fn find_shape(name: &str) -> Result<&'static BodyShape, TreeMessage> {
    SHAPES
        .iter()
        .find(|shape| shape.name == name)
        .ok_or_else(|| {
            let mut known: Vec<&'static str> = SHAPES.iter().map(|shape| shape.name).collect();
            known.push("generations");
            TreeMessage::UnknownShape {
                name: name.to_owned(),
                nearest: synonym(name).or_else(|| nearest(name, &known)),
                known,
            }
        })
}

/// The message about a link without a shape that is called as one, or has the properties of
/// one. A link with a centre of mass and an inertia may be called anything: a shape has neither.
pub(super) fn forgotten_shape(node: &Node) -> Option<TreeMessage> {
    let is_given = |name: &str| node.properties.iter().any(|own| own.name == name);
    let is_plain = ["com", "inertia"].into_iter().all(is_given);
    if node.shape.is_some() || node.damaged || is_plain {
        return None;
    }
    let link = node.name.to_string();
    let mut names = SHAPES.iter().map(|shape| shape.name).chain(["generations"]);
    if let Some(shape) = names.find(|name| *name == link) {
        return Some(TreeMessage::ShapeWithoutName { shape });
    }
    let mut dimensions = SHAPES.iter().flat_map(|shape| shape.dimensions);
    let own = dimensions.find(|own| own.name != "mass" && is_given(own.name))?;
    let known: Vec<&str> = SHAPES.iter().map(|shape| shape.name).collect();
    let shape = synonym(&link).or_else(|| nearest(&link, &known));
    Some(TreeMessage::ShapeForgotten {
        link,
        property: own.name,
        shape: shape.unwrap_or("rod"),
    })
}
