//! Taylor coefficients of described trees, against their equations of motion.

use branched_pendulum::integrate::{Crossing, Event, IntegrationError};
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Double;
use branched_pendulum::system::TaylorPendulum;
use branched_pendulum::taylor::Quad;
use branched_pendulum_trees::{PendulumTree, TreeDescription};

/// Trees with all that a link can have, of numbers of links around those of a register.
const TREES: [&str; 11] = [
    "gravity = 9.81, rod: rod(mass = 0.2, length = 0.4)",
    "gravity = 9.81, rod: rod(mass = 0.2, length = 0.4, friction(coulomb = 0.02)),
     drive(torque = 0.3 * cos(5 * t) + 0.1 * t, x = 0.02 * sin(3 * t)^2)",
    "gravity = 9.80665,
     parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
         child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
     ]",
    "gravity = -9.81,
     reed: rod(mass = 0.2, length = 0.4, spring = 3, friction = 1e-3) [
         ear(mass = 0.05, com = (0.03, 0.02), inertia = 1e-4, spring = 0.2, rest = 0.3) * 2,
         leaf: rod(mass = 0.02, length = 0.1, at = (0.3, 0.01), drag = 1e-4),
     ],
     drive(y = 0.01 * cos(6 * t), x = 0.02 * sin(2 * t + 0.3) * cos(t))",
    "gravity = 9.80665,
     limb(mass = 0.4, com = (0.2, 0.03), inertia = 2e-3, joint = 0.5,
         friction(viscous = 1e-3, coulomb = 0.05, static = 0.07, stribeck = 0.6,
             quadratic = 2e-3, width = 0.3)) [
         twig: rod(mass = 0.1, length = 0.3, at = (0.4, 0.05), drag(quadratic = 1e-3)) * 2,
         leaf: rod(mass = 0.05, length = 0.2, spring = 0.02, friction(coulomb = 0.01)),
     ]",
    "gravity = 9.81,
     a: rod(mass = 0.4, length = 0.5) [
         b: rod(mass = 0.2, length = 0.35) [c: rod(mass = 0.1, length = 0.245) * 2] * 2
     ]",
    "gravity = 9.81,
     a: rod(mass = 0.4, length = 0.5) [
         b: rod(mass = 0.2, length = 0.35) [c: rod(mass = 0.1, length = 0.245) * 2] * 2,
         d: rod(mass = 0.3, length = 0.2, friction = 1e-3),
     ],
     drive(torque = 0.2 * sin(4 * t), y = 0.02 * cos(3 * t))",
    "gravity = 9.81,
     a: rod(mass = 0.4, length = 0.5, friction = 1e-3) [
         b: rod(mass = 0.2, length = 0.35, spring = 0.1) [c: rod(mass = 0.1, length = 0.2) * 3] * 2
     ]",
    "gravity = 9.81,
     arm: generations(count = 4, branching = 2, shape = rod, mass = 0.12, length = 0.3,
         mass_ratio = 0.5, length_ratio = 0.7, friction = 1e-3)",
    "gravity = 9.81,
     a: rod(mass = 0.4, length = 0.5) [b: rod(mass = 0.2, length = 0.35) * 2],
     between(a, b_2, spring = 0.5, rest = 0.3)",
    "gravity = 9.81,
     arm: generations(count = 3, branching = 2, shape = rod, mass = 0.12, length = 0.3,
         mass_ratio = 0.5, length_ratio = 0.7, friction(coulomb = 0.01)),
     siblings(arm_3, spring = 0.1, friction = 1e-3),
     between(arm_1, arm_3_1_2, spring = 0.2, rest = -0.4,
         friction(coulomb = 0.02, quadratic = 1e-3, width = 0.2))",
];

fn trees() -> impl Iterator<Item = PendulumTree> {
    TREES.iter().map(|text| PendulumTree::parse(text).unwrap())
}

/// Angles and angular velocities that no symmetry has.
fn state(links: usize, seed: usize) -> Vec<f64> {
    let angle = |i: usize| 1.3 * (1.7 * i as f64 + 0.9 * seed as f64 + 0.4).sin();
    (0..2 * links).map(angle).collect()
}

fn coefficients<P: TaylorPendulum<f64>>(tree: &P, time: f64, y: &[f64], order: usize) -> Vec<f64> {
    let mut coefficients = vec![f64::NAN; y.len() * (order + 1)];
    // Numbers that stand in the workspace before do not count.
    let mut work = vec![Quad([f64::NAN; 4]); tree.taylor_workspace(order)];
    let (theta, omega) = y.split_at(tree.links());
    tree.taylor_coefficients_into(time, theta, omega, &mut coefficients, &mut work);
    coefficients
}

/// The polynomial of an order at a time after the start.
fn polynomial(coefficients: &[f64], components: usize, order: usize, tau: f64) -> Vec<f64> {
    let rows = coefficients.chunks(components).take(order + 1).rev();
    rows.fold(vec![0.0; components], |sum, row| {
        sum.iter().zip(row).map(|(sum, c)| sum * tau + c).collect()
    })
}

fn largest(a: &[f64], b: &[f64]) -> f64 {
    let differences = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max)
}

#[test]
fn all_trees_are_read() {
    for text in TREES {
        if let Err(error) = PendulumTree::parse(text) {
            panic!("{error}");
        }
    }
}

/// The reference is another method on the equations for accelerations, in numbers of
/// 32 digits. The orders that decide are so high that those below are seen to be right.
#[test]
fn polynomials_are_the_motion() {
    const ORDER: usize = 30;
    for (index, tree) in trees().enumerate() {
        let components = 2 * tree.links();
        let exact = tree.cast(Double::from_f64);
        for seed in 0..3 {
            let (time, y) = (0.3 * seed as f64, state(tree.links(), seed));
            let coefficients = coefficients(&tree, time, &y, ORDER);
            // Where order 12 is needed for the twelfth digit.
            let size = |k: usize, tau: f64| {
                let row = &coefficients[k * components..][..components];
                row.iter().fold(0.0_f64, |size, c| size.max(c.abs())) * tau.powi(k as i32)
            };
            let mut tau = 0.2;
            while size(28, tau) > 1e-16 {
                tau *= 0.9;
            }
            assert!(size(12, tau) > 1e-11, "tree {index}: {}", size(12, tau));
            let start = State::new(
                Double::from_f64(time),
                y.iter().copied().map(Double::from_f64).collect(),
            );
            let method = Dop853::new(Options::with_tolerance(Double::from_f64(1e-19)));
            let end = Double::from_f64(time) + Double::from_f64(tau);
            let system = AbsoluteAngles(&exact);
            let end = method.run(&system, &start, end).unwrap().state;
            let right: Vec<f64> = end.values.iter().map(|value| value.high()).collect();
            let own = polynomial(&coefficients, components, ORDER, tau);
            let error = largest(&own, &right);
            // Light links turn at tens of radians a second.
            let whole = right
                .iter()
                .fold(1.0_f64, |whole, own| whole.max(own.abs()));
            assert!(
                error < 1e-13 * whole,
                "tree {index}, state {seed}: {error:e}"
            );
        }
    }
}

/// Orders 0 and 1 are the state and its accelerations; what does not fit gives no number.
#[test]
fn low_orders_are_the_accelerations() {
    for (index, tree) in trees().enumerate() {
        let (links, y) = (tree.links(), state(tree.links(), 5));
        let (theta, omega) = y.split_at(links);
        let alpha = tree.accelerations(0.7, theta, omega);
        let size = largest(&alpha, &vec![0.0; links]);
        for order in [0, 1, 2, 3, 27, 28, 31] {
            let rows = coefficients(&tree, 0.7, &y, order);
            assert_eq!(rows[..2 * links], y, "tree {index}, order {order}");
            let Some(first) = rows.get(2 * links..4 * links) else {
                continue;
            };
            assert_eq!(first[..links], *omega);
            let error = largest(&first[links..], &alpha);
            assert!(
                error < 1e-13 * size,
                "tree {index}, order {order}: {error:e}"
            );
        }
        let mut short = vec![Quad([0.0; 4]); tree.taylor_workspace(4) - 1];
        let mut rows = vec![0.0; 10 * links];
        tree.taylor_coefficients_into(0.7, theta, omega, &mut rows, &mut short);
        assert!(rows.iter().all(|number| number.is_nan()));
        let mut work = vec![Quad([0.0; 4]); tree.taylor_workspace(4)];
        let mut rows = vec![0.0; 10 * links];
        tree.taylor_coefficients_into(0.7, &theta[1..], omega, &mut rows, &mut work);
        assert!(rows.iter().all(|number| number.is_nan()));
    }
}

/// One state, dense output and events, against another method.
#[test]
fn motions_keep_their_tolerance() -> Result<(), IntegrationError<f64>> {
    for (index, tree) in trees().enumerate() {
        let (links, system) = (tree.links(), AbsoluteAngles(&tree));
        let start = State::new(0.2, state(links, 3));
        let times: Vec<f64> = (1..=20).map(|i| 0.2 + 0.03 * f64::from(i)).collect();
        let taylor = Taylor::new(Options::with_tolerance(1e-13));
        let dop = Dop853::new(Options::with_tolerance(1e-14));
        let reached = taylor.sample_to_vec(&system, &start, &times)?;
        let right = dop.sample_to_vec(&system, &start, &times)?;
        assert_eq!(reached.len(), times.len());
        for (own, right) in reached.iter().zip(&right) {
            let error = largest(&own.values, &right.values);
            assert!(error < 1e-10, "tree {index}: {error:e}");
        }
        let turning = |_: f64, y: &[f64]| y[links];
        let events = [Event::new(Crossing::Either, &turning)];
        let mut crossings = [Vec::new(), Vec::new()];
        let [of_taylor, of_dop] = &mut crossings;
        taylor.integrate_with_events(&system, &start, 0.8, &events, |found| {
            of_taylor.push(found.time);
            ControlFlow::Continue(())
        })?;
        dop.integrate_with_events(&system, &start, 0.8, &events, |found| {
            of_dop.push(found.time);
            ControlFlow::Continue(())
        })?;
        assert_eq!(of_taylor.len(), of_dop.len(), "tree {index}");
        assert!(largest(of_taylor, of_dop) < 1e-10, "tree {index}");
    }
    Ok(())
}

/// In lanes the bits depend on a start alone, and the plain method is met; so are trees that
/// differ in a parameter.
#[test]
fn lanes_hold_motions_of_their_own() {
    let method = Taylor::new(Options::with_tolerance(1e-11));
    for tree in trees() {
        let links = tree.links();
        let system = AbsoluteAngles(&tree);
        let starts: Vec<State<f64>> = (0..19)
            .map(|seed| State::new(0.1 * seed as f64, state(links, seed)))
            .collect();
        let lanes = Ensemble::new().integrate_in_lanes(&method, &system, &starts, 2.5);
        let turned: Vec<State<f64>> = starts.iter().rev().cloned().collect();
        let others = Ensemble::new().integrate_in_lanes(&method, &system, &turned, 2.5);
        let plain = Ensemble::new().integrate(&method, &system, &starts, 2.5);
        for ((lane, other), plain) in lanes.iter().zip(others.iter().rev()).zip(&plain) {
            let [lane, other, plain] = [lane, other, plain].map(|end| &end.as_ref().unwrap().state);
            assert_eq!(lane, other);
            assert!(largest(&lane.values, &plain.values) < 1e-6);
        }
    }
    let description = TreeDescription::parse(
        "gravity = 9.81, limb: rod(mass = 0.3, length = 0.4, friction = c) [
             twig: rod(mass = m, length = 0.2, friction(coulomb = c, width = 0.2)) * 2
         ],
         drive(torque = 0.1 * cos(p * t))",
    );
    let description = description.unwrap();
    let scan: Vec<_> = (1..12)
        .map(|i| {
            let part = f64::from(i);
            let values = [("c", 1e-3 * part), ("m", 0.02 * part), ("p", 0.5 * part)];
            let tree = description.tree(&values).unwrap();
            (AbsoluteAngles(tree), State::new(0.0, state(3, 1)))
        })
        .collect();
    let lanes = Ensemble::new().integrate_models_in_lanes(&method, &scan, 2.0);
    for (lane, (system, start)) in lanes.iter().zip(&scan) {
        let one = std::slice::from_ref(start);
        let alone = Ensemble::new().integrate_in_lanes(&method, system, one, 2.0);
        let plain = Ensemble::new().integrate(&method, system, one, 2.0);
        let [lane, alone, plain] =
            [lane, &alone[0], &plain[0]].map(|end| &end.as_ref().unwrap().state);
        assert_eq!(lane, alone);
        assert!(largest(&lane.values, &plain.values) < 1e-8);
    }
}
