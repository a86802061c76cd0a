//! Driven trees: against derivations of the tests' own, and the physics of
//! shaken pendulums.

use std::f64::consts::PI;

use branched_pendulum::prelude::*;
use branched_pendulum_codegen::mechanics::coordinates::Kind;
use branched_pendulum_codegen::scene::Solve;
use branched_pendulum_tests::oracle::cartesian::Motion;
use branched_pendulum_tests::oracle::constrained;
use branched_pendulum_tests::oracle::drive::{Jet, Push, Signal};
use branched_pendulum_tests::oracle::generator::{Recipe, Sample, sample};
use branched_pendulum_tests::random::Random;
use branched_pendulum_tests::scenes::driven::{Driven, DrivenParameters};
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

/// The same accelerations in symmetric coordinates, of nested groups too.
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
        .map(|c| matches!(c.kind, Kind::Difference { .. }))
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
    assert!(torque.program.entry("antiphase_drive_power").is_none());
    let pivot = with("x = sin(t)");
    assert!(pivot.program.entry("antiphase_drive_power").is_some());
    // Powers of the whole come with the energies.
    assert!(pivot.program.entry("drive_power").is_none());
}

fn driven() -> Driven {
    let parameters = DrivenParameters {
        push: 0.2,
        pace: 8.0,
        phase: 0.7,
        sway: 0.04,
    };
    Driven::new(parameters).expect("possible parameters")
}

/// Integrates the driven fixture and, beside it, powers; returns the largest
/// |E(t) − E(0) − ∫P dt| and the largest |E|, of all samples.
fn balance(
    energy: impl Fn(&Driven, &[f64; 3], &[f64; 3]) -> f64,
    power: impl Fn(&Driven, f64, &[f64; 3], &[f64; 3]) -> f64,
) -> (f64, f64) {
    let model = driven();
    let halves = |state: &[f64]| -> ([f64; 3], [f64; 3]) {
        let half = |part: &[f64]| part.try_into().expect("three links");
        (half(&state[..3]), half(&state[3..6]))
    };
    let system = OdeFn::new(7, |time: f64, state: &[f64], rates: &mut [f64]| {
        let (theta, omega) = halves(state);
        rates[..3].copy_from_slice(&omega);
        rates[3..6].copy_from_slice(&model.accelerations(time, &theta, &omega));
        rates[6] = power(&model, time, &theta, &omega);
    });
    let start = State::new(0.0, vec![0.9, 0.3, -0.2, 0.0, 1.0, -2.0, 0.0]);
    let of = |state: &[f64]| {
        let (theta, omega) = halves(state);
        energy(&model, &theta, &omega)
    };
    let first = of(&start.values);
    let times: Vec<f64> = (1..=200).map(|i| 0.05 * f64::from(i)).collect();
    let (mut error, mut size) = (0.0_f64, 0.0_f64);
    Dop853::new(Options::with_tolerance(1e-13))
        .sample(&system, &start, &times, |_, state| {
            let own = of(state);
            error = error.max((own - first - state[6]).abs());
            size = size.max(own.abs());
        })
        .expect("it runs");
    (error, size)
}

#[test]
fn energy_is_balanced_by_the_powers_of_drive_and_friction() {
    let energy = |model: &Driven, theta: &[f64; 3], omega: &[f64; 3]| {
        model.kinetic_energy(theta, omega) + model.potential_energy(theta)
    };
    let (error, size) = balance(energy, |model, time, theta, omega| {
        model.drive_power(time, theta, omega) + model.friction_power(omega)
    });
    println!("balance of the energy: {error:.2e} J of {size:.2e} J");
    assert!(error <= 1e-10 * size, "{error} {size}");
    // Neither power may be left out.
    let (error, size) = balance(energy, |model, time, theta, omega| {
        model.drive_power(time, theta, omega)
    });
    assert!(error > 1e-3 * size, "{error} {size}");
    let (error, size) = balance(energy, |model, _, _, omega| model.friction_power(omega));
    assert!(error > 1e-3 * size, "{error} {size}");
}

#[test]
fn antiphase_energy_is_balanced_by_transfer_friction_and_drive() {
    let symmetric = |model: &Driven, theta: &[f64; 3], omega: &[f64; 3]| {
        (model.to_symmetric(theta), model.to_symmetric(omega))
    };
    let energy = |model: &Driven, theta: &[f64; 3], omega: &[f64; 3]| {
        let (q, v) = symmetric(model, theta, omega);
        model.antiphase_energy(&q, &model.symmetric_momenta(&q, &v))
    };
    let conservative = |model: &Driven, theta: &[f64; 3], omega: &[f64; 3]| {
        let (q, v) = symmetric(model, theta, omega);
        model.transfer_exact_from_rates(&q, &v).total() + model.antiphase_friction_power(&q, &v)
    };
    let (error, size) = balance(energy, |model, time, theta, omega| {
        let (q, v) = symmetric(model, theta, omega);
        conservative(model, theta, omega) + model.antiphase_drive_power(time, &q, &v)
    });
    println!("balance of the antiphase: {error:.2e} J of {size:.2e} J");
    assert!(error <= 1e-10 * size, "{error} {size}");
    let (error, size) = balance(energy, |model, _, theta, omega| {
        conservative(model, theta, omega)
    });
    assert!(error > 1e-2 * size, "{error} {size}");
}

mod shaken {
    #![allow(missing_docs)]
    use branched_pendulum::branched_pendulum;

    /// A rod whose pivot is shaken up and down; it swings like a point at
    /// 2/3 of its length.
    #[branched_pendulum(
        gravity = 9.8,
        rod: rod(mass = 0.1, length = 0.3),
        drive(y = height * cos(rate * t)),
    )]
    pub struct Shaken;
}

/// The largest angle from upright over 6 s, and the number of crossings of it.
fn upright(height: f64, rate: f64) -> (f64, usize) {
    let parameters = shaken::ShakenParameters { height, rate };
    let model = shaken::Shaken::new(parameters).expect("possible parameters");
    let start = State::at_rest(0.0, &[PI + 0.02]);
    let times: Vec<f64> = (1..=6000).map(|i| 1e-3 * f64::from(i)).collect();
    let mut angles = Vec::new();
    Dop853::new(Options::with_tolerance(1e-10))
        .sample(&AbsoluteAngles(&model), &start, &times, |_, state| {
            angles.push(state[0] - PI);
        })
        .expect("it runs");
    let crossings = angles.windows(2).filter(|w| w[0] * w[1] < 0.0).count();
    let largest = angles.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
    (largest, crossings)
}

/// Kapitza's pendulum (Landau and Lifshitz, Mechanics, §30): upright is stable
/// where the pivot moves fast enough, a² Ω² > 2 g l, and the slow oscillation
/// about it has the frequency √(a² Ω²/2 l² − g/l).
#[test]
fn a_fast_pivot_holds_the_pendulum_upright() {
    const HEIGHT: f64 = 0.005;
    const LENGTH: f64 = 0.2;
    let threshold = (2.0 * 9.8 * LENGTH).sqrt() / HEIGHT;
    let (largest, crossings) = upright(HEIGHT, 0.95 * threshold);
    assert!(largest > 1.0, "{largest} {crossings}");
    for factor in [1.05, 1.5, 3.0] {
        let rate = factor * threshold;
        let (largest, crossings) = upright(HEIGHT, rate);
        assert!(largest < 0.03, "{factor}: {largest}");
        let square = (HEIGHT * rate / LENGTH).powi(2) / 2.0 - 9.8 / LENGTH;
        let expected = 6.0 * square.sqrt() / PI;
        // Two crossings a period; the fast motion adds none away from zero.
        assert!(
            (crossings as f64 - expected).abs() < 2.0,
            "{crossings} {expected}"
        );
    }
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
