//! The text of a description with numbers in place of its parameters.

use branched_pendulum::system::Model;
use branched_pendulum_trees::PendulumTree;

use crate::subject::Subject;

/// Largest relative difference of an acceleration between a tree and its text.
const SAME: f64 = 1e-9;

/// Returns the description of a tree with the values of all parameters written into it; `None` if
/// the text would not describe the same tree.
pub(super) fn written(subject: &Subject) -> Option<String> {
    let description = subject.tree.description();
    let value = |name: &str| subject.tree.value(name);
    let is_named = |name: &str| description.parameters().any(|own| own == name);
    let text = with_values(&subject.text, &|name| {
        is_named(name).then(|| value(name))?
    });
    let read = PendulumTree::parse(&text).ok()?;
    is_same(&subject.tree, &read).then_some(text)
}

/// Compares the accelerations of two trees in one state, in which all links have different angles
/// and velocities.
fn is_same(one: &PendulumTree, other: &PendulumTree) -> bool {
    let links = one.links();
    let theta: Vec<f64> = (1..=links).map(|link| (link as f64).sin()).collect();
    let omega: Vec<f64> = (1..=links).map(|link| (link as f64).cos()).collect();
    let [a, b] = [one, other].map(|tree| match tree.links() == links {
        true => tree.accelerations(0.0, &theta, &omega),
        false => Vec::new(),
    });
    let largest = a.iter().fold(0.0_f64, |most, own| most.max(own.abs()));
    let mut both = a.iter().zip(&b);
    a.len() == b.len() && both.all(|(a, b)| (a - b).abs() <= SAME * largest)
}

/// Replaces names by their values, outside comments; names of properties, links and functions,
/// which `=`, `:` or `(` follow, stay.
fn with_values(text: &str, value: &dyn Fn(&str) -> Option<f64>) -> String {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let (mut written, mut rest) = (String::new(), text);
    while let Some(first) = rest.chars().next() {
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            rest.find("*/").map_or(rest.len(), |end| end + 2)
        } else if is_word(first) {
            // A number with its exponent, or a name.
            rest.find(|c| !is_word(c)).unwrap_or(rest.len())
        } else {
            first.len_utf8()
        };
        let (token, after) = rest.split_at(length);
        let is_name = !after.trim_start().starts_with(['=', ':', '(']);
        match value(token).filter(|_| is_name) {
            Some(value) if value < 0.0 => written.push_str(&format!("({value:?})")),
            Some(value) => written.push_str(&format!("{value:?}")),
            None => written.push_str(token),
        }
        rest = after;
    }
    written
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_properties_stay() {
        let text = "// mass\ngravity = g, rod(mass = mass * 2, com = -com/2 /* com */, joint=1e-3)";
        let values = |name: &str| match name {
            "g" => Some(-9.5),
            "mass" => Some(0.1),
            "com" => Some(1e-7),
            "e" => Some(3.0),
            _ => None,
        };
        assert_eq!(
            with_values(text, &values),
            "// mass\ngravity = (-9.5), rod(mass = 0.1 * 2, com = -1e-7/2 /* com */, joint=1e-3)"
        );
    }
}
