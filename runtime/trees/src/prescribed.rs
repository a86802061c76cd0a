//! Trees with links whose motion is prescribed.

use std::sync::Arc;

use branched_pendulum::emitted::no_answer;
use branched_pendulum::scalar::Scalar;
use branched_pendulum::system::functions::{AccelerationsOfHeldLinks, InverseDynamics};
use branched_pendulum::system::{At, Computes, Prescribed, PrescribedMotion, Workspace};
use branched_pendulum::tree::{RootDrive, Tree};
use branched_pendulum_codegen::scene::Scene;

use crate::equations::PrescribedEquations;
use crate::tree::PendulumTree;

/// Equations of a tree in which the motion of some links can be prescribed, and the indices of
/// these links.
#[derive(Clone, Debug)]
pub(crate) struct PrescribedLinks<T> {
    sets: Arc<[Vec<usize>]>,
    tree: Tree<PrescribedEquations, T>,
}

impl<T: Scalar> PrescribedLinks<T> {
    pub(crate) fn of(scene: &Scene, parents: &[u32], gravity: T, rows: &[T]) -> Self {
        let sets = scene.prescribed.iter();
        let sets = sets.map(|set| set.links.iter().map(|link| link.0).collect());
        Self {
            sets: sets.collect(),
            tree: Tree::with_parents(parents, rows, [T::from_f64(0.0), gravity]),
        }
    }

    pub(crate) fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> PrescribedLinks<S> {
        PrescribedLinks {
            sets: Arc::clone(&self.sets),
            tree: self.tree.cast(convert),
        }
    }
}

impl<T: Scalar> Prescribed<T> for PendulumTree<T> {
    fn prescribed_links(&self, set: usize) -> Option<&[usize]> {
        self.prescribed.sets.get(set).map(Vec::as_slice)
    }
}

impl<T: Scalar> Computes<AccelerationsOfHeldLinks, T> for PendulumTree<T> {
    type On<S: Scalar> = PendulumTree<S>;

    fn on<S: Scalar>(&self, convert: impl Fn(T) -> S) -> PendulumTree<S> {
        self.on_scalar(&convert)
    }

    #[inline(always)]
    fn compute(&self, at: At<T>, given: &[&[T]], results: &mut [&mut [T]]) {
        self.with_arguments(at, given, results, |tree, drive, links, motion, results| {
            tree.evaluate_prescribed(drive, links, motion, results);
        });
    }

    fn compute_with(
        &self,
        workspace: &mut Workspace<T>,
        at: At<T>,
        given: &[&[T]],
        results: &mut [&mut [T]],
    ) {
        self.with_arguments(at, given, results, |tree, drive, links, motion, results| {
            tree.accelerations_prescribed_with(workspace, drive, links, motion, results);
        });
    }
}

impl<T: Scalar> PendulumTree<T> {
    /// Calls `compute` with the arguments that the equations with prescribed links take.
    #[inline(always)]
    fn with_arguments(
        &self,
        at: At<T>,
        given: &[&[T]],
        results: &mut [&mut [T]],
        compute: impl FnOnce(
            &Tree<PrescribedEquations, T>,
            Option<RootDrive<T>>,
            Option<&[usize]>,
            PrescribedMotion<'_, T>,
            [&mut [T]; 2],
        ),
    ) {
        let (Some(motion), [alpha, reactions]) = (PrescribedMotion::of(given), &mut *results)
        else {
            return no_answer(results);
        };
        let outside = self.acting(at.time, Some(motion.torques));
        let (given, mut numbers) = ([motion.theta, motion.omega], Vec::new());
        let acting = self.equations.all_acting(outside, given, &mut numbers);
        let mut sum = [T::from_f64(0.0)];
        let torques = acting.on_links(motion.torques.len(), &mut sum);
        let torques = torques.unwrap_or_default();
        let motion = PrescribedMotion { torques, ..motion };
        let links = self.prescribed.sets.get(at.index).map(Vec::as_slice);
        compute(
            &self.prescribed.tree,
            acting.drive,
            links,
            motion,
            [alpha, reactions],
        );
    }
}

impl<T: Scalar> Computes<InverseDynamics, T> for PendulumTree<T> {
    type On<S: Scalar> = PendulumTree<S>;

    fn on<S: Scalar>(&self, convert: impl Fn(T) -> S) -> PendulumTree<S> {
        self.on_scalar(&convert)
    }

    #[inline(always)]
    fn compute(&self, at: At<T>, given: &[&[T]], results: &mut [&mut [T]]) {
        self.move_as_given(
            at,
            given,
            results,
            |tree, drive, motion, acting, torques| {
                tree.evaluate_inverse_dynamics(drive, motion, acting, torques);
            },
        );
    }

    fn compute_with(
        &self,
        workspace: &mut Workspace<T>,
        at: At<T>,
        given: &[&[T]],
        results: &mut [&mut [T]],
    ) {
        self.move_as_given(
            at,
            given,
            results,
            |tree, drive, motion, acting, torques| {
                tree.inverse_dynamics_with(workspace, drive, motion, acting, torques);
            },
        );
    }
}

impl<T: Scalar> PendulumTree<T> {
    /// Calls `compute` with the arguments from which the torques of a given motion are computed
    /// (inverse dynamics).
    #[inline(always)]
    fn move_as_given(
        &self,
        at: At<T>,
        given: &[&[T]],
        results: &mut [&mut [T]],
        compute: impl FnOnce(
            &Tree<PrescribedEquations, T>,
            Option<RootDrive<T>>,
            [&[T]; 3],
            Option<&[T]>,
            &mut [T],
        ),
    ) {
        let (&[theta, omega, alpha], [torques]) = (given, &mut *results) else {
            return no_answer(results);
        };
        let (outside, mut numbers) = (self.acting(at.time, None), Vec::new());
        let acting = self
            .equations
            .all_acting(outside, [theta, omega], &mut numbers);
        let mut sum = [T::from_f64(0.0)];
        let on_links = acting.on_links(theta.len(), &mut sum);
        let motion = [theta, omega, alpha];
        compute(
            &self.prescribed.tree,
            acting.drive,
            motion,
            on_links,
            torques,
        );
    }
}
