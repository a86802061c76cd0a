//! Dense output: stores a motion and returns its state at any time, as accurately as the
//! integrator's steps.

use branched_pendulum::prelude::*;

/// A rod.
#[branched_pendulum(
    gravity = 9.80665,
    rod(mass = 0.2, com = 0.25, inertia = 4e-3),
    emit(energies)
)]
struct Rod;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let rod = Rod::new();
    let start = State::at_rest(0.0, &[2.0]);
    let method = Dop853::new(Options::with_tolerance(1e-11));
    let motion = method.trajectory(&AbsoluteAngles(&rod), &start, 10.0)?;
    let energy = |state: &[f64]| rod.energy_of(&state[..1], &state[1..]);
    let first = energy(&start.values);
    let mut worst = 0.0_f64;
    for k in 0..=1000 {
        // Not where a step ends.
        let state = motion.at(0.01 * f64::from(k))?;
        worst = worst.max((energy(&state) / first - 1.0).abs());
    }
    println!("energy between the steps kept to {worst:.1e}");
    let state = motion.at(7.3)?;
    println!("at 7.3 s {:.6} rad, {:.6} rad/s", state[0], state[1]);
    println!("{}", motion.at(10.1).unwrap_err());
    Ok(())
}
