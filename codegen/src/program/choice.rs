//! The choice of the solve for the accelerations: both are derived, and the
//! cheaper one stays.

use super::count::{Operations, operations};
use super::lower::{Environment, Lowering};
use super::{Argument, Pass, ValueId};
use crate::scene::{Scene, Solve};

/// The solve for the accelerations in absolute angles, and the cost of both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice {
    /// The solve that is emitted.
    pub solve: Solve,
    /// Operations of the factorisation; `None` where it is too long to be formed.
    pub factorization: Option<Operations>,
    /// Operations of the recursion.
    pub recursion: Operations,
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
    ) -> (Vec<ValueId>, Choice) {
        let (mut other, mut other_environment) = (self.clone(), environment.clone());
        let compared = self.builder.off == Some(Pass::Choice)
            || scene.requests.solve == Some(Solve::Factorization);
        if is_deep(scene) && !compared {
            let recursion = self.recursion(scene, environment);
            let choice = Choice {
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
        let choice = Choice {
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

    /// q̈ with M q̈ = Q − bias, Q from outside if at all, by elimination.
    pub(super) fn factorization(&mut self, environment: &mut Environment<'_>) -> Vec<ValueId> {
        let frame = environment.frame;
        let names = self.coordinate_names(frame);
        let mass = self.mass_matrix(environment);
        let mut right = Vec::new();
        for (bias, name) in frame.bias.iter().zip(&names) {
            let value = self.expr(environment, bias);
            self.builder.name(value, &format!("bias_{name}"));
            let mut torque = self.builder.neg(value);
            if let Some(argument) = environment.torques {
                let outside = self.builder.input(argument, right.len());
                torque = self.builder.add(outside, torque);
            }
            right.push(self.builder.name(torque, &format!("torque_{name}")));
        }
        let solution = self.builder.solve(mass, right, &names);
        for (&value, name) in solution.iter().zip(&names) {
            self.builder.name(value, &format!("alpha_{name}"));
        }
        solution
    }
}
