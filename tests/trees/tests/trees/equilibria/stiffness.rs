//! Second derivatives of the potential energy, and equilibria of trees whose springs all differ.

use branched_pendulum::prelude::*;
use branched_pendulum_trees::PendulumTree;

use super::scene::{NAMES, Random, Scene};

/// Asserts that the stiffness matrix has these entries, to a part of them and of one.
fn assert_stiffness(text: &str, found: &[Vec<f64>], expected: impl Fn(usize, usize) -> f64) {
    for (a, row) in found.iter().enumerate() {
        for (b, &found) in row.iter().enumerate() {
            let expected = expected(a, b);
            let error = (found - expected).abs();
            assert!(
                error < 2e-6 * (1.0 + expected.abs()),
                "{text}: {a} {b}: {found} {expected}"
            );
        }
    }
}

/// Of trees with springs in pivots, between angles and between points: the energy is that of points
/// in the plane.
#[test]
fn stiffness_is_the_second_derivative_of_the_energy_of_points() {
    let mut random = Random(48);
    for _ in 0..24 {
        let scene = Scene::random(&mut random);
        let text = scene.text();
        let tree = PendulumTree::parse(&text).unwrap();
        let names: Vec<&str> = tree.names().iter().map(String::as_str).collect();
        let place = |name: &str| NAMES.iter().position(|own| *own == name).unwrap();
        let order: Vec<usize> = names.into_iter().map(place).collect();
        let links = order.len();
        let theta: Vec<f64> = (0..links).map(|_| random.within(-1.5, 1.5)).collect();
        let mut of_scene = vec![0.0; links];
        for (link, &own) in order.iter().enumerate() {
            of_scene[own] = theta[link];
        }
        let expected = scene.hessian(&of_scene);
        let stiffness = tree.stiffness_matrix(&theta);
        assert_stiffness(&text, &stiffness, |a, b| expected[order[a]][order[b]]);
    }
}

/// Lines to a fixed point, lines between copies, repulsions, and inverted trees: second
/// differences of the tree's own energy.
#[test]
fn stiffness_of_lines_is_the_second_difference_of_the_energy() {
    const TREES: [&str; 4] = [
        "gravity = 9.81, a: rod(mass = 0.3, length = 0.2, spring = 0.7, rest = 0.4) [
            b: rod(mass = 0.2, length = 0.3) [c: rod(mass = 0.1, length = 0.25, spring = 1.1, rest = -0.8)]
        ], guy(c, at = 0.05, to = (0.3, 0.2), spring = 8, rest = 0.1)",
        "gravity = -9.81, stem: rod(mass = 0.3, length = 0.2, spring = 4) [
            arm: rod(mass = 0.2, length = 0.3, spring = 2, rest = 0.3) * 3
        ], siblings(arm, at = 0.2, spring = 6, rest = 0.05), siblings(arm, spring = 0.3)",
        "gravity = 9.81, a: rod(mass = 0.1, length = 0.2) [b: rod(mass = 0.1, length = 0.2) * 2],
            guy(a, at = 0.2, to = (0.3, 0), spring = 3, rest = 0.1),
            between(a, b_1, at = 0.1, repulsion = 1e-4, exponent = 3)",
        "gravity = 0, a: rod(mass = 0.1, length = 0.4) [
            b: rod(mass = 0.1, length = 0.2), c: rod(mass = 0.1, length = 0.2)
        ], between(b, c, spring = 1.3, rest = 0.4),
            guy(b, at = 0.15, to = (-0.2, 0.1), repulsion = 2e-3, exponent = 1)",
    ];
    let mut random = Random(7);
    for text in TREES {
        let tree = PendulumTree::parse(text).unwrap_or_else(|error| panic!("{text}\n{error}"));
        let links = tree.links();
        let theta: Vec<f64> = (0..links).map(|_| random.within(-1.5, 1.5)).collect();
        let stiffness = tree.stiffness_matrix(&theta);
        let step = 1e-4;
        assert_stiffness(text, &stiffness, |a, b| {
            let moved = |by_a: f64, by_b: f64| {
                let mut moved = theta.clone();
                moved[a] += by_a * step;
                moved[b] += by_b * step;
                tree.potential_energy_of(&moved)
            };
            let difference =
                moved(1.0, 1.0) - moved(1.0, -1.0) - moved(-1.0, 1.0) + moved(-1.0, -1.0);
            difference / (4.0 * step * step)
        });
    }
}

#[test]
fn trees_stay_where_they_rest() {
    let mut random = Random(9);
    let mut elsewhere = 0;
    for _ in 0..40 {
        let scene = Scene::random(&mut random);
        let text = scene.text();
        let tree = PendulumTree::<f64>::parse(&text).unwrap();
        let links = tree.links();
        let rest = tree
            .stable_equilibrium(&vec![0.0; links])
            .unwrap_or_else(|error| panic!("{text}\n{error}"));
        let alpha = tree.accelerations(0.0, &rest.theta, &vec![0.0; links]);
        let largest = alpha.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        assert!(largest < 1e-7, "{text}: {alpha:?}");
        elsewhere += usize::from(rest.theta.iter().any(|angle| angle.abs() > 1e-3));
    }
    assert!(elsewhere >= 35, "{elsewhere}");
    // Angles of another number than there are links have no equilibrium.
    let tree = PendulumTree::parse("gravity = 9.81, rod: rod(mass = 1, length = 1)").unwrap();
    assert!(tree.stable_equilibrium(&[]).is_err());
    assert!(tree.stable_equilibrium(&[0.0, 0.0]).is_err());
    assert!(tree.stiffness_matrix(&[0.0, 0.0])[0][0].is_nan());
}

/// Each step takes time in proportion to the links: with all entries of the stiffness matrix this would
/// need 34 GB.
#[test]
fn the_largest_trees_come_to_rest() {
    for spring in ["", ", spring = 1e-3, rest = 0.1"] {
        let tree = PendulumTree::parse(&format!(
            "gravity = 9.81, a: generations(count = 16, branching = 2, shape = rod, mass = 0.1,
                 length = 0.3, mass_ratio = 0.5, length_ratio = 0.8{spring})"
        ))
        .unwrap();
        let links = tree.names().len();
        assert_eq!(links, 65_535);
        let theta = tree.stable_equilibrium(&vec![0.0; links]).unwrap().theta;
        assert_eq!(theta.iter().all(|angle| *angle == 0.0), spring.is_empty());
        let alpha = tree.accelerations(0.0, &theta, &vec![0.0; links]);
        let largest = alpha.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        assert!(largest < 1e-6, "{largest}");
    }
}
