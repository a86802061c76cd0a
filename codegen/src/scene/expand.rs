//! Expands templates (one per node of the description) to links: every copy is written out and
//! named.

use std::collections::BTreeMap;

use proc_macro2::Span;

use super::template::{MAX_LINKS, Template};
use super::{Group, Lineage, Link, LinkId, Orbit, OrbitId};
use crate::report::{Faults, SizeMessage, TreeMessage};

/// Largest number of pairs of a link and one of its ancestors in a tree that is written out. A
/// chain of 100 links has 4,950 pairs and takes 2 s in an unoptimised build, or 5 s with its
/// energies.
const MAX_PAIRS: usize = 6000;

/// The tree with all copies written out.
pub(super) struct ExpandedTree {
    pub(super) links: Vec<Link>,
    pub(super) orbits: Vec<Orbit>,
    pub(super) groups: Vec<Group>,
    /// The lineage that the tree is, if it is one. Its open and closed links are no group, because
    /// different subtrees hang from them.
    pub(super) lineage: Option<Lineage>,
}

/// A copy that is still to be written out.
struct Pending {
    template: usize,
    parent: Option<LinkId>,
    /// Numbers of the copies on the path from the root to this copy, as in `_2_1`.
    suffix: String,
}

/// Writes out all copies depth first, each parent before its children. The number of copies must be
/// limited before, see [`check_size`].
pub(super) fn expand(templates: &[Template], lineage: Option<Lineage>) -> ExpandedTree {
    let children = children_of(templates);
    let mut expansion = ExpandedTree {
        links: Vec::new(),
        orbits: orbits(templates),
        groups: Vec::new(),
        lineage,
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
            // If copies of the node differ, the orbit (set of equal copies of one link) gets the
            // name of its first link instead of the node's.
            if orbit.name.is_empty() {
                orbit.name.clone_from(&own.name);
            }
            orbit.links.push(id);
        }
        expansion.links.push(own);
        if lineage.is_none() && (template.copies > 1 || template.number.is_some()) {
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

/// Returns the child templates of each template in reverse order, because the last one on the stack
/// is taken first.
fn children_of(templates: &[Template]) -> Vec<Vec<usize>> {
    let mut children = vec![Vec::new(); templates.len()];
    for (index, template) in templates.iter().enumerate().rev() {
        if let Some(siblings) = template.parent.and_then(|parent| children.get_mut(parent)) {
            siblings.push(index);
        }
    }
    children
}

/// Returns the suffixes of the names of a template's copies, as in `_2_1`, in reverse order;
/// `above` is the suffix of their parent.
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

/// Creates the link for one copy of a template.
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

/// Creates the orbits (sets of equal copies), one per template, without links. Orbits get no name
/// yet if copies of their node, or of a node above it, differ. Templates are in the order of their
/// first link.
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

/// Returns the name of the group that a copy belongs to: the name of the copy without its own
/// number.
fn group_name(template: &Template, suffix: &str) -> String {
    let outer = suffix.rsplit_once('_').map_or("", |(outer, _)| outer);
    format!("{}{outer}", template.name)
}

/// Reports a tree of more than [`MAX_LINKS`] links, copies included; returns true if there are
/// fewer.
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

/// Returns, for each template, the number of links of all templates up to it, copies included.
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

/// Checks that a tree is small enough to be written out. It counts pairs of a link and one of its
/// ancestors, which are the entries of the mass matrix.
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

/// Reports names that are shared by links, orbits or groups of two nodes. Returns all names, each
/// with the first template of its node.
pub(super) fn check_names(
    expansion: &ExpandedTree,
    templates: &[Template],
    report: &mut Faults,
) -> BTreeMap<String, usize> {
    let ExpandedTree {
        links,
        orbits,
        groups,
        lineage: _,
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
        // One message per pair of nodes, not per pair of copies.
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
