//! Exact reductions of a tree: descriptions of the same motion with fewer coordinates.
//!
//! Both reductions convert templates to templates. A link with a locked joint is combined with its
//! parent into one body. Identical copies in phase (of equal angle) become one link of the total
//! mass, because mass, inertia, friction, drag and springs enter the Lagrangian and the dissipation
//! as sums over links. Nothing is approximated: every motion of the reduced tree is a motion of the
//! whole tree.

use proc_macro2::Ident;

use super::expand::running_totals;
use super::layout::{self, Layout, RequestedOutputs};
use super::passive::PassiveTorques;
use super::reduced_body::{in_parent_frame, weld};
use super::template::{Template, TreeBuilder};
use super::values::{Usage, Values};
use super::{NodeMotion, Quantity, Reduction, Sign, WholeNode, WholeOrder};
use crate::description::{Expression, LockedClause, Reductions};
use crate::exact::Rational;
use crate::report::{
    Faults, OutputMessage, SizeMessage, TreeMessage, UnequalUse, ValueMessage, nearest,
};

/// Applies the reductions that the description names. Returns the relation between the remaining
/// links and those of the whole tree; `None` without reductions and after an error.
pub(super) fn reduce(
    reductions: &Reductions,
    builder: &mut TreeBuilder,
    asked: &RequestedOutputs<'_>,
    report: &mut Faults,
) -> Option<Reduction> {
    if reductions.is_empty() {
        return None;
    }
    let before = report.diagnostics().len();
    let TreeBuilder {
        templates, values, ..
    } = builder;
    if let Some(unequal) = templates.iter().find(|known| known.number.is_some()) {
        let in_phase = reductions.in_phase.iter().map(Ident::span);
        let locked = reductions.locked.iter().map(|clause| clause.link.span());
        for span in in_phase.chain(locked) {
            let (node, wanted) = (unequal.name.clone(), UnequalUse::Reduction);
            report.error(span, OutputMessage::UnequalCopies { node, wanted });
        }
        return None;
    }
    let locks = locks(&reductions.locked, templates, values, report);
    let in_phase = copies_in_phase(&reductions.in_phase, templates, report);
    if report.diagnostics().len() > before {
        return None;
    }
    let order = order(builder, asked);
    if order == WholeOrder::Generations
        && let Some(clause) = reductions.locked.first()
    {
        let message = TreeMessage::LockedGeneration {
            link: clause.link.to_string(),
        };
        report.error(clause.link.span(), message);
        return None;
    }
    let links = whole_links(&builder.templates, report)?;
    let orbits = whole_orbits(&builder.templates, &locks, &in_phase);
    builder.whole = None;
    merge(&mut builder.templates, &in_phase);
    lock(&mut builder.templates, &locks, report)?;
    Some(Reduction {
        order,
        links,
        orbits,
    })
}

/// Returns, for each template, the angle of its locked joint relative to the parent, in rad; `None`
/// if the joint moves.
fn locks(
    clauses: &[LockedClause],
    templates: &[Template],
    values: &mut Values,
    report: &mut Faults,
) -> Vec<Option<Rational>> {
    let mut locks = vec![None; templates.len()];
    for LockedClause { link, angle } in clauses {
        let name = link.to_string();
        let Some(index) = templates.iter().position(|known| known.name == name) else {
            let names: Vec<&str> = templates.iter().map(|known| known.name.as_str()).collect();
            let nearest = nearest(&name, &names).map(str::to_owned);
            report.error(link.span(), TreeMessage::UnknownNode { name, nearest });
            continue;
        };
        let template = &templates[index];
        if template.parent.is_none() {
            report.error(link.span(), TreeMessage::LockedRoot);
            continue;
        }
        let idle = [
            ("friction", template.passive.has_friction()),
            ("spring", !template.passive.spring.is_zero()),
        ];
        for (property, _) in idle.into_iter().filter(|(_, given)| *given) {
            let message = TreeMessage::IdleJoint {
                link: name.clone(),
                property,
            };
            report.error(link.span(), message);
        }
        let Some(angle) = locked_angle(angle, &name, values, report) else {
            continue;
        };
        if locks[index].replace(angle).is_some() {
            report.error(link.span(), OutputMessage::DuplicateRequest { name });
        }
    }
    locks
}

/// Reads the angle of a locked joint, which must be a number, in rad.
fn locked_angle(
    written: &Expression,
    link: &str,
    values: &mut Values,
    report: &mut Faults,
) -> Option<Rational> {
    let usage = Usage {
        what: format!("angle of `{link}`"),
        unit: "rad",
        sign: Sign::Any,
    };
    let angle = values.evaluate(written, &usage, report)?;
    // A full turn has no effect; a larger number was probably meant in degrees.
    let most = Rational::from(7);
    let angle = angle
        .exact()
        .filter(|angle| **angle < most && -&most < **angle);
    if angle.is_none() {
        report.error(written.span, TreeMessage::LockedAngle);
    }
    angle.cloned()
}

/// Returns, for each template, true if its copies move in phase.
fn copies_in_phase(nodes: &[Ident], templates: &[Template], report: &mut Faults) -> Vec<bool> {
    let mut in_phase = vec![false; templates.len()];
    for node in nodes {
        let name = node.to_string();
        let several = |template: &Template| template.copies > 1;
        if name == "all" && !templates.iter().any(|known| known.node == name) {
            if !templates.iter().any(several) {
                report.error(node.span(), TreeMessage::NothingInPhase { name });
            }
            in_phase.fill(true);
            continue;
        }
        let of_node = |template: &&Template| template.node == name;
        if !templates.iter().any(|template| of_node(&template)) {
            let mut names: Vec<&str> = templates.iter().map(|known| known.node.as_str()).collect();
            names.dedup();
            let nearest = nearest(&name, &names).map(str::to_owned);
            report.error(node.span(), TreeMessage::UnknownNode { name, nearest });
            continue;
        }
        if !templates.iter().filter(of_node).any(several) {
            report.error(node.span(), TreeMessage::NothingInPhase { name });
            continue;
        }
        for (in_phase, template) in in_phase.iter_mut().zip(templates) {
            if template.node == name && std::mem::replace(in_phase, true) {
                let name = name.clone();
                report.error(node.span(), OutputMessage::DuplicateRequest { name });
                break;
            }
        }
    }
    in_phase
}

/// Returns the order of the links in the whole tree, which is the order that the same description
/// has without reductions.
fn order(builder: &TreeBuilder, asked: &RequestedOutputs<'_>) -> WholeOrder {
    let Some(rule) = builder.whole else {
        return WholeOrder::DepthFirst;
    };
    match layout::unreduced(rule, &builder.templates, asked) {
        Layout::Generations { .. } => WholeOrder::Generations,
        Layout::Unrolled | Layout::Links => WholeOrder::DepthFirst,
    }
}

/// Returns the number of links of the whole tree.
fn whole_links(templates: &[Template], report: &mut Faults) -> Option<usize> {
    let links = *running_totals(templates).last()?;
    if links > layout::MOST {
        let limit = layout::MOST;
        let span = templates.first()?.span;
        report.error(span, SizeMessage::TooManyLinks { limit });
        return None;
    }
    Some(links)
}

/// Returns the nearest ancestor that is not locked (`None` for the root), and the number of
/// independently moving copies of the link below this ancestor.
fn holder(
    templates: &[Template],
    locks: &[Option<Rational>],
    in_phase: &[bool],
    index: usize,
) -> (Option<usize>, usize) {
    let apart = |index: usize| {
        if in_phase[index] {
            1
        } else {
            templates[index].copies
        }
    };
    let (mut above, mut copies) = (templates[index].parent, apart(index));
    while let Some(parent) = above.filter(|&parent| locks[parent].is_some()) {
        copies *= apart(parent);
        above = templates[parent].parent;
    }
    (above, copies)
}

/// Returns the motion of each node of the whole tree, given by the links of the reduced tree, which
/// are in depth-first order.
fn whole_orbits(
    templates: &[Template],
    locks: &[Option<Rational>],
    in_phase: &[bool],
) -> Vec<WholeNode> {
    let holder = |index: usize| holder(templates, locks, in_phase, index);
    // `sizes`: number of reduced links below one copy, itself included; `ends`: end of the whole
    // subtree.
    let mut sizes = vec![1; templates.len()];
    let mut ends: Vec<usize> = (1..=templates.len()).collect();
    for (index, template) in templates.iter().enumerate().rev() {
        if let Some(parent) = template.parent {
            ends[parent] = ends[parent].max(ends[index]);
        }
        if let (None, (Some(above), copies)) = (&locks[index], holder(index)) {
            sizes[above] += copies * sizes[index];
        }
    }
    // Index at which the next reduced subtree begins, relative to the link that it hangs from.
    let mut next = vec![1; templates.len()];
    let mut orbits = Vec::with_capacity(templates.len());
    for (index, template) in templates.iter().enumerate() {
        let motion = match (&locks[index], holder(index)) {
            (Some(angle), _) => NodeMotion::Locked {
                angle: angle.clone(),
            },
            (None, (None, _)) => NodeMotion::Moving {
                offset: 0,
                stride: 0,
            },
            (None, (Some(above), copies)) => {
                let offset = next[above];
                next[above] += copies * sizes[index];
                NodeMotion::Moving {
                    offset,
                    stride: sizes[index],
                }
            }
        };
        orbits.push(WholeNode {
            name: template.name.clone(),
            copies: template.copies,
            in_phase: in_phase[index],
            end: ends[index],
            motion,
        });
    }
    orbits
}

/// Combines locked links with their parents.
fn lock(
    templates: &mut Vec<Template>,
    locks: &[Option<Rational>],
    report: &mut Faults,
) -> Option<()> {
    // From the leaves upwards, so that of two locked links the lower one is combined first.
    for index in (0..templates.len()).rev() {
        let Some(angle) = &locks[index] else {
            continue;
        };
        let (above, rest) = templates.split_at_mut(index);
        let (link, below) = rest.split_first_mut()?;
        let parent = above.get_mut(link.parent?)?;
        for child in below.iter_mut().filter(|child| child.parent == Some(index)) {
            child.parent = link.parent;
            child.pivot = in_parent_frame(&child.pivot, angle, &link.pivot);
            child.copies = child.copies.saturating_mul(link.copies);
            let PassiveTorques { spring, rest, .. } = &mut child.passive;
            if !spring.is_zero() {
                // The spring's angle is now measured from the link that holds this one.
                *rest = Quantity::sum([rest.clone(), Quantity::number(angle.clone())]);
            }
        }
        match weld(&parent.body, link, angle) {
            Ok(body) => parent.body = body,
            Err(_) => {
                report.error(link.span, ValueMessage::NumberLength);
                return None;
            }
        }
        if !parent.passive.take_drag(&link.passive, link.copies) {
            let name = link.name.clone();
            report.error(link.span, TreeMessage::LockedWidth { link: name });
            return None;
        }
    }
    let mut places = Vec::with_capacity(templates.len());
    let mut kept = 0;
    for locked in locks {
        places.push(kept);
        kept += usize::from(locked.is_none());
    }
    let mut index = 0;
    templates.retain(|_| {
        index += 1;
        locks[index - 1].is_none()
    });
    for template in templates {
        template.parent = template.parent.map(|parent| places[parent]);
    }
    Some(())
}

/// Replaces identical copies that move in phase by one link.
fn merge(templates: &mut [Template], in_phase: &[bool]) {
    let mut weights: Vec<usize> = Vec::with_capacity(templates.len());
    for (template, in_phase) in templates.iter_mut().zip(in_phase) {
        let above = template.parent.and_then(|parent| weights.get(parent));
        let mut weight = above.copied().unwrap_or(1);
        if *in_phase {
            weight = weight.saturating_mul(template.copies);
            template.copies = 1;
        }
        weights.push(weight);
        template.take_copies(weight);
    }
}

impl Template {
    /// Makes the link one that represents this many copies in phase.
    pub(super) fn take_copies(&mut self, copies: usize) {
        let Self { body, passive, .. } = self;
        passive.times(copies);
        for value in [&mut body.mass, &mut body.inertia] {
            *value = value.times(copies);
        }
    }
}
