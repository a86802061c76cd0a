//! Motion frame by frame and step by step.

use branched_pendulum::integrate::{Crossing, Event, InputError, RunError};
use branched_pendulum::prelude::*;

use crate::problems::{BranchedDouble, Problem, harmonic};

const FRAME: f64 = 1.0 / 60.0;

fn release<T: Real>() -> State<T> {
    State::at_rest(T::ZERO, &[1.5, 1e-3, -1e-3].map(T::from_f64))
}

fn dop853() -> Dop853<f64> {
    Dop853::new(Options::with_tolerance(1e-9))
}

/// Frames of the length of a step are the steps of one run, to the bit, and cost as many
/// evaluations: no matrix is made anew.
fn frames_are_steps<T: Real>() {
    let pendulum = BranchedDouble::paper();
    let ode = AbsoluteAngles(&pendulum);
    let frame = T::from_f64(FRAME);
    let method = Gauss::for_animation(frame);
    let mut ends = Vec::new();
    let run = method
        .integrate(&ode, &release(), T::from_f64(60.0), |step| {
            ends.push(step.end().to_vec());
            ControlFlow::Continue(())
        })
        .unwrap();
    assert_eq!(ends.len(), 3600);
    let mut stepper = method.start(&ode, &release()).unwrap();
    for (number, end) in ends.iter().enumerate() {
        stepper.advance(frame).unwrap();
        assert_eq!(stepper.state(), end, "{number}");
    }
    assert_eq!(stepper.report().evaluations, run.report.evaluations);
    assert!((stepper.time().to_f64() - 60.0).abs() < 120.0 * T::EPSILON.to_f64());
}

#[test]
fn frames_of_the_length_of_a_step_are_the_steps_of_one_run() {
    frames_are_steps::<f64>();
    frames_are_steps::<f32>();
}

/// At 30, 60 and 144 frames a second, and at uneven ones.
#[test]
fn the_motion_does_not_depend_on_the_frames() {
    fn seconds(method: &impl Integrator<f64, Problem<f64>>, error: f64) {
        let oscillator: fn(f64, &[f64], &mut [f64]) =
            |_, y, rates| rates.copy_from_slice(&[y[1], -y[0]]);
        let start = State::at_rest(0.0, &[1.0]);
        let ends = [30, 60, 144, 1000].map(|frames| {
            let mut stepper = method.start(Problem::new(2, oscillator), &start).unwrap();
            for number in 0..3 * frames {
                let uneven = if frames == 1000 {
                    1.0 + 0.9 * (-1.0_f64).powi(number)
                } else {
                    1.0
                };
                stepper.advance(uneven / f64::from(frames)).unwrap();
            }
            assert!((stepper.time() - 3.0).abs() < 1e-15);
            stepper.state()[0]
        });
        for end in ends {
            assert!((end - ends[0]).abs() < 1e-13, "{ends:?}");
            assert!((end - 3.0_f64.cos()).abs() < error, "{ends:?}");
        }
    }
    seconds(&dop853(), 1e-8);
    seconds(&Dopri5::new(Options::with_tolerance(1e-9)), 1e-7);
    seconds(&Verner98::new(Options::with_tolerance(1e-9)), 1e-8);
    seconds(&Rk4::new(0.01), 1e-8);
    seconds(&Gauss::new(GaussOrder::Six, 0.07), 1e-4);
}

#[test]
fn frames_see_what_samples_see() {
    let pendulum = BranchedDouble::paper();
    let ode = AbsoluteAngles(&pendulum);
    let times: Vec<f64> = (1..=600).map(|number| FRAME * f64::from(number)).collect();
    let states = dop853().sample_to_vec(&ode, &release(), &times).unwrap();
    let mut stepper = dop853().start(&ode, &release()).unwrap();
    // The last step of the run is cut short at its end.
    for state in &states[..580] {
        stepper.advance(FRAME).unwrap();
        assert!((stepper.time() - state.time).abs() <= f64::EPSILON * state.time);
        for (a, b) in stepper.state().iter().zip(&state.values) {
            assert!((a - b).abs() < 1e-12, "{}", state.time);
        }
    }
}

#[test]
fn steps_to_a_time_are_those_of_a_run() {
    let pendulum = BranchedDouble::paper();
    let ode = AbsoluteAngles(&pendulum);
    let start = State::at_rest(0.0, &[0.3, 1e-3, -1e-3]);
    let mut seen = Vec::new();
    let run = dop853()
        .integrate(&ode, &start, 5.0, |step| {
            seen.push(State::new(step.end_time(), step.end().to_vec()));
            ControlFlow::Continue(())
        })
        .unwrap();
    let mut stepper = dop853().start(&ode, &start).unwrap();
    let steps: Result<Vec<_>, _> = stepper.states_to(5.0).collect();
    assert_eq!(steps.unwrap(), seen);
    assert_eq!(stepper.to_state(), run.state);
    assert_eq!(*stepper.report(), run.report);
    assert!(stepper.step_to(5.0).unwrap().is_none());
    // On, and back to the start.
    let far = stepper.step().unwrap().end_time();
    assert!(far > 5.0);
    while stepper.step_to(0.0).unwrap().is_some() {}
    for (a, b) in stepper.state().iter().zip(&start.values) {
        assert!((a - b).abs() < 1e-6);
    }
}

#[test]
fn a_step_may_be_longer_than_what_is_left_of_the_run() {
    let mut stepper = dop853()
        .start(harmonic::<f64>(), &State::at_rest(0.0, &[0.0]))
        .unwrap();
    // At rest for ever: steps have no length of their own.
    for _ in 0..50 {
        stepper.advance(1.0).unwrap();
    }
    assert_eq!((stepper.time(), stepper.state()), (50.0, &[0.0, 0.0][..]));
}

/// A rate that can be changed.
struct Growth(f64);

impl Ode<f64> for Growth {
    fn dimension(&self) -> usize {
        1
    }

    fn rates(&self, _time: f64, y: &[f64], rates: &mut [f64]) {
        rates[0] = self.0 * y[0];
    }
}

#[test]
fn changed_equations_and_states_are_those_of_the_next_step() {
    fn check(method: &impl Integrator<f64, Growth>, error: f64) {
        let start = State::new(0.0, vec![1.0]);
        let mut stepper = method.start(Growth(1.0), &start).unwrap();
        stepper.advance(0.3).unwrap();
        stepper.ode_mut().0 = -2.0;
        let before = stepper.to_state();
        stepper.advance(0.7).unwrap();
        let grown = (0.3_f64 - 1.4).exp();
        assert!((stepper.state()[0] - grown).abs() < error, "{stepper:?}");
        // As if it began there.
        let run = method.run(&Growth(-2.0), &before, 1.0).unwrap();
        assert!((stepper.state()[0] - run.state.values[0]).abs() < error);
        stepper.set_state(2.0, &[5.0]).unwrap();
        assert_eq!((stepper.time(), stepper.state()), (2.0, &[5.0][..]));
        stepper.advance(-0.5).unwrap();
        assert!((stepper.state()[0] - 5.0 * 1.0_f64.exp()).abs() < 10.0 * error);
        let refused = stepper.set_state(0.0, &[1.0, 2.0]).unwrap_err();
        assert!(matches!(
            refused,
            InputError::Dimension {
                expected: 1,
                found: 2
            }
        ));
        assert!(stepper.set_state(0.0, &[f64::NAN]).is_err());
        assert!(stepper.advance(f64::INFINITY).is_err());
        assert_eq!(stepper.time(), 1.5);
    }
    check(&dop853(), 1e-8);
    check(&Rk4::new(0.01), 1e-8);
    check(&Gauss::new(GaussOrder::Eight, 0.1), 1e-4);
    check(&Gauss::for_animation(0.001), 1e-5);
}

#[test]
fn after_an_error_one_goes_on_from_the_last_good_state() {
    // Infinite at t = 1.
    let ode = Problem::new(1, |_: f64, y: &[f64], rates: &mut [f64]| {
        rates[0] = y[0] * y[0]
    });
    let mut stepper = dop853().start(ode, &State::new(0.0, vec![1.0])).unwrap();
    let error = loop {
        if let Err(error) = stepper.advance(0.3) {
            break error;
        }
    };
    let last = error.last_state().unwrap();
    assert_eq!(*last, stepper.to_state());
    assert!((stepper.time() - 1.0).abs() < 1e-6);
    stepper.set_state(0.0, &[0.1]).unwrap();
    stepper.advance(0.5).unwrap();
    assert!((stepper.state()[0] - 1.0 / 9.5).abs() < 1e-9);
}

#[test]
fn step_limits_count_the_steps_of_one_request() {
    let options = Options {
        step_limit: 20,
        ..Options::with_tolerance(1e-9)
    };
    let mut stepper = Dop853::new(options)
        .start(harmonic::<f64>(), &State::at_rest(0.0, &[1.0]))
        .unwrap();
    for _ in 0..200 {
        stepper.advance(1.0).unwrap();
    }
    assert!(stepper.report().accepted > 20);
    let error = stepper.advance(200.0).unwrap_err();
    assert!(matches!(
        error,
        IntegrationError::StepLimit { limit: 20, .. }
    ));
}

#[test]
fn errors_of_observers_reach_the_caller() {
    let ode = harmonic::<f64>();
    let start = State::at_rest(0.0, &[1.0]);
    let observer = |step: &mut DenseStep<'_, f64>| {
        if step.end_time() > 3.0 {
            Err("late")
        } else {
            Ok(ControlFlow::Continue(()))
        }
    };
    let run = dop853().try_integrate(&ode, &start, 10.0, observer);
    let Err(RunError::Observer {
        error,
        last,
        report,
    }) = run
    else {
        panic!("{run:?}");
    };
    assert_eq!(error, "late");
    assert!(last.time > 3.0 && (last.values[0] - last.time.cos()).abs() < 1e-8);
    let rest = dop853().run(&ode, &last, 10.0);
    assert!(rest.unwrap().report.accepted + report.accepted > report.accepted);

    let position = |_: f64, y: &[f64]| y[0];
    let events = [Event::new(Crossing::Falling, &position)];
    let run = dop853().try_integrate_with_events(&ode, &start, 10.0, &events, |_| Err("found"));
    let Err(RunError::Observer { error, last, .. }) = run else {
        panic!("{run:?}");
    };
    assert_eq!(error, "found");
    assert!((last.time - core::f64::consts::FRAC_PI_2).abs() < 1e-9);
    // What is no fault of the observer stays what it is.
    let run = dop853().try_sample(&ode, &start, &[1.0, f64::NAN], |_, _| Ok::<_, ()>(()));
    assert!(matches!(
        run,
        Err(RunError::Integration(IntegrationError::Input(_)))
    ));
}

#[test]
fn messages_do_not_show_large_states() {
    let ode = Problem::new(100_000, |_: f64, _: &[f64], rates: &mut [f64]| {
        rates.fill(f64::NAN);
    });
    let start = State::at_rest(0.0, &[0.25; 50_000]);
    let error = dop853().run(&ode, &start, 1.0).unwrap_err();
    let message = error.to_string();
    assert!(message.contains("y = [0.25, 0.25, 0.25, 0.25, 0.25, 0.25, … (100000 components)]"));
    assert!(message.len() < 200, "{message}");
}
