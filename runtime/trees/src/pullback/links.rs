//! Virtual power of inertia, gravity, springs and friction, with its derivatives.

use branched_pendulum::friction::FrictionLaw;
use branched_pendulum::scalar::{Dual, Scalar};
use branched_pendulum::spring_dampers::SpringDamper;
use branched_pendulum::tree::RootDrive;
use branched_pendulum_codegen::scene::{self, LAW_CONSTANTS};

use super::constants::{Constants, LinkConstants, ParameterSlopes, numbers_of_spring};
use super::planar::{Vector, arm, arm_slopes, direction, dot, scaled, sum, turned};

/// Motion at one state: angles θ (rad), angular velocities ω (rad/s), accelerations α (rad/s²) and
/// virtual angular velocities λ.
#[derive(Clone, Copy)]
pub(super) struct Motion<'a, T> {
    pub(super) theta: &'a [T],
    pub(super) omega: &'a [T],
    pub(super) alpha: &'a [T],
    pub(super) lambda: &'a [T],
}

/// Virtual power at one state, with its derivatives.
pub(super) struct VirtualPower<'a, T> {
    pub(super) constants: &'a Constants<T>,
    pub(super) slopes: &'a ParameterSlopes<T>,
    pub(super) motion: Motion<'a, T>,
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

impl<'a, T: Scalar> VirtualPower<'a, T> {
    /// Number of vectors of memory that one link takes.
    pub(super) const VECTORS: usize = 5;

    /// Prepares the sum at a state. `memory` has two numbers for each of the vectors.
    pub(super) fn new(
        (constants, slopes): (&'a Constants<T>, &'a ParameterSlopes<T>),
        motion: Motion<'a, T>,
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
            constants,
            slopes,
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
    pub(super) fn add_links(&mut self, drive: Option<RootDrive<T>>) -> Vector<T> {
        let zero = T::from_f64(0.0);
        // `RootDrive` has the opposite of the pivot's acceleration.
        let [x, y] = drive.map_or([zero; 2], |drive| drive.pivot);
        let root = [-x, self.constants.gravity - y];
        for (index, link) in self.constants.links.iter().enumerate() {
            let (velocity, acceleration) = match link.numbers.parent {
                Some(parent) => self.at(parent, link.numbers.pivot),
                None => ([zero; 2], root),
            };
            self.velocities[index] = velocity;
            self.accelerations[index] = acceleration;
        }
        self.forces.fill([zero; 2]);
        self.momenta.fill([zero; 2]);
        for (index, link) in self.constants.links.iter().enumerate().rev() {
            self.add_link(index, link);
        }
        let pivot = self.momenta.first().copied().unwrap_or([zero; 2]);
        let [_, _, parameters] = &mut self.by;
        self.slopes.gravity.add(&[pivot[1]], parameters);
        pivot
    }

    /// Returns the virtual velocity and the acceleration of a point of a link, which is given by its
    /// components along the link and across it.
    fn at(&self, link: usize, point: [T; 2]) -> (Vector<T>, Vector<T>) {
        let Motion {
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
        let Motion {
            omega,
            alpha,
            lambda,
            ..
        } = self.motion;
        let (omega, axis) = (omega[link], self.axes[link]);
        // The power depends on the arm e as e·g; the transpose of J is −J.
        let turning = sum(scaled(lambda[link], force), scaled(alpha[link], momentum));
        let g = sum(
            scaled(-(omega * omega), momentum),
            scaled(T::from_f64(-1.0), turned(turning)),
        );
        let (by_angle, by_point) = arm_slopes(point, axis, g);
        let [by_theta, by_omega, _] = &mut self.by;
        by_theta[link] = by_theta[link] + by_angle;
        let twice = omega + omega;
        by_omega[link] = by_omega[link] - twice * dot(arm(point, axis), momentum);
        self.forces[link] = sum(self.forces[link], force);
        self.momenta[link] = sum(self.momenta[link], momentum);
        by_point
    }

    /// Adds the derivatives of the part of one link, whose children have been added before.
    fn add_link(&mut self, index: usize, link: &LinkConstants<T>) {
        let own = &link.numbers;
        let Motion { alpha, lambda, .. } = self.motion;
        let (velocity, acceleration) = self.at(index, own.com);
        let (force, momentum) = (scaled(-own.mass, acceleration), scaled(-own.mass, velocity));
        let mut by = own.map(|_| T::from_f64(0.0));
        by.mass = -dot(acceleration, velocity);
        by.inertia = -(alpha[index] * lambda[index]);
        by.com = self.add_point(index, own.com, force, momentum);
        if let Some(parent) = own.parent {
            by.pivot = self.add_point(parent, own.pivot, self.forces[index], self.momenta[index]);
        }
        let joint = self.add_spring(&link.joint, [Some(index), own.parent]);
        let ground = self.add_spring(&link.ground, [Some(index), None]);
        let passive = &mut by.passive;
        passive.friction = joint.friction;
        passive.spring = joint.spring;
        passive.rest = joint.rest;
        passive.drag = ground.friction;
        for (by, own) in passive.laws.iter_mut().zip([joint.law, ground.law]) {
            if let Some(own) = own {
                *by = scene::FrictionLaw::of_constants(own.into_constants());
            }
        }
        let [_, _, parameters] = &mut self.by;
        if let Some(slopes) = self.slopes.links.get(index) {
            slopes.add(&by.numbers(), parameters);
        }
    }

    /// Adds the derivatives of the springs and friction between links that are not parent and child.
    pub(super) fn add_springs(&mut self) {
        for (own, slopes) in self.constants.springs.iter().zip(&self.slopes.springs) {
            let by = self.add_spring(own, own.links.map(Some));
            let [_, _, parameters] = &mut self.by;
            slopes.add(&numbers_of_spring(&by), parameters);
        }
    }

    /// Adds the derivatives of a torsion spring and friction between two `links`, where `None` is the
    /// ground. Returns the derivatives by the constants.
    fn add_spring(&mut self, own: &SpringDamper<T>, links: [Option<usize>; 2]) -> SpringDamper<T> {
        let zero = T::from_f64(0.0);
        let Motion {
            theta,
            omega,
            lambda,
            ..
        } = self.motion;
        let [angle, rate, across] = [theta, omega, lambda].map(|values| {
            let [own, other] = links.map(|link| link.map_or(zero, |link| values[link]));
            own - other
        });
        let (law, slope) = match &own.law {
            Some(law) => {
                let (by, slope) = law_slopes(law, rate);
                (Some(by.map(|slope| -(across * slope))), slope)
            }
            None => (None, zero),
        };
        let [by_theta, by_omega, _] = &mut self.by;
        let by_angle = -(across * own.spring);
        let by_rate = -(across * (own.friction + slope));
        for (link, sign) in links.into_iter().zip([1.0, -1.0]) {
            if let Some(link) = link {
                let sign = T::from_f64(sign);
                by_theta[link] = by_theta[link] + sign * by_angle;
                by_omega[link] = by_omega[link] + sign * by_rate;
            }
        }
        SpringDamper {
            links: own.links,
            spring: -(across * (angle - own.rest)),
            rest: across * own.spring,
            friction: -(across * rate),
            law,
        }
    }
}

/// Returns the derivatives of the torque of a law of friction by its constants and by the rate.
fn law_slopes<T: Scalar>(law: &FrictionLaw<T>, rate: T) -> (FrictionLaw<T>, T) {
    let mut index = 0..=LAW_CONSTANTS;
    let mut variable = |value: T| {
        let index = index.next().unwrap_or(LAW_CONSTANTS);
        Dual::<T, { LAW_CONSTANTS + 1 }>::variable(value, index)
    };
    let varied = law.map(&mut variable);
    let [constants @ .., slope] = varied.torque(variable(rate)).tangents;
    (FrictionLaw::of_constants(constants), slope)
}
