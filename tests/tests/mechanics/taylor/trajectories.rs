//! The method against reference trajectories and the energy.

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Double;
use branched_pendulum::system::TaylorPendulum;
use branched_pendulum_tests::scenes::damped_series::DampedSeries;
use branched_pendulum_tests::scenes::driven_series::DrivenSeries;
use branched_pendulum_tests::scenes::series::Series;

use super::{PARAMETERS, exact_tree};
use crate::reference::reference_state;

fn method(tolerance: f64) -> Taylor<f64> {
    Taylor::new(Options {
        compensated: true,
        ..Options::with_tolerance(tolerance)
    })
}

/// Largest errors at the times, and the run's account.
fn errors(problem: &str, times: &[f64], method: &Taylor<f64>) -> (Vec<f64>, Report<f64>) {
    let model = Series::new();
    let (theta, expected) = reference_state(problem);
    let mut errors = Vec::new();
    let solution = method
        .sample(
            &AbsoluteAngles(&model),
            &State::at_rest(0.0, &theta),
            times,
            |time, state| {
                let expected = expected(time);
                let differences = expected.iter().zip(state).map(|(a, b)| (a - b).abs());
                errors.push(differences.fold(0.0, f64::max));
            },
        )
        .expect("the motion is smooth");
    assert_eq!(errors.len(), times.len());
    (errors, solution.report)
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

#[test]
fn regular_trajectory() {
    // The truncation of steps shows after 100 s at 1e-14.
    for (tolerance, hundred) in [(1e-14, 2e-13), (1e-15, 1e-13), (1e-16, 1e-13)] {
        let (errors, report) = errors("regular", &TIMES, &method(tolerance));
        println!("regular, {tolerance:e}: {errors:?}; {report}");
        assert!(errors[3] < 2e-14, "{tolerance:e}: {errors:?}");
        assert!(errors[6] < hundred, "{tolerance:e}: {errors:?}");
    }
    let (errors, _) = errors("regular", &TIMES, &method(1e-9));
    assert!(errors[3] < 1e-8, "{errors:?}");
}

/// At tolerances of rounding the error is rounding: a single error is luck,
/// their size is not.
#[test]
fn rounding_in_the_mean() {
    const TOLERANCES: u32 = 60;
    let (mut ten, mut hundred) = (0.0_f64, 0.0_f64);
    for i in 0..TOLERANCES {
        let tolerance = 3e-15 * 0.033_f64.powf(f64::from(i) / f64::from(TOLERANCES - 1));
        let (errors, _) = errors("regular", &TIMES, &method(tolerance));
        ten += errors[3].powi(2) / f64::from(TOLERANCES);
        hundred += errors[6].powi(2) / f64::from(TOLERANCES);
    }
    let (ten, hundred) = (ten.sqrt(), hundred.sqrt());
    println!("regular, root of the mean square: {ten:e} at 10 s, {hundred:e} at 100 s");
    // The refinement needs instructions that fuse products with sums.
    #[cfg(target_arch = "x86_64")]
    let fused = std::is_x86_feature_detected!("avx2") && std::is_x86_feature_detected!("fma");
    #[cfg(not(target_arch = "x86_64"))]
    let fused = false;
    assert!(ten < 1e-14, "{ten:e}");
    assert!(hundred < if fused { 1e-13 } else { 2e-13 }, "{hundred:e}");
}

/// With constants of 32 digits, formed from decimals or those of a scene of numbers,
/// the series gives the reference trajectory to the last digit for 100 s.
#[test]
fn a_hundred_seconds() {
    let (_, expected) = reference_state("regular");
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
    let (_, expected) = reference_state("regular");
    let rounded: Series<Double> = Series::new().cast(Double::from_f64);
    let states = in_32_digits(&rounded, &TIMES);
    let of_constants = largest_difference(&states[6], &expected(TIMES[6]));
    println!("rounded constants: {of_constants:e}");
    assert!(of_constants < 4e-14, "{of_constants:e}");
}

#[test]
fn trajectory_near_the_threshold() {
    let times = [1.0, 2.0, 5.0, 10.0];
    for tolerance in [1e-13, 1e-15] {
        let (errors, report) = errors("near-threshold", &times, &method(tolerance));
        println!("near the threshold, {tolerance:e}: {errors:?}; {report}");
        assert!(errors[3] < 1e-7, "{tolerance:e}: {errors:?}");
    }
}

/// Relative to the energy above the hanging state, at the end of every step.
#[test]
fn energy_after_a_thousand_seconds() {
    let model = Series::new();
    let (theta, _) = reference_state("regular");
    let energy = |state: &[f64]| {
        let &[a, b, c, u, v, w] = state else {
            panic!("{} values", state.len());
        };
        let (theta, omega) = ([a, b, c], [u, v, w]);
        model.kinetic_energy(&theta, &omega) + model.potential_energy(&theta)
    };
    let start = State::at_rest(0.0, &theta);
    let initial = energy(&start.values);
    let mut worst = 0.0_f64;
    let solution = method(1e-16)
        .integrate(&AbsoluteAngles(&model), &start, 1000.0, |step| {
            worst = worst.max((energy(step.end()) / initial - 1.0).abs());
            ControlFlow::Continue(())
        })
        .expect("the motion is smooth");
    println!("energy: {worst:e}; {}", solution.report);
    assert!(worst < 1e-13, "{worst:e}");
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
    let (theta, _) = reference_state("regular");
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
