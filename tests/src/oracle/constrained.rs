//! The equations of motion in maximal coordinates: every body moves freely in
//! the plane, and forces in the joints hold the tree together.
//!
//! Unknowns are the accelerations of all centres of mass, the angular
//! accelerations, and two components of force for each joint. No Jacobian of
//! the tree and no mass matrix appears.

use nalgebra::{DMatrix, DVector};

use super::drive::Push;
use super::{Tree, perpendicular, turned};

/// The angular accelerations, rad/s², of the tree with angles `theta` (rad)
/// and angular velocities `omega` (rad/s).
///
/// Newton's and Euler's equations for body l, with the force f_l that the
/// parent exerts on it in its pivot:
///
/// m r̈ = −m g ŷ + f_l − Σ_children f_j,
/// I ω̇ = Σ torques of these forces about the centre of mass + friction,
///
/// and the twice differentiated condition that the pivot of l is where the
/// parent has it. Dense LU decomposition, O(n³).
///
/// # Panics
/// If the system is singular.
pub fn accelerations(tree: &Tree, theta: &[f64], omega: &[f64]) -> Vec<f64> {
    driven(tree, theta, omega, &Push::default())
}

/// Accelerations with a torque on the root and an accelerated pivot, all in the
/// frame of the ground: only the condition on the root's pivot changes.
///
/// # Panics
/// As [`accelerations`].
pub fn driven(tree: &Tree, theta: &[f64], omega: &[f64], push: &Push) -> Vec<f64> {
    let n = tree.links.len();
    // Blocks of unknowns: x and y by body, angles, forces by joint.
    let position = |body: usize, axis: usize| 2 * body + axis;
    let angle = |body: usize| 2 * n + body;
    let force = |body: usize, axis: usize| 3 * n + 2 * body + axis;
    let mut matrix = DMatrix::zeros(5 * n, 5 * n);
    let mut right = DVector::zeros(5 * n);
    for (body, link) in tree.links.iter().enumerate() {
        // From the centre of mass to the body's own pivot.
        let up = turned([-link.com[0], -link.com[1]], theta[body]);
        matrix[(angle(body), angle(body))] = link.inertia;
        for axis in 0..2 {
            let row = position(body, axis);
            matrix[(row, row)] = link.mass;
            matrix[(row, force(body, axis))] = -1.0;
            // The torque of a force F on the arm r is (⊥r)·F.
            matrix[(angle(body), force(body, axis))] = -perpendicular(up)[axis];
            // Acceleration of the pivot as this body sees it.
            let row = force(body, axis);
            matrix[(row, position(body, axis))] = 1.0;
            matrix[(row, angle(body))] = perpendicular(up)[axis];
            right[row] += omega[body] * omega[body] * up[axis];
        }
        right[position(body, 1)] = -link.mass * tree.gravity;
        let (torque, _) = link.pivot_torque(body, theta, omega);
        right[angle(body)] += torque + link.ground_torque(omega[body]).0;
        let Some(parent) = link.parent else {
            right[angle(body)] += push.torque;
            for axis in 0..2 {
                right[force(body, axis)] += push.acceleration[axis];
            }
            continue;
        };
        right[angle(parent)] -= torque;
        // From the parent's centre of mass to this pivot.
        let com = tree.links[parent].com;
        let down = turned(
            [link.pivot[0] - com[0], link.pivot[1] - com[1]],
            theta[parent],
        );
        for axis in 0..2 {
            matrix[(position(parent, axis), force(body, axis))] = 1.0;
            matrix[(angle(parent), force(body, axis))] = perpendicular(down)[axis];
            // ... must be what the parent makes it.
            let row = force(body, axis);
            matrix[(row, position(parent, axis))] = -1.0;
            matrix[(row, angle(parent))] = -perpendicular(down)[axis];
            right[row] -= omega[parent] * omega[parent] * down[axis];
        }
    }
    for own in &tree.between {
        let [a, b] = own.links;
        let (torque, _) = own.torque(theta, omega);
        right[angle(a)] += torque;
        right[angle(b)] -= torque;
    }
    let solution = matrix
        .lu()
        .solve(&right)
        .expect("joints hold a tree together in one way");
    (0..n).map(|body| solution[angle(body)]).collect()
}
