//! Straight springs, repulsions and dampers, and guys: compiled code against trees at run time, and emitted
//! models against the energy along their motions and against each other's series.

use std::f64::consts::PI;

use branched_pendulum::prelude::*;
use branched_pendulum::system::OdeFn;
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::oracle::cartesian::Motion;
use branched_pendulum_tests::oracle::generator::{Coupling, Recipe, coupled_sample};
use branched_pendulum_trees::{PendulumTree, TreeDescription};

use crate::support::{Worst, compile};

const STATES: usize = 25;

/// Clauses between random points of links of those names. A repulsion stands beside a spring without
/// length at rest, and beside one with such a length, and an attraction by itself.
fn clauses(names: &[String], random: &mut Random) -> String {
    let mut text = String::new();
    for number in 0..4 {
        let first = random.below(names.len());
        let second = (first + 1 + random.below(names.len() - 1)) % names.len();
        let mut point = || {
            let [along, lateral] = random.array::<2>(-0.3, 0.4);
            format!("({along:.3}, {lateral:.3})")
        };
        let (a, b, at, to) = (&names[first], &names[second], point(), point());
        let ends = match number {
            2 => format!("guy({a}, at = {at}, to = {to}"),
            _ => format!("between({a}, {b}, at = each({at}, {to})"),
        };
        let [spring, rest, friction] = random.array::<3>(0.1, 0.5);
        let rest = match number {
            0 => String::new(),
            _ => format!(", rest = {rest:.3}"),
        };
        let exponent = 1 + random.below(12);
        let strength = (0.3_f64).powi(exponent as i32) * random.between(0.05, 0.3);
        let spring = format!(", spring = {:.3}{rest}", 20.0 * spring);
        let acts = match number {
            2 => spring,
            3 => format!(", repulsion = {:e}, exponent = {exponent}", -0.2 * strength),
            _ => format!("{spring}, repulsion = {strength:e}, exponent = {exponent}"),
        };
        text.push_str(&format!(", {ends}{acts}, friction = {friction:.3})"));
    }
    text
}

/// Random trees of 3 to 8 links, which torsion springs couple as well, by either solve. Trees at
/// run time are compared with Cartesian points elsewhere.
#[test]
fn functions_are_those_of_trees_at_run_time() {
    let [
        mut accelerations,
        mut energies,
        mut powers,
        mut matrices,
        mut canonical,
    ] = [(); 5].map(|()| Worst::default());
    for number in 0..12 {
        let recipe = Recipe {
            links: 3 + number as usize % 6,
            copies: &[1, 1, 2],
            nested: true,
            requests: "energies, momenta, modes, forces",
        };
        let sample = coupled_sample(&recipe, 7_000 + number, Coupling::Any);
        let mut random = Random::new(number);
        let plain = PendulumTree::parse(&sample.text).expect("the compiler takes it");
        let text = format!(
            "{}{}",
            sample.text.trim_end_matches([',', ' ', '\n']),
            clauses(plain.names(), &mut random)
        );
        let tree = PendulumTree::parse(&text).expect("the compiler takes it");
        let solves = ["factorization", "recursion"];
        let solves = solves.map(|solve| compile(&format!("solve = {solve}, {text}")));
        let n = tree.links();
        for state in 0..STATES {
            let place = || format!("tree {number}, state {state}");
            let theta = random.around_zero(n, PI);
            let omega = random.around_zero(n, 8.0);
            let inputs: [&[f64]; 2] = [&theta, &omega];
            let motion = Motion::new(&sample.tree, &theta, &omega);
            let own = tree.accelerations(0.0, &theta, &omega);
            // Torques by straight springs belong to what rounding counts against.
            let free = plain.accelerations(0.0, &theta, &omega);
            let sensitivity = motion.sensitivity(&motion.accelerations());
            let pulled = own.iter().zip(&free);
            let pulled = pulled.fold(0.0, |size: f64, (own, free)| size.max((own - free).abs()));
            for compiled in &solves {
                let found = compiled.evaluate("accelerations", &inputs);
                for (link, found) in found.iter().enumerate() {
                    accelerations.note(found - own[link], sensitivity[link] + pulled, place);
                }
            }
            let potential = solves[1].evaluate("potential_energy", &[&theta])[0];
            let error = tree.potential_energy_of(&theta) - potential;
            energies.note(error, motion.potential_terms + potential.abs(), place);
            let power = solves[0].evaluate("friction_power", &inputs)[0];
            powers.note(tree.friction_power(&theta, &omega) - power, power, place);
            assert!(power < 0.0, "{}", place());
            let pairs = [
                ("mass_matrix", tree.mass_matrix(&theta)),
                ("stiffness_matrix", tree.stiffness_matrix(&theta)),
            ];
            for (entry, own) in pairs {
                let derived = solves[0].evaluate(entry, &[&theta]);
                let size = derived.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
                for (own, derived) in own.iter().flatten().zip(derived) {
                    matrices.note(own - derived, size, || format!("{entry}, {}", place()));
                }
            }
            let momenta = tree.momenta(&theta, &omega);
            let derived = solves[0].evaluate("canonical_rates", &[&theta, &momenta]);
            let [mut velocities, mut slopes] = [(); 2].map(|()| vec![0.0; n]);
            tree.canonical_rates_into(0.0, &theta, &momenta, &mut velocities, &mut slopes);
            let terms = motion.bias_terms.iter().chain(motion.mass_terms.iter());
            let size = terms.fold(pulled, |size: f64, x| size.max(x.abs()));
            for (own, derived) in slopes.iter().zip(&derived[n..]) {
                canonical.note(own - derived, size * (1.0 + 1e2 * size), place);
            }
        }
    }
    accelerations.assert_below(1e-12, "accelerations");
    energies.assert_below(1e-13, "potential energies");
    powers.assert_below(1e-12, "powers of friction");
    matrices.assert_below(1e-12, "matrices of the modes");
    canonical.assert_below(1e-10, "rates of momenta");
}

/// A Y with a guy, a spring and damper across beside magnets, a spring without length at rest, and an
/// attraction to a place out of reach.
#[branched_pendulum(
    gravity = -9.80665,
    mast: rod(mass = 0.3, length = 0.4) [
        left: rod(mass = 0.05, length = 0.2, spring = 0.2, rest = 0.5),
        right: rod(mass = 0.05, length = 0.2, spring = 0.2, rest = -0.5) [
            tip: rod(mass = 0.02, length = 0.1),
        ],
    ],
    guy(mast, at = 0.4, to = (-0.4, 0), spring = stiffness, rest = 0.5),
    guy(mast, at = (0.35, 0.01), to = (0.4, 0), spring = stiffness, rest = 0.5, friction = loss),
    between(left, right, at = each(0.2, 0.1), spring = 8, rest = 0.1, friction = loss,
        repulsion = magnets, exponent = 3),
    between(left, tip, at = each(0.1, 0.05), spring = 2),
    guy(tip, at = 0.1, to = (0.9, 0.3), repulsion = -2 * magnets, exponent = 2),
    emit(energies, forces, momenta, taylor, modes, positions),
    observe(energy = kinetic_energy + potential_energy),
    prescribed(right),
)]
struct Guyed;

const LINKS: usize = 4;
/// Strength of the magnets, J m³.
const MAGNETS: f64 = 5e-4;
/// Number of the link that is held.
const RIGHT: usize = 2;

fn model(loss: f64) -> Guyed {
    let parameters = GuyedParameters {
        stiffness: 60.0,
        loss,
        magnets: MAGNETS,
    };
    Guyed::new(parameters).expect("springs are positive")
}

const START: [f64; 2 * LINKS] = [0.2, 0.4, -0.6, 0.3, 1.0, -2.0, 0.5, 3.0];

/// ∫P dt is what the energy loses, and its rate as an observable is P.
#[test]
fn the_energy_is_balanced_along_a_run() {
    for (loss, least) in [(0.0, 0.0), (0.05, 0.05)] {
        let model = model(loss);
        let split = |state: &[f64]| -> [[f64; LINKS]; 2] {
            [0, LINKS].map(|first| std::array::from_fn(|link| state[first + link]))
        };
        let ode = OdeFn::new(2 * LINKS + 1, |_: f64, state: &[f64], rates: &mut [f64]| {
            let [theta, omega] = split(state);
            rates[..LINKS].copy_from_slice(&omega);
            rates[LINKS..2 * LINKS].copy_from_slice(&model.accelerations(&theta, &omega));
            rates[2 * LINKS] = model.friction_power(&theta, &omega);
        });
        let energy = |state: &[f64]| {
            let [theta, omega] = split(state);
            let power = model.friction_power(&theta, &omega);
            let rate = model.energy_rate(&theta, &omega);
            assert!((rate - power).abs() < 1e-11, "{rate} {power}");
            model.kinetic_energy(&theta, &omega) + model.potential_energy(&theta)
        };
        let start = State::new(0.0, [&START[..], &[0.0]].concat());
        let method = Dop853::new(Options::with_tolerance(1e-14));
        let end = method.run(&ode, &start, 10.0);
        let end = end.expect("a smooth motion").state.values;
        let lost = energy(&start.values) - energy(&end);
        assert!(lost >= least - 1e-9, "{lost}");
        let error = lost + end[2 * LINKS];
        assert!(error.abs() < 1e-10, "{error:e} of {lost}");
    }
}

/// A start that is off by 1e-10 is off by 3e-7 at 1.5 s.
#[test]
fn taylor_series_are_those_of_dop853() {
    let model = model(0.05);
    let system = AbsoluteAngles(&model);
    let options = || Options::with_tolerance(1e-13);
    let start = State::new(0.0, START.to_vec());
    let by_series = Taylor::new(options()).run(&system, &start, 1.5);
    let by_stages = Dop853::new(options()).run(&system, &start, 1.5);
    let [by_series, by_stages] = [by_series, by_stages].map(|end| end.expect("smooth").state);
    for (a, b) in by_series.values.iter().zip(&by_stages.values) {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }
}

/// Under the reaction as a torque from outside the free tree moves as the one whose link is held.
#[test]
fn reactions_make_the_free_tree_move_so() {
    let model = model(0.05);
    let mut random = Random::new(12);
    for _ in 0..100 {
        let mut fixed =
            |size: f64| -> [f64; LINKS] { std::array::from_fn(|_| random.between(-size, size)) };
        let ([theta, omega], mut torques) = ([3.0, 5.0].map(&mut fixed), fixed(0.1));
        let [given, ..] = fixed(20.0);
        let (alpha, [reaction]) =
            model.accelerations_prescribed_right(&theta, &omega, &torques, &[given]);
        assert_eq!(alpha[RIGHT], given);
        torques[RIGHT] += reaction;
        let under = model.accelerations_under(&theta, &omega, &torques);
        let size = alpha.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
        for (own, other) in alpha.iter().zip(under) {
            assert!((own - other).abs() < 1e-10 * size, "{own} {other}");
        }
    }
}

/// The text of the model, read at run time with the same values.
#[test]
fn emitted_code_agrees_with_the_tree_at_run_time() {
    let source = include_str!("straight.rs");
    let (_, rest) = source
        .split_once("#[branched_pendulum(")
        .expect("it is above");
    let (text, _) = rest.split_once(")]\nstruct Guyed;").expect("it ends");
    let description = TreeDescription::parse(text).expect("the compiler takes it");
    let values = [("stiffness", 60.0), ("loss", 0.05), ("magnets", MAGNETS)];
    let tree = description.tree(&values).expect("the model takes them");
    let model = model(0.05);
    let mut random = Random::new(9);
    for _ in 0..100 {
        let [theta, omega] = [3.0, 5.0].map(|size| random.around_zero(LINKS, size));
        let own = tree.accelerations(0.0, &theta, &omega);
        let fixed = |values: &[f64]| -> [f64; LINKS] { std::array::from_fn(|link| values[link]) };
        let (theta, omega) = (fixed(&theta), fixed(&omega));
        let emitted = model.accelerations(&theta, &omega);
        let size = own.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
        for (own, emitted) in own.iter().zip(emitted) {
            assert!((own - emitted).abs() < 1e-11 * size, "{own} {emitted}");
        }
        let power = model.friction_power(&theta, &omega);
        let own = tree.friction_power(&theta, &omega);
        assert!((own / power - 1.0).abs() < 1e-12, "{own} {power}");
    }
}
