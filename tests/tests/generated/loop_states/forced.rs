//! Driven trees, those with offsets whose energies are asked for, and those with
//! children at several places.

use branched_pendulum::Pendulum;
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::{Dual, Lanes};
use branched_pendulum_compiler_tests::random::Random;

use super::{TIME, batch_agrees, derivatives_agree, lanes_meet_the_plain_method};

/// The root is above the first subtree.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 8, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7, friction = 1e-4),
    drive(torque = 0.4 * cos(3 * t), x = 0.2 * sin(5 * t), y = 0.1 * cos(4 * t)),
    emit(energies),
)]
struct Shaken;

/// The root is the first link of a subtree.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 5, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7, code = loops),
    drive(torque = 0.4 * cos(3 * t)),
)]
struct Turned;

/// The root carries the leaves.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 2, branching = 90, shape = rod, mass = 0.12, length = 0.3,
        drag = 1e-4),
    drive(torque = 0.4 * cos(3 * t), y = 0.1 * cos(4 * t)),
)]
struct Wheel;

#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 4, branching = 3, mass = 0.2, com = (-0.05, 0.02), inertia = 1e-4,
        joint = (0, 0.2), mass_ratio = 0.4, length_ratio = 0.8, friction = 2e-4, drag = 1e-4,
        spring = 3e-3, code = loops),
    emit(energies),
)]
struct Crooked;

#[branched_pendulum(
    gravity = 9.80665,
    code = loops,
    trunk(mass = 0.3, com = (0.2, 0.1), inertia = 1e-3, joint = (0.4, 0.1), spring = 0.3) [
        twig: point(mass = 0.05, length = 0.2),
        bough(mass = 0.1, com = 0.15, inertia = 1e-4, joint = (0, -0.3), friction = 1e-4) [
            stick(mass = 0.03, com = (0.05, -0.05), inertia = 1e-5) * 3,
            hub(mass = 0.01, com = 0, inertia = 1e-5),
        ],
    ],
    drive(torque = push * cos(3 * t), x = 0.2 * sin(5 * t)),
    emit(energies),
)]
struct Bush;

/// Without forces: nothing is read of joints.
#[branched_pendulum(
    gravity = 9.80665,
    code = loops,
    beam: rod(mass = 0.3, length = 0.4) [
        hook: point(mass = 0.05, length = 0.2, at = 0.1),
        bar: rod(mass = 0.1, length = 0.3, at = 0.25) [
            stick: rod(mass = 0.03, length = 0.1) * 3,
            leaf: disc(mass = 0.01, length = 0.05, radius = 0.02, at = -0.1),
            twin: rod(mass = 0.02, length = 0.15, at = 0) [
                tip: point(mass = 0.01, length = 0.05),
            ],
        ],
        tail: rod(mass = 0.02, length = 0.1),
    ],
)]
struct Rack;

#[branched_pendulum(
    gravity = 9.80665,
    code = loops,
    beam(mass = 0.2, com = (0.01, -0.03), inertia = 1e-3, friction = 1e-4, spring = 0.03) [
        left(mass = 0.1, com = (0.1, 0.01), inertia = 1e-4, at = (0.02, -0.2), spring = 0.01) [
            inner: rod(mass = 0.04, length = 0.1, at = (0, 0.05), drag = 2e-4),
            outer(mass = 0.04, com = (0, 0.1), inertia = 0, at = (0, -0.1), friction = 1e-5) * 2,
        ] * 2,
        right: rod(mass = 0.15, length = 0.2, at = (0.02, 0.2), friction = 1e-4) [
            fork: generations(count = 3, branching = 2, shape = rod, mass = 0.02, length = 0.1,
                length_ratio = 0.8, friction = 1e-5),
        ],
    ],
    drive(torque = 0.4 * cos(3 * t), x = 0.2 * sin(5 * t), y = 0.1 * cos(4 * t)),
    emit(energies),
)]
struct Mobile;

fn bush(push: f64) -> Bush {
    Bush::new(BushParameters { push }).unwrap()
}

#[test]
fn batches_of_driven_trees_have_the_bits_of_single_states() {
    let bits = |x: &f64| x.to_bits();
    batch_agrees(&Shaken::<f64>::new(), bits);
    batch_agrees(&Turned::<f64>::new(), bits);
    batch_agrees(&Wheel::<f64>::new(), bits);
    batch_agrees(&bush(0.4), bits);
    batch_agrees(&Shaken::<f32>::default(), |x| u64::from(x.to_bits()));
}

#[test]
fn batches_of_crooked_trees_have_the_bits_of_single_states() {
    batch_agrees(&Crooked::<f64>::new(), |x| x.to_bits());
}

#[test]
fn batches_of_tables_with_places_have_the_bits_of_single_states() {
    batch_agrees(&Rack::<f64>::new(), |x| x.to_bits());
    batch_agrees(&Mobile::<f64>::new(), |x| x.to_bits());
    batch_agrees(&Mobile::<f32>::default(), |x| u64::from(x.to_bits()));
}

#[test]
fn trajectories_of_forced_trees_in_lanes() {
    lanes_meet_the_plain_method(&Turned::<f64>::new());
    lanes_meet_the_plain_method(&bush(0.4));
    lanes_meet_the_plain_method(&Mobile::<f64>::new());
}

/// Every lane has the time and the drive of its own trajectory.
#[test]
fn driven_trees_that_differ_in_lanes() {
    let mut random = Random::new(17);
    let mut release = |i: u32| {
        let start = State {
            time: 0.1 * f64::from(i),
            values: random.around_zero(2 * Bush::LINKS, 0.4),
        };
        (AbsoluteAngles(bush(0.1 * f64::from(i))), start)
    };
    let releases: Vec<(AbsoluteAngles<Bush>, State<f64>)> = (0..11).map(&mut release).collect();
    let (method, end) = (Dop853::new(Options::with_tolerance(1e-9)), 1.5);
    let lanes = Ensemble::new().integrate_models_in_lanes(&method, &releases, end);
    for ((model, start), lane) in releases.iter().zip(lanes) {
        let lane = lane.unwrap().state;
        let plain = method.run(model, start, end).unwrap();
        assert_eq!(lane.time, end);
        for (lane, plain) in lane.values.iter().zip(&plain.state.values) {
            assert!((lane - plain).abs() < 1e-6, "{lane} {plain}");
        }
    }
}

#[test]
fn dual_numbers_of_cast_forced_models() {
    derivatives_agree(&Shaken::<f64>::new(), 5);
    derivatives_agree(&Turned::<f64>::new(), 0);
    derivatives_agree(&Crooked::<f64>::new(), 2);
    derivatives_agree(&bush(0.4), 2);
    derivatives_agree(&Rack::<f64>::new(), 2);
    derivatives_agree(&Mobile::<f64>::new(), 2);
}

/// ∂ω̇/∂t by dual numbers, against differences.
fn drives_vary<P: Pendulum<f64>>(model: &P) {
    let mut random = Random::new(5);
    let (theta, omega) = (
        random.around_zero(model.links(), 3.0),
        random.around_zero(model.links(), 9.0),
    );
    let at = |time: f64| {
        let mut alpha = vec![0.0; model.links()];
        model.accelerations_into(time, &theta, &omega, &mut alpha);
        alpha
    };
    let mut rates = vec![f64::NAN; model.links()];
    model.cast(Dual::<f64, 1>::constant).evaluate(
        Dual::variable(TIME, 0),
        |i| Dual::constant(theta[i]),
        |i| Dual::constant(omega[i]),
        |i, value| rates[i] = value.tangents[0],
    );
    let size = rates
        .iter()
        .fold(0.0, |size: f64, rate| size.max(rate.abs()));
    assert!(size > 1.0, "{size}");
    for (i, (later, earlier)) in at(TIME + 1e-5).iter().zip(at(TIME - 1e-5)).enumerate() {
        let difference = (later - earlier) / 2e-5;
        assert!((rates[i] - difference).abs() < 1e-6 * size, "{i}");
    }
}

#[test]
fn dual_numbers_of_drives() {
    drives_vary(&Shaken::<f64>::new());
    drives_vary(&Turned::<f64>::new());
    drives_vary(&bush(0.4));
    drives_vary(&Mobile::<f64>::new());
}

/// The energies of a cast model: the same bits in lanes, and in dual numbers
/// dE/dt along the motion, which is the power of the forces.
fn energies_go_along<P: Pendulum<f64> + Energy<f64>>(
    model: &P,
    power: impl Fn(&[f64], &[f64]) -> f64,
) where
    P::Of<Lanes<f64, 2>>: Energy<Lanes<f64, 2>>,
    P::Of<Dual<f64, 1>>: Energy<Dual<f64, 1>>,
{
    let (n, mut random) = (model.links(), Random::new(5));
    let (theta, omega) = (random.around_zero(n, 3.0), random.around_zero(n, 9.0));
    let lanes = model.cast(|number| Lanes([number; 2]));
    let splat = |numbers: &[f64]| -> Vec<_> { numbers.iter().map(|&x| Lanes([x; 2])).collect() };
    let (kinetic, potential) = (
        lanes.kinetic_energy_of(&splat(&theta), &splat(&omega)),
        lanes.potential_energy_of(&splat(&theta)),
    );
    assert_eq!(kinetic.0, [model.kinetic_energy_of(&theta, &omega); 2]);
    assert_eq!(potential.0, [model.potential_energy_of(&theta); 2]);

    let mut alpha = vec![0.0; n];
    model.accelerations_into(TIME, &theta, &omega, &mut alpha);
    let along = |values: &[f64], rates: &[f64]| -> Vec<Dual<f64, 1>> {
        let pairs = values.iter().zip(rates);
        pairs
            .map(|(&value, &rate)| Dual {
                value,
                tangents: [rate],
            })
            .collect()
    };
    let duals = model.cast(Dual::<f64, 1>::constant);
    let (theta_duals, omega_duals) = (along(&theta, &omega), along(&omega, &alpha));
    let rates = [
        duals.kinetic_energy_of(&theta_duals, &omega_duals),
        duals.potential_energy_of(&theta_duals),
    ]
    .map(|energy| energy.tangents[0]);
    let size = rates[0].abs() + rates[1].abs();
    let power = power(&theta, &omega);
    assert!(power.abs() > 1e-6 * size);
    assert!((rates[0] + rates[1] - power).abs() < 1e-10 * size);
}

#[test]
fn energies_of_cast_models() {
    let shaken = Shaken::<f64>::new();
    energies_go_along(&shaken, |theta, omega| {
        shaken.drive_power(TIME, theta, omega) + shaken.friction_power(omega)
    });
    let bush = bush(0.4);
    energies_go_along(&bush, |theta, omega| {
        bush.drive_power(TIME, theta, omega) + bush.friction_power(omega)
    });
    let mobile = Mobile::<f64>::new();
    energies_go_along(&mobile, |theta, omega| {
        mobile.drive_power(TIME, theta, omega) + mobile.friction_power(omega)
    });
}
