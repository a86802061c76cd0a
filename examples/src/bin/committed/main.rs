//! A committed expansion: the code that the attribute generates for `scene.rs` is stored as
//! `model.rs`. The crate then builds without Symbolica (`branched-pendulum` without its feature
//! `macros`), and without the standard library.
//!
//! `cargo branched-pendulum expand scene.rs --output model.rs` writes the file, and `cargo
//! branched-pendulum check scene.rs model.rs` fails if the file differs from what the compiler
//! writes.

#[rustfmt::skip]
mod model;

use branched_pendulum::prelude::*;
use model::Rod;

fn main() -> Result<(), IntegrationError<f64>> {
    let rod = Rod::new();
    let start = State::at_rest(0.0, &[1.0]);
    let energy = |state: &State<f64>| rod.energy_of(state.positions(), state.velocities());
    let method = Rk4::new(1e-3);
    let end = method.run(&AbsoluteAngles(&rod), &start, 10.0)?;
    let left = 100.0 * energy(&end.state) / energy(&start);
    println!("{left:.4} % of the energy is left after 10 s of friction");
    Ok(())
}
