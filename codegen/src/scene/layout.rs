//! Which trees are written out link by link, and which are taken through loops.

use proc_macro2::Span;

use super::Requests;
use super::Solve;
use super::bodies::Body;
use super::requests::Resolved;
use super::rule::Code;
use super::template::{MAX_LINKS, Template, WholeRule};
use crate::report::{Faults, SizeMessage};

/// Trees by rule of at least so many links get loops: straight code for one state is slower,
/// and takes several times as long to compile (`docs/performance.md`).
const FEWEST: usize = 63;

/// Other trees of more links than this get a loop: straight code for more is no faster,
/// and takes long to derive and compile (`docs/performance.md`).
const MOST_UNROLLED: usize = 100;

/// Most links of a tree by rule: what an index of 32 bits counts. Where all numbers have as
/// many bits the largest stands for every sum beyond, and is too many.
pub(super) const MOST: usize = match 1_usize.checked_shl(32) {
    Some(most) => most,
    None => usize::MAX - 1,
};

/// Most generations of such a tree whose bodies have parameters.
const MOST_WITH_PARAMETERS: usize = 64;

/// How the code takes the equations of motion through the tree.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layout {
    /// Written out, link by link.
    Unrolled,
    /// In loops over generations: [`Scene::links`](super::Scene::links) holds one link of each.
    Generations {
        /// Children of each link but those of the last generation.
        branching: usize,
        /// Links of all generations.
        links: usize,
    },
    /// In a loop over all links.
    Links,
}

/// Outputs that are asked for about a tree.
pub(super) struct Asked<'a> {
    pub(super) resolved: &'a Resolved,
    pub(super) observables: bool,
}

/// How the code of a rule would be laid out that is not reduced.
pub(super) fn unreduced(rule: WholeRule, templates: &[Template], asked: &Asked<'_>) -> Layout {
    let branching = rule.branching;
    let links = links(branching, templates.len());
    let looped = match rule.code {
        Some(code) => code == Code::Loops,
        None => links > MAX_LINKS || (links >= FEWEST && obstacle(templates, asked).is_none()),
    };
    match looped {
        true => Layout::Generations { branching, links },
        false => Layout::Unrolled,
    }
}

/// Number of links of so many generations.
fn links(branching: usize, generations: usize) -> usize {
    let (mut links, mut count): (usize, usize) = (0, 1);
    for _ in 0..generations {
        links = links.saturating_add(count);
        count = count.saturating_mul(branching);
    }
    links
}

/// Decides how the code of a rule is laid out. Where it is loops, leaves one
/// template for a link of each generation.
///
/// # Errors
/// Where the tree can neither be written out nor have loops, or has loops that
/// it cannot have; `report` says why.
pub(super) fn of_rule(
    rule: WholeRule,
    templates: &mut [Template],
    asked: &Asked<'_>,
    report: &mut Faults,
) -> Result<Layout, ()> {
    let links = links(rule.branching, templates.len());
    let wanted = match rule.code {
        Some(Code::Unrolled) => return Ok(Layout::Unrolled),
        Some(Code::Loops) => true,
        None => links >= FEWEST || asked.resolved.requests.scales(),
    };
    if !wanted {
        return Ok(Layout::Unrolled);
    }
    match obstacle(templates, asked) {
        Some(what) if rule.code.is_some() || asked.resolved.requests.scales() => {
            report.error(rule.span, SizeMessage::NoLoops { what });
            Err(())
        }
        Some(what) if links > MAX_LINKS => {
            let limit = MAX_LINKS;
            report.error(rule.span, SizeMessage::TooManyForUnrolled { what, limit });
            Err(())
        }
        Some(_) => Ok(Layout::Unrolled),
        None if links > MOST => {
            report.error(rule.span, SizeMessage::TooManyLinks { limit: MOST });
            Err(())
        }
        None => {
            for template in templates {
                template.copies = 1;
            }
            Ok(Layout::Generations {
                branching: rule.branching,
                links,
            })
        }
    }
}

/// Decides how the code of a tree that is no rule is laid out. Where it cannot be loops
/// and must, `report` says why.
pub(super) fn of_links(
    code: Option<(Code, Span)>,
    links: usize,
    templates: &[Template],
    asked: &Asked<'_>,
    report: &mut Faults,
) -> Layout {
    let span = match code {
        Some((Code::Unrolled, _)) => return Layout::Unrolled,
        Some((Code::Loops, span)) => Some(span),
        None if links > MOST_UNROLLED => None,
        None => return Layout::Unrolled,
    };
    let obstacle = unlooped(templates, asked);
    // What is unreadable may look like an obstacle.
    if let (Some(what), Some(span), true) = (obstacle, span, report.is_empty()) {
        let what = what.to_owned();
        report.error(span, SizeMessage::NoLoops { what });
    }
    match obstacle {
        Some(_) => Layout::Unrolled,
        None => Layout::Links,
    }
}

/// Reasons in words against loops over generations.
fn obstacle(templates: &[Template], asked: &Asked<'_>) -> Option<String> {
    if let Some(what) = unlooped(templates, asked) {
        return Some(what.to_owned());
    }
    // Their constants are formed of those of all generations below, in code.
    let parameters = templates.len() > MOST_WITH_PARAMETERS
        && templates.iter().any(|template| {
            let Body {
                mass, inertia, com, ..
            } = &template.body;
            let pivot = &template.pivot;
            let parts = [
                mass,
                inertia,
                &com.along,
                &com.lateral,
                &pivot.along,
                &pivot.lateral,
            ];
            parts.into_iter().any(|value| value.exact().is_none())
        });
    parameters.then(|| format!("parameters in more than {MOST_WITH_PARAMETERS} generations"))
}

/// Reasons in words against loops of either kind.
fn unlooped(templates: &[Template], asked: &Asked<'_>) -> Option<&'static str> {
    let Requests {
        energies: _,
        momenta,
        modes,
        symmetric,
        transfer,
        budget,
        taylor,
        positions: _,
        transverse,
        small: _,
        forces: _,
        solve,
    } = &asked.resolved.requests;
    // Loops are the recursion.
    let factorization = *solve == Some(Solve::Factorization);
    let exact_or_truncated = budget.as_ref().is_some_and(|budget| !budget.scales);
    let requests = [
        (*momenta, "`emit(momenta)`"),
        (*modes, "`emit(modes)`"),
        (*symmetric, "`emit(symmetric)`"),
        (transfer.is_some(), "`emit(transfer)`"),
        (exact_or_truncated, "`emit(budget)`"),
        (*taylor, "`emit(taylor)`"),
        (*transverse, "`emit(transverse)`"),
        (asked.resolved.acting.is_some(), "`emit(small)`"),
        (asked.observables, "`observe(…)`"),
        (factorization, "`solve = factorization`"),
        (templates.len() < 2, "a single generation"),
    ];
    // What brings others along comes last.
    let request = requests.into_iter().rev().find(|(wanted, _)| *wanted);
    request.map(|(_, what)| what)
}
