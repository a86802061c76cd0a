//! Friction between copies: nonlinear in their differences, and zero where these are.

use std::f64::consts::PI;

use branched_pendulum_codegen::scene::coordinates::CoordinateKind;
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::oracle::generator::{Recipe, braked_sample};

use crate::support::{Compiled, Worst, compile};

use super::rates;

/// Flat groups of up to four copies, and nested ones of up to three.
fn samples() -> Vec<Compiled> {
    let samples = (0..8).map(|seed| {
        let nested = seed >= 4;
        let recipe = Recipe {
            links: 8,
            copies: if nested { &[2, 2, 3] } else { &[1, 2, 3, 4] },
            nested,
            requests: "energies, momenta, symmetric",
        };
        compile(&braked_sample(&recipe, 800 + seed).text)
    });
    samples.collect()
}

#[test]
fn symmetric_accelerations_are_those_of_the_links() {
    let mut worst = Worst::default();
    let mut braked = 0;
    for (number, compiled) in samples().iter().enumerate() {
        let links = compiled.scene.links.len();
        let of_copies = compiled.scene.groups.iter().flat_map(|group| &group.copies);
        braked += of_copies
            .filter(|link| !compiled.scene.links[link.0].passive.is_viscous())
            .count();
        let mut random = Random::new(number as u64);
        for state in 0..100 {
            let q = random.around_zero(links, PI);
            let v = rates(&mut random, links, state);
            let [theta, omega] = [&q, &v].map(|x| compiled.evaluate("from_symmetric", &[x]));
            let alpha = compiled.evaluate("accelerations", &[&theta, &omega]);
            let expected = compiled.evaluate("to_symmetric", &[&alpha]);
            let found = compiled.evaluate("symmetric_accelerations", &[&q, &v]);
            let scale = alpha.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
            for (found, expected) in found.iter().zip(&expected) {
                worst.note(found - expected, scale, || {
                    format!("tree {number}, state {state}")
                });
            }
        }
    }
    assert!(braked > 10, "{braked}");
    worst.assert_below(1e-11, "symmetric accelerations");
}

/// Seven copies, whose sums with Helmert's weights round; three in each of two.
const ZEROS: [&str; 2] = [
    "gravity = 9.8, trunk: rod(mass = 0.5, length = 0.4, friction(coulomb = 1e-3)) [
        twig: rod(mass = 0.1, length = 0.3, friction(coulomb = 2e-3, quadratic = 3e-4),
            drag(quadratic = 2e-4)) * 7
    ], emit(symmetric)",
    "gravity = 9.8, trunk: rod(mass = 0.5, length = 0.4, friction(coulomb = 1e-3)) [
        arm: rod(mass = 0.1, length = 0.3, friction(coulomb = 2e-3, quadratic = 3e-4)) [
            hand: rod(mass = 0.04, length = 0.1, friction(coulomb = 1e-4, width = 0.3),
                drag(quadratic = 2e-5)) * 3
        ] * 2
    ], emit(symmetric)",
];

fn differences(compiled: &Compiled) -> Vec<usize> {
    let coordinates = compiled.mechanics.coordinates.iter().enumerate();
    let is_difference = |kind: &CoordinateKind| matches!(kind, CoordinateKind::Difference { .. });
    coordinates
        .filter(|(_, coordinate)| is_difference(&coordinate.kind))
        .map(|(index, _)| index)
        .collect()
}

#[test]
fn differences_of_zero_stay_zero() {
    for text in ZEROS {
        let compiled = compile(text);
        let links = compiled.scene.links.len();
        let differences = differences(&compiled);
        let mut random = Random::new(5);
        for state in 0..200 {
            let (mut q, mut v) = (
                random.around_zero(links, PI),
                rates(&mut random, links, state),
            );
            for &index in &differences {
                (q[index], v[index]) = (0.0, 0.0);
            }
            let found = compiled.evaluate("symmetric_accelerations", &[&q, &v]);
            assert!(
                differences.iter().all(|&index| found[index] == 0.0),
                "{found:?}"
            );
        }
    }
}

/// Differences of 10⁻¹³ are accelerated as a thousandth of those of 10⁻¹⁰ are, to the
/// digits that linearity leaves: nothing of the size of the torques themselves comes in.
#[test]
fn small_differences_keep_their_digits() {
    let mut worst = Worst::default();
    for text in ZEROS {
        let compiled = compile(text);
        let links = compiled.scene.links.len();
        let differences = differences(&compiled);
        let mut random = Random::new(6);
        for state in 0..100 {
            let q = random.around_zero(links, 1.0);
            let v = rates(&mut random, links, 2 * state);
            let accelerations = |size: f64| {
                let scaled = |x: &[f64]| -> Vec<f64> {
                    let small = |(index, x): (usize, &f64)| match differences.contains(&index) {
                        true => x * size,
                        false => *x,
                    };
                    x.iter().enumerate().map(small).collect()
                };
                compiled.evaluate("symmetric_accelerations", &[&scaled(&q), &scaled(&v)])
            };
            let (large, small) = (accelerations(1e-10), accelerations(1e-13));
            let scale = differences
                .iter()
                .fold(0.0_f64, |most, &index| most.max(large[index].abs()));
            for &index in &differences {
                let error = large[index] - 1e3 * small[index];
                worst.note(error, scale, || format!("state {state}, {index}"));
            }
        }
    }
    worst.assert_below(1e-7, "small differences");
}

/// A tree whose copies differ, against its absolute angles.
#[test]
fn unequal_copies() {
    let compiled = compile(
        "gravity = 9.8, trunk: rod(mass = 0.5, length = 0.4) [
            twig: rod(mass = each(0.1, 0.11), length = 0.3,
                friction(coulomb = each(2e-3, 3e-3), quadratic = each(0, 3e-4), width = 0.1),
                drag(quadratic = each(2e-4, 1e-4))) * 2
        ], emit(symmetric)",
    );
    let mut worst = Worst::default();
    let mut random = Random::new(7);
    for state in 0..100 {
        let q = random.around_zero(3, PI);
        let v = rates(&mut random, 3, state);
        let [theta, omega] = [&q, &v].map(|x| compiled.evaluate("from_symmetric", &[x]));
        let alpha = compiled.evaluate("accelerations", &[&theta, &omega]);
        let expected = compiled.evaluate("to_symmetric", &[&alpha]);
        let found = compiled.evaluate("symmetric_accelerations", &[&q, &v]);
        let scale = alpha.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
        for (found, expected) in found.iter().zip(&expected) {
            worst.note(found - expected, scale, || format!("state {state}"));
        }
    }
    worst.assert_below(1e-12, "unequal copies");
}
