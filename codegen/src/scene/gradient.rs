//! Request for derivatives of functions by their arguments and by parameters.

use proc_macro2::Span;

use super::GradientRequest;
use super::written_forms::written_forms;
use crate::description::{ObservableClause, RequestForm};
use crate::report::{Faults, OutputMessage, nearest};

/// Names of the functions of a model that can be differentiated, in addition to observables.
const FUNCTIONS: [&str; 3] = ["accelerations", "energies", "transfer"];

/// Reads the functions that `gradient(...)` names; all if there are no parentheses.
pub(super) fn gradient(
    span: Span,
    forms: Option<&[RequestForm]>,
    damaged: bool,
    observables: &[ObservableClause],
    report: &mut Faults,
) -> GradientRequest {
    let names = observables.iter().map(|clause| clause.name.to_string());
    let Some(forms) = forms else {
        return GradientRequest {
            accelerations: true,
            energies: true,
            transfer: true,
            observables: names.collect(),
        };
    };
    if forms.is_empty() && !damaged {
        report.error(span, OutputMessage::NoGradient);
    }
    let names: Vec<String> = names.collect();
    let mut request = GradientRequest::default();
    for form in written_forms(forms, report) {
        let name = form.text.clone();
        if form.order.is_some() || form.members.is_some() {
            let name = name.clone();
            report.error(form.span, OutputMessage::GradientForms { name });
        }
        let is_observable = names.contains(&name);
        match name.as_str() {
            "accelerations" => request.accelerations = true,
            "energies" => request.energies = true,
            "transfer" => request.transfer = true,
            _ if is_observable => {}
            _ => {
                let (name, nearest) = (name.clone(), nearest(&name, &FUNCTIONS));
                report.error(form.span, OutputMessage::UnknownGradient { name, nearest });
            }
        }
        // An observable may have the name of a function.
        request.observables.extend(is_observable.then_some(name));
    }
    request
}
