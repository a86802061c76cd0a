//! Trait of models that compute their energies.

use super::by_reference::by_reference;
use super::{Pendulum, Workspace};
use crate::scalar::Scalar;

/// Kinetic and potential energy in absolute angles, in joules.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not know its energies in `{T}`",
    note = "a model knows them with `emit(energies)` in its attribute"
)]
pub trait Energy<T: Scalar>: Pendulum<T> {
    /// Returns the kinetic energy for angles `theta` (rad) and angular velocities `omega` (rad/s),
    /// with one value for each link; NaN for slices of a wrong length.
    fn kinetic_energy_of(&self, theta: &[T], omega: &[T]) -> T;

    /// Returns the potential energy for angles `theta` (rad), with one value for each link. It is
    /// zero if all angles are zero and the springs are relaxed. NaN for a slice of a wrong length.
    fn potential_energy_of(&self, theta: &[T]) -> T;

    /// Returns the sum of kinetic and potential energy.
    #[inline]
    fn energy_of(&self, theta: &[T], omega: &[T]) -> T {
        self.kinetic_energy_of(theta, omega) + self.potential_energy_of(theta)
    }

    /// Returns the kinetic energy like [`kinetic_energy_of`](Self::kinetic_energy_of), with a
    /// workspace that the caller keeps. Trees computed in loops need this memory; without it they
    /// would allocate it in every call.
    #[inline]
    fn kinetic_energy_with(&self, workspace: &mut Workspace<T>, theta: &[T], omega: &[T]) -> T {
        let _ = workspace;
        self.kinetic_energy_of(theta, omega)
    }

    /// Returns the potential energy like [`potential_energy_of`](Self::potential_energy_of), with a
    /// workspace that the caller keeps.
    #[inline]
    fn potential_energy_with(&self, workspace: &mut Workspace<T>, theta: &[T]) -> T {
        let _ = workspace;
        self.potential_energy_of(theta)
    }
}

by_reference! {
    impl<T: Scalar> Energy<T> for &P {
        fn kinetic_energy_of(&self, theta: &[T], omega: &[T]) -> T;
        fn potential_energy_of(&self, theta: &[T]) -> T;
        fn energy_of(&self, theta: &[T], omega: &[T]) -> T;
        fn kinetic_energy_with(
            &self, workspace: &mut Workspace<T>, theta: &[T], omega: &[T]
        ) -> T;
        fn potential_energy_with(&self, workspace: &mut Workspace<T>, theta: &[T]) -> T;
    }
}
