//! What `stability-map` measures.

use branched_pendulum::prelude::*;
use branched_pendulum_studies::stability_map::verdict::{
    Verdict, damped, damped_model, damped_reference, ideal,
};

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
