//! The method in 32 digits against reference trajectories, and against other methods. In `f64` and for
//! long: `optimised/tests/run_time/written_out.rs`.

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Double;
use branched_pendulum::system::TaylorPendulum;
use branched_pendulum_tests::reference::trajectory;
use branched_pendulum_tests::scenes::damped_series::DampedSeries;
use branched_pendulum_tests::scenes::driven_series::DrivenSeries;
use branched_pendulum_tests::scenes::series::Series;

use super::{PARAMETERS, exact_tree};

fn method(tolerance: f64) -> Taylor<f64> {
    Taylor::new(Options {
        compensated: true,
        ..Options::with_tolerance(tolerance)
    })
}

/// States at the times, by a model and its Taylor series in 32 digits.
fn in_32_digits<P: TaylorPendulum<Double>>(model: &P, times: &[f64]) -> Vec<Vec<f64>> {
    // 0.3, 0.001, −0.001: not as `f64` has them.
    let start = [300.0, 1.0, -1.0].map(|x| Double::from_f64(x) / Double::from_f64(1000.0));
    let times: Vec<Double> = times.iter().copied().map(Double::from_f64).collect();
    let mut states = Vec::new();
    Taylor::new(Options::with_tolerance(Double::from_f64(1e-24)))
        .sample(
            &AbsoluteAngles(model),
            &State::at_rest(Double::from_f64(0.0), &start),
            &times,
            |_, state| states.push(state.iter().map(|x| x.to_f64()).collect()),
        )
        .expect("the motion is smooth");
    states
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    let differences = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max)
}

const TIMES: [f64; 7] = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0];

/// With constants of 32 digits, formed from decimals or those of a scene of numbers,
/// the series gives the reference trajectory to the last digit for 100 s.
#[test]
fn a_hundred_seconds() {
    let (_, expected) = trajectory("regular");
    let expected: Vec<Vec<f64>> = TIMES.iter().map(|&time| expected(time).to_vec()).collect();
    let decimals = in_32_digits(&exact_tree(), &TIMES);
    let scene = in_32_digits(&Series::<Double>::default(), &TIMES);
    for ((decimals, scene), expected) in decimals.iter().zip(&scene).zip(&expected) {
        let errors = [decimals, scene].map(|states| largest_difference(states, expected));
        println!("{errors:?}");
        assert!(errors.iter().all(|error| *error < 1e-15), "{errors:?}");
    }
}

/// The rounding of constants to `f64` moves the motion less than rounding on
/// the way does: divided by one of them, as those of a scene with parameters,
/// by 9e-14.
#[test]
fn rounded_constants() {
    let (_, expected) = trajectory("regular");
    let rounded: Series<Double> = Series::new().cast(Double::from_f64);
    let states = in_32_digits(&rounded, &TIMES);
    let of_constants = largest_difference(&states[6], &expected(TIMES[6]));
    println!("rounded constants: {of_constants:e}");
    assert!(of_constants < 4e-14, "{of_constants:e}");
}

/// The driven tree by another method, with the same equations.
#[test]
fn driven_trajectory() {
    let model = DrivenSeries::new(PARAMETERS).expect("possible parameters");
    let ode = AbsoluteAngles(&model);
    let start = State::at_rest(0.5, &[0.3, -0.2, 0.1]);
    let times = [1.0, 2.0];
    let (mut series, mut pair) = (Vec::new(), Vec::new());
    method(1e-15)
        .sample(&ode, &start, &times, |_, state| {
            series.extend_from_slice(state)
        })
        .expect("the motion is smooth");
    Verner98::new(Options::with_tolerance(1e-14))
        .sample(&ode, &start, &times, |_, state| {
            pair.extend_from_slice(state)
        })
        .expect("the motion is smooth");
    assert_eq!((series.len(), pair.len()), (12, 12));
    for (a, b) in series.iter().zip(&pair) {
        assert!((a - b).abs() < 1e-12, "{a} {b}");
    }
}

/// The damped tree by another method, and with half as many orders again as the rule
/// for the tolerance says.
#[test]
fn damped_trajectory() {
    let model = DampedSeries::new();
    let ode = AbsoluteAngles(&model);
    let start = State::at_rest(0.0, &[0.8, 0.1, -0.2]);
    let times = [1.0, 10.0];
    let states = |integrate: &dyn Fn(&mut Vec<f64>)| {
        let mut states = Vec::new();
        integrate(&mut states);
        assert_eq!(states.len(), 12);
        states
    };
    let series = |method: Taylor<f64>| {
        states(&|states| {
            method
                .sample(&ode, &start, &times, |_, state| {
                    states.extend_from_slice(state)
                })
                .expect("the motion is smooth");
        })
    };
    let pair = states(&|states| {
        Verner98::new(Options {
            compensated: true,
            ..Options::with_tolerance(1e-14)
        })
        .sample(&ode, &start, &times, |_, state| {
            states.extend_from_slice(state)
        })
        .expect("the motion is smooth");
    });
    let tight = series(method(1e-15));
    let high = series(method(1e-15).with_order(45));
    let errors = [&pair, &high].map(|other| largest_difference(&tight, other));
    println!("damped: {errors:?}");
    assert!(errors[0] < 1e-11, "{errors:?}");
    assert!(errors[1] < 1e-12, "{errors:?}");
    // Damping is there: half of the energy is not.
    let energy = |state: &[f64]| {
        let &[a, b, c, u, v, w] = state else {
            panic!("{} values", state.len());
        };
        model.kinetic_energy(&[a, b, c], &[u, v, w]) + model.potential_energy(&[a, b, c])
    };
    assert!(energy(&tight[6..]) < 0.5 * energy(&start.values));
    // Looser tolerances keep their promise too.
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let error = largest_difference(&tight, &series(method(tolerance)));
        println!("damped, {tolerance:e}: {error:e}");
        assert!(error < 30.0 * tolerance, "{tolerance:e}: {error:e}");
    }
}

/// There and back again.
#[test]
fn time_running_backwards() {
    let model = Series::new();
    let ode = AbsoluteAngles(&model);
    let (theta, _) = trajectory("regular");
    let start = State::at_rest(0.0, &theta);
    let go = |from: &State<f64>, to: f64| {
        let solution = method(1e-16).run(&ode, from, to);
        solution.expect("the motion is smooth").state
    };
    let back = go(&go(&start, 10.0), 0.0);
    assert_eq!(back.time, 0.0);
    for (a, b) in back.values.iter().zip(&start.values) {
        assert!((a - b).abs() < 1e-12, "{a} {b}");
    }
}
