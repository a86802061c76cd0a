//! Collected errors of a description, each with its span in the source.
//!
//! Every stage of the front end adds its errors to one [`Faults`] and continues after an error, so
//! that a user sees all mistakes at once. The messages are listed in [`Message`].

mod message;
mod nearest;
mod settings;

use std::fmt::Write as _;

use proc_macro2::{Span, TokenStream};
use quote::quote_spanned;

pub use message::{
    Lookalike, Message, NoChord, OutputMessage, Problem, SizeMessage, SyntaxMessage, TreeMessage,
    UnequalUse, ValueMessage,
};
pub use nearest::nearest;
pub use settings::SceneSetting;

/// One error and its span.
#[derive(Debug, Clone)]
pub struct Diagnostic {
    /// The tokens that are wrong.
    pub span: Span,
    /// Message about these tokens.
    pub message: Message,
}

impl Diagnostic {
    /// Creates an error at `span`.
    pub fn new(span: Span, message: impl Into<Message>) -> Self {
        let message = message.into();
        Self { span, message }
    }
}

/// Names that links, parameters and observables may have.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum NameRule {
    /// Snake-case names, which become part of names in the emitted code.
    #[default]
    SnakeCase,
    /// Any letters, digits and underscores, as in `I_2` and `L`: no code is emitted.
    Free,
}

/// All errors found so far, in the order in which they were found.
#[derive(Debug, Clone, Default)]
pub struct Faults {
    diagnostics: Vec<Diagnostic>,
    names: NameRule,
}

impl Faults {
    /// Creates an empty list of errors.
    pub fn new() -> Self {
        Self::default()
    }

    /// Creates an empty list of errors, for a description whose names follow this rule.
    pub fn with_names(names: NameRule) -> Self {
        Self {
            diagnostics: Vec::new(),
            names,
        }
    }

    /// Returns the rule that names follow.
    pub fn names(&self) -> NameRule {
        self.names
    }

    /// Adds an error.
    pub fn error(&mut self, span: Span, message: impl Into<Message>) {
        self.push(Diagnostic::new(span, message));
    }

    /// Adds an error.
    pub fn push(&mut self, diagnostic: Diagnostic) {
        self.diagnostics.push(diagnostic);
    }

    /// Returns true if there are no errors.
    pub fn is_empty(&self) -> bool {
        self.diagnostics.is_empty()
    }

    /// Returns the errors, in the order in which they were found.
    pub fn diagnostics(&self) -> &[Diagnostic] {
        &self.diagnostics
    }

    /// Returns one `compile_error!` per error, at the error's span.
    pub fn to_compile_errors(&self) -> TokenStream {
        self.diagnostics
            .iter()
            .map(|Diagnostic { span, message }| {
                let Problem { text, label, hint } = message.problem();
                // `compile_error!` takes one text only.
                let text = format!("{text}: {label}\nhelp: {hint}");
                quote_spanned!(*span=> ::core::compile_error! { #text })
            })
            .collect()
    }

    /// Formats the errors in the manner of the Rust compiler, in the order of the source: message,
    /// line and column, the line with the wrong tokens marked, and what to write instead. `source`
    /// is the text that the tokens were read from. Long lines are shortened, and of
    /// very many errors only the first are shown.
    pub fn render(&self, source: &str) -> String {
        let mut ordered: Vec<&Diagnostic> = self.diagnostics.iter().collect();
        ordered.sort_by_key(|diagnostic| {
            let start = diagnostic.span.start();
            (start.line, start.column)
        });
        let mut text = String::new();
        for diagnostic in ordered.iter().take(MOST_SHOWN) {
            if !text.is_empty() {
                text.push('\n');
            }
            render_one(diagnostic, source, &mut text);
        }
        let others = ordered.len().saturating_sub(MOST_SHOWN);
        if others > 0 {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "\n{others} more errors");
        }
        text
    }
}

/// Largest number of errors that are shown as text.
const MOST_SHOWN: usize = 100;

/// Largest number of characters of a source line that are shown, and of those before the error.
const LONGEST_LINE: usize = 120;
const BEFORE: usize = 60;

/// Returns the part of a long line around `column`, and the column within that part.
fn excerpt(line: &str, column: usize) -> (String, usize) {
    if line.chars().nth(LONGEST_LINE).is_none() {
        return (line.to_owned(), column);
    }
    let start = column.saturating_sub(BEFORE);
    let part = line.chars().skip(start).take(LONGEST_LINE);
    let lead = if start > 0 { "…" } else { "" };
    let part: String = lead.chars().chain(part).collect();
    (part, column - start + lead.chars().count())
}

/// Appends the text of one error to `text`.
fn render_one(diagnostic: &Diagnostic, source: &str, text: &mut String) {
    let Diagnostic { span, message } = diagnostic;
    let Problem {
        text: headline,
        label,
        hint,
    } = message.problem();
    let (start, end) = (span.start(), span.end());
    // Writing to a string cannot fail.
    let _ = writeln!(text, "error: {headline}");
    if let Some(line) = source.lines().nth(start.line.saturating_sub(1)) {
        let margin = " ".repeat(start.line.to_string().len());
        let (line, column) = excerpt(line, start.column);
        let whole = line.chars().count().saturating_sub(column);
        let width = if end.line == start.line {
            end.column.saturating_sub(start.column).min(whole)
        } else {
            whole
        };
        let _ = writeln!(text, "{margin}--> {}:{}", start.line, start.column + 1);
        let _ = writeln!(text, "{margin} |");
        let _ = writeln!(text, "{} | {line}", start.line);
        let _ = writeln!(
            text,
            "{margin} | {}{} {label}",
            " ".repeat(column),
            "^".repeat(width.max(1)),
        );
    }
    let _ = writeln!(text, "help: {hint}");
}
