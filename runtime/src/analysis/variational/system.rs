//! A motion and its deviations as one system.

use std::cell::RefCell;
use std::fmt;

use crate::scalar::{Dual, Scalar};
use crate::system::{Ode, Workspace};

/// A system that knows how its rates change with the state.
pub trait Linearised<T>: Ode<T> {
    /// Writes f(t, y) to `rates` and ∂f/∂y v to `deviation_rates`, y being
    /// `state` and v being `deviation`. All slices have the length of the
    /// state.
    fn linearised_rates(
        &self,
        time: T,
        state: &[T],
        deviation: &[T],
        rates: &mut [T],
        deviation_rates: &mut [T],
    );
}

/// A number that carries one derivative: a dual number.
pub trait Tangent<T>: Scalar {
    /// The number with this value and this derivative.
    fn with_tangent(value: T, tangent: T) -> Self;

    /// The value and the derivative.
    fn value_and_tangent(self) -> (T, T);
}

impl<T: Scalar> Tangent<T> for Dual<T, 1> {
    fn with_tangent(value: T, tangent: T) -> Self {
        Self {
            value,
            tangents: [tangent],
        }
    }

    fn value_and_tangent(self) -> (T, T) {
        (self.value, self.tangents[0])
    }
}

/// A system that is generic over the scalar, linearised by numbers of type `D`
/// that carry a derivative: exact to rounding.
///
/// Not for several threads at once, since it holds a workspace: each thread
/// makes its own.
pub struct ByTangents<'a, O: ?Sized, D> {
    ode: &'a O,
    tangents: RefCell<Tangents<D>>,
}

/// Memory for one evaluation.
struct Tangents<D> {
    state: Vec<D>,
    rates: Vec<D>,
    workspace: Workspace<D>,
}

impl<'a, O: ?Sized, D: Scalar> ByTangents<'a, O, D> {
    /// Linearises `ode`.
    pub fn new(ode: &'a O) -> Self {
        Self {
            ode,
            tangents: RefCell::new(Tangents {
                state: Vec::new(),
                rates: Vec::new(),
                workspace: Workspace::new(),
            }),
        }
    }
}

impl<O: ?Sized, D> fmt::Debug for ByTangents<'_, O, D> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            ode: _,
            tangents: _,
        } = self;
        formatter.debug_struct("ByTangents").finish_non_exhaustive()
    }
}

impl<T, O: Ode<T> + ?Sized, D> Ode<T> for ByTangents<'_, O, D> {
    fn dimension(&self) -> usize {
        self.ode.dimension()
    }

    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        self.ode.rates(time, state, rates);
    }

    fn rates_with(&self, workspace: &mut Workspace<T>, time: T, state: &[T], rates: &mut [T]) {
        self.ode.rates_with(workspace, time, state, rates);
    }
}

impl<T, O, D> Linearised<T> for ByTangents<'_, O, D>
where
    T: Scalar,
    O: Ode<T> + Ode<D> + ?Sized,
    D: Tangent<T>,
{
    fn linearised_rates(
        &self,
        time: T,
        state: &[T],
        deviation: &[T],
        rates: &mut [T],
        deviation_rates: &mut [T],
    ) {
        let zero = T::from_f64(0.0);
        let mut tangents = self.tangents.borrow_mut();
        let own = &mut *tangents;
        own.state.clear();
        let both = state.iter().zip(deviation);
        own.state.extend(both.map(|(&y, &v)| D::with_tangent(y, v)));
        own.rates.resize(state.len(), D::with_tangent(zero, zero));
        let time = D::with_tangent(time, zero);
        self.ode
            .rates_with(&mut own.workspace, time, &own.state, &mut own.rates);
        let out = rates.iter_mut().zip(deviation_rates);
        for ((rate, deviation_rate), tangent) in out.zip(own.rates.iter()) {
            (*rate, *deviation_rate) = tangent.value_and_tangent();
        }
    }
}

/// A system and the derivative of its rates as a function of the caller.
#[derive(Clone, Copy)]
pub struct WithDerivative<O, F> {
    ode: O,
    derivative: F,
}

impl<O, F> WithDerivative<O, F> {
    /// The system `ode`, for which `derivative(time, state, deviation, out)`
    /// writes ∂f/∂y v.
    pub fn new<T>(ode: O, derivative: F) -> Self
    where
        O: Ode<T>,
        F: Fn(T, &[T], &[T], &mut [T]),
    {
        Self { ode, derivative }
    }
}

impl<O, F> fmt::Debug for WithDerivative<O, F> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            ode: _,
            derivative: _,
        } = self;
        formatter
            .debug_struct("WithDerivative")
            .finish_non_exhaustive()
    }
}

impl<T, O: Ode<T>, F> Ode<T> for WithDerivative<O, F> {
    fn dimension(&self) -> usize {
        self.ode.dimension()
    }

    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        self.ode.rates(time, state, rates);
    }

    fn rates_with(&self, workspace: &mut Workspace<T>, time: T, state: &[T], rates: &mut [T]) {
        self.ode.rates_with(workspace, time, state, rates);
    }
}

impl<T: Copy, O: Ode<T>, F: Fn(T, &[T], &[T], &mut [T])> Linearised<T> for WithDerivative<O, F> {
    fn linearised_rates(
        &self,
        time: T,
        state: &[T],
        deviation: &[T],
        rates: &mut [T],
        deviation_rates: &mut [T],
    ) {
        self.ode.rates(time, state, rates);
        (self.derivative)(time, state, deviation, deviation_rates);
    }
}

/// A motion and deviations from it: the state is that of the system, followed
/// by the deviations, one after the other.
#[derive(Clone, Copy, Debug)]
pub struct Variational<'a, L: ?Sized> {
    system: &'a L,
    deviations: usize,
}

impl<'a, L: ?Sized> Variational<'a, L> {
    /// `system` with so many deviations.
    pub fn new(system: &'a L, deviations: usize) -> Self {
        Self { system, deviations }
    }
}

impl<T: Scalar, L: Linearised<T> + ?Sized> Ode<T> for Variational<'_, L> {
    fn dimension(&self) -> usize {
        self.system.dimension() * (1 + self.deviations)
    }

    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        self.rates_with(&mut Workspace::new(), time, state, rates);
    }

    fn rates_with(&self, workspace: &mut Workspace<T>, time: T, state: &[T], rates: &mut [T]) {
        let n = self.system.dimension();
        let expected = n * (1 + self.deviations);
        if n == 0 || state.len() != expected || rates.len() != expected {
            rates.fill(T::from_f64(f64::NAN));
            return;
        }
        let (motion, deviations) = state.split_at(n);
        let (motion_rates, deviation_rates) = rates.split_at_mut(n);
        if self.deviations == 0 {
            self.system
                .rates_with(workspace, time, motion, motion_rates);
        }
        let pairs = deviations.chunks(n).zip(deviation_rates.chunks_mut(n));
        for (deviation, own_rates) in pairs {
            self.system
                .linearised_rates(time, motion, deviation, motion_rates, own_rates);
        }
    }
}
