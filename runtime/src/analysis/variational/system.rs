//! Systems that combine a motion with small deviations from it.

use std::cell::RefCell;
use std::fmt;

use crate::scalar::{Dual, Scalar};
use crate::system::{CastOde, Ode, Workspace};

/// A system that can compute the derivatives of its rates by the state.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not know how its rates change with the state",
    note = "for a model: `linearised(AbsoluteAngles(&model))`; for equations that are generic over the scalar: `ByTangents::<_, Dual<f64, 1>>::new(&ode)`; otherwise `WithDerivative`"
)]
pub trait Linearised<T>: Ode<T> {
    /// Writes f(t, y) to `rates` and ∂f/∂y v to `deviation_rates`, where y is `state` and v is
    /// `deviation`. All slices have the length of the state. `workspace` is used as in
    /// [`Ode::rates_with`].
    fn linearised_rates(
        &self,
        workspace: &mut Workspace<T>,
        time: T,
        state: &[T],
        deviation: &[T],
        rates: &mut [T],
        deviation_rates: &mut [T],
    );
}

/// A number that carries a derivative: a dual number.
pub trait Tangent<T>: Scalar {
    /// Returns the number with this value and this derivative.
    fn with_tangent(value: T, tangent: T) -> Self;

    /// Returns the value and the derivative.
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

/// A system that is linearised by evaluating its equations `tangents` in numbers of type `D`, which
/// carry a derivative. The result is exact up to rounding.
///
/// It cannot be shared between threads, since it contains a workspace: each thread needs its own
/// value.
pub struct ByTangents<O, D, Q = O> {
    ode: O,
    tangents: Q,
    memory: RefCell<TangentMemory<D>>,
}

/// Buffers for one evaluation of the equations in numbers with derivatives.
struct TangentMemory<D> {
    state: Vec<D>,
    rates: Vec<D>,
    workspace: Workspace<D>,
}

impl<D: Scalar> TangentMemory<D> {
    /// Creates buffers for states of `dimension` numbers.
    fn new(dimension: usize) -> Self {
        let zeros = vec![D::from_f64(0.0); dimension];
        Self {
            state: zeros.clone(),
            rates: zeros,
            workspace: Workspace::new(),
        }
    }
}

/// Linearises a model in its coordinates, by evaluating its equations in dual numbers.
///
/// # Examples
///
/// This example computes, for an emitted model, its Lyapunov exponents, the derivative of a flow,
/// and the time for which rounding errors stay small.
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::analysis::variational::{
///     Lyapunov, flow_jacobian, linearised, trusted_until,
/// };
/// use branched_pendulum::prelude::*;
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     upper: rod(mass = 1, length = 1) [lower: rod(mass = 1, length = lower_length)],
/// )]
/// struct Chain;
///
/// let model = Chain::new(ChainParameters { lower_length: 0.8 })?;
/// let system = linearised(AbsoluteAngles(&model));
///
/// let method = Dop853::new(Options::with_tolerance(1e-10));
/// let start = State::at_rest(0.0, &[2.0, 2.5]);
/// let lyapunov = Lyapunov { count: 4, interval: 0.5, settling: 20, intervals: 100 };
/// let exponents = lyapunov.spectrum(&method, &system, &start)?.exponents;
/// assert!(exponents[0] > 1.0);
/// // No friction: volumes in phase space keep their size.
/// assert!(exponents.iter().sum::<f64>().abs() < 0.1);
///
/// let (end, columns) = flow_jacobian(&method, &system, &start, 1.0)?;
/// assert_eq!((end.values.len(), columns.len()), (4, 16));
/// let horizon = trusted_until(&method, &system, &start, 60.0, 1e-16, 1e-3)?;
/// assert!(horizon.is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn linearised<T: Scalar, O: CastOde<T>>(
    ode: O,
) -> ByTangents<O, Dual<T, 1>, O::Of<Dual<T, 1>>> {
    let tangents = ode.cast(Dual::<T, 1>::constant);
    ByTangents::of_both(ode, tangents)
}

impl<'a, O: ?Sized, D: Scalar> ByTangents<&'a O, D> {
    /// Linearises equations that are generic over the scalar type. For models see [`linearised`].
    pub fn new(ode: &'a O) -> Self {
        Self::of_both(ode, ode)
    }
}

impl<O, D: Scalar, Q> ByTangents<O, D, Q> {
    fn of_both(ode: O, tangents: Q) -> Self {
        Self {
            ode,
            tangents,
            memory: RefCell::new(TangentMemory::new(0)),
        }
    }
}

impl<O, D, Q> fmt::Debug for ByTangents<O, D, Q> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            ode: _,
            tangents: _,
            memory: _,
        } = self;
        formatter.debug_struct("ByTangents").finish_non_exhaustive()
    }
}

impl<T, O: Ode<T>, D, Q> Ode<T> for ByTangents<O, D, Q> {
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

impl<T, O, D, Q> Linearised<T> for ByTangents<O, D, Q>
where
    T: Scalar,
    O: Ode<T>,
    D: Tangent<T>,
    Q: Ode<D>,
{
    fn linearised_rates(
        &self,
        _workspace: &mut Workspace<T>,
        time: T,
        state: &[T],
        deviation: &[T],
        rates: &mut [T],
        deviation_rates: &mut [T],
    ) {
        let zero = T::from_f64(0.0);
        let mut memory = self.memory.borrow_mut();
        let own = &mut *memory;
        own.state.clear();
        let both = state.iter().zip(deviation);
        own.state.extend(both.map(|(&y, &v)| D::with_tangent(y, v)));
        own.rates.resize(state.len(), D::with_tangent(zero, zero));
        let time = D::with_tangent(time, zero);
        self.tangents
            .rates_with(&mut own.workspace, time, &own.state, &mut own.rates);
        let out = rates.iter_mut().zip(deviation_rates);
        for ((rate, deviation_rate), tangent) in out.zip(own.rates.iter()) {
            (*rate, *deviation_rate) = tangent.value_and_tangent();
        }
    }
}

/// A system for which a function of the caller computes the derivative of the rates.
#[derive(Clone, Copy)]
pub struct WithDerivative<O, F> {
    ode: O,
    derivative: F,
}

impl<O, F> WithDerivative<O, F> {
    /// Combines the system `ode` with `derivative(time, state, deviation, out)`, which writes ∂f/∂y
    /// v to `out` for the deviation v.
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
        workspace: &mut Workspace<T>,
        time: T,
        state: &[T],
        deviation: &[T],
        rates: &mut [T],
        deviation_rates: &mut [T],
    ) {
        self.ode.rates_with(workspace, time, state, rates);
        (self.derivative)(time, state, deviation, deviation_rates);
    }
}

/// System of a motion and of deviations from it: its state is the state of `system`, followed by
/// the deviations one after the other.
#[derive(Clone, Copy, Debug)]
pub struct Variational<'a, L: ?Sized> {
    system: &'a L,
    deviations: usize,
}

impl<'a, L: ?Sized> Variational<'a, L> {
    /// Returns the system of a motion of `system` and its deviations; `deviations` is their number.
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
            self.system.linearised_rates(
                workspace,
                time,
                motion,
                deviation,
                motion_rates,
                own_rates,
            );
        }
    }
}
