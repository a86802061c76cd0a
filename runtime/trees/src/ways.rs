//! Ways through a tree: in strips, and link by link.

use branched_pendulum::scalar::Scalar;
use branched_pendulum::system::Workspace;
use branched_pendulum::tree::{LinkEquations, LinkStates, SmallTree, Tree};

use crate::forms::Acting;
use crate::rows::Form;

/// Ways through a tree: in strips, for many states and large trees, and link by link, for
/// one state of a small one.
#[derive(Clone, Debug)]
pub(crate) struct Ways<E, T> {
    strips: Tree<E, T>,
    small: Option<SmallTree<E, T>>,
}

/// Returns the most links that are computed one by one: from there on strips are faster
/// (`costs_of_one_state` in the tests).
fn most(form: Form) -> usize {
    match form {
        Form::Straight => 40,
        Form::General | Form::Rough => 20,
    }
}

impl<E: LinkEquations, T: Scalar> Ways<E, T> {
    pub(crate) fn new(form: Form, parents: &[u32], rows: Vec<T>, gravity: T) -> Self {
        let above = [T::from_f64(0.0), gravity];
        Self {
            strips: Tree::with_parents(parents, &rows, above),
            small: (parents.len() <= most(form)).then(|| SmallTree::new(parents, rows, above)),
        }
    }

    pub(crate) fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Ways<E, S> {
        Ways {
            strips: self.strips.cast(&convert),
            small: self.small.as_ref().map(|small| small.cast(&convert)),
        }
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
        let drive = acting.drive;
        if let Some(small) = &self.small {
            let states = LinkStates {
                theta,
                omega,
                torques,
            };
            return small.accelerations_with(workspace, drive, states, alpha);
        }
        let tree = &self.strips;
        match torques {
            None => tree.accelerations_with(workspace, drive, theta, omega, alpha),
            Some(torques) => {
                let given = [theta, omega, torques];
                tree.accelerations_under_with(workspace, drive, given, alpha);
            }
        }
    }

    /// Does so in the arithmetic of `T`, compiled for the instructions that the caller
    /// chooses.
    #[inline(always)]
    pub(crate) fn evaluate(
        &self,
        acting: Acting<'_, T>,
        [theta, omega]: [&[T]; 2],
        alpha: &mut [T],
    ) {
        let mut sum = [T::from_f64(0.0)];
        let torques = acting.on_links(theta.len(), &mut sum);
        match torques {
            None => {
                let at = |numbers: &[T], link: usize| match numbers.get(link) {
                    Some(&number) => number,
                    None => T::from_f64(f64::NAN),
                };
                self.strips.evaluate(
                    acting.drive,
                    |link| at(theta, link),
                    |link| at(omega, link),
                    |link, value| {
                        if let Some(alpha) = alpha.get_mut(link) {
                            *alpha = value;
                        }
                    },
                );
            }
            Some(torques) => {
                let given = [theta, omega, torques];
                self.strips.evaluate_under(acting.drive, given, alpha);
            }
        }
    }
}
