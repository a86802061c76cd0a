//! Random trees against derivations of the tests' own.

use std::f64::consts::PI;
use std::sync::LazyLock;

use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::oracle::cartesian::Motion;
use branched_pendulum_tests::oracle::generator::{Recipe, Sample, sample};
use branched_pendulum_tests::oracle::{Link, Tree, closed_form, constrained};
use nalgebra::DVector;

use crate::support::{Compiled, Worst, compile};

const TREES: u64 = 20;
const STATES: usize = 1000;

/// Twenty trees of 3 to 12 links, every third one of full size.
static SAMPLES: LazyLock<Vec<(Sample, Compiled)>> = LazyLock::new(|| {
    (0..TREES)
        .map(|seed| {
            let links = if seed % 3 == 0 {
                12
            } else {
                3 + seed as usize % 9
            };
            let recipe = Recipe {
                links,
                copies: &[1, 1, 1, 2, 3],
                nested: true,
                requests: "energies",
            };
            let sample = sample(&recipe, seed);
            let compiled = compile(&sample.text);
            (sample, compiled)
        })
        .collect()
});

fn state(random: &mut Random, links: usize) -> (Vec<f64>, Vec<f64>) {
    (
        random.around_zero(links, PI),
        random.around_zero(links, 10.0),
    )
}

/// The trees have what the comparisons are about.
#[test]
fn the_samples_are_rich() {
    let links = || SAMPLES.iter().flat_map(|(sample, _)| &sample.tree.links);
    let largest = SAMPLES.iter().map(|(s, _)| s.tree.links.len()).max();
    assert_eq!(largest, Some(12));
    let total = links().count();
    let share = |count: usize| count as f64 / total as f64;
    assert!(share(links().filter(|l| l.com[1] != 0.0).count()) > 0.1);
    assert!(share(links().filter(|l| l.pivot[1] != 0.0).count()) > 0.1);
    assert!(share(links().filter(|l| l.friction > 0.0).count()) > 0.3);
    assert!(share(links().filter(|l| l.inertia == 0.0).count()) > 0.02);
    let groups = SAMPLES.iter().map(|(_, c)| c.scene.groups.len());
    assert!(groups.sum::<usize>() > 10);
    let deepest = SAMPLES
        .iter()
        .flat_map(|(s, _)| (0..s.tree.links.len()).map(|l| s.tree.lineage(l).len()));
    assert!(deepest.max() > Some(5));
    for (sample, compiled) in SAMPLES.iter() {
        assert_eq!(sample.tree.links.len(), compiled.scene.links.len());
    }
}

/// Relative to the problem's conditioning: an error of 1e-12 is what a change
/// of every term of the equations by 1e-12 could make at worst, component by
/// component ([`Motion::sensitivity`]).
#[test]
fn accelerations_agree_with_cartesian_jacobians() {
    let mut worst = Worst::default();
    let mut residual = Worst::default();
    for (number, (sample, compiled)) in SAMPLES.iter().enumerate() {
        let mut random = Random::new(1000 + number as u64);
        for count in 0..STATES {
            let (theta, omega) = state(&mut random, sample.tree.links.len());
            let motion = Motion::new(&sample.tree, &theta, &omega);
            let expected = motion.accelerations();
            let sensitivity = motion.sensitivity(&expected);
            let found = compiled.evaluate("accelerations", &[&theta, &omega]);
            let place = |link: usize| format!("tree {number}, state {count}, link {link}");
            for link in 0..found.len() {
                let error = found[link] - expected[link];
                worst.note(error, sensitivity[link], || place(link));
            }
            // How well the equations are solved, whatever their conditioning.
            let found = DVector::from_vec(found);
            let rest = &motion.mass * &found + &motion.bias;
            let terms = motion.residual_terms(&found);
            for link in 0..found.len() {
                residual.note(rest[link], terms[link], || place(link));
            }
        }
    }
    worst.assert_below(1e-12, "accelerations");
    residual.assert_below(1e-12, "residual");
}

/// Relative to the sum of the absolute values of all terms.
#[test]
fn energies_agree_with_velocities_and_heights() {
    let mut kinetic = Worst::default();
    let mut potential = Worst::default();
    for (number, (sample, compiled)) in SAMPLES.iter().enumerate() {
        let mut random = Random::new(2000 + number as u64);
        for count in 0..STATES {
            let (theta, omega) = state(&mut random, sample.tree.links.len());
            let motion = Motion::new(&sample.tree, &theta, &omega);
            let place = || format!("tree {number}, state {count}");
            let found = compiled.evaluate("kinetic_energy", &[&theta, &omega])[0];
            kinetic.note(found - motion.kinetic, motion.kinetic_terms, place);
            let found = compiled.evaluate("potential_energy", &[&theta])[0];
            potential.note(found - motion.potential, motion.potential_terms, place);
        }
    }
    kinetic.assert_below(1e-14, "kinetic energy");
    potential.assert_below(1e-14, "potential energy");
}

/// Bodies with constraint forces know no generalized coordinates: a mistake
/// in a Jacobian cannot hide there.
#[test]
fn accelerations_agree_with_constraint_forces() {
    let mut worst = Worst::default();
    for (number, (sample, compiled)) in SAMPLES.iter().enumerate() {
        let mut random = Random::new(3000 + number as u64);
        for count in 0..20 {
            let (theta, omega) = state(&mut random, sample.tree.links.len());
            let expected = constrained::accelerations(&sample.tree, &theta, &omega);
            let motion = Motion::new(&sample.tree, &theta, &omega);
            let sensitivity = motion.sensitivity(&DVector::from_column_slice(&expected));
            let found = compiled.evaluate("accelerations", &[&theta, &omega]);
            for link in 0..found.len() {
                worst.note(found[link] - expected[link], sensitivity[link], || {
                    format!("tree {number}, state {count}, link {link}")
                });
            }
        }
    }
    worst.assert_below(1e-12, "accelerations");
}

/// The Cartesian derivation itself, against the closed form of the literature
/// with complex lever arms.
#[test]
fn the_closed_form_agrees_with_cartesian_jacobians() {
    let mut mass = Worst::default();
    let mut bias = Worst::default();
    for (number, (sample, _)) in SAMPLES.iter().enumerate() {
        let mut random = Random::new(4000 + number as u64);
        for count in 0..20 {
            let (theta, omega) = state(&mut random, sample.tree.links.len());
            let motion = Motion::new(&sample.tree, &theta, &omega);
            let (closed_mass, closed_bias) = closed_form::equations(&sample.tree, &theta, &omega);
            let n = theta.len();
            for i in 0..n {
                let place = || format!("tree {number}, state {count}, row {i}");
                let error = closed_bias[i] - motion.bias[i];
                bias.note(error, motion.bias_terms[i], place);
                for j in 0..n {
                    let error = closed_mass[(i, j)] - motion.mass[(i, j)];
                    // M is positive definite: no entry can be larger.
                    let largest = (motion.mass[(i, i)] * motion.mass[(j, j)]).sqrt();
                    mass.note(error, largest, place);
                }
            }
        }
    }
    mass.assert_below(1e-14, "mass matrix");
    bias.assert_below(1e-14, "bias");
}

/// A trunk with three generations by rule, written out by hand.
#[test]
fn generations_by_rule() {
    let compiled = compile(
        "gravity = 9.8, trunk: rod(mass = 1.1, length = 0.7) [
            branch: generations(count = 3, branching = 2, shape = rod, mass = 0.4, length = 0.5,
                mass_ratio = 1 / 2, length_ratio = 0.8, friction = 1e-3, at = 0.6),
        ]",
    );
    let rod = |parent: Option<usize>, mass: f64, length: f64, at: f64| Link {
        parent,
        mass,
        inertia: mass * length * length / 12.0,
        com: [length / 2.0, 0.0],
        pivot: [at, 0.0],
        friction: if parent.is_some() { 1e-3 } else { 0.0 },
        drag: 0.0,
        spring: 0.0,
        rest: 0.0,
        laws: Default::default(),
    };
    let second = |parent: usize| rod(Some(parent), 0.2, 0.4, 0.5);
    let third = |parent: usize| rod(Some(parent), 0.1, 0.32, 0.4);
    let tree = Tree {
        gravity: 9.8,
        between: Vec::new(),
        links: vec![
            rod(None, 1.1, 0.7, 0.0),
            rod(Some(0), 0.4, 0.5, 0.6),
            second(1),
            third(2),
            third(2),
            second(1),
            third(5),
            third(5),
        ],
    };
    assert_eq!(compiled.scene.links.len(), tree.links.len());
    let mut worst = Worst::default();
    let mut random = Random::new(5000);
    for count in 0..100 {
        let (theta, omega) = state(&mut random, tree.links.len());
        let motion = Motion::new(&tree, &theta, &omega);
        let expected = motion.accelerations();
        let sensitivity = motion.sensitivity(&expected);
        let found = compiled.evaluate("accelerations", &[&theta, &omega]);
        for link in 0..found.len() {
            worst.note(found[link] - expected[link], sensitivity[link], || {
                format!("state {count}, link {link}")
            });
        }
    }
    worst.assert_below(1e-12, "accelerations");
}

/// Hamilton's equations: the rates of the momenta are those along the motion.
#[test]
fn canonical_rates_are_those_of_the_motion() {
    let mut worst = Worst::default();
    for seed in 0..8 {
        let recipe = Recipe {
            links: 8,
            copies: &[1, 2, 3],
            nested: true,
            requests: "momenta",
        };
        let sample = sample(&recipe, 900 + seed);
        let compiled = compile(&sample.text);
        let n = sample.tree.links.len();
        let mut random = Random::new(seed);
        for _ in 0..20 {
            let theta = random.around_zero(n, 3.0);
            let omega = random.around_zero(n, 4.0);
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
            for link in 0..n {
                let place = || format!("seed {seed}, link {link}");
                worst.note(rates[n + link] - slope[link], scale, place);
                worst.note(rates[link] - omega[link], 10.0, place);
            }
        }
    }
    worst.assert_below(1e-9, "canonical rates against differences");
}
