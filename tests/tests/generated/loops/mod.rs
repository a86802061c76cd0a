//! Trees whose code is loops, over generations or a table, with drives, offsets and
//! places of their own: against the same trees written out, and against Jacobians
//! of the tests' own.

mod coupled;
mod driven;
mod friction;
mod offsets;
mod places;
mod pullbacks;
mod straight;

use branched_pendulum::prelude::*;
use branched_pendulum_codegen::scene::Scene;
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_compiler_tests::source;
use branched_pendulum_tests::bodies::bodies_of;
use branched_pendulum_tests::oracle::Tree;
use branched_pendulum_tests::oracle::cartesian::Motion;
use branched_pendulum_tests::oracle::drive::{Jet, Push};
use nalgebra::DVector;

/// A tree in loops, the same one written out, its text, and the powers of both.
macro_rules! pair {
    ($loops:ident, $unrolled:ident, $text:ident: $($tree:tt)*) => {
        #[branched_pendulum(gravity = 9.80665, code = loops, emit(energies), $($tree)*)]
        struct $loops;

        #[branched_pendulum(gravity = 9.80665, code = unrolled, emit(energies), $($tree)*)]
        struct $unrolled;

        const $text: &str =
            concat!("gravity = 9.80665, code = unrolled, ", stringify!($($tree)*));
    };
}

/// A model that is driven.
trait Powered: Energy<f64> {
    fn power(&self, time: f64, theta: &[f64], omega: &[f64]) -> f64;
    fn loss(&self, omega: &[f64]) -> f64;
}

macro_rules! powered {
    ($loops:ident, $unrolled:ident) => {
        powered!($loops, $unrolled, omega => 0.0, 0.0);
    };
    ($loops:ident, $unrolled:ident, braked) => {
        impl Powered for $loops {
            fn power(&self, time: f64, theta: &[f64], omega: &[f64]) -> f64 {
                self.drive_power(time, theta, omega)
            }
            fn loss(&self, omega: &[f64]) -> f64 {
                self.friction_power(omega)
            }
        }
        impl Powered for $unrolled {
            fn power(&self, time: f64, theta: &[f64], omega: &[f64]) -> f64 {
                self.drive_power(time, array(theta), array(omega))
            }
            fn loss(&self, omega: &[f64]) -> f64 {
                self.friction_power(array(omega))
            }
        }
    };
    ($loops:ident, $unrolled:ident, $omega:ident => $own:expr, $other:expr) => {
        impl Powered for $loops {
            fn power(&self, time: f64, theta: &[f64], omega: &[f64]) -> f64 {
                self.drive_power(time, theta, omega)
            }
            fn loss(&self, _: &[f64]) -> f64 {
                $own
            }
        }
        impl Powered for $unrolled {
            fn power(&self, time: f64, theta: &[f64], omega: &[f64]) -> f64 {
                self.drive_power(time, array(theta), array(omega))
            }
            fn loss(&self, _: &[f64]) -> f64 {
                $other
            }
        }
    };
}

fn array<const N: usize>(numbers: &[f64]) -> &[f64; N] {
    numbers.try_into().unwrap()
}

use {pair, powered};

/// The drive of these trees, the parts that they have: torque, and motion of the pivot.
/// In the attribute: `torque = 0.4 * cos(3 * t)`, `x = 0.2 * sin(5 * t)`,
/// `y = 0.1 * cos(4 * t)`.
fn push(time: f64, parts: [bool; 2]) -> Push {
    let wave = |size: f64, rate: f64| (Jet::constant(size), Jet::constant(rate) * Jet::time(time));
    let [torque, moved] = parts.map(f64::from);
    let (size, angle) = wave(0.4 * torque, 3.0);
    let torque = size * angle.cos();
    let (size, angle) = wave(0.2 * moved, 5.0);
    let x = size * angle.sin();
    let (size, angle) = wave(0.1 * moved, 4.0);
    let y = size * angle.cos();
    Push {
        torque: torque.value[0],
        acceleration: [x.value[2], y.value[2]],
        torque_terms: torque.terms[0],
        acceleration_terms: [x.terms[2], y.terms[2]],
    }
}

fn scene_of(text: &str) -> Scene {
    source::stages_of(&format!("#[branched_pendulum({text})] struct Sample;")).scene
}

/// Index in the first model of each link of the second, by name.
fn order<L: Pendulum<f64>, U: Pendulum<f64>>(loops: &L, unrolled: &U) -> Vec<usize> {
    assert_eq!(loops.links(), unrolled.links());
    let names = loops.link_names();
    let find = |name: &String| names.iter().position(|other| other == name).unwrap();
    unrolled.link_names().iter().map(find).collect()
}

fn placed(order: &[usize], numbers: &[f64]) -> Vec<f64> {
    let mut own = vec![0.0; numbers.len()];
    for (&place, &number) in order.iter().zip(numbers) {
        own[place] = number;
    }
    own
}

/// Weights times the farthest that their bodies can be from the root's pivot:
/// potential energies of links that point up and down cancel.
fn lifted(tree: &Tree) -> f64 {
    let links = tree.links.iter().enumerate();
    let sizes = links.map(|(index, link)| {
        let levers = tree.lineage(index).into_iter();
        let reach: f64 = levers
            .map(|link| tree.links[link].pivot.map(f64::abs).iter().sum::<f64>())
            .sum();
        tree.gravity * link.mass * (reach + link.com.map(f64::abs).iter().sum::<f64>())
    });
    sizes.sum()
}

struct State {
    time: f64,
    theta: Vec<f64>,
    omega: Vec<f64>,
}

fn states(n: usize, count: usize) -> impl Iterator<Item = State> {
    let mut random = Random::new(7);
    (0..count).map(move |_| State {
        time: random.between(-3.0, 3.0),
        theta: random.around_zero(n, 3.0),
        omega: random.around_zero(n, 9.0),
    })
}

/// Accelerations within roundings of the conditioning bound of the code written
/// out, and of the oracle; energies of the code written out.
fn agree<L: Energy<f64>, U: Energy<f64>>(loops: &L, unrolled: &U, text: &str, parts: [bool; 2]) {
    let n = unrolled.links();
    let order = order(loops, unrolled);
    let tree = bodies_of(&scene_of(text));
    let (mut worst, mut farthest) = (0.0_f64, 0.0_f64);
    for State { time, theta, omega } in states(n, 100) {
        let (own_theta, own_omega) = (placed(&order, &theta), placed(&order, &omega));
        let (mut alpha, mut other) = (vec![f64::NAN; n], vec![f64::NAN; n]);
        loops.accelerations_into(time, &own_theta, &own_omega, &mut alpha);
        unrolled.accelerations_into(time, &theta, &omega, &mut other);
        let motion = Motion::driven(&tree, &theta, &omega, &push(time, parts));
        let right = motion.accelerations();
        let bound = motion.sensitivity(&DVector::from_column_slice(&other));
        for (link, &place) in order.iter().enumerate() {
            let (own, other) = (alpha[place], other[link]);
            assert!(own.is_finite());
            // A link that is balanced on its pivot turns as it does.
            if bound[link] == 0.0 {
                assert!(own == 0.0 && other == 0.0, "{own} {other}");
                continue;
            }
            worst = worst.max((own - other).abs() / bound[link]);
            farthest = farthest.max((own - right[link]).abs() / bound[link]);
        }
        let energies = [
            loops.kinetic_energy_of(&own_theta, &own_omega),
            unrolled.kinetic_energy_of(&theta, &omega),
            loops.potential_energy_of(&own_theta),
            unrolled.potential_energy_of(&theta),
        ];
        let [kinetic, other_kinetic, potential, other_potential] = energies;
        assert!((kinetic - other_kinetic).abs() <= 1e-14 * other_kinetic);
        let size = lifted(&tree) + other_potential.abs();
        assert!((potential - other_potential).abs() <= 1e-14 * size);
    }
    println!(
        "{n} links: {worst:.1e} of the bound from code written out, {farthest:.1e} from the oracle"
    );
    assert!(worst < 2.0 * f64::EPSILON, "{worst:e}");
    assert!(farthest < 1e-13, "{farthest:e}");
}

/// The powers of the code written out; and they are dE/dt, by differences along
/// the motion.
fn balance<L: Powered, U: Powered>(loops: &L, unrolled: &U) {
    let n = unrolled.links();
    let order = order(loops, unrolled);
    for State { time, theta, omega } in states(n, 50) {
        let (own_theta, own_omega) = (placed(&order, &theta), placed(&order, &omega));
        let power = loops.power(time, &own_theta, &own_omega);
        let other = unrolled.power(time, &theta, &omega);
        let mut alpha = vec![0.0; n];
        loops.accelerations_into(time, &own_theta, &own_omega, &mut alpha);
        let loss = loops.loss(&own_omega);
        let scale = loops.kinetic_energy_of(&own_theta, &own_omega) + power.abs();
        assert!((power - other).abs() < 1e-13 * scale, "{power} {other}");
        assert!((loss - unrolled.loss(&omega)).abs() <= 1e-14 * loss.abs());
        assert!(loss <= 0.0);
        let energy = |step: f64| {
            let moved = |at: &[f64], rates: &[f64]| -> Vec<f64> {
                at.iter()
                    .zip(rates)
                    .map(|(at, rate)| at + step * rate)
                    .collect()
            };
            // θ to the second order.
            let theta = moved(
                &moved(&own_theta, &own_omega),
                &moved(&vec![0.0; n], &alpha)
                    .iter()
                    .map(|a| 0.5 * a)
                    .collect::<Vec<_>>(),
            );
            let omega = moved(&own_omega, &alpha);
            loops.kinetic_energy_of(&theta, &omega) + loops.potential_energy_of(&theta)
        };
        let step = 1e-6;
        let slope = (energy(step) - energy(-step)) / (2.0 * step);
        let size: f64 = alpha
            .iter()
            .zip(&own_omega)
            .map(|(a, w)| (a * w).abs())
            .sum();
        assert!(
            (slope - power - loss).abs() < 1e-6 * (scale + size),
            "{slope} {power} {loss}"
        );
    }
}
