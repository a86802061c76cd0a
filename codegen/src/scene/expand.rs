//! Templates to links: every copy written out and named.

use std::collections::BTreeMap;

use proc_macro2::Span;

use super::template::{MAX_LINKS, Template};
use super::{Group, Link, LinkId, Orbit, OrbitId};
use crate::report::{Faults, SizeMessage, TreeMessage};

/// Most pairs of a link and one above it in a tree that is written out. A chain of 100
/// links, 4,950 pairs, takes 2 s in an unoptimised build, with its energies 5 s.
const MAX_PAIRS: usize = 6000;

/// The tree with all its copies.
pub(super) struct ExpandedTree {
    pub(super) links: Vec<Link>,
    pub(super) orbits: Vec<Orbit>,
    pub(super) groups: Vec<Group>,
}

/// A copy that is still to be written out.
struct Pending {
    template: usize,
    parent: Option<LinkId>,
    /// The numbers of the copies that it is or hangs in, as in `_2_1`.
    suffix: String,
}

/// Writes out all copies, parent before child, depth first. The templates must
/// be few enough in copies, see [`check_size`].
pub(super) fn expand(templates: &[Template]) -> ExpandedTree {
    let children = children_of(templates);
    let mut expansion = ExpandedTree {
        links: Vec::new(),
        orbits: orbits(templates),
        groups: Vec::new(),
    };
    let mut groups = BTreeMap::new();
    let mut stack = Vec::new();
    if !templates.is_empty() {
        stack.push(Pending {
            template: 0,
            parent: None,
            suffix: String::new(),
        });
    }
    while let Some(pending) = stack.pop() {
        let Some(template) = templates.get(pending.template) else {
            continue;
        };
        let id = LinkId(expansion.links.len());
        let own = link(template, &pending);
        if let Some(orbit) = expansion.orbits.get_mut(pending.template) {
            // Copies that differ cannot share the name of their node.
            if orbit.name.is_empty() {
                orbit.name.clone_from(&own.name);
            }
            orbit.links.push(id);
        }
        expansion.links.push(own);
        if template.copies > 1 || template.number.is_some() {
            let key = (pending.parent, template.origin);
            let index = *groups.entry(key).or_insert_with(|| {
                expansion.groups.push(Group {
                    name: group_name(template, &pending.suffix),
                    parent: pending.parent,
                    copies: Vec::new(),
                });
                expansion.groups.len() - 1
            });
            if let Some(group) = expansion.groups.get_mut(index) {
                group.copies.push(id);
            }
        }
        for &child in children.get(pending.template).into_iter().flatten() {
            if let Some(below) = templates.get(child) {
                let suffixes = suffixes(below, &pending.suffix);
                stack.extend(suffixes.map(|suffix| Pending {
                    template: child,
                    parent: Some(id),
                    suffix,
                }));
            }
        }
    }
    expansion
}

/// The templates that hang from each, last first: the stack gives back the last first.
fn children_of(templates: &[Template]) -> Vec<Vec<usize>> {
    let mut children = vec![Vec::new(); templates.len()];
    for (index, template) in templates.iter().enumerate().rev() {
        if let Some(siblings) = template.parent.and_then(|parent| children.get_mut(parent)) {
            siblings.push(index);
        }
    }
    children
}

/// The numbers of a template's copies behind those that they hang in, last first.
fn suffixes(template: &Template, above: &str) -> impl Iterator<Item = String> {
    let numbers = match template.number {
        Some(number) => number..=number,
        None => 1..=template.copies,
    };
    let is_numbered = template.copies > 1 || template.number.is_some();
    numbers.rev().map(move |copy| match is_numbered {
        true => format!("{above}_{copy}"),
        false => above.to_owned(),
    })
}

/// One copy of a template.
fn link(template: &Template, pending: &Pending) -> Link {
    let Template {
        name,
        body,
        pivot,
        passive,
        ..
    } = template;
    Link {
        name: format!("{name}{}", pending.suffix),
        parent: pending.parent,
        orbit: OrbitId(pending.template),
        mass: body.mass.clone(),
        inertia: body.inertia.clone(),
        com: body.com.clone(),
        pivot: pivot.clone(),
        end: body.joint.as_ref().unwrap_or(&body.com).clone(),
        passive: passive.clone(),
    }
}

/// The orbits of the templates, still without links, and without names where copies of
/// their node or of one above it differ. Templates stand in the order of their first link.
fn orbits(templates: &[Template]) -> Vec<Orbit> {
    let mut orbits: Vec<Orbit> = Vec::with_capacity(templates.len());
    for template in templates {
        let above = template.parent.and_then(|parent| orbits.get(parent));
        let depth = above.map_or(0, |parent| parent.depth + 1);
        let differ = template.number.is_some() || above.is_some_and(|above| above.name.is_empty());
        let node = template.name.clone();
        orbits.push(Orbit {
            name: if differ { String::new() } else { node.clone() },
            node,
            depth,
            links: Vec::new(),
        });
    }
    orbits
}

/// The name of the group that a copy belongs to: the copy's without its own
/// number.
fn group_name(template: &Template, suffix: &str) -> String {
    let outer = suffix.rsplit_once('_').map_or("", |(outer, _)| outer);
    format!("{}{outer}", template.name)
}

/// Returns true if all copies together are at most [`MAX_LINKS`].
pub(super) fn check_size(templates: &[Template], report: &mut Faults) -> bool {
    let totals = running_totals(templates);
    let beyond = templates
        .iter()
        .zip(totals)
        .find(|(_, links)| *links > MAX_LINKS);
    if let Some((template, _)) = beyond {
        report.error(
            template.span,
            SizeMessage::TooManyLinks { limit: MAX_LINKS },
        );
    }
    beyond.is_none()
}

/// Number of links of the templates up to each, copies included.
pub(super) fn running_totals(templates: &[Template]) -> Vec<usize> {
    let mut copies: Vec<usize> = Vec::with_capacity(templates.len());
    let mut links: usize = 0;
    let mut total = |template: &Template| {
        let above = template.parent.and_then(|parent| copies.get(parent));
        let own = above.copied().unwrap_or(1).saturating_mul(template.copies);
        copies.push(own);
        links = links.saturating_add(own);
        links
    };
    templates.iter().map(&mut total).collect()
}

/// Checks that a tree is small enough for code that is written out: pairs of a link and
/// one above it are the entries of its mass matrix.
pub(super) fn check_pairs(links: &[Link], span: Span, report: &mut Faults) -> bool {
    let mut depths: Vec<usize> = Vec::with_capacity(links.len());
    for link in links {
        let above = link.parent.and_then(|parent| depths.get(parent.0));
        depths.push(above.map_or(0, |depth| depth + 1));
    }
    let pairs = depths.iter().sum();
    if pairs > MAX_PAIRS {
        let limit = MAX_PAIRS;
        report.error(span, SizeMessage::TooManyPairs { pairs, limit });
    }
    pairs <= MAX_PAIRS
}

/// Reports names of links, orbits and groups that two nodes share, and returns the names
/// of all, each with the node's first template.
pub(super) fn check_names(
    expansion: &ExpandedTree,
    templates: &[Template],
    report: &mut Faults,
) -> BTreeMap<String, usize> {
    let ExpandedTree {
        links,
        orbits,
        groups,
    } = expansion;
    let of_orbits = orbits
        .iter()
        .enumerate()
        .flat_map(|(orbit, Orbit { name, node, .. })| [(name, orbit), (node, orbit)]);
    let of_links = links.iter().map(|Link { name, orbit, .. }| (name, orbit.0));
    let of_groups = groups.iter().filter_map(|Group { name, copies, .. }| {
        let first = copies.first()?;
        Some((name, links.get(first.0)?.orbit.0))
    });
    let mut owners: BTreeMap<String, usize> = BTreeMap::new();
    let mut reported = vec![false; templates.len()];
    for (name, template) in of_orbits.chain(of_links).chain(of_groups) {
        let template = templates.get(template).map_or(template, |own| own.origin);
        let owner = *owners.entry(name.clone()).or_insert(template);
        if owner == template {
            continue;
        }
        // One message for each pair of nodes, not for each of their copies.
        let later = owner.max(template);
        if let (Some(reported), Some(node)) = (reported.get_mut(later), templates.get(later))
            && !std::mem::replace(reported, true)
        {
            let name = name.clone();
            report.error(node.span, TreeMessage::DuplicateName { name });
        }
    }
    owners
}
