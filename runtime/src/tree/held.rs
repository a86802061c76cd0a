//! Accelerations of a tree of which some links have given ones.

use super::small::LinkStates;
use super::states::{self, ActingOnStates};
use super::{LinkEquations, RootDrive, Tree};
use crate::scalar::{Scalar, at};
use crate::system::pendulum::put;
use crate::system::{PrescribedMotion, Workspace};

impl<E: LinkEquations, T: Scalar> Tree<E, T> {
    /// Numbers of a link: what is given of it, whether it is held, and where torques act between
    /// links all of these.
    const OUTSIDE: usize = if E::COUPLED { 3 } else { 2 };

    /// Writes the angular accelerations and reactions where those of the links `set` are
    /// given, as
    /// [`Prescribed::accelerations_prescribed_with`](crate::Prescribed::accelerations_prescribed_with):
    /// NaN without a set, and for equations that know no held links
    /// ([`LinkEquations::HELD`]).
    pub fn accelerations_prescribed_with(
        &self,
        workspace: &mut Workspace<T>,
        drive: Option<RootDrive<T>>,
        set: Option<&[usize]>,
        motion: PrescribedMotion<'_, T>,
        [alpha, reactions]: [&mut [T]; 2],
    ) {
        let links = self.skeleton.plan.links();
        let Some(held_links) = self.held_links(set, &motion, [alpha, reactions]) else {
            alpha.fill(T::from_f64(f64::NAN));
            reactions.fill(T::from_f64(f64::NAN));
            return;
        };
        let (outside, workspace) = workspace.with_inner(Self::OUTSIDE * links);
        let (all, outside) = outside.split_at_mut((Self::OUTSIDE - 2) * links);
        let (given, held) = outside.split_at_mut(links);
        if E::COUPLED {
            self.write_torques_fused(Some(motion.torques), [motion.theta, motion.omega], all);
        }
        let motion = Self::under_all(motion, all);
        hold(held_links, &motion, given, held);
        let states = LinkStates {
            theta: motion.theta,
            omega: motion.omega,
            torques: Some(given),
        };
        self.accelerate_as_given(workspace, drive, states, Some(held), alpha);
        tell(held_links, &motion, alpha, reactions);
    }

    /// Writes them in the arithmetic of `T`, as [`evaluate_under`](Self::evaluate_under).
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
        let Some(held_links) = self.held_links(set, &motion, [alpha, reactions]) else {
            alpha.fill(T::from_f64(f64::NAN));
            reactions.fill(T::from_f64(f64::NAN));
            return;
        };
        let mut outside = alloc::vec![zero; Self::OUTSIDE * links];
        let (all, outside) = outside.split_at_mut((Self::OUTSIDE - 2) * links);
        let (given, held) = outside.split_at_mut(links);
        if E::COUPLED {
            self.write_torques(Some(motion.torques), [motion.theta, motion.omega], all);
        }
        let motion = Self::under_all(motion, all);
        hold(held_links, &motion, given, held);
        let mut room = alloc::vec![zero; self.room()];
        let torques = &[];
        states::accelerations::<E, T, T>(
            &self.skeleton,
            ActingOnStates { drive, torques },
            &mut room,
            |link| at(motion.theta, link),
            |link| at(motion.omega, link),
            |link| [at(given, link), at(held, link)],
            |link, value| put(alpha, link, value),
        );
        tell(held_links, &motion, alpha, reactions);
    }

    /// Returns the motion under all that acts, where torques act between links: then these and
    /// those from outside are in `all`.
    #[inline(always)]
    fn under_all<'a>(motion: PrescribedMotion<'a, T>, all: &'a [T]) -> PrescribedMotion<'a, T> {
        let torques = if E::COUPLED { all } else { motion.torques };
        PrescribedMotion { torques, ..motion }
    }

    /// Returns the links of a set, of which there are some, if all lengths fit.
    fn held_links<'s>(
        &self,
        set: Option<&'s [usize]>,
        motion: &PrescribedMotion<'_, T>,
        [alpha, reactions]: [&[T]; 2],
    ) -> Option<&'s [usize]> {
        let held = set?;
        let links = self.skeleton.plan.links();
        let PrescribedMotion {
            theta,
            omega,
            torques,
            prescribed,
        } = motion;
        let fit = [theta, omega, torques, alpha].map(<[T]>::len) == [links; 4]
            && [prescribed, reactions].map(<[T]>::len) == [held.len(); 2]
            && held.iter().all(|&link| link < links);
        (E::HELD && fit).then_some(held)
    }
}

/// Writes what is given of each link, its torque or its acceleration, and 1 for those that
/// are held.
#[inline(always)]
fn hold<T: Scalar>(
    links: &[usize],
    motion: &PrescribedMotion<'_, T>,
    given: &mut [T],
    held: &mut [T],
) {
    given.copy_from_slice(motion.torques);
    held.fill(T::from_f64(0.0));
    for (&link, &acceleration) in links.iter().zip(motion.prescribed) {
        put(given, link, acceleration);
        put(held, link, T::from_f64(1.0));
    }
}

/// Writes the reactions, the torques beyond those from outside that held links take, and
/// their accelerations where the whole torques were told.
#[inline(always)]
fn tell<T: Scalar>(
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
