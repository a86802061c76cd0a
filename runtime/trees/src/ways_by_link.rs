//! The way through a tree link by link, for builds without strips.

use branched_pendulum::scalar::Scalar;
use branched_pendulum::system::Workspace;
use branched_pendulum::tree::{LinkEquations, LinkStates, SmallTree};

use crate::forms::Acting;
use crate::rows::Form;

/// A tree of any size, link by link.
#[derive(Clone, Debug)]
pub(crate) struct Ways<E, T>(SmallTree<E, T>);

impl<E: LinkEquations, T: Scalar> Ways<E, T> {
    pub(crate) fn new(_: Form, parents: &[u32], rows: Vec<T>, gravity: T) -> Self {
        Self(SmallTree::new(parents, rows, [T::from_f64(0.0), gravity]))
    }

    pub(crate) fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Ways<E, S> {
        Ways(self.0.cast(convert))
    }

    /// Writes the accelerations at angles and angular velocities.
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
        let Self(tree) = self;
        tree.accelerations_with(workspace, acting.drive, states, alpha);
    }

    /// Does so in the arithmetic of `T`.
    #[inline(always)]
    pub(crate) fn evaluate(&self, acting: Acting<'_, T>, given: [&[T]; 2], alpha: &mut [T]) {
        self.accelerate(&mut Workspace::new(), acting, given, alpha);
    }
}
