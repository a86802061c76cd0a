//! Forces that no energy knows: friction, the drive, torques from outside.

use alloc::vec::Vec;

use super::SymmetricTree;
use super::motion::TreeMotion;
use crate::scalar::Scalar;

/// What acts on a tree beside its springs and gravity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NonConservative<'a, T> {
    /// Friction in the pivots and against the ground.
    Friction,
    /// The drive at one time: the acceleration x, y (m/s²) of the root's pivot, y upwards, and
    /// the torque (N m) on the root.
    Drive([T; 3]),
    /// Torques from outside (N m), one for each link.
    Torques(&'a [T]),
}

/// Constants of friction and of the drive.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Passive<T> {
    /// Friction in the pivot and drag of each link; empty where there are none.
    pub(super) viscous: Vec<[T; 2]>,
    /// Laws of friction that is not viscous, likewise.
    pub(super) laws: Vec<[T; 5]>,
    /// First moments of mass about the pivots.
    pub(super) moments: Vec<[T; 2]>,
    /// True if y of the drive is against that of the equations.
    pub(super) stands: bool,
}

impl<T: Scalar> Passive<T> {
    pub(super) fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Passive<S> {
        Passive {
            viscous: self.viscous.iter().map(|row| row.map(&convert)).collect(),
            laws: self.laws.iter().map(|row| row.map(&convert)).collect(),
            moments: self.moments.iter().map(|row| row.map(&convert)).collect(),
            stands: self.stands,
        }
    }
}

impl<T: Scalar> SymmetricTree<T> {
    /// Adds generalized forces Q. NaN for torques of another number than there are links.
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
        for (link, law) in laws.iter().enumerate() {
            let &[coulomb, quadratic, width, drag, drag_width] = law;
            let (rate, own) = (relative(link), omega[link]);
            let speed = (rate * rate + width * width).sqrt();
            let own_speed = (own * own + drag_width * drag_width).sqrt();
            let joint = (coulomb / speed + quadratic * speed) * rate;
            brake(link, joint, drag * own_speed * own);
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
