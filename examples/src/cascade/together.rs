//! Starts that move together, in the lanes of vector registers.

use branched_pendulum::prelude::*;

use super::motor::Motor;
use super::scene::RodTree;

/// Angles, velocities or accelerations: for each link one number a start.
type Values = Vec<Vec<f64>>;

/// Some starts under motors of their own, by the classical Runge–Kutta method. All have
/// one time. Their bits do not depend on who moves along.
#[derive(Debug)]
pub struct Together<'a, P> {
    batch: Batch<'a, P, f64>,
    motors: Vec<&'a Motor>,
    theta: Values,
    omega: Values,
    torques: Values,
    /// Angles, velocities and accelerations of a stage.
    stage: [Values; 3],
    /// Sums of the velocities and accelerations of the stages.
    sums: [Values; 2],
}

impl<'a, P: RodTree> Together<'a, P> {
    /// Starts from `states`, angles before velocities, each with its motor.
    pub fn new(tree: &'a P, starts: &[(&[f64], &'a Motor)]) -> Self {
        let zeros = || vec![vec![0.0; starts.len()]; tree.links()];
        let column = |number: usize| {
            let numbers = starts.iter().map(|(state, _)| state.get(number));
            numbers
                .map(|value| value.copied().unwrap_or(f64::NAN))
                .collect()
        };
        Self {
            batch: Batch::new(tree),
            motors: starts.iter().map(|(_, motor)| *motor).collect(),
            theta: (0..tree.links()).map(column).collect(),
            omega: (tree.links()..2 * tree.links()).map(column).collect(),
            torques: zeros(),
            stage: [zeros(), zeros(), zeros()],
            sums: [zeros(), zeros()],
        }
    }

    /// Makes a step of the length `step`, s.
    pub fn step(&mut self, time: f64, step: f64) {
        for (part, weight) in [(0.0, 1.0), (0.5, 2.0), (0.5, 2.0), (1.0, 1.0)] {
            self.stage(part * step);
            self.accelerate(time + part * step);
            let [_, omega, alpha] = &self.stage;
            for (sums, values) in self.sums.iter_mut().zip([omega, alpha]) {
                for (sums, values) in sums.iter_mut().zip(values) {
                    for (sum, value) in sums.iter_mut().zip(values) {
                        *sum = if part == 0.0 {
                            *value
                        } else {
                            *sum + weight * value
                        };
                    }
                }
            }
        }
        let sixth = step / 6.0;
        for (values, sums) in [&mut self.theta, &mut self.omega]
            .into_iter()
            .zip(&self.sums)
        {
            for (values, sums) in values.iter_mut().zip(sums) {
                for (value, sum) in values.iter_mut().zip(sums) {
                    *value += sixth * sum;
                }
            }
        }
    }

    /// Moves the state of the stage to `reach` behind the start of the step, along the rates of the
    /// stage before.
    fn stage(&mut self, reach: f64) {
        let [theta, omega, alpha] = &mut self.stage;
        for link in 0..self.theta.len() {
            let own = (&mut theta[link], &mut omega[link], &alpha[link]);
            for (start, &angle) in self.theta[link].iter().enumerate() {
                let velocity = self.omega[link][start];
                own.0[start] = angle + reach * if reach == 0.0 { 0.0 } else { own.1[start] };
                own.1[start] = velocity + reach * own.2[start];
            }
        }
    }

    /// Computes the accelerations of the stage.
    fn accelerate(&mut self, time: f64) {
        for (start, motor) in self.motors.iter().enumerate() {
            self.torques[0][start] = motor.torque(time);
        }
        let [theta, omega, alpha] = &mut self.stage;
        let arguments = [&theta[..], &omega[..], &self.torques[..]];
        if self
            .batch
            .accelerations_under(time, arguments, alpha)
            .is_err()
        {
            // Lengths are right by construction; a run of NaN ends with an error.
            alpha.iter_mut().for_each(|values| values.fill(f64::NAN));
        }
    }

    /// The state of a start, angles before velocities.
    pub fn state(&self, start: usize) -> Vec<f64> {
        let links = self.theta.iter().chain(&self.omega);
        links.map(|values| values[start]).collect()
    }
}
