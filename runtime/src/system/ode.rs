//! Systems of first-order equations, which integrators see.

use core::fmt;

use super::Workspace;
use super::by_reference::by_reference;
use crate::scalar::Scalar;

/// A system of first-order ordinary differential equations y' = f(t, y).
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no system of first-order equations in `{T}`",
    label = "not an `Ode<{T}>`",
    note = "choose the coordinates of a model: `AbsoluteAngles(&model)`, with `emit(symmetric)` `SymmetricCoordinates(&model)`, with `emit(momenta)` `CanonicalVariables(&model)`",
    note = "equations of your own: implement `Ode`, or `OdeFn::new(dimension, |time, state, rates| …)`"
)]
pub trait Ode<T> {
    /// Number of components of the state.
    fn dimension(&self) -> usize;

    /// Writes f(t, y) to `rates`. Both slices have length
    /// [`dimension`](Self::dimension).
    ///
    /// Where f is not defined, write NaN: integrators stop there at once, with
    /// the time and the state.
    fn rates(&self, time: T, state: &[T], rates: &mut [T]);

    /// Writes the same rates as [`rates`](Self::rates), in memory that the caller
    /// keeps. Integrators call this one. Systems that need no memory leave it as it
    /// is.
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

/// Halves of a state, and of its rates.
pub(crate) type StateHalves<'s, 'r, T> = ([&'s [T]; 2], [&'r mut [T]; 2]);

/// Splits a state and its rates in halves of so many numbers. None, and rates that are NaN,
/// where lengths do not fit: there is no answer.
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

/// A function as an [`Ode`].
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
    /// The system of `dimension` equations whose rates `function(time, state,
    /// rates)` writes.
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
