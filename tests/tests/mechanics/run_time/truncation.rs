//! Errors of truncated forms of W: derived forms against those of a tree at run time, and
//! differences that are not small.

use branched_pendulum::TransferForms;
use branched_pendulum::analysis::SectorModes;
use branched_pendulum::analysis::truncation::{
    Background, ComparedForms, ErrorCurve, PhaseAverage, TreeForms, sector_frequencies,
};
use branched_pendulum::prelude::*;
use branched_pendulum_trees::PendulumTree;

/// The pendulum of the paper.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ],
    emit(transfer(angle = 1, amplitude = 2, amplitude = 4, exact)),
)]
struct Paper;

/// A nested tree of which one branching counts as small.
#[branched_pendulum(
    gravity = 9.80665,
    trunk: rod(mass = 0.12, length = 0.3) [
        limb: rod(mass = 0.06, length = 0.2) [twig: rod(mass = 0.03, length = 0.15) * 2] * 2
    ],
    emit(modes, budget(canonical, amplitude = 2, amplitude = 4, small(twig_1_d, twig_2_d))),
)]
struct Twigs;

fn curves(tree: &(impl ComparedForms + Sync), amplitudes: &[f64]) -> Vec<ErrorCurve> {
    let average = PhaseAverage {
        amplitudes: amplitudes.to_vec(),
        states: 300,
        seed: 0,
        background: Background::uniform(tree, 1.0, 5.0),
    };
    average.curves(tree).expect("amplitudes that grow")
}

#[test]
fn derived_forms_have_the_errors_of_series() {
    let tree = PendulumTree::parse(
        "gravity = 9.80665,
        parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
            child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
        ]",
    );
    let tree = tree.expect("it is right");
    let symmetric = tree.symmetric().expect("it has copies");
    let forms = TreeForms {
        tree: &symmetric,
        motion: SymmetricCoordinates(&tree),
        forms: <Paper as TransferForms<f64>>::TRANSFER_FORMS.to_vec(),
    };
    let amplitudes = [0.03, 0.3, 1.2];
    let (own, derived) = (
        curves(&forms, &amplitudes),
        curves(&Paper::new(), &amplitudes),
    );
    let [own, derived] = [&own, &derived].map(|curves| curves.first().expect("one sector"));
    assert_eq!(
        (&own.receiver, &own.forms),
        (&derived.receiver, &derived.forms)
    );
    for (own, derived) in own.points.iter().zip(&derived.points) {
        for (own, derived) in own.errors.iter().zip(&derived.errors) {
            assert!((own / derived - 1.0).abs() < 1e-6, "{own} {derived}");
        }
    }
}

/// Differences that are not small belong to the background: they stay what they
/// are, and W into them is not small either.
#[test]
fn sectors_that_keep_any_size_are_part_of_the_background() {
    let amplitudes = [0.02_f64, 0.04];
    let curves = curves(&Twigs::new(), &amplitudes);
    let curve = curves.iter().find(|curve| curve.receiver == "twig_1_d");
    let curve = curve.expect("a receiver of that name");
    let slope = |form: usize| {
        let errors = curve.errors(form);
        (errors[1] / errors[0]).ln() / (amplitudes[1] / amplitudes[0]).ln()
    };
    let found = [slope(0), slope(1)];
    assert!(found[0] > 0.9 && found[1] > found[0] + 1.5, "{found:?}");
}

#[test]
fn frequencies_of_differences_are_those_of_their_modes() {
    let model = Twigs::new();
    let (mass, stiffness) = (
        model.mass_matrix(&[0.0; 7]),
        model.stiffness_matrix(&[0.0; 7]),
    );
    let modes = SectorModes::new(Twigs::<f64>::SECTORS, &mass, &stiffness);
    let blocks = modes.expect("it hangs").blocks;
    let found = sector_frequencies(&model).expect("it hangs");
    assert_eq!(found.len(), 2);
    for (found, block) in found.iter().zip(&blocks[2..]) {
        let expected = block.modes.frequencies_hz[0] * std::f64::consts::TAU;
        assert!((found / expected - 1.0).abs() < 1e-9, "{found}, {expected}");
    }
}
