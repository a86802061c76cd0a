//! Evaluates the equations of a tree link by link, for builds without strips (links that are
//! computed together).

use branched_pendulum::emitted::Simd;
use branched_pendulum::scalar::Scalar;
use branched_pendulum::system::{InRegisters, Workspace};
use branched_pendulum::tree::{LinkEquations, LinkStates, RootDrive, SmallTree};

use crate::equations::Form;
use crate::forms::{Acting, AtOneTime};

/// A tree of any size, evaluated link by link.
#[derive(Clone, Debug)]
pub(crate) struct TreeEvaluator<E, T> {
    links: usize,
    tree: SmallTree<E, T>,
}

impl<E: LinkEquations, T: Scalar> TreeEvaluator<E, T> {
    pub(crate) fn new(_: Form, parents: &[u32], rows: Vec<T>, gravity: T) -> Self {
        Self {
            links: parents.len(),
            tree: SmallTree::new(parents, rows, [T::from_f64(0.0), gravity]),
        }
    }

    pub(crate) fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> TreeEvaluator<E, S> {
        TreeEvaluator {
            links: self.links,
            tree: self.tree.cast(convert),
        }
    }

    /// Writes the accelerations (rad/s²) at given angles and angular velocities.
    #[inline(always)]
    pub(crate) fn accelerate(
        &self,
        workspace: &mut Workspace<T>,
        acting: Acting<'_, T>,
        [theta, omega]: [&[T]; 2],
        alpha: &mut [T],
    ) {
        let mut sum = [T::from_f64(0.0)];
        let torques = acting.on_links(theta.len(), &mut sum);
        let states = LinkStates {
            theta,
            omega,
            torques,
        };
        self.tree
            .accelerations_with(workspace, acting.drive, states, alpha);
    }

    /// Returns the number of links.
    pub(crate) fn links(&self) -> usize {
        self.links
    }

    /// Writes accelerations under external actions, in the arithmetic of `T`.
    #[inline(always)]
    pub(crate) fn evaluate_with(
        &self,
        workspace: &mut Workspace<T>,
        acting: Acting<'_, T>,
        [theta, omega]: [&[T]; 2],
        alpha: &mut [T],
    ) {
        let mut sum = [T::from_f64(0.0)];
        let torques = acting.on_links(theta.len(), &mut sum);
        let given = LinkStates {
            theta,
            omega,
            torques,
        };
        self.tree
            .evaluate_apart(workspace, acting.drive, given, alpha);
    }

    /// Returns the length of the buffer that [`in_registers`](Self::in_registers) needs.
    pub(crate) fn workspace_len(&self) -> usize {
        0
    }

    /// Returns the tree for the evaluation of several states at once in vector registers, at one
    /// time of a drive.
    #[inline(always)]
    pub(crate) fn in_registers<R: Simd<T>>(
        &self,
        drive: Option<RootDrive<T>>,
        _: &mut [T],
    ) -> impl InRegisters<R> {
        AtOneTime {
            evaluator: self.cast(R::splat),
            drive: drive.map(|drive| drive.map(R::splat)),
            workspace: Workspace::new(),
        }
    }
}
