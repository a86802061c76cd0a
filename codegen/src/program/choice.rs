//! The choice of the solve for the accelerations: both are derived, and the
//! cheaper one stays.

use super::count::{Operations, operations};
use super::lower::{Environment, Lowering};
use super::{Pass, ValueId};
use crate::scene::{Scene, Solve};

/// The solve for the accelerations in absolute angles, and the cost of both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice {
    /// The solve that is emitted.
    pub solve: Solve,
    /// Operations of the factorisation.
    pub factorization: Operations,
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

impl Lowering<'_> {
    /// θ̈ in absolute angles, solved for as the scene asks, or else at the lower
    /// [`cost`]. What is not chosen leaves no trace in the program.
    pub(super) fn accelerations(
        &mut self,
        scene: &Scene,
        environment: &mut Environment<'_>,
    ) -> (Vec<ValueId>, Choice) {
        let (mut other, mut other_environment) = (self.clone(), environment.clone());
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
            factorization: factorization_cost,
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

    /// q̈ with M q̈ = −bias, by elimination.
    pub(super) fn factorization(&mut self, environment: &mut Environment<'_>) -> Vec<ValueId> {
        let frame = environment.frame;
        let names = self.coordinate_names(frame);
        let mass = self.mass_matrix(environment);
        let mut right = Vec::new();
        for (bias, name) in frame.bias.iter().zip(&names) {
            let value = self.expr(environment, bias);
            self.builder.name(value, &format!("bias_{name}"));
            let torque = self.builder.neg(value);
            right.push(self.builder.name(torque, &format!("torque_{name}")));
        }
        let solution = self.builder.solve(mass, right, &names);
        for (&value, name) in solution.iter().zip(&names) {
            self.builder.name(value, &format!("alpha_{name}"));
        }
        solution
    }
}
