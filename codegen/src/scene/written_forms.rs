//! Forms in the parentheses after a requested output.

use proc_macro2::{Ident, Span};

use crate::description::RequestForm;
use crate::report::{Faults, OutputMessage};

/// A form in the parentheses after an output.
pub(super) struct WrittenForm<'f> {
    pub(super) text: String,
    pub(super) order: Option<u32>,
    /// Span of the name.
    pub(super) span: Span,
    /// Span of the value, or of the name if there is no value.
    pub(super) place: Span,
    pub(super) members: Option<&'f [Ident]>,
}

/// Returns the requested forms, each once. A form may be written several times with different
/// orders.
pub(super) fn written_forms<'f>(
    forms: &'f [RequestForm],
    report: &mut Faults,
) -> Vec<WrittenForm<'f>> {
    let mut written: Vec<WrittenForm<'f>> = Vec::new();
    for form in forms {
        let (text, span) = (form.name.to_string(), form.name.span());
        let order = form.value.map(|value| value.count);
        if written
            .iter()
            .any(|known| known.text == text && known.order == order)
        {
            report.error(span, OutputMessage::DuplicateRequest { name: text });
            continue;
        }
        written.push(WrittenForm {
            text,
            order,
            span,
            place: form.value.map_or(span, |value| value.span),
            members: form.members.as_deref(),
        });
    }
    written
}
