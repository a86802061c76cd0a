//! The equations of a tree in one of their forms, and the ways through it.

use branched_pendulum::scalar::Scalar;
use branched_pendulum::system::Workspace;
use branched_pendulum::tree::{LinkEquations, LinkStates, RootDrive, SmallTree, Tree};

use crate::equations::{GeneralEquations, RoughEquations, StraightEquations};
use crate::rows::Form;

/// A tree in one of the forms.
#[derive(Clone, Debug)]
pub(crate) enum Equations<T> {
    Straight(Ways<StraightEquations, T>),
    General(Ways<GeneralEquations, T>),
    Rough(Ways<RoughEquations, T>),
}

/// Ways through a tree: in strips, for many states and large trees, and link by link, for
/// one state of a small one.
#[derive(Clone, Debug)]
pub(crate) struct Ways<E, T> {
    strips: Tree<E, T>,
    small: Option<SmallTree<E, T>>,
}

/// Most links that are computed one by one, by form: from there on strips are faster
/// (`costs_of_one_state` in the tests).
const SMALL_STRAIGHT: usize = 40;
const SMALL_GENERAL: usize = 20;

impl<E: LinkEquations, T: Scalar> Ways<E, T> {
    fn new(parents: &[u32], rows: Vec<T>, gravity: T, most: usize) -> Self {
        let above = [T::from_f64(0.0), gravity];
        Self {
            strips: Tree::with_parents(parents, &rows, above),
            small: (parents.len() <= most).then(|| SmallTree::new(parents, rows, above)),
        }
    }

    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Ways<E, S> {
        Ways {
            strips: self.strips.cast(&convert),
            small: self.small.as_ref().map(|small| small.cast(&convert)),
        }
    }
}

/// Actions on a tree from outside.
#[derive(Clone, Copy)]
pub(crate) struct Acting<'a, T> {
    pub(crate) drive: Option<RootDrive<T>>,
    pub(crate) torques: Option<&'a [T]>,
}

impl<T: Scalar> Equations<T> {
    pub(crate) fn new(form: Form, parents: &[u32], rows: Vec<T>, gravity: T) -> Self {
        match form {
            Form::Straight => Self::Straight(Ways::new(parents, rows, gravity, SMALL_STRAIGHT)),
            Form::General => Self::General(Ways::new(parents, rows, gravity, SMALL_GENERAL)),
            Form::Rough => Self::Rough(Ways::new(parents, rows, gravity, SMALL_GENERAL)),
        }
    }

    pub(crate) fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Equations<S> {
        match self {
            Self::Straight(tree) => Equations::Straight(tree.cast(convert)),
            Self::General(tree) => Equations::General(tree.cast(convert)),
            Self::Rough(tree) => Equations::Rough(tree.cast(convert)),
        }
    }

    /// Writes the accelerations at angles and angular velocities.
    #[inline(always)]
    pub(crate) fn accelerate(
        &self,
        workspace: &mut Workspace<T>,
        acting: Acting<'_, T>,
        given: [&[T]; 2],
        alpha: &mut [T],
    ) {
        match self {
            Self::Straight(tree) => accelerate(tree, workspace, acting, given, alpha),
            Self::General(tree) => accelerate(tree, workspace, acting, given, alpha),
            Self::Rough(tree) => accelerate(tree, workspace, acting, given, alpha),
        }
    }

    /// Does so in the arithmetic of `T`, compiled for the instructions that the caller
    /// chooses.
    #[inline(always)]
    pub(crate) fn evaluate(&self, acting: Acting<'_, T>, given: [&[T]; 2], alpha: &mut [T]) {
        match self {
            Self::Straight(ways) => evaluate(&ways.strips, acting, given, alpha),
            Self::General(ways) => evaluate(&ways.strips, acting, given, alpha),
            Self::Rough(ways) => evaluate(&ways.strips, acting, given, alpha),
        }
    }
}

#[inline(always)]
fn accelerate<E: LinkEquations, T: Scalar>(
    ways: &Ways<E, T>,
    workspace: &mut Workspace<T>,
    acting: Acting<'_, T>,
    [theta, omega]: [&[T]; 2],
    alpha: &mut [T],
) {
    let single = on_single_link(&acting, theta.len());
    let torques = single.as_ref().map(<[T; 1]>::as_slice).or(acting.torques);
    let drive = acting.drive;
    if let Some(small) = &ways.small {
        let states = LinkStates {
            theta,
            omega,
            torques,
        };
        return small.accelerations_with(workspace, drive, states, alpha);
    }
    let tree = &ways.strips;
    match torques {
        None => tree.accelerations_with(workspace, drive, theta, omega, alpha),
        Some(torques) => {
            let given = [theta, omega, torques];
            tree.accelerations_under_with(workspace, drive, given, alpha);
        }
    }
}

#[inline(always)]
fn evaluate<E: LinkEquations, T: Scalar>(
    tree: &Tree<E, T>,
    acting: Acting<'_, T>,
    [theta, omega]: [&[T]; 2],
    alpha: &mut [T],
) {
    let single = on_single_link(&acting, theta.len());
    let torques = single.as_ref().map(<[T; 1]>::as_slice).or(acting.torques);
    match torques {
        None => {
            let at = |numbers: &[T], link: usize| match numbers.get(link) {
                Some(&number) => number,
                None => T::from_f64(f64::NAN),
            };
            tree.evaluate(
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
        Some(torques) => tree.evaluate_under(acting.drive, [theta, omega, torques], alpha),
    }
}

/// All torque on a tree of one link, if a drive turns it: the equations know a torque of
/// the drive on links with children alone.
#[inline(always)]
pub(crate) fn on_single_link<T: Scalar>(acting: &Acting<'_, T>, links: usize) -> Option<[T; 1]> {
    let drive = acting.drive.filter(|_| links == 1)?;
    let given = acting.torques.and_then(|torques| torques.first());
    Some([match given {
        Some(&torque) => torque + drive.torque,
        None => drive.torque,
    }])
}
