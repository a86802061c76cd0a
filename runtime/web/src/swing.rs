//! The equations of motion, together with the work done on the tree.

use branched_pendulum::system::{Model, Ode, Pendulum, Workspace};
use branched_pendulum_trees::PendulumTree;

use crate::hand::Hand;

/// A tree that the user's hand may hold. A state consists of the angles (rad), the angular
/// velocities (rad/s) and the work (J) done by friction, the drive and the hand. Energy minus work
/// would be constant; it changes only by the error of the method.
#[derive(Clone, Debug)]
pub(crate) struct Swing {
    pub(crate) tree: PendulumTree,
    pub(crate) hand: Option<Hand>,
}

impl Swing {
    /// Returns the torques of the hand (N m); `None` without a hand.
    pub(crate) fn torques(&self, theta: &[f64], omega: &[f64]) -> Option<Vec<f64>> {
        let hand = self.hand.as_ref()?;
        Some(hand.torques(&self.tree, theta, omega))
    }
}

/// Splits a state into angles, angular velocities and work; `None` if its length is wrong.
pub(crate) fn parts(state: &[f64]) -> Option<(&[f64], &[f64], f64)> {
    let (work, motion) = state.split_last()?;
    let (theta, omega) = motion.split_at(motion.len() / 2);
    (theta.len() == omega.len()).then_some((theta, omega, *work))
}

impl Ode<f64> for Swing {
    fn dimension(&self) -> usize {
        2 * self.tree.links() + 1
    }

    fn rates(&self, time: f64, state: &[f64], rates: &mut [f64]) {
        self.rates_with(&mut Workspace::new(), time, state, rates);
    }

    fn rates_with(
        &self,
        workspace: &mut Workspace<f64>,
        time: f64,
        state: &[f64],
        rates: &mut [f64],
    ) {
        let tree = &self.tree;
        let n = tree.links();
        let (Some((theta, omega, _)), Some((power, motion))) =
            (parts(state), rates.split_last_mut())
        else {
            return rates.fill(f64::NAN);
        };
        if theta.len() != n || motion.len() != 2 * n {
            return rates.fill(f64::NAN);
        }
        let (velocities, alpha) = motion.split_at_mut(n);
        velocities.copy_from_slice(omega);
        *power = tree.friction_power(theta, omega) + tree.drive_power(time, theta, omega);
        match self.torques(theta, omega) {
            None => tree.accelerations_with(workspace, time, theta, omega, alpha),
            Some(torques) => {
                *power += tree.outside_power(omega, &torques);
                tree.accelerations_under_with(workspace, time, theta, omega, &torques, alpha);
            }
        }
    }
}
