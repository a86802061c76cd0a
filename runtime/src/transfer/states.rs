//! Conversions between velocities and momenta of a state, and its energy H.

use super::memory::FreeMemory;
use super::motion::{TreeMotion, factors, workspace_len};
use super::{NonConservative, StateInput, SymmetricTree};
use crate::scalar::Scalar;
use crate::sectors::{Normalisation, Sectors};
use crate::system::Workspace;

impl<T: Scalar> SymmetricTree<T> {
    /// Writes the momenta (kg m²/s) of the symmetric coordinates; NaN if a slice does not have one
    /// number per link.
    pub fn momenta(
        &self,
        workspace: &mut Workspace<T>,
        given: StateInput<'_, T>,
        momenta: &mut [T],
    ) {
        self.write(workspace, given, momenta, |motion, momenta| {
            momenta.copy_from_slice(motion.momenta);
        });
    }

    /// Writes the symmetric coordinates (rad); NaN if a slice does not have one number per link.
    pub fn coordinates(
        &self,
        workspace: &mut Workspace<T>,
        given: StateInput<'_, T>,
        coordinates: &mut [T],
    ) {
        self.write(workspace, given, coordinates, |motion, coordinates| {
            self.symmetric_from_absolute(Normalisation::Plain, motion.theta, coordinates);
        });
    }

    /// Writes the rates (rad/s) of the symmetric coordinates; NaN if a slice does not have one
    /// number per link.
    pub fn rates(&self, workspace: &mut Workspace<T>, given: StateInput<'_, T>, rates: &mut [T]) {
        self.write(workspace, given, rates, |motion, rates| {
            self.symmetric_from_absolute(Normalisation::Plain, motion.omega, rates);
        });
    }

    /// Writes the angles (rad) and the angular velocities (rad/s) of the links; NaN if a slice does
    /// not have one number per link.
    pub fn absolute(
        &self,
        workspace: &mut Workspace<T>,
        given: StateInput<'_, T>,
        [theta, omega]: [&mut [T]; 2],
    ) {
        self.write(workspace, given, theta, |motion, theta| {
            theta.copy_from_slice(motion.theta);
        });
        self.write(workspace, given, omega, |motion, omega| {
            omega.copy_from_slice(motion.omega);
        });
    }

    /// Writes the accelerations M⁻¹ Q (rad/s²) of the links that the forces Q (friction, drive,
    /// external torques) add to those caused by gravity and springs. NaN if a slice does not have
    /// one number per link.
    pub fn accelerations_by(
        &self,
        workspace: &mut Workspace<T>,
        acting: NonConservative<'_, T>,
        given: StateInput<'_, T>,
        accelerations: &mut [T],
    ) {
        let mut memory = FreeMemory(workspace.numbers(self.state_workspace_len()));
        match self.motion(given, &mut memory) {
            Some(motion) if accelerations.len() == self.links() => {
                accelerations.fill(T::from_f64(0.0));
                self.add_forces(acting, &motion, accelerations);
                self.solve(&self.whole, motion.matrix, accelerations, memory);
            }
            _ => accelerations.fill(T::from_f64(f64::NAN)),
        }
    }

    /// Returns the energy H = K + U (J), which is zero if all angles are zero, nothing moves and
    /// the springs are at rest; NaN if a slice does not have one number per link.
    #[must_use]
    pub fn hamiltonian(&self, workspace: &mut Workspace<T>, given: StateInput<'_, T>) -> T {
        let [kinetic, potential] = self.kinetic_and_potential_energy(workspace, given);
        kinetic + potential
    }

    /// Returns K and U (J), the terms of [`hamiltonian`](Self::hamiltonian).
    #[must_use]
    pub fn kinetic_and_potential_energy(
        &self,
        workspace: &mut Workspace<T>,
        given: StateInput<'_, T>,
    ) -> [T; 2] {
        let mut memory = FreeMemory(workspace.numbers(self.state_workspace_len()));
        let Some(motion) = self.motion(given, &mut memory) else {
            return [T::from_f64(f64::NAN); 2];
        };
        let momenta = memory.take(self.links());
        self.write_absolute_momenta(&motion, momenta);
        let pairs = momenta.iter().zip(motion.omega);
        let twice = pairs.fold(T::from_f64(0.0), |sum, (&p, &omega)| sum + p * omega);
        [T::from_f64(0.5) * twice, self.potential_energy(&motion)]
    }

    /// Writes the momenta that belong to the absolute angles of the links.
    pub(super) fn write_absolute_momenta(&self, motion: &TreeMotion<'_, T>, momenta: &mut [T]) {
        let plain = Normalisation::Plain;
        self.absolute_momenta_from_symmetric(plain, motion.momenta, momenta);
    }

    fn write(
        &self,
        workspace: &mut Workspace<T>,
        given: StateInput<'_, T>,
        values: &mut [T],
        write: impl FnOnce(&TreeMotion<'_, T>, &mut [T]),
    ) {
        let mut memory = FreeMemory(workspace.numbers(self.state_workspace_len()));
        match self.motion(given, &mut memory) {
            Some(motion) if values.len() == self.links() => write(&motion, values),
            _ => values.fill(T::from_f64(f64::NAN)),
        }
    }

    fn state_workspace_len(&self) -> usize {
        let (links, entries) = (self.links(), self.shape.pattern.entries());
        workspace_len(links, entries) + links + factors(links, entries)
    }
}
