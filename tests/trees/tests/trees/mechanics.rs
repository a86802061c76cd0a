//! The mechanics of a described tree, one part against another.

use branched_pendulum::analysis::ModesError;
use branched_pendulum::ensemble::Ensemble;
use branched_pendulum::integrate::{Projected, Rk4};
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Double;
use branched_pendulum::system::{LinkPoint, TotalEnergy, UnderTorques};
use branched_pendulum_trees::{PendulumTree, TreeDescription};

/// Everything that a link can have.
pub(crate) const BENT: &str = "gravity = 9.80665,
    limb(mass = 0.4, com = (0.2, 0.03), inertia = 2e-3, joint = 0.5, friction = 1e-3) [
        bough(mass = 0.1, com = (0.12, 0.01), inertia = 1e-3, at = (0.3, -0.02),
            joint = (0.25, 0.03), spring = 0.1, rest = 0.2) [
            twig: rod(mass = m, length = 0.3, drag = 1e-4) * 2
        ],
        shoot(mass = 0.05, com = 0.1, inertia = 1e-4,
            friction(viscous = 1e-3, coulomb = 0.02, static = 0.03, stribeck = 0.8,
            quadratic = 1e-3), drag(quadratic = 1e-4)),
    ],
    between(twig_2, shoot, spring = 0.3, rest = 0.2,
        friction(coulomb = 0.02, static = 0.05, stribeck = 0.3, viscous = 2e-3)),
    siblings(twig, spring = 0.1, friction = 1e-3),
    drive(torque = 0.01 * cos(3 * t), x = 0.02 * sin(2 * t)^2)";

pub(crate) fn bent() -> PendulumTree {
    let description = TreeDescription::parse(BENT).unwrap();
    description.tree(&[("m", 0.07)]).unwrap()
}

pub(crate) const THETA: [f64; 5] = [0.4, -1.1, 2.0, 0.3, -0.6];
pub(crate) const OMEGA: [f64; 5] = [1.0, -2.0, 0.5, 3.0, -0.2];

pub(crate) fn near(left: f64, right: f64, tolerance: f64) {
    let size = left.abs().max(right.abs()).max(1e-3);
    assert!((left - right).abs() <= tolerance * size, "{left} {right}");
}

/// M α = Q − Christoffel terms − ∂U/∂θ + friction: along a motion dE/dt is the power of all
/// that is not conservative.
#[test]
fn the_rate_of_the_energy_is_the_power_of_all_forces() {
    let tree = bent();
    let torques = [0.03, -0.02, 0.01, 0.0, 0.005];
    let time = 0.7;
    let mut alpha = [0.0; 5];
    tree.accelerations_under_into(time, &THETA, &OMEGA, &torques, &mut alpha);
    let mut slopes = [0.0; 10];
    let state: Vec<f64> = THETA.into_iter().chain(OMEGA).collect();
    let energy: f64 = TotalEnergy::new(&tree).evaluate(&state, &mut slopes);
    assert_eq!(energy, tree.energy_of(&THETA, &OMEGA));
    let rates = OMEGA.iter().chain(&alpha);
    let rate: f64 = slopes
        .iter()
        .zip(rates)
        .map(|(slope, rate)| slope * rate)
        .sum();
    let power = tree.friction_power(&THETA, &OMEGA)
        + tree.outside_power(&OMEGA, &torques)
        + tree.drive_power(time, &THETA, &OMEGA);
    near(rate, power, 1e-12);
}

/// x = 0.02 sin² 2t has ẍ = 0.16 cos 4t.
#[test]
fn a_drive_is_differentiated_exactly() {
    let tree = bent();
    let [x, y, torque] = tree.drive(0.7).unwrap();
    near(x, 0.16 * (4.0 * 0.7_f64).cos(), 1e-14);
    assert_eq!(y, 0.0);
    near(torque, 0.01 * (3.0 * 0.7_f64).cos(), 1e-15);
}

#[test]
fn momenta_are_the_mass_matrix_times_the_velocities() {
    let tree = bent();
    let mass = tree.mass_matrix(&THETA);
    let momenta = tree.momenta(&THETA, &OMEGA);
    for (row, momentum) in mass.iter().zip(&momenta) {
        let product: f64 = row.iter().zip(&OMEGA).map(|(m, w)| m * w).sum();
        near(product, *momentum, 1e-13);
    }
    let kinetic: f64 = momenta.iter().zip(&OMEGA).map(|(p, w)| 0.5 * p * w).sum();
    near(kinetic, tree.kinetic_energy_of(&THETA, &OMEGA), 1e-13);
}

/// The centres of mass fall as the potential energy rises, and forces on them do the work
/// that their torques do.
#[test]
fn forces_work_as_their_torques_do() {
    let tree = bent();
    let forces = [[0.1, 0.2], [-0.3, 0.1], [0.2, 0.0], [0.0, -0.4], [0.5, 0.1]];
    for point in LinkPoint::ALL {
        let velocities = tree.point_velocities(point, &THETA, &OMEGA);
        let work: f64 = velocities
            .iter()
            .zip(&forces)
            .map(|(v, f)| v[0] * f[0] + v[1] * f[1])
            .sum();
        let torques = tree.point_torques(point, &THETA, &forces);
        near(work, tree.outside_power(&OMEGA, &torques), 1e-13);
    }
    let lengths = tree.points(LinkPoint::End, &[0.0; 5]);
    near(lengths[0][1], -0.5, 1e-15);
    assert!(tree.properties_of(5).is_none());
}

#[test]
fn a_parameter_gives_the_tree_of_its_value() {
    let tree = bent().with("m", 0.05).unwrap();
    let text = BENT.replace("mass = m", "mass = 0.05");
    let literal = PendulumTree::parse(&text).unwrap();
    let [own, other] = [&tree, &literal].map(|tree| tree.accelerations(0.2, &THETA, &OMEGA));
    for (own, other) in own.iter().zip(&other) {
        near(*own, *other, 1e-14);
    }
    assert_eq!(tree.value("m"), Some(0.05));
    let wrong = tree.with("m", -1.0).unwrap_err().to_string();
    assert_eq!(
        wrong,
        "mass of `twig` is -1, must be finite and not negative"
    );
    let unknown = tree.with("n", 1.0).unwrap_err().to_string();
    assert_eq!(unknown, "no parameter `n`: there are `m`");
    let missing = PendulumTree::parse(BENT).unwrap_err().to_string();
    assert_eq!(missing, "no value for `m`");
}

#[test]
fn other_scalars_compute_the_same_tree() {
    let tree = bent();
    let double: PendulumTree<Double> = tree.description().tree(&[("m", 0.07)]).unwrap();
    let wide = |numbers: [f64; 5]| numbers.map(Double::from_f64);
    let time = Double::from_f64(0.7);
    let precise = double.accelerations(time, &wide(THETA), &wide(OMEGA));
    let plain = tree.accelerations(0.7, &THETA, &OMEGA);
    for (plain, precise) in plain.iter().zip(&precise) {
        near(*plain, precise.high(), 1e-13);
    }
    let single = tree.cast(|value| value as f32);
    let alpha = single.accelerations(0.7, &THETA.map(|x| x as f32), &OMEGA.map(|x| x as f32));
    for (plain, single) in plain.iter().zip(&alpha) {
        near(*plain, f64::from(*single), 1e-4);
    }
}

/// Methods of every kind, one of them held to the energy, agree about a motion.
#[test]
fn methods_agree() {
    let tree = PendulumTree::parse(
        "gravity = 9.81, tree: generations(count = 3, branching = 2, shape = rod, mass = 0.2,
            length = 0.3, length_ratio = 0.7)",
    )
    .unwrap();
    let start = State::at_rest(0.0, &[0.5, 0.4, -0.3, 0.2, 0.1, 0.0, -0.2]);
    let options = Options::with_tolerance(1e-12);
    let system = AbsoluteAngles(&tree);
    let ends = [
        Dop853::new(options.clone()).run(&system, &start, 2.0),
        Verner98::new(options.clone()).run(&system, &start, 2.0),
        Dopri5::new(options).run(&system, &start, 2.0),
        Gauss::new(GaussOrder::Six, 1e-3).run(&system, &start, 2.0),
        Rk4::new(1e-4).run(&system, &start, 2.0),
    ];
    let ends = ends.map(|end| end.unwrap().state);
    for end in &ends[1..] {
        for (own, first) in end.values.iter().zip(&ends[0].values) {
            assert!((own - first).abs() < 1e-8, "{own} {first}");
        }
    }
    let held = Projected::new(Gauss::new(GaussOrder::Two, 0.01), TotalEnergy::new(&tree));
    let end = held.run(&system, &start, 2.0).unwrap().state;
    let energy = |state: &State<f64>| tree.energy_of(state.positions(), state.velocities());
    near(energy(&end), energy(&start), 1e-13);
}

#[test]
fn ensembles_in_lanes_compute_what_one_thread_computes() {
    let tree = bent();
    let starts: Vec<State<f64>> = (0..11)
        .map(|i| State::at_rest(0.0, &THETA.map(|angle| angle * (1.0 + 0.01 * f64::from(i)))))
        .collect();
    let method = Dop853::new(Options::with_tolerance(1e-11));
    let system = AbsoluteAngles(&tree);
    let lanes = Ensemble::new().integrate_in_lanes(&method, &system, &starts, 1.0);
    let plain = Ensemble::new().integrate(&method, &system, &starts, 1.0);
    for (lane, plain) in lanes.iter().zip(&plain) {
        let [lane, plain] = [lane, plain].map(|end| &end.as_ref().unwrap().state.values);
        for (lane, plain) in lane.iter().zip(plain) {
            assert!((lane - plain).abs() < 1e-7, "{lane} {plain}");
        }
    }
    // Trees that differ in a mass.
    let releases: Vec<(AbsoluteAngles<PendulumTree>, State<f64>)> = (1..10)
        .map(|i| tree.with("m", 0.02 * f64::from(i)).unwrap())
        .map(|tree| (AbsoluteAngles(tree), starts[0].clone()))
        .collect();
    let lanes = Ensemble::new().integrate_models_in_lanes(&method, &releases, 1.0);
    for (lane, (tree, start)) in lanes.iter().zip(&releases) {
        let plain = method.run(tree, start, 1.0).unwrap();
        let lane = &lane.as_ref().unwrap().state.values;
        for (lane, plain) in lane.iter().zip(&plain.state.values) {
            assert!((lane - plain).abs() < 1e-7, "{lane} {plain}");
        }
    }
    // Trees of another shape cannot share lanes.
    let other = PendulumTree::parse(
        "gravity = 9.81, a: rod(mass = 1, length = 1, friction = 1e-3) [b: rod(mass = 1, length = 1) [
            c: rod(mass = 1, length = 1) [d: rod(mass = 1, length = 1) [e: rod(mass = 1, length = 1)]]]]",
    );
    let mixed = [
        (AbsoluteAngles(tree.clone()), starts[0].clone()),
        (AbsoluteAngles(other.unwrap()), starts[0].clone()),
    ];
    let ends = Ensemble::new().integrate_models_in_lanes(&method, &mixed, 1.0);
    assert!(ends.iter().any(Result::is_err));
}

#[test]
fn a_vector_of_torques_holds_a_tree() {
    let tree = bent();
    let still = [0.3, 0.2, 0.1, -0.1, 0.2];
    let undriven = BENT.split(",\n    drive").next().unwrap();
    let description = TreeDescription::parse(undriven).unwrap();
    let tree_at_rest: PendulumTree = description.tree(&[("m", 0.07)]).unwrap();
    let alpha = tree_at_rest.accelerations(0.0, &still, &[0.0; 5]);
    let mass = tree.mass_matrix(&still);
    let holding: Vec<f64> = mass
        .iter()
        .map(|row| -row.iter().zip(&alpha).map(|(m, a)| m * a).sum::<f64>())
        .collect();
    let held = UnderTorques::of(tree_at_rest, holding);
    let mut rates = [0.0; 10];
    let state = State::at_rest(0.0, &still);
    held.rates(0.0, &state.values, &mut rates);
    assert!(rates.iter().all(|rate| rate.abs() < 1e-12), "{rates:?}");
}

/// A single rod on a driven pivot, with a motor: θ̈ = −(3/2l)(g sin θ + ẍ cos θ) + τ/(ml²/3).
#[test]
fn a_single_link_takes_its_drive() {
    let rod = PendulumTree::parse(
        "gravity = 9.81, rod: rod(mass = 0.2, length = 0.5),
         drive(torque = 0.03 * t, x = 0.5 * t^2)",
    )
    .unwrap();
    let alpha = rod.accelerations(2.0, &[0.4], &[1.0])[0];
    let inertia = 0.2 * 0.25 / 3.0;
    let expected = (0.06 - 0.2 * 0.25 * (9.81 * 0.4_f64.sin() + 0.4_f64.cos())) / inertia;
    near(alpha, expected, 1e-14);
    // A torque from outside adds to the drive's.
    let mut more = [0.0];
    rod.accelerations_under_into(2.0, &[0.4], &[1.0], &[0.01], &mut more);
    near(more[0] - alpha, 0.01 / inertia, 1e-12);
}

#[test]
fn slices_of_another_length_give_nan() {
    let tree = bent();
    assert!(
        tree.accelerations(0.0, &[0.0; 3], &[0.0; 5])
            .iter()
            .all(|a| a.is_nan())
    );
    assert!(tree.kinetic_energy_of(&THETA, &[0.0]).is_nan());
    assert!(tree.momenta(&THETA, &[]).iter().all(|p| p.is_nan()));
    assert!(tree.momenta(&[], &OMEGA).iter().all(|p| p.is_nan()));
    let matrices = [
        tree.mass_matrix(&[0.0; 6]),
        tree.stiffness_matrix(&[0.0; 3]),
    ];
    assert!(
        matrices
            .iter()
            .flatten()
            .flatten()
            .all(|entry| entry.is_nan())
    );
    assert!(tree.modes(&[0.0; 2]).is_err());
    let mut rates = [0.0; 3];
    AbsoluteAngles(&tree).rates(0.0, &[0.0; 10], &mut rates);
    assert!(rates.iter().all(|rate| rate.is_nan()));
}

/// Frequencies are those of small motions about rest, and of nothing else.
#[test]
fn modes_are_those_of_an_equilibrium() {
    for (text, aside, inverted) in [
        ("rod: rod(mass = 2, length = 0.5)", [0.1, 0.0, 0.0], true),
        (
            "a: rod(mass = 1, length = 0.3) [b: rod(mass = 0.2, length = 0.4) * 2]",
            [1.0, 0.0, 0.0],
            true,
        ),
        (
            "a: rod(mass = 1, length = 0.3, spring = 0.7, rest = 0.4) [
                b(mass = 0.2, com = (0.1, 0.03), inertia = 1e-3)
            ]",
            [0.0; 3],
            false,
        ),
        // The twig weighs a millionth of the trunk.
        (
            "a: rod(mass = 100, length = 3) [b: rod(mass = 1e-4, length = 0.1)]",
            [0.0, 0.01, 0.0],
            true,
        ),
    ] {
        let tree = PendulumTree::parse(&format!("gravity = 9.81, {text}")).unwrap();
        let n = tree.links();
        let error = tree.modes(&aside[..n]).unwrap_err();
        let ModesError::NotAtRest {
            torques,
            torque,
            coordinate,
        } = &error
        else {
            panic!("{text}: {error}");
        };
        assert_eq!(torques[*coordinate], *torque);
        let still = vec![0.0; n];
        let alpha = tree.accelerations(0.0, &aside[..n], &still);
        for (row, torque) in tree.mass_matrix(&aside[..n]).iter().zip(torques) {
            near(
                row.iter().zip(&alpha).map(|(m, a)| m * a).sum(),
                *torque,
                1e-12,
            );
        }
        let text = error.to_string();
        assert!(
            text.contains("not an equilibrium") && text.contains("`equilibrium`"),
            "{text}"
        );
        let rest = tree.equilibrium(&aside[..n]).unwrap();
        let alpha = tree.accelerations(0.0, &rest, &still);
        assert!(alpha.iter().all(|alpha| alpha.abs() < 1e-9), "{text}");
        let modes = tree.modes(&rest).unwrap();
        // Found to some digits, it is one.
        let rounded: Vec<f64> = rest.iter().map(|angle| angle + 1e-8).collect();
        let near_rest = tree.modes(&rounded).unwrap();
        near(modes.frequencies_hz[0], near_rest.frequencies_hz[0], 1e-6);
        if inverted {
            let upright = vec![std::f64::consts::PI; n];
            let error = tree.modes(&upright).unwrap_err();
            assert!(
                matches!(error, ModesError::NegativeStiffness { .. }),
                "{error}"
            );
        }
    }
    let error = bent().equilibrium(&[0.0; 3]).unwrap_err().to_string();
    assert!(error.contains("NaN"), "{error}");
}

/// In loops over generations and written out, in their own orders of the links.
#[test]
fn names_and_shapes_of_rules_are_those_of_models() {
    let rule = |code: &str| {
        PendulumTree::parse(&format!(
            "gravity = 9.81, code = {code}, tree: generations(count = 4, branching = 2, shape = rod,
                mass = 0.2, length = 0.3, length_ratio = 0.7)"
        ))
        .unwrap()
    };
    let (loops, unrolled) = (rule("loops"), rule("unrolled"));
    let names = loops.names();
    assert_eq!(names[..3], ["tree_1", "tree_2_1", "tree_2_2"]);
    assert_eq!(names.last().map(String::as_str), Some("tree_4_2_2_2"));
    let (mut sorted, mut others) = (names.to_vec(), unrolled.names().to_vec());
    sorted.sort();
    others.sort();
    assert_eq!(sorted, others);
    let angle = |name: &String| name.bytes().map(f64::from).sum::<f64>().sin();
    let alpha = |tree: &PendulumTree| {
        let theta: Vec<f64> = tree.names().iter().map(angle).collect();
        let alpha = tree.accelerations(0.0, &theta, &theta);
        let mut alpha: Vec<_> = tree.names().iter().cloned().zip(alpha).collect();
        alpha.sort_by(|a, b| a.0.cmp(&b.0));
        alpha
    };
    for ((name, own), (_, other)) in alpha(&loops).into_iter().zip(alpha(&unrolled)) {
        assert!((own - other).abs() < 1e-11, "{name}: {own} {other}");
    }
}
