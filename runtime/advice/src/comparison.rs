//! How wrong a run is: by its values as far as they can be known, beyond by what is
//! kept or by statistics.

use crate::paths::{OutputValues, Paths};
use crate::truth::Truth;
use crate::wanted::Wanted;
use branched_pendulum::analysis::statistics::Estimate;

/// Measure by which an output is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Criterion {
    /// Values of the output, time by time.
    Values,
    /// The drift of a quantity that the motion keeps.
    Conserved,
    /// Mean and mean square of the output.
    Statistics,
}

/// Where a run is worst.
#[derive(Clone, Debug, PartialEq)]
pub struct Worst {
    /// Index of the output, or of the conserved quantity behind all outputs.
    pub output: usize,
    /// By what.
    pub criterion: Criterion,
    /// When, in s: of statistics, from when on.
    pub time: f64,
    /// Error, in the unit of the output.
    pub error: f64,
    /// Error over the one allowed: at most 1 where the run is good enough.
    pub ratio: f64,
}

/// Everything that runs are compared with.
pub(crate) struct Comparison<'a> {
    pub(crate) wanted: &'a [Wanted<'a>],
    pub(crate) conserved: Option<&'a Wanted<'a>>,
    pub(crate) times: &'a [f64],
    pub(crate) truth: Truth,
    /// The conserved quantity at every start.
    pub(crate) kept: Vec<f64>,
}

/// Standard errors by which two means of one motion may differ.
const SIGMAS: f64 = 3.0;

/// Parts of a record, by whose spread the standard error of its mean is told.
const PARTS: usize = 10;

impl Comparison<'_> {
    /// Returns true if an output cannot be followed to the end.
    pub(crate) fn is_short(&self, output: usize) -> bool {
        self.truth.trusted[output] < self.times.len()
    }

    /// Measure by which an output is judged beyond the time to which it can be followed; none
    /// where there is too little of it.
    pub(crate) fn beyond(&self, output: usize) -> Option<Criterion> {
        let rest = self.times.len() - self.truth.trusted[output];
        match self.conserved {
            Some(_) => Some(Criterion::Conserved),
            None => (rest >= 2 * PARTS).then_some(Criterion::Statistics),
        }
    }

    /// The worst of all errors of a run.
    pub(crate) fn worst(&self, paths: &Paths) -> Worst {
        let mut worst = Worst {
            output: 0,
            criterion: Criterion::Values,
            time: self.times[0],
            error: 0.0,
            ratio: 0.0,
        };
        // An error that is no number is worse than any.
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

    /// Mean and mean square beyond the time `trusted`, against those of the reference: a
    /// motion, too, if not this one.
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
