//! Straight springs, repulsions and dampers between points of links, and guys to the ground, against
//! Cartesian positions.

mod functions;
mod motion;
mod sectors;
mod series;

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::{Double, Dual, Scalar};
use branched_pendulum::system::Workspace;
use branched_pendulum_trees::PendulumTree;

use super::plain::Numbers;

/// Siblings with a spring without length at rest, one across, a guy, magnets across that repel each
/// other, and an attraction to a point out of reach.
const GUYED: &str = "gravity = 9.81,
    a: rod(mass = 0.4, length = 0.5) [
        b: rod(mass = 0.2, length = 0.35) [c: rod(mass = 0.1, length = 0.25) * 2] * 2
    ],
    siblings(b, at = 0.3, spring = 12), between(b_1, c_2_1, at = each((0.1, 0.05), 0.2), spring = 5),
    guy(a, at = 0.4, to = (0.9, -0.1), spring = 30, rest = 0.3),
    between(b_2, c_1_1, at = each((0.1, 0.05), 0.2), repulsion = 0.002, exponent = 3),
    guy(b_2, at = 0.3, to = (-1.2, 0.2), repulsion = -0.02, exponent = 2)";

/// A point of a link, or of the ground for `None`.
type End = (Option<usize>, [f64; 2]);

/// What acts between two points.
struct Line {
    ends: [End; 2],
    stiffness: f64,
    rest: f64,
    friction: f64,
    /// A and n.
    repulsion: Option<(f64, u32)>,
}

impl Line {
    fn random(numbers: &mut Numbers, ends: [End; 2]) -> Self {
        // A spring at rest at no length is one in three.
        let rest = [0.0, 1.0, 1.0][numbers.below(3)] * numbers.between(0.1, 0.5);
        let exponent = 1 + numbers.below(12) as u32;
        let strength = numbers.between(-0.3, 0.3) * 0.3_f64.powi(exponent as i32);
        Self {
            ends,
            rest,
            stiffness: numbers.between(0.0, 20.0),
            friction: numbers.between(0.0, 0.5),
            repulsion: (numbers.below(2) == 0).then_some((strength, exponent)),
        }
    }

    /// Energy at a length.
    fn energy<T: Scalar>(&self, length: T) -> T {
        let stretch = length - T::from_f64(self.rest);
        let spring = T::from_f64(0.5 * self.stiffness) * stretch * stretch;
        let Some((strength, exponent)) = self.repulsion else {
            return spring;
        };
        let divided = (0..exponent).fold(T::from_f64(strength), |all, _| all / length);
        spring + divided
    }

    fn text(&self) -> String {
        let [(a, [x, y]), (b, [u, v])] = self.ends;
        let a = a.unwrap();
        let ends = match b {
            Some(b) => format!("between(l{a}, l{b}, at = each(({x}, {y}), ({u}, {v}))"),
            None => format!("guy(l{a}, at = ({x}, {y}), to = ({u}, {v})"),
        };
        let rest = match self.rest {
            0.0 => String::new(),
            rest => format!(", rest = {rest}"),
        };
        let repulsion = self
            .repulsion
            .map_or_else(String::new, |(strength, exponent)| {
                format!(", repulsion = {strength}, exponent = {exponent}")
            });
        let (stiffness, friction) = (self.stiffness, self.friction);
        format!(", {ends}, spring = {stiffness}{rest}{repulsion}, friction = {friction})")
    }
}

/// A random tree with lateral offsets, with straight springs, in plain numbers.
struct StraightTree {
    stands: bool,
    parents: Vec<Option<usize>>,
    /// Pivot on the parent, along and across.
    pivots: Vec<[f64; 2]>,
    bodies: Vec<[f64; 4]>,
    lines: Vec<Line>,
}

impl StraightTree {
    fn random(numbers: &mut Numbers) -> Self {
        let links = 2 + numbers.below(7);
        let pair = |numbers: &mut Numbers| [(); 2].map(|()| numbers.between(-0.3, 0.4));
        let parents: Vec<Option<usize>> = (0..links)
            .map(|link| (link > 0).then(|| numbers.below(link)))
            .collect();
        let line = |numbers: &mut Numbers| {
            let first = numbers.below(links);
            let second = (first + 1 + numbers.below(links - 1)) % links;
            let on_ground = numbers.below(3) == 0;
            let other = if on_ground { None } else { Some(second) };
            let ends = [(Some(first), pair(numbers)), (other, pair(numbers))];
            Line::random(numbers, ends)
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
            lines: (0..1 + numbers.below(4)).map(|_| line(numbers)).collect(),
            parents,
        }
    }

    fn text(&self, with_lines: bool) -> String {
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
        for line in self.lines.iter().filter(|_| with_lines) {
            text.push_str(&line.text());
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
        let energies = self.lines.iter();
        let energies = energies.map(|line| line.energy(self.length(line.ends, theta)));
        energies.sum()
    }

    /// Torques of all lines, by differences of energies and of lengths in 106 bits, and the power of
    /// the dampers.
    fn torques(&self, theta: &[f64], omega: &[f64]) -> (Vec<f64>, f64) {
        // The third derivative of a short line's energy is large.
        let step = 1e-11;
        let (mut torques, mut power) = (vec![0.0; theta.len()], 0.0);
        for line in &self.lines {
            // Of the length, and of the energy.
            let slopes = |link: usize| -> [f64; 2] {
                let [high, low] = [step, -step].map(|step| {
                    let mut moved: Vec<Double> =
                        theta.iter().copied().map(Double::from_f64).collect();
                    moved[link] += Double::from_f64(step);
                    let length = self.length(line.ends, &moved);
                    [length, line.energy(length)]
                });
                [0, 1].map(|place| (high[place] - low[place]).high() / (2.0 * step))
            };
            let slopes: Vec<[f64; 2]> = (0..theta.len()).map(slopes).collect();
            let rate: f64 = slopes.iter().zip(omega).map(|([a, _], b)| a * b).sum();
            power -= line.friction * rate * rate;
            for (torque, [slope, force]) in torques.iter_mut().zip(&slopes) {
                *torque -= force + line.friction * rate * slope;
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
    let mut exponents = [0; 12];
    for _ in 0..200 {
        let plain = StraightTree::random(&mut numbers);
        for (_, exponent) in plain.lines.iter().filter_map(|line| line.repulsion) {
            exponents[exponent as usize - 1] += 1;
        }
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
    assert!(exponents.iter().all(|&count| count > 5), "{exponents:?}");
}
