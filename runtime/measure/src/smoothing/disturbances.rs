//! What disturbs a motion from time to time, as a smoother estimates it.
//!
//! S. J. Koopman, *Disturbance smoother for state space models*, Biometrika 80 (1993).

use nalgebra::{SMatrix, SVector};

use super::gaussian::Innovation;

/// A time of a filter, and the step that leads to it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct DisturbedStep<const D: usize> {
    /// Derivative of the step from the time before.
    pub(super) transition: SMatrix<f64, D, D>,
    /// Variance that disturbances add on the way, for data of a variance of 1.
    pub(super) variance: SMatrix<f64, D, D>,
    /// Innovations by the data of the time, in the order in which they were taken.
    pub(super) data: Vec<Innovation<D>>,
}

/// What tells the disturbances of a motion.
#[derive(Clone, Debug, PartialEq, Default)]
pub(super) struct Disturbances<const D: usize> {
    pub(super) steps: Vec<DisturbedStep<D>>,
    /// Unit vectors of what constants that were fitted explain of the innovations.
    pub(super) explained: Vec<Vec<f64>>,
}

impl<const D: usize> Disturbances<D> {
    /// Returns the changes of the state that the likeliest disturbances make in each step, by
    /// all innovations over the roots of their variances for data of a variance of 1.
    pub(super) fn likeliest(&self, innovations: &[f64]) -> Vec<[f64; D]> {
        let mut innovations = innovations.iter().rev();
        // What a change of the state would gain by all later data: r of physics (16.2).
        let mut pull = SVector::<f64, D>::zeros();
        let changes = self.steps.iter().rev().map(|step| {
            for (datum, innovation) in step.data.iter().rev().zip(&mut innovations) {
                pull[datum.component] += innovation / datum.variance.sqrt() - datum.gain.dot(&pull);
            }
            let change = step.variance * pull;
            pull = step.transition.transpose() * pull;
            change.into()
        });
        let mut changes: Vec<[f64; D]> = changes.collect();
        changes.reverse();
        changes
    }

    /// Returns those that noise alone feigns where nothing disturbs the motion: `noise` gives
    /// that of a datum.
    pub(super) fn spurious(&self, mut noise: impl FnMut() -> f64) -> Vec<[f64; D]> {
        let mut state = SVector::<f64, D>::zeros();
        let mut innovations = Vec::new();
        for step in &self.steps {
            state = step.transition * state;
            for datum in &step.data {
                let innovation = noise() - state[datum.component];
                state += datum.gain * innovation;
                innovations.push(innovation / datum.variance.sqrt());
            }
        }
        for direction in &self.explained {
            let parts = innovations.iter().zip(direction);
            let along: f64 = parts.map(|(innovation, unit)| innovation * unit).sum();
            for (innovation, unit) in innovations.iter_mut().zip(direction) {
                *innovation -= along * unit;
            }
        }
        self.likeliest(&innovations)
    }
}
