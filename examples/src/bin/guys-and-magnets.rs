//! Forces between points: a Y that two guys hold upright, with magnets on its arms that repel each
//! other. Without the guys it falls.

use branched_pendulum::prelude::*;
use branched_pendulum::system::{LinkPoint, Positions, UnderTorques};

/// A mast without any spring in its pivot, and two arms on springs.
#[branched_pendulum(
    gravity = -9.80665,
    mast: rod(mass = 0.3, length = 0.4) [
        left: rod(mass = 0.05, length = 0.2, spring = 0.2, rest = 0.5),
        right: rod(mass = 0.05, length = 0.2, spring = 0.2, rest = -0.5),
    ],
    emit(energies, positions, forces),
)]
struct Y;

/// The links, in the order of the description.
const MAST: usize = 0;
const LEFT: usize = 1;
const RIGHT: usize = 2;
/// Where the guys are tied to the ground, m.
const PEGS: [[f64; 2]; 2] = [[-0.4, 0.0], [0.4, 0.0]];
/// Length of a guy that does not pull, m.
const LENGTH: f64 = 0.55;
/// Strength of both magnets, 3 μ₀ m²/(4 π), N m⁴.
const MAGNETS: f64 = 1e-4;

/// A force along the line between two points by their distance: energy, and what pushes the first
/// point away from the second.
type Law = fn(f64) -> (f64, f64);

/// A rope that pulls with `stiffness` (N/m) once it is taut, and pushes never.
fn guy(distance: f64) -> (f64, f64) {
    let (stiffness, stretch) = (60.0, (distance - LENGTH).max(0.0));
    (0.5 * stiffness * stretch * stretch, -stiffness * stretch)
}

/// Two dipoles side by side.
fn magnets(distance: f64) -> (f64, f64) {
    let energy = MAGNETS / (3.0 * distance.powi(3));
    (energy, 3.0 * energy / distance)
}

fn along([a, b]: [[f64; 2]; 2], law: Law) -> (f64, [f64; 2]) {
    let [x, y] = [a[0] - b[0], a[1] - b[1]];
    let distance = x.hypot(y);
    let (energy, push) = law(distance);
    (energy, [push * x / distance, push * y / distance])
}

/// The energy of magnets and of guys to these pegs, and the forces on the ends of the links.
fn between(ends: &[[f64; 2]; 3], pegs: &[[f64; 2]]) -> (f64, [[f64; 2]; 3]) {
    let (mut sum, mut forces) = (0.0, [[0.0; 2]; 3]);
    for peg in pegs {
        let (energy, force) = along([ends[MAST], *peg], guy);
        sum += energy;
        forces[MAST] = [0, 1].map(|axis| forces[MAST][axis] + force[axis]);
    }
    let (energy, force) = along([ends[LEFT], ends[RIGHT]], magnets);
    forces[LEFT] = force;
    forces[RIGHT] = force.map(|own| -own);
    (sum + energy, forces)
}

fn main() -> Result<(), IntegrationError<f64>> {
    let tree = Y::new();
    let start = State::at_rest(0.0, &[0.1, 0.4, -0.6]);
    let method = Dop853::new(Options::with_tolerance(1e-10));
    let times: Vec<f64> = (0..=10).map(|step| 0.1 * f64::from(step)).collect();
    for (title, pegs) in [("with guys", &PEGS[..]), ("without", &[])] {
        let forces = |_: f64, theta: &[f64], _: &[f64], torques: &mut [f64]| {
            let mut ends = [[0.0; 2]; 3];
            tree.points_into(LinkPoint::End, theta, &mut ends);
            let (_, forces) = between(&ends, pegs);
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
                let energy = tree.kinetic_energy(&theta, &omega) + tree.potential_energy(&theta);
                let (stored, _) = between(&ends, pegs);
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
