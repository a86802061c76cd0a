//! What `work-precision` and `stability-map` measure.

use branched_pendulum::prelude::*;
use branched_pendulum_studies::stability_map::verdict::{
    Verdict, damped, damped_model, damped_reference, ideal,
};
use branched_pendulum_studies::work_precision::measure::{Measurement, time_to_error};

#[test]
fn verdicts_where_they_are_known() {
    assert_eq!(ideal(Method::Dop853, 1e-9, 15.0), Verdict::Accurate);
    assert_eq!(
        ideal(Method::Gauss(GaussOrder::Eight), 0.01, 15.0),
        Verdict::Accurate
    );
    assert_eq!(ideal(Method::Rk4, 0.02, 60.0), Verdict::Drifting);
    assert_eq!(
        ideal(Method::Gauss(GaussOrder::Two), 0.03, 45.0),
        Verdict::Bounded
    );
    assert_eq!(
        ideal(Method::Gauss(GaussOrder::Two), 0.3, 150.0),
        Verdict::Refused
    );
}

#[test]
fn stiff_friction_is_for_newton_s_method_alone() {
    let model = damped_model(1.0).unwrap();
    let expected = damped_reference(&model).unwrap();
    assert_eq!(
        damped(Method::Rk4, 0.03, &model, expected),
        Verdict::Diverged
    );
    assert_eq!(
        damped(Method::Animation, 0.03, &model, expected),
        Verdict::Accurate
    );
    let fixed_point = damped(Method::Gauss(GaussOrder::Two), 0.03, &model, expected);
    assert_eq!(fixed_point, Verdict::Refused);
}

#[test]
fn times_are_interpolated_between_runs() {
    let run = |error, microseconds| Measurement {
        method: Method::Rk4,
        setting: 0.0,
        error,
        microseconds,
        evaluations: 0,
    };
    let runs = [run(1e-2, 10.0), run(1e-4, 1000.0)];
    let time = |error| time_to_error(&runs, Method::Rk4, error);
    assert!((time(1e-3).unwrap() - 100.0).abs() < 1e-9);
    assert_eq!(time(1.0), Some(10.0));
    assert_eq!(time(1e-5), None);
    assert_eq!(time_to_error(&runs, Method::Dop853, 1.0), None);
}
