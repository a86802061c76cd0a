//! Errors of a run: first of its values, as long as they are predictable, afterwards of a conserved
//! quantity or of statistics.

use crate::paths::{OutputValues, Paths};
use crate::truth::Truth;
use crate::wanted::Wanted;
use branched_pendulum::analysis::statistics::Estimate;

/// Criterion by which an output is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Criterion {
    /// Values of the output at each time.
    Values,
    /// Drift of a conserved quantity.
    Conserved,
    /// Mean and mean square of the output.
    Statistics,
}

/// The largest error of a run, relative to its limit.
#[derive(Clone, Debug, PartialEq)]
pub struct Worst {
    /// Index of the output; the conserved quantity counts as the one after the last output.
    pub output: usize,
    /// Criterion by which the error was found.
    pub criterion: Criterion,
    /// Time of the error, in s; for statistics, the time at which averaging begins.
    pub time: f64,
    /// Error, in the unit of the output.
    pub error: f64,
    /// Ratio of the error to the allowed error; at most 1 for a run that is right.
    pub ratio: f64,
}

/// Reference data with which runs are compared.
pub(crate) struct Comparison<'a> {
    pub(crate) wanted: &'a [Wanted<'a>],
    pub(crate) conserved: Option<&'a Wanted<'a>>,
    pub(crate) times: &'a [f64],
    pub(crate) truth: Truth,
    /// Value of the conserved quantity at each start.
    pub(crate) kept: Vec<f64>,
}

/// Number of standard errors by which two means of the same motion may differ.
const SIGMAS: f64 = 3.0;

/// Number of parts of a record whose spread gives the standard error of its mean.
const PARTS: usize = 10;

impl Comparison<'_> {
    /// Returns true if the values of an output become unpredictable before the end.
    pub(crate) fn is_short(&self, output: usize) -> bool {
        self.truth.trusted[output] < self.times.len()
    }

    /// Returns the criterion for an output after its values have become unpredictable; `None` if
    /// too little time is left.
    pub(crate) fn beyond(&self, output: usize) -> Option<Criterion> {
        let rest = self.times.len() - self.truth.trusted[output];
        match self.conserved {
            Some(_) => Some(Criterion::Conserved),
            None => (rest >= 2 * PARTS).then_some(Criterion::Statistics),
        }
    }

    /// Returns the largest of all errors of a run, relative to their limits.
    pub(crate) fn worst(&self, paths: &Paths) -> Worst {
        let mut worst = Worst {
            output: 0,
            criterion: Criterion::Values,
            time: self.times[0],
            error: 0.0,
            ratio: 0.0,
        };
        // A NaN error counts as the largest.
        let mut take = |found: Worst| {
            let ratio = match found.ratio.is_nan() {
                true => f64::INFINITY,
                false => found.ratio,
            };
            if ratio > worst.ratio {
                worst = Worst { ratio, ..found };
            }
        };
        for (output, wanted) in self.wanted.iter().enumerate() {
            let own = paths.outputs(wanted, self.times);
            let (truth, trusted) = (&self.truth.outputs[output], self.truth.trusted[output]);
            for time in 0..trusted {
                let error = own.difference(truth, time);
                take(Worst {
                    output,
                    criterion: Criterion::Values,
                    time: self.times[time],
                    error,
                    ratio: error / wanted.tolerance,
                });
            }
            if self.is_short(output) && self.beyond(output) == Some(Criterion::Statistics) {
                take(self.by_statistics(output, &own, truth, trusted));
            }
        }
        let any_short = (0..self.wanted.len()).any(|output| self.is_short(output));
        if let (true, Some(conserved)) = (any_short, self.conserved) {
            let own = paths.outputs(conserved, self.times);
            for (start, level) in self.kept.iter().enumerate() {
                for time in 0..self.times.len() {
                    let value = own.at(start, time).first().copied().unwrap_or(f64::NAN);
                    let error = (value - level).abs();
                    take(Worst {
                        output: self.wanted.len(),
                        criterion: Criterion::Conserved,
                        time: self.times[time],
                        error,
                        ratio: error / conserved.tolerance,
                    });
                }
            }
        }
        worst
    }

    /// Compares mean and mean square after the time index `trusted` with those of the reference.
    /// From then on a correct run may be a different motion, but with the same statistics.
    fn by_statistics(
        &self,
        output: usize,
        own: &OutputValues,
        truth: &OutputValues,
        trusted: usize,
    ) -> Worst {
        let mut worst = Worst {
            output,
            criterion: Criterion::Statistics,
            time: self.times.get(trusted).copied().unwrap_or(f64::NAN),
            error: 0.0,
            ratio: 0.0,
        };
        let starts = truth.values.len() / (truth.width * truth.times).max(1);
        for value in 0..truth.width {
            for power in [1, 2] {
                let mean = |outputs: &OutputValues| {
                    let mut parts = Vec::new();
                    let count = (truth.times - trusted) / PARTS;
                    for start in 0..starts {
                        for part in 0..PARTS {
                            let from = trusted + part * count;
                            let sum: f64 = (from..from + count)
                                .map(|time| outputs.at(start, time)[value].powi(power))
                                .sum();
                            parts.push(sum / count as f64);
                        }
                    }
                    Estimate::of_independent(&parts)
                };
                let (found, expected) = (mean(own), mean(truth));
                let error = (found.value - expected.value).abs();
                let allowed = SIGMAS * found.error.hypot(expected.error);
                let ratio = if error == 0.0 { 0.0 } else { error / allowed };
                if ratio > worst.ratio || ratio.is_nan() {
                    (worst.error, worst.ratio) = (error, ratio);
                }
            }
        }
        worst
    }
}
