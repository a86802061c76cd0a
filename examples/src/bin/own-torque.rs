//! A user-defined torque: gusts of wind that drag at the ends of a branch.

use branched_pendulum::prelude::*;
use branched_pendulum::system::{LinkPoint, UnderTorques};

/// A limb with two twigs and friction in the joints.
#[branched_pendulum(
    gravity = 9.80665,
    limb: rod(mass = 0.4, length = 0.5, friction = 0.1) [
        twig: rod(mass = 0.1, length = 0.3, friction = 0.01) * 2
    ],
    emit(positions, forces),
)]
struct Branch;

fn main() -> Result<(), IntegrationError<f64>> {
    let branch = Branch::new();
    let wind = |time: f64| 5.0 + 3.0 * (2.0 * time).sin();
    let gusts = UnderTorques::new(
        &branch,
        |time: f64, theta: &[f64], omega: &[f64], torques: &mut [f64]| {
            let mut velocities = [[0.0; 2]; 3];
            branch.point_velocities_into(LinkPoint::End, theta, omega, &mut velocities);
            let drag = velocities.map(|[x, y]| [0.05 * (wind(time) - x), -0.05 * y]);
            branch.point_torques_into(LinkPoint::End, theta, &drag, torques);
        },
    );
    let method = Dop853::new(Options::with_tolerance(1e-9));
    let start = State::at_rest(0.0, &[0.0; 3]);
    let times: Vec<f64> = (0..=10).map(f64::from).collect();
    method.sample(&gusts, &start, &times, |time, state| {
        let degrees = state[0].to_degrees();
        println!(
            "{time:4} s  wind {:4.1} m/s  limb at {degrees:5.1}°",
            wind(time)
        );
    })?;
    Ok(())
}
