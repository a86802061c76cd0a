//! Functions with one number as their result, whose gradients can be requested.

use super::{Counting, EntryState, ObservableForm};

/// A function with one number as its result, or with the two parts of a transfer, whose sum is
/// differentiated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Differentiated {
    /// Kinetic energy K.
    KineticEnergy,
    /// Potential energy U.
    PotentialEnergy,
    /// Energy H_d of the difference with this index.
    SubHamiltonian(usize),
    /// Energy transfer W into the difference with this index, truncated at an order.
    TruncatedTransfer(usize, Counting, u32),
    /// Energy transfer W into the difference with this index, without truncation.
    ExactTransfer(usize, EntryState),
    /// The observable with this index, or its rate.
    Observable(usize, ObservableForm),
}
