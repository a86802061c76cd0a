//! Constants that act on a motion, found beside a filter that runs without them.
//!
//! Constants move the expected data linearly, so that the filter runs once, without any, and
//! takes along what each would do: a regression of the innovations finds them (B. Friedland,
//! *Treatment of bias in recursive filtering*, IEEE Transactions on Automatic Control 14 (1969)).

use nalgebra::{DMatrix, DVector, Dyn};

use super::gaussian::{Innovations, Step};

/// Changes of the state at one time by constants of one, a column each: before and after the data
/// of the time.
#[derive(Clone, Debug)]
pub(super) struct StepEffects {
    pub(super) predicted: DMatrix<f64>,
    pub(super) updated: DMatrix<f64>,
}

/// Constants that were fitted.
#[derive(Clone, Debug)]
pub(super) struct FittedConstants {
    /// Zero for those that the data do not ask for.
    pub(super) values: DVector<f64>,
    /// A root of their variance, for data of a standard deviation of 1.
    root: DMatrix<f64>,
}

impl FittedConstants {
    /// Fits constants to innovations, of which each moves by its row times them, in its
    /// deviations; takes what they explain out of the innovations. One after the other is
    /// taken, the one that gains most first, until none is worth its number.
    ///
    /// `noise` is the standard deviation of the data, where it is known.
    pub(super) fn fit(
        innovations: &mut Innovations,
        rows: &[DVector<f64>],
        noise: Option<f64>,
    ) -> Self {
        let count = rows.first().map_or(0, |row| row.len());
        let mut found = Self {
            values: DVector::zeros(count),
            root: DMatrix::zeros(count, count),
        };
        let (mut information, mut pull) = (found.root.clone(), found.values.clone());
        let used = rows.iter().zip(&innovations.standard);
        for (row, value) in used.skip(innovations.free) {
            information.ger(1.0, row, row, 1.0);
            pull.axpy(*value, row, 1.0);
        }
        let all = innovations.clone();
        let mut taken = vec![false; count];
        loop {
            let mut better = None;
            let mut best = innovations.log_likelihood(noise);
            for one in (0..count).filter(|&one| !taken[one]) {
                let mut trial = taken.clone();
                trial[one] = true;
                let Some(constants) = Self::solve(&information, &pull, &trial) else {
                    continue;
                };
                let mut left = all.clone();
                left.constants = trial.iter().filter(|&&one| one).count();
                for (value, row) in left.standard.iter_mut().zip(rows) {
                    *value -= row.dot(&constants.values);
                }
                let likelihood = left.log_likelihood(noise);
                if likelihood > best {
                    best = likelihood;
                    better = Some((trial, constants, left));
                }
            }
            let Some(next) = better else {
                return found;
            };
            (taken, found, *innovations) = next;
        }
    }

    /// Least squares with those constants that are taken; none where they cannot be told apart.
    fn solve(information: &DMatrix<f64>, pull: &DVector<f64>, taken: &[bool]) -> Option<Self> {
        let count = taken.len();
        let own = DMatrix::from_fn(count, count, |i, j| match taken[i] && taken[j] {
            true => information[(i, j)],
            false => f64::from(u8::from(i == j)),
        });
        let factor = own.cholesky()?;
        let pull = DVector::from_fn(count, |i, _| if taken[i] { pull[i] } else { 0.0 });
        let mut root = factor.inverse().cholesky()?.l();
        for (one, _) in taken.iter().enumerate().filter(|(_, taken)| !**taken) {
            root.row_mut(one).fill(0.0);
        }
        Some(Self {
            values: factor.solve(&pull),
            root,
        })
    }

    /// Moves the states of a filter to where the constants take them.
    pub(super) fn move_steps(&self, steps: &mut [Step<Dyn>], effects: &[StepEffects]) {
        for (step, effects) in steps.iter_mut().zip(effects) {
            step.predicted.mean += &effects.predicted * &self.values;
            step.updated.mean += &effects.updated * &self.values;
        }
    }

    /// Returns the changes of the smoothed states by independent errors of one deviation of the
    /// constants: a series each.
    pub(super) fn errors(
        &self,
        gains: &[DMatrix<f64>],
        effects: &[StepEffects],
    ) -> Vec<Vec<Vec<f64>>> {
        let mut smoothed: Vec<_> = effects.iter().map(|own| own.updated.clone()).collect();
        for ((index, gain), next) in gains.iter().enumerate().zip(effects.iter().skip(1)).rev() {
            let learnt = &smoothed[index + 1] - &next.predicted;
            smoothed[index] += gain * learnt;
        }
        let of = |one: usize| {
            let direction = self.root.column(one);
            let states = smoothed.iter();
            states
                .map(|effects| (effects * direction).data.into())
                .collect()
        };
        self.known().map(of).collect()
    }

    /// Columns of the root that are not zero.
    fn known(&self) -> impl Iterator<Item = usize> {
        let is_known = |one: &usize| self.root.column(*one).iter().any(|&part| part != 0.0);
        (0..self.values.len()).filter(is_known)
    }

    /// Returns unit vectors of what the constants explain of the innovations they were fitted to.
    pub(super) fn explained(&self, rows: &[DVector<f64>]) -> Vec<Vec<f64>> {
        let of = |one: usize| {
            rows.iter()
                .map(|row| row.dot(&self.root.column(one)))
                .collect()
        };
        self.known().map(of).collect()
    }
}
