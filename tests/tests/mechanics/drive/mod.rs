//! Driven trees: against derivations of the tests' own, and the physics of
//! shaken pendulums.

mod balance;
mod shaken;

use std::f64::consts::PI;

use branched_pendulum_codegen::scene::Solve;
use branched_pendulum_codegen::scene::coordinates::CoordinateKind;
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::oracle::cartesian::Motion;
use branched_pendulum_tests::oracle::constrained;
use branched_pendulum_tests::oracle::drive::{Jet, Push, Signal};
use branched_pendulum_tests::oracle::generator::{Recipe, Sample, sample};
use nalgebra::DVector;

use crate::support::{Compiled, Worst, compile};

/// A tree and what drives it: torque, x, y.
struct Case {
    sample: Sample,
    drive: [Option<Signal>; 3],
    compiled: Compiled,
}

impl Case {
    fn new(seed: u64, recipe: &Recipe) -> Self {
        let sample = sample(recipe, seed);
        let mut random = Random::new(100 + seed);
        // Every part alone, every pair, and all of them.
        let wanted = 1 + seed % 7;
        let drive: [Option<Signal>; 3] = std::array::from_fn(|part| {
            (wanted >> part & 1 == 1).then(|| Signal::random(&mut random, 4))
        });
        let parts: Vec<String> = ["torque", "x", "y"]
            .iter()
            .zip(&drive)
            .filter_map(|(name, signal)| Some(format!("{name} = {}", signal.as_ref()?)))
            .collect();
        // Either solve, in turn.
        let solve = Solve::ALL[seed as usize % 2].name();
        let text = format!(
            "{}, drive({}), solve = {solve}",
            sample.text,
            parts.join(", ")
        );
        let compiled = compile(&text);
        Self {
            sample,
            drive,
            compiled,
        }
    }

    fn push(&self, time: f64) -> Push {
        let [torque, x, y] = self.drive.each_ref().map(|signal| {
            let rest = Jet::constant(0.0);
            signal.as_ref().map_or(rest, |signal| signal.at(time))
        });
        Push {
            torque: torque.value[0],
            acceleration: [x.value[2], y.value[2]],
            torque_terms: torque.terms[0],
            acceleration_terms: [x.terms[2], y.terms[2]],
        }
    }
}

/// Trees with friction, drag, springs and offsets, and random functions of
/// time: the slopes of those by Taylor arithmetic.
fn cases(requests: &'static str) -> impl Iterator<Item = Case> {
    (0..14).map(move |seed| {
        let recipe = Recipe {
            links: 2 + seed as usize % 7,
            copies: &[1, 1, 2, 3],
            nested: true,
            requests,
        };
        Case::new(seed, &recipe)
    })
}

fn state(random: &mut Random, links: usize) -> (f64, Vec<f64>, Vec<f64>) {
    (
        random.between(-3.0, 3.0),
        random.around_zero(links, PI),
        random.around_zero(links, 10.0),
    )
}

/// Relative to the problem's conditioning, as for undriven trees; the constraint
/// forces are in the frame of the ground.
#[test]
fn accelerations_and_power_agree_with_both_oracles() {
    let [mut jacobians, mut forces, mut power] = [(); 3].map(|()| Worst::default());
    let mut largest = 0.0_f64;
    for (number, case) in cases("energies").enumerate() {
        let tree = &case.sample.tree;
        let mut random = Random::new(6000 + number as u64);
        for count in 0..300 {
            let (time, theta, omega) = state(&mut random, tree.links.len());
            let push = case.push(time);
            let motion = Motion::driven(tree, &theta, &omega, &push);
            let expected = motion.accelerations();
            let sensitivity = motion.sensitivity(&expected);
            let constrained = constrained::driven(tree, &theta, &omega, &push);
            let constrained = DVector::from_vec(constrained);
            let slack = motion.sensitivity(&constrained);
            let inputs: [&[f64]; 3] = [&[time], &theta, &omega];
            let found = case.compiled.evaluate("accelerations", &inputs);
            let place = |link: usize| format!("tree {number}, state {count}, link {link}");
            for link in 0..found.len() {
                let error = found[link] - expected[link];
                jacobians.note(error, sensitivity[link], || place(link));
                let error = found[link] - constrained[link];
                forces.note(error, slack[link], || place(link));
            }
            let still = Motion::new(tree, &theta, &omega);
            let velocities = DVector::from_column_slice(&omega);
            let expected = (&still.bias - &motion.bias).dot(&velocities);
            let terms = motion.bias_terms.dot(&velocities.abs());
            let found = case.compiled.evaluate("drive_power", &inputs)[0];
            power.note(found - expected, terms, || place(0));
            largest = largest.max((expected / terms).abs());
        }
    }
    assert!(largest > 0.5, "{largest}");
    jacobians.assert_below(1e-12, "Cartesian Jacobians");
    forces.assert_below(1e-12, "constraint forces");
    power.assert_below(1e-14, "power");
}

/// Driven accelerations in symmetric coordinates, of nested groups too.
#[test]
fn symmetric_coordinates_are_driven_alike() {
    let mut worst = Worst::default();
    let recipe = Recipe {
        links: 9,
        copies: &[2, 3],
        nested: true,
        requests: "symmetric",
    };
    for seed in 20..26 {
        let case = Case::new(seed, &recipe);
        let tree = &case.sample.tree;
        assert!(!case.compiled.scene.groups.is_empty());
        let mut random = Random::new(7000 + seed);
        for count in 0..100 {
            let (time, theta, omega) = state(&mut random, tree.links.len());
            let motion = Motion::driven(tree, &theta, &omega, &case.push(time));
            let expected = motion.accelerations();
            let sensitivity = motion.sensitivity(&expected);
            let transform = |values: &[f64]| case.compiled.evaluate("to_symmetric", &[values]);
            let (q, v) = (transform(&theta), transform(&omega));
            let inputs: [&[f64]; 3] = [&[time], &q, &v];
            let found = case.compiled.evaluate("symmetric_accelerations", &inputs);
            let found = case.compiled.evaluate("from_symmetric", &[&found]);
            // The transform mixes the errors of all links.
            let scale = sensitivity.max();
            for link in 0..found.len() {
                worst.note(found[link] - expected[link], scale, || {
                    format!("seed {seed}, state {count}, link {link}")
                });
            }
        }
    }
    worst.assert_below(1e-12, "symmetric accelerations");
}

/// A drive acts on copies alike: differences that are zero stay exactly zero.
#[test]
fn a_drive_leaves_zero_differences_exactly_zero() {
    let compiled = compile(
        "gravity = 9.8, body: rod(mass = 0.4, length = 0.3) [
            arm(mass = 0.2, com = (0.1, 0.02), inertia = 1e-3, joint = (0.2, 0.01)) [
                hand: point(mass = 0.1, length = 0.1) * 3
            ] * 2
        ],
        drive(torque = cos(3 * t), x = 0.1 * sin(7 * t), y = 0.2 * cos(5 * t)),
        emit(symmetric)",
    );
    let differences: Vec<bool> = compiled
        .mechanics
        .coordinates
        .iter()
        .map(|c| matches!(c.kind, CoordinateKind::Difference { .. }))
        .collect();
    assert_eq!(differences.iter().filter(|d| **d).count(), 6);
    let mut random = Random::new(8000);
    for _ in 0..1000 {
        let (time, mut q, mut v) = state(&mut random, differences.len());
        for (index, _) in differences.iter().enumerate().filter(|(_, d)| **d) {
            (q[index], v[index]) = (0.0, 0.0);
        }
        let found = compiled.evaluate("symmetric_accelerations", &[&[time], &q, &v]);
        for (value, difference) in found.iter().zip(&differences) {
            assert!(*difference == (*value == 0.0), "{found:?}");
        }
    }
}

/// A pivot accelerated by (6, 3) m/s² under 5 m/s² hangs in a gravity of
/// 10 m/s² that is tilted by atan(6/8).
#[test]
fn uniform_acceleration_is_tilted_gravity() {
    const TREE: &str = "parent(mass = 0.3, com = (0.1, 0.02), inertia = 2e-3, joint = 0.25,
        friction = 5e-4) [ child: rod(mass = 0.1, length = 0.2, friction = 1e-4) * 2 ]";
    let driven = compile(&format!(
        "gravity = 5, {TREE}, drive(x = 3 * t^2 - t, y = 1.5 * t^2 + 2)"
    ));
    let tilted = compile(&format!("gravity = 10, {TREE}"));
    let tilt = (-6.0_f64).atan2(8.0);
    let mut worst = Worst::default();
    let mut random = Random::new(9000);
    for count in 0..1000 {
        let (time, theta, omega) = state(&mut random, 3);
        let turned: Vec<f64> = theta.iter().map(|theta| theta - tilt).collect();
        let found = driven.evaluate("accelerations", &[&[time], &theta, &omega]);
        let expected = tilted.evaluate("accelerations", &[&turned, &omega]);
        let scale = expected.iter().fold(1.0_f64, |m, a| m.max(a.abs()));
        for link in 0..3 {
            let error = found[link] - expected[link];
            worst.note(error, scale, || format!("state {count}, link {link}"));
        }
    }
    worst.assert_below(1e-13, "tilted gravity");
}

/// A pivot at constant velocity is at rest in a frame of its own.
#[test]
fn a_galilean_pivot_changes_no_bit() {
    const TREE: &str = "gravity = 9.8, parent: rod(mass = 0.3, length = 0.2, drag = 0.01) [
        child: rod(mass = 0.1, length = 0.2) * 2 ]";
    let moving = compile(&format!(
        "{TREE}, drive(x = 3 * t + sin(0.5), y = 1 - t / 7)"
    ));
    let resting = compile(TREE);
    let mut random = Random::new(10_000);
    for _ in 0..100 {
        let (time, theta, omega) = state(&mut random, 3);
        let found = moving.evaluate("accelerations", &[&[time], &theta, &omega]);
        assert_eq!(found, resting.evaluate("accelerations", &[&theta, &omega]));
    }
    let drive = moving.mechanics.drive.as_ref().expect("there is one");
    assert!(drive.pivot.iter().all(|axis| axis.acceleration.is_none()));
}

/// A torque on the root feeds no difference of siblings; a moving pivot does.
#[test]
fn only_the_pivot_feeds_the_antiphase() {
    let with = |drive: &str| {
        compile(&format!(
            "gravity = 9.8, a: rod(mass = 1, length = 1) [ b: rod(mass = 1, length = 1) * 2 ],
            drive({drive}), emit(transfer(exact))"
        ))
    };
    let torque = with("torque = sin(t)");
    assert!(torque.mechanics.transfers[0].drive.is_zero());
    for power in ["antiphase_drive_power", "antiphase_drive_power_from_rates"] {
        assert!(torque.program.entry(power).is_none());
    }
    let pivot = with("x = sin(t)");
    for power in ["antiphase_drive_power", "antiphase_drive_power_from_rates"] {
        assert!(pivot.program.entry(power).is_some());
    }
    // Powers of the whole come with the energies.
    assert!(pivot.program.entry("drive_power").is_none());
}

/// Observables know the drive: their rates are those along the driven motion,
/// and the bracket's route agrees.
#[test]
fn observables_of_a_driven_tree_have_its_rates() {
    let compiled = compile(
        "gravity = 9.8, a: rod(mass = 1, length = 0.5, friction = 0.1) \
         [b: rod(mass = 0.5, length = 0.3) * 2], \
         drive(torque = 0.7 * cos(3 * t), x = 0.1 * sin(5 * t), y = 0.05 * cos(4 * t)), \
         emit(energies, momenta), \
         observe(energy = kinetic_energy + potential_energy, spin = omega_a * omega_b_1, push = p_b_2)",
    );
    let mut random = Random::new(31);
    for _ in 0..20 {
        let time = random.between(0.0, 3.0);
        let theta = random.around_zero(3, 3.0);
        let omega = random.around_zero(3, 4.0);
        let at = |entry: &str| compiled.evaluate(entry, &[&[time], &theta, &omega]);
        let power = at("drive_power")[0] + compiled.evaluate("friction_power", &[&omega])[0];
        let energy = at("energy_rate")[0];
        assert!(
            (energy - power).abs() <= 1e-12 * (1.0 + power.abs()),
            "{energy} {power}"
        );
        let alpha = at("accelerations");
        let spin = alpha[0] * omega[1] + omega[0] * alpha[1];
        assert!((at("spin_rate")[0] - spin).abs() <= 1e-12 * (1.0 + spin.abs()));
        let momenta = compiled.evaluate("momenta", &[&theta, &omega]);
        for name in ["energy", "spin", "push"] {
            let rate = at(&format!("{name}_rate"))[0];
            let entry = format!("{name}_rate_from_momenta");
            let bracket = compiled.evaluate(&entry, &[&[time], &theta, &momenta])[0];
            let scale = 1.0 + alpha.iter().fold(rate.abs(), |most, a| most.max(a.abs()));
            assert!(
                (bracket - rate).abs() <= 1e-11 * scale,
                "{name}: {bracket} {rate}"
            );
        }
    }
}
