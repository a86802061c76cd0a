//! Accelerations of a tree with prescribed links.

use super::small::LinkStates;
use super::states::{self, ActingOnStates};
use super::{LinkEquations, RootDrive, Tree};
use crate::scalar::{Scalar, at};
use crate::system::pendulum::put;
use crate::system::{PrescribedMotion, Workspace};

impl<E: LinkEquations, T: Scalar> Tree<E, T> {
    /// Number of input values per link: its torque or acceleration, the flag of a prescribed link,
    /// and, if torques act between links, the sum of all torques.
    const OUTSIDE: usize = if E::COUPLED { 3 } else { 2 };

    /// Writes the angular accelerations, and the torques that the prescribed links in `set` need,
    /// as
    /// [`Prescribed::accelerations_prescribed_with`](crate::Prescribed::accelerations_prescribed_with).
    /// NaN if there is no set, or if the equations do not allow prescribed links
    /// ([`LinkEquations::PRESCRIBED`]).
    pub fn accelerations_prescribed_with(
        &self,
        workspace: &mut Workspace<T>,
        drive: Option<RootDrive<T>>,
        set: Option<&[usize]>,
        motion: PrescribedMotion<'_, T>,
        [alpha, reactions]: [&mut [T]; 2],
    ) {
        let links = self.skeleton.plan.links();
        let Some(prescribed_links) = self.prescribed_links(set, &motion, [alpha, reactions]) else {
            alpha.fill(T::from_f64(f64::NAN));
            reactions.fill(T::from_f64(f64::NAN));
            return;
        };
        let (outside, workspace) = workspace.with_inner(Self::OUTSIDE * links);
        let (all, outside) = outside.split_at_mut((Self::OUTSIDE - 2) * links);
        let (given, prescribed) = outside.split_at_mut(links);
        if E::COUPLED {
            self.write_torques_fused(Some(motion.torques), [motion.theta, motion.omega], all);
        }
        let motion = Self::under_all(motion, all);
        write_inputs(prescribed_links, &motion, given, prescribed);
        let states = LinkStates {
            theta: motion.theta,
            omega: motion.omega,
            torques: Some(given),
        };
        self.accelerate_as_given(workspace, drive, states, Some(prescribed), alpha);
        write_reactions(prescribed_links, &motion, alpha, reactions);
    }

    /// Writes the accelerations, and the torques that the prescribed links need, computed in the
    /// arithmetic of `T`. Allocates, as [`evaluate_under`](Self::evaluate_under) does.
    #[inline(always)]
    pub fn evaluate_prescribed(
        &self,
        drive: Option<RootDrive<T>>,
        set: Option<&[usize]>,
        motion: PrescribedMotion<'_, T>,
        [alpha, reactions]: [&mut [T]; 2],
    ) {
        let zero = T::from_f64(0.0);
        let links = self.skeleton.plan.links();
        let Some(prescribed_links) = self.prescribed_links(set, &motion, [alpha, reactions]) else {
            alpha.fill(T::from_f64(f64::NAN));
            reactions.fill(T::from_f64(f64::NAN));
            return;
        };
        let mut outside = alloc::vec![zero; Self::OUTSIDE * links];
        let (all, outside) = outside.split_at_mut((Self::OUTSIDE - 2) * links);
        let (given, prescribed) = outside.split_at_mut(links);
        if E::COUPLED {
            self.write_torques(Some(motion.torques), [motion.theta, motion.omega], all);
        }
        let motion = Self::under_all(motion, all);
        write_inputs(prescribed_links, &motion, given, prescribed);
        let mut buffer = alloc::vec![zero; self.workspace_len()];
        let torques = &[];
        states::accelerations::<E, T, T>(
            &self.skeleton,
            ActingOnStates { drive, torques },
            &mut buffer,
            |link| at(motion.theta, link),
            |link| at(motion.omega, link),
            |link| [at(given, link), at(prescribed, link)],
            |link, value| put(alpha, link, value),
        );
        write_reactions(prescribed_links, &motion, alpha, reactions);
    }

    /// Writes the generalized torques (N m) that give the links the angular accelerations of a
    /// motion of angles, angular velocities and angular accelerations, in addition to the torques
    /// `acting`. NaN if a slice does not have one number per link, and if the equations do not
    /// allow prescribed links ([`LinkEquations::PRESCRIBED`]).
    pub fn inverse_dynamics_with(
        &self,
        workspace: &mut Workspace<T>,
        drive: Option<RootDrive<T>>,
        [theta, omega, alpha]: [&[T]; 3],
        acting: Option<&[T]>,
        torques: &mut [T],
    ) {
        let links = self.skeleton.plan.links();
        if !self.knows_motion([theta, omega, alpha, torques], acting) {
            torques.fill(T::from_f64(f64::NAN));
            return;
        }
        let (numbers, workspace) = workspace.with_inner(2 * links);
        let (all, prescribed) = numbers.split_at_mut(links);
        if E::COUPLED {
            self.write_torques_fused(acting, [theta, omega], all);
        }
        prescribed.fill(T::from_f64(1.0));
        let states = LinkStates {
            theta,
            omega,
            torques: Some(alpha),
        };
        self.accelerate_as_given(workspace, drive, states, Some(prescribed), torques);
        subtract(if E::COUPLED { Some(all) } else { acting }, torques);
    }

    /// Writes the torques of the inverse dynamics, computed in the arithmetic of `T`. Allocates, as
    /// [`evaluate_under`](Self::evaluate_under) does.
    #[inline(always)]
    pub fn evaluate_inverse_dynamics(
        &self,
        drive: Option<RootDrive<T>>,
        [theta, omega, alpha]: [&[T]; 3],
        acting: Option<&[T]>,
        torques: &mut [T],
    ) {
        let zero = T::from_f64(0.0);
        let links = self.skeleton.plan.links();
        if !self.knows_motion([theta, omega, alpha, torques], acting) {
            torques.fill(T::from_f64(f64::NAN));
            return;
        }
        let mut all = alloc::vec![zero; if E::COUPLED { links } else { 0 }];
        if E::COUPLED {
            self.write_torques(acting, [theta, omega], &mut all);
        }
        let mut buffer = alloc::vec![zero; self.workspace_len()];
        let prescribed = T::from_f64(1.0);
        states::accelerations::<E, T, T>(
            &self.skeleton,
            ActingOnStates {
                drive,
                torques: &[],
            },
            &mut buffer,
            |link| at(theta, link),
            |link| at(omega, link),
            |link| [at(alpha, link), prescribed],
            |link, value| put(torques, link, value),
        );
        subtract(if E::COUPLED { Some(&all) } else { acting }, torques);
    }

    /// Returns true if the equations allow prescribed links and all slices have one number per
    /// link.
    fn knows_motion(&self, slices: [&[T]; 4], acting: Option<&[T]>) -> bool {
        let links = self.skeleton.plan.links();
        E::PRESCRIBED
            && slices.map(<[T]>::len) == [links; 4]
            && acting.is_none_or(|acting| acting.len() == links)
    }

    /// Returns the motion with the sum of all torques in place of the external torques: `all` holds
    /// this sum if torques act between links.
    #[inline(always)]
    fn under_all<'a>(motion: PrescribedMotion<'a, T>, all: &'a [T]) -> PrescribedMotion<'a, T> {
        let torques = if E::COUPLED { all } else { motion.torques };
        PrescribedMotion { torques, ..motion }
    }

    /// Returns the indices of the prescribed links if there are any and all slices have the right
    /// lengths.
    fn prescribed_links<'s>(
        &self,
        set: Option<&'s [usize]>,
        motion: &PrescribedMotion<'_, T>,
        [alpha, reactions]: [&[T]; 2],
    ) -> Option<&'s [usize]> {
        let chosen = set?;
        let links = self.skeleton.plan.links();
        let PrescribedMotion {
            theta,
            omega,
            torques,
            prescribed,
        } = motion;
        let fit = [theta, omega, torques, alpha].map(<[T]>::len) == [links; 4]
            && [prescribed, reactions].map(<[T]>::len) == [chosen.len(); 2]
            && chosen.iter().all(|&link| link < links);
        (E::PRESCRIBED && fit).then_some(chosen)
    }
}

/// Subtracts torques that act already.
#[inline(always)]
fn subtract<T: Scalar>(acting: Option<&[T]>, torques: &mut [T]) {
    for (torque, acting) in torques.iter_mut().zip(acting.into_iter().flatten()) {
        *torque = *torque - *acting;
    }
}

/// Writes the input of each link: its torque, or the acceleration of a prescribed link, and the
/// flag 1 for prescribed links.
#[inline(always)]
fn write_inputs<T: Scalar>(
    links: &[usize],
    motion: &PrescribedMotion<'_, T>,
    given: &mut [T],
    prescribed: &mut [T],
) {
    given.copy_from_slice(motion.torques);
    prescribed.fill(T::from_f64(0.0));
    for (&link, &acceleration) in links.iter().zip(motion.prescribed) {
        put(given, link, acceleration);
        put(prescribed, link, T::from_f64(1.0));
    }
}

/// Writes the reactions (the torques that prescribed links need in addition to the external ones),
/// and replaces these links' torques in `alpha` by their accelerations.
#[inline(always)]
fn write_reactions<T: Scalar>(
    links: &[usize],
    motion: &PrescribedMotion<'_, T>,
    alpha: &mut [T],
    reactions: &mut [T],
) {
    let given = links.iter().zip(motion.prescribed).zip(reactions);
    for ((&link, &acceleration), reaction) in given {
        *reaction = at(alpha, link) - at(motion.torques, link);
        put(alpha, link, acceleration);
    }
}
