//! Accelerations of trees with springs and friction between links that are not parent and child,
//! and to the ground.
//!
//! These torques depend only on angles and velocities. They are computed before the recursion for
//! the accelerations, which treats them as external torques.

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
    /// Adds springs and friction between links that are not parent and child. The tree's equations
    /// must allow them ([`LinkEquations::COUPLED`]). If they are made for another number of links,
    /// all accelerations are NaN.
    #[must_use]
    pub fn with_spring_dampers(mut self, spring_dampers: SpringDampers<T>) -> Self {
        const { assert!(E::COUPLED && E::FORCED) };
        self.spring_dampers = spring_dampers;
        self
    }

    /// Returns the springs and friction between links that are not parent and child.
    #[must_use]
    pub fn spring_dampers(&self) -> &SpringDampers<T> {
        &self.spring_dampers
    }

    /// Adds springs and dampers that act along lines between points. The tree's equations must
    /// allow them ([`LinkEquations::COUPLED`]). Energy budgets by scale do not include them.
    #[must_use]
    pub fn with_translational_spring_dampers(
        mut self,
        translational: TranslationalSpringDampers<T>,
    ) -> Self {
        const { assert!(E::COUPLED && E::FORCED) };
        self.translational = translational;
        self
    }

    /// Returns the springs and dampers along lines between points of links, and to the ground.
    #[must_use]
    pub fn translational_spring_dampers(&self) -> &TranslationalSpringDampers<T> {
        &self.translational
    }

    /// Returns true if springs or dampers act along lines. Also returns true if they are made for
    /// another number of links, which makes the accelerations NaN.
    #[inline(always)]
    fn has_lines(&self) -> bool {
        !self.translational.is_empty_on(self.skeleton.plan.links())
    }

    /// Writes the sum of all torques on the links: the `outside` torques (if any), and the torques
    /// of springs and friction between links. Forces along lines are computed in the arithmetic of
    /// `T`.
    #[inline(always)]
    pub(super) fn write_torques(&self, outside: Option<&[T]>, given: [&[T]; 2], torques: &mut [T]) {
        self.spring_dampers.write_torques(outside, given, torques);
        if self.has_lines() {
            self.translational.add_torques(given, torques);
        }
    }

    /// Writes the sum of all torques on the links. Forces along lines are computed with fused
    /// multiply–add if the machine has it, as they are for many states in registers.
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

    /// Writes the accelerations under all torques, including those of springs and friction between
    /// links.
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

    /// Writes the accelerations if the external torques already include the torques of springs and
    /// friction between links.
    pub(super) fn accelerate_as_given(
        &self,
        workspace: &mut Workspace<T>,
        drive: Option<RootDrive<T>>,
        given: LinkStates<'_, T>,
        prescribed: Option<&[T]>,
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
            prescribed,
            alpha,
            workspace,
        );
    }

    /// Writes the accelerations of several states, one in each lane of `V`, under all torques.
    /// Writes nothing if the workspace is too small.
    #[inline(always)]
    pub(super) fn accelerate_states<V: Simd<T>>(
        &self,
        drive: Option<RootDrive<V>>,
        mut buffer: &mut [V],
        theta: impl Fn(usize) -> V,
        omega: impl Fn(usize) -> V,
        outside: impl Fn(usize) -> [V; 2],
        alpha: impl FnMut(usize, V),
    ) {
        let mut torques: &[V] = &[];
        if E::COUPLED {
            let all = take(&mut buffer, self.skeleton.plan.links());
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
        states::accelerations::<E, T, V>(tree, acting, buffer, theta, omega, outside, alpha);
    }
}

/// Operation that adds the torques of the forces along lines, computed in numbers of one lane.
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
            // Only numbers of several lanes reach this; none is used here.
            _ => self.lines.add_torques(self.given, self.torques),
        }
    }
}
