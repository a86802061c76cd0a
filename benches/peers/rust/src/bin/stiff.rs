//! A stiff tree by BDF of `diffsol`: implicit methods of other crates take the accelerations of an
//! emitted model, and products of its Jacobian with a vector, which dual numbers give exactly.

use std::error::Error;

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Dual;
use branched_pendulum_peers::scenes::Reed;
use diffsol::{NalgebraLU, NalgebraMat, OdeBuilder, OdeSolverMethod, OdeSolverStopReason, Vector};

/// Angles (rad) and angular velocities (rad/s) at the start, and the time at the end (s).
const START: [f64; 6] = [0.02, -0.01, 0.8, 0.0, 0.0, 0.0];
const END: f64 = 2.0;

/// Writes the rates of a state: velocities and accelerations.
fn rates(state: &[f64], time: f64, rates: &mut [f64]) {
    let ((theta, omega), (turning, alpha)) = (state.split_at(3), rates.split_at_mut(3));
    turning.copy_from_slice(omega);
    Reed::<f64>::new().accelerations_into(time, theta, omega, alpha);
}

/// Writes the derivative of the rates in the direction `along`.
fn rates_along(state: &[f64], time: f64, along: &[f64], rates: &mut [f64]) {
    let pairs = state.iter().zip(along);
    let varied = pairs.map(|(&value, &slope)| Dual {
        value,
        tangents: [slope],
    });
    let varied: Vec<Dual<f64, 1>> = varied.collect();
    let (theta, omega) = varied.split_at(3);
    let mut alpha = [Dual::constant(0.0); 3];
    Reed::<Dual<f64, 1>>::default().accelerations_into(
        Dual::constant(time),
        theta,
        omega,
        &mut alpha,
    );
    let slopes = omega.iter().chain(&alpha).map(|own| own.tangents[0]);
    rates
        .iter_mut()
        .zip(slopes)
        .for_each(|(rate, slope)| *rate = slope);
}

fn main() -> Result<(), Box<dyn Error>> {
    let model = Reed::<f64>::new();
    let system = AbsoluteAngles(&model);
    let start = State::new(0.0, START.to_vec());
    let exact = Gauss::new(GaussOrder::Eight, 1e-3).run(&system, &start, END)?;
    let explicit = Dop853::new(Options::with_tolerance(1e-6)).run(&system, &start, END)?;
    println!(
        "tolerance   steps of BDF   error   (Dop853 at 1e-6: {} steps)",
        explicit.report.accepted
    );
    for tolerance in [1e-4, 1e-6, 1e-8] {
        let problem = OdeBuilder::<NalgebraMat<f64>>::new()
            .rtol(tolerance)
            .atol([tolerance])
            .rhs_implicit(
                |state: &[f64], _: &[f64], time: f64, out: &mut [f64]| rates(state, time, out),
                |state: &[f64], _: &[f64], time: f64, along: &[f64], out: &mut [f64]| {
                    rates_along(state, time, along, out);
                },
            )
            .init(
                |_: &[f64], _: f64, state: &mut [f64]| state.copy_from_slice(&START),
                6,
            )
            .build()?;
        let mut solver = problem.bdf::<NalgebraLU<f64>>()?;
        solver.set_stop_time(END)?;
        let mut steps = 1;
        while !matches!(solver.step()?, OdeSolverStopReason::TstopReached) {
            steps += 1;
        }
        let end = solver.state().y.clone_as_vec();
        let pairs = end.iter().zip(&exact.state.values);
        let error = pairs.fold(0.0, |worst: f64, (a, b)| worst.max((a - b).abs()));
        println!("{tolerance:9.0e}   {steps:12}   {error:.1e}");
    }
    Ok(())
}
