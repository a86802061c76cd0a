//! Disturbances that act on a motion in each step, estimated by a smoother.
//!
//! S. J. Koopman, *Disturbance smoother for state space models*, Biometrika 80 (1993).

use nalgebra::{DMatrix, DVector, Dyn};

use super::gaussian::{Innovation, Step};

/// State of the filter at one time, with the step from the previous time to it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct DisturbedStep {
    /// Derivative of the step from the time before.
    pub(super) transition: DMatrix<f64>,
    /// Covariance that disturbances add in the step, for data with a variance of 1.
    pub(super) variance: DMatrix<f64>,
    /// Innovations by the data of this time, in the order in which they were used.
    pub(super) data: Vec<Innovation<Dyn>>,
}

/// The steps of a filter, from which disturbances are estimated.
#[derive(Clone, Debug, PartialEq, Default)]
pub(super) struct Disturbances {
    pub(super) steps: Vec<DisturbedStep>,
    /// Orthonormal vectors that span the effects of fitted constants on the innovations.
    pub(super) explained: Vec<Vec<f64>>,
}

impl Disturbances {
    /// Creates the estimator from the steps of a filter, with the innovations by the data of each
    /// time.
    pub(super) fn new(
        steps: Vec<Step<Dyn>>,
        data: Vec<Vec<Innovation<Dyn>>>,
        explained: Vec<Vec<f64>>,
    ) -> Self {
        let steps = steps.into_iter().zip(data);
        let steps = steps.map(|(step, data)| DisturbedStep {
            transition: step.transition,
            variance: step.noise,
            data,
        });
        Self {
            steps: steps.collect(),
            explained,
        }
    }

    /// Returns the number of components of a state.
    fn size(&self) -> usize {
        self.steps.first().map_or(0, |step| step.variance.nrows())
    }

    /// Returns the changes of the state by the most likely disturbances in each step. `innovations`
    /// are divided by their standard deviations for data with a variance of 1.
    pub(super) fn likeliest(&self, innovations: &[f64]) -> Vec<Vec<f64>> {
        let mut innovations = innovations.iter().rev();
        // Gradient of the likelihood by a change of the state, from all later data: r of physics
        // (16.2).
        let mut pull = DVector::zeros(self.size());
        let changes = self.steps.iter().rev().map(|step| {
            for (datum, innovation) in step.data.iter().rev().zip(&mut innovations) {
                pull[datum.component] += innovation / datum.variance.sqrt() - datum.gain.dot(&pull);
            }
            let change = &step.variance * &pull;
            pull = step.transition.tr_mul(&pull);
            change.data.into()
        });
        let mut changes: Vec<Vec<f64>> = changes.collect();
        changes.reverse();
        changes
    }

    /// Returns the disturbances that noise alone would mimic in an undisturbed motion; `noise`
    /// returns the noise of one datum.
    pub(super) fn spurious(&self, mut noise: impl FnMut() -> f64) -> Vec<Vec<f64>> {
        let mut state = DVector::zeros(self.size());
        let mut innovations = Vec::new();
        for step in &self.steps {
            state = &step.transition * state;
            for datum in &step.data {
                let innovation = noise() - state[datum.component];
                state.axpy(innovation, &datum.gain, 1.0);
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
