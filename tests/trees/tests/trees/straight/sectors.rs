//! Straight springs between copies in symmetric coordinates: energies of the differences, W.

use branched_pendulum::prelude::*;
use branched_pendulum::system::Workspace;
use branched_pendulum::transfer::{EnergyDefinition, Order, SectorBudget, StateInput};
use branched_pendulum::{Transfer, TransferForm};
use branched_pendulum_trees::{PendulumTree, TreeError};

use super::GUYED;

/// The apparatus of the paper, with what is between its children.
fn apparatus(clause: &str) -> String {
    format!(
        "gravity = 9.80665,
         parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
             child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
         ],
         {clause}"
    )
}

/// H_d = p_d²/(4 M) + (G + 2 κ r²) sin² θ_d.
#[test]
fn a_spring_between_two_children_stands_beside_their_weight() {
    let (stiffness, along, lateral) = (3.0, 0.06, 0.02);
    let clause = format!("siblings(child, at = ({along}, {lateral}), spring = {stiffness})");
    let tree = PendulumTree::parse(&apparatus(&clause)).unwrap();
    let symmetric = tree.symmetric().unwrap();
    let inertia = 0.516e-3 + 0.10531 * 0.043 * 0.043;
    let weight = 0.10531 * 9.80665 * 0.043;
    let fall = weight + 2.0 * stiffness * (along * along + lateral * lateral);
    for (theta_d, p_d) in [(0.7, 2e-3), (1e-3, 1e-6), (-2.0, 0.01)] {
        let given = StateInput::Momenta {
            coordinates: &[0.4, -0.3, theta_d],
            momenta: &[0.02, -0.004, p_d],
        };
        let mut energies = [[0.0; 2]; 2];
        symmetric.energies(&mut Workspace::new(), given, &mut energies);
        let expected = [p_d * p_d / (4.0 * inertia), fall * theta_d.sin().powi(2)];
        for (own, expected) in energies[1].iter().zip(expected) {
            assert!(
                (own - expected).abs() < 1e-13 * expected,
                "{own} {expected}"
            );
        }
    }
    let modes = tree.modes(&[0.0; 3]).unwrap();
    let antiphase = (fall / inertia).sqrt();
    let turns = modes.frequencies_hz.iter();
    let nearest = turns.map(|hertz| (hertz * std::f64::consts::TAU / antiphase - 1.0).abs());
    assert!(nearest.fold(f64::INFINITY, f64::min) < 1e-12);
}

/// The energy of the whole tree, with its lines, is formed of Cartesian lengths elsewhere.
#[test]
fn energies_by_parseval_are_those_of_the_whole_tree() {
    let text = "gravity = 9.81,
        a: rod(mass = 0.4, length = 0.5, spring = 0.3) [
            b: rod(mass = 0.2, length = 0.35) [c: rod(mass = 0.1, length = 0.25) * 4] * 3
        ],
        siblings(b, at = (0.3, -0.1), spring = 12), siblings(c, at = 0.2, spring = 5)";
    let tree = PendulumTree::parse(text).unwrap();
    let symmetric = tree.symmetric().unwrap();
    let number = |link: usize, factor: f64| (factor * (1 + link) as f64).sin();
    let [theta, omega] = [4.1, 1.3].map(|factor| {
        (0..16)
            .map(|link| 2.0 * number(link, factor))
            .collect::<Vec<_>>()
    });
    let mut budget = SectorBudget::new();
    let given = StateInput::Absolute {
        theta: &theta,
        omega: &omega,
    };
    let mut workspace = Workspace::new();
    symmetric.budget(
        &mut workspace,
        EnergyDefinition::Parseval,
        &[],
        given,
        &mut budget,
    );
    let whole = tree.energy_of(&theta, &omega);
    let sum: f64 = budget.energies.iter().sum();
    assert!((sum - whole).abs() < 1e-13 * whole, "{sum} {whole}");
    let hamiltonian = symmetric.hamiltonian(&mut workspace, given);
    assert!((hamiltonian - whole).abs() < 1e-13 * whole);
    let sum: f64 = budget.transfers.iter().sum();
    let size = budget
        .transfers
        .iter()
        .fold(0.0_f64, |most, w| most.max(w.abs()));
    assert!(sum.abs() < 1e-13 * size, "{sum} {size}");
}

/// An order more leaves a sixteenth where the difference is halved; nothing flows into differences
/// that are zero.
#[test]
fn orders_meet_the_exact_transfer() {
    let clause = "siblings(child, at = 0.06, spring = 3)";
    let symmetric = PendulumTree::parse(&apparatus(clause))
        .unwrap()
        .symmetric()
        .unwrap();
    let error_at = |size: f64| {
        let (coordinates, momenta) = ([0.4, 0.3, size], [0.02, -0.004, 2e-3 * size]);
        let given = StateInput::Momenta {
            coordinates: &coordinates,
            momenta: &momenta,
        };
        let mut w = [Transfer::default(); 2];
        let mut workspace = Workspace::new();
        symmetric.transfers(&mut workspace, TransferForm::Exact, given, &mut w);
        let exact = w[1].total();
        symmetric.transfers(&mut workspace, TransferForm::Amplitude(2), given, &mut w);
        (w[1].total() - exact).abs()
    };
    let ratio = error_at(0.02) / error_at(0.01);
    assert!((ratio - 16.0).abs() < 0.1, "{ratio}");

    let mut series = symmetric.expansion::<5>(&[]);
    let mut w = [Transfer::default(); 2];
    series.transfers(
        Order::Amplitude,
        4,
        [&[0.4, 0.3, 0.0], &[0.02, -0.004, 0.0]],
        &mut w,
    );
    assert_eq!(w[1].total(), 0.0);
}

#[test]
fn lines_of_other_kinds_are_refused_by_name() {
    for (clause, what) in [
        (
            "siblings(child, at = 0.06, spring = 3, rest = 0.01)",
            "siblings(child)",
        ),
        (
            "siblings(child, at = 0.06, spring = 3, friction = 0.1)",
            "siblings(child)",
        ),
        (
            "siblings(child, at = 0.06, repulsion = 1e-5, exponent = 3)",
            "siblings(child)",
        ),
        (
            "siblings(child, at = 0.06, spring = 3), guy(parent, at = 0.1, to = (1, 0), spring = 2)",
            "guy(parent)",
        ),
        (
            "between(child_1, child_2, at = each(0.06, 0.05), spring = 3)",
            "between(child_1, child_2)",
        ),
    ] {
        let refused = PendulumTree::parse(&apparatus(clause)).unwrap().symmetric();
        let Err(TreeError::StraightSpring { line }) = refused else {
            panic!("{clause}: {refused:?}")
        };
        assert!(line.contains(what), "{clause}: {line}");
    }
    // Two of three copies; all of them, one by one, are a set.
    let three = |clauses: &str| {
        let text = format!(
            "gravity = 9.81, a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 3], {clauses}"
        );
        PendulumTree::parse(&text).unwrap().symmetric()
    };
    let pair = |one: u32, other: u32| format!("between(b_{one}, b_{other}, at = 0.5, spring = 2)");
    let [first, second, third] = [pair(1, 2), pair(2, 3), pair(3, 1)];
    let refused = three(&format!("{first}, {second}")).unwrap_err();
    assert!(
        matches!(refused, TreeError::StraightSpring { .. }),
        "{refused}"
    );
    let set = three(&format!("{first}, {second}, {third}")).unwrap();
    assert_eq!(set, three("siblings(b, at = 0.5, spring = 2)").unwrap());

    let tree = PendulumTree::parse(GUYED).unwrap();
    assert!(matches!(
        tree.symmetric(),
        Err(TreeError::StraightSpring { .. })
    ));
    assert!(tree.copies().is_none());
}
