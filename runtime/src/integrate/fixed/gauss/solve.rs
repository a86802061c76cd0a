//! Solving for the rates of the stages: K_i = f(t + c_i h, y + h Σ_j a_ij K_j).

use super::Solver;
use super::step::GaussStep;
use crate::integrate::evaluator::Evaluator;
use crate::integrate::steps::Failure;
use crate::scalar::{Real, Scalar};
use crate::system::Ode;

/// Below this, in units of rounding, a change that does not fall is rounding.
const ROUNDING: f64 = 1e2;

/// Below this, a change that has not fallen for two rounds is rounding too.
const NOISE: f64 = 1e4;

/// A fixed point that comes no nearer in more rounds than these is none.
const PATIENCE: u32 = 3;

/// Rates that are not finite after a relative change above this are those of an
/// iterate that ran away.
const RUNAWAY: f64 = 1e-3;

/// A matrix of derivatives that took more rounds than this is made anew.
const STALE: u32 = 8;

impl<T: Real> GaussStep<T> {
    /// Iterates the rates of the stages, from their increments in place, until
    /// the change is zero or rounding.
    pub(super) fn solve<O: Ode<T> + ?Sized>(
        &mut self,
        system: &mut Evaluator<'_, T, O>,
        time: T,
        step: T,
    ) -> Result<(), Failure<T>> {
        self.evaluate(system, time, step)?;
        core::mem::swap(&mut self.rates, &mut self.change);
        if self.solver == Solver::Newton && self.newton_step != step {
            self.newton_step = T::ZERO;
            self.differentiate(system, time, step)?;
        }
        let rounding = T::from_f64(ROUNDING) * T::EPSILON;
        let noise = T::from_f64(NOISE) * T::EPSILON;
        let mut best = T::ONE / T::ZERO;
        let (mut without_progress, mut last) = (0, best);
        for round in 1..=self.iteration_limit {
            self.increments(step);
            if let Err(failure) = self.evaluate(system, time, step) {
                // An iterate that ran away says nothing about the equations.
                if last > T::from_f64(RUNAWAY) {
                    return self.give_up(step, round, last);
                }
                return Err(failure);
            }
            let change = self.update(step);
            last = change;
            if change < best {
                best = change;
                without_progress = 0;
            } else {
                without_progress += 1;
            }
            // Where the change no longer falls, rounding is all that is left.
            // It may fall in every second round only.
            let settled = change <= self.tolerance
                || (without_progress == 1 && change <= rounding)
                || (without_progress > 1 && change <= noise);
            if settled {
                if round > STALE {
                    self.newton_step = T::ZERO;
                }
                return Ok(());
            }
            if without_progress > PATIENCE {
                return self.give_up(step, round, change);
            }
        }
        self.give_up(step, self.iteration_limit, best)
    }

    fn give_up(&mut self, step: T, iterations: u32, change: T) -> Result<(), Failure<T>> {
        self.newton_step = T::ZERO;
        Err(Failure::NotSolved {
            step: step.abs(),
            iterations,
            change,
        })
    }

    /// h Σ_j a_ij K_j, and the residue of the start.
    fn increments(&mut self, step: T) {
        let (n, s) = (self.start.len(), self.table.nodes.len());
        for (i, row) in self.table.matrix.chunks(s).enumerate() {
            for k in 0..n {
                let (mut main, mut rest) = (T::ZERO, T::ZERO);
                for (j, &(large, small)) in row.iter().enumerate() {
                    main += T::from_f64(large) * self.rates[j * n + k];
                    rest += T::from_f64(small) * self.rates[j * n + k];
                }
                self.increments[i * n + k] = step * main + (step * rest + self.residue[k]);
            }
        }
    }

    /// Rates at the stages' states, into `change`.
    fn evaluate<O: Ode<T> + ?Sized>(
        &mut self,
        system: &mut Evaluator<'_, T, O>,
        time: T,
        step: T,
    ) -> Result<(), Failure<T>> {
        let n = self.start.len();
        for (i, &node) in self.table.nodes.iter().enumerate() {
            for (k, value) in self.stage.iter_mut().enumerate() {
                *value = self.start[k] + self.increments[i * n + k];
            }
            let rates = &mut self.change[i * n..(i + 1) * n];
            let at = time + T::from_f64(node) * step;
            if let Err(place) = system.evaluate(at, &self.stage, rates) {
                self.newton_step = T::ZERO;
                return Err(place.into());
            }
        }
        Ok(())
    }

    /// Moves the rates to the new ones in `change`; returns the largest change
    /// of an increment, relative to the size of its component.
    fn update(&mut self, step: T) -> T {
        let n = self.start.len();
        for (new, &old) in self.change.iter_mut().zip(&self.rates) {
            *new = *new - old;
        }
        if self.solver == Solver::Newton {
            self.newton.solve(&mut self.change);
        }
        let mut largest = T::ZERO;
        for (index, (rate, &change)) in self.rates.iter_mut().zip(&self.change).enumerate() {
            *rate += change;
            if change != T::ZERO {
                let size = self.sizes[index % n].max((step * *rate).abs());
                let ratio = (step * change).abs() / size;
                largest = largest.max(ratio);
            }
        }
        largest
    }

    /// Derivatives of the rates in the middle of the step, by differences, and
    /// the matrix 1 − h a ⊗ ∂f/∂y of Newton's method.
    fn differentiate<O: Ode<T> + ?Sized>(
        &mut self,
        system: &mut Evaluator<'_, T, O>,
        time: T,
        step: T,
    ) -> Result<(), Failure<T>> {
        let (n, s) = (self.start.len(), self.table.nodes.len());
        let middle = time + T::from_f64(0.5) * step;
        self.stage.copy_from_slice(&self.start);
        system.write(middle, &self.stage, &mut self.other);
        let root = Scalar::sqrt(T::EPSILON);
        for column in 0..n {
            let value = self.stage[column];
            let shifted = value + root * (T::ONE + value.abs());
            let difference = shifted - value;
            self.stage[column] = shifted;
            // Into the first rows of `increments`, which are made anew later.
            let rates = &mut self.increments[..n];
            system.write(middle, &self.stage, rates);
            for (row, (&rate, &other)) in rates.iter().zip(&self.other).enumerate() {
                self.derivatives[row * n + column] = (rate - other) / difference;
            }
            self.stage[column] = value;
        }
        let size = n * s;
        for (i, row) in self.table.matrix.chunks(s).enumerate() {
            for (j, &(large, small)) in row.iter().enumerate() {
                let weight = step * T::from_f64(large + small);
                for k in 0..n {
                    for l in 0..n {
                        let same = i == j && k == l;
                        let one = if same { T::ONE } else { T::ZERO };
                        self.newton.entries[(i * n + k) * size + j * n + l] =
                            one - weight * self.derivatives[k * n + l];
                    }
                }
            }
        }
        if !self.newton.factorise() {
            return self.give_up(step, 0, T::NAN);
        }
        self.newton_step = step;
        Ok(())
    }
}
