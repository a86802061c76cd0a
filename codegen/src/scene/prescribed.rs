//! Links whose motion the caller states at each call.

use super::expand::ExpandedTree;
use super::{LinkId, PrescribedSet};
use crate::description::PrescribedClause;
use crate::report::{OutputMessage, Report, TreeMessage, nearest};

/// Finds the links of each clause; what is wrong goes to `report`.
pub(super) fn resolve_prescribed(
    clauses: &[PrescribedClause],
    expansion: &ExpandedTree,
    report: &mut Report,
) -> Vec<PrescribedSet> {
    let names: Vec<&str> = expansion
        .links
        .iter()
        .map(|link| link.name.as_str())
        .collect();
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
            match names.iter().position(|known| *known == name) {
                Some(index) if found.contains(&LinkId(index)) => {
                    report.error(link.span(), OutputMessage::DuplicateRequest { name });
                }
                Some(index) => {
                    found.push(LinkId(index));
                    written.push(name);
                }
                None => {
                    let nearest = nearest(&name, &names).map(str::to_owned);
                    report.error(link.span(), TreeMessage::UnknownNode { name, nearest });
                }
            }
        }
        let set = PrescribedSet {
            name: written.join("_and_"),
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
