//! Taylor series of a tree that is written out against reference trajectories and the energy, for
//! long.

use branched_pendulum::prelude::*;
use branched_pendulum_tests::reference::trajectory;
use branched_pendulum_tests::scenes::series::Series;

fn method(tolerance: f64) -> Taylor<f64> {
    Taylor::new(Options {
        compensated: true,
        ..Options::with_tolerance(tolerance)
    })
}

/// Largest errors at the times, and the run's account.
fn errors(problem: &str, times: &[f64], method: &Taylor<f64>) -> (Vec<f64>, Report<f64>) {
    let model = Series::new();
    let (theta, expected) = trajectory(problem);
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
    let (theta, _) = trajectory("regular");
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
