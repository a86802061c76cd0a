//! Report of the advisor.

use std::fmt;

use branched_pendulum::integrate::Method;

use crate::candidate::{CandidateName, SettingRange};
use crate::candidates::Candidates;
use crate::choice::{ChosenRuns, Measured, TimeLimit};
use crate::comparison::{Comparison, Criterion};

/// Time until which an output was compared with its reference, and the accuracy of the reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Followed {
    /// Name of the output.
    pub name: String,
    /// Unit of the output.
    pub unit: &'static str,
    /// Largest allowed error.
    pub tolerance: f64,
    /// Largest error of the reference itself.
    pub reference_error: f64,
    /// Time from which on the values are unpredictable, in s; `None` if they are predictable to the
    /// end.
    pub chaotic_from: Option<f64>,
    /// Criterion by which the output is judged once its values are unpredictable.
    pub beyond: Option<Criterion>,
}

/// The choice, with all measurements behind it.
#[derive(Clone, Debug, PartialEq)]
pub struct Advice {
    /// All measured runs.
    pub runs: Vec<Measured>,
    /// Names of the candidates, in their order.
    pub names: Vec<CandidateName>,
    /// Outputs, with the accuracy of their references.
    pub outputs: Vec<Followed>,
    /// Method by which the reference was computed.
    pub reference: String,
    /// Growth rate of small deviations, in 1/s, if it was computed. The deviations are like
    /// rounding errors: equal components stay equal, and zeros stay zero. For identical branches in
    /// phase it is the rate [within](branched_pendulum::analysis::variational::Lyapunov::within)
    /// the in-phase motions; differences between the branches may grow faster.
    pub growth: Option<f64>,
    /// Lines that a user writes for the choice.
    pub to_write: Vec<String>,
    ranges: Vec<SettingRange>,
    conserved: Option<(String, &'static str, f64)>,
    choice: ChosenRuns,
    limit: Option<TimeLimit>,
    samples: usize,
    end: f64,
}

impl Advice {
    pub(crate) fn new(
        comparison: &Comparison<'_>,
        candidates: &Candidates<'_>,
        runs: Vec<Measured>,
        choice: ChosenRuns,
        limit: Option<TimeLimit>,
    ) -> Self {
        let outputs = comparison
            .wanted
            .iter()
            .enumerate()
            .map(|(output, wanted)| {
                let trusted = comparison.truth.trusted[output];
                let short = comparison.is_short(output);
                Followed {
                    name: wanted.name.clone(),
                    unit: wanted.unit,
                    tolerance: wanted.tolerance,
                    reference_error: comparison.truth.error(output),
                    chaotic_from: comparison.times.get(trusted).copied(),
                    beyond: short.then(|| comparison.beyond(output)).flatten(),
                }
            });
        let to_write = choice.chosen.map(|index| {
            let run = &runs[index];
            candidates.all[run.candidate].to_write(run.setting)
        });
        Self {
            names: candidates.names().collect(),
            outputs: outputs.collect(),
            reference: comparison.truth.method.clone(),
            growth: comparison.truth.digits.growth,
            to_write: to_write.unwrap_or_default(),
            ranges: candidates.all.iter().map(|one| one.settings()).collect(),
            conserved: comparison
                .conserved
                .map(|kept| (kept.name.clone(), kept.unit, kept.tolerance)),
            runs,
            choice,
            limit,
            samples: comparison.times.len(),
            end: comparison.times.last().copied().unwrap_or(f64::NAN),
        }
    }

    /// Names and units of the columns of [`rows`](Self::rows).
    pub const COLUMNS: [(&str, &str); 7] = [
        ("model", ""),
        ("method", ""),
        ("scalar", ""),
        ("lanes", ""),
        ("tolerance or step", ""),
        ("error over tolerance", ""),
        ("time", "s"),
    ];

    /// Returns all measurements in their order, as rows of a table.
    pub fn rows<'a, C: From<&'a str> + From<f64>>(&'a self) -> impl Iterator<Item = [C; 7]> {
        self.runs.iter().filter_map(|run| {
            let name = self.names.get(run.candidate)?;
            let in_lanes = if name.in_lanes { "yes" } else { "no" };
            Some([
                name.model.as_str().into(),
                name.method.as_str().into(),
                name.scalar.into(),
                in_lanes.into(),
                run.setting.into(),
                run.ratio().into(),
                run.seconds.into(),
            ])
        })
    }

    /// Returns the chosen run: the cheapest that is right and within the limit.
    pub fn chosen(&self) -> Option<&Measured> {
        self.run(self.choice.chosen)
    }

    /// Returns the cheapest run of another candidate that is right. Without a choice, returns the
    /// cheapest run that is right but too slow.
    pub fn runner_up(&self) -> Option<&Measured> {
        self.run(self.choice.runner_up)
    }

    /// Returns the most expensive run among those that cost less than the choice and are wrong, of
    /// another candidate if possible.
    pub fn next_cheaper(&self) -> Option<&Measured> {
        self.run(self.choice.next_cheaper)
    }

    /// Returns the run within the limit that has the smallest error, if there is no choice.
    pub fn closest(&self) -> Option<&Measured> {
        self.run(self.choice.closest)
    }

    /// Returns one run of each candidate: first those with a run that is right and within the
    /// limit, by cost; then the other candidates, by the smallest error that they reach.
    pub fn ranked(&self) -> impl Iterator<Item = &Measured> {
        let is_taken = |run: &Measured| {
            let is_within = |limit: TimeLimit| limit.allows(run, self.samples);
            run.is_right() && self.limit.is_none_or(is_within)
        };
        // Right runs are ordered by time, wrong ones by error.
        let key = |run: &Measured| match (is_taken(run), run.is_right()) {
            (true, _) => (0, run.seconds),
            (false, true) => (1, run.seconds),
            (false, false) => (2, run.ratio()),
        };
        let order = |a: &&Measured, b: &&Measured| {
            let (a, b) = (key(a), key(b));
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        };
        let best = |candidate: usize| {
            let own = self
                .runs
                .iter()
                .filter(move |run| run.candidate == candidate);
            own.min_by(order)
        };
        let mut ranked: Vec<&Measured> = (0..self.names.len()).filter_map(best).collect();
        ranked.sort_by(order);
        ranked.into_iter()
    }

    fn run(&self, index: Option<usize>) -> Option<&Measured> {
        self.runs.get(index?)
    }

    /// Returns the method of a run of the full equations of motion in `f64`; `None` for other
    /// models and scalars.
    pub fn method(&self, run: &Measured) -> Option<Method> {
        let name = self.names.get(run.candidate)?;
        let is_full = name.model == "full" && name.scalar == "f64";
        let mut methods = Method::ALL.iter().copied();
        methods.find(|method| is_full && method.title() == name.method)
    }

    /// Returns the best run of the full equations of motion in `f64` that is right, with its
    /// method; `None` if no run is right.
    pub fn best_full(&self) -> Option<(&Measured, Method)> {
        self.chosen()?;
        let mut right = self.ranked().filter(|run| run.is_right());
        right.find_map(|run| Some((run, self.method(run)?)))
    }

    /// Returns the range of settings of a run's candidate.
    pub fn range(&self, run: &Measured) -> SettingRange {
        let range = self.ranges.get(run.candidate);
        range.copied().unwrap_or(SettingRange::Fixed)
    }

    /// Returns name and setting of a run as text.
    pub fn describe(&self, run: &Measured) -> String {
        let setting = self.range(run).describe(run.setting);
        format!("{}, {setting}", self.names[run.candidate])
    }

    /// Returns the largest error of a run and its position as text.
    pub fn evidence(&self, run: &Measured) -> String {
        let Some(worst) = &run.worst else {
            let why = run.failure.as_deref().unwrap_or("it failed");
            return format!("no result: {why}");
        };
        let (name, unit, tolerance) = match self.outputs.get(worst.output) {
            Some(output) => (output.name.as_str(), output.unit, output.tolerance),
            None => match &self.conserved {
                Some((name, unit, tolerance)) => (name.as_str(), *unit, *tolerance),
                None => ("", "", f64::NAN),
            },
        };
        let gap = if unit.is_empty() { "" } else { " " };
        let (error, time, tolerance) = (worst.error, worst.time, plain(tolerance));
        match worst.criterion {
            Criterion::Values => {
                format!("{name} off by {error:.1e}{gap}{unit} at {time:.4} s, {tolerance} allowed")
            }
            Criterion::Conserved => format!(
                "{name} drifts by {error:.1e}{gap}{unit} at {time:.4} s, {tolerance} allowed"
            ),
            Criterion::Statistics => format!(
                "means of {name} from {time:.4} s on off by {:.1} of what chance makes",
                worst.ratio
            ),
        }
    }

    fn cost(&self, run: &Measured) -> String {
        let per_sample = run.seconds / self.samples.max(1) as f64;
        format!("{}, {} a sample", time(run.seconds), time(per_sample))
    }
}

/// Formats a number with at most four digits.
fn plain(value: f64) -> String {
    let value = format!("{value:.3e}").parse().unwrap_or(value);
    if (1e-3..1e6).contains(&value) {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

/// Returns a time as text.
fn time(seconds: f64) -> String {
    let (value, unit) = match seconds {
        s if s < 1e-6 => (1e9 * s, "ns"),
        s if s < 1e-3 => (1e6 * s, "µs"),
        s if s < 1.0 => (1e3 * s, "ms"),
        s => (s, "s"),
    };
    let decimals = if value < 10.0 {
        2
    } else {
        usize::from(value < 100.0)
    };
    format!("{value:.decimals$} {unit}")
}

impl fmt::Display for Followed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let gap = if self.unit.is_empty() { "" } else { " " };
        let (name, unit, tolerance) = (&self.name, self.unit, plain(self.tolerance));
        write!(f, "{name} to {tolerance}{gap}{unit}")?;
        let error = self.reference_error;
        write!(f, "; the reference is good to {error:.1e}{gap}{unit}")?;
        if let Some(from) = self.chaotic_from {
            write!(
                f,
                "\n  from {from:.4} s on, what rounding leaves of the start does not tell them; \
                 judged there: "
            )?;
            f.write_str(match self.beyond {
                Some(Criterion::Conserved) => "what the motion keeps",
                Some(Criterion::Statistics) => "means and mean squares",
                Some(Criterion::Values) | None => "nothing",
            })?;
        }
        Ok(())
    }
}

impl fmt::Display for Advice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for output in &self.outputs {
            writeln!(f, "{output}")?;
        }
        writeln!(f, "reference: {}", self.reference)?;
        if let Some(growth) = self.growth {
            writeln!(f, "small deviations grow e-fold each {:.2} s", 1.0 / growth)?;
        }
        let (samples, end) = (self.samples, self.end);
        writeln!(
            f,
            "{} runs of {} candidates, {samples} samples to {end} s\n",
            self.runs.len(),
            self.names.len()
        )?;
        let mut line = |title: &str, run: &Measured| {
            writeln!(f, "{title}: {}", self.describe(run))?;
            writeln!(f, "  {}; {}", self.cost(run), self.evidence(run))
        };
        match self.chosen() {
            Some(run) => line("take", run)?,
            None => {
                if let Some(run) = self.closest() {
                    line("nothing is right; the closest", run)?;
                }
            }
        }
        if let Some(run) = self.runner_up() {
            let title = match self.chosen() {
                Some(_) => "runner-up",
                None => "right, but too slow",
            };
            line(title, run)?;
        }
        if let Some(run) = self.next_cheaper() {
            line("cheaper, but wrong", run)?;
        }
        if let Some(limit) = self.limit
            && let Some(run) = self.chosen().or(self.runner_up())
        {
            let (allowed, found) = limit.compare(run, self.samples);
            let what = match limit {
                TimeLimit::Step(_) => "step",
                TimeLimit::Sample(_) => "sample",
            };
            writeln!(
                f,
                "a {what} takes {}, {} allowed",
                time(found),
                time(allowed)
            )?;
        }
        if !self.to_write.is_empty() {
            writeln!(f, "\nwrite:")?;
            for line in &self.to_write {
                writeln!(f, "    {line}")?;
            }
        }
        Ok(())
    }
}
