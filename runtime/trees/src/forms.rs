//! The equations of a tree in one of their forms, and what acts between its links.

use branched_pendulum::emitted::Simd;
use branched_pendulum::scalar::Scalar;
use branched_pendulum::system::{InRegisters, Workspace};
use branched_pendulum::tree::{LinkEquations, RootDrive};

use crate::between::Between;
use crate::equations::{Form, GeneralEquations, RoughEquations, StraightEquations};
use crate::ways::Ways;

/// A tree in one of the forms.
#[derive(Clone, Debug)]
enum FormEquations<T> {
    Straight(Ways<StraightEquations, T>),
    General(Ways<GeneralEquations, T>),
    Rough(Ways<RoughEquations, T>),
}

/// Actions on a tree from outside.
#[derive(Clone, Copy)]
pub(crate) struct Acting<'a, T> {
    pub(crate) drive: Option<RootDrive<T>>,
    pub(crate) torques: Option<&'a [T]>,
}

impl<T: Scalar> Acting<'_, T> {
    /// Returns the torques of links. If a drive turns a tree of one link, they are the `sum`
    /// of all: the equations know a torque of the drive on links with children alone.
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
            Form::Straight => Self::Straight(Ways::new(form, parents, rows, gravity)),
            Form::General => Self::General(Ways::new(form, parents, rows, gravity)),
            Form::Rough => Self::Rough(Ways::new(form, parents, rows, gravity)),
        }
    }

    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> FormEquations<S> {
        match self {
            Self::Straight(tree) => FormEquations::Straight(tree.cast(convert)),
            Self::General(tree) => FormEquations::General(tree.cast(convert)),
            Self::Rough(tree) => FormEquations::Rough(tree.cast(convert)),
        }
    }

    /// Writes the accelerations at angles and angular velocities.
    #[inline(always)]
    fn accelerate(
        &self,
        workspace: &mut Workspace<T>,
        acting: Acting<'_, T>,
        given: [&[T]; 2],
        alpha: &mut [T],
    ) {
        match self {
            Self::Straight(ways) => ways.accelerate(workspace, acting, given, alpha),
            Self::General(ways) => ways.accelerate(workspace, acting, given, alpha),
            Self::Rough(ways) => ways.accelerate(workspace, acting, given, alpha),
        }
    }

    /// Writes accelerations in the arithmetic of `T`, compiled for the instructions that the caller
    /// chooses.
    #[inline(always)]
    fn evaluate_under(&self, acting: Acting<'_, T>, given: [&[T]; 2], alpha: &mut [T]) {
        match self {
            Self::Straight(ways) => ways.evaluate_under(acting, given, alpha),
            Self::General(ways) => ways.evaluate_under(acting, given, alpha),
            Self::Rough(ways) => ways.evaluate_under(acting, given, alpha),
        }
    }

    /// Returns how many numbers [`in_registers`](Self::in_registers) takes room for.
    fn room(&self) -> usize {
        match self {
            Self::Straight(ways) => ways.room(),
            Self::General(ways) => ways.room(),
            Self::Rough(ways) => ways.room(),
        }
    }

    /// Returns the tree for registers of states at one time of a drive.
    #[inline(always)]
    fn in_registers<R: Simd<T>>(
        &self,
        drive: Option<RootDrive<T>>,
        room: &mut [T],
    ) -> impl InRegisters<R> {
        match self {
            Self::Straight(ways) => OneOf::First(ways.in_registers(drive, room)),
            Self::General(ways) => OneOf::Second(OneOf::First(ways.in_registers(drive, room))),
            Self::Rough(ways) => OneOf::Second(OneOf::Second(ways.in_registers(drive, room))),
        }
    }
}

/// The equations of a tree, with the springs and the friction between its links.
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

    /// What acts between links.
    pub(crate) fn between(&self) -> &Between<T> {
        &self.between
    }

    /// Returns what acts, with the torques between links among those from outside; they stand in
    /// `numbers`.
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

    /// Writes the accelerations at angles and angular velocities.
    #[inline(always)]
    pub(crate) fn accelerate(
        &self,
        workspace: &mut Workspace<T>,
        acting: Acting<'_, T>,
        given: [&[T]; 2],
        alpha: &mut [T],
    ) {
        let (acting, workspace) = match self.between.is_empty() {
            true => (acting, workspace),
            false => {
                let (torques, inner) = workspace.with_inner(given[0].len());
                self.between.write_torques(acting.torques, given, torques);
                let torques = Some(&*torques);
                (Acting { torques, ..acting }, inner)
            }
        };
        self.form.accelerate(workspace, acting, given, alpha);
    }

    /// Gives the accelerations in the arithmetic of `T`, compiled for the instructions that the
    /// caller chooses.
    #[inline(always)]
    pub(crate) fn evaluate(
        &self,
        drive: Option<RootDrive<T>>,
        theta: impl Fn(usize) -> T,
        omega: impl Fn(usize) -> T,
        alpha: impl FnMut(usize, T),
    ) {
        let torques = None;
        through_slices(self.links, theta, omega, alpha, |given, results| {
            self.evaluate_under(Acting { drive, torques }, given, results);
        });
    }

    /// Writes accelerations under torques, likewise.
    #[inline(always)]
    pub(crate) fn evaluate_under(&self, acting: Acting<'_, T>, given: [&[T]; 2], alpha: &mut [T]) {
        let mut numbers = Vec::new();
        let acting = self.all_acting(acting, given, &mut numbers);
        self.form.evaluate_under(acting, given, alpha);
    }

    /// Returns how many numbers [`in_registers`](Self::in_registers) takes room for.
    pub(crate) fn room(&self) -> usize {
        self.form.room()
    }

    /// Returns the tree for registers of states at one time of a drive.
    #[inline(always)]
    pub(crate) fn in_registers<R: Simd<T>>(
        &self,
        drive: Option<RootDrive<T>>,
        room: &mut [T],
    ) -> impl InRegisters<R> {
        match self.between.is_empty() {
            true => OneOf::First(self.form.in_registers(drive, room)),
            false => OneOf::Second(CoupledAtOneTime {
                equations: self.cast(R::splat),
                drive: drive.map(|drive| drive.map(R::splat)),
            }),
        }
    }
}

/// Hands the angles and velocities of links to a function of slices, and its results on.
#[inline(always)]
fn through_slices<T: Scalar>(
    links: usize,
    theta: impl Fn(usize) -> T,
    omega: impl Fn(usize) -> T,
    mut alpha: impl FnMut(usize, T),
    write: impl FnOnce([&[T]; 2], &mut [T]),
) {
    let mut numbers = vec![T::from_f64(f64::NAN); 3 * links];
    let (given, results) = numbers.split_at_mut(2 * links);
    let (angles, velocities) = given.split_at_mut(links);
    let both = angles.iter_mut().zip(&mut *velocities);
    for (link, (angle, velocity)) in both.enumerate() {
        (*angle, *velocity) = (theta(link), omega(link));
    }
    write([angles, velocities], results);
    for (link, acceleration) in results.iter().enumerate() {
        alpha(link, *acceleration);
    }
}

/// One of two forms in registers.
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

/// A tree whose constants are registers, with its drive at one time.
pub(crate) struct AtOneTime<E, R> {
    pub(crate) ways: Ways<E, R>,
    pub(crate) drive: Option<RootDrive<R>>,
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
        through_slices(self.ways.links(), theta, omega, alpha, |given, results| {
            let acting = Acting { drive, torques };
            self.ways.evaluate_under(acting, given, results);
        });
    }
}

/// A tree with what acts between its links, whose constants are registers, likewise.
struct CoupledAtOneTime<R> {
    equations: Equations<R>,
    drive: Option<RootDrive<R>>,
}

impl<R: Scalar> InRegisters<R> for CoupledAtOneTime<R> {
    #[inline(always)]
    fn evaluate(
        &mut self,
        theta: impl Fn(usize) -> R,
        omega: impl Fn(usize) -> R,
        alpha: impl FnMut(usize, R),
    ) {
        self.equations.evaluate(self.drive, theta, omega, alpha);
    }
}
