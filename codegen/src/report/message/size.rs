//! Messages about a description: how large it is and what can be derived of it.

use super::{Problem, problem};

/// A mistake in a description: how large it is and what can be derived of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SizeMessage {
    /// Code in loops for something that it does not do.
    NoLoops {
        /// Name of it, as in "`emit(modes)`".
        what: String,
    },
    /// More links than can be expanded, of a rule whose code cannot be loops.
    TooManyForUnrolled {
        /// Name of it, as in "`emit(modes)`".
        what: String,
        /// The limit.
        limit: usize,
    },
    /// More links than can be expanded.
    TooManyLinks {
        /// The limit.
        limit: usize,
    },
    /// More pairs of a link and one above it than can be written out.
    TooManyPairs {
        /// Number of pairs.
        pairs: usize,
        /// The limit.
        limit: usize,
    },
    /// Formulas longer than the derivation goes on with.
    TooManyTerms {
        /// The limit.
        limit: u64,
    },
    /// More values in the code than are written.
    TooManyValues {
        /// The limit.
        limit: usize,
    },
    /// The derivation could not be run.
    Algebra(String),
}

impl SizeMessage {
    /// The message in words.
    pub(super) fn problem(&self) -> Problem {
        use SizeMessage as M;
        match self {
            M::NoLoops { what } => problem(
                format!("no loops with {what}"),
                "this cannot be in loops",
                "leave `code = loops` out, or what it does not go with; loops compute \
                 accelerations and energies",
            ),
            M::TooManyForUnrolled { what, limit } => problem(
                format!("more than {limit} links with {what}"),
                "too many to be written out",
                "leave that out: loops over generations compute accelerations and energies \
                 of any number of links; or use fewer generations or branches",
            ),
            M::TooManyLinks { limit } => problem(
                format!("more than {limit} links"),
                "too many with this one",
                "use fewer generations, branches or copies",
            ),
            M::TooManyPairs { pairs, limit } => problem(
                format!(
                    "a tree too large to be written out: {pairs} pairs of a link and one above"
                ),
                format!("at most {limit} pairs"),
                "large trees get loops where accelerations and energies alone are asked for; or \
                 use fewer links or shorter chains",
            ),
            M::TooManyTerms { limit } => problem(
                "formulas too long to be derived",
                format!("more than {limit} terms"),
                "ask for less at once: lower orders, fewer outputs, simpler observables, or a \
                 smaller tree",
            ),
            M::TooManyValues { limit } => problem(
                "code too long to be written",
                format!("more than {limit} values"),
                "ask for less at once: fewer outputs or forms, lower orders, or a smaller tree",
            ),
            M::Algebra(reason) => problem(
                "the mechanics could not be derived",
                reason.as_str(),
                "commit the expansion made by the tool `branched-pendulum` where the derivation cannot run",
            ),
        }
    }
}
