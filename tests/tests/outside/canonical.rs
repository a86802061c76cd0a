//! Canonical variables in the lanes of vector registers and in batches, against single states and
//! absolute angles.

use branched_pendulum::prelude::*;
use branched_pendulum::system::At;
use branched_pendulum::system::functions::CanonicalRates;
use branched_pendulum_compiler_tests::random::Random;

/// A limb with two twigs, written out.
#[branched_pendulum(
    gravity = 9.80665,
    limb: rod(mass = 0.4, length = 0.5, friction = 2e-2) [
        twig: rod(mass = 0.1, length = 0.3, friction = 1e-3) * 2
    ],
    drive(torque = push * cos(3 * t)),
    emit(momenta),
)]
struct Driven;

const LINKS: usize = Driven::LINKS;

fn driven(push: f64) -> Driven {
    Driven::new(DrivenParameters { push }).expect("it is physical")
}

/// Starts in absolute angles and the same starts in canonical variables.
fn starts(count: usize) -> Vec<[State<f64>; 2]> {
    let (mut random, model) = (Random::new(17), driven(0.0));
    let start = |_| {
        let values = random.around_zero(2 * LINKS, 0.6);
        let [theta, omega] = halves(&values);
        let momenta = model.momenta(&theta, &omega);
        let canonical = State::from_positions_and_momenta(0.25, &theta, &momenta);
        [
            State::new(0.25, values),
            canonical.expect("as many momenta as angles"),
        ]
    };
    (0..count).map(start).collect()
}

fn halves(values: &[f64]) -> [[f64; LINKS]; 2] {
    [0, LINKS].map(|from| std::array::from_fn(|link| values[from + link]))
}

#[test]
fn fixed_steps_in_lanes_have_the_bits_of_single_states() {
    let (ensemble, ode) = (Ensemble::new(), CanonicalVariables(driven(0.2)));
    let starts: Vec<_> = starts(13).into_iter().map(|[_, own]| own).collect();
    let gauss = Gauss::new(GaussOrder::Six, 0.01);
    let lanes = ensemble.integrate_in_lanes(&gauss, &ode, &starts, 1.0);
    assert!(lanes.iter().all(Result::is_ok));
    assert_eq!(lanes, ensemble.integrate(&gauss, &ode, &starts, 1.0));
    let rk4 = Rk4::new(0.001);
    let lanes = ensemble.integrate_in_lanes(&rk4, &ode, &starts, 1.0);
    assert!(lanes.iter().all(Result::is_ok));
    assert_eq!(lanes, ensemble.integrate(&rk4, &ode, &starts, 1.0));
}

/// Each lane has its own torque of the drive.
#[test]
fn ensembles_in_lanes_move_as_in_absolute_angles() {
    let starts = starts(21);
    let push = |index: usize| 0.02 * index as f64;
    let releases = starts.iter().enumerate();
    let releases: Vec<_> = releases
        .map(|(index, [_, own])| (CanonicalVariables(driven(push(index))), own.clone()))
        .collect();
    let method = Dop853::new(Options::with_tolerance(1e-11));
    let ends = Ensemble::new().integrate_models_in_lanes(&method, &releases, 3.0);
    for ((index, [start, _]), end) in starts.iter().enumerate().zip(ends) {
        let model = driven(push(index));
        let [theta, momenta] = halves(&end.expect("it ends").state.values);
        let moved = [theta, model.velocities(&theta, &momenta)].concat();
        let plain = method.run(&AbsoluteAngles(&model), start, 3.0);
        let plain = plain.expect("it ends").state.values;
        for (own, plain) in moved.iter().zip(plain) {
            assert!((own - plain).abs() < 1e-7, "{own} {plain}");
        }
    }
}

#[test]
fn batches_have_the_bits_of_single_states() {
    const STATES: usize = 37;
    let (model, mut random) = (driven(0.3), Random::new(8));
    let [theta, momenta] = [3.0, 0.1].map(|size| -> Vec<Vec<f64>> {
        let column = |_| random.around_zero(STATES, size);
        (0..LINKS).map(column).collect()
    });
    let mut rates = [theta.clone(), theta.clone()];
    let [angle_rates, momentum_rates] = &mut rates;
    let results = [&mut angle_rates[..], &mut momentum_rates[..]];
    let given = [&theta[..], &momenta];
    Batch::new(&model)
        .compute(CanonicalRates, At::time(0.7), given, results)
        .expect("all slices have one length");
    for state in 0..STATES {
        let row = |columns: &[Vec<f64>]| -> Vec<f64> {
            columns.iter().map(|column| column[state]).collect()
        };
        let [mut first, mut second] = [[0.0; LINKS]; 2];
        let (theta, momenta) = (row(&theta), row(&momenta));
        model.canonical_rates_into(0.7, &theta, &momenta, &mut first, &mut second);
        assert_eq!([row(&rates[0]), row(&rates[1])], [first, second]);
    }
}

#[test]
fn slices_of_wrong_lengths_get_nan() {
    let (model, mut rates) = (driven(0.3), [[0.0; LINKS]; 2]);
    let [first, second] = &mut rates;
    model.canonical_rates_into(0.0, &[0.1; LINKS], &[0.1; 2], first, second);
    assert!(rates.as_flattened().iter().all(|rate| rate.is_nan()));
}
