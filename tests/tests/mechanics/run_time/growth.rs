//! Growth of small differences beside motions in phase at run time against the derived transverse
//! equations.

use std::thread;

use branched_pendulum::analysis::growth::{Growth, frequency_at_rest};
use branched_pendulum::ensemble::Ensemble;
use branched_pendulum::prelude::*;
use branched_pendulum::system::{Transverse, TransverseOde};
use branched_pendulum_trees::{DifferenceGrowth, PendulumTree};

/// The paper's pendulum, its children in phase.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ],
    in_phase(child),
    emit(transverse),
)]
struct Paper;

/// Three arms of two links, with springs and dry friction.
#[branched_pendulum(
    gravity = 9.80665,
    trunk: rod(mass = 0.4, length = 0.3, friction = 1e-3) [
        arm: rod(mass = 0.2, length = 0.2, spring = 0.05) [
            hand: rod(mass = 0.1, length = 0.15, friction(coulomb = 2e-3, width = 0.5))
        ] * 3
    ],
    in_phase(arm),
    emit(transverse),
)]
struct Arms;

/// Largest relative difference between growth factors by both ways, after releases of the
/// reduced and of the whole tree, and the largest factor.
fn differences<P: Transverse<f64> + Copy + Sync>(
    model: P,
    text: &str,
    releases: &[[Vec<f64>; 2]],
) -> [f64; 2] {
    let tree = PendulumTree::parse(text).expect("it is right");
    let copies = tree.all_copies();
    let in_phase = tree.in_phase(&copies).expect("it has copies");
    let system = in_phase.with_differences(&copies).expect("they differ");
    let ode = TransverseOde::new(model, 0).expect("there is one sector");
    let own = frequency_at_rest(&system);
    let frequency_hz = frequency_at_rest(&ode);
    assert!(
        (own / frequency_hz - 1.0).abs() < 1e-12,
        "{own} {frequency_hz}"
    );
    let growth = Growth {
        frequency_hz,
        horizons: vec![1.0, 3.0],
        tolerance: 1e-11,
    };
    let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
    for [reduced, whole] in releases {
        let ones = vec![1.0; ode.differences()];
        let start = State::at_rest(0.0, &[&reduced[..], &ones].concat());
        let derived = growth.in_lanes(&Ensemble::new(), &[(ode, start)]);
        let [Ok(derived)] = derived.as_slice() else {
            panic!("{derived:?}")
        };
        let start = system.start(&State::at_rest(0.0, whole));
        let start = start.expect("it is in phase");
        let own = growth.in_lanes(&Ensemble::new(), &[(&system, start)]);
        let [Ok(own)] = own.as_slice() else {
            panic!("{own:?}")
        };
        for (own, derived) in own.factors.iter().zip(&derived.factors) {
            worst = worst.max((own.value / derived.value - 1.0).abs());
            largest = largest.max(own.value);
        }
    }
    [worst, largest]
}

/// Kernels in lanes take large frames where they are not optimised.
const STACK: usize = 64 << 20;

#[test]
fn growth_agrees_with_the_transverse_equations() {
    let thread = thread::Builder::new().stack_size(STACK);
    let compared = thread.spawn(compare).expect("there are threads");
    compared.join().expect("both ways agree");
}

fn compare() {
    let paper = "gravity = 9.80665,
        parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
            child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
        ]";
    let releases = [0.3, 0.6, 0.9, 1.2].map(|angle| [vec![angle, 0.0], vec![angle, 0.0, 0.0]]);
    let [worst, largest] = differences(Paper::new(), paper, &releases);
    assert!(worst < 1e-9 && largest > 2.0, "{worst:e} {largest}");

    let arms = "gravity = 9.80665,
        trunk: rod(mass = 0.4, length = 0.3, friction = 1e-3) [
            arm: rod(mass = 0.2, length = 0.2, spring = 0.05) [
                hand: rod(mass = 0.1, length = 0.15, friction(coulomb = 2e-3, width = 0.5))
            ] * 3
        ]";
    let releases = [0.4, 1.0].map(|angle| {
        let (arm, hand) = (0.3 * angle, -0.2);
        let whole = vec![angle, arm, hand, arm, hand, arm, hand];
        [vec![angle, arm, hand], whole]
    });
    let [worst, largest] = differences(Arms::new(), arms, &releases);
    assert!(worst < 1e-9 && largest > 1.0, "{worst:e} {largest}");
}

/// The decay is the mean over the links of an arm: friction c in its first pivot takes
/// c (M₂₂ − M₁₂) / det M from the two rates of a difference, together.
#[test]
fn decay_of_a_difference_is_the_mean_of_its_links() {
    for ([upper, lower], [long, short], friction, copies) in [
        ([0.1, 0.05], [0.2, 0.15], 1e-3, 2),
        ([0.3, 0.2], [0.1, 0.4], 2e-4, 2),
        ([0.2, 0.4], [0.25, 0.1], 5e-3, 3),
    ] {
        let text = format!(
            "gravity = 9.81, trunk: rod(mass = 0.4, length = 0.3) [
                 upper: rod(mass = {upper}, length = {long}, friction = {friction}) [
                     lower: rod(mass = {lower}, length = {short})
                 ] * {copies}
             ]"
        );
        let tree = PendulumTree::parse(&text).expect("it is right");
        let first = upper * long * long / 3.0 + lower * long * long;
        let between = 0.5 * lower * long * short;
        let second = lower * short * short / 3.0;
        let lost = friction * (second - between) / (first * second - between * between);
        let growth = DifferenceGrowth::new(&tree, &tree.all_copies(), vec![1.0], 1e-9);
        let decay = growth.expect("it has copies").decay();
        assert!((decay / (0.5 * lost) - 1.0).abs() < 1e-12, "{decay} {lost}");
    }
}
