//! Torques that stay as they are.

use alloc::vec;
use alloc::vec::Vec;

use crate::scalar::{Real, Scalar};
use crate::system::{Forced, Ode};

/// A pendulum in absolute angles under torques (N m) that stay until the caller changes
/// them: between two frames of [`Frames`](super::Frames), for example.
///
/// Torques that follow time and state by themselves are those of
/// [`UnderTorques`](crate::system::UnderTorques).
#[derive(Clone, Debug)]
pub struct HeldTorques<P, T> {
    pendulum: P,
    torques: Vec<T>,
}

impl<P: Forced<T>, T: Real> HeldTorques<P, T> {
    /// The pendulum, or a reference to one, under no torques.
    pub fn new(pendulum: P) -> Self {
        Self {
            pendulum,
            torques: vec![T::ZERO; P::LINKS],
        }
    }

    /// The pendulum.
    pub fn pendulum(&self) -> &P {
        &self.pendulum
    }

    /// The torques, one for each link.
    pub fn torques(&self) -> &[T] {
        &self.torques
    }

    /// The torques, to change them.
    pub fn torques_mut(&mut self) -> &mut [T] {
        &mut self.torques
    }
}

impl<P: Forced<T>, T: Scalar> Ode<T> for HeldTorques<P, T> {
    fn dimension(&self) -> usize {
        2 * P::LINKS
    }

    #[inline]
    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        let links = P::LINKS;
        if state.len() != 2 * links || rates.len() != 2 * links {
            rates.fill(T::from_f64(f64::NAN));
            return;
        }
        let (theta, omega) = state.split_at(links);
        let (velocities, alpha) = rates.split_at_mut(links);
        velocities.copy_from_slice(omega);
        self.pendulum
            .accelerations_under_into(time, theta, omega, &self.torques, alpha);
    }
}
