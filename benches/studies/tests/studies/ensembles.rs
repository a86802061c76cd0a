//! Accuracy of the ensembles whose speed `cargo bench -- ensembles` measures.

use branched_pendulum::integrate::IntegrationError;
use branched_pendulum::prelude::*;
use branched_pendulum_studies::scenes::BranchedDouble;
use branched_pendulum_studies::work_precision::reference::near_threshold;

/// In lanes, an emitted model ends as near to the truth as by the same method
/// alone. Steps are not the same: their control rounds differently, and the motion
/// makes up to a million times as much of it in 5 s.
#[test]
fn lanes_are_as_accurate_as_the_plain_method_near_the_threshold() {
    let (model, starts) = (BranchedDouble::new(), near_threshold(101));
    let ode = AbsoluteAngles(&model);
    let ensemble = Ensemble::new();
    let exact = Taylor::new(Options::with_tolerance(1e-16));
    let exact = ensemble.integrate(&exact, &ode, &starts, 5.0);
    let median_and_worst = |ends: Vec<Result<Solution<f64>, IntegrationError<f64>>>| {
        let mut errors: Vec<f64> = ends
            .into_iter()
            .zip(&exact)
            .map(|(end, exact)| {
                let (end, exact) = (end.unwrap().state, exact.as_ref().unwrap());
                let pairs = end.values.iter().zip(&exact.state.values);
                pairs.fold(0.0, |most, (a, b)| (a - b).abs().max(most))
            })
            .collect();
        errors.sort_by(f64::total_cmp);
        (errors[errors.len() / 2], errors[errors.len() - 1])
    };
    let options = Options::with_tolerance(1e-11);
    let (pair, series) = (Dop853::new(options.clone()), Taylor::new(options));
    for (plain, lanes) in [
        (
            ensemble.integrate(&pair, &ode, &starts, 5.0),
            ensemble.integrate_in_lanes(&pair, &ode, &starts, 5.0),
        ),
        (
            ensemble.integrate(&series, &ode, &starts, 5.0),
            ensemble.integrate_in_lanes(&series, &ode, &starts, 5.0),
        ),
    ] {
        let (plain, lanes) = (median_and_worst(plain), median_and_worst(lanes));
        println!("{plain:?} {lanes:?}");
        assert!(lanes.0 < 2.0 * plain.0, "{plain:?} {lanes:?}");
        assert!(lanes.1 < 4.0 * plain.1, "{plain:?} {lanes:?}");
        assert!(plain.0 < 1e-8, "{plain:?}");
    }
}
