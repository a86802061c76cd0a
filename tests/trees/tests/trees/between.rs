//! Springs and friction between links that are not parent and child.

use branched_pendulum::analysis::variational::Copies;
use branched_pendulum::prelude::*;
use branched_pendulum::sectors::{Normalisation, Sectors};
use branched_pendulum::system::Workspace;
use branched_pendulum::transfer::StateInput;
use branched_pendulum::{Transfer, TransferForm};
use branched_pendulum_trees::{PendulumTree, TreeError};

use super::balance::{self, END};
use super::plain::{Numbers, PlainTree};

/// The order of links of a plain tree in the described one.
fn order(tree: &PendulumTree) -> Vec<usize> {
    let names = tree.names().iter();
    names.map(|name| name[1..].parse().unwrap()).collect()
}

#[test]
fn accelerations_are_those_of_a_dense_solve() {
    let mut numbers = Numbers(7);
    for _ in 0..100 {
        let plain = PlainTree::random(&mut numbers);
        let tree = PendulumTree::parse(&plain.text()).unwrap();
        let order = order(&tree);
        let links = order.len();
        let state = |numbers: &mut Numbers, range: f64| -> Vec<f64> {
            (0..links).map(|_| numbers.between(-range, range)).collect()
        };
        let (theta, omega) = (state(&mut numbers, 3.0), state(&mut numbers, 6.0));
        let expected = plain.accelerations(&theta, &omega);
        let own = |values: &[f64]| -> Vec<f64> { order.iter().map(|link| values[*link]).collect() };
        let found = tree.accelerations(0.0, &own(&theta), &own(&omega));
        let size = expected
            .iter()
            .fold(1.0, |size: f64, alpha| size.max(alpha.abs()));
        for (found, expected) in found.iter().zip(own(&expected)) {
            let apart = (found - expected).abs();
            assert!(apart < 1e-9 * size, "{found} {expected}: {}", plain.text());
        }
    }
}

/// The paper's tree with a spring between its children: θ_d has the stiffness 2 G_2 + 4 κ and the
/// mass 2 M_2, and in phase nothing is changed.
#[test]
fn a_spring_between_siblings_stiffens_their_difference_alone() {
    let paper = "gravity = 9.80665,
        parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
            child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
        ]";
    let stiffness: f64 = 0.02;
    let free = PendulumTree::parse(paper).unwrap();
    let coupled = format!("{paper}, siblings(child, spring = {stiffness})");
    let coupled = PendulumTree::parse(&coupled).unwrap();
    let own = PendulumTree::parse(&format!(
        "{paper}, between(child_1, child_2, spring = {stiffness})"
    ));
    assert_eq!(
        own.unwrap().modes(&[0.0; 3]).unwrap(),
        coupled.modes(&[0.0; 3]).unwrap()
    );
    let [gravity, inertia] = [
        0.10531 * 9.80665 * 0.043,
        0.516e-3 + 0.10531 * 0.043 * 0.043,
    ];
    let antiphase = ((gravity + 2.0 * stiffness) / inertia).sqrt() / std::f64::consts::TAU;
    let modes = coupled.modes(&[0.0; 3]).unwrap();
    let nearest = |modes: &[f64], wanted: f64| {
        modes.iter().fold(f64::INFINITY, |least: f64, own| {
            least.min((own - wanted).abs())
        })
    };
    assert!(nearest(&modes.frequencies_hz, antiphase) < 1e-12);
    for frequency in &free.modes(&[0.0; 3]).unwrap().frequencies_hz[..] {
        let is_antiphase =
            (frequency - (gravity / inertia).sqrt() / std::f64::consts::TAU).abs() < 1e-9;
        assert!(is_antiphase || nearest(&modes.frequencies_hz, *frequency) < 1e-12);
    }
    // The bits of a motion in phase.
    let ([theta, omega], time) = ([[0.8, 0.3, 0.3], [-1.0, 2.0, 2.0]], 0.0);
    let braked = format!("{paper}, siblings(child, spring = 0.3, friction(coulomb = 0.1))");
    let braked = PendulumTree::parse(&braked).unwrap();
    assert_eq!(
        braked.accelerations(time, &theta, &omega),
        free.accelerations(time, &theta, &omega)
    );
}

/// Springs alone keep the energy in every form of the equations, and friction takes what its
/// power says: the loss is integrated beside the motion.
#[test]
fn energy_is_balanced_in_every_form() {
    let text = "gravity = 9.81,
        a: rod(mass = 0.4, length = 0.5) [
            b: rod(mass = 0.2, length = 0.35) [c: rod(mass = 0.1, length = 0.25) * 2] * 2
        ],
        siblings(b, spring = 0.4), siblings(c, spring = 0.2), between(a, c_2_1, spring = 0.3, rest = 0.4)";
    let tree = PendulumTree::parse(text).unwrap();
    let start = balance::state(&tree, 3, 2.0);
    balance::assert_energy_is_kept(&tree, &start);
    let taylor = Taylor::new(Options::with_tolerance(1e-14));
    let end = taylor.run(&AbsoluteAngles(&tree), &start, END);
    balance::assert_same_energy(&tree, &start, &end.unwrap().state);
    let (links, plain) = (tree.links(), Normalisation::Plain);
    let mut coordinates = start.clone();
    let absolute = start.values.chunks(links);
    for (own, absolute) in coordinates.values.chunks_mut(links).zip(absolute) {
        tree.symmetric_from_absolute(plain, absolute, own);
    }
    let end = balance::method().run(&SymmetricCoordinates(&tree), &coordinates, END);
    let mut moved = start.clone();
    let end = end.unwrap().state.values;
    for (own, coordinates) in moved.values.chunks_mut(links).zip(end.chunks(links)) {
        tree.absolute_from_symmetric(plain, coordinates, own);
    }
    balance::assert_same_energy(&tree, &start, &moved);
    // What friction takes.
    let braked = text.replace(
        "rest = 0.4)",
        "rest = 0.4, friction(viscous = 1e-3, coulomb = 0.02, static = 0.03, stribeck = 1.1, width = 0.3))",
    );
    balance::assert_friction_takes(&PendulumTree::parse(&braked).unwrap(), &start, 0.01);
}

/// In the binary tree of three generations every order of W closes on the exact one, and a
/// spring that couples sectors is refused.
#[test]
fn transfers_know_springs_between_siblings() {
    let text = "gravity = 9.81,
        a: rod(mass = 0.4, length = 0.5) [b: rod(mass = 0.2, length = 0.35) * 2],
        siblings(b, spring = 0.4)";
    let tree = PendulumTree::parse(text).unwrap();
    let symmetric = tree.symmetric().unwrap();
    let mut workspace = Workspace::new();
    let mut errors = Vec::new();
    for size in [0.02, 0.01] {
        let (coordinates, momenta) = ([0.9, 0.4, size], [0.03, 0.01, 0.01 * size]);
        let given = StateInput::Momenta {
            coordinates: &coordinates,
            momenta: &momenta,
        };
        let mut w = [Transfer::default(); 2];
        let mut into = |form| {
            symmetric.transfers(&mut workspace, form, given, &mut w);
            w[1].total()
        };
        let exact = into(TransferForm::Exact);
        errors.push(((into(TransferForm::Amplitude(2)) - exact) / exact).abs());
        assert!(exact.abs() > 1e-9);
    }
    // The next order is the fourth: four times less at half the size.
    assert!((errors[0] / errors[1] - 4.0).abs() < 0.05, "{errors:?}");

    let crossed = text.replace("siblings(b,", "between(a, b_1,");
    let crossed = PendulumTree::parse(&crossed).unwrap();
    assert_eq!(crossed.symmetric().unwrap_err(), TreeError::CoupledSectors);
    assert!(crossed.copies().is_none());
    let damped = text.replace(
        "siblings(b, spring = 0.4)",
        "between(a, b_1, friction = 1e-3)",
    );
    assert!(PendulumTree::parse(&damped).unwrap().symmetric().is_ok());
}

/// Springs between links of one sector, and equal ones in all copies, couple no sectors: the
/// energies of the sectors change by W.
#[test]
fn springs_within_sectors_have_energies_there() {
    let links = "gravity = 9.81, a: rod(mass = 0.4, length = 0.5) [
        b: rod(mass = 0.3, length = 0.4) [c: rod(mass = 0.2, length = 0.3) [
            d: rod(mass = 0.1, length = 0.2)]] * 2]";
    let equal = "between(b_1, d_1, spring = 0.7), between(b_2, d_2, spring = 0.7)";
    let unequal = equal.replace("d_2, spring = 0.7", "d_2, spring = 0.6");
    let at_rest_apart = equal.replace("d_2, spring = 0.7", "d_2, spring = 0.7, rest = 0.1");
    for clauses in [&unequal, &at_rest_apart] {
        let tree = PendulumTree::parse(&format!("{links}, {clauses}")).unwrap();
        assert_eq!(
            tree.symmetric().unwrap_err(),
            TreeError::CoupledSectors,
            "{clauses}"
        );
    }
    let tree = PendulumTree::parse(&format!("{links}, {equal}")).unwrap();
    let symmetric = tree.symmetric().unwrap();
    let n = tree.links();
    let start = State::at_rest(0.0, &[0.9, 0.7, 0.5, 0.3, 0.6, 0.4, -0.2]);
    let method = Dop853::new(Options::with_tolerance(1e-13));
    let system = AbsoluteAngles(&tree);
    let mut workspace = Workspace::new();
    let mut at = |time: f64| {
        let state = method.run(&system, &start, time).unwrap();
        let (theta, omega) = state.state.values.split_at(n);
        let given = StateInput::Absolute { theta, omega };
        let mut energies = vec![[0.0; 2]; symmetric.sectors().len()];
        symmetric.energies(&mut workspace, given, &mut energies);
        let mut w = vec![Transfer::default(); energies.len()];
        symmetric.transfers(&mut workspace, TransferForm::Exact, given, &mut w);
        (energies[1].iter().sum::<f64>(), w[1].total())
    };
    // The central difference of fourth order.
    let h = 2e-4;
    for time in [0.3, 0.6, 0.9] {
        let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|step| at(time + step * h).0);
        let rate = (8.0 * (c - b) - (d - a)) / (12.0 * h);
        let (_, w) = at(time);
        assert!(w.abs() > 1e-3 && (rate - w).abs() < 1e-7, "{rate} {w}");
    }
}

/// A damper on one of two copies, which does nothing at rest, takes them out of phase.
#[test]
fn copies_that_one_damper_brakes_do_not_move_alike() {
    let tree = "gravity = 9.81, a: rod(mass = 0.4, length = 0.5) [b: rod(mass = 0.2, length = 0.35, F) * 2]";
    let start = State::at_rest(0.0, &[0.9, 0.4, 0.4]);
    let copies = Copies::of_links(&[None, Some(0), Some(0)], &[&[1, 2]]).unwrap();
    for (friction, clause, are_alike) in [
        ("friction = 1e-3", "", true),
        (
            "friction = 1e-3",
            ", siblings(b, spring = 0.1, friction = 1e-3)",
            true,
        ),
        (
            "friction = 1e-3",
            ", between(a, b_1, friction = 1e-3)",
            false,
        ),
        ("friction = each(1e-3, 2e-3)", "", false),
    ] {
        let text = format!("{}{clause}", tree.replace('F', friction));
        let tree = PendulumTree::parse(&text).unwrap();
        let found = copies.are_in_phase(&AbsoluteAngles(&tree), &start);
        assert_eq!(found, are_alike, "{text}");
    }
}

#[test]
fn clauses_that_say_nothing_are_refused() {
    let tree = "gravity = 9.81, a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2]";
    for (clause, message) in [
        ("between(a, b_1)", "neither spring nor friction"),
        ("between(a, a, spring = 1)", "does not name two links"),
        ("between(a, c, spring = 1)", "no link is called `c`"),
        (
            "between(a, b_1, spring = -1)",
            "spring of `between(a, b_1)`",
        ),
        ("between(a, b_1, rest = 1)", "rest angle, but no spring"),
        (
            "between(a, b_1, mass = 1)",
            "`between` has no property `mass`",
        ),
        ("siblings(a, spring = 1)", "`a` has no copies"),
        (
            "siblings(b, spring = 1, rest = 1)",
            "`siblings` has no property `rest`",
        ),
        ("siblings(b, b, spring = 1)", "does not name one node"),
        (
            "between(a, b_1, spring = each(1, 2))",
            "there are no copies",
        ),
        (
            "between(a, b, spring = 1), in_phase(b)",
            "a link in phase represents several",
        ),
    ] {
        let found = PendulumTree::parse(&format!("{tree}, {clause}"))
            .unwrap_err()
            .to_string();
        assert!(found.contains(message), "{clause}: {found}");
    }
}
