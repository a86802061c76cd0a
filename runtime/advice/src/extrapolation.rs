//! Extrapolation of the modified midpoint rule, for references. Its coefficients are ratios of
//! integers, so that its accuracy is limited only by the type of numbers. It integrates any system
//! of first-order equations.
//!
//! Source: E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*,
//! section II.9 (Gragg, Bulirsch, Stoer).

use std::error::Error;
use std::fmt;

use branched_pendulum::interruption;
use branched_pendulum::scalar::Real;
use branched_pendulum::system::{Ode, Workspace};

/// Largest number of rows of the extrapolation table (order 24).
const ROWS: usize = 12;

/// Row of the table at which steps should converge; the step length is chosen for it.
const AIM: usize = 9;

/// Returns the number of parts into which row `row` of the table divides a step.
const fn parts(row: usize) -> u32 {
    2 * (row as u32 + 1)
}

/// Error: a step does not reach its tolerance at any length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Unreachable {
    /// Start of the step, in s.
    time: f64,
}

impl fmt::Display for Unreachable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "no step leads on from t = {} s", self.time)
    }
}

impl Error for Unreachable {}

/// Integrates `state` from `time` through all `times`, and calls `visit` at each. The error of a
/// step stays below `tolerance`, relative to each component down to a thousandth.
pub(crate) fn extrapolate<T: Real, O: Ode<T> + ?Sized>(
    ode: &O,
    mut time: f64,
    state: &mut [T],
    times: &[f64],
    tolerance: f64,
    mut visit: impl FnMut(usize, &[T]),
) -> Result<(), Unreachable> {
    let mut table = ExtrapolatedStep::new(ode, state.len());
    let mut longest = f64::INFINITY;
    for (number, &goal) in times.iter().enumerate() {
        // Times of steps are rounded; the last step ends exactly at the goal.
        while time != goal {
            let step = (goal - time).abs().min(longest).copysign(goal - time);
            let end = if step.abs() < (goal - time).abs() {
                time + step
            } else {
                goal
            };
            if end == time {
                return Err(Unreachable { time });
            }
            let (reached, factor) = table.step(time, end, state, tolerance);
            if reached {
                state.copy_from_slice(table.best());
                time = end;
                longest = longest.max(factor * step.abs());
            } else {
                longest = factor * step.abs();
            }
        }
        visit(number, state);
    }
    Ok(())
}

/// Workspace of one extrapolated step.
struct ExtrapolatedStep<'a, T, O: ?Sized> {
    ode: &'a O,
    workspace: Workspace<T>,
    /// Last row of the extrapolation table; its last entry is the best value.
    columns: Vec<Vec<T>>,
    start_rates: Vec<T>,
    rates: Vec<T>,
    before: Vec<T>,
    now: Vec<T>,
}

impl<'a, T: Real, O: Ode<T> + ?Sized> ExtrapolatedStep<'a, T, O> {
    fn new(ode: &'a O, dimension: usize) -> Self {
        let zeros = || vec![T::ZERO; dimension];
        Self {
            ode,
            workspace: Workspace::new(),
            columns: (0..ROWS).map(|_| zeros()).collect(),
            start_rates: zeros(),
            rates: zeros(),
            before: zeros(),
            now: zeros(),
        }
    }

    /// Returns the best extrapolated value.
    fn best(&self) -> &[T] {
        &self.now
    }

    /// Makes a step. Returns whether its error is below the tolerance, and the ratio of the next
    /// step length to this one.
    fn step(&mut self, time: f64, end: f64, state: &[T], tolerance: f64) -> (bool, f64) {
        let from = T::from_f64(time);
        let length = T::from_f64(end) - from;
        self.ode
            .rates_with(&mut self.workspace, from, state, &mut self.start_rates);
        let mut error = f64::INFINITY;
        for row in 0..ROWS {
            interruption::look();
            self.midpoint(from, length, state, parts(row));
            // Neville's scheme in h², applied to the row before.
            error = 0.0;
            for (i, value) in state.iter().enumerate() {
                let mut entry = self.now[i];
                for column in 0..row {
                    let above = std::mem::replace(&mut self.columns[column][i], entry);
                    let ratio = T::from_f64(f64::from(parts(row)))
                        / T::from_f64(f64::from(parts(row - column - 1)));
                    entry = entry + (entry - above) / (ratio * ratio - T::ONE);
                    let change = (entry - self.columns[column][i]).to_f64().abs();
                    if column + 1 == row {
                        let size = value.to_f64().abs() + 1e-3;
                        // A NaN error must not pass.
                        error = match change.is_finite() {
                            true => f64::max(error, change / (tolerance * size)),
                            false => f64::INFINITY,
                        };
                    }
                }
                self.columns[row][i] = entry;
                self.now[i] = entry;
            }
            if row > 2 && error <= 1.0 {
                let spare = if row < AIM { 2.0 } else { 1.2 };
                return (true, spare);
            }
        }
        let order = 2.0 * ROWS as f64 - 1.0;
        let factor = 0.8 * error.powf(-1.0 / order);
        (false, if factor > 0.1 { factor.min(0.8) } else { 0.1 })
    }

    /// Computes the modified midpoint rule with `parts` substeps; the result is stored in `now`.
    fn midpoint(&mut self, from: T, length: T, state: &[T], parts: u32) {
        let part = length / T::from_f64(f64::from(parts));
        let twice = part + part;
        self.before.copy_from_slice(state);
        for ((now, y), rate) in self.now.iter_mut().zip(state).zip(&self.start_rates) {
            *now = *y + part * *rate;
        }
        for number in 1..parts {
            let time = from + part * T::from_f64(f64::from(number));
            self.ode
                .rates_with(&mut self.workspace, time, &self.now, &mut self.rates);
            for ((before, now), rate) in self.before.iter_mut().zip(&mut self.now).zip(&self.rates)
            {
                let next = *before + twice * *rate;
                *before = std::mem::replace(now, next);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::extrapolate;
    use branched_pendulum::scalar::{Double, Real, Scalar};
    use branched_pendulum::system::OdeFn;

    /// Integrates an oscillator in double-double numbers at uneven times, and compares it with the
    /// exact sines.
    #[test]
    fn an_oscillator_keeps_the_digits_of_its_numbers() {
        let ode = OdeFn::new(2, |_: Double, y: &[Double], rates: &mut [Double]| {
            rates[0] = y[1];
            rates[1] = -y[0];
        });
        let times = [0.1, 3.0, 3.001, 20.0];
        let mut state = [Double::ZERO, Double::ONE];
        let mut worst = 0.0_f64;
        extrapolate(&ode, 0.0, &mut state, &times, 1e-26, |number, state| {
            let (sin, cos) = Double::from_f64(times[number]).sin_cos();
            for (found, exact) in state.iter().zip([sin, cos]) {
                worst = worst.max((*found - exact).to_f64().abs());
            }
        })
        .unwrap();
        assert!(worst < 1e-24, "{worst:e}");
    }

    #[test]
    fn rates_that_are_not_finite_end_it() {
        let ode = OdeFn::new(1, |_: f64, _: &[f64], rates: &mut [f64]| {
            rates[0] = f64::NAN
        });
        assert!(extrapolate(&ode, 0.0, &mut [1.0], &[1.0], 1e-10, |_, _| {}).is_err());
    }
}
