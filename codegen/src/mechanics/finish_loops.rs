//! The mechanics of a tree in loops.

use super::articulation::Articulation;
use super::derivation::Derivation;
use super::{Frame, Mechanics, Observables};

impl Derivation<'_> {
    /// A tree in loops: one link for all, and the drive.
    pub(super) fn finish_loops(mut self) -> Mechanics {
        self.drive_signals();
        let link = self.link_balance();
        let scales = self.scene.requests.scales();
        let scales = scales.then(|| self.link_scales(&link.symbols));
        let gravity = self.quantity(&self.scene.gravity);
        Mechanics {
            parameters: self.parameters.clone(),
            drive: self.plain_drive(None),
            friction_power: None,
            absolute: Frame::default(),
            articulation: Articulation {
                gravity: self.expr(&gravity.expand()),
                joints: Vec::new(),
            },
            positions: None,
            link: Some(link),
            scales,
            combinations: Vec::new(),
            constants: Vec::new(),
            coordinates: Vec::new(),
            symmetric: None,
            sectors: None,
            transverse: None,
            expansion: None,
            mean_tree: None,
            transfers: Vec::new(),
            observables: Observables::default(),
            trigonometry: self.trigonometry,
            symbols: self.symbols,
        }
    }
}
