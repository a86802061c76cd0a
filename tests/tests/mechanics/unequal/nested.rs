//! Nested copies that differ, against bodies in numbers.

use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::oracle::cartesian::Motion;
use branched_pendulum_tests::oracle::{Link, Tree};

use crate::support::{Compiled, Worst, compile};

fn body(parent: Option<usize>, mass: f64, inertia: f64, com: [f64; 2], pivot: [f64; 2]) -> Link {
    Link {
        parent,
        mass,
        inertia,
        com,
        pivot,
        friction: 0.0,
        drag: 0.0,
        spring: 0.0,
        rest: 0.0,
        laws: Default::default(),
    }
}

const NESTED: &str = "gravity = 9.80665,
    trunk(mass = 0.3, com = 0.1, inertia = 2e-3, joint = 0.25, drag = 1e-4) [
        arm(
            mass = each(0.12, 0.13), com = (0.06, 0.01), inertia = 4e-4,
            joint = each(0.15, (0.14, 0.02)), spring = each(0.02, 0.03), rest = each(0, 0.2),
        ) [
            hand(mass = each(0.05, 0.06), com = each(0.03, (0.035, 0.01)), inertia = 5e-5,
                friction = each(0, 1e-5)) * 2
        ] * 2
    ]";

/// The tree of [`NESTED`] in numbers.
fn nested() -> Tree {
    let arm = |mass, spring, rest| Link {
        spring,
        rest,
        ..body(Some(0), mass, 4e-4, [0.06, 0.01], [0.25, 0.0])
    };
    let light = |arm, pivot| body(Some(arm), 0.05, 5e-5, [0.03, 0.0], pivot);
    let heavy = |arm, pivot| Link {
        friction: 1e-5,
        ..body(Some(arm), 0.06, 5e-5, [0.035, 0.01], pivot)
    };
    let (first, second) = ([0.15, 0.0], [0.14, 0.02]);
    Tree {
        gravity: 9.80665,
        between: Vec::new(),
        links: vec![
            Link {
                drag: 1e-4,
                ..body(None, 0.3, 2e-3, [0.1, 0.0], [0.0; 2])
            },
            arm(0.12, 0.02, 0.0),
            light(1, first),
            heavy(1, first),
            arm(0.13, 0.03, 0.2),
            light(4, second),
            heavy(4, second),
        ],
    }
}

fn agrees(compiled: &Compiled, tree: &Tree, what: &str) {
    let mut random = Random::new(3);
    let [mut accelerations, mut kinetic, mut potential] = std::array::from_fn(|_| Worst::default());
    for count in 0..200 {
        let theta = random.around_zero(tree.links.len(), 3.0);
        let omega = random.around_zero(tree.links.len(), 8.0);
        let motion = Motion::new(tree, &theta, &omega);
        let expected = motion.accelerations();
        let scale = motion.sensitivity(&expected);
        let found = compiled.evaluate("accelerations", &[&theta, &omega]);
        for link in 0..found.len() {
            let place = || format!("state {count}, link {link}");
            accelerations.note(found[link] - expected[link], scale[link], place);
        }
        let place = || format!("state {count}");
        let found = compiled.evaluate("kinetic_energy", &[&theta, &omega])[0];
        kinetic.note(found - motion.kinetic, motion.kinetic_terms, place);
        let found = compiled.evaluate("potential_energy", &[&theta])[0];
        potential.note(found - motion.potential, motion.potential_terms, place);
    }
    accelerations.assert_below(1e-12, what);
    kinetic.assert_below(1e-14, what);
    potential.assert_below(1e-14, what);
}

#[test]
fn nested_copies_agree_with_bodies() {
    let names = "trunk arm_1 hand_1_1 hand_1_2 arm_2 hand_2_1 hand_2_2";
    for (settings, what) in [
        ("", "chosen"),
        (", solve = factorization", "elimination"),
        (", solve = recursion", "recursion"),
    ] {
        let compiled = compile(&format!("{NESTED}, emit(energies){settings}"));
        let links = compiled.scene.links.iter().map(|link| link.name.as_str());
        assert_eq!(links.collect::<Vec<_>>().join(" "), names);
        agrees(&compiled, &nested(), what);
    }
}

/// Coordinates are those of equal copies; motion, momenta and energy are those in absolute
/// angles.
#[test]
fn symmetric_coordinates_of_nested_copies() {
    let compiled = compile(&format!(
        "{NESTED}, emit(energies, momenta, modes, symmetric)"
    ));
    let equal = compile(
        "gravity = 9.80665,
        trunk(mass = 0.3, com = 0.1, inertia = 2e-3, joint = 0.25) [
            arm(mass = 0.12, com = 0.06, inertia = 4e-4, joint = 0.15) [
                hand(mass = 0.05, com = 0.03, inertia = 5e-5) * 2
            ] * 2
        ], emit(symmetric)",
    );
    assert_eq!(compiled.mechanics.coordinates.len(), 7);
    for (own, equal) in (compiled.mechanics.coordinates.iter()).zip(&equal.mechanics.coordinates) {
        assert_eq!((&own.name, &own.weights), (&equal.name, &equal.weights));
    }
    let mut random = Random::new(4);
    let mut worst = Worst::default();
    for count in 0..100 {
        let theta = random.around_zero(7, 2.0);
        let omega = random.around_zero(7, 5.0);
        let transform = |values: &[f64]| compiled.evaluate("to_symmetric", &[values]);
        let (q, v) = (transform(&theta), transform(&omega));
        let alpha = transform(&compiled.evaluate("accelerations", &[&theta, &omega]));
        let found = compiled.evaluate("symmetric_accelerations", &[&q, &v]);
        let largest = alpha
            .iter()
            .fold(1.0_f64, |largest, a| largest.max(a.abs()));
        for (found, alpha) in found.iter().zip(&alpha) {
            worst.note(found - alpha, largest, || format!("state {count}"));
        }
        let p = compiled.evaluate("symmetric_momenta", &[&q, &v]);
        let energy = compiled.evaluate("kinetic_energy", &[&theta, &omega])[0]
            + compiled.evaluate("potential_energy", &[&theta])[0];
        let found = compiled.evaluate("hamiltonian", &[&q, &p])[0];
        worst.note(found - energy, energy.abs() + 1.0, || {
            format!("H, state {count}")
        });
        let back = compiled.evaluate("symmetric_velocities", &[&q, &p]);
        for (back, v) in back.iter().zip(&v) {
            worst.note(back - v, 5.0, || format!("velocities, state {count}"));
        }
    }
    worst.assert_below(1e-11, "symmetric coordinates");
}

/// Where arms are alike and hands are not, the arms' difference stays exactly zero.
#[test]
fn what_is_equal_stays_in_phase() {
    let compiled = compile(
        "gravity = 9.80665,
        trunk(mass = 0.3, com = 0.1, inertia = 2e-3, joint = 0.25) [
            arm(mass = 0.12, com = 0.06, inertia = 4e-4, joint = 0.15) [
                hand(mass = each(0.05, 0.06), com = 0.03, inertia = 5e-5) * 2
            ] * 2
        ], emit(symmetric)",
    );
    let names = (compiled.mechanics.coordinates.iter()).map(|own| own.name.as_str());
    assert_eq!(
        names.collect::<Vec<_>>(),
        [
            "trunk", "arm_m", "hand_m", "arm_d", "hand_d", "hand_1_d", "hand_2_d"
        ]
    );
    let q = [0.3, 0.5, -0.2, 0.0, 0.0, 0.4, 0.4];
    let v = [1.0, -2.0, 3.0, 0.0, 0.0, 0.5, 0.5];
    let alpha = compiled.evaluate("symmetric_accelerations", &[&q, &v]);
    assert!(
        alpha[3].abs() < 1e-12 && alpha[4].abs() < 1e-12,
        "{alpha:?}"
    );
    assert!((alpha[5] - alpha[6]).abs() < 1e-12);
    assert!(alpha[5].abs() > 1.0);
}
