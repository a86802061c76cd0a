//! Constants that act on a motion, found beside a filter that runs without them.
//!
//! Constants move the expected data linearly, so that the filter runs once, without any, and
//! takes along what each would do: a regression of the innovations finds them (B. Friedland,
//! *Treatment of bias in recursive filtering*, IEEE Transactions on Automatic Control 14 (1969)).

use nalgebra::{SMatrix, SVector};

use super::gaussian::{Back, Innovations, Step};

/// Changes of a state by constants of one: a column each.
pub(super) type Effects<const D: usize, const K: usize> = SMatrix<f64, D, K>;

/// Changes of the state at one time, before and after its data.
#[derive(Clone, Copy, Debug)]
pub(super) struct StepEffects<const D: usize, const K: usize> {
    pub(super) predicted: Effects<D, K>,
    pub(super) updated: Effects<D, K>,
}

/// Constants that were fitted.
#[derive(Clone, Copy, Debug)]
pub(super) struct FittedConstants<const K: usize> {
    /// Zero for those that the data do not ask for.
    pub(super) values: SVector<f64, K>,
    /// A root of their variance, for data of a standard deviation of 1.
    root: SMatrix<f64, K, K>,
}

impl<const K: usize> FittedConstants<K> {
    /// None that differ from zero.
    pub(super) fn none() -> Self {
        Self {
            values: SVector::zeros(),
            root: SMatrix::zeros(),
        }
    }

    /// Fits constants to innovations, of which each moves by its row times them, in its
    /// deviations; takes what they explain out of the innovations. One after the other is
    /// taken, the one that gains most first, until none is worth its number.
    ///
    /// `noise` is the standard deviation of the data, where it is known.
    pub(super) fn fit(
        innovations: &mut Innovations,
        rows: &[SVector<f64, K>],
        noise: Option<f64>,
    ) -> Self {
        let mut found = Self::none();
        if rows.is_empty() {
            return found;
        }
        let (mut information, mut pull) = (SMatrix::zeros(), SVector::zeros());
        let used = rows.iter().zip(&innovations.standard);
        for (row, value) in used.skip(innovations.free) {
            information += row * row.transpose();
            pull += row * *value;
        }
        let all = innovations.clone();
        let mut taken = [false; K];
        loop {
            let mut better = None;
            let mut best = innovations.log_likelihood(noise);
            for one in (0..K).filter(|&one| !taken[one]) {
                let mut trial = taken;
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
    fn solve(
        information: &SMatrix<f64, K, K>,
        pull: &SVector<f64, K>,
        taken: &[bool; K],
    ) -> Option<Self> {
        let unit = SMatrix::<f64, K, K>::identity();
        let own = SMatrix::<f64, K, K>::from_fn(|i, j| match taken[i] && taken[j] {
            true => information[(i, j)],
            false => unit[(i, j)],
        });
        let factor = own.cholesky()?;
        let pull = SVector::from_fn(|i, _| if taken[i] { pull[i] } else { 0.0 });
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
    pub(super) fn move_steps<const D: usize>(
        &self,
        steps: &mut [Step<D>],
        effects: &[StepEffects<D, K>],
    ) {
        for (step, effects) in steps.iter_mut().zip(effects) {
            step.predicted.mean += effects.predicted * self.values;
            step.updated.mean += effects.updated * self.values;
        }
    }

    /// Returns the changes of the smoothed states by independent errors of one deviation of the
    /// constants: a series each.
    pub(super) fn errors<const D: usize>(
        &self,
        back: &[Back<D>],
        effects: &[StepEffects<D, K>],
    ) -> Vec<Vec<SVector<f64, D>>> {
        let mut smoothed: Vec<Effects<D, K>> = Vec::with_capacity(effects.len());
        for (index, (own, back)) in effects.iter().zip(back).enumerate().rev() {
            let later = smoothed.last().zip(effects.get(index + 1));
            let ahead = later.map_or_else(SMatrix::zeros, |(later, next)| later - next.predicted);
            smoothed.push(own.updated + back.gain * ahead);
        }
        let of = |one: usize| {
            let direction = self.root.column(one).into_owned();
            let states = smoothed.iter().rev();
            states.map(|effects| effects * direction).collect()
        };
        self.known().map(of).collect()
    }

    /// Columns of the root that are not zero.
    fn known(&self) -> impl Iterator<Item = usize> {
        let is_known = |one: &usize| self.root.column(*one).iter().any(|&part| part != 0.0);
        (0..K).filter(is_known)
    }

    /// Returns unit vectors of what the constants explain of the innovations they were fitted to.
    pub(super) fn explained(&self, rows: &[SVector<f64, K>]) -> Vec<Vec<f64>> {
        let of = |one: usize| {
            rows.iter()
                .map(|row| row.dot(&self.root.column(one)))
                .collect()
        };
        self.known().map(of).collect()
    }
}
