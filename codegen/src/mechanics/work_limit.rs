//! Limit of the work of one derivation. Work is counted in terms of multiplied-out formulas, and
//! other operations as the number of terms that take equally long. Unlike a limit of time, it is
//! the same on every machine. A term takes about 1.2 µs in an unoptimised build.

use std::cell::Cell;

/// Largest number of terms that one derivation may compute.
pub const MOST_TERMS: u64 = 4_000_000;

thread_local! {
    /// Number of terms that the derivation on this thread has computed.
    static SPENT: Cell<u64> = const { Cell::new(0) };
}

/// Panic payload with which a derivation ends that has too many terms.
pub(super) struct TooManyTerms;

/// Counts terms before they are computed. If there are too many, ends the derivation, which runs on
/// its own thread.
pub(super) fn spend(terms: u64) {
    let spent = SPENT.get().saturating_add(terms);
    SPENT.set(spent);
    if spent > MOST_TERMS {
        // No panic, so that nothing is printed; `algebra::run` reports the reason.
        std::panic::resume_unwind(Box::new(TooManyTerms));
    }
}
