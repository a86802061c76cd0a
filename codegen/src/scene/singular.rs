//! Check that the mass matrix is regular for all angles.
//!
//! The mass matrix is singular at a configuration if some nonzero velocities have no kinetic energy
//! there. Call a subtree *yielding* if in some configuration its pivot can move, in some direction,
//! without kinetic energy; the direction turns with the subtree, and subtrees turn independently.
//! Let m, I, d be mass, inertia and centre of mass of a link, and p the points from which its
//! children hang; d and p are measured from its pivot:
//!
//! - A link can turn about its resting pivot without energy if and only if I = 0, m d = 0 and every
//!   child has p = 0 or yields. The mass matrix is singular for some angles if and only if there is
//!   such a link: take the topmost link that moves.
//! - A subtree yields if and only if it can move without turning its first link, or with turning
//!   it:
//!   - m = 0 and all children yield; or
//!   - I = 0, m = 0 and the children that do not yield hang from one common p ≠ 0, which stays at
//!     rest while the link turns about it; or
//!   - I = 0, m > 0, d ≠ 0 and every child yields or has p = d: the link turns about its centre of
//!     mass.
//!
//! Values that are [negligible](NEGLIGIBLE) count as zero. Values that depend on parameters count
//! as different from zero, and from each other unless they are the same expression; the model
//! checks them when it is built.

use super::bodies::Body;
use super::template::Template;
use super::{NEGLIGIBLE, Offset, Quantity};
use crate::report::{Faults, TreeMessage};

/// Reports links that can turn without kinetic energy, only the lowest of each branch: once it is
/// corrected, links above it may be correct.
pub(super) fn check_regular(templates: &[Template], report: &mut Faults) {
    for index in singular(templates) {
        if let Some(Template { name, span, .. }) = templates.get(index) {
            report.error(*span, TreeMessage::Singular { link: name.clone() });
        }
    }
}

/// Children of a link that have already been checked.
struct Subtrees<'a> {
    /// Pivots of the children that do not yield, that is, cannot move without kinetic energy.
    firm: Vec<&'a Offset>,
    /// True if a descendant of the link can turn without kinetic energy.
    singular: bool,
}

/// Returns the links that can turn without kinetic energy and have no such link below them, in the
/// order of the templates.
pub(super) fn singular(templates: &[Template]) -> Vec<usize> {
    let mut below: Vec<Subtrees<'_>> = templates
        .iter()
        .map(|_| Subtrees {
            firm: Vec::new(),
            singular: false,
        })
        .collect();
    let mut found = Vec::new();
    // Children come after their parents, so in reverse order they come first.
    for (index, template) in templates.iter().enumerate().rev() {
        let Some(own) = below.get(index) else {
            continue;
        };
        let turns = can_turn_freely(template, &own.firm);
        let yields = yields(template, &own.firm);
        let singular = own.singular || turns;
        if turns && !own.singular {
            found.push(index);
        }
        if let Some(above) = template.parent.and_then(|parent| below.get_mut(parent)) {
            above.singular |= singular;
            if !yields {
                above.firm.push(&template.pivot);
            }
        }
    }
    found.reverse();
    found
}

/// Returns true if the link can turn about its resting pivot without kinetic energy; `firm` holds
/// the pivots of the children that do not yield.
fn can_turn_freely(Template { body, .. }: &Template, firm: &[&Offset]) -> bool {
    is_without_inertia(body)
        && (is_massless(body) || is_origin(&body.com))
        && firm.iter().all(|pivot| is_origin(pivot))
}

/// Returns true if the link's own pivot can move without kinetic energy.
fn yields(Template { body, .. }: &Template, firm: &[&Offset]) -> bool {
    if is_massless(body) && firm.is_empty() {
        return true;
    }
    if !is_without_inertia(body) {
        return false;
    }
    let centre = if is_massless(body) {
        firm.first().copied()
    } else {
        Some(&body.com)
    };
    centre.is_some_and(|centre| !is_origin(centre) && firm.iter().all(|pivot| *pivot == centre))
}

/// Returns true if a point certainly coincides with the pivot, for all values of the parameters.
fn is_origin(Offset { along, lateral }: &Offset) -> bool {
    let [_, length, _] = NEGLIGIBLE;
    [along, lateral]
        .into_iter()
        .all(|part| is_below(part, length))
}

fn is_massless(body: &Body) -> bool {
    let [mass, _, _] = NEGLIGIBLE;
    is_below(&body.mass, mass)
}

fn is_without_inertia(body: &Body) -> bool {
    let [_, _, inertia] = NEGLIGIBLE;
    is_below(&body.inertia, inertia)
}

/// Returns true if the magnitude of a value is certainly less than `least`, for all values of the
/// parameters.
fn is_below(value: &Quantity, least: f64) -> bool {
    value
        .exact()
        .is_some_and(|number| number.to_f64().abs() < least)
}
