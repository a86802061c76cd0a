//! Decides whether the equations of a tree are written out link by link or computed in loops.

use proc_macro2::Span;

use super::Solve;
use super::bodies::Body;
use super::outputs::Support;
use super::requests::Resolved;
use super::rule::Code;
use super::template::{MAX_LINKS, Template, WholeRule};
use crate::report::{Faults, SizeMessage};

/// Smallest number of links of a rule-based tree that gets loops by default. From there on,
/// straight code for one state is slower and takes several times as long to compile
/// (`docs/performance.md`).
const FEWEST: usize = 63;

/// Largest number of links of any other tree that is written out by default. Straight code for more
/// links is no faster and takes long to derive and compile (`docs/performance.md`).
const MOST_UNROLLED: usize = 100;

/// Largest number of links of a rule-based tree: the range of a 32-bit index. If `usize` has 32
/// bits too, `usize::MAX` stands for every larger sum and counts as too many.
pub(super) const MOST: usize = match 1_usize.checked_shl(32) {
    Some(most) => most,
    None => usize::MAX - 1,
};

/// Largest number of generations in loops if masses, lengths or inertias contain parameters.
const MOST_WITH_PARAMETERS: usize = 64;

/// Layout of the generated code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layout {
    /// Equations written out link by link.
    Unrolled,
    /// Loops over generations; [`Scene::links`](super::Scene::links) holds one link of each
    /// generation.
    Generations {
        /// Number of children of each link above the last generation.
        branching: usize,
        /// Number of links in all generations.
        links: usize,
    },
    /// A loop over all links.
    Links,
}

/// Outputs requested for a tree.
pub(super) struct RequestedOutputs<'a> {
    pub(super) resolved: &'a Resolved,
    pub(super) observables: bool,
}

/// Returns the layout that the code of a rule would have without reductions (copies in phase,
/// locked joints).
pub(super) fn unreduced(
    rule: WholeRule,
    templates: &[Template],
    asked: &RequestedOutputs<'_>,
) -> Layout {
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

/// Returns the number of links of a tree with the given number of generations.
fn links(branching: usize, generations: usize) -> usize {
    let (mut links, mut count): (usize, usize) = (0, 1);
    for _ in 0..generations {
        links = links.saturating_add(count);
        count = count.saturating_mul(branching);
    }
    links
}

/// Chooses the code layout of a rule-based tree. For loops, it reduces the templates to one link
/// per generation.
///
/// # Errors
/// The tree can neither be written out nor get loops, or the requested loops are impossible; the
/// reason is added to `report`.
pub(super) fn of_rule(
    rule: WholeRule,
    templates: &mut [Template],
    asked: &RequestedOutputs<'_>,
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

/// Chooses the code layout of a tree that is given link by link. If loops are required but
/// impossible, adds the reason to `report`.
pub(super) fn of_links(
    code: Option<(Code, Span)>,
    links: usize,
    templates: &[Template],
    asked: &RequestedOutputs<'_>,
    report: &mut Faults,
) -> Layout {
    let span = match code {
        Some((Code::Unrolled, _)) => return Layout::Unrolled,
        Some((Code::Loops, span)) => Some(span),
        None if links > MOST_UNROLLED => None,
        None => return Layout::Unrolled,
    };
    let obstacle = unlooped(templates, asked);
    let layout = match obstacle {
        Some(_) => Layout::Unrolled,
        None => Layout::Links,
    };
    // After other mistakes the obstacle may not be real.
    if let (Some(what), Some(span), true) = (obstacle, span, report.is_empty()) {
        report.error(span, SizeMessage::NoLoops { what });
    }
    layout
}

/// Returns the reason why loops over generations are impossible, in words; `None` if they are
/// possible.
fn obstacle(templates: &[Template], asked: &RequestedOutputs<'_>) -> Option<String> {
    if let Some(what) = unlooped(templates, asked) {
        return Some(what);
    }
    // The code would compute the constants of a generation from those of all generations below it.
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

/// Returns the reason why loops of either kind are impossible, in words; `None` if they are
/// possible.
fn unlooped(templates: &[Template], asked: &RequestedOutputs<'_>) -> Option<String> {
    let requests = &asked.resolved.requests;
    // Loops always use the articulated recursion.
    let factorization = requests.solve == Some(Solve::Factorization);
    let budget = requests.budget.as_ref();
    let gradient = requests.gradient.as_ref();
    let gradient_of_energies = gradient.is_some_and(|gradient| gradient.energies);
    let exact_or_truncated = budget.is_some_and(|budget| !budget.scales);
    let flags = requests.named();
    let flag = flags
        .filter(|(_, support)| *support != Support::Everywhere)
        .last();
    let values = [
        (requests.transfer.is_some(), "`emit(transfer)`"),
        (exact_or_truncated, "`emit(budget)`"),
        (asked.resolved.acting.is_some(), "`emit(small)`"),
        (gradient_of_energies, "`emit(gradient(energies))`"),
        (asked.observables, "`observe(…)`"),
        (factorization, "`solve = factorization`"),
        (templates.len() < 2, "a single generation"),
    ];
    // Search from the end: a request that implies other requests comes after them.
    let value = values.into_iter().rev().find(|(wanted, _)| *wanted);
    let value = value.map(|(_, what)| what.to_owned());
    value.or_else(|| flag.map(|(name, _)| format!("`emit({name})`")))
}
