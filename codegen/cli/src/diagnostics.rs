//! Prints errors of a source file in the format of the Rust compiler.

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use branched_pendulum_codegen::report::{Diagnostic, Faults, Problem};
use std::ops::Range;

/// Formats all errors in an attribute, in the order of the source. Errors without a span point to
/// the struct at `item`.
pub(crate) fn all(
    path: &str,
    source: &str,
    item: &Range<usize>,
    report: &Faults,
    styled: bool,
) -> String {
    let place = |diagnostic: &Diagnostic| {
        let range = diagnostic.span.byte_range();
        if range.is_empty() {
            first_line(source, item)
        } else {
            range
        }
    };
    let mut ordered: Vec<&Diagnostic> = report.diagnostics().iter().collect();
    ordered.sort_by_key(|diagnostic| place(diagnostic).start);
    let texts = ordered.into_iter().map(|diagnostic| {
        let Problem { text, label, hint } = diagnostic.message.problem();
        let snippet = Snippet::source(source).path(path).annotation(
            AnnotationKind::Primary
                .span(place(diagnostic))
                .label(label.as_str()),
        );
        let group = Level::ERROR.primary_title(text.as_str()).element(snippet);
        render(group.element(Level::HELP.message(hint.as_str())), styled)
    });
    texts.collect::<Vec<_>>().join("\n\n")
}

/// Formats one error without a label or a hint.
pub(crate) fn one(
    path: &str,
    source: &str,
    range: Range<usize>,
    title: &str,
    styled: bool,
) -> String {
    let snippet = Snippet::source(source).path(path);
    let snippet = snippet.annotation(AnnotationKind::Primary.span(range));
    render(Level::ERROR.primary_title(title).element(snippet), styled)
}

fn render(group: Group<'_>, styled: bool) -> String {
    let renderer = if styled {
        Renderer::styled()
    } else {
        Renderer::plain()
    };
    renderer.render(&[group])
}

/// Returns the part of a range that is on its first line.
fn first_line(source: &str, range: &Range<usize>) -> Range<usize> {
    let text = source.get(range.clone()).unwrap_or_default();
    let length = text.find('\n').unwrap_or(text.len());
    range.start..range.start + length
}
