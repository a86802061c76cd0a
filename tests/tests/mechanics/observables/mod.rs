//! Observables of the user's own: values against their expressions, rates
//! against trajectories of the oracle, and one route against the other.

mod cases;

use branched_pendulum::integrate::{Dop853, Integrator, Options};
use branched_pendulum::system::{OdeFn, State};
use branched_pendulum_codegen::report::{Faults, Message, OutputMessage, TreeMessage};
use branched_pendulum_codegen::{description, scene};
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_compiler_tests::source::{self, attributed_struct};
use branched_pendulum_tests::oracle::Tree;
use branched_pendulum_tests::oracle::cartesian::Motion;

use crate::support::{Worst, compile};
use cases::{CASES, Case, OBSERVABLES, Point};

/// No observable can take the name of a function of a fixture's model: the
/// front end's list of them is complete.
#[test]
fn no_emitted_function_can_be_defined_again() {
    for fixture in ["chain", "offset", "paper", "simple", "sweep", "triplet"] {
        let path = source::fixture(&format!("scenes/{fixture}.rs"));
        let text = std::fs::read_to_string(path).expect("the fixture exists");
        let (attribute, item) = attributed_struct(&text);
        let mut functions = Vec::new();
        let code: syn::File =
            syn::parse2(source::scene(fixture).tokens().clone()).expect("it is Rust");
        for block in code.items {
            let syn::Item::Impl(block) = block else {
                continue;
            };
            // Parameters are a type of their own.
            if let syn::Type::Path(own) = &*block.self_ty
                && let Some(own) = own.path.segments.last()
                && own.ident.to_string().ends_with("Parameters")
            {
                continue;
            }
            functions.extend(block.items.into_iter().filter_map(|member| match member {
                syn::ImplItem::Fn(function) => Some(function.sig.ident),
                _ => None,
            }));
        }
        assert!(!functions.is_empty());
        for function in functions {
            let mut report = Faults::new();
            let attribute = quote::quote!(observe(#function = 1), #attribute);
            let description = description::parse(attribute, item.clone(), &mut report);
            let scene = description.and_then(|d| scene::resolve(&d, &mut report));
            let messages: Vec<&Message> = report.diagnostics().iter().map(|d| &d.message).collect();
            let refused = matches!(
                messages[..],
                [Message::Output(OutputMessage::FunctionTaken { .. })
                    | Message::Tree(TreeMessage::ReservedName { .. })]
            );
            assert!(scene.is_none() && refused, "{function}: {messages:?}");
        }
    }
}

fn states(case: &Case, seed: u64, count: usize) -> Vec<(Vec<f64>, Vec<f64>)> {
    let mut random = Random::new(seed);
    let n = case.tree.links.len();
    (0..count)
        .map(|_| (random.around_zero(n, 2.0), random.around_zero(n, 2.0)))
        .collect()
}

#[test]
fn values_are_those_of_the_expressions() {
    let (mut direct, mut canonical) = (Worst::default(), Worst::default());
    for (index, case) in CASES.iter().enumerate() {
        for (theta, omega) in states(case, index as u64, 5) {
            let point = Point::new(case, &theta, &omega);
            for number in 0..OBSERVABLES {
                let place = || format!("tree {index}, observable {number}");
                let (expected, size) = point.observable(number);
                direct.note(point.evaluate(number, "") - expected, size, place);
                let found = point.evaluate(number, "_from_momenta");
                canonical.note(found - expected, size, place);
            }
        }
    }
    direct.assert_below(1e-14, "value");
    canonical.assert_below(1e-11, "value from momenta");
}

/// The states at `time` before and after, by the oracle's equations of motion.
fn moved(tree: &Tree, theta: &[f64], omega: &[f64], time: f64) -> (Vec<f64>, Vec<f64>) {
    let n = theta.len();
    let motion = OdeFn::new(2 * n, |_time: f64, state: &[f64], rates: &mut [f64]| {
        let (theta, omega) = state.split_at(n);
        rates[..n].copy_from_slice(omega);
        let alpha = Motion::new(tree, theta, omega).accelerations();
        rates[n..].copy_from_slice(alpha.as_slice());
    });
    let start = State::new(0.0, [theta, omega].concat());
    let solution = Dop853::new(Options::with_tolerance(1e-15))
        .run(&motion, &start, time)
        .expect("a short path is integrated");
    let state = solution.state;
    (state.positions().to_vec(), state.velocities().to_vec())
}

/// A bound on how fast the tree can answer, 1/s: friction on a light link damps
/// within microseconds.
fn fastest(tree: &Tree, theta: &[f64], omega: &[f64]) -> f64 {
    const STEP: f64 = 1e-6;
    let at = |theta: &[f64], omega: &[f64]| Motion::new(tree, theta, omega).accelerations();
    let (mut damping, mut stiffness) = (0.0, 0.0);
    let here = at(theta, omega);
    for link in 0..theta.len() {
        let (mut turned, mut faster) = (theta.to_vec(), omega.to_vec());
        turned[link] += STEP;
        faster[link] += STEP;
        stiffness += (at(&turned, omega) - &here).norm_squared();
        damping += (at(theta, &faster) - &here).norm_squared();
    }
    (damping.sqrt() / STEP).max((stiffness.sqrt() / STEP).sqrt())
}

/// The rates of all observables along the motion of `tree`, by differences of
/// eighth order on finer and finer steps, each with their accuracy: the change that the
/// last refinement made, which may be small by chance, and what rounding does to values
/// over the step.
fn differences(case: &Case, tree: &Tree, theta: &[f64], omega: &[f64]) -> Vec<(f64, f64)> {
    const WEIGHTS: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    let mut best = vec![(f64::NAN, f64::INFINITY); OBSERVABLES];
    let mut last = vec![f64::NAN; OBSERVABLES];
    let coarsest = (0.3 / fastest(tree, theta, omega)).min(1e-2);
    // Observables before and after the state, by the number of steps to it.
    let mut values: [[Vec<f64>; 4]; 2] = Default::default();
    for level in 0..12 {
        let step = coarsest * 0.5_f64.powi(level);
        let mut rates = vec![0.0; OBSERVABLES];
        let mut largest = [0.0_f64; OBSERVABLES];
        for (side, values) in [-1.0, 1.0].into_iter().zip(&mut values) {
            let coarser = core::mem::take(values);
            for (place, weight) in WEIGHTS.iter().enumerate() {
                // Two and four steps are one and two of those before.
                values[place] = match place {
                    1 | 3 if level > 0 => coarser[place / 2].clone(),
                    _ => {
                        let time = side * step * (place + 1) as f64;
                        let (theta, omega) = moved(tree, theta, omega, time);
                        let point = Point::new(case, &theta, &omega);
                        let all = 0..OBSERVABLES;
                        all.map(|number| point.observable(number).0).collect()
                    }
                };
                for (number, rate) in rates.iter_mut().enumerate() {
                    let value = values[place][number];
                    *rate += side * weight * value / step;
                    largest[number] = largest[number].max(value.abs());
                }
            }
        }
        for number in 0..OBSERVABLES {
            let rounding = f64::EPSILON * largest[number] / step;
            let change = (rates[number] - last[number]).abs() + rounding;
            if change < best[number].1 {
                best[number] = (rates[number], change);
            }
        }
        last = rates;
    }
    best
}

/// With the oracle's trajectories: the whole rate along those with friction,
/// the rate less friction's part along those without.
#[test]
fn rates_are_those_along_trajectories() {
    let mut accuracy = Worst::default();
    let (mut whole, mut conservative) = (Worst::default(), Worst::default());
    for (index, case) in CASES.iter().enumerate() {
        let mut frictionless = case.tree.clone();
        for link in &mut frictionless.links {
            (link.friction, link.drag) = (0.0, 0.0);
        }
        for (theta, omega) in states(case, 100 + index as u64, 1) {
            let point = Point::new(case, &theta, &omega);
            for (tree, worst) in [(&case.tree, &mut whole), (&frictionless, &mut conservative)] {
                let differences = differences(case, tree, &theta, &omega);
                for (number, (expected, change)) in differences.into_iter().enumerate() {
                    let place = || format!("tree {index}, observable {number}: {expected}");
                    let mut rate = point.evaluate(number, "_rate");
                    let friction = format!("o_{number}_friction_rate");
                    if *tree == frictionless && case.compiled.program.entry(&friction).is_some() {
                        rate -= point.evaluate(number, "_friction_rate");
                    }
                    let size = point.observable(number).1 + expected.abs();
                    accuracy.note(change, size, place);
                    // The last refinement's change is an estimate, not a bound.
                    worst.note(rate - expected, 10.0 * change + 1e-12 * size, place);
                }
            }
        }
    }
    accuracy.assert_below(1e-9, "accuracy of the differences");
    whole.assert_below(1.0, "rate");
    conservative.assert_below(1.0, "rate without friction's part");
}

/// The chain rule with accelerations against the Poisson bracket with its
/// adjoint solve: no step in common but the mass matrix.
#[test]
fn the_bracket_gives_the_same_rates() {
    let mut worst = Worst::default();
    for (index, case) in CASES.iter().enumerate() {
        for (theta, omega) in states(case, 200 + index as u64, 5) {
            let point = Point::new(case, &theta, &omega);
            for number in 0..OBSERVABLES {
                let place = || format!("tree {index}, observable {number}");
                let rate = point.evaluate(number, "_rate");
                let bracket = point.evaluate(number, "_rate_from_momenta");
                worst.note(
                    rate - bracket,
                    point.observable(number).1 + rate.abs(),
                    place,
                );
            }
        }
    }
    worst.assert_below(1e-11, "bracket");
}

/// The paper's W, which `transfer(exact)` derives by itself, is the rate of
/// what the paper defines as H_d.
#[test]
fn the_transfer_is_the_rate_of_the_sub_hamiltonian() {
    let compiled = compile(
        "gravity = 9.80665,
        parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27, friction = 4e-4) [
            child(mass = 0.10531, com = 0.043, inertia = 0.516e-3, friction = 7e-5) * 2
        ],
        emit(transfer(exact)),
        observe(hd = p_d^2 / (4 * inertia_child) + gravity_child * sin(theta_d)^2)",
    );
    let (mut rates, mut momenta) = (Worst::default(), Worst::default());
    let mut random = Random::new(11);
    for number in 0..1000 {
        let place = || format!("state {number}");
        let q = random.around_zero(3, 3.0);
        let v = random.around_zero(3, 10.0);
        let p = compiled.evaluate("symmetric_momenta", &[&q, &v]);
        let friction = compiled.evaluate("antiphase_friction_power_from_rates", &[&q, &v])[0];
        let transfer = compiled.evaluate("transfer_exact_from_rates", &[&q, &v]);
        let size = transfer[0].abs() + transfer[1].abs() + friction.abs();
        let found = compiled.evaluate("hd_friction_rate", &[&q, &v])[0];
        rates.note(found - friction, friction, place);
        let found = compiled.evaluate("hd_rate", &[&q, &v])[0];
        rates.note(found - friction - transfer[0] - transfer[1], size, place);
        let transfer = compiled.evaluate("transfer_exact", &[&q, &p]);
        let found = compiled.evaluate("hd_rate_from_momenta", &[&q, &p])[0];
        momenta.note(found - friction - transfer[0] - transfer[1], size, place);
    }
    rates.assert_below(1e-13, "rate");
    momenta.assert_below(1e-12, "rate from momenta");
}
