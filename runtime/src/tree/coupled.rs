//! Accelerations with springs and friction between links that are not parent and child.
//!
//! Angles and rates give their torques before the recursion, which takes them and those from
//! outside alike.

use super::evaluate::{InBlocks, InOnePiece};
use super::memory::take;
use super::small::LinkStates;
use super::states::{self, ActingOnStates};
use super::{LinkEquations, RootDrive, Tree, sweep};
use crate::scalar::Scalar;
use crate::scalar::kind::compiled;
use crate::simd::Simd;
use crate::spring_dampers::SpringDampers;
use crate::system::Workspace;

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
        self.spring_dampers
            .write_torques(outside, [theta, omega], torques);
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
            torques = all;
        }
        let acting = ActingOnStates { drive, torques };
        let tree = &self.skeleton;
        states::accelerations::<E, T, V>(tree, acting, room, theta, omega, outside, alpha);
    }
}
