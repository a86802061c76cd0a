//! Sectors of an invalid description, as far as they can be determined.

use super::is_plain;
use crate::description::{Description, Expression, ExpressionKind, Node, Value};
use std::collections::BTreeSet;

/// Limit on the number of sectors of an invalid description; more would not be useful.
const MOST_SECTORS: usize = 1024;

/// Returns the names of the differences between copies that are single links. A set, because names
/// in an invalid description may be repeated.
pub(super) fn difference_names(description: &Description) -> BTreeSet<String> {
    let mut groups: Vec<(String, usize)> = Vec::new();
    let mut pending: Vec<&Node> = description.roots.iter().collect();
    while let Some(node) = pending.pop() {
        let copies = node.copies.map_or(1, |copies| copies.count as usize);
        let name = node.name.to_string();
        if copies > 1 && copies <= MOST_SECTORS && is_plain(&name) {
            groups.push((name, copies));
        }
        pending.extend(&node.children);
    }
    let alone = groups.len() == 1;
    let names = groups.iter().flat_map(|(name, copies)| {
        let stem = if alone {
            "d".to_owned()
        } else {
            format!("{name}_d")
        };
        let number = move |number: usize| match copies {
            2 => stem.clone(),
            _ => format!("{stem}{number}"),
        };
        (1..*copies).map(number)
    });
    names.collect()
}

/// Returns the number of sectors of the tree, as far as it can be determined.
pub(super) fn sector_count(description: &Description) -> usize {
    let differences = description.roots.iter().map(differences);
    let sectors = differences.fold(1_usize, usize::saturating_add);
    sectors.min(MOST_SECTORS)
}

/// Counts the differences between copies in a subtree: every group of k copies has k − 1.
fn differences(node: &Node) -> usize {
    let copies = node.copies.map_or(1, |copies| copies.count.max(1) as usize);
    let below = if node
        .shape
        .as_ref()
        .is_some_and(|shape| shape == "generations")
    {
        // Σ (k − 1) kⁱ over all generations except the last.
        let branching = rule_count(node, "branching").unwrap_or(1);
        let generations = rule_count(node, "count").unwrap_or(1);
        let power = u32::try_from(generations.saturating_sub(1)).unwrap_or(u32::MAX);
        match rule_count(node, "open") {
            // One open branching per generation.
            Some(_) => generations.saturating_sub(1),
            None => branching.saturating_pow(power).saturating_sub(1),
        }
    } else {
        let children = node.children.iter().map(differences);
        children.fold(0, usize::saturating_add)
    };
    copies.saturating_mul(below).saturating_add(copies - 1)
}

/// Returns a whole number among the properties of a rule.
fn rule_count(node: &Node, name: &str) -> Option<usize> {
    let property = node.properties.iter().find(|p| p.name == name)?;
    match &property.value {
        Value::Single(Expression {
            kind: ExpressionKind::Number(number),
            ..
        }) => number.numerator_text().parse().ok(),
        _ => None,
    }
}
