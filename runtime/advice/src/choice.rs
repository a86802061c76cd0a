//! Choice among the measured runs.

use crate::comparison::Worst;

/// Measured run of one candidate at one setting.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Index of the candidate.
    pub candidate: usize,
    /// Tolerance or step of the candidate.
    pub setting: f64,
    /// The largest error and its position; `None` if the run failed.
    pub worst: Option<Worst>,
    /// Reason of the failure, if the run failed.
    pub failure: Option<String>,
    /// Time for one start, in s: the shortest of all runs.
    pub seconds: f64,
    /// Number of steps for one start.
    pub steps: f64,
}

impl Measured {
    /// Returns the largest ratio of an error to the allowed error; infinite for a failed run.
    pub fn ratio(&self) -> f64 {
        self.worst
            .as_ref()
            .map_or(f64::INFINITY, |worst| worst.ratio)
    }

    /// Returns true if all errors are within their limits.
    pub fn is_right(&self) -> bool {
        self.ratio() <= 1.0
    }
}

/// Limit on the time of a candidate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TimeLimit {
    /// Time for a step of the method, in s.
    Step(f64),
    /// Time from one sample to the next, in s; for frames.
    Sample(f64),
}

impl TimeLimit {
    /// Returns the limit, and the time of the run that it applies to, for this number of samples.
    pub(crate) fn compare(self, run: &Measured, samples: usize) -> (f64, f64) {
        match self {
            Self::Step(limit) => (limit, run.seconds / run.steps.max(1.0)),
            Self::Sample(limit) => (limit, run.seconds / samples.max(1) as f64),
        }
    }

    pub(crate) fn allows(self, run: &Measured, samples: usize) -> bool {
        let (limit, time) = self.compare(run, samples);
        time <= limit
    }
}

/// Indices of the runs that an [`Advice`](super::Advice) reports.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct ChosenRuns {
    pub(crate) chosen: Option<usize>,
    pub(crate) runner_up: Option<usize>,
    pub(crate) next_cheaper: Option<usize>,
    pub(crate) closest: Option<usize>,
}

/// Chooses the cheapest run that is right and within the limit. Also finds the cheapest run of
/// another candidate, and the most expensive run among those that cost less, of another candidate
/// if possible. If no run qualifies, finds the run with the smallest error within the limit.
pub(crate) fn choose(runs: &[Measured], limit: Option<TimeLimit>, samples: usize) -> ChosenRuns {
    let within = |run: &Measured| limit.is_none_or(|limit| limit.allows(run, samples));
    let least = |value: fn(&Measured) -> f64, among: &dyn Fn(&Measured) -> bool| {
        let own = runs.iter().enumerate().filter(|(_, run)| among(run));
        own.min_by(|a, b| value(a.1).total_cmp(&value(b.1)))
            .map(|(index, _)| index)
    };
    let chosen = least(|run| run.seconds, &|run| run.is_right() && within(run));
    let Some(best) = chosen.map(|index| &runs[index]) else {
        return ChosenRuns {
            runner_up: least(|run| run.seconds, &Measured::is_right),
            closest: least(Measured::ratio, &within),
            ..ChosenRuns::default()
        };
    };
    let cheaper = |run: &Measured| run.seconds < best.seconds && !run.is_right();
    let other = |run: &Measured| cheaper(run) && run.candidate != best.candidate;
    ChosenRuns {
        chosen,
        runner_up: least(|run| run.seconds, &|run| {
            run.candidate != best.candidate && run.is_right() && within(run)
        }),
        next_cheaper: least(|run| -run.seconds, &other)
            .or_else(|| least(|run| -run.seconds, &cheaper)),
        closest: None,
    }
}

/// Returns the indices of the runs that no other run beats in both time and error, from the fastest
/// on.
pub fn pareto(runs: &[Measured]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..runs.len())
        .filter(|&index| runs[index].ratio().is_finite())
        .collect();
    let key = |index: &usize| (runs[*index].seconds, runs[*index].ratio());
    order.sort_by(|a, b| {
        let (a, b) = (key(a), key(b));
        a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    let mut least = f64::INFINITY;
    order.retain(|&index| {
        let ratio = runs[index].ratio();
        let better = ratio < least;
        least = least.min(ratio);
        better
    });
    order
}

#[cfg(test)]
mod tests {
    use super::{ChosenRuns, Measured, TimeLimit, choose, pareto};
    use crate::{Criterion, Worst};

    fn run(candidate: usize, seconds: f64, ratio: f64) -> Measured {
        Measured {
            candidate,
            setting: 1e-6,
            worst: Some(Worst {
                output: 0,
                criterion: Criterion::Values,
                time: 1.0,
                error: ratio,
                ratio,
            }),
            failure: None,
            seconds,
            steps: 10.0,
        }
    }

    #[test]
    fn the_cheapest_that_is_right_is_chosen_and_its_neighbours_are_named() {
        let runs = [
            run(0, 4.0, 0.5),
            run(0, 1.0, 30.0),
            run(1, 2.0, 0.9),
            run(1, 1.5, 2.0),
            run(2, 3.0, 1e-9),
            run(3, 9.0, 0.0),
        ];
        let expected = ChosenRuns {
            chosen: Some(2),
            runner_up: Some(4),
            // Not 3, which is more expensive but belongs to the chosen candidate.
            next_cheaper: Some(1),
            closest: None,
        };
        assert_eq!(choose(&runs, None, 1), expected);
        assert_eq!(pareto(&runs), [1, 3, 2, 4, 5]);
    }

    #[test]
    fn a_limit_leaves_out_what_is_too_slow() {
        let runs = [run(0, 4.0, 0.5), run(1, 1.0, 3.0), run(2, 2.0, 2.0)];
        let limit = |seconds| Some(TimeLimit::Sample(seconds));
        assert_eq!(choose(&runs, limit(1.0), 4).chosen, Some(0));
        let none = choose(&runs, limit(0.5), 4);
        assert_eq!(
            (none.chosen, none.runner_up, none.closest),
            (None, Some(0), Some(2))
        );
        assert_eq!(choose(&runs, Some(TimeLimit::Step(0.3)), 4).chosen, None);
    }

    #[test]
    fn a_run_that_failed_is_never_right() {
        let mut failed = run(0, 1.0, 0.1);
        failed.worst = None;
        assert_eq!(
            choose(&[failed.clone()], None, 1),
            ChosenRuns {
                closest: Some(0),
                ..ChosenRuns::default()
            }
        );
        assert!(pareto(&[failed]).is_empty());
    }
}
