//! Energies.

use super::by_reference::by_reference;
use super::{Pendulum, Workspace};
use crate::scalar::Scalar;

/// Kinetic and potential energy in absolute angles, in joules.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not know its energies in `{T}`",
    note = "a model knows them with `emit(energies)` in its attribute"
)]
pub trait Energy<T: Scalar>: Pendulum<T> {
    /// Kinetic energy for angles `theta` (rad) and angular velocities `omega`
    /// (rad/s), one of each a link; NaN for slices of another length.
    fn kinetic_energy_of(&self, theta: &[T], omega: &[T]) -> T;

    /// Potential energy for angles `theta` (rad), one a link; zero where all angles are zero
    /// and the springs at rest. NaN for a slice of another length.
    fn potential_energy_of(&self, theta: &[T]) -> T;

    /// Returns the energy K + U.
    #[inline]
    fn energy_of(&self, theta: &[T], omega: &[T]) -> T {
        self.kinetic_energy_of(theta, omega) + self.potential_energy_of(theta)
    }

    /// Returns the kinetic energy, in memory that the caller keeps: trees in loops
    /// need some, and allocate it for every call of
    /// [`kinetic_energy_of`](Self::kinetic_energy_of).
    #[inline]
    fn kinetic_energy_with(&self, workspace: &mut Workspace<T>, theta: &[T], omega: &[T]) -> T {
        let _ = workspace;
        self.kinetic_energy_of(theta, omega)
    }

    /// Returns the potential energy, in memory that the caller keeps.
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
