//! The advisor: measures candidates and chooses the cheapest one that is right.

use std::fmt;
use std::hint::black_box;
use std::time::Instant;

use crate::candidate::{Candidate, SettingRange};
use crate::candidates::Candidates;
use crate::choice::{Measured, TimeLimit, choose};
use crate::comparison::Comparison;
use crate::error::AdviceError;
use crate::paths::Paths;
use crate::report::Advice;
use crate::search::bracket;
use crate::truth::{Exact, Truth};
use crate::wanted::Wanted;
use branched_pendulum::system::{CastOde, State};

/// A scene with its starts, its end, the outputs that must be right, and an optional time limit.
pub struct Advisor<'a> {
    exact: &'a dyn Exact,
    starts: Vec<State<f64>>,
    times: Vec<f64>,
    wanted: Vec<Wanted<'a>>,
    conserved: Option<Wanted<'a>>,
    limit: Option<TimeLimit>,
}

/// Default number of samples of a motion.
const SAMPLES: u32 = 100;

/// Multiple of the best time so far that a candidate may take during the search.
const ALLOWED: f64 = 1.5;

/// Largest number of repeated rounds in which the best runs are timed alternately, and the time
/// that may be spent on them.
const ROUNDS: usize = 60;
const SECONDS: f64 = 0.5;

/// Total duration of repeated runs of one setting in a survey, in s.
const SHORT: f64 = 0.02;

impl<'a> Advisor<'a> {
    /// Creates an advisor for a scene. `exact` are its exact equations of motion: the complete
    /// model in its own coordinates.
    pub fn new<O: CastOde<f64>>(exact: &'a O) -> Self {
        Self {
            exact,
            starts: Vec::new(),
            times: Vec::new(),
            wanted: Vec::new(),
            conserved: None,
            limit: None,
        }
    }

    /// Adds a start. Candidates integrate from all starts; costs are given for one start.
    #[must_use]
    pub fn start(mut self, start: State<f64>) -> Self {
        self.starts.push(start);
        self
    }

    /// Sets the end time (s), with a hundred samples at equal intervals.
    #[must_use]
    pub fn until(self, end: f64) -> Self {
        let sample = |index| end * f64::from(index) / f64::from(SAMPLES);
        self.at((1..=SAMPLES).map(sample).collect())
    }

    /// Sets the sample times (s).
    #[must_use]
    pub fn at(mut self, times: Vec<f64>) -> Self {
        self.times = times;
        self
    }

    /// Adds an output that must be right.
    #[must_use]
    pub fn wanted(mut self, wanted: Wanted<'a>) -> Self {
        self.wanted.push(wanted);
        self
    }

    /// Adds a conserved quantity. If the values of an output cannot be followed to the end, the
    /// drift of this quantity is judged instead.
    #[must_use]
    pub fn conserved(mut self, conserved: Wanted<'a>) -> Self {
        self.conserved = Some(conserved);
        self
    }

    /// Excludes candidates that take longer than this limit.
    #[must_use]
    pub fn within(mut self, limit: TimeLimit) -> Self {
        self.limit = Some(limit);
        self
    }

    /// Measures the candidates and chooses among them.
    ///
    /// Candidates are measured in the order in which they were added; a candidate that costs 1.5
    /// times as much as the best so far is abandoned. Takes about ten runs of each candidate, and
    /// the reference.
    ///
    /// # Errors
    ///
    /// [`AdviceError`].
    pub fn advise(&self, candidates: &Candidates<'_>) -> Result<Advice, AdviceError> {
        let mut comparison = self.comparison()?;
        let advice = self.advise_by(&comparison, candidates);
        // Near the last digits of `f64`, first check whether they suffice.
        if advice.runs.iter().any(Measured::is_right) || !comparison.truth.trust_less() {
            return Ok(advice);
        }
        Ok(self.advise_by(&comparison, candidates))
    }

    fn advise_by(&self, comparison: &Comparison<'_>, candidates: &Candidates<'_>) -> Advice {
        let samples = self.times.len();
        let eligible = |run: &Measured| {
            run.is_right() && self.limit.is_none_or(|limit| limit.allows(run, samples))
        };
        let tolerance = self.tolerance();
        let mut runs: Vec<Measured> = Vec::new();
        let mut best = f64::INFINITY;
        for (index, candidate) in candidates.all.iter().enumerate() {
            let range = candidate.settings();
            let begin = runs.len();
            bracket(range, tolerance, ALLOWED * best, |logarithm| {
                let setting = range.setting(logarithm);
                // Two settings may be equal after rounding to the digits that are written.
                let known = runs[begin..].iter().find(|run| run.setting == setting);
                if let Some(known) = known {
                    return (known.ratio(), known.seconds);
                }
                let run = self.measure(comparison, index, candidate.as_ref(), setting);
                let found = (run.ratio(), run.seconds);
                if eligible(&run) {
                    best = best.min(run.seconds);
                }
                runs.push(run);
                found
            });
        }
        self.time_the_best(candidates, &mut runs, &eligible);
        let choice = choose(&runs, self.limit, samples);
        Advice::new(comparison, candidates, runs, choice, self.limit)
    }

    /// Measures every candidate at settings of its range that are `spacing` decades apart, for a
    /// chart. A candidate is abandoned if a run takes more than `most` seconds for one start, or if
    /// three fine settings bring no improvement.
    ///
    /// # Errors
    ///
    /// [`AdviceError`].
    pub fn survey(
        &self,
        candidates: &Candidates<'_>,
        spacing: f64,
        most: f64,
    ) -> Result<Vec<Measured>, AdviceError> {
        let comparison = self.comparison()?;
        let mut runs = Vec::new();
        for (index, candidate) in candidates.all.iter().enumerate() {
            let range = candidate.settings();
            let (coarsest, finest) = range.ends();
            let spacing = match range {
                SettingRange::Tolerance { .. } | SettingRange::Fixed => spacing,
                SettingRange::Step { .. } => spacing / 4.0,
            };
            let count = ((coarsest - finest) / spacing).floor() as u32;
            let (mut least, mut useless) = (f64::INFINITY, 0);
            for number in 0..=count {
                let setting = range.setting(coarsest - spacing * f64::from(number));
                let mut run = self.measure(&comparison, index, candidate.as_ref(), setting);
                let ratio = run.ratio();
                let clock = Instant::now();
                for _ in 0..4 {
                    let is_short = clock.elapsed().as_secs_f64() < SHORT;
                    if is_short && ratio.is_finite() && run.seconds < most {
                        let again = self.time(candidate.as_ref(), setting);
                        run.seconds = run.seconds.min(again);
                    }
                }
                let slow = run.seconds > most;
                runs.push(run);
                // Coarse settings may all have the same large error.
                let is_coarse = 2 * number < count;
                useless = match ratio < least || is_coarse {
                    true => 0,
                    false => useless + 1,
                };
                least = least.min(ratio);
                if slow || useless == 3 {
                    break;
                }
            }
        }
        Ok(runs)
    }

    fn comparison(&self) -> Result<Comparison<'_>, AdviceError> {
        let request = AdviceError::Request;
        if self.starts.is_empty() {
            return Err(request("a start"));
        }
        let dimension = self.exact.dimension();
        if self
            .starts
            .iter()
            .any(|start| start.values.len() != dimension)
        {
            return Err(request(
                "starts with as many components as the exact equations have",
            ));
        }
        if self.times.is_empty() {
            return Err(request("times to which the motion is followed"));
        }
        let one_way = |start: &State<f64>| {
            let from_start = std::iter::once(start.time).chain(self.times.iter().copied());
            let steps: Vec<f64> = from_start
                .zip(&self.times)
                .map(|(before, after)| after - before)
                .collect();
            steps.iter().all(|&step| step >= 0.0) || steps.iter().all(|&step| step <= 0.0)
        };
        if !self.starts.iter().all(one_way) {
            return Err(request("times that run one way from every start"));
        }
        if self.wanted.is_empty() {
            return Err(request("an output that must be right"));
        }
        let all = self.wanted.iter().chain(&self.conserved);
        if all
            .clone()
            .any(|wanted| !(wanted.tolerance.is_finite() && wanted.tolerance > 0.0))
        {
            return Err(request("tolerances above zero"));
        }
        let truth = Truth::find(self.exact, &self.starts, &self.times, &self.wanted)
            .map_err(AdviceError::Reference)?;
        let conserved = self.conserved.as_ref();
        let kept = |start: &State<f64>| {
            let mut values = Vec::new();
            if let Some(conserved) = conserved {
                conserved.values(start.time, &start.values, &mut values);
            }
            values.first().copied().unwrap_or(f64::NAN)
        };
        Ok(Comparison {
            wanted: &self.wanted,
            conserved,
            times: &self.times,
            truth,
            kept: self.starts.iter().map(kept).collect(),
        })
    }

    /// Returns the tolerance with which the search begins: the smallest requested one.
    fn tolerance(&self) -> f64 {
        let tolerances = self.wanted.iter().map(|wanted| wanted.tolerance);
        tolerances.fold(f64::INFINITY, f64::min)
    }

    /// Runs a candidate at a setting, judges the result, and times the run twice.
    fn measure(
        &self,
        comparison: &Comparison<'_>,
        index: usize,
        candidate: &dyn Candidate,
        setting: f64,
    ) -> Measured {
        let dimension = self.exact.dimension();
        let mut paths = Paths::new(dimension, self.starts.len(), self.times.len());
        let clock = Instant::now();
        let result = candidate.run(
            setting,
            &self.starts,
            &self.times,
            &mut |start, time, state| {
                paths.set(start, time, state);
            },
        );
        let starts = self.starts.len() as f64;
        let mut measured = Measured {
            candidate: index,
            setting,
            worst: None,
            failure: None,
            seconds: clock.elapsed().as_secs_f64() / starts,
            steps: 0.0,
        };
        match result {
            Ok(steps) => {
                measured.steps = steps as f64 / starts;
                measured.worst = Some(comparison.worst(&paths));
                measured.seconds = measured.seconds.min(self.time(candidate, setting));
            }
            Err(error) => measured.failure = Some(error.to_string()),
        }
        measured
    }

    /// Runs a candidate once. Returns the time for one start, in s.
    pub fn time(&self, candidate: &dyn Candidate, setting: f64) -> f64 {
        let clock = Instant::now();
        let result = candidate.run(
            setting,
            black_box(&self.starts),
            &self.times,
            &mut |_, _, state| {
                black_box(state);
            },
        );
        let time = clock.elapsed().as_secs_f64();
        // The time of a failed run is not used.
        let _ = black_box(result);
        time / self.starts.len() as f64
    }

    /// Times the best runs again, alternating between them. The shortest time of each counts, since
    /// disturbances only lengthen a run.
    fn time_the_best(
        &self,
        candidates: &Candidates<'_>,
        runs: &mut [Measured],
        eligible: &dyn Fn(&Measured) -> bool,
    ) {
        let right = runs.iter().filter(|run| eligible(run));
        let best = right.map(|run| run.seconds).fold(f64::INFINITY, f64::min);
        // The cheapest run of each candidate.
        let mut finalists: Vec<usize> = Vec::new();
        for index in 0..candidates.all.len() {
            let own = (0..runs.len()).filter(|&run| runs[run].candidate == index);
            let right = own.filter(|&run| eligible(&runs[run]));
            let cheapest = right.min_by(|&a, &b| runs[a].seconds.total_cmp(&runs[b].seconds));
            finalists.extend(cheapest.filter(|&run| runs[run].seconds <= 2.0 * best));
        }
        let clock = Instant::now();
        for _ in 0..ROUNDS {
            for &index in &finalists {
                let run = &mut runs[index];
                if let Some(candidate) = candidates.all.get(run.candidate) {
                    run.seconds = run.seconds.min(self.time(candidate.as_ref(), run.setting));
                }
            }
            if clock.elapsed().as_secs_f64() > SECONDS {
                break;
            }
        }
    }
}

impl fmt::Debug for Advisor<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            exact: _,
            starts,
            times,
            wanted,
            conserved,
            limit,
        } = self;
        f.debug_struct("Advisor")
            .field("starts", starts)
            .field("times", times)
            .field("wanted", wanted)
            .field("conserved", conserved)
            .field("limit", limit)
            .finish_non_exhaustive()
    }
}
