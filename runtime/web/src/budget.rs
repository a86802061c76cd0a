//! Energies by scale, in the form that the web page receives.

use wasm_bindgen::prelude::*;

/// Energies by scale and the powers that change them. Scale 0 is the motion that all copies have in
/// common; scale s is the motion of the copies of generation s relative to each other. Copies, and
/// links of one generation, may differ.
#[wasm_bindgen(getter_with_clone)]
#[derive(Clone, Debug, PartialEq)]
pub struct Budget {
    /// Energies in J. In Parseval's form, their sum is the energy of the tree; in the form computed
    /// from momenta, the energy of scale 1 of the paper's pendulum is H_d.
    #[wasm_bindgen(readonly)]
    pub energies: Vec<f64>,
    /// Power that each scale receives from all others, in W.
    #[wasm_bindgen(readonly)]
    pub received: Vec<f64>,
    /// Power of friction, drag, drive and the user's pointer on each scale, in W.
    #[wasm_bindgen(readonly)]
    pub powers: Vec<f64>,
}
