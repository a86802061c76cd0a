//! Equations of a tree in one of several forms, with the forces between its links.

use branched_pendulum::emitted::Simd;
use branched_pendulum::scalar::Scalar;
use branched_pendulum::system::{InRegisters, Workspace};
use branched_pendulum::tree::{LinkEquations, RootDrive};

use crate::between::Between;
use crate::equations::{Form, GeneralEquations, NonViscousEquations, PlainEquations};
use crate::evaluator::TreeEvaluator;

/// Equations of a tree in one of several forms.
#[derive(Clone, Debug)]
enum FormEquations<T> {
    Plain(TreeEvaluator<PlainEquations, T>),
    General(TreeEvaluator<GeneralEquations, T>),
    NonViscous(TreeEvaluator<NonViscousEquations, T>),
}

/// Calls a function of the equations of any form.
macro_rules! of_form {
    ($equations:expr, $evaluator:ident => $call:expr) => {
        match $equations {
            Self::Plain($evaluator) => $call,
            Self::General($evaluator) => $call,
            Self::NonViscous($evaluator) => $call,
        }
    };
}

/// External actions on a tree: its drive, and torques on its links.
#[derive(Clone, Copy)]
pub(crate) struct Acting<'a, T> {
    pub(crate) drive: Option<RootDrive<T>>,
    pub(crate) torques: Option<&'a [T]>,
}

impl<T: Scalar> Acting<'_, T> {
    /// Returns the external torques on the links. For a driven tree of one link, it returns `sum`,
    /// which includes the torque of the drive, because the equations accept that torque only on
    /// links with children.
    #[inline(always)]
    pub(crate) fn on_links<'s>(&'s self, links: usize, sum: &'s mut [T; 1]) -> Option<&'s [T]> {
        let Some(drive) = self.drive.filter(|_| links == 1) else {
            return self.torques;
        };
        *sum = [match self.torques.and_then(|torques| torques.first()) {
            Some(&torque) => torque + drive.torque,
            None => drive.torque,
        }];
        Some(sum)
    }
}

impl<T: Scalar> FormEquations<T> {
    fn new(form: Form, parents: &[u32], rows: Vec<T>, gravity: T) -> Self {
        match form {
            Form::Plain => Self::Plain(TreeEvaluator::new(form, parents, rows, gravity)),
            Form::General => Self::General(TreeEvaluator::new(form, parents, rows, gravity)),
            Form::NonViscous => Self::NonViscous(TreeEvaluator::new(form, parents, rows, gravity)),
        }
    }

    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> FormEquations<S> {
        match self {
            Self::Plain(tree) => FormEquations::Plain(tree.cast(convert)),
            Self::General(tree) => FormEquations::General(tree.cast(convert)),
            Self::NonViscous(tree) => FormEquations::NonViscous(tree.cast(convert)),
        }
    }

    /// Writes the accelerations (rad/s²) at the given angles and angular velocities, under external
    /// actions.
    #[inline(always)]
    fn accelerate(
        &self,
        workspace: &mut Workspace<T>,
        acting: Acting<'_, T>,
        given: [&[T]; 2],
        alpha: &mut [T],
    ) {
        of_form!(self, evaluator => evaluator.accelerate(workspace, acting, given, alpha))
    }

    /// Writes the accelerations in the arithmetic of `T`. It is compiled for the instructions that
    /// the caller chooses.
    #[inline(always)]
    fn evaluate_with(
        &self,
        workspace: &mut Workspace<T>,
        acting: Acting<'_, T>,
        given: [&[T]; 2],
        alpha: &mut [T],
    ) {
        of_form!(self, evaluator => evaluator.evaluate_with(workspace, acting, given, alpha))
    }

    /// Returns the length of the buffer that [`in_registers`](Self::in_registers) needs.
    fn workspace_len(&self) -> usize {
        of_form!(self, evaluator => evaluator.workspace_len())
    }

    /// Prepares the tree for the evaluation of many states in registers, at one time of a drive.
    #[inline(always)]
    fn in_registers<R: Simd<T>>(
        &self,
        drive: Option<RootDrive<T>>,
        buffer: &mut [T],
    ) -> impl InRegisters<R> {
        match self {
            Self::Plain(evaluator) => OneOf::First(evaluator.in_registers(drive, buffer)),
            Self::General(evaluator) => {
                OneOf::Second(OneOf::First(evaluator.in_registers(drive, buffer)))
            }
            Self::NonViscous(evaluator) => {
                OneOf::Second(OneOf::Second(evaluator.in_registers(drive, buffer)))
            }
        }
    }
}

/// Equations of a tree, with the springs and friction between its links.
#[derive(Clone, Debug)]
pub(crate) struct Equations<T> {
    links: usize,
    form: FormEquations<T>,
    between: Between<T>,
}

impl<T: Scalar> Equations<T> {
    pub(crate) fn new(
        form: Form,
        parents: &[u32],
        rows: Vec<T>,
        gravity: T,
        between: Between<T>,
    ) -> Self {
        let form = FormEquations::new(form, parents, rows, gravity);
        Self {
            links: parents.len(),
            form,
            between,
        }
    }

    pub(crate) fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Equations<S> {
        Equations {
            links: self.links,
            form: self.form.cast(&convert),
            between: self.between.cast(convert),
        }
    }

    /// Returns the springs and friction between the links.
    pub(crate) fn between(&self) -> &Between<T> {
        &self.between
    }

    /// Returns the external actions, with the torques of springs and friction between links added;
    /// these are computed in the buffer `numbers`.
    #[inline(always)]
    pub(crate) fn all_acting<'a>(
        &self,
        acting: Acting<'a, T>,
        given: [&[T]; 2],
        numbers: &'a mut Vec<T>,
    ) -> Acting<'a, T> {
        if self.between.is_empty() {
            return acting;
        }
        numbers.resize(given[0].len(), T::from_f64(0.0));
        self.between.write_torques(acting.torques, given, numbers);
        let torques = Some(&**numbers);
        Acting { torques, ..acting }
    }

    /// Writes the accelerations (rad/s²) at the given angles and angular velocities, under external
    /// actions.
    #[inline(always)]
    pub(crate) fn accelerate(
        &self,
        workspace: &mut Workspace<T>,
        acting: Acting<'_, T>,
        given: [&[T]; 2],
        alpha: &mut [T],
    ) {
        let (acting, workspace) = self.with_torques_between(workspace, acting, given);
        self.form.accelerate(workspace, acting, given, alpha);
    }

    /// Returns the external actions, with the torques of springs and friction between links added,
    /// and the workspace that remains.
    #[inline(always)]
    fn with_torques_between<'a>(
        &self,
        workspace: &'a mut Workspace<T>,
        acting: Acting<'a, T>,
        given: [&[T]; 2],
    ) -> (Acting<'a, T>, &'a mut Workspace<T>) {
        if self.between.is_empty() {
            return (acting, workspace);
        }
        let (torques, inner) = workspace.with_inner(given[0].len());
        self.between.write_torques(acting.torques, given, torques);
        let torques = Some(&*torques);
        (Acting { torques, ..acting }, inner)
    }

    /// Computes the accelerations in the arithmetic of `T`, compiled for the instructions that the
    /// caller chooses, and passes each to a closure.
    #[inline(always)]
    pub(crate) fn evaluate(
        &self,
        workspace: &mut Workspace<T>,
        drive: Option<RootDrive<T>>,
        theta: impl Fn(usize) -> T,
        omega: impl Fn(usize) -> T,
        alpha: impl FnMut(usize, T),
    ) {
        let torques = None;
        let write = |workspace: &mut Workspace<T>, given: [&[T]; 2], results: &mut [T]| {
            self.evaluate_with(workspace, Acting { drive, torques }, given, results);
        };
        through_slices(workspace, self.links, theta, omega, alpha, write);
    }

    /// Writes the accelerations under external actions, in the arithmetic of `T`. It is compiled
    /// for the instructions that the caller chooses.
    #[inline(always)]
    pub(crate) fn evaluate_with(
        &self,
        workspace: &mut Workspace<T>,
        acting: Acting<'_, T>,
        given: [&[T]; 2],
        alpha: &mut [T],
    ) {
        let (acting, workspace) = self.with_torques_between(workspace, acting, given);
        self.form.evaluate_with(workspace, acting, given, alpha);
    }

    /// Returns the length of the buffer that [`in_registers`](Self::in_registers) needs.
    pub(crate) fn workspace_len(&self) -> usize {
        self.form.workspace_len()
    }

    /// Prepares the tree for the evaluation of many states in registers, at one time of a drive.
    #[inline(always)]
    pub(crate) fn in_registers<R: Simd<T>>(
        &self,
        drive: Option<RootDrive<T>>,
        buffer: &mut [T],
    ) -> impl InRegisters<R> {
        match self.between.is_empty() {
            true => OneOf::First(self.form.in_registers(drive, buffer)),
            false => OneOf::Second(CoupledAtOneTime {
                equations: self.cast(R::splat),
                drive: drive.map(|drive| drive.map(R::splat)),
                workspace: Workspace::new(),
            }),
        }
    }
}

/// Adapts a function of slices to callers that use closures: copies angles and velocities to slices
/// in the workspace, calls `write` with the workspace that remains, and passes each result to
/// `alpha`.
#[inline(always)]
fn through_slices<T: Scalar>(
    workspace: &mut Workspace<T>,
    links: usize,
    theta: impl Fn(usize) -> T,
    omega: impl Fn(usize) -> T,
    mut alpha: impl FnMut(usize, T),
    write: impl FnOnce(&mut Workspace<T>, [&[T]; 2], &mut [T]),
) {
    let (numbers, inner) = workspace.with_inner(3 * links);
    let (given, results) = numbers.split_at_mut(2 * links);
    let (angles, velocities) = given.split_at_mut(links);
    let both = angles.iter_mut().zip(&mut *velocities);
    for (link, (angle, velocity)) in both.enumerate() {
        (*angle, *velocity) = (theta(link), omega(link));
    }
    write(inner, [angles, velocities], results);
    for (link, acceleration) in results.iter().enumerate() {
        alpha(link, *acceleration);
    }
}

/// A value of one of two types, for evaluation in registers.
pub(crate) enum OneOf<A, B> {
    First(A),
    Second(B),
}

impl<R, A: InRegisters<R>, B: InRegisters<R>> InRegisters<R> for OneOf<A, B> {
    #[inline(always)]
    fn evaluate(
        &mut self,
        theta: impl Fn(usize) -> R,
        omega: impl Fn(usize) -> R,
        alpha: impl FnMut(usize, R),
    ) {
        match self {
            Self::First(form) => form.evaluate(theta, omega, alpha),
            Self::Second(form) => form.evaluate(theta, omega, alpha),
        }
    }
}

/// Tree whose constants have been converted to registers, with its drive at one time.
pub(crate) struct AtOneTime<E, R> {
    pub(crate) evaluator: TreeEvaluator<E, R>,
    pub(crate) drive: Option<RootDrive<R>>,
    pub(crate) workspace: Workspace<R>,
}

impl<E: LinkEquations, R: Scalar> InRegisters<R> for AtOneTime<E, R> {
    #[inline(always)]
    fn evaluate(
        &mut self,
        theta: impl Fn(usize) -> R,
        omega: impl Fn(usize) -> R,
        alpha: impl FnMut(usize, R),
    ) {
        let (drive, torques) = (self.drive, None);
        let (evaluator, workspace) = (&self.evaluator, &mut self.workspace);
        let write = |workspace: &mut Workspace<R>, given: [&[R]; 2], results: &mut [R]| {
            evaluator.evaluate_with(workspace, Acting { drive, torques }, given, results);
        };
        through_slices(workspace, evaluator.links(), theta, omega, alpha, write);
    }
}

/// Tree with forces between its links whose constants have been converted to registers, with its
/// drive at one time.
struct CoupledAtOneTime<R> {
    equations: Equations<R>,
    drive: Option<RootDrive<R>>,
    workspace: Workspace<R>,
}

impl<R: Scalar> InRegisters<R> for CoupledAtOneTime<R> {
    #[inline(always)]
    fn evaluate(
        &mut self,
        theta: impl Fn(usize) -> R,
        omega: impl Fn(usize) -> R,
        alpha: impl FnMut(usize, R),
    ) {
        self.equations
            .evaluate(&mut self.workspace, self.drive, theta, omega, alpha);
    }
}
