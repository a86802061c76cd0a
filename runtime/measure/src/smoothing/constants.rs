//! Constants that act on a motion, estimated from a filter that runs without them.
//!
//! The expected data depend linearly on the constants. Therefore the filter runs once, with all
//! constants zero, and computes their effects too: a regression of the innovations estimates them
//! (B. Friedland, *Treatment of bias in recursive filtering*, IEEE Transactions on Automatic
//! Control 14 (1969)).

use nalgebra::{DMatrix, DVector, Dyn};

use super::gaussian::{Innovations, Step};

/// Changes of the state at one time caused by constants with the value 1, one column per constant:
/// before and after the data of that time are used.
#[derive(Clone, Debug)]
pub(super) struct StepEffects {
    pub(super) predicted: DMatrix<f64>,
    pub(super) updated: DMatrix<f64>,
}

/// Constants that have been fitted.
#[derive(Clone, Debug)]
pub(super) struct FittedConstants {
    /// Values of the constants; zero for those that do not improve the likelihood enough.
    pub(super) values: DVector<f64>,
    /// Square root of their covariance, for data with a standard deviation of 1.
    root: DMatrix<f64>,
}

impl FittedConstants {
    /// Fits constants to innovations: each innovation changes by its row times the constants, in
    /// units of its standard deviation. Subtracts the fitted effects from the innovations.
    /// Constants are included one after the other, the one with the largest gain first, until no
    /// gain outweighs the additional number.
    ///
    /// `noise` is the standard deviation of the data, if it is known.
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

    /// Solves the least-squares problem for the constants marked in `taken`; `None` if they cannot
    /// be separated.
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

    /// Adds the effects of the constants to the states of a filter.
    pub(super) fn move_steps(&self, steps: &mut [Step<Dyn>], effects: &[StepEffects]) {
        for (step, effects) in steps.iter_mut().zip(effects) {
            step.predicted.mean += &effects.predicted * &self.values;
            step.updated.mean += &effects.updated * &self.values;
        }
    }

    /// Returns the changes of the smoothed states by independent errors of the constants, each of
    /// one standard deviation: one series for each error.
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

    /// Returns the indices of the columns of the root that are not zero.
    fn known(&self) -> impl Iterator<Item = usize> {
        let is_known = |one: &usize| self.root.column(*one).iter().any(|&part| part != 0.0);
        (0..self.values.len()).filter(is_known)
    }

    /// Returns orthonormal vectors that span the effects of the fitted constants on the
    /// innovations.
    pub(super) fn explained(&self, rows: &[DVector<f64>]) -> Vec<Vec<f64>> {
        let of = |one: usize| {
            rows.iter()
                .map(|row| row.dot(&self.root.column(one)))
                .collect()
        };
        self.known().map(of).collect()
    }
}
