//! Mechanics of a tree whose code is loops.

use super::Mechanics;
use super::articulation::Articulation;
use super::derivation::Derivation;

impl Derivation<'_> {
    /// Derives the equations of one link, which represents all links, and the drive.
    pub(super) fn finish_loops(mut self) -> Mechanics {
        self.drive_signals();
        let link = self.link_balance();
        let forces = self.joint_forces(link.symbols.omega);
        let requests = &self.scene.requests;
        let (energies, scales) = (requests.energies || requests.positions, requests.scales());
        let body = (energies || scales).then(|| self.link_body(&link.symbols, &forces));
        let scales = body.as_ref().filter(|_| scales);
        let scales = scales.map(|body| self.link_scales(&link.symbols, &forces, &body.symbols));
        let gravity = self.quantity(&self.scene.gravity);
        Mechanics {
            parameters: self.parameters.clone(),
            drive: self.plain_drive(None),
            articulation: Articulation {
                gravity: self.expr(&gravity.expand()),
                joints: Vec::new(),
                pairs: Vec::new(),
                lines: Vec::new(),
            },
            link: Some(link),
            joint_forces: Some(self.plain_forces(&forces)),
            body,
            scales,
            trigonometry: self.trigonometry,
            symbols: self.symbols,
            ..Mechanics::default()
        }
    }
}
