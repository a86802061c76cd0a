//! Messages about the size of a tree, and about a derivation that fails.

use super::Problem;

messages! {
    /// The tree is too large, or its equations cannot be derived.
    SizeMessage as Size:

    /// Code in loops is requested together with something that it does not support.
    NoLoops { what: String } => (
        format!("code in loops does not support {what}"),
        "cannot be computed in loops",
        "leave out `code = loops`, or the part that it does not support; loops compute \
         accelerations, energies, and with `gradient(accelerations)` derivatives of accelerations",
    ),
    /// A generation rule has too many links to be written out, and its code cannot be loops.
    TooManyForUnrolled { what: String, limit: usize } => (
        format!("more than {limit} links cannot be combined with {what}"),
        "too many links to be written out",
        format!(
            "leave out {what}: without it the code is loops over generations, which compute \
             accelerations and energies of any number of links; or use fewer generations or \
             branches"
        ),
    ),
    /// The tree has too many links to be expanded.
    TooManyLinks { limit: usize } => (
        format!("the tree has more than {limit} links"),
        "exceeds the limit",
        "use fewer generations, branches or copies",
    ),
    /// The tree has too many pairs of a link and one of its ancestors to be written out.
    TooManyPairs { pairs: usize, limit: usize } => (
        format!(
            "the tree is too large to be written out: {pairs} pairs of a link and one of its \
             ancestors"
        ),
        format!("at most {limit} pairs"),
        "request accelerations and energies only, so that a large tree gets loops, or use fewer \
         links or shorter chains",
    ),
    /// The formulas exceed the number of terms at which the derivation stops.
    TooManyTerms { limit: u64 } => (
        "the formulas are too long to be derived",
        format!("more than {limit} terms"),
        "request less at once: lower orders, fewer outputs, simpler observables, or a smaller \
         tree",
    ),
    /// The code would have too many values.
    TooManyValues { limit: usize } => (
        "the code is too long to be emitted",
        format!("more than {limit} values"),
        "request less at once: fewer outputs or forms, lower orders, or a smaller tree",
    ),
    /// The computer algebra could not be run.
    Algebra { reason: String } => (
        "the mechanics could not be derived",
        reason.as_str(),
        "if the derivation cannot run here, commit the expansion that \
         `cargo branched-pendulum expand` writes",
    ),
}
