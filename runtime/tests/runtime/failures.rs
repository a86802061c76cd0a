//! Every way for a run to fail, provoked, with its message and last state.

use branched_pendulum::integrate::DenseError;
use branched_pendulum::prelude::*;

use crate::problems::{Problem, growth_and_decay, harmonic, watch};

type Failure = IntegrationError<f64>;

fn start() -> State<f64> {
    State::at_rest(0.0, &[1.0])
}

fn options() -> Options<f64> {
    Options::with_tolerance(1e-9)
}

fn run(options: Options<f64>) -> Failure {
    Dop853::new(options)
        .integrate(&harmonic(), &start(), 10.0, watch)
        .unwrap_err()
}

#[test]
fn rates_that_blow_up_are_reported_at_once() {
    // Defined until t = 1 only.
    let ode = Problem::new(1, |time: f64, _y: &[f64], rates: &mut [f64]| {
        rates[0] = (1.0 - time).sqrt();
    });
    let error = Dop853::new(options())
        .integrate(&ode, &State::new(0.0, vec![0.0]), 2.0, watch)
        .unwrap_err();
    let report = *error.report().unwrap();
    assert_eq!(report.stop, StopReason::NonFinite);
    let message = error.to_string();
    let IntegrationError::NonFinite {
        time, values, last, ..
    } = error
    else {
        panic!("{error:?}");
    };
    assert!(time > 1.0 && last.time <= 1.0 && values.len() == 1);
    let expected = 2.0 / 3.0 * (1.0 - (1.0 - last.time).powf(1.5));
    assert!((last.values[0] - expected).abs() < 1e-8);
    assert_eq!(
        message,
        format!(
            "state or rates are not finite at t = {time}, y = {values:?}; \
             last good state at t = {}",
            last.time
        )
    );
    // The last state is good enough to go on from.
    let rest = Dop853::new(options())
        .integrate(&ode, &last, 0.9, watch)
        .unwrap();
    assert_eq!(rest.state.time, 0.9);
}

#[test]
fn rates_that_are_not_finite_at_the_start() {
    let ode = Problem::new(1, |_time: f64, y: &[f64], rates: &mut [f64]| {
        rates[0] = 1.0 / y[0]
    });
    let zero = State::new(0.5, vec![0.0]);
    let error = Dop853::new(options())
        .integrate(&ode, &zero, 1.0, watch)
        .unwrap_err();
    assert_eq!(error.last_state(), Some(&zero));
    assert_eq!(error.report().unwrap().evaluations, 1);
    assert!(matches!(
        error,
        IntegrationError::NonFinite { time: 0.5, .. }
    ));
    let error = Dop853::new(options()).step(&ode, &zero, 0.1).unwrap_err();
    assert!(matches!(
        error,
        IntegrationError::NonFinite { time: 0.5, .. }
    ));
}

#[test]
fn a_fixed_step_that_overflows() {
    let ode = Problem::new(1, |_time: f64, _y: &[f64], rates: &mut [f64]| {
        rates[0] = 1e308
    });
    let error = Dop853::new(options())
        .step(&ode, &State::new(0.0, vec![1e308]), 10.0)
        .unwrap_err();
    assert!(
        matches!(error, IntegrationError::NonFinite { time: 10.0, .. }),
        "{error:?}"
    );
}

#[test]
fn a_singularity_that_the_steps_cannot_pass() {
    // y = 1/(1 - t): the steps shrink towards t = 1 and end there.
    let ode = Problem::new(1, |_time: f64, y: &[f64], rates: &mut [f64]| {
        rates[0] = y[0] * y[0]
    });
    let one = State::new(0.0, vec![1.0]);
    let error = Dop853::new(options())
        .integrate(&ode, &one, 2.0, watch)
        .unwrap_err();
    let IntegrationError::StepTooSmall {
        step,
        shortest,
        last,
        report,
    } = &error
    else {
        panic!("{error:?}");
    };
    assert!(step <= shortest && (last.time - 1.0).abs() < 1e-6);
    assert_eq!(report.stop, StopReason::StepTooSmall);
    // A floor of the user's own is kept to.
    let floor = Options {
        min_step: 1e-3,
        ..options()
    };
    let error = Dop853::new(floor)
        .integrate(&ode, &one, 2.0, watch)
        .unwrap_err();
    let IntegrationError::StepTooSmall {
        step,
        shortest,
        last,
        report,
    } = &error
    else {
        panic!("{error:?}");
    };
    assert!(*step < 1e-3 && *shortest == 1e-3 && report.shortest_step >= 1e-3);
    assert_eq!(
        error.to_string(),
        format!(
            "a step of {step} at t = {} is below the shortest allowed, 0.001",
            last.time
        )
    );
}

#[test]
fn the_step_limit() {
    let error = run(Options {
        step_limit: 7,
        ..options()
    });
    let IntegrationError::StepLimit {
        limit,
        last,
        report,
    } = &error
    else {
        panic!("{error:?}");
    };
    assert_eq!((*limit, report.accepted + report.rejected), (7, 7));
    assert_eq!(report.stop, StopReason::StepLimit);
    assert!(last.time > 0.0 && last.time < 10.0);
    assert_eq!(
        error.to_string(),
        format!("the limit of 7 steps was reached at t = {}", last.time)
    );
}

#[test]
fn dense_output_refuses_what_it_does_not_know() {
    let mut refusals = Vec::new();
    Dop853::new(options())
        .integrate(
            &growth_and_decay(),
            &State::new(0.0, vec![1.0]),
            1.0,
            |step| {
                let before = step.report().evaluations;
                for time in [-1.0, 2.0, f64::NAN] {
                    refusals.push(step.eval(time, &mut [0.0]).unwrap_err().to_string());
                }
                refusals.push(step.eval(0.0, &mut [0.0; 2]).unwrap_err().to_string());
                assert_eq!(step.report().evaluations, before);
                ControlFlow::Break(())
            },
        )
        .unwrap();
    assert!(refusals[0].starts_with("time -1 is outside the step from 0 to "));
    assert!(refusals[2].starts_with("time NaN is outside the step from 0 to "));
    assert_eq!(
        refusals[3],
        "2 values asked for from a state of 1 components"
    );
}

#[test]
fn rates_that_are_not_finite_only_between_the_stages() {
    // Finite where the twelve stages look, NaN where the dense output does: at
    // the tenth of a step of length one.
    let ode = Problem::new(1, |time: f64, _y: &[f64], rates: &mut [f64]| {
        rates[0] = if (time - 0.1).abs() < 1e-9 {
            f64::NAN
        } else {
            1.0
        };
    });
    let whole = Options {
        initial_step: Some(1.0),
        ..options()
    };
    let zero = State::new(0.0, vec![0.0]);
    let mut seen = None;
    Dop853::new(whole.clone())
        .integrate(&ode, &zero, 1.0, |step| {
            seen = step.eval(0.5, &mut [0.0]).err();
            ControlFlow::Continue(())
        })
        .unwrap();
    assert!(
        matches!(seen, Some(DenseError::NonFinite { .. })),
        "{seen:?}"
    );
    assert!(
        seen.unwrap()
            .to_string()
            .starts_with("rates are not finite at t = 0.1, y = [0.")
    );
    let error = Dop853::new(whole)
        .sample(&ode, &zero, &[0.5, 1.0], |_, _| {
            panic!("no value can be given")
        })
        .unwrap_err();
    assert_eq!(error.report().unwrap().stop, StopReason::NonFinite);
    assert_eq!(error.last_state().unwrap().time, 1.0);
}
