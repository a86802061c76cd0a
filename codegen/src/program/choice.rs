//! Choice of the method of solving for the accelerations: both methods are derived, and the cheaper
//! one is kept.

use super::count::{Operations, operations};
use super::lower::{Environment, Lowering};
use super::solve::Matrix;
use super::{Pass, SolveChoice, ValueId};
use crate::functions::Argument;
use crate::scene::{LinkId, Scene, Solve};
use std::collections::BTreeMap;

/// Prescribed accelerations, as values by the index of the link.
pub(super) type PrescribedAccelerations = BTreeMap<usize, ValueId>;

/// Accelerations of all links, and the torques that the prescribed ones need in addition to the
/// external torques, in the order of the links.
pub(super) struct PrescribedSolution {
    pub(super) accelerations: Vec<ValueId>,
    pub(super) reactions: Vec<ValueId>,
}

/// Cost of a division relative to a product or sum. On current processors a division takes as long
/// as 4 to 8 of these in vector code. Both methods have one division for each link with children,
/// so that the value hardly matters.
const DIVISION: usize = 6;

/// Returns the cost by which the methods are compared: products, sums and six times the divisions.
/// Sines and cosines are the same in both.
pub fn cost(operations: &Operations) -> usize {
    operations.multiplications + operations.additions + DIVISION * operations.divisions
}

/// Largest number of products of a factorisation that is derived only for comparison. The recursion
/// takes about 40 operations per link; the factorisation of a chain of 48 links has this many
/// products.
const MOST_PRODUCTS: usize = 20_000;

/// Returns true if the factorisation takes far more operations than the recursion. It has one
/// product for each link and each pair of its ancestors.
fn is_deep(scene: &Scene) -> bool {
    let mut depths: Vec<usize> = Vec::with_capacity(scene.links.len());
    for link in &scene.links {
        depths.push(link.parent.map_or(0, |parent| depths[parent.0] + 1));
    }
    let products = depths.iter().map(|depth| depth * (depth + 1) / 2);
    products.sum::<usize>() > MOST_PRODUCTS
}

impl Lowering<'_> {
    /// Computes the accelerations θ̈ in absolute angles, by the requested method or else by the one
    /// with the lower [`cost`]. The program contains nothing of the other method.
    pub(super) fn accelerations(
        &mut self,
        scene: &Scene,
        environment: &mut Environment<'_>,
    ) -> (Vec<ValueId>, SolveChoice) {
        let (mut other, mut other_environment) = (self.clone(), environment.clone());
        let compared = self.builder.off == Some(Pass::Choice)
            || scene.requests.solve == Some(Solve::Factorization);
        if is_deep(scene) && !compared {
            let recursion = self.recursion(scene, environment);
            let choice = SolveChoice {
                solve: Solve::Recursion,
                factorization: None,
                recursion: operations(&self.builder.definitions, &recursion),
            };
            if self.builder.setup.is_representable() {
                return (recursion, choice);
            }
            (*self, *environment) = (other.clone(), other_environment.clone());
        }
        let recursion = other.recursion(scene, &mut other_environment);
        let recursion_cost = operations(&other.builder.definitions, &recursion);
        let factorization = self.factorization(environment);
        let factorization_cost = operations(&self.builder.definitions, &factorization);
        let cheaper = self.builder.off != Some(Pass::Choice)
            && cost(&recursion_cost) < cost(&factorization_cost)
            && other.builder.setup.is_representable();
        let solve = scene.requests.solve.unwrap_or(match cheaper {
            true => Solve::Recursion,
            false => Solve::Factorization,
        });
        let choice = SolveChoice {
            solve,
            factorization: Some(factorization_cost),
            recursion: recursion_cost,
        };
        match solve {
            Solve::Factorization => (factorization, choice),
            Solve::Recursion => {
                *self = other;
                *environment = other_environment;
                (recursion, choice)
            }
        }
    }

    /// Computes the accelerations θ̈ under external torques, by the method that was chosen without
    /// them.
    pub(super) fn accelerations_under(
        &mut self,
        scene: &Scene,
        environment: &mut Environment<'_>,
        solve: Solve,
    ) -> Vec<ValueId> {
        environment.torques = Some(Argument::Torques);
        match solve {
            Solve::Factorization => self.factorization(environment),
            Solve::Recursion => self.recursion(scene, environment),
        }
    }

    /// Computes the accelerations θ̈ of all links and the reaction torques of the prescribed links
    /// of a set, by the same method.
    pub(super) fn accelerations_prescribed(
        &mut self,
        scene: &Scene,
        environment: &mut Environment<'_>,
        solve: Solve,
        set: usize,
    ) -> PrescribedSolution {
        environment.torques = Some(Argument::Torques);
        let mut prescribed = PrescribedAccelerations::new();
        for (index, &LinkId(link)) in scene.prescribed[set].links.iter().enumerate() {
            let alpha = self.builder.input(Argument::Prescribed(set), index);
            prescribed.insert(link, alpha);
        }
        let mut moved = self.around(scene, environment, solve, &prescribed);
        // From the order of the links to that of the set.
        let order: Vec<usize> = prescribed.keys().copied().collect();
        let links = scene.prescribed[set].links.iter();
        let of_link = |link: &LinkId| order.iter().position(|&known| known == link.0);
        let reactions = links
            .filter_map(of_link)
            .map(|place| moved.reactions[place]);
        moved.reactions = reactions.collect();
        moved
    }

    /// Computes θ̈ of all links with the chosen method, and the torques that the prescribed
    /// accelerations need.
    pub(super) fn around(
        &mut self,
        scene: &Scene,
        environment: &mut Environment<'_>,
        solve: Solve,
        prescribed: &PrescribedAccelerations,
    ) -> PrescribedSolution {
        match solve {
            Solve::Factorization => self.factorization_around(environment, prescribed),
            Solve::Recursion => self.recursion_around(scene, environment, prescribed),
        }
    }

    /// Solves M q̈ = Q − bias for q̈ by elimination, with external torques Q if there are any.
    pub(super) fn factorization(&mut self, environment: &mut Environment<'_>) -> Vec<ValueId> {
        self.factorization_around(environment, &PrescribedAccelerations::new())
            .accelerations
    }

    /// Solves by elimination with some accelerations prescribed: the rows of these links give the
    /// torques that they need.
    fn factorization_around(
        &mut self,
        environment: &mut Environment<'_>,
        prescribed: &PrescribedAccelerations,
    ) -> PrescribedSolution {
        let frame = environment.frame;
        let names = self.coordinate_names(frame);
        let mass = self.mass_matrix(environment);
        let mut right = self.right_sides(environment, &names);
        let builder = &mut self.builder;
        let free: Vec<usize> = (0..right.len())
            .filter(|i| !prescribed.contains_key(i))
            .collect();
        let (reduced, across) = without_prescribed(&mass, &free);
        let mut take = |right: &mut [ValueId], link: usize, value: ValueId, alpha: ValueId| {
            let part = builder.mul(value, alpha);
            right[link] = builder.sub(right[link], part);
        };
        for &(row, column, value) in &across {
            if let Some(&alpha) = prescribed.get(&column) {
                take(&mut right, row, value, alpha);
            }
            if let (Some(&alpha), true) = (prescribed.get(&row), row != column) {
                take(&mut right, column, value, alpha);
            }
        }
        let own = free.iter().map(|&link| right[link]).collect();
        let free_names: Vec<String> = free.iter().map(|&link| names[link].clone()).collect();
        let solution = self.builder.solve(reduced, own, &free_names);
        let mut accelerations = right.clone();
        for (&link, &value) in free.iter().zip(&solution).chain(prescribed) {
            accelerations[link] = value;
        }
        for (&value, name) in solution.iter().zip(&free_names) {
            self.builder.name(value, &format!("alpha_{name}"));
        }
        // Contribution of the free links' accelerations to these torques.
        for &(row, column, value) in &across {
            for (link, other) in [(row, column), (column, row)] {
                if prescribed.contains_key(&link) && !prescribed.contains_key(&other) {
                    let part = self.builder.mul(value, accelerations[other]);
                    right[link] = self.builder.sub(right[link], part);
                }
            }
        }
        let mut reactions = Vec::with_capacity(prescribed.len());
        for link in prescribed.keys() {
            let reaction = self.builder.neg(right[*link]);
            reactions.push(
                self.builder
                    .name(reaction, &format!("reaction_{}", names[*link])),
            );
        }
        PrescribedSolution {
            accelerations,
            reactions,
        }
    }

    /// Returns the right sides Q − bias of the equations of motion, one for each coordinate.
    fn right_sides(&mut self, environment: &mut Environment<'_>, names: &[String]) -> Vec<ValueId> {
        let mut right = Vec::new();
        for (bias, name) in environment.frame.bias.iter().zip(names) {
            let value = self.expr(environment, bias);
            self.builder.name(value, &format!("bias_{name}"));
            let torque = self.builder.neg(value);
            self.builder.name(torque, &format!("minus_bias_{name}"));
            right.push(match environment.torques {
                Some(argument) => {
                    let outside = self.builder.input(argument, right.len());
                    let torque = self.builder.add(outside, torque);
                    self.builder.name(torque, &format!("torque_{name}"))
                }
                None => torque,
            });
        }
        right
    }
}

/// Splits the mass matrix into the block of the free links, and all other entries.
fn without_prescribed(mass: &Matrix, free: &[usize]) -> (Matrix, Vec<(usize, usize, ValueId)>) {
    let (mut reduced, mut across) = (Matrix::new(), Vec::new());
    for (&(row, column), &value) in mass {
        let place = |link: usize| free.binary_search(&link).ok();
        match (place(row), place(column)) {
            (Some(i), Some(j)) => {
                reduced.insert((i, j), value);
            }
            _ => across.push((row, column, value)),
        }
    }
    (reduced, across)
}
