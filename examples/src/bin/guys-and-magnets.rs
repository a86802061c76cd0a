//! Forces between points: a Y that two guys hold upright, with magnets on its arms that repel each
//! other. Without the guys it falls.

use branched_pendulum::prelude::*;
use branched_pendulum::system::{LinkPoint, Positions, UnderTorques};

/// A mast without any spring in its pivot, and two arms on springs. The guys are taut wherever
/// they hold the mast: a straight spring pushes where a slack rope does not.
#[branched_pendulum(
    gravity = -9.80665,
    mast: rod(mass = 0.3, length = 0.4) [
        left: rod(mass = 0.05, length = 0.2, spring = 0.2, rest = 0.5),
        right: rod(mass = 0.05, length = 0.2, spring = 0.2, rest = -0.5),
    ],
    guy(mast, at = 0.4, to = (-0.4, 0), spring = stiffness, rest = 0.5),
    guy(mast, at = 0.4, to = (0.4, 0), spring = stiffness, rest = 0.5),
    emit(energies, positions, forces),
)]
struct Y;

/// The links, in the order of the description.
const MAST: usize = 0;
const LEFT: usize = 1;
const RIGHT: usize = 2;
/// Strength of both magnets, 3 μ₀ m²/(4 π), N m⁴.
const MAGNETS: f64 = 1e-4;

/// The energy of two dipoles side by side, and the forces on the ends of the links.
fn magnets(ends: &[[f64; 2]; 3]) -> (f64, [[f64; 2]; 3]) {
    let [x, y] = [0, 1].map(|axis| ends[LEFT][axis] - ends[RIGHT][axis]);
    let distance = x.hypot(y);
    let energy = MAGNETS / (3.0 * distance.powi(3));
    let push = 3.0 * energy / distance;
    let force = [push * x / distance, push * y / distance];
    let mut forces = [[0.0; 2]; 3];
    forces[LEFT] = force;
    forces[RIGHT] = force.map(|own| -own);
    (energy, forces)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let start = State::at_rest(0.0, &[0.1, 0.4, -0.6]);
    let method = Dop853::new(Options::with_tolerance(1e-10));
    let times: Vec<f64> = (0..=10).map(|step| 0.1 * f64::from(step)).collect();
    for (title, stiffness) in [("with guys", 60.0), ("without", 0.0)] {
        let tree = Y::new(YParameters { stiffness })?;
        let forces = |_: f64, theta: &[f64], _: &[f64], torques: &mut [f64]| {
            let mut ends = [[0.0; 2]; 3];
            tree.points_into(LinkPoint::End, theta, &mut ends);
            let (_, forces) = magnets(&ends);
            tree.point_torques_into(LinkPoint::End, theta, &forces, torques);
        };
        println!("{title:>9}: mast (°)  magnets apart (m)  energy (J)");
        method.sample(
            &UnderTorques::new(&tree, forces),
            &start,
            &times,
            |time, state| {
                let [theta, omega] = [0, 3].map(|first| [0, 1, 2].map(|link| state[first + link]));
                let ends = tree.ends(&theta);
                let [x, y] = [0, 1].map(|axis| ends[LEFT][axis] - ends[RIGHT][axis]);
                // The guys' energy is the tree's.
                let energy = tree.kinetic_energy(&theta, &omega) + tree.potential_energy(&theta);
                let (stored, _) = magnets(&ends);
                println!(
                    "{time:7.1} s: {:8.3}  {:17.4}  {:10.7}",
                    theta[MAST].to_degrees(),
                    x.hypot(y),
                    energy + stored
                );
            },
        )?;
    }
    Ok(())
}
