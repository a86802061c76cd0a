//! Systems of first-order equations, in the form that integrators use.

use core::fmt;

use super::Workspace;
use super::by_reference::by_reference;
use crate::scalar::Scalar;

/// A system of first-order ordinary differential equations y' = f(t, y).
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a system of first-order equations in `{T}`",
    label = "not an `Ode<{T}>`",
    note = "choose the coordinates of a model: `AbsoluteAngles(&model)`, with `emit(symmetric)` `SymmetricCoordinates(&model)`, with `emit(momenta)` `CanonicalVariables(&model)`",
    note = "equations of your own: implement `Ode`, or `OdeFn::new(dimension, |time, state, rates| …)`"
)]
pub trait Ode<T> {
    /// Returns the number of components of the state.
    fn dimension(&self) -> usize;

    /// Writes f(t, y) to `rates`, where y is `state` and t is `time`. Both slices have length
    /// [`dimension`](Self::dimension).
    ///
    /// Writes NaN where f is undefined: integrators stop there at once and report the time and the
    /// state.
    fn rates(&self, time: T, state: &[T], rates: &mut [T]);

    /// Writes the same rates as [`rates`](Self::rates), using memory that the caller keeps.
    /// Integrators call this function. Systems that need no memory keep the default.
    #[inline]
    fn rates_with(&self, workspace: &mut Workspace<T>, time: T, state: &[T], rates: &mut [T]) {
        let _ = workspace;
        self.rates(time, state, rates);
    }
}

by_reference! {
    impl<T> Ode<T> for &P where P: ?Sized {
        fn dimension(&self) -> usize;
        fn rates(&self, time: T, state: &[T], rates: &mut [T]);
        fn rates_with(
            &self, workspace: &mut Workspace<T>, time: T, state: &[T], rates: &mut [T]
        );
    }
}

/// The two halves of a state, and the two halves of its rates of change.
pub(crate) type StateHalves<'s, 'r, T> = ([&'s [T]; 2], [&'r mut [T]; 2]);

/// Splits a state and its rates into two halves of `half` components each. If a length is not 2 ·
/// `half`, returns `None` and fills the rates with NaN.
#[inline(always)]
pub(crate) fn halves<'s, 'r, T: Scalar>(
    half: usize,
    state: &'s [T],
    rates: &'r mut [T],
) -> Option<StateHalves<'s, 'r, T>> {
    if [state.len(), rates.len()] != [2 * half; 2] {
        rates.fill(T::from_f64(f64::NAN));
        return None;
    }
    Some((state.split_at(half).into(), rates.split_at_mut(half).into()))
}

/// System of first-order equations whose right-hand side is a function of the caller.
///
/// # Examples
///
/// ```
/// use branched_pendulum::system::{Ode, OdeFn};
///
/// let oscillator = OdeFn::new(2, |_time: f64, y: &[f64], rates: &mut [f64]| {
///     rates[0] = y[1];
///     rates[1] = -y[0];
/// });
/// let mut rates = [0.0; 2];
/// oscillator.rates(0.0, &[1.0, 0.5], &mut rates);
/// assert_eq!(rates, [0.5, -1.0]);
/// ```
#[derive(Clone, Copy)]
pub struct OdeFn<F> {
    dimension: usize,
    function: F,
}

impl<F> OdeFn<F> {
    /// Returns the system of `dimension` equations whose rates are written by `function(time,
    /// state, rates)`.
    pub fn new<T>(dimension: usize, function: F) -> Self
    where
        F: Fn(T, &[T], &mut [T]),
    {
        Self {
            dimension,
            function,
        }
    }
}

impl<F> fmt::Debug for OdeFn<F> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            dimension,
            function: _,
        } = self;
        formatter
            .debug_struct("OdeFn")
            .field("dimension", dimension)
            .finish_non_exhaustive()
    }
}

impl<T, F: Fn(T, &[T], &mut [T])> Ode<T> for OdeFn<F> {
    fn dimension(&self) -> usize {
        self.dimension
    }

    #[inline]
    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        (self.function)(time, state, rates);
    }
}
