//! Equations that return derivatives of their rates in reverse mode.

use alloc::vec::Vec;

use super::function::{At, Computes, functions};
use super::ode::halves;
use super::{AbsoluteAngles, Ode, Pendulum, Workspace};
use crate::scalar::Scalar;

/// Equations y' = f(t, y) that return the derivatives of Σ w_i f_i, a sum of their rates with
/// weights w.
///
/// [`AbsoluteAngles`] of a model has them if the description of the model requests
/// `emit(gradient(accelerations))`. They cost about as much as two evaluations of the rates,
/// for any number of components and parameters.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no derivatives in reverse mode",
    note = "models have them with `emit(gradient(accelerations))` in their attribute; equations of your own: implement `PullbackOde`"
)]
pub trait PullbackOde<T>: Ode<T> {
    /// Adds the derivatives of Σ w_i f_i by the state to `state_adjoint`, and those by the
    /// parameters to `parameters_adjoint`. `weights` are the w. All slices but the last have length
    /// [`dimension`](Ode::dimension); if a length is wrong, the derivatives are NaN.
    fn add_pullback(
        &self,
        workspace: &mut PullbackWorkspace<T>,
        time: T,
        state: &[T],
        weights: &[T],
        state_adjoint: &mut [T],
        parameters_adjoint: &mut [T],
    );
}

/// Memory of derivatives in reverse mode, which the caller keeps from one evaluation to the next.
#[derive(Clone, Debug)]
pub struct PullbackWorkspace<T> {
    equations: Workspace<T>,
    derivatives: Vec<T>,
}

impl<T: Scalar> PullbackWorkspace<T> {
    /// Creates an empty workspace, which the first evaluation fills.
    pub fn new() -> Self {
        Self {
            equations: Workspace::new(),
            derivatives: Vec::new(),
        }
    }

    /// Returns the memory of the equations themselves, and `len` numbers, which have no meaning at
    /// first.
    pub fn parts(&mut self, len: usize) -> (&mut Workspace<T>, &mut [T]) {
        let Self {
            equations,
            derivatives,
        } = self;
        derivatives.resize(len, T::from_f64(f64::NAN));
        (equations, derivatives)
    }
}

impl<T: Scalar> Default for PullbackWorkspace<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T, P> PullbackOde<T> for AbsoluteAngles<P>
where
    T: Scalar,
    P: Pendulum<T> + Computes<functions::AccelerationsPullback, T>,
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
        let links = self.0.links();
        let nan = T::from_f64(f64::NAN);
        let Some(([theta, omega], adjoints)) = halves(links, state, state_adjoint) else {
            return parameters_adjoint.fill(nan);
        };
        if weights.len() != 2 * links {
            adjoints.into_iter().for_each(|adjoint| adjoint.fill(nan));
            return parameters_adjoint.fill(nan);
        }
        let (of_angles, of_velocities) = weights.split_at(links);
        let (equations, derivatives) = workspace.parts(2 * links + parameters_adjoint.len());
        let (by_theta, rest) = derivatives.split_at_mut(links);
        let (by_omega, by_parameters) = rest.split_at_mut(links);
        Computes::<functions::AccelerationsPullback, T>::compute_with(
            &self.0,
            equations,
            At::time(time),
            &[theta, omega, of_velocities],
            &mut [&mut *by_theta, &mut *by_omega, &mut *by_parameters],
        );
        let [theta_adjoint, omega_adjoint] = adjoints;
        add(theta_adjoint, by_theta);
        add(omega_adjoint, by_omega);
        // The rates of the angles are the velocities.
        add(omega_adjoint, of_angles);
        add(parameters_adjoint, by_parameters);
    }
}

/// Adds numbers to a slice of the same length.
fn add<T: Scalar>(sum: &mut [T], more: &[T]) {
    for (sum, more) in sum.iter_mut().zip(more) {
        *sum = *sum + *more;
    }
}
