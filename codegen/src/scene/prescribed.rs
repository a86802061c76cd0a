//! Links whose motion the caller states at each call.

use super::expand::ExpandedTree;
use super::layout::Layout;
use super::{LinkId, PrescribedSet};
use crate::description::PrescribedClause;
use crate::report::{Faults, OutputMessage, TreeMessage, nearest};

/// Finds the links of each clause; what is wrong goes to `report`.
pub(super) fn resolve_prescribed(
    clauses: &[PrescribedClause],
    expansion: &ExpandedTree,
    layout: Layout,
    report: &mut Faults,
) -> Vec<PrescribedSet> {
    let names: Vec<&str> = expansion
        .links
        .iter()
        .map(|link| link.name.as_str())
        .collect();
    // A generation's name alone is no link's.
    let copies = usize::from(matches!(layout, Layout::Generations { branching: 2.., .. }));
    let first_copies = names.iter().enumerate();
    let first_copies: Vec<String> = first_copies
        .map(|(generation, name)| format!("{name}{}", "_1".repeat(copies * generation)))
        .collect();
    let examples: Vec<&str> = first_copies.iter().map(String::as_str).collect();
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
            let place = match layout {
                Layout::Generations { branching, .. } => of_generations(&name, &names, branching),
                _ => names.iter().position(|known| *known == name),
            };
            match place.map(LinkId) {
                Some(link_id) if found.contains(&link_id) => {
                    report.error(link.span(), OutputMessage::DuplicateRequest { name });
                }
                Some(link_id) => {
                    found.push(link_id);
                    written.push(name);
                }
                None => {
                    let nearest = nearest(&name, &examples).map(str::to_owned);
                    report.error(link.span(), TreeMessage::UnknownNode { name, nearest });
                }
            }
        }
        let set = PrescribedSet {
            name: written.join("_and_"),
            members: written,
            links: found,
        };
        // Nothing of it was readable, which is reported.
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

/// The index in the whole tree of the link that has this name, that of its generation with
/// the numbers of the copies that it is and hangs in: copy c under link i of a generation
/// of n links is number c n + i of the next one.
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

/// So many numbers as in `_2_1`, counted from 0.
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
