//! The mechanics of a tree in loops.

use super::Mechanics;
use super::articulation::Articulation;
use super::derivation::Derivation;

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
            articulation: Articulation {
                gravity: self.expr(&gravity.expand()),
                joints: Vec::new(),
            },
            link: Some(link),
            scales,
            trigonometry: self.trigonometry,
            symbols: self.symbols,
            ..Mechanics::default()
        }
    }
}
