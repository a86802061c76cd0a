//! Coulomb, Stribeck and quadratic friction and drag, against the Cartesian derivation, differences
//! of the energy, and laws written out by hand.

mod motion;
mod symmetric;

use std::f64::consts::PI;
use std::sync::LazyLock;

use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::oracle::cartesian::Motion;
use branched_pendulum_tests::oracle::constrained;
use branched_pendulum_tests::oracle::generator::{Recipe, Sample, braked_sample};
use nalgebra::DVector;

use crate::support::{Compiled, Worst, compile};

const STATES: usize = 200;

/// Random trees of 3 to 10 links, by either solve.
static SAMPLES: LazyLock<Vec<(Sample, [Compiled; 2])>> = LazyLock::new(|| {
    (0..10)
        .map(|seed| {
            let recipe = Recipe {
                links: 3 + seed as usize % 8,
                copies: &[1, 1, 2, 3],
                nested: true,
                requests: "energies, momenta, forces",
            };
            let sample = braked_sample(&recipe, 700 + seed);
            let solves = ["factorization", "recursion"];
            let compiled =
                solves.map(|solve| compile(&format!("solve = {solve}, {}", sample.text)));
            (sample, compiled)
        })
        .collect()
});

/// Rates of all sizes: within widths, between them, and far beyond.
fn rates(random: &mut Random, links: usize, state: usize) -> Vec<f64> {
    random.around_zero(links, [10.0, 1.0, 0.1, 1e-3][state % 4])
}

#[test]
fn the_samples_are_rich() {
    let links = || SAMPLES.iter().flat_map(|(sample, _)| &sample.tree.links);
    let total = links().count() as f64;
    let share = |has: fn(&&branched_pendulum_tests::oracle::Link) -> bool| {
        links().filter(has).count() as f64 / total
    };
    assert!(share(|link| link.laws[0].coulomb > 0.0) > 0.2);
    assert!(share(|link| link.laws[0].excess > 0.0) > 0.1);
    assert!(share(|link| link.laws[0].quadratic > 0.0) > 0.2);
    assert!(share(|link| link.laws[1].quadratic > 0.0) > 0.2);
    assert!(share(|link| link.laws[0].coulomb > 0.0 && link.laws[0].quadratic > 0.0) > 0.1);
}

#[test]
fn accelerations_agree_with_cartesian_jacobians() {
    let mut worst = Worst::default();
    for (number, (sample, solves)) in SAMPLES.iter().enumerate() {
        let links = sample.tree.links.len();
        let mut random = Random::new(100 + number as u64);
        for state in 0..STATES {
            let theta = random.around_zero(links, PI);
            let omega = rates(&mut random, links, state);
            let motion = Motion::new(&sample.tree, &theta, &omega);
            let expected = motion.accelerations();
            let sensitivity = motion.sensitivity(&expected);
            for (solve, compiled) in solves.iter().enumerate() {
                let found = compiled.evaluate("accelerations", &[&theta, &omega]);
                for link in 0..links {
                    worst.note(found[link] - expected[link], sensitivity[link], || {
                        format!("tree {number}, solve {solve}, state {state}, link {link}")
                    });
                }
            }
        }
    }
    worst.assert_below(1e-12, "accelerations");
}

#[test]
fn accelerations_agree_with_constraint_forces() {
    let mut worst = Worst::default();
    for (number, (sample, [compiled, _])) in SAMPLES.iter().enumerate() {
        let links = sample.tree.links.len();
        let mut random = Random::new(200 + number as u64);
        for state in 0..20 {
            let theta = random.around_zero(links, PI);
            let omega = rates(&mut random, links, state);
            let expected = constrained::accelerations(&sample.tree, &theta, &omega);
            let motion = Motion::new(&sample.tree, &theta, &omega);
            let sensitivity = motion.sensitivity(&DVector::from_column_slice(&expected));
            let found = compiled.evaluate("accelerations", &[&theta, &omega]);
            for link in 0..links {
                worst.note(found[link] - expected[link], sensitivity[link], || {
                    format!("tree {number}, state {state}, link {link}")
                });
            }
        }
    }
    worst.assert_below(1e-12, "accelerations");
}

/// The rate of the energy, by differences along the motion, is the power of friction, which
/// is never positive.
#[test]
fn the_power_is_the_rate_of_the_energy() {
    let mut worst = Worst::default();
    for (number, (sample, [compiled, _])) in SAMPLES.iter().enumerate() {
        let links = sample.tree.links.len();
        let mut random = Random::new(300 + number as u64);
        for state in 0..50 {
            let theta = random.around_zero(links, PI);
            let omega = rates(&mut random, links, 2 * state);
            let alpha = compiled.evaluate("accelerations", &[&theta, &omega]);
            let power = compiled.evaluate("friction_power", &[&omega])[0];
            assert!(power <= 0.0, "tree {number}, state {state}: {power}");
            let largest = alpha
                .iter()
                .fold(1.0_f64, |most, alpha| most.max(alpha.abs()));
            let energy = |h: f64| {
                let moved = |state: &[f64], rates: &[f64]| -> Vec<f64> {
                    state
                        .iter()
                        .zip(rates)
                        .map(|(x, rate)| x + h * rate)
                        .collect()
                };
                let motion =
                    Motion::new(&sample.tree, &moved(&theta, &omega), &moved(&omega, &alpha));
                motion.kinetic + motion.potential
            };
            let h = 1e-3 / largest;
            let slope = (8.0 * (energy(h) - energy(-h)) - (energy(2.0 * h) - energy(-2.0 * h)))
                / (12.0 * h);
            let motion = Motion::new(&sample.tree, &theta, &omega);
            let scale = (motion.kinetic_terms + motion.potential_terms) * largest;
            worst.note(slope - power, scale, || {
                format!("tree {number}, state {state}")
            });
        }
    }
    worst.assert_below(1e-9, "power");
}

/// Hamilton's equations: the rates of the momenta are those along the motion.
#[test]
fn canonical_rates_are_those_of_the_motion() {
    let mut worst = Worst::default();
    for (number, (sample, [compiled, _])) in SAMPLES.iter().enumerate() {
        let links = sample.tree.links.len();
        let mut random = Random::new(400 + number as u64);
        for state in 0..20 {
            let theta = random.around_zero(links, PI);
            let omega = rates(&mut random, links, state);
            let momenta = compiled.evaluate("momenta", &[&theta, &omega]);
            let rates = compiled.evaluate("canonical_rates", &[&theta, &momenta]);
            let motion = Motion::new(&sample.tree, &theta, &omega);
            let alpha = motion.accelerations();
            let momenta_at = |h: f64| {
                let moved: Vec<f64> = theta.iter().zip(&omega).map(|(a, b)| a + h * b).collect();
                let faster: Vec<f64> = omega.iter().zip(&alpha).map(|(a, b)| a + h * b).collect();
                let motion = Motion::new(&sample.tree, &moved, &faster);
                &motion.mass * DVector::from_vec(faster)
            };
            let h = 1e-4;
            let slope = (8.0 * (momenta_at(h) - momenta_at(-h))
                - (momenta_at(2.0 * h) - momenta_at(-2.0 * h)))
                / (12.0 * h);
            let scale = slope.amax() + motion.residual_terms(&alpha).amax();
            for link in 0..links {
                let place = || format!("tree {number}, state {state}, link {link}");
                worst.note(rates[links + link] - slope[link], scale, place);
            }
        }
    }
    worst.assert_below(1e-9, "rates of momenta");
}
