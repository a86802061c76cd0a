//! Driven trees whose code is loops, over generations or a table: against the same
//! trees written out, and against Jacobians of the tests' own.

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Double;
use branched_pendulum_codegen::scene::{Offset, Quantity, Scene};
use branched_pendulum_tests::oracle::cartesian::Motion;
use branched_pendulum_tests::oracle::drive::{Jet, Push};
use branched_pendulum_tests::oracle::{Link, Tree};
use branched_pendulum_tests::random::Random;
use branched_pendulum_tests::source;
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

pair!(TurnedLoops, TurnedUnrolled, TURNED:
    tree: generations(count = 5, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7),
    drive(torque = 0.4 * cos(3 * t))
);
powered!(TurnedLoops, TurnedUnrolled);
pair!(ShakenLoops, ShakenUnrolled, SHAKEN:
    tree: generations(count = 4, branching = 3, mass = 0.2, com = 0.05, inertia = 1e-4,
        joint = 0.2, mass_ratio = 0.4, length_ratio = 0.8, friction = 2e-4, drag = 1e-4,
        spring = 3e-3),
    drive(x = 0.2 * sin(5 * t), y = 0.1 * cos(4 * t))
);
powered!(ShakenLoops, ShakenUnrolled, braked);
pair!(ShortLoops, ShortUnrolled, SHORT:
    tree: generations(count = 2, branching = 5, shape = disc, mass = 0.3, length = 0.2,
        radius = 0.05, friction = 1e-3),
    drive(torque = 0.4 * cos(3 * t), x = 0.2 * sin(5 * t), y = 0.1 * cos(4 * t))
);
powered!(ShortLoops, ShortUnrolled, braked);
pair!(ChainLoops, ChainUnrolled, CHAIN:
    tree: generations(count = 9, branching = 1, shape = point, mass = 0.2, length = 0.1,
        drag = 1e-4),
    drive(torque = 0.4 * cos(3 * t), x = 0.2 * sin(5 * t), y = 0.1 * cos(4 * t))
);
powered!(ChainLoops, ChainUnrolled, braked);
pair!(BushTable, BushUnrolled, BUSH:
    trunk: rod(mass = 0.3, length = 0.4) [
        twig: point(mass = 0.05, length = 0.2),
        bough: rod(mass = 0.1, length = 0.3) [
            stick: rod(mass = 0.03, length = 0.1) * 3,
            leaf: disc(mass = 0.01, length = 0.05, radius = 0.02),
        ],
    ],
    drive(torque = 0.4 * cos(3 * t), x = 0.2 * sin(5 * t), y = 0.1 * cos(4 * t))
);
powered!(BushTable, BushUnrolled);
pair!(SprungTable, SprungUnrolled, SPRUNG:
    trunk(mass = 0.2, com = -0.03, inertia = 1e-3, joint = -0.2, friction = 1e-4) [
        arm: rod(mass = 0.1, length = 0.25, spring = 0.01) [
            hand(mass = 0.04, com = 0.1, inertia = 0, drag = 2e-4),
            fork: generations(count = 3, branching = 2, shape = rod, mass = 0.02, length = 0.1,
                length_ratio = 0.8, friction = 1e-5),
        ] * 2,
        tail: point(mass = 0.03, length = 0.3, spring = 0.02),
    ],
    drive(x = 0.2 * sin(5 * t), y = 0.1 * cos(4 * t))
);
powered!(SprungTable, SprungUnrolled, braked);

/// The drive of the trees above, the parts that they have.
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

/// A scene that is written out, in plain numbers.
fn oracle_of(scene: &Scene) -> Tree {
    let number = |quantity: &Quantity| quantity.exact().expect("no parameters").to_f64();
    let point = |offset: &Offset| [number(&offset.along), number(&offset.lateral)];
    let force = |force: &Option<Quantity>| force.as_ref().map_or(0.0, number);
    let links = scene.links.iter().map(|link| Link {
        parent: link.parent.map(|parent| parent.0),
        mass: number(&link.mass),
        inertia: number(&link.inertia),
        com: point(&link.com),
        pivot: point(&link.pivot),
        friction: force(&link.friction),
        drag: force(&link.drag),
        spring: force(&link.spring),
    });
    Tree {
        gravity: number(&scene.gravity),
        links: links.collect(),
    }
}

/// Where each link of `U` stands in `L`, by name.
fn order<L: Pendulum<f64>, U: Pendulum<f64>>() -> Vec<usize> {
    assert_eq!(L::LINKS, U::LINKS);
    let name = |index: usize| L::link_name(index).unwrap().to_string();
    let names: Vec<String> = (0..L::LINKS).map(name).collect();
    let find = |name: &&str| names.iter().position(|other| other == name).unwrap();
    U::LINK_NAMES.iter().map(find).collect()
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
    let n = U::LINKS;
    let order = order::<L, U>();
    let tree = oracle_of(&scene_of(text));
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
            assert!(bound[link] > 0.0);
            worst = worst.max((alpha[place] - other[link]).abs() / bound[link]);
            farthest = farthest.max((alpha[place] - right[link]).abs() / bound[link]);
            assert!(alpha[place].is_finite());
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
    let n = U::LINKS;
    let order = order::<L, U>();
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

#[test]
fn driven_loops_agree_with_code_written_out_and_with_the_oracle() {
    let (loops, unrolled) = (TurnedLoops::<f64>::new(), TurnedUnrolled::<f64>::new());
    agree(&loops, &unrolled, TURNED, [true, false]);
    balance(&loops, &unrolled);
    let (loops, unrolled) = (ShakenLoops::<f64>::new(), ShakenUnrolled::<f64>::new());
    agree(&loops, &unrolled, SHAKEN, [false, true]);
    balance(&loops, &unrolled);
    let (loops, unrolled) = (ShortLoops::<f64>::new(), ShortUnrolled::<f64>::new());
    agree(&loops, &unrolled, SHORT, [true, true]);
    balance(&loops, &unrolled);
    let (loops, unrolled) = (ChainLoops::<f64>::new(), ChainUnrolled::<f64>::new());
    agree(&loops, &unrolled, CHAIN, [true, true]);
    balance(&loops, &unrolled);
}

#[test]
fn driven_tables_agree_with_code_written_out_and_with_the_oracle() {
    let (table, unrolled) = (BushTable::<f64>::new(), BushUnrolled::<f64>::new());
    agree(&table, &unrolled, BUSH, [true, true]);
    balance(&table, &unrolled);
    let (table, unrolled) = (SprungTable::<f64>::new(), SprungUnrolled::<f64>::new());
    agree(&table, &unrolled, SPRUNG, [false, true]);
    balance(&table, &unrolled);
}

/// 32,767 links, taken apart: the root is not in the parts.
#[branched_pendulum(
    gravity = g,
    tree: generations(count = 15, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.9),
    drive(torque = links * cos(bodies * t), x = 0.1 * sin(per_lever * t)),
    emit(energies),
)]
struct Many;

#[test]
fn a_large_driven_tree_is_the_same_in_other_scalars_and_on_more_threads() {
    let n = <Many as Pendulum<f64>>::LINKS;
    assert_eq!(n, 32_767);
    let mut model = Many::new(ManyParameters {
        g: 9.8125,
        links: 2.0,
        bodies: 3.0,
        per_lever: 7.0,
    })
    .unwrap();
    let mut random = Random::new(3);
    let (theta, omega) = (random.around_zero(n, 3.0), random.around_zero(n, 2.0));
    let mut alpha = vec![f64::NAN; n];
    model.accelerations_into(0.5, &theta, &omega, &mut alpha);
    model.set_threads(std::num::NonZeroUsize::new(2).unwrap());
    let mut threaded = vec![f64::NAN; n];
    model.accelerations_into(0.5, &theta, &omega, &mut threaded);
    assert!(alpha.iter().zip(&threaded).all(|(a, b)| a == b));

    let exact = ManyParameters {
        g: 9.8125,
        links: 2.0,
        bodies: 3.0,
        per_lever: 7.0,
    };
    let wide = |numbers: &[f64]| -> Vec<Double> {
        numbers.iter().copied().map(Double::from_f64).collect()
    };
    let mut doubles = vec![Double::from_f64(0.0); n];
    Many::<Double>::from_parameters(ManyParameters {
        g: Double::from_f64(exact.g),
        links: Double::from_f64(exact.links),
        bodies: Double::from_f64(exact.bodies),
        per_lever: Double::from_f64(exact.per_lever),
    })
    .accelerations_into(
        Double::from_f64(0.5),
        &wide(&theta),
        &wide(&omega),
        &mut doubles,
    );
    let largest = alpha.iter().fold(0.0, |max: f64, x| max.max(x.abs()));
    for (alpha, double) in alpha.iter().zip(&doubles) {
        assert!((alpha - double.to_f64()).abs() < 1e-10 * largest);
    }
    // The drive reaches the root.
    let mut later = vec![f64::NAN; n];
    model.accelerations_into(0.75, &theta, &omega, &mut later);
    assert!((later[0] - alpha[0]).abs() > 0.1);
    assert_eq!(model.drive(0.0), [-0.0, 0.0, 2.0]);
}
