//! Functions of a state of a model: each said once, on any scalar.

use super::fused::in_fused_arithmetic;
use super::{Model, Workspace};
use crate::scalar::Scalar;

/// When a function is asked for, and of which of several alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct At<T> {
    /// Time, s.
    pub time: T,
    /// Number of the sector, or of the set of links; 0 where there is one function.
    pub index: usize,
}

impl<T> At<T> {
    /// The function at a time, where there is one of its kind.
    pub const fn time(time: T) -> Self {
        Self { time, index: 0 }
    }

    /// The same on other scalars.
    #[inline(always)]
    pub fn map<S>(self, convert: impl Fn(T) -> S) -> At<S> {
        At {
            time: convert(self.time),
            index: self.index,
        }
    }
}

/// A function of a state: how many slices it takes and writes.
pub trait SliceCounts {
    /// Number of slices that it takes.
    const GIVEN: usize;

    /// Number of slices that it writes.
    const RESULTS: usize;
}

macro_rules! function {
    ($(#[$docs:meta])* $name:ident: $given:literal -> $results:literal) => {
        $(#[$docs])*
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl super::SliceCounts for $name {
            const GIVEN: usize = $given;
            const RESULTS: usize = $results;
        }
    };
}

/// The functions.
pub mod functions {
    function! {
        /// Angular accelerations (rad/s²) of angles (rad), angular velocities (rad/s) and torques
        /// from outside (N m) on all links.
        AccelerationsUnderTorques: 3 -> 1
    }

    function! {
        /// Angular accelerations (rad/s²) of all links and reactions (N m) on those of a set, of
        /// angles, angular velocities and torques on all links and the angular accelerations of
        /// that set.
        AccelerationsOfHeldLinks: 4 -> 2
    }

    function! {
        /// Accelerations of the motion in phase and, behind them, of the differences of a sector,
        /// of angles, angular velocities, differences and their rates: linear in the differences.
        LinearDifferences: 4 -> 1
    }

    function! {
        /// Accelerations of the angles in phase and, behind them, of small differences that act
        /// back, of angles, angular velocities, differences and their rates.
        SmallDifferences: 4 -> 1
    }

    function! {
        /// The same under torques: on the angles in phase, and on the differences.
        SmallDifferencesUnderTorques: 6 -> 1
    }

    function! {
        /// Second derivatives (rad/s²) of symmetric coordinates (rad), of these and their rates.
        SymmetricAccelerations: 2 -> 1
    }
}

/// A model that has a function `F` of [`functions`]. Emitted code implements it: once, in the
/// arithmetic of the model's own scalar. All forms of the function are made of that:
/// one state in fused arithmetic, many in registers ([`Batch`](crate::batch::Batch)), a system
/// of equations ([`SecondOrderOde`](super::SecondOrderOde)) and its lanes, the same on other scalars.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no function `{F}` in `{T}`",
    note = "torques from outside are asked for by `emit(forces)`, held links by `prescribed(LINK)`, linear differences by `in_phase(…)` with `emit(transverse)`, those that act back by `emit(small)`, symmetric coordinates by `emit(symmetric)`"
)]
pub trait Computes<F: SliceCounts, T: Scalar>: Model<T> {
    /// The model on other scalars, which has the function too.
    type On<S: Scalar>: Computes<F, S>;

    /// Takes every constant through `convert`, as [`Model::cast`].
    fn on<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::On<S>;

    /// Writes the results, in the arithmetic of `T`; NaN where there are other slices than the
    /// function takes, or their lengths do not fit.
    ///
    /// Write `#[inline(always)]`: the caller chooses the instructions that this is
    /// compiled for.
    fn compute(&self, at: At<T>, given: &[&[T]], results: &mut [&mut [T]]);

    /// Writes the same in memory that the caller keeps, and where the type and the machine can,
    /// with fused products and sums: [`scalar`](crate::scalar#which-bits). Integrators call
    /// this one.
    #[inline]
    fn compute_with(
        &self,
        workspace: &mut Workspace<T>,
        at: At<T>,
        given: &[&[T]],
        results: &mut [&mut [T]],
    ) {
        let _ = workspace;
        in_fused_arithmetic(self, at, given, results);
    }
}

impl<F: SliceCounts, T: Scalar, M: Computes<F, T>> Computes<F, T> for &M {
    type On<S: Scalar> = M::On<S>;

    #[inline(always)]
    fn on<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::On<S> {
        (**self).on(convert)
    }

    #[inline(always)]
    fn compute(&self, at: At<T>, given: &[&[T]], results: &mut [&mut [T]]) {
        (**self).compute(at, given, results);
    }

    #[inline]
    fn compute_with(
        &self,
        workspace: &mut Workspace<T>,
        at: At<T>,
        given: &[&[T]],
        results: &mut [&mut [T]],
    ) {
        (**self).compute_with(workspace, at, given, results);
    }
}

/// Computes in memory that the caller keeps, or without any in the arithmetic of `T`.
#[inline(always)]
pub(super) fn compute_in<F: SliceCounts, T: Scalar, M: Computes<F, T>>(
    model: &M,
    workspace: Option<&mut Workspace<T>>,
    at: At<T>,
    given: &[&[T]],
    results: &mut [&mut [T]],
) {
    match workspace {
        Some(workspace) => model.compute_with(workspace, at, given, results),
        None => model.compute(at, given, results),
    }
}
