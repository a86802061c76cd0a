//! Messages about a description: how large it is and what can be derived of it.

use super::Problem;

messages! {
    /// A mistake in a description: how large it is and what can be derived of it.
    SizeMessage as Size:

    /// Code in loops for something that it does not do.
    NoLoops { what: String } => (
        format!("no loops with {what}"),
        "this cannot be in loops",
        "leave `code = loops` out, or what it does not go with; loops compute \
         accelerations and energies",
    ),
    /// More links than can be expanded, of a rule whose code cannot be loops.
    TooManyForUnrolled { what: String, limit: usize } => (
        format!("more than {limit} links with {what}"),
        "too many to be written out",
        "leave that out: loops over generations compute accelerations and energies \
         of any number of links; or use fewer generations or branches",
    ),
    /// More links than can be expanded.
    TooManyLinks { limit: usize } => (
        format!("more than {limit} links"),
        "too many with this one",
        "use fewer generations, branches or copies",
    ),
    /// More pairs of a link and one above it than can be written out.
    TooManyPairs { pairs: usize, limit: usize } => (
        format!(
            "a tree too large to be written out: {pairs} pairs of a link and one above"
        ),
        format!("at most {limit} pairs"),
        "large trees get loops where accelerations and energies alone are asked for; or \
         use fewer links or shorter chains",
    ),
    /// Formulas longer than the derivation goes on with.
    TooManyTerms { limit: u64 } => (
        "formulas too long to be derived",
        format!("more than {limit} terms"),
        "ask for less at once: lower orders, fewer outputs, simpler observables, or a \
         smaller tree",
    ),
    /// More values in the code than are written.
    TooManyValues { limit: usize } => (
        "code too long to be written",
        format!("more than {limit} values"),
        "ask for less at once: fewer outputs or forms, lower orders, or a smaller tree",
    ),
    /// The derivation could not be run.
    Algebra { reason: String } => (
        "the mechanics could not be derived",
        reason.as_str(),
        "commit the expansion made by the tool `branched-pendulum` where the derivation cannot run",
    ),
}
