//! Trajectories that are kept.

use branched_pendulum::integrate::{DenseError, Projected, Trajectory};
use branched_pendulum::prelude::*;

use crate::problems::{BranchedDouble, growth_and_decay, harmonic};

/// What is kept is what the run gave, to the bit, and its derivative that of the motion
/// within `error`.
fn kept<O: Ode<f64>>(ode: &O, method: &impl Integrator<f64, O>, end: f64, error: f64) {
    let start = State::new(0.5, vec![0.3; ode.dimension()]);
    let trajectory = method.trajectory(ode, &start, end).unwrap();
    let n = ode.dimension();
    let (mut value, mut slope, mut rates) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    let mut steps = 0;
    method
        .integrate(ode, &start, end, |step| {
            steps += 1;
            for part in [0.0, 0.1, 0.5, 0.77, 1.0] {
                let time = step.start_time() + part * (step.end_time() - step.start_time());
                let time = if part == 1.0 { step.end_time() } else { time };
                step.eval(time, &mut value).unwrap();
                assert_eq!(trajectory.at(time).unwrap(), value);
                step.derivative(time, &mut slope).unwrap();
                ode.rates(time, &value, &mut rates);
                for (a, b) in slope.iter().zip(&rates) {
                    assert!((a - b).abs() < error, "{time}: {a} {b}");
                }
                // At the ends of steps it is that of the step before.
                if part != 0.0 {
                    trajectory.derivative_into(time, &mut rates).unwrap();
                    assert_eq!(rates, slope);
                }
            }
            ControlFlow::Continue(())
        })
        .unwrap();
    assert_eq!(trajectory.times().len(), steps + 1);
    assert_eq!((trajectory.start_time(), trajectory.end_time()), (0.5, end));
    for time in [0.5 - 0.01 * end.signum(), f64::NAN, 10.0 * end] {
        let error = trajectory.at(time).unwrap_err();
        assert!(matches!(error, DenseError::OutsideStep { .. }), "{time}");
    }
}

#[test]
fn of_every_method() {
    let options = || Options::with_tolerance(1e-8);
    let ode = growth_and_decay();
    for end in [6.0, -3.0] {
        kept(&ode, &Dopri5::new(options()), end, 1e-3);
        kept(&ode, &Dop853::new(options()), end, 1e-4);
        kept(&ode, &Verner98::new(options()), end, 1e-4);
        kept(&ode, &Rk4::new(0.01), end, 1e-4);
        kept(&ode, &Gauss::new(GaussOrder::Two, 0.001), end, 1e-2);
        kept(&ode, &Gauss::new(GaussOrder::Eight, 0.03), end, 1e-5);
    }
    let energy = |y: &[f64], gradient: &mut [f64]| {
        gradient.copy_from_slice(y);
        0.5 * (y[0] * y[0] + y[1] * y[1])
    };
    let projected = Projected::new(Gauss::new(GaussOrder::Four, 0.03), energy);
    kept(&harmonic(), &projected, 4.0, 1e-3);
    let projected = Projected::new(Rk4::new(0.03), energy);
    kept(&harmonic(), &projected, 4.0, 1e-3);
    let pendulum = BranchedDouble::paper();
    let ode = CanonicalVariables(&pendulum);
    // The motion is fast: its rates reach 500.
    let precise = Options::with_tolerance(1e-9);
    kept(&ode, &Dop853::new(precise), 2.0, 1e-2);
}

#[test]
fn steps_that_do_not_follow_are_refused() {
    let ode = harmonic::<f64>();
    let start = State::at_rest(0.0, &[1.0]);
    let mut trajectory = Trajectory::new(start.clone());
    assert_eq!(trajectory.at(0.0).unwrap(), start.values);
    assert!(trajectory.at(0.1).is_err());
    let mut stepper = Rk4::new(0.1).start(&ode, &start).unwrap();
    trajectory.push(&mut stepper.step().unwrap()).unwrap();
    stepper.step().unwrap();
    assert!(trajectory.push(&mut stepper.step().unwrap()).is_err());
    stepper.set_state(0.1, &[0.9, 0.0]).unwrap();
    // Backwards over itself.
    assert!(
        trajectory
            .push(&mut stepper.step_to(0.0).unwrap().unwrap())
            .is_err()
    );
    assert_eq!(trajectory.times(), [0.0, 0.1]);
    assert!(trajectory.at_into(0.05, &mut [0.0; 3]).is_err());
}
