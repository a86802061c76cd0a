//! Hamilton's equations.

use branched_pendulum::scalar::{Dual, Scalar};
use branched_pendulum::system::{Canonical, Forced, Model, Pendulum, Workspace};

use crate::tree::PendulumTree;

/// Velocities are what torques p less the velocities' own terms accelerate, and the rates of
/// the momenta are their derivative along the motion: of friction, springs and drive nothing
/// has to be known here. O(links²); allocates.
impl<T: Scalar> Canonical<T> for PendulumTree<T> {
    fn degrees_of_freedom(&self) -> usize {
        self.links()
    }

    fn canonical_rates(
        &self,
        time: T,
        theta: &[T],
        momenta: &[T],
        q_rates: &mut [T],
        p_rates: &mut [T],
    ) {
        let n = self.links();
        if [theta.len(), momenta.len(), q_rates.len(), p_rates.len()] != [n; 4] {
            for rates in [q_rates, p_rates] {
                rates.fill(T::from_f64(f64::NAN));
            }
            return;
        }
        // M ω = p: at rest M α = Q + torques that do not depend on Q.
        let workspace = &mut Workspace::new();
        let still = vec![T::from_f64(0.0); n];
        let mut without = still.clone();
        self.accelerations_with(workspace, time, theta, &still, &mut without);
        self.accelerations_under_with(workspace, time, theta, &still, momenta, q_rates);
        for (velocity, without) in q_rates.iter_mut().zip(&without) {
            *velocity = *velocity - *without;
        }
        let mut alpha = without;
        self.accelerations_with(workspace, time, theta, q_rates, &mut alpha);
        let along = |values: &[T], rates: &[T]| -> Vec<Dual<T, 1>> {
            let pairs = values.iter().zip(rates);
            let moving = |(&value, &rate): (&T, &T)| Dual {
                value,
                tangents: [rate],
            };
            pairs.map(moving).collect()
        };
        let (theta, omega) = (along(theta, q_rates), along(q_rates, &alpha));
        let moving = self.cast(Dual::<T, 1>::constant).momenta(&theta, &omega);
        for (rate, momentum) in p_rates.iter_mut().zip(moving) {
            [*rate] = momentum.tangents;
        }
    }
}
