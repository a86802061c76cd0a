//! Links whose motion the caller prescribes at each call.

use proc_macro2::Ident;

use super::expand::ExpandedTree;
use super::layout::Layout;
use super::{LinkId, PrescribedSet};
use crate::description::PrescribedClause;
use crate::report::{Faults, OutputMessage, TreeMessage, nearest};

/// Names of the links of a tree, as clauses use them.
pub(super) struct LinkNames<'a> {
    names: Vec<&'a str>,
    pub(super) layout: Layout,
}

impl<'a> LinkNames<'a> {
    pub(super) fn of(expansion: &'a ExpandedTree, layout: Layout) -> Self {
        let links = expansion.links.iter();
        let names = links.map(|link| link.name.as_str()).collect();
        Self { names, layout }
    }

    /// Returns the link of the given name; reports a name that no link has.
    pub(super) fn find(&self, link: &Ident, report: &mut Faults) -> Option<LinkId> {
        let name = link.to_string();
        let place = match self.layout {
            Layout::Generations { branching, .. } => of_generations(&name, &self.names, branching),
            Layout::Unrolled | Layout::Links => self.names.iter().position(|known| *known == name),
        };
        if place.is_none() {
            // If links branch, the name of a generation is not the name of a link.
            let branches = matches!(self.layout, Layout::Generations { branching: 2.., .. });
            let copies = usize::from(branches);
            let numbered = self.names.iter().enumerate();
            let examples: Vec<String> = numbered
                .map(|(generation, name)| format!("{name}{}", "_1".repeat(copies * generation)))
                .collect();
            let examples: Vec<&str> = examples.iter().map(String::as_str).collect();
            let nearest = nearest(&name, &examples).map(str::to_owned);
            report.error(link.span(), TreeMessage::UnknownNode { name, nearest });
        }
        place.map(LinkId)
    }
}

/// Finds the links of each clause about prescribed motions. Adds mistakes to `report`.
pub(super) fn resolve_prescribed(
    clauses: &[PrescribedClause],
    names: &LinkNames<'_>,
    report: &mut Faults,
) -> Vec<PrescribedSet> {
    let mut sets: Vec<PrescribedSet> = Vec::new();
    for PrescribedClause {
        name,
        links,
        damaged,
    } in clauses
    {
        if links.is_empty() && !damaged {
            report.error(name.span(), TreeMessage::NothingPrescribed);
        }
        let (mut found, mut written) = (Vec::new(), Vec::new());
        for link in links {
            let name = link.to_string();
            match names.find(link, report) {
                Some(link_id) if found.contains(&link_id) => {
                    report.error(link.span(), OutputMessage::DuplicateRequest { name });
                }
                Some(link_id) => {
                    found.push(link_id);
                    written.push(name);
                }
                None => {}
            }
        }
        let set = PrescribedSet {
            name: written.join("_and_"),
            members: written,
            links: found,
        };
        // No link could be read, which has been reported.
        if set.links.is_empty() {
            continue;
        }
        if sets.iter().any(|known| known.name == set.name) {
            let message = OutputMessage::DuplicateRequest { name: set.name };
            report.error(name.span(), message);
        } else {
            sets.push(set);
        }
    }
    sets
}

/// Returns the index in the whole tree of the link with this name. The name is that of its
/// generation, followed by the numbers of the copies on the path to it, as in `_2_1`. Copy c under
/// link i of a generation of n links has the number c n + i in the next generation.
fn of_generations(name: &str, generations: &[&str], branching: usize) -> Option<usize> {
    let (mut start, mut count) = (0, 1);
    for (generation, stem) in generations.iter().enumerate() {
        let numbers = if branching > 1 { generation } else { 0 };
        let suffix = name.strip_prefix(stem);
        let copies = suffix.and_then(|suffix| copies(suffix, numbers, branching));
        if let Some(copies) = copies {
            let mut stride = 1;
            return Some(copies.into_iter().fold(start, |index, copy| {
                let place = index + copy * stride;
                stride *= branching;
                place
            }));
        }
        start += count;
        count *= branching;
    }
    None
}

/// Parses a suffix of exactly `numbers` copy numbers, as in `_2_1`. The result counts from 0;
/// `None` if the suffix is different.
fn copies(suffix: &str, numbers: usize, branching: usize) -> Option<Vec<usize>> {
    let mut parts = suffix.split('_');
    if parts.next() != Some("") {
        return None;
    }
    let copy = |part: &str| {
        let number: usize = part.parse().ok()?;
        let is_known = (1..=branching).contains(&number) && number.to_string() == part;
        is_known.then(|| number - 1)
    };
    let copies: Option<Vec<usize>> = parts.map(copy).collect();
    copies.filter(|copies| copies.len() == numbers)
}
