//! The paper's apparatus as a tree at run time.

use branched_pendulum::system::Workspace;
use branched_pendulum::transfer::{StateInput, SymmetricTree};
use branched_pendulum::{Transfer, TransferForm};
use branched_pendulum_trees::PendulumTree;
use serde_json::Value;

use super::{Terms, largest, number};
use crate::support::Worst;

pub(super) struct AtRunTime(SymmetricTree<f64>);

impl AtRunTime {
    pub(super) fn new() -> Self {
        let tree = PendulumTree::parse(
            "gravity = 9.80665,
             parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
                 child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
             ]",
        );
        let symmetric = tree.and_then(|tree| tree.symmetric());
        Self(symmetric.expect("it has two children alike"))
    }

    /// Notes all figures of a point.
    pub(super) fn note(
        &self,
        worst: &mut Worst,
        point: &Value,
        terms: &Terms,
        [coordinates, momenta]: [&[f64]; 2],
    ) {
        let given = StateInput::Momenta {
            coordinates,
            momenta,
        };
        let mut check = |name: &str, own: f64, terms: &[f64]| {
            let expected = number(&point[name]);
            worst.note(own - expected, largest(terms), || {
                format!("{name} at run time, of {expected}")
            });
        };
        let Self(tree) = self;
        let workspace = &mut Workspace::new();
        check("H", tree.hamiltonian(workspace, given), &terms.energy);
        let mut energies = [[0.0; 2]; 2];
        tree.energies(workspace, given, &mut energies);
        let [kinetic, potential] = energies[1];
        check("Hd", kinetic + potential, &terms.antiphase_energy);
        let mut transfers = |form| {
            let mut transfers = [Transfer::default(); 2];
            tree.transfers(workspace, form, given, &mut transfers);
            transfers[1]
        };
        let angle = transfers(TransferForm::Angle(1));
        check("WK_paper", angle.kinetic, &terms.angle_kinetic);
        check("WP_paper", angle.potential, &terms.angle_potential);
        let amplitude = transfers(TransferForm::Amplitude(2)).total();
        check("W_eps2", amplitude, &terms.amplitude);
        check("W", transfers(TransferForm::Exact).total(), &terms.exact);
    }
}
