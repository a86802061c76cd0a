//! Energies and powers by scale.
//!
//! By Parseval (physics.md, §8): of any quantity of the rods of one generation, the part
//! at scale s is what the means over the subtrees that part there differ by from the mean
//! of their parent. Squares of these parts, each counted once for every rod, sum to the
//! square of the quantity.

use branched_pendulum::system::Workspace;

use super::motor::Motor;
use super::scene::{RodTree, Shape};

/// What happens at one scale.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ScaleBudget {
    /// Energy, J.
    pub energy: f64,
    /// Power that the other scales give it, W.
    pub received: f64,
    /// Power of the friction, W.
    pub friction: f64,
    /// Power of the motor, W.
    pub drive: f64,
}

/// The budgets of a tree, with the memory that they need.
#[derive(Debug)]
pub struct Budgets<'a, P> {
    shape: Shape,
    tree: &'a P,
    /// The tree without friction.
    free: &'a P,
    workspace: Workspace<f64>,
    torques: Vec<f64>,
    /// Accelerations without friction and motor, with friction, with both.
    alpha: [Vec<f64>; 3],
    /// Budgets by scale.
    scales: Vec<ScaleBudget>,
}

/// Quantities of a rod, and their changes by one cause: the velocity of its centre and its own.
type Velocity = [f64; 3];

impl<'a, P: RodTree> Budgets<'a, P> {
    /// Memory for the budgets of `tree`; `free` is the same one without friction.
    pub fn new(shape: Shape, tree: &'a P, free: &'a P) -> Self {
        let zeros = || vec![0.0; shape.links()];
        Self {
            shape,
            tree,
            free,
            workspace: Workspace::new(),
            torques: zeros(),
            alpha: [zeros(), zeros(), zeros()],
            scales: vec![ScaleBudget::default(); shape.generations],
        }
    }

    /// Budgets by scale at a time and a state, angles before velocities.
    pub fn at(&mut self, motor: &Motor, time: f64, state: &[f64]) -> &[ScaleBudget] {
        let (theta, omega) = state.split_at(state.len() / 2);
        let Self {
            shape,
            tree,
            free,
            workspace,
            torques,
            alpha: [own, braked, driven],
            scales,
        } = self;
        torques.fill(0.0);
        free.accelerations_under_with(workspace, time, theta, omega, torques, own);
        tree.accelerations_under_with(workspace, time, theta, omega, torques, braked);
        if let Some(root) = torques.first_mut() {
            *root = motor.torque(time);
        }
        tree.accelerations_under_with(workspace, time, theta, omega, torques, driven);
        // Torques change the accelerations by M⁻¹ Q, linearly.
        for ((driven, braked), own) in driven.iter_mut().zip(&mut *braked).zip(&*own) {
            *driven -= *braked;
            *braked -= own;
        }
        scales.fill(ScaleBudget::default());
        let still = vec![0.0; omega.len()];
        let velocities = shape.velocities(theta, omega, None);
        let changes = [
            shape.velocities(theta, own, Some(omega)),
            shape.velocities(theta, braked, Some(&still)),
            shape.velocities(theta, driven, Some(&still)),
        ];
        for generation in 0..shape.generations {
            let range = shape.first(generation)..shape.first(generation + 1);
            let (mass, length) = (shape.mass(generation), shape.length(generation));
            let inertia = mass * length * length / 12.0;
            let of = |all: &[Velocity], part: usize| -> Vec<f64> {
                all[range.clone()].iter().map(|one| one[part]).collect()
            };
            for (part, size) in [(0, mass), (1, mass), (2, inertia)] {
                let velocity = of(&velocities, part);
                let [own, friction, drive] = changes
                    .each_ref()
                    .map(|change| shape.products(&velocity, &of(change, part)));
                let squares = shape.products(&velocity, &velocity);
                for (scale, budget) in scales.iter_mut().enumerate().take(generation + 1) {
                    budget.energy += 0.5 * size * squares[scale];
                    budget.received += size * own[scale];
                    budget.friction += size * friction[scale];
                    budget.drive += size * drive[scale];
                }
            }
            // 1 − cos θ = |1 − e^{iθ}|²/2.
            let weight = shape.weight(generation);
            let angles = range.clone().map(|link| theta[link].sin_cos());
            let (sines, heights): (Vec<f64>, Vec<f64>) =
                angles.map(|(sine, cosine)| (sine, 1.0 - cosine)).unzip();
            let turned = |values: &[f64]| -> Vec<f64> {
                values
                    .iter()
                    .zip(&omega[range.clone()])
                    .map(|(value, omega)| value * omega)
                    .collect()
            };
            let cosines: Vec<f64> = heights.iter().map(|height| 1.0 - height).collect();
            for (values, rates) in [(&sines, turned(&cosines)), (&heights, turned(&sines))] {
                let squares = shape.products(values, values);
                let changes = shape.products(values, &rates);
                for (scale, budget) in scales.iter_mut().enumerate().take(generation + 1) {
                    budget.energy += 0.5 * weight * squares[scale];
                    budget.received += weight * changes[scale];
                }
            }
        }
        scales
    }
}

impl Shape {
    /// Velocities of the centres of all rods, and their angular velocities `omega`; or, where `turning` is
    /// given, the accelerations by angular accelerations `omega` of rods that turn so.
    fn velocities(&self, theta: &[f64], omega: &[f64], turning: Option<&[f64]>) -> Vec<Velocity> {
        let mut ends = vec![[0.0; 2]; self.links()];
        let mut velocities = vec![[0.0; 3]; self.links()];
        for generation in 0..self.generations {
            let (first, width) = (self.first(generation), self.width(generation));
            for place in 0..width {
                let link = first + place;
                let (sine, cosine) = theta[link].sin_cos();
                let square = turning.map_or(0.0, |turning| turning[link] * turning[link]);
                let along = [
                    omega[link] * cosine - square * sine,
                    omega[link] * sine + square * cosine,
                ];
                let pivot = match generation {
                    0 => [0.0; 2],
                    // Copy c under link i of n is number c n + i of the next generation.
                    _ => ends[self.first(generation - 1) + place % self.width(generation - 1)],
                };
                let length = self.length(generation);
                let at = |share: f64| [0, 1].map(|i| pivot[i] + share * length * along[i]);
                let [x, y] = at(0.5);
                velocities[link] = [x, y, omega[link]];
                ends[link] = at(1.0);
            }
        }
        velocities
    }

    /// Products of two quantities of the rods of one generation, by scale.
    fn products(&self, one: &[f64], other: &[f64]) -> Vec<f64> {
        let (mut one, mut other) = (one.to_vec(), other.to_vec());
        let mut products = Vec::new();
        let mut copies = 1.0;
        while one.len() > 1 {
            let parents = one.len() / self.branching;
            let [first, second] = [&one, &other].map(|values| self.means(values, parents));
            let deviations = (0..one.len()).map(|place| {
                (one[place] - first[place % parents]) * (other[place] - second[place % parents])
            });
            products.push(copies * deviations.sum::<f64>());
            copies *= self.branching as f64;
            (one, other) = (first, second);
        }
        products.push(copies * one[0] * other[0]);
        products.reverse();
        products
    }

    /// Means over the copies under each of `parents` rods.
    fn means(&self, values: &[f64], parents: usize) -> Vec<f64> {
        let share = 1.0 / self.branching as f64;
        let copies = |parent: usize| (0..self.branching).map(move |copy| copy * parents + parent);
        (0..parents)
            .map(|parent| share * copies(parent).map(|place| values[place]).sum::<f64>())
            .collect()
    }
}
