//! Accelerations with springs and friction between links that are not parent and child, and to the
//! ground.
//!
//! Angles and rates give their torques before the recursion, which takes them and those from
//! outside alike.

use super::evaluate::{InBlocks, InOnePiece};
use super::memory::take;
use super::small::LinkStates;
use super::states::{self, ActingOnStates};
use super::{LinkEquations, RootDrive, Tree, sweep};
use crate::scalar::kind::compiled;
use crate::scalar::{Scalar, at};
use crate::simd::dispatch::in_fused_numbers;
use crate::simd::{Kernel, Simd, one_slice, one_slice_mut};
use crate::spring_dampers::SpringDampers;
use crate::system::Workspace;
use crate::translational::TranslationalSpringDampers;

impl<E: LinkEquations, T: Scalar> Tree<E, T> {
    /// Returns the tree with springs and friction between its links, whose equations say that
    /// there are some ([`LinkEquations::COUPLED`]). All accelerations are NaN with those of a
    /// tree of another number of links.
    #[must_use]
    pub fn with_spring_dampers(mut self, spring_dampers: SpringDampers<T>) -> Self {
        const { assert!(E::COUPLED && E::FORCED) };
        self.spring_dampers = spring_dampers;
        self
    }

    /// Returns what acts between links that are not parent and child.
    #[must_use]
    pub fn spring_dampers(&self) -> &SpringDampers<T> {
        &self.spring_dampers
    }

    /// Returns the tree with springs and dampers along lines between points, likewise. Budgets by
    /// scale know none of them.
    #[must_use]
    pub fn with_translational_spring_dampers(
        mut self,
        translational: TranslationalSpringDampers<T>,
    ) -> Self {
        const { assert!(E::COUPLED && E::FORCED) };
        self.translational = translational;
        self
    }

    /// Returns what acts along lines between points of links, and to the ground.
    #[must_use]
    pub fn translational_spring_dampers(&self) -> &TranslationalSpringDampers<T> {
        &self.translational
    }

    /// Returns true if something acts along lines; also if that is of another number of links, which
    /// makes the accelerations NaN.
    #[inline(always)]
    fn has_lines(&self) -> bool {
        !self.translational.is_empty_on(self.skeleton.plan.links())
    }

    /// Writes all torques on the links: those from `outside`, where there are any, and those
    /// between links, with lines in the arithmetic of `T`.
    #[inline(always)]
    pub(super) fn write_torques(&self, outside: Option<&[T]>, given: [&[T]; 2], torques: &mut [T]) {
        self.spring_dampers.write_torques(outside, given, torques);
        if self.has_lines() {
            self.translational.add_torques(given, torques);
        }
    }

    /// Writes them with lines in fused arithmetic where the machine has it, as registers of states
    /// have them.
    pub(super) fn write_torques_fused(
        &self,
        outside: Option<&[T]>,
        given: [&[T]; 2],
        torques: &mut [T],
    ) {
        self.spring_dampers.write_torques(outside, given, torques);
        if self.has_lines() {
            in_fused_numbers(LineTorques {
                lines: &self.translational,
                given,
                torques,
            });
        }
    }

    /// Writes the accelerations under all that acts.
    pub(super) fn accelerate(
        &self,
        workspace: &mut Workspace<T>,
        drive: Option<RootDrive<T>>,
        given: LinkStates<'_, T>,
        alpha: &mut [T],
    ) {
        if !E::COUPLED {
            return self.accelerate_as_given(workspace, drive, given, None, alpha);
        }
        let LinkStates {
            theta,
            omega,
            torques: outside,
        } = given;
        let (torques, workspace) = workspace.with_inner(self.skeleton.plan.links());
        self.write_torques_fused(outside, [theta, omega], torques);
        let torques = Some(&*torques);
        let given = LinkStates { torques, ..given };
        self.accelerate_as_given(workspace, drive, given, None, alpha);
    }

    /// Writes the accelerations where what acts between links is among the torques from
    /// outside.
    pub(super) fn accelerate_as_given(
        &self,
        workspace: &mut Workspace<T>,
        drive: Option<RootDrive<T>>,
        given: LinkStates<'_, T>,
        held: Option<&[T]>,
        alpha: &mut [T],
    ) {
        let accelerate = match Self::IN_BLOCKS {
            true => compiled::<InBlocks, T>(),
            false => compiled::<InOnePiece, T>(),
        };
        accelerate(
            &self.skeleton,
            sweep::sweep::<E, T>,
            drive,
            given,
            held,
            alpha,
            workspace,
        );
    }

    /// Hands over the accelerations of states in the lanes of `V` under all that acts; of none where
    /// the room is too small.
    #[inline(always)]
    pub(super) fn accelerate_states<V: Simd<T>>(
        &self,
        drive: Option<RootDrive<V>>,
        mut room: &mut [V],
        theta: impl Fn(usize) -> V,
        omega: impl Fn(usize) -> V,
        outside: impl Fn(usize) -> [V; 2],
        alpha: impl FnMut(usize, V),
    ) {
        let mut torques: &[V] = &[];
        if E::COUPLED {
            let all = take(&mut room, self.skeleton.plan.links());
            for (link, torque) in all.iter_mut().enumerate() {
                [*torque, _] = outside(link);
            }
            self.spring_dampers
                .add_torques_in_registers(&theta, &omega, all);
            if self.has_lines() {
                self.translational
                    .add_torques_in_registers(&theta, &omega, all);
            }
            torques = all;
        }
        let acting = ActingOnStates { drive, torques };
        let tree = &self.skeleton;
        states::accelerations::<E, T, V>(tree, acting, room, theta, omega, outside, alpha);
    }
}

/// The torques by what acts along lines, added in numbers of one lane.
struct LineTorques<'a, T> {
    lines: &'a TranslationalSpringDampers<T>,
    given: [&'a [T]; 2],
    torques: &'a mut [T],
}

impl<T: Scalar> Kernel<T> for LineTorques<'_, T> {
    type Output = ();

    #[inline(always)]
    fn run<V: Simd<T>>(self) {
        let [theta, omega] = self.given.map(one_slice::<T, V>);
        let torques = one_slice_mut::<T, V>(self.torques);
        match (theta, omega, torques) {
            (Some(theta), Some(omega), Some(torques)) => self.lines.add_torques_in_registers(
                |link| at(theta, link),
                |link| at(omega, link),
                torques,
            ),
            // Numbers of more than one lane, which none here is.
            _ => self.lines.add_torques(self.given, self.torques),
        }
    }
}
