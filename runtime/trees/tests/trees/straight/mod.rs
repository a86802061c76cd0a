//! Straight springs and dampers between points of links, and guys to the ground, against Cartesian
//! positions.

mod functions;
mod motion;

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::{Double, Dual, Scalar};
use branched_pendulum::system::{Forced, Workspace};
use branched_pendulum_trees::PendulumTree;

use super::plain::Numbers;

/// Siblings with a spring without length at rest, one across, and a guy.
const GUYED: &str = "gravity = 9.81,
    a: rod(mass = 0.4, length = 0.5) [
        b: rod(mass = 0.2, length = 0.35) [c: rod(mass = 0.1, length = 0.25) * 2] * 2
    ],
    siblings(b, at = 0.3, spring = 12), between(b_1, c_2_1, at = each((0.1, 0.05), 0.2), spring = 5),
    guy(a, at = 0.4, to = (0.9, -0.1), spring = 30, rest = 0.3)";

fn go_on(_: &mut DenseStep<'_, f64>) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// A point of a link, or of the ground for `None`.
type End = (Option<usize>, [f64; 2]);

/// A random tree with lateral offsets, with straight springs, in plain numbers.
struct StraightTree {
    stands: bool,
    parents: Vec<Option<usize>>,
    /// Pivot on the parent, along and across.
    pivots: Vec<[f64; 2]>,
    bodies: Vec<[f64; 4]>,
    /// The points, κ, L₀ and c.
    springs: Vec<([End; 2], [f64; 3])>,
}

impl StraightTree {
    fn random(numbers: &mut Numbers) -> Self {
        let links = 2 + numbers.below(7);
        let pair = |numbers: &mut Numbers| [(); 2].map(|()| numbers.between(-0.3, 0.4));
        let parents: Vec<Option<usize>> = (0..links)
            .map(|link| (link > 0).then(|| numbers.below(link)))
            .collect();
        let spring = |numbers: &mut Numbers| {
            let first = numbers.below(links);
            let second = (first + 1 + numbers.below(links - 1)) % links;
            let on_ground = numbers.below(3) == 0;
            let other = if on_ground { None } else { Some(second) };
            let ends = [(Some(first), pair(numbers)), (other, pair(numbers))];
            // A spring at rest at no length is one in three.
            let rest = [0.0, 1.0, 1.0][numbers.below(3)] * numbers.between(0.1, 0.5);
            let stiffness = numbers.between(0.0, 20.0);
            (ends, [stiffness, rest, numbers.between(0.0, 0.5)])
        };
        Self {
            stands: numbers.below(2) == 0,
            pivots: (0..links).map(|_| pair(numbers)).collect(),
            bodies: (0..links)
                .map(|_| {
                    [(0.05, 0.4), (0.05, 0.3), (-0.1, 0.1), (1e-3, 3e-3)]
                        .map(|(low, high)| numbers.between(low, high))
                })
                .collect(),
            springs: (0..1 + numbers.below(4)).map(|_| spring(numbers)).collect(),
            parents,
        }
    }

    fn text(&self, with_springs: bool) -> String {
        fn written(tree: &StraightTree, own: usize) -> String {
            let [mass, com, across, inertia] = tree.bodies[own];
            let [along, lateral] = tree.pivots[own];
            let at = match tree.parents[own] {
                Some(_) => format!(", at = ({along}, {lateral})"),
                None => String::new(),
            };
            let link =
                format!("l{own}(mass = {mass}, com = ({com}, {across}), inertia = {inertia}{at})");
            let children =
                (0..tree.parents.len()).filter(|other| tree.parents[*other] == Some(own));
            let children: Vec<String> = children.map(|child| written(tree, child)).collect();
            match children.is_empty() {
                true => link,
                false => format!("{link} [{}]", children.join(", ")),
            }
        }
        let sign = if self.stands { "-" } else { "" };
        let mut text = format!("gravity = {sign}9.81, {}", written(self, 0));
        for ([(a, [x, y]), (b, [u, v])], [stiffness, rest, friction]) in
            self.springs.iter().filter(|_| with_springs)
        {
            let a = a.unwrap();
            let ends = match b {
                Some(b) => format!("between(l{a}, l{b}, at = each(({x}, {y}), ({u}, {v}))"),
                None => format!("guy(l{a}, at = ({x}, {y}), to = ({u}, {v})"),
            };
            let rest = match *rest {
                0.0 => String::new(),
                rest => format!(", rest = {rest}"),
            };
            text.push_str(&format!(
                ", {ends}, spring = {stiffness}{rest}, friction = {friction})"
            ));
        }
        text
    }

    /// Cartesian place of a point, y upwards.
    fn place<T: Scalar>(&self, (link, at): End, theta: &[T]) -> [T; 2] {
        let Some(mut link) = link else {
            return at.map(T::from_f64);
        };
        let up = T::from_f64(if self.stands { 1.0 } else { -1.0 });
        let mut place = [T::from_f64(0.0); 2];
        let mut point = at;
        loop {
            let (sin, cos) = theta[link].sin_cos();
            let [along, across] = point.map(T::from_f64);
            place[0] = place[0] + along * sin + across * cos;
            place[1] = place[1] + up * (along * cos - across * sin);
            let Some(parent) = self.parents[link] else {
                return place;
            };
            (point, link) = (self.pivots[link], parent);
        }
    }

    fn length<T: Scalar>(&self, [a, b]: [End; 2], theta: &[T]) -> T {
        let ([x, y], [u, v]) = (self.place(a, theta), self.place(b, theta));
        ((u - x) * (u - x) + (v - y) * (v - y)).sqrt()
    }

    fn energy(&self, theta: &[f64]) -> f64 {
        let energies = self.springs.iter().map(|(ends, [stiffness, rest, _])| {
            0.5 * stiffness * (self.length(*ends, theta) - rest).powi(2)
        });
        energies.sum()
    }

    /// Torques of all springs and dampers, by differences of lengths in 106 bits, and the power of
    /// the dampers.
    fn torques(&self, theta: &[f64], omega: &[f64]) -> (Vec<f64>, f64) {
        let step = 1e-8;
        let (mut torques, mut power) = (vec![0.0; theta.len()], 0.0);
        for (ends, [stiffness, rest, friction]) in &self.springs {
            let slope = |link: usize| {
                let [high, low] = [step, -step].map(|step| {
                    let mut moved: Vec<Double> =
                        theta.iter().copied().map(Double::from_f64).collect();
                    moved[link] += Double::from_f64(step);
                    self.length(*ends, &moved)
                });
                (high - low).high() / (2.0 * step)
            };
            let slopes: Vec<f64> = (0..theta.len()).map(slope).collect();
            let rate: f64 = slopes.iter().zip(omega).map(|(a, b)| a * b).sum();
            let pull = stiffness * (self.length(*ends, theta) - rest) + friction * rate;
            power -= friction * rate * rate;
            for (torque, slope) in torques.iter_mut().zip(&slopes) {
                *torque -= pull * slope;
            }
        }
        (torques, power)
    }
}

fn order(tree: &PendulumTree) -> Vec<usize> {
    let names = tree.names().iter();
    names.map(|name| name[1..].parse().unwrap()).collect()
}

#[test]
fn accelerations_energies_and_powers_are_those_of_cartesian_points() {
    let mut numbers = Numbers(11);
    for _ in 0..200 {
        let plain = StraightTree::random(&mut numbers);
        let text = plain.text(true);
        let tree = PendulumTree::parse(&text).unwrap();
        let free = PendulumTree::parse(&plain.text(false)).unwrap();
        let order = order(&tree);
        let state = |numbers: &mut Numbers, range: f64| -> Vec<f64> {
            let links = order.iter();
            links.map(|_| numbers.between(-range, range)).collect()
        };
        let (theta, omega) = (state(&mut numbers, 3.0), state(&mut numbers, 6.0));
        let own = |values: &[f64]| -> Vec<f64> { order.iter().map(|link| values[*link]).collect() };
        let (torques, power) = plain.torques(&theta, &omega);
        let (theta_own, omega_own) = (own(&theta), own(&omega));
        let found = tree.accelerations(0.0, &theta_own, &omega_own);
        let mut expected = vec![0.0; found.len()];
        free.accelerations_under_with(
            &mut Workspace::new(),
            0.0,
            &theta_own,
            &omega_own,
            &own(&torques),
            &mut expected,
        );
        let size = |values: &[f64]| {
            values
                .iter()
                .fold(1.0, |size: f64, own| size.max(own.abs()))
        };
        for (found, expected_one) in found.iter().zip(&expected) {
            let apart = (found - expected_one).abs();
            assert!(
                apart < 1e-12 * size(&expected),
                "{found} {expected_one}: {text}"
            );
        }
        let stored = tree.potential_energy_of(&theta_own) - free.potential_energy_of(&theta_own);
        assert!(
            (stored - plain.energy(&theta)).abs() < 1e-12 * (1.0 + stored.abs()),
            "{text}"
        );
        let lost = tree.friction_power(&theta_own, &omega_own);
        assert!((lost - power).abs() < 1e-12 * (1.0 + power.abs()), "{text}");
        // Numbers with derivatives find the same torques.
        let along: Vec<Dual<f64, 1>> = theta_own
            .iter()
            .zip(&omega_own)
            .map(|(&value, &rate)| Dual {
                value,
                tangents: [rate],
            })
            .collect();
        let moving = tree.cast(Dual::<f64, 1>::constant);
        let [rate] = moving.potential_energy_of(&along).tangents;
        let still = vec![0.0; theta.len()];
        let by_torques: f64 = {
            let (springs, _) = plain.torques(&theta, &still);
            springs.iter().zip(&omega).map(|(a, b)| a * b).sum()
        };
        let free_moving = free.cast(Dual::<f64, 1>::constant);
        let [free_rate] = free_moving.potential_energy_of(&along).tangents;
        let work = free_rate - rate;
        assert!(
            (work - by_torques).abs() < 1e-12 * (1.0 + work.abs() + rate.abs()),
            "{text}"
        );
    }
}
