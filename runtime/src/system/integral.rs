//! Equations with an integral along the motion as one more component.

use super::{Ode, PullbackOde, PullbackWorkspace, Workspace};
use crate::scalar::Scalar;
use alloc::vec;

/// Equations of motion y' = f(t, y) together with an integral along the motion, z' = g(t, y).
///
/// The state is y followed by z. The function g receives the time, the state y and a slice of zeros
/// of the same length, to which it writes its derivatives by y. So costs that are integrals have
/// gradients ([`AdjointMethod::gradient`](crate::integrate::AdjointMethod::gradient)): the cost is
/// the last component at the end, if it is zero at the start.
///
/// # Examples
///
/// ∫ y² dt of y = exp(−t):
///
/// ```
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::{OdeFn, WithIntegral};
///
/// let decay = OdeFn::new(1, |_, state: &[f64], rates: &mut [f64]| rates[0] = -state[0]);
/// let square = |_: f64, state: &[f64], slopes: &mut [f64]| {
///     slopes[0] = 2.0 * state[0];
///     state[0] * state[0]
/// };
/// let equations = WithIntegral::new(decay, square);
/// let method = Dop853::new(Options::with_tolerance(1e-10));
/// let end = method.run(&equations, &State::new(0.0, vec![1.0, 0.0]), 1.0)?;
/// assert!((end.state.values[1] - 0.5 * (1.0 - (-2.0_f64).exp())).abs() < 1e-9);
/// # Ok::<(), IntegrationError<f64>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct WithIntegral<O, G> {
    ode: O,
    integrand: G,
}

impl<O, G> WithIntegral<O, G> {
    /// Creates the equations from those of the motion and the function g.
    pub const fn new(ode: O, integrand: G) -> Self {
        Self { ode, integrand }
    }
}

impl<T, O, G> Ode<T> for WithIntegral<O, G>
where
    T: Scalar,
    O: Ode<T>,
    G: Fn(T, &[T], &mut [T]) -> T,
{
    fn dimension(&self) -> usize {
        self.ode.dimension() + 1
    }

    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        self.rates_with(&mut Workspace::new(), time, state, rates);
    }

    fn rates_with(&self, workspace: &mut Workspace<T>, time: T, state: &[T], rates: &mut [T]) {
        if [state.len(), rates.len()] != [self.dimension(); 2] {
            return rates.fill(T::from_f64(f64::NAN));
        }
        let (Some((_, state)), Some((rate, rates))) = (state.split_last(), rates.split_last_mut())
        else {
            return;
        };
        let (slopes, workspace) = workspace.with_inner(state.len());
        slopes.fill(T::from_f64(0.0));
        *rate = (self.integrand)(time, state, slopes);
        self.ode.rates_with(workspace, time, state, rates);
    }
}

impl<T, O, G> PullbackOde<T> for WithIntegral<O, G>
where
    T: Scalar,
    O: PullbackOde<T>,
    G: Fn(T, &[T], &mut [T]) -> T,
{
    fn add_pullback(
        &self,
        workspace: &mut PullbackWorkspace<T>,
        time: T,
        state: &[T],
        weights: &[T],
        state_adjoint: &mut [T],
        parameters_adjoint: &mut [T],
    ) {
        let (Some((_, state)), Some((weight, weights)), Some((_, adjoint))) = (
            state.split_last(),
            weights.split_last(),
            state_adjoint.split_last_mut(),
        ) else {
            return parameters_adjoint.fill(T::from_f64(f64::NAN));
        };
        let mut slopes = vec![T::from_f64(0.0); state.len()];
        let _ = (self.integrand)(time, state, &mut slopes);
        for (sum, slope) in adjoint.iter_mut().zip(slopes) {
            *sum = *sum + *weight * slope;
        }
        self.ode
            .add_pullback(workspace, time, state, weights, adjoint, parameters_adjoint);
    }
}
