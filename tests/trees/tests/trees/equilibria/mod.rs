//! Equilibria of trees with springs, against an independent search: points in the plane, random
//! starts, and second derivatives by finite differences.

mod scene;
mod stiffness;

use std::f64::consts::{PI, TAU};

use branched_pendulum::analysis::{EquilibriumError, Stability};
use branched_pendulum::prelude::*;
use branched_pendulum_trees::PendulumTree;

use self::scene::{NAMES, Random, Scene, eigen};

/// Whole turns do not count where no spring counts them: then the energies are equal.
fn is_same(scene: &Scene, one: &[f64], other: &[f64]) -> bool {
    let apart = |(a, b): (&f64, &f64)| ((a - b) / TAU - ((a - b) / TAU).round()).abs() * TAU;
    let energies = [one, other].map(|theta| scene.energy(theta));
    one.iter().zip(other).map(apart).all(|apart| apart < 1e-4)
        && (energies[0] - energies[1]).abs() < 1e-6
}

#[test]
fn equilibria_of_random_trees_with_springs() {
    let mut random = Random(48);
    let (mut saddles, mut several, mut lowest, mut unstable_zero) = (0, 0, 0, 0);
    const TREES: usize = 100;
    for number in 0..TREES {
        let scene = Scene::random(&mut random);
        let text = scene.text();
        let tree = PendulumTree::parse(&text).unwrap_or_else(|error| panic!("{text}\n{error}"));
        let n = tree.links();
        // The tree may have another order of links.
        let order: Vec<usize> = (0..n)
            .map(|link| {
                tree.names()
                    .iter()
                    .position(|name| name == NAMES[link])
                    .unwrap()
            })
            .collect();
        let own = |theta: &[f64]| -> Vec<f64> { order.iter().map(|&place| theta[place]).collect() };
        let found = tree
            .equilibria()
            .unwrap_or_else(|error| panic!("{text}\n{error}"));
        assert_eq!(found[0].stability, Stability::Stable, "{number} {text}");
        for one in &found {
            let theta = own(&one.theta);
            let torque = scene
                .gradient(&theta)
                .iter()
                .fold(0.0_f64, |most, x| most.max(x.abs()));
            assert!(torque < 1e-7, "{number} {text} {theta:?} {torque}");
            let (values, _) = eigen(scene.hessian(&theta));
            let least = values.iter().copied().fold(f64::INFINITY, f64::min);
            let expected = if least > 0.0 {
                Stability::Stable
            } else {
                Stability::Unstable
            };
            assert_eq!(one.stability, expected, "{number} {text} {theta:?} {least}");
            assert_eq!(tree.modes(&one.theta).is_ok(), least > 0.0);
            saddles += usize::from(least < 0.0);
        }
        let stable: Vec<Vec<f64>> = found
            .iter()
            .filter(|one| one.stability == Stability::Stable)
            .map(|one| own(&one.theta))
            .collect();
        several += usize::from(stable.len() > 1);
        let mut minima: Vec<Vec<f64>> = Vec::new();
        for _ in 0..5 {
            let start = (0..n).map(|_| random.within(-PI, PI)).collect();
            minima.extend(scene.descend(start));
        }
        minima.sort_by(|a, b| scene.energy(a).total_cmp(&scene.energy(b)));
        let is_found = |one: &Vec<f64>| stable.iter().any(|other| is_same(&scene, one, other));
        assert!(
            minima.iter().any(is_found),
            "{number} {text} {stable:?} {minima:?}"
        );
        lowest += usize::from(minima.first().is_some_and(is_found));
        let zeros = vec![0.0; n];
        let at_zero = tree.equilibrium_at(&zeros, 1e-12);
        unstable_zero +=
            usize::from(at_zero.is_some_and(|own| own.stability == Stability::Unstable));
    }
    // The trees are of all kinds, and nearly always the lowest minimum is among those found.
    assert!(
        saddles > 10 && several > 10,
        "{saddles} {several} {unstable_zero}"
    );
    assert!(lowest >= TREES * 97 / 100, "{lowest}");
}

/// Trees whose rest at zero is a saddle, and where they rest then.
#[test]
fn rest_is_looked_for_below_saddles() {
    // κ θ = m g l/2 sin θ.
    let buckled = |spring: f64| {
        PendulumTree::parse(&format!(
            "gravity = -9.81, r: rod(mass = 0.4, length = 0.5, spring = {spring})"
        ))
        .unwrap()
    };
    for (spring, expected) in [(0.9, 0.71286), (0.5, 1.81316), (0.95, 0.0), (1.2, 0.0)] {
        let tree = buckled(spring);
        for start in [0.0, 0.3, 0.02, -0.3] {
            let rest = tree.stable_equilibrium(&[start]).unwrap();
            let angle = rest.theta[0];
            assert_eq!(rest.stability, Stability::Stable);
            let moment = 0.5 * 0.4 * 9.81 * 0.5;
            let torque = spring * angle - moment * angle.sin();
            assert!(torque.abs() < 1e-12, "{spring} {angle}");
            if spring < moment {
                assert!(angle.abs() > 0.3);
                assert!(start == 0.0 || angle * start > 0.0);
            } else {
                assert!(angle.abs() < 1e-9);
            }
            if spring != 0.95 && spring != 0.5 {
                assert!((angle.abs() - expected).abs() < 1e-5, "{spring} {angle}");
            }
        }
    }
    // At the onset the second derivative vanishes.
    let onset = buckled(0.5 * 0.4 * 9.81 * 0.5);
    let rest = onset.stable_equilibrium(&[0.0]).unwrap();
    assert!(rest.theta[0].abs() < 1e-2, "{rest:?}");
    // Copies that a spring pushes apart from where they meet: no torque has a direction there.
    for (count, rest) in [(2, 0.2), (2, 0.05), (3, 0.1)] {
        let tree = PendulumTree::parse(&format!(
            "gravity = 9.81, stem: rod(mass = 0.25, length = 0.28) [
                arm: rod(mass = 0.1, length = 0.25) * {count}
            ], siblings(arm, at = 0.2, spring = 50, rest = {rest})"
        ))
        .unwrap();
        let found = tree.stable_equilibrium(&vec![0.0; tree.links()]).unwrap();
        assert_eq!(found.stability, Stability::Stable);
        let alpha = tree.accelerations(0.0, &found.theta, &vec![0.0; tree.links()]);
        assert!(alpha.iter().all(|alpha| alpha.abs() < 1e-8), "{alpha:?}");
        let apart = (found.theta[1] - found.theta[2]).abs();
        assert!(apart > 0.05, "{found:?}");
    }
    // An attraction has no minimum.
    let tree = PendulumTree::parse(
        "gravity = 9.81, stem: rod(mass = 0.25, length = 0.28) [
            left: rod(mass = 0.1, length = 0.25), right: rod(mass = 0.1, length = 0.25)
        ], between(left, right, at = 0.2, repulsion = -1e-3, exponent = 3)",
    )
    .unwrap();
    let error = tree.stable_equilibrium(&[0.0, 0.1, -0.1]).unwrap_err();
    assert!(
        matches!(
            error,
            EquilibriumError::NoMinimum { .. } | EquilibriumError::NotFinite
        ),
        "{error}"
    );
    let error = tree.stable_equilibrium(&[0.0]).unwrap_err();
    assert_eq!(error, EquilibriumError::NotFinite);
}

/// Large trees are searched link by link.
#[test]
fn rest_of_many_links() {
    for (text, links) in [
        ("count = 12, branching = 2", 4095),
        ("count = 1500, branching = 1", 1500),
        ("count = 3, branching = 40", 1641),
    ] {
        let tree = PendulumTree::parse(&format!(
            "gravity = 9.81, a: generations({text}, shape = rod, mass = 0.1, length = 0.3,
                spring = 0.2, rest = 0.3)"
        ))
        .unwrap();
        assert_eq!(tree.links(), links);
        let rest = tree.stable_equilibrium(&vec![0.0; links]).unwrap();
        assert_eq!(rest.stability, Stability::Stable);
        let alpha = tree.accelerations(0.0, &rest.theta, &vec![0.0; links]);
        let most = alpha.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        assert!(most < 1e-6, "{most}");
        assert!(rest.theta.iter().any(|angle| angle.abs() > 1e-2));
    }
}

/// Whole turns of a link are the same place, unless a torsion spring distinguishes them; the energy
/// there may be zero.
#[test]
fn a_rest_is_listed_once() {
    let y = |arms: &str, springs: &str| {
        format!("gravity = 9.80665, stem: rod(mass = 0.25, length = 0.28) [{arms}], {springs}")
    };
    let unequal = "arm: rod(mass = each(0.09, 0.11), length = each(0.22, 0.25)) * 2";
    for (text, is_wound) in [
        (y(unequal, "siblings(arm, at = 0.2, spring = 2)"), false),
        (
            y(
                "arm: rod(mass = 0.1, length = 0.2) * 3",
                "siblings(arm, at = 0.15, spring = 40)",
            ),
            false,
        ),
        (
            y(
                "left: rod(mass = 0.1, length = 0.2), right: rod(mass = 0.2, length = 0.3)",
                "guy(left, at = 0.2, to = (0, -0.48), spring = 3)",
            ),
            false,
        ),
        // A torsion spring is wound up by whole turns.
        (y(unequal, "siblings(arm, spring = 1e-3)"), true),
    ] {
        let tree = PendulumTree::parse(&text).unwrap_or_else(|error| panic!("{text}\n{error}"));
        let found = tree.equilibria().unwrap();
        let found: Vec<_> = found
            .iter()
            .filter(|own| own.stability == Stability::Stable)
            .map(|own| &own.theta)
            .collect();
        assert_eq!(found.len() > 1, is_wound, "{text} {found:?}");
        let turned = found
            .iter()
            .copied()
            .flatten()
            .any(|angle| angle.abs() > 3.2);
        assert_eq!(turned, is_wound, "{text} {found:?}");
    }
}
