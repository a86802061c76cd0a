//! Forces that have no potential energy: friction, the drive, external torques.

use alloc::vec::Vec;

use super::SymmetricTree;
use super::motion::TreeMotion;
use crate::friction::FrictionLaw;
use crate::scalar::Scalar;

/// A force on a tree other than its springs and gravity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NonConservative<'a, T> {
    /// Friction in the pivots and against the ground.
    Friction,
    /// The drive at one time: the acceleration x, y (m/s²) of the root's pivot, with y upwards, and
    /// the torque (N m) on the root.
    Drive([T; 3]),
    /// External torques (N m), one per link.
    Torques(&'a [T]),
}

/// Constants of the friction and of the drive of a tree.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Passive<T> {
    /// Coefficients (N m s) of viscous friction in the pivot and of drag against the ground, for
    /// each link; empty if a tree has neither.
    pub(super) viscous: Vec<[T; 2]>,
    /// The two laws of non-viscous friction of each link, in its pivot and against the ground;
    /// empty if the tree has no such friction.
    pub(super) laws: Vec<[FrictionLaw<T>; 2]>,
    /// First moments of mass of the links about their pivots, in kg m.
    pub(super) moments: Vec<[T; 2]>,
    /// True if the y axis of the drive is opposite to that of the equations.
    pub(super) stands: bool,
}

impl<T: Scalar> Passive<T> {
    pub(super) fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Passive<S> {
        let laws = self.laws.iter();
        Passive {
            viscous: self.viscous.iter().map(|row| row.map(&convert)).collect(),
            laws: laws.map(|row| row.map(|law| law.map(&convert))).collect(),
            moments: self.moments.iter().map(|row| row.map(&convert)).collect(),
            stands: self.stands,
        }
    }
}

impl<T: Scalar> SymmetricTree<T> {
    /// Adds the generalized forces (N m) on the links to `q`. NaN if the number of torques is not
    /// the number of links.
    pub(super) fn add_forces(
        &self,
        acting: NonConservative<'_, T>,
        motion: &TreeMotion<'_, T>,
        q: &mut [T],
    ) {
        match acting {
            NonConservative::Friction => self.add_friction(motion.omega, q),
            NonConservative::Drive(drive) => self.add_drive(drive, motion, q),
            NonConservative::Torques(torques) if torques.len() == q.len() => {
                for (q, &torque) in q.iter_mut().zip(torques) {
                    *q = *q + torque;
                }
            }
            NonConservative::Torques(_) => q.fill(T::from_f64(f64::NAN)),
        }
    }

    fn add_friction(&self, omega: &[T], q: &mut [T]) {
        let Passive { viscous, laws, .. } = &self.passive;
        let relative = |link: usize| match self.shape.parents[link] {
            Some(parent) => omega[link] - omega[parent],
            None => omega[link],
        };
        let mut brake = |link: usize, joint: T, ground: T| {
            q[link] = q[link] - (joint + ground);
            if let Some(parent) = self.shape.parents[link] {
                q[parent] = q[parent] + joint;
            }
        };
        for (link, &[friction, drag]) in viscous.iter().enumerate() {
            brake(link, friction * relative(link), drag * omega[link]);
        }
        for (link, [joint, ground]) in laws.iter().enumerate() {
            brake(
                link,
                joint.torque(relative(link)),
                ground.torque(omega[link]),
            );
        }
        if !self.spring_dampers.is_empty() {
            self.spring_dampers.add_friction(omega, q);
        }
    }

    fn add_drive(&self, [x, y, torque]: [T; 3], motion: &TreeMotion<'_, T>, q: &mut [T]) {
        let Passive {
            moments, stands, ..
        } = &self.passive;
        let y = if *stands { -y } else { y };
        for (link, &[along, across]) in moments.iter().enumerate() {
            let (sine, cosine) = (motion.sines[link], motion.cosines[link]);
            let sideways = along * cosine - across * sine;
            let upwards = along * sine + across * cosine;
            q[link] = q[link] - (x * sideways + y * upwards);
        }
        if let Some(root) = q.first_mut() {
            *root = *root + torque;
        }
    }
}
