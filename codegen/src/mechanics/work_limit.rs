//! Limit of the work of one derivation, counted in terms of formulas that are multiplied
//! out, and in what other operations take as long as: the same on every machine, as a limit
//! of time would not be. Terms take some 1.2 µs each in an unoptimised build.

use std::cell::Cell;

/// Most terms that one derivation may form.
pub const MOST_TERMS: u64 = 4_000_000;

thread_local! {
    /// Terms that the derivation on this thread has formed.
    static SPENT: Cell<u64> = const { Cell::new(0) };
}

/// Reason for which a derivation ended early.
pub(super) struct TooManyTerms;

/// Counts terms that are about to be formed, and ends the derivation, which has a
/// thread of its own, where they are too many.
pub(super) fn spend(terms: u64) {
    let spent = SPENT.get().saturating_add(terms);
    SPENT.set(spent);
    if spent > MOST_TERMS {
        // No panic: nothing is printed, and `algebra::run` says why.
        std::panic::resume_unwind(Box::new(TooManyTerms));
    }
}
