//! Shapes by name, and a message for links whose shape was probably forgotten.

use super::bodies::{BodyShape, SHAPES};
use crate::description::Node;
use crate::report::{TreeMessage, nearest};

/// Other words for shapes, each with the name of the shape.
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

/// Returns the shape with the given name.
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

/// Returns a message for a link without a shape that has the name of a shape, or properties that
/// only shapes have. A link with a centre of mass and an inertia may have any name, because a shape
/// has neither property.
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
