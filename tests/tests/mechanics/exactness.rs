//! Symmetry without rounding: what is zero stays zero, what is equal stays
//! equal, bit for bit.

use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::scenes::paper::Paper;

use crate::fixtures::{Nested, Triple};
use crate::support::{Compiled, compile};
use crate::symmetric::sector;

/// Steps of the semi-implicit Euler method; of no order worth mention, but it
/// evaluates the accelerations once a step and its orbits stay bounded.
fn run<const N: usize>(
    mut q: [f64; N],
    step: f64,
    steps: usize,
    accelerations: impl Fn(&[f64; N], &[f64; N]) -> [f64; N],
    mut visit: impl FnMut(&[f64; N], &[f64; N]),
) {
    let mut v = [0.0; N];
    for _ in 0..steps {
        let a = accelerations(&q, &v);
        for i in 0..N {
            v[i] += step * a[i];
            q[i] += step * v[i];
        }
        visit(&q, &v);
    }
}

/// The range of a component along a run.
struct Range(f64, f64);

impl Range {
    fn new() -> Self {
        Self(f64::INFINITY, f64::NEG_INFINITY)
    }

    fn add(&mut self, value: f64) {
        assert!(value.is_finite());
        *self = Self(self.0.min(value), self.1.max(value));
    }

    fn width(&self) -> f64 {
        self.1 - self.0
    }
}

/// A million steps of the paper's pendulum, from beyond the threshold where
/// any disturbance of θ_d would grow.
#[test]
fn an_antiphase_of_zero_stays_zero_over_a_million_steps() {
    let model = Paper::new();
    let mut range = Range::new();
    run(
        [0.85, 0.0, 0.0],
        1e-4,
        1_000_000,
        |q, v| model.symmetric_accelerations(q, v),
        |q, v| {
            assert!(q[2] == 0.0 && v[2] == 0.0, "{q:?} {v:?}");
            range.add(q[1]);
        },
    );
    assert!(range.width() > 2.0, "{}", range.width());
}

/// The motion over 100 s, with a disturbance in the last place: the zero above
/// is not for lack of growth.
#[test]
fn a_disturbance_in_the_last_place_grows() {
    let model = Paper::new();
    let mut range = Range::new();
    run(
        [0.85, 0.0, 1e-16],
        1e-4,
        1_000_000,
        |q, v| model.symmetric_accelerations(q, v),
        |q, _| range.add(q[2]),
    );
    assert!(range.width() > 0.1, "{}", range.width());
}

#[test]
fn equal_children_stay_equal_in_absolute_angles() {
    let model = Paper::new();
    run(
        [0.85, 0.1, 0.1],
        1e-4,
        1_000_000,
        |q, v| model.accelerations(q, v),
        |q, v| assert!(q[1] == q[2] && v[1] == v[2], "{q:?} {v:?}"),
    );
}

/// Three equal children with friction and lateral offsets beside another link.
#[test]
fn equal_triples_stay_equal() {
    let model = Triple::new();
    let mut range = Range::new();
    run(
        [0.9, -0.2, -0.2, -0.2, 0.4],
        1e-3,
        100_000,
        |q, v| model.accelerations(q, v),
        |q, v| {
            assert!(q[1] == q[2] && q[2] == q[3] && v[1] == v[2] && v[2] == v[3]);
            range.add(q[1]);
        },
    );
    assert!(range.width() > 1.0);
    // Coordinates parent, m, other, d1, d2.
    run(
        [0.9, -0.2, 0.4, 0.0, 0.0],
        1e-3,
        100_000,
        |q, v| model.symmetric_accelerations(q, v),
        |q, v| assert!(q[3] == 0.0 && q[4] == 0.0 && v[3] == 0.0 && v[4] == 0.0),
    );
}

/// Arms in phase with their hands in phase stay so; and the hands of one arm
/// do while the arms move against each other.
#[test]
fn equal_subtrees_stay_equal() {
    let model = Nested::new();
    // Body; arm 1 with its hands; arm 2 with its hands.
    run(
        [0.9, -0.3, 0.5, 0.5, -0.3, 0.5, 0.5],
        1e-3,
        50_000,
        |q, v| model.accelerations(q, v),
        |q, v| {
            assert!(q[1] == q[4] && v[1] == v[4]);
            let hands = [2, 3, 5, 6].map(|hand| (q[hand], v[hand]));
            assert!(hands.iter().all(|hand| *hand == hands[0]));
        },
    );
    let mut range = Range::new();
    run(
        [0.9, -0.3, 0.5, 0.5, 0.6, -0.5, 0.2],
        1e-3,
        50_000,
        |q, v| model.accelerations(q, v),
        |q, v| {
            assert!(q[2] == q[3] && v[2] == v[3]);
            range.add(q[5] - q[6]);
        },
    );
    assert!(range.width() > 0.5);
}

/// Trees whose zeros must be exact, by what is special about them.
const STRUCTURES: &[(&str, &str)] = &[
    (
        "pair",
        "hub(mass = 1.3, com = (0.2, 0.1), inertia = 0.01, joint = (0.3, 0.17), friction = 0.3) [
            a(mass = 0.7, com = (0.11, 0.07), inertia = 0.003, friction = 0.013) * 2
        ]",
    ),
    (
        "triple",
        "hub(mass = 1.3, com = 0.2, inertia = 0.01, joint = (0.3, 0.17)) [
            a(mass = 0.7, com = (0.11, 0.07), inertia = 0.003, friction = 0.013) * 3
        ]",
    ),
    (
        "four copies",
        "hub(mass = 1.3, com = 0.2, inertia = 0.01, joint = 0.3) [
            a(mass = 0.7, com = 0.11, inertia = 0.003) * 4
        ]",
    ),
    (
        "two pairs",
        "hub(mass = 1.3, com = 0.2, inertia = 0.01, joint = (0.3, 0.1)) [
            a(mass = 0.7, com = (0.11, 0.03), inertia = 0.003) * 2,
            b(mass = 0.3, com = (0.13, 0.02), inertia = 0.001, at = 0.1) * 2,
        ]",
    ),
    (
        "pair of chains",
        "hub(mass = 1.3, com = 0.2, inertia = 0.01, joint = (0.3, 0.1)) [
            a(mass = 0.7, com = (0.11, 0.03), inertia = 0.003, joint = (0.23, 0.07)) [
                b(mass = 0.3, com = (0.13, 0.02), inertia = 0.001, friction = 0.03)
            ] * 2
        ]",
    ),
    (
        "pair of pairs",
        "hub(mass = 1.3, com = 0.2, inertia = 0.01, joint = 0.3) [
            a(mass = 0.7, com = (0.11, 0.03), inertia = 0.003, joint = (0.23, 0.07)) [
                b(mass = 0.3, com = (0.13, 0.02), inertia = 0.001, friction = 0.03) * 2
            ] * 2
        ]",
    ),
    (
        "triple of pairs",
        "hub(mass = 1.3, com = 0.2, inertia = 0.01, joint = 0.3) [
            a(mass = 0.7, com = 0.11, inertia = 0.003, joint = 0.23) [
                b(mass = 0.3, com = 0.13, inertia = 0.001) * 2
            ] * 3
        ]",
    ),
    (
        "pair of triples",
        "hub(mass = 1.3, com = 0.2, inertia = 0.01, joint = 0.3) [
            a(mass = 0.7, com = 0.11, inertia = 0.003, joint = 0.23) [
                b(mass = 0.3, com = 0.13, inertia = 0.001) * 3
            ] * 2
        ]",
    ),
];

/// Returns true if group `inner` is group `outer` or hangs in one of its
/// copies.
fn within(compiled: &Compiled, inner: usize, outer: usize) -> bool {
    let scene = &compiled.scene;
    let mut at = scene.groups[inner].parent;
    while let Some(link) = at {
        if scene.groups[outer].copies.contains(&link) {
            return true;
        }
        at = scene.links[link.0].parent;
    }
    inner == outer
}

/// Differences that are zero with their rates have accelerations that are
/// exactly zero, whatever the rest of the tree does: those of a group, with
/// all that hangs in its copies in phase too.
#[test]
fn zero_differences_have_accelerations_of_exactly_zero() {
    let mut failures = Vec::new();
    for (name, links) in STRUCTURES {
        let compiled = compile(&format!("gravity = 9.81, {links}, emit(symmetric)"));
        let mut random = Random::new(70);
        let mut worst = 0.0_f64;
        for group in 0..compiled.scene.groups.len() {
            let zero: Vec<bool> = compiled
                .mechanics
                .coordinates
                .iter()
                .map(|c| sector(&c.kind).is_some_and(|(inner, _)| within(&compiled, inner, group)))
                .collect();
            assert!(zero.contains(&true));
            for _ in 0..200 {
                let mut values = |size: f64| -> Vec<f64> {
                    let value = |zero: &bool| match zero {
                        true => 0.0,
                        false => random.between(-size, size),
                    };
                    zero.iter().map(value).collect()
                };
                let (q, v) = (values(3.0), values(8.0));
                let found = compiled.evaluate("symmetric_accelerations", &[&q, &v]);
                for (component, _) in found.iter().zip(&zero).filter(|(_, zero)| **zero) {
                    worst = worst.max(component.abs());
                }
            }
        }
        if worst != 0.0 {
            failures.push(format!("{name}: {worst:.1e} rad/s²"));
        }
    }
    assert!(failures.is_empty(), "{failures:?}");
}

/// Equal angles and velocities of copies have bit-equal accelerations.
#[test]
fn copies_in_phase_have_equal_accelerations() {
    for (name, links) in STRUCTURES {
        let compiled = compile(&format!("gravity = 9.81, {links}"));
        let mut random = Random::new(80);
        let orbits: Vec<usize> = compiled.scene.links.iter().map(|l| l.orbit.0).collect();
        for _ in 0..200 {
            let mut values = |size: f64| -> Vec<f64> {
                let by_orbit = random.around_zero(orbits.len(), size);
                orbits.iter().map(|&orbit| by_orbit[orbit]).collect()
            };
            let (theta, omega) = (values(3.0), values(8.0));
            let found = compiled.evaluate("accelerations", &[&theta, &omega]);
            for (link, &orbit) in orbits.iter().enumerate() {
                let first = orbits.iter().position(|&o| o == orbit);
                let first = found[first.expect("an orbit has links")];
                assert!(found[link] == first, "{name}: {found:?}");
            }
        }
    }
}
