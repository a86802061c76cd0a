//! Exact reductions: links that need no coordinate of their own.
//!
//! Both are steps from templates to templates. What hangs from a joint that does not
//! move is one body with the link above; identical copies that move alike are one link
//! of as many times the mass, because mass, inertia, friction, drag and springs enter
//! the Lagrangian and the dissipation as sums over links of equal angle and velocity.
//! Nothing is approximated: the motion of the reduced tree is one of the whole tree.

use proc_macro2::Ident;

use super::expand::running_totals;
use super::layout::{self, Asked, Layout};
use super::passive::PassiveTorques;
use super::reduced_body::{turned, weld};
use super::template::{Template, TreeBuilder};
use super::values::{Usage, Values};
use super::{NodeMotion, Quantity, Reduction, Sign, WholeNode, WholeOrder};
use crate::description::{Expression, LockedClause, Reductions};
use crate::exact::Rational;
use crate::report::{
    Faults, OutputMessage, SizeMessage, TreeMessage, UnequalUse, ValueMessage, nearest,
};

/// Makes the reductions that the description names and returns how the links that are
/// left stand for those of the whole tree; `None` without reductions and after an error.
pub(super) fn reduce(
    reductions: &Reductions,
    builder: &mut TreeBuilder,
    asked: &Asked<'_>,
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
    let alike = alike(&reductions.in_phase, templates, report);
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
    let orbits = whole_orbits(&builder.templates, &locks, &alike);
    builder.whole = None;
    merge(&mut builder.templates, &alike);
    lock(&mut builder.templates, &locks, report)?;
    Some(Reduction {
        order,
        links,
        orbits,
    })
}

/// Angle, relative to its parent, of each template that is locked.
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

/// The angle of a joint that does not move, a number.
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
    // A turn more or less says nothing; a large angle is one in degrees.
    let most = Rational::from(7);
    let angle = angle
        .exact()
        .filter(|angle| **angle < most && -&most < **angle);
    if angle.is_none() {
        report.error(written.span, TreeMessage::LockedAngle);
    }
    angle.cloned()
}

/// For each template, true if its copies move alike.
fn alike(nodes: &[Ident], templates: &[Template], report: &mut Faults) -> Vec<bool> {
    let mut alike = vec![false; templates.len()];
    for node in nodes {
        let name = node.to_string();
        let several = |template: &Template| template.copies > 1;
        if name == "all" && !templates.iter().any(|known| known.node == name) {
            if !templates.iter().any(several) {
                report.error(node.span(), TreeMessage::NothingInPhase { name });
            }
            alike.fill(true);
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
        for (alike, template) in alike.iter_mut().zip(templates) {
            if template.node == name && std::mem::replace(alike, true) {
                let name = name.clone();
                report.error(node.span(), OutputMessage::DuplicateRequest { name });
                break;
            }
        }
    }
    alike
}

/// Order of the links of the whole tree: that of the same description without
/// reductions.
fn order(builder: &TreeBuilder, asked: &Asked<'_>) -> WholeOrder {
    let Some(rule) = builder.whole else {
        return WholeOrder::DepthFirst;
    };
    match layout::unreduced(rule, &builder.templates, asked) {
        Layout::Generations { .. } => WholeOrder::Generations,
        Layout::Unrolled | Layout::Links => WholeOrder::DepthFirst,
    }
}

/// Number of links of the whole tree.
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

/// Nearest link above that is not locked, and the number of a link's copies that move by
/// themselves there.
fn holder(
    templates: &[Template],
    locks: &[Option<Rational>],
    alike: &[bool],
    index: usize,
) -> (Option<usize>, usize) {
    let apart = |index: usize| {
        if alike[index] {
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

/// Motion of each orbit of the whole tree in terms of the reduced one's links, which
/// stand depth first.
fn whole_orbits(
    templates: &[Template],
    locks: &[Option<Rational>],
    alike: &[bool],
) -> Vec<WholeNode> {
    let holder = |index: usize| holder(templates, locks, alike, index);
    // Links of the reduced subtree of one copy; where the whole subtree ends.
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
    // Where the next reduced subtree begins, from the link that it hangs from.
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
            in_phase: alike[index],
            end: ends[index],
            motion,
        });
    }
    orbits
}

/// Makes locked links parts of those that they hang from.
fn lock(
    templates: &mut Vec<Template>,
    locks: &[Option<Rational>],
    report: &mut Faults,
) -> Option<()> {
    // From the leaves up, so that a locked link below a locked one is part of it before.
    for index in (0..templates.len()).rev() {
        let Some(angle) = &locks[index] else {
            continue;
        };
        let (above, rest) = templates.split_at_mut(index);
        let (link, below) = rest.split_first_mut()?;
        let parent = above.get_mut(link.parent?)?;
        for child in below.iter_mut().filter(|child| child.parent == Some(index)) {
            child.parent = link.parent;
            child.pivot = turned(&child.pivot, angle, &link.pivot);
            child.copies = child.copies.saturating_mul(link.copies);
            let PassiveTorques { spring, rest, .. } = &mut child.passive;
            if !spring.is_zero() {
                // The spring's angle counts from the link that is now a part of another.
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

/// Makes copies that move alike one link.
fn merge(templates: &mut [Template], alike: &[bool]) {
    let mut weights: Vec<usize> = Vec::with_capacity(templates.len());
    for (template, alike) in templates.iter_mut().zip(alike) {
        let above = template.parent.and_then(|parent| weights.get(parent));
        let mut weight = above.copied().unwrap_or(1);
        if *alike {
            weight = weight.saturating_mul(template.copies);
            template.copies = 1;
        }
        weights.push(weight);
        let Template { body, passive, .. } = template;
        passive.times(weight);
        for value in [&mut body.mass, &mut body.inertia] {
            *value = value.times(weight);
        }
    }
}
