//! Forces between points: two guys (straight springs to the ground) hold a Y upright, and magnets
//! on its arms repel each other. Without the guys it falls.

use branched_pendulum::prelude::*;

/// A mast without a spring in its pivot, and two arms on springs. The guys must stay taut: a
/// straight spring would push when a slack rope does not. The magnets are dipoles perpendicular to
/// the plane, of the strength μ₀ m²/(4 π).
#[branched_pendulum(
    gravity = -9.80665,
    mast: rod(mass = 0.3, length = 0.4) [
        left: rod(mass = 0.05, length = 0.2, spring = 0.2, rest = 0.5),
        right: rod(mass = 0.05, length = 0.2, spring = 0.2, rest = -0.5),
    ],
    guy(mast, at = 0.4, to = (-0.4, 0), spring = stiffness, rest = 0.5),
    guy(mast, at = 0.4, to = (0.4, 0), spring = stiffness, rest = 0.5),
    between(left, right, at = 0.2, repulsion = 1e-4 / 3, exponent = 3),
    emit(energies, positions),
)]
struct Y;

/// Indices of the links, in the order of the description.
const MAST: usize = 0;
const LEFT: usize = 1;
const RIGHT: usize = 2;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let start = State::at_rest(0.0, &[0.1, 0.4, -0.6]);
    let method = Dop853::new(Options::with_tolerance(1e-10));
    let times: Vec<f64> = (0..=10).map(|step| 0.1 * f64::from(step)).collect();
    for (title, stiffness) in [("with guys", 60.0), ("without", 0.0)] {
        let tree = Y::new(YParameters { stiffness })?;
        println!("{title:>9}: mast (°)  magnets apart (m)  energy (J)");
        method.sample(&AbsoluteAngles(&tree), &start, &times, |time, state| {
            let [theta, omega] = [0, 3].map(|first| [0, 1, 2].map(|link| state[first + link]));
            let ends = tree.ends(&theta);
            let [x, y] = [0, 1].map(|axis| ends[LEFT][axis] - ends[RIGHT][axis]);
            // Guys and magnets are part of the tree.
            let energy = tree.kinetic_energy(&theta, &omega) + tree.potential_energy(&theta);
            println!(
                "{time:7.1} s: {:8.3}  {:17.4}  {energy:10.7}",
                theta[MAST].to_degrees(),
                x.hypot(y),
            );
        })?;
    }
    Ok(())
}
