//! Budgets by scale of trees in loops: against budgets by sector that are written out,
//! against rates of the energies along the motion, and against each other.

mod rates;
mod written_out;

use branched_pendulum::prelude::*;
use branched_pendulum::sectors::{ScaleBudget, Scales};
use branched_pendulum::system::Workspace;
use branched_pendulum_compiler_tests::random::Random;

/// A tree in loops and its description.
macro_rules! tree {
    ($name:ident: $($tree:tt)*) => {
        #[branched_pendulum(
            gravity = 9.80665, emit(energies, forces, budget(parseval, scales)), $($tree)*
        )]
        struct $name;
    };
    ($name:ident, $text:ident: $($tree:tt)*) => {
        tree!($name: $($tree)*);

        /// Description of the tree without what is asked for.
        const $text: &str = stringify!($($tree)*);
    };
}

tree!(Seven, SEVEN: tree: generations(count = 3, branching = 2, shape = rod, mass = 0.12,
    length = 0.3, mass_ratio = 0.5, length_ratio = 0.7));
tree!(Fifteen, FIFTEEN: tree: generations(count = 4, branching = 2, mass = 0.12,
    com = (0.14, 0.02), inertia = 1e-3, joint = (0.3, 0.05), mass_ratio = 0.5,
    length_ratio = 0.7, friction = 1e-3, drag = 4e-4, spring = 0.02),
    drive(torque = 0.4 * cos(3 * t), x = 0.02 * sin(5 * t), y = 0.01 * cos(4 * t)));
tree!(ThirtyOne, THIRTY_ONE: tree: generations(count = 5, branching = 2, shape = rod,
    mass = 0.2, length = 0.3, mass_ratio = 0.6, length_ratio = 0.8, friction = 1e-4),
    drive(torque = 0.2 * cos(4 * t)));
tree!(Thirteen, THIRTEEN: tree: generations(count = 3, branching = 3, shape = rod, mass = 0.12,
    length = 0.3, mass_ratio = 0.4, length_ratio = 0.7, drag(viscous = 1e-3, quadratic = 1e-4),
    friction(viscous = 1e-4, coulomb = 2e-4, width = 0.05)));

tree!(Braked, BRAKED: tree: generations(count = 3, branching = 3, shape = rod, mass = 0.12,
    length = 0.3, mass_ratio = 0.4, length_ratio = 0.7,
    friction(viscous = 1e-4, coulomb = 1e-2, quadratic = 1e-3, width = 0.1), friction_ratio = 0.5,
    drag(quadratic = 1e-4)));

tree!(Coupled, COUPLED: tree: generations(count = 4, branching = 2, mass = 0.12,
    com = (0.14, 0.02), inertia = 1e-3, joint = (0.3, 0.05), mass_ratio = 0.5,
    length_ratio = 0.7),
    siblings(tree_2, spring = 0.1), siblings(tree_4, spring = 0.02,
        friction(viscous = 1e-3, coulomb = 2e-3, width = 0.1)),
    between(tree_1, tree_4_2_1_2, friction(viscous = 1e-3, quadratic = 1e-4)),
    drive(torque = 0.4 * cos(3 * t), x = 0.02 * sin(5 * t), y = 0.01 * cos(4 * t)));
// Joints have springs and friction besides, and two act between the same.
tree!(CoupledThrees, COUPLED_THREES: tree: generations(count = 3, branching = 3, shape = rod,
    mass = 0.12, length = 0.3, mass_ratio = 0.4, length_ratio = 0.7, spring = 0.01, drag = 1e-4,
    friction = 1e-4), siblings(tree_2, spring = 0.1, friction = 1e-3),
    siblings(tree_3, spring = 0.02), siblings(tree_3, spring = 0.03, friction(quadratic = 1e-4)));

// Large enough to be computed in blocks.
tree!(CoupledBlocks: tree: generations(count = 13, branching = 2, shape = rod,
    mass = 0.2, length = 0.3, mass_ratio = 0.6, length_ratio = 0.8),
    siblings(tree_13, spring = 1e-4, friction = 1e-5), siblings(tree_7, friction = 1e-4));
tree!(InBlocks: tree: generations(count = 13, branching = 2, shape = rod,
    mass = 0.2, length = 0.3, mass_ratio = 0.6, length_ratio = 0.8, friction = 1e-4,
    spring = 1e-3), drive(torque = 0.2 * cos(4 * t), y = 0.01 * sin(7 * t)));
tree!(BlocksOfThrees: tree: generations(count = 9, branching = 3,
    shape = rod, mass = 0.2, length = 0.3, mass_ratio = 0.4, length_ratio = 0.8, drag = 1e-4));

/// A state at a time, with torques from outside.
struct Sample {
    time: f64,
    theta: Vec<f64>,
    omega: Vec<f64>,
    torques: Vec<f64>,
}

fn samples(links: usize, count: usize) -> Vec<Sample> {
    let mut random = Random::new(11);
    (0..count)
        .map(|_| Sample {
            time: random.between(-3.0, 3.0),
            theta: random.around_zero(links, 3.0),
            omega: random.around_zero(links, 9.0),
            torques: random.around_zero(links, 0.1),
        })
        .collect()
}

fn budget<M: Scales<f64>>(model: &M, sample: &Sample) -> ScaleBudget<f64> {
    let (mut workspace, mut budget) = (Workspace::new(), ScaleBudget::new());
    let Sample {
        time,
        theta,
        omega,
        torques,
    } = sample;
    model.budget_by_scale_under(&mut workspace, *time, theta, omega, torques, &mut budget);
    budget
}
