//! The choice of the solve for the accelerations: both are derived, and the
//! cheaper one stays.

use super::count::{Operations, operations};
use super::lower::{Environment, Lowering};
use super::solve::Matrix;
use super::{Pass, SolveChoice, ValueId};
use crate::functions::Argument;
use crate::scene::{LinkId, Scene, Solve};
use std::collections::BTreeMap;

/// Accelerations of links that are given, by link.
pub(super) type Held = BTreeMap<usize, ValueId>;

/// Accelerations of all links, and the torques that the given ones take beyond those from
/// outside, in the order of the links.
pub(super) struct Moved {
    pub(super) accelerations: Vec<ValueId>,
    pub(super) reactions: Vec<ValueId>,
}

/// Cost of a division in products and sums. On current processors one takes as
/// long as 4 to 8 of these at full width; both solves have one for each link
/// with children, so that little depends on it.
const DIVISION: usize = 6;

/// Cost by which solves are compared: products, sums and six times the
/// divisions. Sines and cosines are the same in all.
pub fn cost(operations: &Operations) -> usize {
    operations.multiplications + operations.additions + DIVISION * operations.divisions
}

/// Most products of a factorisation that is formed only to be compared. The recursion
/// takes some 40 operations a link, and a chain of 48 links has as many here.
const MOST_PRODUCTS: usize = 20_000;

/// Returns true if the factorisation takes far more operations than the recursion: one
/// product for each link and pair of links above it.
fn is_deep(scene: &Scene) -> bool {
    let mut depths: Vec<usize> = Vec::with_capacity(scene.links.len());
    for link in &scene.links {
        depths.push(link.parent.map_or(0, |parent| depths[parent.0] + 1));
    }
    let products = depths.iter().map(|depth| depth * (depth + 1) / 2);
    products.sum::<usize>() > MOST_PRODUCTS
}

impl Lowering<'_> {
    /// θ̈ in absolute angles, solved for as the scene asks, or else at the lower
    /// [`cost`]. What is not chosen leaves no trace in the program.
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

    /// θ̈ under torques from outside, by the solve that was chosen without them.
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

    /// θ̈ of all links and the reactions of the prescribed ones of a set, by the same
    /// solve.
    pub(super) fn accelerations_prescribed(
        &mut self,
        scene: &Scene,
        environment: &mut Environment<'_>,
        solve: Solve,
        set: usize,
    ) -> Moved {
        environment.torques = Some(Argument::Torques);
        let mut held = Held::new();
        for (index, &LinkId(link)) in scene.prescribed[set].links.iter().enumerate() {
            let alpha = self.builder.input(Argument::Prescribed(set), index);
            held.insert(link, alpha);
        }
        let mut moved = match solve {
            Solve::Factorization => self.factorization_around(environment, &held),
            Solve::Recursion => self.recursion_around(scene, environment, &held),
        };
        // From the order of the links to that of the set.
        let order: Vec<usize> = held.keys().copied().collect();
        let links = scene.prescribed[set].links.iter();
        let of_link = |link: &LinkId| order.iter().position(|&known| known == link.0);
        let reactions = links
            .filter_map(of_link)
            .map(|place| moved.reactions[place]);
        moved.reactions = reactions.collect();
        moved
    }

    /// q̈ with M q̈ = Q − bias, Q from outside if at all, by elimination.
    pub(super) fn factorization(&mut self, environment: &mut Environment<'_>) -> Vec<ValueId> {
        self.factorization_around(environment, &Held::new())
            .accelerations
    }

    /// Elimination around links whose acceleration is given: their rows are the torques
    /// that it takes.
    fn factorization_around(&mut self, environment: &mut Environment<'_>, held: &Held) -> Moved {
        let frame = environment.frame;
        let names = self.coordinate_names(frame);
        let mass = self.mass_matrix(environment);
        let mut right = self.right_sides(environment, &names);
        let builder = &mut self.builder;
        let free: Vec<usize> = (0..right.len()).filter(|i| !held.contains_key(i)).collect();
        let (reduced, across) = without_held(&mass, &free);
        let mut take = |right: &mut [ValueId], link: usize, value: ValueId, alpha: ValueId| {
            let part = builder.mul(value, alpha);
            right[link] = builder.sub(right[link], part);
        };
        for &(row, column, value) in &across {
            if let Some(&alpha) = held.get(&column) {
                take(&mut right, row, value, alpha);
            }
            if let (Some(&alpha), true) = (held.get(&row), row != column) {
                take(&mut right, column, value, alpha);
            }
        }
        let own = free.iter().map(|&link| right[link]).collect();
        let free_names: Vec<String> = free.iter().map(|&link| names[link].clone()).collect();
        let solution = self.builder.solve(reduced, own, &free_names);
        let mut accelerations = right.clone();
        for (&link, &value) in free.iter().zip(&solution).chain(held) {
            accelerations[link] = value;
        }
        for (&value, name) in solution.iter().zip(&free_names) {
            self.builder.name(value, &format!("alpha_{name}"));
        }
        // What the free links' accelerations take besides.
        for &(row, column, value) in &across {
            for (link, other) in [(row, column), (column, row)] {
                if held.contains_key(&link) && !held.contains_key(&other) {
                    let part = self.builder.mul(value, accelerations[other]);
                    right[link] = self.builder.sub(right[link], part);
                }
            }
        }
        let mut reactions = Vec::with_capacity(held.len());
        for link in held.keys() {
            let reaction = self.builder.neg(right[*link]);
            reactions.push(
                self.builder
                    .name(reaction, &format!("reaction_{}", names[*link])),
            );
        }
        Moved {
            accelerations,
            reactions,
        }
    }

    /// Q − bias of all coordinates.
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

/// The matrix of the links that are not held, and the entries of all others.
fn without_held(mass: &Matrix, free: &[usize]) -> (Matrix, Vec<(usize, usize, ValueId)>) {
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
