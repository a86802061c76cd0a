//! Motions, modes and configurations of trees with straight springs.

use branched_pendulum::analysis::Modes;
use branched_pendulum::prelude::*;
use branched_pendulum_trees::PendulumTree;

use super::super::balance;
use super::super::plain::Numbers;
use super::GUYED;

/// Springs alone keep the energy in every form of the equations, and dampers take what their
/// power says.
#[test]
fn energy_is_balanced_in_every_form() {
    let tree = PendulumTree::parse(GUYED).unwrap();
    let start = balance::state(&tree, 5, 1.5);
    balance::assert_energy_is_kept(&tree, &start);
    let braked = GUYED.replace("rest = 0.3)", "rest = 0.3, friction = 0.2)");
    let braked = braked.replace("spring = 5)", "friction = 0.05)");
    let tree = PendulumTree::parse(&braked).unwrap();
    let end = balance::assert_friction_takes(&tree, &start, 0.1);
    // Without dampers it is the tree that keeps its energy.
    let conservative = tree.conservative().unwrap();
    assert!(
        conservative
            .translational_spring_dampers()
            .iter()
            .all(|own| own.friction.is_none())
    );
    let (theta, omega) = (end.positions(), end.velocities());
    assert_eq!(conservative.friction_power(theta, omega), 0.0);
    assert_eq!(
        conservative.potential_energy_of(theta),
        tree.potential_energy_of(theta)
    );
}

/// Two equal rods side by side, whose ends a spring joins, by the equations of docs/limits.md.
struct Coupled {
    stiffness: f64,
    apart: f64,
}

const MASS: f64 = 0.12;
const LENGTH: f64 = 0.3;

impl Ode<f64> for Coupled {
    fn dimension(&self) -> usize {
        4
    }

    fn rates(&self, _: f64, state: &[f64], rates: &mut [f64]) {
        let &[a, b, left, right] = state else {
            unreachable!()
        };
        let [x, y] = [
            self.apart + LENGTH * (b.sin() - a.sin()),
            LENGTH * (a.cos() - b.cos()),
        ];
        let length = x.hypot(y);
        let pull = self.stiffness * (length - self.apart) / length;
        let slopes = [
            LENGTH * (-x * a.cos() - y * a.sin()),
            LENGTH * (x * b.cos() + y * b.sin()),
        ];
        let inertia = MASS * LENGTH * LENGTH / 3.0;
        rates[..2].copy_from_slice(&[left, right]);
        for (place, angle) in [a, b].into_iter().enumerate() {
            let weight = MASS * 9.81 * LENGTH / 2.0 * angle.sin();
            rates[2 + place] = (-weight - pull * slopes[place]) / inertia;
        }
    }
}

/// The rods hang from a frame that nothing moves.
fn rods(apart: f64, more: &str) -> String {
    let [left, right] = [-apart / 2.0, apart / 2.0];
    format!(
        "gravity = 9.81, frame(mass = 1, com = 0.1, inertia = 1e30) [
            left: rod(mass = {MASS}, length = {LENGTH}, at = (0, {left})),
            right: rod(mass = {MASS}, length = {LENGTH}, at = (0, {right}))
        ], between(left, right, at = {LENGTH}{more})"
    )
}

#[test]
fn two_coupled_rods_move_as_their_own_equations_say() {
    let (stiffness, apart) = (4.0, 0.25);
    let tree = rods(apart, &format!(", spring = {stiffness}, rest = {apart}"));
    let tree = PendulumTree::parse(&tree).unwrap();
    let own = Coupled { stiffness, apart };
    let mut numbers = Numbers(8);
    for _ in 0..100 {
        let state = [2.0, 2.0, 5.0, 5.0].map(|size| numbers.between(-size, size));
        let [a, b, left, right] = state;
        let mut expected = [0.0; 4];
        own.rates(0.0, &state, &mut expected);
        let found = tree.accelerations(0.0, &[0.0, a, b], &[0.0, left, right]);
        for (found, expected) in found[1..].iter().zip(&expected[2..]) {
            assert!(
                (found - expected).abs() < 1e-12 * (100.0 + expected.abs()),
                "{found} {expected}"
            );
        }
    }
    let method = Dop853::new(Options::with_tolerance(1e-13));
    let start = [0.7, -0.4, 1.0, 2.0];
    let expected = method.run(&own, &State::new(0.0, start.to_vec()), 3.0);
    let expected = expected.unwrap().state.values;
    let start = State::new(0.0, vec![0.0, 0.7, -0.4, 0.0, 1.0, 2.0]);
    let found = method.run(&AbsoluteAngles(&tree), &start, 3.0);
    let found = found.unwrap().state.values;
    let found = [1, 2, 4, 5].map(|place| found[place]);
    for (found, expected) in found.iter().zip(&expected) {
        assert!((found - expected).abs() < 1e-10, "{found} {expected}");
    }
}

/// Against each other the rods have the stiffness m g ℓ/2 + 2 κ ℓ², in phase m g ℓ/2.
#[test]
fn modes_of_two_coupled_rods_are_the_closed_form() {
    let (stiffness, apart) = (4.0, 0.25);
    let tree = rods(apart, &format!(", spring = {stiffness}, rest = {apart}"));
    let tree = PendulumTree::parse(&tree).unwrap();
    let modes: Modes = tree.modes(&[0.0; 3]).unwrap();
    let inertia = MASS * LENGTH * LENGTH / 3.0;
    let weight = MASS * 9.81 * LENGTH / 2.0;
    for coupling in [0.0, 2.0 * stiffness * LENGTH * LENGTH] {
        let expected = f64::sqrt((weight + coupling) / inertia) / std::f64::consts::TAU;
        let found = modes.frequencies_hz.iter();
        let apart = found.fold(1.0, |least: f64, own| {
            least.min((own / expected - 1.0).abs())
        });
        assert!(apart < 1e-12, "{expected}: {:?}", modes.frequencies_hz);
    }
}

/// Magnets push the rods apart by the angle φ. Against each other they move in one coordinate of the
/// line, and together they turn a line that is under pressure.
#[test]
fn modes_of_two_rods_with_magnets_are_the_closed_form() {
    let (inertia, weight) = (MASS * LENGTH * LENGTH / 3.0, MASS * 9.81 * LENGTH / 2.0);
    let apart = 0.1;
    for (strength, n) in [(3e-5, 3), (2e-3, 1), (1e-6, 4), (-1e-7, 3), (-3e-6, 2)] {
        let length = |angle: f64| apart + 2.0 * LENGTH * angle.sin();
        let push = |angle: f64| f64::from(n) * strength / length(angle).powi(n + 1);
        // m g ℓ/2 sin φ balances the push at the lever ℓ cos φ.
        let balance = |angle: f64| weight * angle.sin() - push(angle) * LENGTH * angle.cos();
        let mut range = if strength > 0.0 {
            [0.0, 1.5]
        } else {
            [-0.03, 0.0]
        };
        for _ in 0..100 {
            let middle = 0.5 * (range[0] + range[1]);
            range[usize::from(balance(middle) > 0.0)] = middle;
        }
        let angle = range[0];
        let more = format!(", repulsion = {strength}, exponent = {n}");
        let tree = PendulumTree::parse(&rods(apart, &more)).unwrap();
        let modes: Modes = tree.modes(&[0.0, -angle, angle]).unwrap();
        let (sin, cos) = angle.sin_cos();
        let own = push(angle);
        let steep = f64::from(n + 1) * own / length(angle);
        let against = 2.0 * LENGTH * LENGTH * cos * cos * steep + own * LENGTH * sin;
        let together = own * apart * LENGTH * sin / length(angle);
        for stiffness in [against, together].map(|line| weight * cos + line) {
            let expected = f64::sqrt(stiffness / inertia) / std::f64::consts::TAU;
            let found = modes.frequencies_hz.iter();
            let apart = found.fold(1.0, |least: f64, own| {
                least.min((own / expected - 1.0).abs())
            });
            let all = &modes.frequencies_hz;
            assert!(apart < 1e-12, "{strength}, {n}: {expected}: {all:?}");
        }
    }
}

/// Where points meet a spring without length at rest pulls at nothing, and others have no
/// direction.
#[test]
fn points_may_meet_where_no_length_is_at_rest() {
    let tree = |more: &str| {
        PendulumTree::parse(&format!(
            "gravity = 9.81, a: rod(mass = 0.4, length = 0.5) [b: rod(mass = 0.2, length = 0.3) * 2],
            siblings(b, at = 0.3{more})"
        ))
        .unwrap()
    };
    let (theta, omega) = ([0.4, 0.2, 0.2], [1.0, -1.0, -1.0]);
    let free = tree(", spring = 0, friction = 0").accelerations(0.0, &theta, &omega);
    assert!(free.iter().all(|alpha| alpha.is_finite()));
    assert_eq!(
        tree(", spring = 7").accelerations(0.0, &theta, &omega),
        free
    );
    assert_eq!(
        tree(", spring = 7").potential_energy_of(&theta),
        tree(", spring = 0").potential_energy_of(&theta)
    );
    let repelled = ", repulsion = 1e-5, exponent = 3";
    for more in [", spring = 7, rest = 0.1", ", friction = 0.1", repelled] {
        let found = tree(more).accelerations(0.0, &theta, &omega);
        assert!(
            found.iter().any(|alpha| alpha.is_nan()),
            "{more}: {found:?}"
        );
    }
    for (sign, energy) in [("", f64::INFINITY), ("-", f64::NEG_INFINITY)] {
        let repelled = repelled.replace("1e-5", &format!("{sign}1e-5"));
        assert_eq!(tree(&repelled).potential_energy_of(&theta), energy);
    }
}

/// Siblings are all copies two by two, in trees by rule too.
#[test]
fn siblings_are_pairs() {
    let rule = "gravity = 9.81, a: generations(count = 3, branching = 2, shape = rod, mass = 0.2,
        length = 0.3, mass_ratio = 0.5, length_ratio = 0.7, CODE)";
    let springs = ", siblings(a_3, at = 0.1, spring = 3, rest = 0.02, friction = 0.01)";
    let own = ", between(a_3_1_1, a_3_1_2, at = 0.1, spring = 3, rest = 0.02, friction = 0.01)";
    let other = own.replace("a_3_1_1, a_3_1_2", "a_3_2_1, a_3_2_2");
    let mut states = Vec::new();
    for (code, clauses) in [
        ("code = loops", springs.to_owned()),
        ("code = loops", format!("{own}{other}")),
        ("code = unrolled", springs.to_owned()),
    ] {
        let tree = format!("{}{clauses}", rule.replace("CODE", code));
        let tree = PendulumTree::parse(&tree).unwrap();
        assert!(tree.copies().is_none(), "{code}");
        // By name: links of loops stand by generations.
        let value = |name: &String| {
            name.bytes().map(f64::from).sum::<f64>().sin() + name.len() as f64 * 0.01
        };
        let theta: Vec<f64> = tree.names().iter().map(value).collect();
        let omega: Vec<f64> = theta.iter().map(|angle| 2.0 * angle.cos()).collect();
        let alpha = tree.accelerations(0.0, &theta, &omega);
        let mut named: Vec<(String, f64)> = tree.names().iter().cloned().zip(alpha).collect();
        named.sort_by(|a, b| a.0.cmp(&b.0));
        states.push(named);
    }
    assert_eq!(states[0], states[1]);
    for ((name, own), (other, unrolled)) in states[0].iter().zip(&states[2]) {
        assert_eq!(name, other);
        assert!((own - unrolled).abs() < 1e-10, "{name}: {own} {unrolled}");
    }
}
