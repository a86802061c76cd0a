//! Does a small difference between two equal links grow when they swing?

use branched_pendulum::prelude::*;
use branched_pendulum_charts::{Axis, Chart, Panel};
use std::error::Error;
use std::process::ExitCode;

/// Two equal links that hang from one: the apparatus of Toda and Ooshida.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ],
    emit(energies, symmetric),
)]
struct BranchedDouble;

fn run() -> Result<(), Box<dyn Error>> {
    let model = BranchedDouble::new();
    // Symmetric coordinates: the parent's angle, mean and half the difference of
    // the children's.
    let start = State::at_rest(0.0, &[47.8_f64.to_radians(), 0.0, 0.01]);
    let times: Vec<f64> = (0..=1000).map(|i| 0.01 * f64::from(i)).collect();
    let mut differences = Vec::new();
    let solution = Dop853::new(Options::with_tolerance(1e-12)).sample(
        &SymmetricCoordinates(&model),
        &start,
        &times,
        |_time, state| differences.push(state[2]),
    )?;
    println!("{}", solution.report);
    let largest = differences
        .iter()
        .fold(0.0, |most: f64, d| most.max(d.abs()));
    println!("θ_d grew from {} to {largest:.2} rad", differences[0]);

    let panel = Panel::new(Axis::linear("θ_d (rad)")).line("θ_d", &times, &differences);
    Chart::new("Antiphase angle", Axis::linear("t (s)"))
        .panel(panel)
        .write_svg("antiphase-angle.svg")?;
    println!("antiphase-angle.svg");
    Ok(())
}

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        // `fn main() -> Result` would show the error's fields in place of its message.
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
