//! Ways through a tree: in strips, and link by link.

use branched_pendulum::emitted::Simd;
use branched_pendulum::scalar::Scalar;
use branched_pendulum::system::{InRegisters, Workspace};
use branched_pendulum::tree::{LinkEquations, LinkStates, RootDrive, SmallTree, Tree};

use crate::equations::Form;
use crate::forms::{Acting, AtOneTime, OneOf};

/// Ways through a tree: in strips, for many states and large trees, and link by link, for
/// one state of a small one.
#[derive(Clone, Debug)]
pub(crate) struct Ways<E, T> {
    links: usize,
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
            links: parents.len(),
            strips: Tree::with_parents(parents, &rows, above),
            small: (parents.len() <= most(form)).then(|| SmallTree::new(parents, rows, above)),
        }
    }

    pub(crate) fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Ways<E, S> {
        Ways {
            links: self.links,
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

    /// Returns the number of links.
    pub(crate) fn links(&self) -> usize {
        self.links
    }

    /// Writes accelerations under what acts from outside, in the arithmetic of `T`, compiled for
    /// the instructions that the caller chooses, in a function that all callers share.
    #[inline(always)]
    pub(crate) fn evaluate_under(
        &self,
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
        self.strips.evaluate_apart(acting.drive, given, alpha);
    }

    /// Returns how many numbers [`in_registers`](Self::in_registers) takes room for.
    pub(crate) fn room(&self) -> usize {
        self.strips.room()
    }

    /// Returns the tree for registers of states at one time of a drive.
    #[inline(always)]
    pub(crate) fn in_registers<R: Simd<T>>(
        &self,
        drive: Option<RootDrive<T>>,
        room: &mut [T],
    ) -> impl InRegisters<R> {
        match self.has_one_driven_link(drive) {
            true => OneOf::First(AtOneTime {
                ways: self.cast(R::splat),
                drive: drive.map(|drive| drive.map(R::splat)),
            }),
            false => OneOf::Second(self.strips.in_registers(drive, room)),
        }
    }

    /// Returns true for a tree of one link with a drive, whose torque the equations know on
    /// links with children alone.
    #[inline(always)]
    fn has_one_driven_link(&self, drive: Option<RootDrive<T>>) -> bool {
        self.links == 1 && drive.is_some()
    }
}
