//! Evaluates the equations of a tree: by strips (links that are computed together), or link by
//! link.

use branched_pendulum::emitted::Simd;
use branched_pendulum::scalar::Scalar;
use branched_pendulum::system::{InRegisters, Workspace};
use branched_pendulum::tree::{LinkEquations, LinkStates, RootDrive, SmallTree, Tree};

use crate::equations::Form;
use crate::forms::{Acting, AtOneTime, OneOf};

/// A tree arranged for evaluation in two ways: by strips (links that are computed together), for
/// many states and large trees; and link by link, for one state of a small tree.
#[derive(Clone, Debug)]
pub(crate) struct TreeEvaluator<E, T> {
    links: usize,
    strips: Tree<E, T>,
    small: Option<SmallTree<E, T>>,
}

/// Returns the largest number of links up to which a tree is computed link by link; for larger
/// trees strips are faster (`costs_of_one_state` in the tests).
fn most(form: Form) -> usize {
    match form {
        Form::Plain => 40,
        Form::General | Form::NonViscous => 20,
    }
}

impl<E: LinkEquations, T: Scalar> TreeEvaluator<E, T> {
    pub(crate) fn new(form: Form, parents: &[u32], rows: Vec<T>, gravity: T) -> Self {
        let above = [T::from_f64(0.0), gravity];
        Self {
            links: parents.len(),
            strips: Tree::with_parents(parents, &rows, above),
            small: (parents.len() <= most(form)).then(|| SmallTree::new(parents, rows, above)),
        }
    }

    pub(crate) fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> TreeEvaluator<E, S> {
        TreeEvaluator {
            links: self.links,
            strips: self.strips.cast(&convert),
            small: self.small.as_ref().map(|small| small.cast(&convert)),
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

    /// Writes accelerations under external actions, in the arithmetic of `T`. The function is
    /// shared by all callers, and is compiled for the instruction set that the caller chooses.
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
        match &self.small {
            Some(small) => small.evaluate_apart(workspace, acting.drive, given, alpha),
            None => {
                let tree = &self.strips;
                tree.evaluate_apart(workspace, acting.drive, given, alpha);
            }
        }
    }

    /// Returns the length of the buffer that [`in_registers`](Self::in_registers) needs.
    pub(crate) fn workspace_len(&self) -> usize {
        self.strips.workspace_len()
    }

    /// Returns the tree for the evaluation of several states at once in vector registers, at one
    /// time of a drive.
    #[inline(always)]
    pub(crate) fn in_registers<R: Simd<T>>(
        &self,
        drive: Option<RootDrive<T>>,
        buffer: &mut [T],
    ) -> impl InRegisters<R> {
        match self.has_one_driven_link(drive) {
            true => OneOf::First(AtOneTime {
                evaluator: self.cast(R::splat),
                drive: drive.map(|drive| drive.map(R::splat)),
                workspace: Workspace::new(),
            }),
            false => OneOf::Second(self.strips.in_registers(drive, buffer)),
        }
    }

    /// Returns true for a tree of one link with a drive. The equations expect the torque of a drive
    /// to act on a link with children.
    #[inline(always)]
    fn has_one_driven_link(&self, drive: Option<RootDrive<T>>) -> bool {
        self.links == 1 && drive.is_some()
    }
}
