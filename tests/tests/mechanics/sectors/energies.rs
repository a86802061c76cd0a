//! Energies of sectors.

use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::oracle::Tree;
use branched_pendulum_tests::oracle::cartesian::Motion;
use branched_pendulum_tests::oracle::generator::{Recipe, Sample, sample};
use std::sync::LazyLock;

use super::oracle::{Basis, DEFINITIONS, energies};
use crate::support::{Compiled, Worst, compile};

/// A random tree with nested symmetry, and all its budgets.
pub(crate) struct Budgeted {
    pub(crate) tree: Tree,
    pub(crate) compiled: Compiled,
    pub(crate) basis: Basis,
}

pub(crate) static SAMPLES: LazyLock<Vec<Budgeted>> = LazyLock::new(|| {
    (0..10)
        .map(|seed| {
            let recipe = Recipe {
                links: 7 + seed as usize % 4,
                copies: if seed % 2 == 0 { &[2] } else { &[1, 2, 3, 4] },
                nested: true,
                requests: "energies, symmetric, \
                           budget(canonical, parseval, velocity, rest, matrix)",
            };
            let Sample { text, tree } = sample(&recipe, 8_000 + seed);
            let compiled = compile(&text);
            let basis = Basis::new(&compiled);
            Budgeted {
                tree,
                compiled,
                basis,
            }
        })
        .collect()
});

/// Random states of a tree: angles and angular velocities.
pub(crate) fn states(links: usize, count: usize, seed: u64) -> Vec<[Vec<f64>; 2]> {
    let mut random = Random::new(seed);
    (0..count)
        .map(|_| {
            [
                random.around_zero(links, 3.0),
                random.around_zero(links, 5.0),
            ]
        })
        .collect()
}

#[test]
fn the_samples_are_rich() {
    let nested = |sample: &&Budgeted| {
        let sectors = sample.compiled.mechanics.sectors.as_ref();
        let mut sectors = sectors.iter().flat_map(|sectors| &sectors.sectors);
        sectors.any(|sector| sector.difference.is_some() && sector.coordinates.len() > 1)
    };
    assert!(SAMPLES.iter().filter(nested).count() >= 4);
    let links = SAMPLES.iter().flat_map(|sample| &sample.tree.links);
    assert!(links.clone().any(|link| link.spring > 0.0));
    assert!(links.clone().any(|link| link.rest != 0.0));
    assert!(links.clone().any(|link| link.com[1] != 0.0));
    assert!(links.clone().any(|link| link.friction > 0.0));
}

#[test]
fn energies_agree_with_dense_matrices() {
    let mut worst = Worst::default();
    for (number, sample) in SAMPLES.iter().enumerate() {
        let count = sample.basis.sectors.len();
        for [theta, omega] in states(sample.tree.links.len(), 10, number as u64) {
            for (definition, entry) in DEFINITIONS {
                let expected = energies(&sample.tree, &sample.basis, definition, &theta, &omega);
                let got = sample.compiled.evaluate(entry, &[&theta, &omega]);
                let scale: f64 = expected.iter().map(|energy| energy.abs()).sum();
                for (expected, got) in expected.iter().zip(&got[..count]) {
                    worst.note(got - expected, scale, || {
                        format!("{entry} of tree {number}")
                    });
                }
            }
        }
    }
    worst.assert_below(1e-13, "sector energies");
}

#[test]
fn energies_by_parseval_sum_to_the_energy() {
    let mut worst = Worst::default();
    for (number, sample) in SAMPLES.iter().enumerate() {
        let count = sample.basis.sectors.len();
        for [theta, omega] in states(sample.tree.links.len(), 20, 50 + number as u64) {
            let motion = Motion::new(&sample.tree, &theta, &omega);
            let got = sample
                .compiled
                .evaluate("budget_parseval", &[&theta, &omega]);
            let sum: f64 = got[..count].iter().sum();
            worst.note(
                sum - motion.kinetic - motion.potential,
                motion.kinetic_terms + motion.potential_terms,
                || format!("tree {number}"),
            );
        }
    }
    worst.assert_below(1e-14, "sum of the sectors' energies");
}

/// From symmetric coordinates the same numbers come out.
#[test]
fn budgets_from_symmetric_coordinates_are_the_same() {
    let mut worst = Worst::default();
    for (number, sample) in SAMPLES.iter().enumerate() {
        for [theta, omega] in states(sample.tree.links.len(), 5, 90 + number as u64) {
            let q = sample.compiled.evaluate("to_symmetric", &[&theta]);
            let v = sample.compiled.evaluate("to_symmetric", &[&omega]);
            for (_, entry) in DEFINITIONS {
                let expected = sample.compiled.evaluate(entry, &[&theta, &omega]);
                let entry = format!("symmetric_{entry}");
                let got = sample.compiled.evaluate(&entry, &[&q, &v]);
                let scale = expected.iter().fold(0.0_f64, |most, e| most.max(e.abs()));
                for (expected, got) in expected.iter().zip(&got) {
                    worst.note(got - expected, scale, || {
                        format!("{entry} of tree {number}")
                    });
                }
            }
        }
    }
    worst.assert_below(1e-12, "budgets from symmetric coordinates");
}

/// A whole turn of one link changes no potential energy.
#[test]
fn the_potential_has_the_period_of_every_angle() {
    let compiled = compile(
        "gravity = 9.8, arm: generations(count = 3, branching = 2, shape = rod, mass = 0.12, \
         length = 0.3, mass_ratio = 0.5, length_ratio = 0.7), emit(budget(parseval))",
    );
    let still = [0.0; 7];
    let mut worst = Worst::default();
    for [theta, _] in states(7, 20, 5) {
        let before = compiled.evaluate("budget_parseval", &[&theta, &still]);
        let scale: f64 = before[..4].iter().sum();
        for link in 0..7 {
            let mut turned = theta.clone();
            turned[link] += std::f64::consts::TAU;
            let after = compiled.evaluate("budget_parseval", &[&turned, &still]);
            for (before, after) in before[..4].iter().zip(&after[..4]) {
                worst.note(after - before, scale, || format!("link {link}"));
            }
        }
    }
    worst.assert_below(1e-14, "energies after a whole turn");
}

/// Copies that move alike to the last bit leave every difference empty.
#[test]
fn in_phase_motion_feeds_no_other_sector() {
    for sample in SAMPLES.iter() {
        let n = sample.tree.links.len();
        let count = sample.basis.sectors.len();
        let mut random = Random::new(3);
        let mut by_orbit = [vec![0.0; n], vec![0.0; n]];
        for orbit in &sample.compiled.scene.orbits {
            for values in &mut by_orbit {
                let value = random.between(-2.0, 2.0);
                for link in &orbit.links {
                    values[link.0] = value;
                }
            }
        }
        let [theta, omega] = by_orbit;
        for (_, entry) in DEFINITIONS {
            let budget = sample.compiled.evaluate(entry, &[&theta, &omega]);
            for part in budget.chunks(count) {
                assert!(
                    part[1..].iter().all(|value| *value == 0.0),
                    "{entry}: {part:?}"
                );
            }
            assert!(budget[0] != 0.0);
        }
    }
}
