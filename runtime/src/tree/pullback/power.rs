//! Virtual power of all forces on a tree, with its derivatives.

use alloc::vec::Vec;

use super::constants::{LAWS, ParameterSlopes, PassiveLink, add_through};
use super::planar::{Vector, arm, arm_slopes, direction, dot, scaled, sum, turned, turned_back};
use crate::friction::{FrictionLaw, LAW_CONSTANTS};
use crate::scalar::Scalar;
use crate::spring_dampers::SpringDampers;
use crate::translational::TranslationalSpringDampers;
use crate::tree::shape::Shape;

/// Constants of a tree on which the virtual power of its forces depends, and their derivatives by
/// the tree's parameters.
///
/// The accelerations α of a tree solve M α + b = Q. If the state or a constant changes, the sum Σ w_i
/// α_i with weights w changes by λ·δ(Q − M α − b), where λ solves M λ = w and δ is the change with α
/// and λ held constant. The product λ·(Q − M α − b) is the virtual power of all forces, inertial
/// forces included, along the virtual angular velocities λ (d'Alembert's principle). It is a sum
/// over links, springs and dampers, and each term depends on few angles. Therefore one pass from the
/// root to the leaves and one back give all derivatives.
#[derive(Clone, Debug, PartialEq)]
pub struct VirtualPower<T> {
    pub(super) shape: Shape,
    gravity: T,
    /// Constants of all links, or of one link per generation.
    pub(super) links: Vec<PassiveLink<T>>,
    pub(super) springs: SpringDampers<T>,
    lines: TranslationalSpringDampers<T>,
    slopes: ParameterSlopes<T>,
}

/// Motion at one state.
#[derive(Clone, Copy, Debug)]
pub struct VirtualMotion<'a, T> {
    /// Angles θ, in rad.
    pub theta: &'a [T],
    /// Angular velocities ω, in rad/s.
    pub omega: &'a [T],
    /// Angular accelerations α, in rad/s².
    pub alpha: &'a [T],
    /// Virtual angular velocities λ.
    pub lambda: &'a [T],
    /// Acceleration of the root's pivot, x and y, in m/s². y is opposite to a link at angle 0.
    pub pivot: [T; 2],
}

impl<T: Scalar> VirtualPower<T> {
    /// Number of values of memory that one link takes.
    pub const NUMBERS: usize = 2 * Derivatives::<T>::VECTORS;

    /// Creates the virtual power of a tree of this shape under a gravity in m/s², from the constants
    /// of all links or of one link per generation, without parameters.
    #[must_use]
    pub fn new(shape: Shape, gravity: T, links: Vec<PassiveLink<T>>) -> Self {
        Self {
            shape,
            gravity,
            links,
            springs: SpringDampers::default(),
            lines: TranslationalSpringDampers::default(),
            slopes: ParameterSlopes::new(0, &[], &[]),
        }
    }

    /// Adds springs and dampers between links that are not parent and child, and to the ground.
    #[must_use]
    pub fn with_forces_between(
        self,
        springs: SpringDampers<T>,
        lines: TranslationalSpringDampers<T>,
    ) -> Self {
        Self {
            springs,
            lines,
            ..self
        }
    }

    /// Adds the derivatives of the constants by parameters.
    #[must_use]
    pub fn with_slopes(self, slopes: ParameterSlopes<T>) -> Self {
        Self { slopes, ..self }
    }

    /// Returns the same virtual power with constants of another scalar type.
    #[must_use]
    pub fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> VirtualPower<S> {
        let links = self.links.iter();
        VirtualPower {
            shape: self.shape.clone(),
            gravity: convert(self.gravity),
            links: links.map(|link| link.cast(&convert)).collect(),
            springs: self.springs.cast(&convert),
            lines: self.lines.cast(&convert),
            slopes: self.slopes.cast(convert),
        }
    }

    /// Returns the number of links.
    #[must_use]
    pub fn links(&self) -> usize {
        self.shape.links()
    }

    /// Returns the number of parameters.
    #[must_use]
    pub fn parameters(&self) -> usize {
        self.slopes.parameters()
    }

    /// Adds the derivatives of the virtual power by angles, angular velocities and parameters to `by`,
    /// and returns those by the acceleration of the root's pivot. `memory` has
    /// [`NUMBERS`](Self::NUMBERS) for each link. All derivatives are NaN if a slice has another length,
    /// or if there are fewer or more links than the shape has rows.
    /// O(links), and O(1) for each derivative of a constant by a parameter; allocates nothing.
    pub fn add_derivatives(
        &self,
        motion: VirtualMotion<'_, T>,
        memory: &mut [T],
        by: [&mut [T]; 3],
    ) -> [T; 2] {
        let links = self.links();
        let VirtualMotion {
            theta,
            omega,
            alpha,
            lambda,
            ..
        } = motion;
        let [by_theta, by_omega, parameters] = &by;
        let states = [theta, omega, alpha, lambda, by_theta, by_omega].map(<[T]>::len);
        let springs_fit = self.springs.is_empty() || self.springs.links() == links;
        let lines_fit = self.lines.is_empty() || self.lines.links() == links;
        let fit = states == [links; 6]
            && self.links.len() == self.shape.rows()
            && springs_fit
            && lines_fit
            && parameters.len() == self.parameters()
            && memory.len() == Self::NUMBERS * links;
        if !fit {
            let nan = T::from_f64(f64::NAN);
            by.into_iter().for_each(|slopes| slopes.fill(nan));
            return [nan; 2];
        }
        let mut derivatives = Derivatives::new(self, motion, memory, by);
        let pivot = derivatives.add_links();
        derivatives.add_springs();
        derivatives.add_lines();
        pivot
    }
}

/// Derivatives of the virtual power at one state, as sums under construction.
pub(super) struct Derivatives<'a, T> {
    pub(super) power: &'a VirtualPower<T>,
    pub(super) motion: VirtualMotion<'a, T>,
    /// Directions of the links.
    pub(super) axes: &'a mut [Vector<T>],
    /// Virtual velocities U of the pivots.
    velocities: &'a mut [Vector<T>],
    /// Accelerations A of the pivots, against free fall.
    accelerations: &'a mut [Vector<T>],
    /// Derivatives of the virtual power by U: the forces of inertia of all that the pivot carries.
    forces: &'a mut [Vector<T>],
    /// Derivatives of the virtual power by A: the opposite of the virtual momentum of all that the
    /// pivot carries.
    momenta: &'a mut [Vector<T>],
    /// Sums of the derivatives by angles, angular velocities and parameters.
    pub(super) by: [&'a mut [T]; 3],
}

impl<'a, T: Scalar> Derivatives<'a, T> {
    /// Number of vectors of memory that one link takes.
    const VECTORS: usize = 5;

    /// Prepares the sums at a state. All slices have the right length.
    fn new(
        power: &'a VirtualPower<T>,
        motion: VirtualMotion<'a, T>,
        memory: &'a mut [T],
        by: [&'a mut [T]; 3],
    ) -> Self {
        let links = motion.theta.len();
        let (vectors, _) = memory.as_chunks_mut::<2>();
        let (axes, vectors) = vectors.split_at_mut(links);
        let (velocities, vectors) = vectors.split_at_mut(links);
        let (accelerations, vectors) = vectors.split_at_mut(links);
        let (forces, momenta) = vectors.split_at_mut(links);
        for (axis, angle) in axes.iter_mut().zip(motion.theta) {
            *axis = direction(*angle);
        }
        Self {
            power,
            motion,
            axes,
            velocities,
            accelerations,
            forces,
            momenta,
            by,
        }
    }

    /// Adds the derivatives of the links' part, and returns those by the acceleration of the root's
    /// pivot.
    fn add_links(&mut self) -> Vector<T> {
        let zero = T::from_f64(0.0);
        let power = self.power;
        let [x, y] = self.motion.pivot;
        let root = [x, power.gravity + y];
        for strip in power.shape.strips() {
            let Some(link) = power.links.get(strip.row) else {
                continue;
            };
            for (index, parent) in strip.each() {
                let (velocity, acceleration) = match parent {
                    Some(parent) => self.at(parent, link.pivot),
                    None => ([zero; 2], root),
                };
                self.velocities[index] = velocity;
                self.accelerations[index] = acceleration;
            }
        }
        self.forces.fill([zero; 2]);
        self.momenta.fill([zero; 2]);
        for strip in power.shape.strips().rev() {
            let Some(link) = power.links.get(strip.row) else {
                continue;
            };
            for (index, parent) in strip.each() {
                let by_constants = self.add_link(index, parent, link);
                self.add_by_link(1 + strip.row, &by_constants);
            }
        }
        let pivot = self.momenta.first().copied().unwrap_or([zero; 2]);
        self.add_by_parameters(0, 0, &[pivot[1]]);
        pivot
    }

    /// Adds to the derivatives by parameters those that go through consecutive constants of a group.
    pub(super) fn add_by_parameters(&mut self, group: usize, first: usize, by_constants: &[T]) {
        let [_, _, parameters] = &mut self.by;
        add_through(self.power.slopes.of(group), first, by_constants, parameters);
    }

    /// Adds to the derivatives by parameters those that go through the constants of a law of friction.
    pub(super) fn add_by_law(
        &mut self,
        group: usize,
        first: usize,
        by_constants: Option<FrictionLaw<T>>,
    ) {
        if let Some(law) = by_constants {
            self.add_by_parameters(group, first, &law.into_constants());
        }
    }

    /// Adds to the derivatives by parameters those that go through the constants of a link.
    fn add_by_link(&mut self, group: usize, by_constants: &PassiveLink<T>) {
        let PassiveLink {
            mass,
            inertia,
            com: [along, across],
            pivot: [pivot_along, pivot_across],
            joint,
            ground,
        } = *by_constants;
        let own: [T; LAWS] = [
            mass,
            inertia,
            along,
            across,
            pivot_along,
            pivot_across,
            joint.friction,
            ground.friction,
            joint.spring,
            joint.rest,
        ];
        self.add_by_parameters(group, 0, &own);
        self.add_by_law(group, own.len(), joint.law);
        self.add_by_law(group, own.len() + LAW_CONSTANTS, ground.law);
    }

    /// Returns the virtual velocity and the acceleration of a point of a link, which is given by its
    /// components along the link and across it.
    fn at(&self, link: usize, point: [T; 2]) -> (Vector<T>, Vector<T>) {
        let VirtualMotion {
            omega,
            alpha,
            lambda,
            ..
        } = self.motion;
        let arm = arm(point, self.axes[link]);
        let centripetal = scaled(-(omega[link] * omega[link]), arm);
        let turning = sum(scaled(alpha[link], turned(arm)), centripetal);
        (
            sum(self.velocities[link], scaled(lambda[link], turned(arm))),
            sum(self.accelerations[link], turning),
        )
    }

    /// Adds the derivatives of a power that depends on virtual velocity and acceleration of a point
    /// of a link, given the derivatives by these two. Returns the derivatives by the components of
    /// the point.
    fn add_point(
        &mut self,
        link: usize,
        point: [T; 2],
        force: Vector<T>,
        momentum: Vector<T>,
    ) -> [T; 2] {
        let VirtualMotion {
            omega,
            alpha,
            lambda,
            ..
        } = self.motion;
        let (omega, axis) = (omega[link], self.axes[link]);
        // The power depends on the arm e as e·g; the transpose of J is −J.
        let turning = sum(scaled(lambda[link], force), scaled(alpha[link], momentum));
        let g = sum(scaled(-(omega * omega), momentum), turned_back(turning));
        let (by_angle, by_point) = arm_slopes(point, axis, g);
        let [by_theta, by_omega, _] = &mut self.by;
        by_theta[link] = by_theta[link] + by_angle;
        let twice = omega + omega;
        by_omega[link] = by_omega[link] - twice * dot(arm(point, axis), momentum);
        self.forces[link] = sum(self.forces[link], force);
        self.momenta[link] = sum(self.momenta[link], momentum);
        by_point
    }

    /// Adds the derivatives of the part of one link, whose children have been added before. Returns
    /// the derivatives by the constants of the link.
    fn add_link(
        &mut self,
        index: usize,
        parent: Option<usize>,
        link: &PassiveLink<T>,
    ) -> PassiveLink<T> {
        let VirtualMotion { alpha, lambda, .. } = self.motion;
        let (velocity, acceleration) = self.at(index, link.com);
        let (force, momentum) = (
            scaled(-link.mass, acceleration),
            scaled(-link.mass, velocity),
        );
        let com = self.add_point(index, link.com, force, momentum);
        let pivot = match parent {
            Some(parent) => {
                self.add_point(parent, link.pivot, self.forces[index], self.momenta[index])
            }
            None => [T::from_f64(0.0); 2],
        };
        PassiveLink {
            mass: -dot(acceleration, velocity),
            inertia: -(alpha[index] * lambda[index]),
            com,
            pivot,
            joint: self.add_torque(&link.joint, [Some(index), parent]),
            ground: self.add_torque(&link.ground, [Some(index), None]),
        }
    }

    /// Adds the derivatives of the forces along lines.
    fn add_lines(&mut self) {
        let power = self.power;
        let group = 1 + power.links.len() + power.springs.runs().count();
        for (run, (line, count)) in power.lines.runs().enumerate() {
            let slopes = power.slopes.of(group + run);
            for place in 0..count {
                self.add_line(line, place, slopes);
            }
        }
    }
}
