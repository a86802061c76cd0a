//! Functions of a model's state, each written once for all scalar types.

use super::fused::in_fused_arithmetic;
use super::{Model, Workspace};
use crate::scalar::Scalar;

/// Time of an evaluation, and the index of the sector or set of links to which the function
/// applies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct At<T> {
    /// Time, s.
    pub time: T,
    /// Index of the sector, or of the set of prescribed links; 0 if the model has a single such
    /// function.
    pub index: usize,
}

impl<T> At<T> {
    /// Creates the argument for a time (s), with index 0.
    pub const fn time(time: T) -> Self {
        Self { time, index: 0 }
    }

    /// Returns the same argument, with the time converted to another scalar type.
    #[inline(always)]
    pub fn map<S>(self, convert: impl Fn(T) -> S) -> At<S> {
        At {
            time: convert(self.time),
            index: self.index,
        }
    }
}

/// A function of a state that takes slices and writes slices: how many of each, and the motion that
/// it describes.
pub trait SliceFunction {
    /// Number of argument slices.
    const ARGUMENTS: usize;

    /// Number of result slices.
    const RESULTS: usize;

    /// How the rates of a [`Motion`](super::Motion) follow from the function; `None` if the function
    /// describes no motion.
    const MOTION: Option<MotionKind>;
}

/// How the rates of a motion follow from a function. The state is coordinates, followed by their
/// velocities or momenta.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MotionKind {
    /// The function returns accelerations, given coordinates and velocities.
    Free,
    /// The function returns accelerations, given coordinates, velocities and external torques.
    UnderTorques,
    /// The function returns accelerations and reactions, given angles, angular velocities, external
    /// torques and the accelerations of prescribed links.
    Prescribed,
    /// The function returns the rates of coordinates and of momenta, given both.
    Canonical,
}

macro_rules! function {
    (
        $(#[$docs:meta])* $name:ident: $given:literal -> $results:literal
        $(, $motion:ident)?
    ) => {
        $(#[$docs])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name;

        impl super::SliceFunction for $name {
            const ARGUMENTS: usize = $given;
            const RESULTS: usize = $results;
            const MOTION: Option<super::MotionKind> = motion_kind!($($motion)?);
        }
    };
}

macro_rules! motion_kind {
    () => {
        None
    };
    ($motion:ident) => {
        Some(super::MotionKind::$motion)
    };
}

/// Marker types of the functions of a state that models can have.
pub mod functions {
    function! {
        /// Angular accelerations (rad/s²) from angles (rad), angular velocities (rad/s) and
        /// external torques (N m) on all links.
        AccelerationsUnderTorques: 3 -> 1, UnderTorques
    }

    function! {
        /// Generalized torques (N m) that cause a motion, from angles (rad), angular velocities
        /// (rad/s) and angular accelerations (rad/s²) of all links.
        InverseDynamics: 3 -> 1
    }

    function! {
        /// Derivatives of the sum Σ w_i α_i of the angular accelerations α, with given weights w: by
        /// angles, by angular velocities, and by parameters. The arguments are angles (rad), angular
        /// velocities (rad/s) and weights.
        AccelerationsPullback: 3 -> 3
    }

    function! {
        /// Derivatives of the sum Σ w_i α_i of the angular accelerations α under external torques:
        /// by angles, by angular velocities, by torques, and by parameters. The arguments are angles
        /// (rad), angular velocities (rad/s), torques (N m) and weights.
        AccelerationsUnderTorquesPullback: 4 -> 4
    }

    function! {
        /// Angular accelerations (rad/s²) of all links and reactions (N m) on a set of prescribed
        /// links, from angles, angular velocities and torques of all links and the angular
        /// accelerations of the set.
        AccelerationsOfHeldLinks: 4 -> 2, Prescribed
    }

    function! {
        /// Accelerations of the in-phase motion, then those of the differences of a sector, from
        /// angles, angular velocities, differences and their rates. Linear in the differences.
        LinearDifferences: 4 -> 1, Free
    }

    function! {
        /// Accelerations of the in-phase angles, then those of small differences that act back on
        /// them, from angles, angular velocities, differences and their rates.
        SmallDifferences: 4 -> 1, Free
    }

    function! {
        /// As `SmallDifferences`, with torques as further arguments: on the in-phase angles, and on the
        /// differences.
        SmallDifferencesUnderTorques: 6 -> 1, UnderTorques
    }

    function! {
        /// Rates of the angles (rad/s) and of their momenta (N m), from angles (rad) and momenta
        /// (kg m²/s): Hamilton's equations with generalized forces.
        CanonicalRates: 2 -> 2, Canonical
    }

    function! {
        /// Second derivatives (rad/s²) of symmetric coordinates (rad), from the coordinates and
        /// their rates.
        SymmetricAccelerations: 2 -> 1, Free
    }
}

/// A model that has a function `F` of [`functions`]. Emitted code implements it once, in the
/// arithmetic of the model's scalar type. All forms of the function use this implementation: one
/// state in fused arithmetic, many states in registers ([`Batch`](crate::batch::Batch)), a system
/// of equations ([`Motion`](super::Motion)), also in lanes, and all of these in other scalar types.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no function `{F}` in `{T}`",
    note = "torques from outside are requested by `emit(forces)`, the torques of a given motion by `emit(inverse_dynamics)`, derivatives by `emit(gradient)`, held links by `prescribed(LINK)`, linear differences by `in_phase(…)` with `emit(transverse)`, those that act back by `emit(small)`, symmetric coordinates by `emit(symmetric)`, canonical variables by `emit(momenta)`"
)]
pub trait Computes<F: SliceFunction, T: Scalar>: Model<T> {
    /// The type of the model with constants of the scalar type `S`, which has the function too.
    type On<S: Scalar>: Computes<F, S>;

    /// Number of coordinates of the motion that the function describes, if the type determines it:
    /// links, and differences between copies.
    const COORDINATES: Option<usize> = Self::KNOWN_LINKS;

    /// Returns the model with each constant converted by `convert`, as in [`Model::cast`].
    fn on<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::On<S>;

    /// Writes the results, in the arithmetic of `T`; NaN if the number of slices or a length is
    /// wrong.
    ///
    /// Implementations should be `#[inline(always)]`: the caller chooses the instructions for which
    /// this is compiled.
    fn compute(&self, at: At<T>, given: &[&[T]], results: &mut [&mut [T]]);

    /// Writes the same results, with a workspace that the caller keeps, and with fused multiply–add
    /// if the type and the machine support it: [`scalar`](crate::scalar#which-bits). Integrators
    /// call this function.
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

impl<F: SliceFunction, T: Scalar, M: Computes<F, T>> Computes<F, T> for &M {
    type On<S: Scalar> = M::On<S>;

    const COORDINATES: Option<usize> = M::COORDINATES;

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

/// Computes the function with the given workspace or, without one, in the arithmetic of `T`.
#[inline(always)]
pub(super) fn compute_in<F: SliceFunction, T: Scalar, M: Computes<F, T>>(
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
