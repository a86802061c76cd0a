//! Events: the times at which a link of a double pendulum turns over, and the turning points
//! before.

use std::f64::consts::PI;

use branched_pendulum::integrate::{Crossing, Event};
use branched_pendulum::prelude::*;

/// Two rods, the second hanging from the first.
#[branched_pendulum(
    gravity = 9.80665,
    upper: rod(mass = 0.2, length = 0.3) [lower: rod(mass = 0.1, length = 0.2)],
)]
struct Chain;

fn main() -> Result<(), IntegrationError<f64>> {
    let chain = Chain::new();
    let start = State::at_rest(0.0, &[1.9, 1.9]);
    let turns_back = |_: f64, state: &[f64]| state[3];
    let turns_over = |_: f64, state: &[f64]| state[1].abs() - PI;
    let events = [
        Event::new(Crossing::Either, &turns_back),
        // The run ends there.
        Event::new(Crossing::Rising, &turns_over).with_terminal(1),
    ];
    let end = Dop853::new(Options::with_tolerance(1e-12)).integrate_with_events(
        &AbsoluteAngles(&chain),
        &start,
        60.0,
        &events,
        |found| {
            let (time, degrees) = (found.time, found.state[1].to_degrees());
            match found.event {
                0 => println!("{time:8.5} s  the lower rod turns back at {degrees:7.2}°"),
                _ => println!("{time:8.5} s  it turns over"),
            }
            ControlFlow::Continue(())
        },
    )?;
    println!("the run ended at {:.5} s", end.state.time);
    Ok(())
}
