//! Energies by scale, as the page is told them.

use wasm_bindgen::prelude::*;

/// Energies by scale and what changes them: scale 0 is what all copies do together, scale s what
/// those of generation s do against each other. Copies may differ, and links of one generation.
#[wasm_bindgen(getter_with_clone)]
#[derive(Clone, Debug, PartialEq)]
pub struct Budget {
    /// Energies, J: those by Parseval sum to the energy of the tree; of those from momenta that of
    /// the paper's pendulum at scale 1 is H_d.
    #[wasm_bindgen(readonly)]
    pub energies: Vec<f64>,
    /// Power that each scale receives from the others, W: the transfer of that name.
    #[wasm_bindgen(readonly)]
    pub received: Vec<f64>,
    /// Power of friction, drag, drive and the hand on each scale, W.
    #[wasm_bindgen(readonly)]
    pub powers: Vec<f64>,
}
