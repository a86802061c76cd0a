//! Conversion of a description to a scene, on one page.

use super::coordinates::symmetric_coordinates;
use super::drive::resolve_drive;
use super::expand::{ExpandedTree, check_names, check_pairs, check_size, expand};
use super::layout::{self, Layout, RequestedOutputs};
use super::observables::resolve_observables;
use super::prescribed::{LinkNames, resolve_prescribed};
use super::reduction::reduce;
use super::requests::{Resolved, check_symmetry, resolve_requests};
use super::rule::{Code, resolve_code};
use super::singular::check_regular;
use super::small_sectors::{resolve_acting, resolve_small};
use super::spring_dampers::{SceneSpringDampers, forces_of_spring_dampers, resolve_spring_dampers};
use super::symbols::check_meanings;
use super::template::{Template, TreeBuilder, WholeRule};
use super::values::{Usage, Values, check_used};
use super::{Lineage, Quantity, Scene, Sign, Solve, SpringLine};
use crate::description::{Description, Node, Property, StructItem, Value};
use crate::report::{Faults, OutputMessage, SyntaxMessage, TreeMessage, ValueMessage, nearest};
use proc_macro2::{Ident, Span};
use std::collections::BTreeMap;

/// Checks a description and expands it link by link.
///
/// Returns `None` after any mistake, in this or an earlier stage; all are added to `report`. After
/// a mistake, every check that does not depend on it still runs.
pub fn resolve(description: &Description, report: &mut Faults) -> Option<Scene> {
    let scene = resolve_scene(description, report)?;
    check_coupling(description, &scene, report);
    check_straight_by_scale(description, &scene, report);
    report.is_empty().then_some(scene)
}

/// Checks the description of a tree, for a compiled model or for one at run time.
pub(super) fn resolve_scene(description: &Description, report: &mut Faults) -> Option<Scene> {
    let mut builder = TreeBuilder {
        values: Values::declared(description.parameters.as_ref(), report),
        ..TreeBuilder::default()
    };
    let gravity = gravity(description, &mut builder.values, report);
    check_roots(description, report);
    for root in &description.roots {
        builder.add_root(root, report);
    }
    let drive = resolve_drive(description.drive.as_ref(), &mut builder.values, report);
    let forces = forces_of_spring_dampers(&description.spring_dampers, &mut builder.values, report);
    let mut resolved = resolve_requests(&description.requests, &description.observables, report);
    resolved.requests.solve = resolve_solve(description.solve.as_ref(), report);
    resolved.requests.forces |= !description.prescribed.is_empty();
    if description.roots.len() > 1 {
        return None;
    }
    let asked = RequestedOutputs {
        resolved: &resolved,
        observables: !description.observables.is_empty(),
    };
    let readable = !description.damaged && !description.roots.iter().any(Node::is_damaged);
    let reduction = readable
        .then(|| reduce(&description.reductions, &mut builder, &asked, report))
        .flatten();
    let TreeBuilder {
        mut templates,
        values,
        whole,
    } = builder;
    let code = resolve_code(description.code.as_ref(), report);
    let (expansion, layout) = lay_out(&mut templates, whole, code, &asked, report)?;
    let branches = matches!(layout, Layout::Generations { branching: 2.., .. });
    let by_rule = branches && reduction.is_none();
    if readable && !by_rule && refuses_scales(&resolved, report) {
        return None;
    }
    if let Some(root) = templates.first()
        && layout == Layout::Unrolled
        && !check_pairs(&expansion.links, root.span, report)
    {
        return None;
    }
    let owners = check_names(&expansion, &templates, report);
    check_parameter_names(&values, &owners, report);
    // The part that could not be parsed may have contained copies.
    let (mut prescribed, mut spring_dampers) = (Vec::new(), SceneSpringDampers::default());
    if readable {
        check_symmetry(&mut resolved, &expansion, report);
        let names = LinkNames::of(&expansion, layout);
        prescribed = resolve_prescribed(&description.prescribed, &names, report);
        let whole = reduction.as_ref();
        spring_dampers =
            resolve_spring_dampers(description, forces, &expansion, whole, &names, report);
    }
    let mut scene = Scene {
        name: description.item.ident.to_string(),
        crate_path: description.crate_path.clone().unwrap_or_default(),
        // A missing value has been reported.
        gravity: gravity.unwrap_or_else(Quantity::zero),
        links: expansion.links,
        orbits: expansion.orbits,
        groups: expansion.groups,
        drive,
        parameters: values.parameters,
        requirements: values.requirements,
        requests: resolved.requests,
        observables: Vec::new(),
        prescribed,
        spring_dampers: spring_dampers.torsional,
        translational: spring_dampers.translational,
        reduction,
        lineage: expansion.lineage,
        layout,
    };
    if readable {
        if let Some(span) = resolved.normal_form
            && let Some(cause) = scene.normal_form_obstacle()
        {
            report.error(span, OutputMessage::NoNormalForm { cause });
        }
        let acting = resolved.acting.as_ref();
        resolve_differences(acting, resolved.transverse, &mut scene, report);
        if !scene.groups.is_empty() {
            resolve_small(&resolved.small, &mut scene, report);
        }
        resolve_observables(&description.observables, &mut scene, &owners, report);
        check_straight(description, &scene, report);
    }
    check_meanings(&scene, &values.spans, report);
    check_derives(&description.item, &scene, report);
    // Skipped after other mistakes: a link with wrong values would appear singular too.
    if report.is_empty() {
        check_used(&scene.parameters, &values.spans, report);
        check_regular(&templates, report);
    }
    report.is_empty().then_some(scene)
}

/// Returns the expanded tree and the layout of its code, or `None` if the tree is too large.
fn lay_out(
    templates: &mut [Template],
    whole: Option<WholeRule>,
    mut code: Option<(Code, Span)>,
    asked: &RequestedOutputs<'_>,
    report: &mut Faults,
) -> Option<(ExpandedTree, Layout)> {
    if let Some(rule) = whole {
        code = rule.code.map(|code| (code, rule.span)).or(code);
    }
    let by_rule = match whole.filter(|rule| rule.open.is_none()) {
        Some(mut rule) => {
            rule.code = code.map(|(code, _)| code);
            Some(layout::of_rule(rule, templates, asked, report).ok()?)
        }
        None => None,
    };
    if !check_size(templates, report) {
        return None;
    }
    let lineage = whole.and_then(|rule| {
        Some(Lineage {
            generations: rule.open?,
        })
    });
    let expansion = expand(templates, lineage);
    let links = expansion.links.len();
    let layout = by_rule.unwrap_or_else(|| layout::of_links(code, links, templates, asked, report));
    Some((expansion, layout))
}

/// Reports a request for energies by scale (by generation) if no single rule describes the tree.
/// Returns true if it reported one.
fn refuses_scales(resolved: &Resolved, report: &mut Faults) -> bool {
    match resolved.budget {
        Some(span) if resolved.requests.scales() => {
            report.error(span, OutputMessage::ScalesWithoutRule);
            true
        }
        _ => false,
    }
}

/// Reports parameters with the name of a link.
fn check_parameter_names(values: &Values, owners: &BTreeMap<String, usize>, report: &mut Faults) {
    for (parameter, span) in values.parameters.iter().zip(&values.spans) {
        if owners.contains_key(&parameter.name) {
            let name = parameter.name.clone();
            report.error(*span, TreeMessage::DuplicateName { name });
        }
    }
}

/// Reports springs that couple sectors (sets of symmetric coordinates: all means, or one difference
/// between copies) whose energies are requested.
fn check_coupling(description: &Description, scene: &Scene, report: &mut Faults) {
    let requests = &scene.requests;
    if scene.spring_dampers.is_empty() || (requests.transfer.is_none() && requests.budget.is_none())
    {
        return;
    }
    let coupling = scene.coupling_spring(&symmetric_coordinates(scene));
    let Some(index) = coupling else { return };
    let clauses = description.spring_dampers.iter();
    let clause = clauses.filter(|own| !own.is_straight()).nth(index);
    if let (Some(clause), Some(own)) = (clause, scene.spring_dampers.get(index)) {
        let what = own.what.clone();
        report.error(clause.name.span(), OutputMessage::CoupledSectors { what });
    }
}

/// Reports straight springs between points whose distance is fixed, and requested outputs that do
/// not support straight springs.
fn check_straight(description: &Description, scene: &Scene, report: &mut Faults) {
    let requests = &scene.requests;
    let refused = [
        (requests.budget.is_some(), "budget"),
        (requests.transfer.is_some(), "transfer"),
        (requests.symmetric, "symmetric"),
        (requests.transverse, "transverse"),
    ];
    let clauses = description.spring_dampers.iter();
    let clauses: Vec<_> = clauses.filter(|own| own.is_straight()).collect();
    // Mistakes in a clause without a spring have been reported.
    if clauses.len() != scene.translational.len() {
        return;
    }
    let refused = refused.iter().find(|(is_wanted, _)| *is_wanted);
    // Loops have budgets by scale only, and no groups.
    let other = match (refused, scene.in_loops()) {
        (Some(_), false) => scene.chord_springs(&scene.groups).err(),
        _ => None,
    };
    let other = other.unwrap_or_default();
    let runs = scene.line_runs();
    for (index, (clause, own)) in clauses.into_iter().zip(&scene.translational).enumerate() {
        let span = clause.name.span();
        if let (Some((_, request)), Some(&cause)) = (refused, other.get(&index)) {
            let message = OutputMessage::StraightSpring {
                line: own.in_words(),
                noun: own.noun(),
                request,
                cause,
            };
            report.error(span, message);
        }
        let lines = runs.iter().map(|run| &run.first);
        let mut lines = lines.filter(|line| line.spring_damper == index);
        if lines.any(SpringLine::is_rigid) {
            let what = own.what.clone();
            report.error(span, TreeMessage::RigidLine { what });
        }
    }
}

/// Reports straight springs if a budget by scale is requested.
fn check_straight_by_scale(description: &Description, scene: &Scene, report: &mut Faults) {
    let mut clauses = description.spring_dampers.iter();
    let clause = clauses.find(|own| own.is_straight());
    if let (Some(clause), Some(own), true) =
        (clause, scene.translational.first(), scene.requests.scales())
    {
        let message = OutputMessage::StraightSpringByScale {
            line: own.in_words(),
            noun: own.noun(),
        };
        report.error(clause.name.span(), message);
    }
}

/// Resolves the requests about small differences between identical copies that move in phase.
fn resolve_differences(
    acting: Option<&(Span, Vec<Ident>)>,
    transverse: Option<Span>,
    scene: &mut Scene,
    report: &mut Faults,
) {
    if !scene.requests.transverse || !scene.transverse_sectors().is_empty() {
        resolve_acting(acting, scene, report);
        return;
    }
    let acting = acting.map(|(span, _)| (*span, "small"));
    let plain = transverse.map(|span| (span, "transverse"));
    for (span, request) in plain.into_iter().chain(acting) {
        report.error(span, OutputMessage::NoTransverse { request });
    }
}

/// Evaluates the gravitational acceleration.
fn gravity(
    description: &Description,
    values: &mut Values,
    report: &mut Faults,
) -> Option<Quantity> {
    let usage = Usage {
        what: "gravity".to_owned(),
        unit: "m/s²",
        sign: Sign::Any,
    };
    match &description.gravity {
        Some(Property {
            value: Value::Single(value),
            ..
        }) => {
            let gravity = values.evaluate(value, &usage, report)?;
            values.require_direction(&gravity, &usage.what);
            Some(gravity)
        }
        Some(Property {
            value: Value::Each { span, .. },
            ..
        }) => {
            report.error(*span, ValueMessage::EachWithoutCopies);
            None
        }
        Some(Property {
            name,
            value: Value::Pair(..),
            ..
        }) => {
            let message = TreeMessage::NotAPoint {
                name: name.to_string(),
            };
            report.error(name.span(), message);
            None
        }
        None => {
            // The part that could not be parsed may have contained it.
            if !description.damaged {
                report.error(description.item.ident.span(), SyntaxMessage::MissingGravity);
            }
            None
        }
    }
}

/// Checks that there is exactly one root.
fn check_roots(description: &Description, report: &mut Faults) {
    match description.roots.as_slice() {
        [] if description.damaged => {}
        [] => report.error(description.item.ident.span(), TreeMessage::EmptyTree),
        [first, others @ ..] => {
            for other in others {
                let first = first.name.to_string();
                report.error(other.name.span(), TreeMessage::SecondRoot { first });
            }
        }
    }
}

/// Reports derived traits that the attribute implements itself, or that the model cannot have.
fn check_derives(item: &StructItem, scene: &Scene, report: &mut Faults) {
    let default = match scene.parameters.is_empty() {
        true => SyntaxMessage::DefaultDerived,
        false => SyntaxMessage::DefaultOfParameters,
    };
    if let Some(span) = item.derived("Default") {
        report.error(span, default);
    }
    if let Some(span) = item.derived("Copy").filter(|_| scene.in_loops()) {
        report.error(span, SyntaxMessage::CopyInLoops);
    }
}

/// Reads `solve = ...`.
fn resolve_solve(written: Option<&(Ident, Ident)>, report: &mut Faults) -> Option<Solve> {
    let (_, value) = written?;
    let name = value.to_string();
    let found = Solve::named(&name);
    if found.is_none() {
        let nearest = nearest(&name, &Solve::ALL.map(Solve::name));
        report.error(value.span(), SyntaxMessage::UnknownSolve { name, nearest });
    }
    found
}
