//! The equations of motion from the Cartesian velocities of the centres of
//! mass: Jacobians propagated vector by vector along the tree.
//!
//! With r_l = Σ (offset vectors from the root to the centre of mass of l),
//! ṙ_l = J_l ω and r̈_l = J_l ω̇ + J̇_l ω, d'Alembert's principle reads
//! Σ_l [m_l J_lᵀ (r̈_l + g ŷ) + I_l ω̇_l e_l] + torques in the pivots
//! and of drag = 0. A moving pivot adds its acceleration to every r̈_l.

use nalgebra::{Cholesky, DMatrix, DVector};

use super::drive::Push;
use super::{Tree, Vector, dot, perpendicular, turned, turned_terms};

/// Motion of the tree in one state, and the size of the terms from which each
/// figure is summed: the measure for rounding errors.
#[derive(Clone, Debug)]
pub struct Motion {
    /// Mass matrix M, kg m².
    pub mass: DMatrix<f64>,
    /// M with the absolute value of every term.
    pub mass_terms: DMatrix<f64>,
    /// Centrifugal, gravity and friction torques on the left-hand side, N m.
    pub bias: DVector<f64>,
    /// The bias with the absolute value of every term.
    pub bias_terms: DVector<f64>,
    /// Kinetic energy ½ Σ m v² + I ω², J.
    pub kinetic: f64,
    /// The kinetic energy with the absolute value of every term, v multiplied
    /// out.
    pub kinetic_terms: f64,
    /// Potential energy, zero where all angles are zero, J.
    pub potential: f64,
    /// The potential energy with the absolute value of every term.
    pub potential_terms: f64,
}

/// Position of a centre of mass above its place at rest, its Jacobian and
/// J̇ω, with the absolute values of the terms.
struct Point {
    columns: Vec<(usize, Vector, Vector)>,
    drift: Vector,
    drift_terms: Vector,
    rise: f64,
    rise_terms: f64,
}

impl Point {
    /// The centre of mass of `link`.
    fn of(tree: &Tree, link: usize, theta: &[f64], omega: &[f64]) -> Self {
        let mut point = Self {
            columns: Vec::new(),
            drift: [0.0; 2],
            drift_terms: [0.0; 2],
            rise: 0.0,
            rise_terms: 0.0,
        };
        let mut offset = tree.links[link].com;
        for on_path in tree.lineage(link) {
            let vector = turned(offset, theta[on_path]);
            let [x, y] = turned_terms(offset, theta[on_path]);
            point.columns.push((on_path, perpendicular(vector), [y, x]));
            // The end of a turning vector is accelerated towards its pivot.
            let square = omega[on_path] * omega[on_path];
            for (axis, size) in [x, y].into_iter().enumerate() {
                point.drift[axis] -= square * vector[axis];
                point.drift_terms[axis] += square * size;
            }
            point.rise += vector[1] + offset[0];
            point.rise_terms += y + offset[0].abs();
            offset = tree.links[on_path].pivot;
        }
        point
    }
}

impl Motion {
    /// The tree with angles `theta` (rad) and angular velocities `omega`
    /// (rad/s).
    pub fn new(tree: &Tree, theta: &[f64], omega: &[f64]) -> Self {
        Self::driven(tree, theta, omega, &Push::default())
    }

    /// The motion with a torque on the root and an accelerated pivot.
    /// Velocities and energies are relative to the pivot.
    pub fn driven(tree: &Tree, theta: &[f64], omega: &[f64], push: &Push) -> Self {
        let n = tree.links.len();
        let mut motion = Self {
            mass: DMatrix::zeros(n, n),
            mass_terms: DMatrix::zeros(n, n),
            bias: DVector::zeros(n),
            bias_terms: DVector::zeros(n),
            kinetic: 0.0,
            kinetic_terms: 0.0,
            potential: 0.0,
            potential_terms: 0.0,
        };
        for (index, link) in tree.links.iter().enumerate() {
            motion.add_body(tree, index, [theta, omega], push);
            let (torque, terms) = link.pivot_torque(index, theta, omega);
            let (drag, drag_terms) = link.ground_torque(omega[index]);
            motion.bias[index] -= drag + torque;
            motion.bias_terms[index] += drag_terms + terms;
            if let Some(parent) = link.parent {
                motion.bias[parent] += torque;
                motion.bias_terms[parent] += terms;
            }
            let turn = theta[index] - link.parent.map_or(0.0, |parent| theta[parent]) - link.rest;
            motion.potential += 0.5 * link.spring * turn * turn;
            motion.potential_terms += 0.5 * link.spring * turn * turn;
        }
        for own in &tree.between {
            let [a, b] = own.links;
            let (torque, terms) = own.torque(theta, omega);
            motion.bias[a] -= torque;
            motion.bias[b] += torque;
            motion.bias_terms[a] += terms;
            motion.bias_terms[b] += terms;
            motion.potential += own.energy(theta);
            motion.potential_terms += own.energy(theta);
        }
        motion.bias[0] -= push.torque;
        motion.bias_terms[0] += push.torque_terms;
        motion
    }

    fn add_body(&mut self, tree: &Tree, index: usize, state: [&[f64]; 2], push: &Push) {
        let [theta, omega] = state;
        let link = &tree.links[index];
        let point = Point::of(tree, index, theta, omega);
        let mut velocity = [0.0; 2];
        let mut velocity_terms = [0.0; 2];
        for &(i, column, terms) in &point.columns {
            for axis in 0..2 {
                velocity[axis] += column[axis] * omega[i];
                velocity_terms[axis] += terms[axis] * omega[i].abs();
            }
            for &(j, other, other_terms) in &point.columns {
                self.mass[(i, j)] += link.mass * dot(column, other);
                self.mass_terms[(i, j)] += link.mass * dot(terms, other_terms);
            }
            let ([x, y], [a, b]) = (point.drift, push.acceleration);
            self.bias[i] += link.mass * dot(column, [x + a, y + b + tree.gravity]);
            let ([x, y], [a, b]) = (point.drift_terms, push.acceleration_terms);
            self.bias_terms[i] += link.mass * dot(terms, [x + a, y + b + tree.gravity]);
        }
        self.mass[(index, index)] += link.inertia;
        self.mass_terms[(index, index)] += link.inertia;
        let spin = link.inertia * omega[index] * omega[index];
        self.kinetic += 0.5 * (link.mass * dot(velocity, velocity) + spin);
        self.kinetic_terms += 0.5 * (link.mass * dot(velocity_terms, velocity_terms) + spin);
        self.potential += link.mass * tree.gravity * point.rise;
        self.potential_terms += link.mass * tree.gravity * point.rise_terms;
    }

    /// The angular accelerations, rad/s², by a dense Cholesky factorisation.
    ///
    /// # Panics
    /// If the mass matrix is not positive definite.
    pub fn accelerations(&self) -> DVector<f64> {
        self.factorised().solve(&-&self.bias)
    }

    /// M⁻¹, dense.
    ///
    /// # Panics
    /// As [`accelerations`](Self::accelerations).
    pub fn inverse_mass(&self) -> DMatrix<f64> {
        self.factorised().inverse()
    }

    fn factorised(&self) -> Cholesky<f64, nalgebra::Dyn> {
        Cholesky::new(self.mass.clone()).expect("a tree has a positive definite mass matrix")
    }

    /// The problem's conditioning: by how much each acceleration changes, to
    /// first order and at worst, when every *term* that the mass matrix and
    /// the bias are summed from changes by one part in one:
    /// |M⁻¹| (|M| |ω̇| + |b|), with |M| and |b| the sums of the terms'
    /// absolute values.
    pub fn sensitivity(&self, accelerations: &DVector<f64>) -> DVector<f64> {
        self.inverse_mass().abs() * self.residual_terms(accelerations)
    }

    /// |M| |ω̇| + |b|.
    pub fn residual_terms(&self, accelerations: &DVector<f64>) -> DVector<f64> {
        &self.mass_terms * accelerations.abs() + &self.bias_terms
    }
}
