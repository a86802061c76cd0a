//! Requests that make no sense are refused with the numbers that they hold;
//! requests for nothing are granted.

use core::cell::Cell;

use branched_pendulum::integrate::InputError;
use branched_pendulum::integrate::Tolerance;
use branched_pendulum::prelude::*;
use branched_pendulum::system::OdeFn;

use crate::problems::{Problem, harmonic, watch};
use crate::taylor::Mathematical;

fn start() -> State<f64> {
    State::at_rest(0.0, &[1.0])
}

fn options() -> Options<f64> {
    Options::with_tolerance(1e-9)
}

fn assert_refused(options: Options<f64>, message: &str) {
    let error = Dop853::new(options)
        .integrate(&harmonic(), &start(), 10.0, watch)
        .unwrap_err();
    assert!(matches!(error, IntegrationError::Input(_)), "{error:?}");
    assert_eq!(error.to_string(), message);
    assert!(error.last_state().is_none() && error.report().is_none());
    // Told once: by the message, and by no cause behind it.
    assert!(std::error::Error::source(&error).is_none());
}

#[test]
fn tolerances_that_make_no_sense() {
    for value in [-1e-9, f64::NAN, f64::INFINITY] {
        let relative = Options {
            relative: Tolerance::Uniform(value),
            ..options()
        };
        assert_refused(
            relative,
            &format!(
                "relative tolerance of component 0 is {value}: it must be finite and not negative"
            ),
        );
        let absolute = Options {
            absolute: Tolerance::PerComponent(vec![1e-9, value]),
            ..options()
        };
        assert_refused(
            absolute,
            &format!(
                "absolute tolerance of component 1 is {value}: it must be finite and not negative"
            ),
        );
    }
    assert_refused(
        Options {
            relative: Tolerance::PerComponent(vec![1e-9; 3]),
            ..options()
        },
        "3 relative tolerances given for a state of 2 components: it must be one for all, or one \
         for each",
    );
    assert_refused(
        Options {
            relative: Tolerance::PerComponent(vec![1e-9, 0.0]),
            absolute: Tolerance::Uniform(0.0),
            ..options()
        },
        "relative and absolute tolerance of component 1 are both zero: \
         at least one must be positive",
    );
}

/// Both tolerances as given, and what comes of a run to the time 1.
fn outcome<T: Real>(
    method: &dyn Fn(Options<T>) -> Result<Solution<T>, IntegrationError<T>>,
    [relative, absolute]: [T; 2],
) -> Result<T, InputError<T>> {
    let options = Options {
        relative: Tolerance::Uniform(relative),
        absolute: Tolerance::Uniform(absolute),
        step_limit: 10_000,
        ..Options::with_tolerance(relative)
    };
    match method(options) {
        Ok(solution) => Ok(solution.state.values[0]),
        Err(IntegrationError::Input(error)) => Err(error),
        Err(error) => panic!("{error}"),
    }
}

/// The smallest useful tolerance is used, and below it a run is refused at once, naming it.
fn tolerances_below_rounding<T: Real>(
    smallest: T,
    method: &dyn Fn(Options<T>) -> Result<Solution<T>, IntegrationError<T>>,
) {
    let zero = T::ZERO;
    // The velocity passes zero.
    let reached = outcome(method, [smallest, smallest * T::from_f64(0.1)]).unwrap();
    let rounding = (reached.to_f64() - 1.0_f64.cos() - 0.5 * 1.0_f64.sin()).abs();
    assert!(rounding < 100.0 * T::EPSILON.to_f64(), "{rounding:e}");
    for tolerance in [0.999, 1e-2, 1e-5, 1e-12] {
        let tolerance = smallest * T::from_f64(tolerance);
        for both in [[tolerance, zero], [zero, tolerance]] {
            let refused = outcome(method, both).unwrap_err();
            let expected = InputError::ToleranceBelowRounding {
                component: 0,
                relative: both[0],
                absolute: both[1],
                smallest,
            };
            assert_eq!(refused, expected);
            let smallest = format!("the smallest relative tolerance of use is {smallest:?}");
            assert!(refused.to_string().ends_with(&smallest), "{refused}");
        }
    }
}

fn below_rounding_of_pairs<T: Real>() {
    let start = State::new(T::ZERO, vec![T::ONE, T::from_f64(0.5)]);
    let end = T::ONE;
    let smallest = T::EPSILON * T::from_f64(0.25);
    let ode = harmonic::<T>();
    tolerances_below_rounding(smallest, &|options| {
        Dop853::new(options).integrate(&ode, &start, end, watch)
    });
    tolerances_below_rounding(smallest, &|options| {
        Dopri5::new(options).integrate(&ode, &start, end, watch)
    });
    tolerances_below_rounding(smallest, &|options| {
        Verner98::new(options).integrate(&ode, &start, end, watch)
    });
}

#[test]
fn tolerances_below_rounding_are_refused() {
    below_rounding_of_pairs::<f64>();
    below_rounding_of_pairs::<f32>();
    // θ'' = −sin θ from rest is no cosine: the method is asked, and not the motion.
    for (tolerance, refused) in [(1e-16, false), (1e-18, false), (1e-19, true), (1e-30, true)] {
        let method = Taylor::new(Options {
            compensated: true,
            ..Options::with_tolerance(tolerance)
        });
        let run = method.integrate(&Mathematical, &start(), 10.0, watch);
        assert_eq!(run.is_err(), refused, "{tolerance:e}");
    }
}

#[test]
fn a_tolerance_is_small_beside_its_component() {
    let run = |relative: f64, absolute: Vec<f64>, values: [f64; 2]| {
        let options = Options {
            relative: Tolerance::Uniform(relative),
            absolute: Tolerance::PerComponent(absolute),
            ..options()
        };
        Dop853::new(options).integrate(&harmonic(), &State::new(0.0, values.to_vec()), 1.0, watch)
    };
    // 1e-20 is much beside 1e-8, and nothing beside 1.
    assert!(run(0.0, vec![1e-20; 2], [1e-8, 1e-8]).is_ok());
    let component = |result: Result<_, _>| match result {
        Err(IntegrationError::Input(InputError::ToleranceBelowRounding { component, .. })) => {
            component
        }
        other => panic!("{other:?}"),
    };
    assert_eq!(component(run(0.0, vec![1e-20; 2], [1e-8, 1.0])), 1);
    assert_eq!(component(run(0.0, vec![1e-9, 1e-17], [1.0, 1.0])), 1);
    // A relative tolerance that has no part in the sum does not matter.
    assert!(run(1e-30, vec![1e-9; 2], [1.0, 0.0]).is_ok());
    // From zero, a relative tolerance is asked about at one, an absolute one not at all.
    assert_eq!(component(run(1e-20, vec![1e-23; 2], [0.0, 0.0])), 0);
    assert!(run(0.0, vec![1e-20; 2], [0.0, 0.0]).is_ok());
}

#[test]
fn steps_that_make_no_sense() {
    for value in [0.0, -0.1, f64::NAN, f64::INFINITY] {
        assert_refused(
            Options {
                initial_step: Some(value),
                ..options()
            },
            &format!("initial step is {value}: it must be finite and positive"),
        );
        assert_refused(
            Options {
                max_step: Some(value),
                ..options()
            },
            &format!("longest step is {value}: it must be finite and positive"),
        );
    }
    assert_refused(
        Options {
            min_step: -1.0,
            ..options()
        },
        "shortest step is -1: it must be finite and not negative",
    );
    assert_refused(
        Options {
            min_step: 0.2,
            max_step: Some(0.1),
            ..options()
        },
        "shortest step 0.2 is longer than the longest step 0.1",
    );
    for value in [-0.01, 0.3, f64::NAN] {
        assert_refused(
            Options {
                beta: value,
                ..options()
            },
            &format!("beta is {value}: it must be between 0 and 0.2"),
        );
    }
}

#[test]
fn starts_and_times_that_make_no_sense() {
    let method = Dop853::new(options());
    let refused = |start: State<f64>, end: f64| match method
        .integrate(&harmonic(), &start, end, watch)
        .unwrap_err()
    {
        IntegrationError::Input(error) => error.to_string(),
        error => panic!("{error:?}"),
    };
    assert_eq!(
        refused(State::at_rest(0.0, &[1.0, 2.0]), 1.0),
        "the state has 4 components, the equations have 2"
    );
    assert_eq!(
        refused(State::at_rest(f64::NAN, &[1.0]), 1.0),
        "the starting time is NaN: it must be finite"
    );
    assert_eq!(
        refused(State::new(0.0, vec![1.0, f64::INFINITY]), 1.0),
        "component 1 of the starting state is inf: it must be finite"
    );
    for end in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let message = format!("the end time is {end}: it must be finite");
        assert_eq!(refused(start(), end), message);
        let error = method.trajectory(&harmonic(), &start(), end).unwrap_err();
        assert_eq!(error.to_string(), message);
        let mut stepper = method.start(harmonic(), &start()).unwrap();
        assert_eq!(stepper.step_to(end).unwrap_err().to_string(), message);
    }
    let empty = Problem::new(0, |_time: f64, _y: &[f64], _rates: &mut [f64]| {});
    let error = method
        .integrate(&empty, &State::new(0.0, vec![]), 1.0, watch)
        .unwrap_err();
    assert_eq!(error, IntegrationError::Input(InputError::EmptyState));
    assert_eq!(
        error.to_string(),
        "the state has no components: it must have at least one"
    );
    let error = method.step(&harmonic(), &start(), f64::NAN).unwrap_err();
    assert_eq!(error.to_string(), "step length is NaN: it must be finite");
}

#[test]
fn fixed_steps_that_make_no_sense() {
    let message = |method: &dyn Fn() -> Result<Solution<f64>, IntegrationError<f64>>| {
        method().unwrap_err().to_string()
    };
    for step in [0.0, -0.1, f64::NAN, f64::INFINITY] {
        let expected = format!("fixed step is {step}: it must be finite and positive");
        let rk4 = || Rk4::new(step).integrate(&harmonic(), &start(), 1.0, watch);
        assert_eq!(message(&rk4), expected);
        let gauss = Gauss::new(GaussOrder::Four, step);
        assert_eq!(
            message(&|| gauss.integrate(&harmonic(), &start(), 1.0, watch)),
            expected
        );
    }
    let far = State::at_rest(1e9, &[1.0]);
    let lost = || Rk4::new(1e-8).integrate(&harmonic(), &far, 1e9 + 1.0, watch);
    assert!(message(&lost).starts_with("a step of 0.00000001 at t = 1000000000 is below"));
    let limited = Rk4 {
        step_limit: 7,
        ..Rk4::new(0.1)
    };
    let error = limited
        .integrate(&harmonic(), &start(), 1.0, watch)
        .unwrap_err();
    assert_eq!(error.report().unwrap().accepted, 7);
    assert!((error.last_state().unwrap().time - 0.7).abs() < 1e-15);
}

#[test]
fn sample_times_that_turn_back() {
    let method = Dop853::new(options());
    let sample = |times: &[f64]| {
        method
            .sample(&harmonic(), &start(), times, |_, _| {
                panic!("visited before the check")
            })
            .unwrap_err()
            .to_string()
    };
    assert_eq!(
        sample(&[1.0, 2.0, 1.5]),
        "requested time 2 is 1.5, after 2: times must run one way from the start"
    );
    assert_eq!(
        sample(&[-1.0, 1.0]),
        "requested time 1 is 1, after -1: times must run one way from the start"
    );
    assert_eq!(
        sample(&[1.0, f64::NAN]),
        "requested time 1 is NaN: it must be finite"
    );
}

#[test]
fn a_span_of_zero_returns_at_once() {
    let evaluations = Cell::new(0);
    let counted = OdeFn::new(2, |_time: f64, y: &[f64], rates: &mut [f64]| {
        evaluations.set(evaluations.get() + 1);
        rates.copy_from_slice(y);
    });
    let method = Dop853::new(options());
    let solution = method
        .integrate(&counted, &start(), 0.0, |_| panic!("there is no step"))
        .unwrap();
    assert_eq!(solution.state, start());
    assert_eq!(solution.report.stop, StopReason::EndReached);
    assert_eq!(
        (solution.report.accepted, solution.report.evaluations),
        (0, 0)
    );
    let solution = method
        .sample(&counted, &start(), &[], |_, _| panic!("no time"))
        .unwrap();
    assert_eq!(solution.state, start());
    let mut visits = 0;
    method
        .sample(&counted, &start(), &[0.0], |_, _| visits += 1)
        .unwrap();
    assert_eq!((visits, evaluations.get()), (1, 0));
}

#[test]
fn the_shortest_span_that_times_can_hold() {
    let begin = State::at_rest(1e6, &[1.0]);
    let end = 1e6_f64.next_up();
    let solution = Dop853::new(options())
        .integrate(&harmonic(), &begin, end, watch)
        .unwrap();
    assert_eq!(solution.state.time, end);
    assert_eq!(solution.report.accepted, 1);
}
