//! Settings of a normal form.

use super::prediction::Agreement;
use super::resonance::Resonance;

/// Settings of a [`NormalForm`](super::NormalForm).
#[derive(Clone, Debug, PartialEq)]
pub struct NormalFormOptions {
    /// Degree up to which the Hamiltonian is expanded: an even number from 4 to 12.
    pub degree: u32,
    /// Largest relative mismatch of a resonance that is kept: a resonance of order 4 + 2k is kept
    /// if |Σ n_j f_j| is at most `bound`/2^k times the lowest frequency of a difference.
    pub bound: f64,
    /// Resonances that are removed although they are within the bound.
    pub removed: Vec<Resonance>,
    /// Largest accepted difference between the results of the two highest degrees.
    pub agreement: Agreement,
    /// Longest period of an averaged motion that is waited for where modes in phase exchange
    /// energy, s.
    pub following: f64,
}

impl Default for NormalFormOptions {
    fn default() -> Self {
        Self {
            degree: 8,
            bound: 0.15,
            removed: Vec::new(),
            agreement: Agreement { frequency: 5e-3 },
            following: 240.0,
        }
    }
}
