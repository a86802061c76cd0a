//! Damping by branching: a trunk without friction gives its energy to branches with friction. This
//! works the better the more the trunk sways, and best if the branches open and close at twice its
//! frequency (B. Theckes, E. de Langre and X. Boutillon, Bioinspir. Biomim. 6, 046010, 2011).

use branched_pendulum::analysis::{AtRest, equilibrium};
use branched_pendulum::prelude::*;

/// A standing Y on springs. Friction acts only on the opening and closing of the branches: while
/// both lean to the same side, small motions do not feel it.
#[branched_pendulum(
    gravity = -9.80665,
    trunk: rod(mass = 0.3, length = 0.4, spring = 20.0) [
        left: rod(mass = 0.1, length = 0.3, spring = stiffness, rest = 1.57),
        right: rod(mass = 0.1, length = 0.3, spring = stiffness, rest = -1.57),
    ],
    between(left, right, friction = friction),
    emit(energies, modes),
)]
struct Y;

/// Moment of inertia of a branch about its pivot, in kg m².
const INERTIA: f64 = 0.1 * 0.3 * 0.3 / 3.0;
/// Amplitudes of the branches at the release, in rad.
const AMPLITUDES: [f64; 4] = [0.05, 0.1, 0.2, 0.3];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("energy that is lost within 20 s, by the amplitude of the branches\n");
    let titles = AMPLITUDES.map(|amplitude| format!("{amplitude:6.2} rad"));
    println!("sway Hz  opening Hz  ratio {}", titles.join(""));
    for stiffness in [2.5, 3.3, 4.1, 4.9, 6.4] {
        let free = Y::new(YParameters {
            stiffness,
            friction: 0.0,
        })?;
        let at = |theta: &[f64; 3]| AtRest {
            mass: free.mass_matrix(theta),
            stiffness: free.stiffness_matrix(theta),
            accelerations: free.accelerations(theta, &[0.0; 3]),
        };
        let rest = equilibrium([0.0, 1.57, -1.57], at)?;
        let modes = at(&rest).modes()?;
        let (sway, opening) = (modes.frequencies_hz[0], modes.frequencies_hz[1]);
        // A tenth of the critical friction of the opening: I d̈ = −k d − 2 c ḋ.
        let friction = 0.1 * INERTIA * std::f64::consts::TAU * opening;
        let model = Y::new(YParameters {
            stiffness,
            friction,
        })?;
        let mut lost = String::new();
        for amplitude in AMPLITUDES {
            let shape = &modes.shapes[0];
            let rate = std::f64::consts::TAU * sway * amplitude / shape[1];
            let rates: Vec<f64> = shape.iter().map(|part| rate * part).collect();
            let start = State::new(0.0, [rest.to_vec(), rates].concat());
            let method = Dop853::new(Options::with_tolerance(1e-10));
            let end = method.run(&AbsoluteAngles(&model), &start, 20.0)?;
            let energy =
                |state: &State<f64>| model.energy_of(state.positions(), state.velocities());
            let given = model.kinetic_energy_of(start.positions(), start.velocities());
            let loss = (energy(&start) - energy(&end.state)) / given;
            lost += &format!("{:8.1} %", 100.0 * loss);
        }
        println!("{sway:7.3}  {opening:10.3}  {:5.2} {lost}", opening / sway);
    }
    Ok(())
}
