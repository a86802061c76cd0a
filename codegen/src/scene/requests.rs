//! Requests: reads the requested outputs, and checks that they can be derived for the tree.

use std::ops::RangeInclusive;

use proc_macro2::{Ident, Span};

use super::expand::ExpandedTree;
use super::gradient::gradient;
use super::small_sectors::acting;
use super::written_forms::{WrittenForm, written_forms};
use super::{BudgetRequest, LinkId, Requests, TransferRequest};
use crate::description::{ObservableClause, Request, RequestForm};
use crate::report::{Faults, OutputMessage, UnequalUse, nearest};

/// Outputs that may have forms in parentheses.
const WITH_FORMS: [&str; 4] = ["transfer", "budget", "small", "gradient"];

/// Names of all forms of the energy budget.
const BUDGET_FORMS: &[&str] = &[
    "canonical",
    "parseval",
    "velocity",
    "rest",
    "matrix",
    "scales",
    "angle",
    "amplitude",
    "small",
];

/// Names of all forms of the energy transfer.
const FORMS: &[&str] = &["angle", "amplitude", "exact"];

/// Supported orders in the difference angles; the paper uses order 1.
const ANGLE_ORDERS: RangeInclusive<u32> = 1..=8;

/// Supported orders in the amplitude; the expansion begins with order 2.
const AMPLITUDE_ORDERS: RangeInclusive<u32> = 2..=8;

/// The requests, and the spans of those that require identical siblings.
pub(super) struct Resolved {
    pub(super) requests: Requests,
    symmetric: Option<Span>,
    transfer: Option<Span>,
    /// Span of the first order of the transfer in the source.
    transfer_order: Option<Span>,
    pub(super) budget: Option<Span>,
    /// Span of `normal_form`.
    pub(super) normal_form: Option<Span>,
    /// Span of `transverse`.
    pub(super) transverse: Option<Span>,
    /// Span of `gradient`.
    gradient: Option<Span>,
    /// Span of the word `small`, and the names of the sectors (differences between copies) that act
    /// back on the in-phase motion.
    pub(super) acting: Option<(Span, Vec<Ident>)>,
    /// Names of the sectors whose differences count as small in a budget.
    pub(super) small: Vec<Ident>,
}

/// Reads the requests. Adds mistakes to `report`.
pub(super) fn resolve_requests(
    requests: &[Request],
    observables: &[ObservableClause],
    report: &mut Faults,
) -> Resolved {
    let mut resolved = Resolved {
        requests: Requests::default(),
        symmetric: None,
        transfer: None,
        transfer_order: None,
        budget: None,
        normal_form: None,
        transverse: None,
        gradient: None,
        acting: None,
        small: Vec::new(),
    };
    let mut named = false;
    let mut seen: Vec<String> = Vec::new();
    for Request {
        name,
        forms,
        damaged,
    } in requests
    {
        let (text, span) = (name.to_string(), name.span());
        if seen.contains(&text) {
            report.error(span, OutputMessage::DuplicateRequest { name: text });
            continue;
        }
        let wanted = &mut resolved.requests;
        if let Some(flag) = wanted.flag(&text) {
            *flag = true;
            if forms.is_some() {
                report.error(span, OutputMessage::RequestForms { name: text.clone() });
            }
            match text.as_str() {
                "normal_form" => resolved.normal_form = Some(span),
                "transverse" => resolved.transverse = Some(span),
                "symmetric" => resolved.symmetric = Some(span),
                _ => {}
            }
            seen.push(text);
            continue;
        }
        match text.as_str() {
            "small" => {
                wanted.transverse = true;
                let names = acting(span, forms.as_deref(), *damaged, report);
                resolved.acting = Some((span, names));
            }
            "transfer" => {
                wanted.transfer = Some(transfer(span, forms.as_deref(), *damaged, report));
                resolved.transfer = Some(span);
                let mut orders = forms.iter().flatten().filter(|form| form.name != "exact");
                resolved.transfer_order = orders.next().map(|form| form.name.span());
            }
            "gradient" => {
                let gradient = gradient(span, forms.as_deref(), *damaged, observables, report);
                wanted.gradient = Some(gradient);
                named = forms.is_some();
                resolved.gradient = Some(span);
            }
            "budget" => {
                let small = &mut resolved.small;
                wanted.budget = Some(budget(span, forms.as_deref(), *damaged, small, report));
                resolved.budget = Some(span);
            }
            _ => {
                let flags = Requests::FLAGS.iter().map(|(name, _)| *name);
                let outputs: Vec<&str> = flags.chain(WITH_FORMS).collect();
                let nearest = nearest(&text, &outputs);
                let name = text.clone();
                report.error(span, OutputMessage::UnknownRequest { name, nearest });
            }
        }
        seen.push(text);
    }
    let wanted = &mut resolved.requests;
    // Without names, derivatives of all other requested outputs are requested.
    if let Some(gradient) = &mut wanted.gradient {
        match named {
            true => wanted.energies |= gradient.energies,
            false => gradient.energies = wanted.energies,
        }
        match (wanted.transfer.is_some(), resolved.gradient) {
            (false, Some(span)) if named && gradient.transfer => {
                report.error(span, OutputMessage::GradientOfNoTransfer);
            }
            (requested, _) => gradient.transfer &= requested,
        }
    }
    // The transfer and truncated budgets are expressed in canonical symmetric coordinates.
    wanted.complete();
    let truncated = wanted
        .budget
        .as_ref()
        .is_some_and(|b| !b.amplitude_orders.is_empty() || !b.angle_orders.is_empty());
    if wanted.transfer.is_some() || truncated {
        wanted.symmetric = true;
        wanted.momenta = true;
    }
    resolved
}

/// Reads a truncated form, `angle = n` or `amplitude = n`. Returns false if the form is another
/// one.
fn take_order(
    form: &WrittenForm<'_>,
    [angle, amplitude]: [&mut Vec<u32>; 2],
    report: &mut Faults,
) -> bool {
    let (known, orders, message) = match form.text.as_str() {
        "angle" => (ANGLE_ORDERS, angle, OutputMessage::AngleOrder),
        "amplitude" => (AMPLITUDE_ORDERS, amplitude, OutputMessage::AmplitudeOrder),
        _ => return false,
    };
    match form.order.filter(|order| known.contains(order)) {
        Some(order) => orders.push(order),
        None => report.error(form.place, message),
    }
    true
}

/// Reads the requested forms of the budget; all exact forms if none are named.
fn budget(
    span: Span,
    forms: Option<&[RequestForm]>,
    damaged: bool,
    small: &mut Vec<Ident>,
    report: &mut Faults,
) -> BudgetRequest {
    let mut request = BudgetRequest::default();
    let Some(forms) = forms else {
        return BudgetRequest {
            canonical: true,
            parseval: true,
            velocity: true,
            matrix: true,
            ..BudgetRequest::default()
        };
    };
    if forms.is_empty() && !damaged {
        report.error(span, OutputMessage::NoBudgetForm);
    }
    for form in written_forms(forms, report) {
        let text = form.text.as_str();
        if form.members.is_some() && text != "small" && BUDGET_FORMS.contains(&text) {
            let name = text.to_owned();
            report.error(form.place, OutputMessage::RequestForms { name });
        }
        let orders = [&mut request.angle_orders, &mut request.amplitude_orders];
        if take_order(&form, orders, report) {
            continue;
        }
        let flag = match text {
            "canonical" => &mut request.canonical,
            "parseval" => &mut request.parseval,
            "velocity" => &mut request.velocity,
            "rest" => &mut request.rest,
            "matrix" => &mut request.matrix,
            "scales" => &mut request.scales,
            "small" => {
                match form.members {
                    Some(members) if !members.is_empty() => members.clone_into(small),
                    _ => report.error(form.place, OutputMessage::NoSmallSector),
                }
                continue;
            }
            _ => {
                let (name, nearest) = (text.to_owned(), nearest(text, BUDGET_FORMS));
                report.error(
                    form.span,
                    OutputMessage::UnknownBudgetForm { name, nearest },
                );
                continue;
            }
        };
        *flag = true;
        if form.order.is_some() {
            let form_name = text.to_owned();
            report.error(form.place, OutputMessage::BudgetOrder { form: form_name });
        }
    }
    if request.scales {
        let others = |form: &&RequestForm| form.name != "scales" && form.name != "parseval";
        if let Some(form) = forms.iter().find(others) {
            report.error(form.name.span(), OutputMessage::BesideScales);
        }
    }
    if request.amplitude_orders.is_empty()
        && request.angle_orders.is_empty()
        && let Some(name) = small.first()
    {
        report.error(name.span(), OutputMessage::SmallWithoutOrder);
    }
    request
}

/// Reads the requested forms of the transfer; all forms if none are named.
fn transfer(
    span: Span,
    forms: Option<&[RequestForm]>,
    damaged: bool,
    report: &mut Faults,
) -> TransferRequest {
    let mut request = TransferRequest {
        angle_orders: Vec::new(),
        amplitude_orders: Vec::new(),
        exact: false,
    };
    let Some(forms) = forms else {
        return TransferRequest {
            angle_orders: vec![*ANGLE_ORDERS.start()],
            amplitude_orders: vec![*AMPLITUDE_ORDERS.start()],
            exact: true,
        };
    };
    if forms.is_empty() && !damaged {
        report.error(span, OutputMessage::NoForm);
    }
    for form in written_forms(forms, report) {
        let name = form.text.clone();
        if form.members.is_some() {
            let name = name.clone();
            report.error(span, OutputMessage::RequestForms { name });
        }
        let orders = [&mut request.angle_orders, &mut request.amplitude_orders];
        if take_order(&form, orders, report) {
            continue;
        }
        if name == "exact" {
            request.exact = true;
            if form.order.is_some() {
                report.error(form.place, OutputMessage::ExactOrder);
            }
        } else {
            let nearest = nearest(&name, FORMS);
            report.error(form.span, OutputMessage::UnknownForm { name, nearest });
        }
    }
    request
}

/// Checks that the tree has the identical siblings that the requests require. If no form of the
/// transfer is named and copies differ, keeps only the forms that are valid for them.
pub(super) fn check_symmetry(
    resolved: &mut Resolved,
    expansion: &ExpandedTree,
    report: &mut Faults,
) {
    let ExpandedTree {
        links,
        groups,
        orbits,
        lineage: _,
    } = expansion;
    let unequal = orbits.iter().find(|orbit| orbit.is_of_unequal());
    if let Some(orbit) = unequal {
        let places = [
            (resolved.transfer_order, UnequalUse::Order),
            (resolved.budget, UnequalUse::Budget),
        ];
        for (span, wanted) in places {
            if let Some(span) = span {
                let node = orbit.node.clone();
                report.error(span, OutputMessage::UnequalCopies { node, wanted });
            }
        }
        if let Some(transfer) = &mut resolved.requests.transfer {
            transfer.angle_orders.clear();
            transfer.amplitude_orders.clear();
        }
    }
    if groups.is_empty() {
        let needy = [
            (resolved.symmetric, "symmetric"),
            (resolved.transfer, "transfer"),
            (
                resolved.budget.filter(|_| !resolved.requests.scales()),
                "budget",
            ),
        ];
        for (span, request) in needy {
            if let Some(span) = span {
                let request = request.to_owned();
                report.error(span, OutputMessage::NoSiblings { request });
            }
        }
    }
    let Some(span) = resolved.transfer else {
        return;
    };
    let has_children = |copy: &LinkId| links.iter().any(|link| link.parent == Some(*copy));
    let nested = groups
        .iter()
        .find(|group| group.copies.iter().any(has_children));
    if let Some(group) = nested {
        let group = group.name.clone();
        report.error(span, OutputMessage::NestedGroups { group });
    }
    let lopsided = groups
        .iter()
        .flat_map(|group| &group.copies)
        .map(|copy| &links[copy.0])
        .find(|link| !link.com.lateral.is_zero());
    if let Some(link) = lopsided {
        let link = link.name.clone();
        report.error(span, OutputMessage::LateralTransfer { link });
    }
}
