//! Runs that are stopped and go on.

use branched_pendulum::integrate::{InputError, Solver};
use branched_pendulum::prelude::*;
use branched_pendulum::system::{OdeFn, RatesOnly, TaylorOde};

use crate::problems::{BranchedDouble, kepler, perihelion, watch};
use crate::taylor::Mathematical;

/// A step as it was seen: its ends, bit for bit.
type Step = (f64, f64, Vec<f64>);

fn record(steps: &mut Vec<Step>, step: &DenseStep<'_, f64>) {
    steps.push((step.start_time(), step.end_time(), step.end().to_vec()));
}

#[test]
fn a_stopped_run_continues_with_the_same_steps() {
    let pendulum = BranchedDouble::paper();
    let ode = AbsoluteAngles(&pendulum);
    let options = Options::with_tolerance(1e-9);
    let start = State::at_rest(0.0, &[47.8_f64.to_radians(), 1e-3, -1e-3]);

    let mut whole = Vec::new();
    let end = Dop853::new(options.clone())
        .integrate(&ode, &start, 5.0, |step| {
            record(&mut whole, step);
            ControlFlow::Continue(())
        })
        .unwrap();
    assert!(
        end.report.rejected > 0,
        "the case must hold rejections too: {}",
        end.report
    );

    let mut parts = Vec::new();
    let (mut state, mut options) = (start, options);
    loop {
        let mut left = 11;
        let part = Dop853::new(options.clone())
            .integrate(&ode, &state, 5.0, |step| {
                record(&mut parts, step);
                left -= 1;
                if left == 0 {
                    ControlFlow::Break(())
                } else {
                    ControlFlow::Continue(())
                }
            })
            .unwrap();
        options.initial_step = Some(part.report.next_step);
        state = part.state;
        if part.report.stop == StopReason::EndReached || state.time == 5.0 {
            break;
        }
    }
    assert!(whole.len() > 30);
    assert_eq!(parts, whole);
    assert_eq!(state, end.state);
}

#[test]
fn a_run_ended_by_the_step_limit_continues_with_the_same_steps() {
    let options = Options::with_tolerance(1e-8);
    let start = perihelion(0.7);
    let whole = Dop853::new(options.clone())
        .integrate(&kepler(), &start, 20.0, watch)
        .unwrap();
    let limited = Options {
        step_limit: 9,
        ..options.clone()
    };
    let error = Dop853::new(limited)
        .integrate(&kepler(), &start, 20.0, watch)
        .unwrap_err();
    let (last, report) = (error.last_state().unwrap(), error.report().unwrap());
    let rest = Dop853::new(Options {
        initial_step: Some(report.next_step),
        ..options
    })
    .integrate(&kepler(), last, 20.0, watch)
    .unwrap();
    assert_eq!(rest.state, whole.state);
    assert_eq!(
        report.accepted + rest.report.accepted,
        whole.report.accepted
    );
}

#[test]
fn equal_runs_are_equal_bit_for_bit() {
    fn twice(method: &impl Integrator<f64, dyn Ode<f64>>) {
        let ode: &dyn Ode<f64> = &kepler();
        let run = || {
            method
                .integrate(ode, &perihelion(0.4), 30.0, watch)
                .unwrap()
        };
        let (first, second) = (run(), run());
        let bits = |solution: &Solution<f64>| -> Vec<u64> {
            solution
                .state
                .values
                .iter()
                .map(|value| value.to_bits())
                .collect()
        };
        assert_eq!(bits(&first), bits(&second));
        assert_eq!(first, second);
    }
    let options = || Options {
        beta: 0.04,
        compensated: true,
        ..Options::with_tolerance(1e-10)
    };
    twice(&Dopri5::new(options()));
    twice(&Dop853::new(options()));
    twice(&Verner98::new(options()));
    twice(&Rk4::new(0.01));
    twice(&Gauss::new(GaussOrder::Six, 0.05));
    twice(&Gauss {
        solver: Solver::Newton,
        ..Gauss::new(GaussOrder::Two, 0.05)
    });
}

/// Stopped anywhere on its grid, a method with fixed steps goes on with the
/// same steps; the times differ by rounding only.
#[test]
fn fixed_steps_continue_on_their_grid() {
    let ode = kepler();
    let method = Rk4::new(0.125);
    let whole = method
        .integrate(&ode, &perihelion(0.4), 10.0, watch)
        .unwrap();
    let first = method
        .integrate(&ode, &perihelion(0.4), 10.0, |step| {
            if step.end_time() >= 3.0 {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        })
        .unwrap();
    assert_eq!(first.state.time, 3.0);
    let rest = method.integrate(&ode, &first.state, 10.0, watch).unwrap();
    assert_eq!(rest.state, whole.state);
}

#[test]
fn the_observer_stops_at_the_end_of_its_step() {
    let mut seen = 0.0;
    let solution = Dop853::new(Options::with_tolerance(1e-9))
        .integrate(&kepler(), &perihelion(0.2), 30.0, |step| {
            seen = step.end_time();
            if step.end_time() > 3.0 {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        })
        .unwrap();
    assert_eq!(solution.report.stop, StopReason::StoppedByObserver);
    assert_eq!(solution.state.time, seen);
    assert!(
        solution
            .report
            .to_string()
            .starts_with("stopped by the observer: ")
    );
}

#[test]
fn the_account_adds_up() {
    let evaluations = core::cell::Cell::new(0_u64);
    let ode = OdeFn::new(4, |time: f64, y: &[f64], rates: &mut [f64]| {
        evaluations.set(evaluations.get() + 1);
        kepler().rates(time, y, rates);
    });
    let mut steps = 0;
    let Solution { report, .. } = Dop853::new(Options::with_tolerance(1e-7))
        .integrate(&ode, &perihelion(0.8), 20.0, |step| {
            steps += 1;
            step.eval(0.5 * (step.start_time() + step.end_time()), &mut [0.0; 4])
                .unwrap();
            ControlFlow::Continue(())
        })
        .unwrap();
    assert_eq!(report.accepted, steps);
    assert!(report.rejected > 0);
    // Two for the first step; twelve an accepted, eleven a rejected step; three
    // for the values inside.
    assert_eq!(
        report.evaluations,
        2 + 15 * report.accepted + 11 * report.rejected
    );
    assert_eq!(report.evaluations, evaluations.get());
    assert!(report.shortest_step > 0.0 && report.shortest_step < report.longest_step);
}

#[test]
fn step_limits_in_length_are_kept() {
    let solution = Dop853::new(Options {
        max_step: Some(0.05),
        ..Options::with_tolerance(1e-6)
    })
    .integrate(&kepler(), &perihelion(0.2), 4.0, watch)
    .unwrap();
    assert!(solution.report.longest_step <= 0.05 * 1.01);
    assert!(solution.report.accepted >= 79);
}

/// Two motions, one of which goes through a checkpoint after each step: the same steps.
fn through_checkpoints<M>(method: &M, ode: &dyn TaylorOde<f64>, start: &State<f64>)
where
    M: for<'a> Integrator<f64, &'a dyn TaylorOde<f64>>,
{
    let mut whole = method.start(ode, start).unwrap();
    let mut parts = method.start(ode, start).unwrap();
    for step in 0..60 {
        // An end off the grid, and back again, on the way.
        let end = match step {
            0..20 => 7.0,
            20..40 => 0.013,
            _ => 100.0,
        };
        let (mut one, mut other) = (Vec::new(), Vec::new());
        if let Some(step) = whole.step_to(end).unwrap() {
            record(&mut one, &step);
        }
        if let Some(step) = parts.step_to(end).unwrap() {
            record(&mut other, &step);
        }
        assert_eq!(one, other, "step {step}");
        parts = method.resume(ode, &parts.checkpoint().unwrap()).unwrap();
    }
    assert_eq!(parts.report(), whole.report());
    // At frames both lay the motion down.
    for frame in 0..60 {
        whole.advance(0.017).unwrap();
        parts.advance(0.017).unwrap();
        assert_eq!(parts.time(), whole.time());
        assert_eq!(parts.state(), whole.state(), "frame {frame}");
        whole.checkpoint().unwrap();
        parts = method.resume(ode, &parts.checkpoint().unwrap()).unwrap();
    }
}

#[test]
fn checkpoints_keep_every_bit() {
    let options = || Options {
        beta: 0.04,
        compensated: true,
        ..Options::with_tolerance(1e-10)
    };
    let ode = kepler();
    let start = perihelion(0.5);
    fn on<M>(method: M, ode: &impl Ode<f64>, start: &State<f64>)
    where
        M: for<'a> Integrator<f64, &'a dyn TaylorOde<f64>>,
    {
        through_checkpoints(&method, &RatesOnly(ode), start);
    }
    on(Dopri5::new(options()), &ode, &start);
    on(Dop853::new(options()), &ode, &start);
    on(Verner98::new(options()), &ode, &start);
    on(Rk4::new(0.01), &ode, &start);
    on(Gauss::new(GaussOrder::Six, 0.05), &ode, &start);
    let newton = Gauss {
        solver: Solver::Newton,
        ..Gauss::new(GaussOrder::Four, 0.05)
    };
    on(newton, &ode, &start);
    on(Method::Dop853.with(1e-8), &ode, &start);
    let series = Taylor::new(Options {
        compensated: true,
        ..Options::with_tolerance(1e-14)
    });
    through_checkpoints(&series, &Mathematical, &State::new(0.0, vec![2.0, 0.0]));
}

/// A checkpoint of another method is refused.
#[test]
fn a_checkpoint_is_of_one_method() {
    let ode = kepler();
    let mut stepper = Rk4::new(0.01).start(&ode, &perihelion(0.5)).unwrap();
    stepper.step().unwrap();
    let checkpoint = stepper.checkpoint().unwrap();
    let refused = Dop853::new(Options::with_tolerance(1e-9)).resume(&ode, &checkpoint);
    assert!(matches!(
        refused.err(),
        Some(IntegrationError::Input(InputError::Checkpoint { .. }))
    ));
}
