//! A fit in the form that the numerical code uses: with checked indices instead of names.

use std::ops::Range;

use nalgebra::DMatrix;

use super::effort::{Counted, Effort};
use super::family::{AnyFamily, WIDTH};
use super::sensitivity::Sensitivities;
use branched_pendulum::integrate::{Dop853, Integrator, Options, Tolerance};
use branched_pendulum::system::{Ode, State};

/// Relative tolerance for derivatives and for the motion integrated with them, which give
/// directions of steps and error bars. The sum of squares itself comes from a motion without
/// derivatives.
const TOLERANCE_OF_COLUMNS: f64 = 1e-7;

/// Models, data and unknowns. The unknowns are the *globals* (parameters, then offsets of angles)
/// and the initial states of the segments.
pub(super) struct FitTask<'a> {
    pub(super) family: &'a dyn AnyFamily,
    /// Numbers of a state.
    pub(super) dimension: usize,
    /// Values of all parameters; for unknown ones the start values.
    pub(super) values: Vec<f64>,
    /// Indices of unknown parameters.
    pub(super) unknown: Vec<usize>,
    /// Names of the globals, parameters first.
    pub(super) names: Vec<String>,
    /// Changes of the globals that are significant, used as their units.
    pub(super) scales: Vec<f64>,
    /// The smallest and the largest allowed value of each global.
    pub(super) bounds: Vec<[f64; 2]>,
    pub(super) times: &'a [f64],
    pub(super) links: Vec<LinkData<'a>>,
    pub(super) frequencies: Vec<FrequencyDatum>,
    /// Relative tolerance of the motion.
    pub(super) tolerance: f64,
    /// Work count of the search to which the task belongs.
    pub(super) effort: &'a Effort<'a>,
}

/// A frequency, with the index of its mode among those that oscillate.
#[derive(Clone, Copy, Debug)]
pub(super) struct FrequencyDatum {
    pub(super) place: usize,
    pub(super) hertz: f64,
    pub(super) deviation: f64,
}

/// Measured angles of one link.
pub(super) struct LinkData<'a> {
    /// Index of the link's angle in the state.
    pub(super) component: usize,
    pub(super) angles: &'a [Option<f64>],
    /// One over the deviation.
    pub(super) weight: f64,
    /// Index of the global that is the offset of the angle.
    pub(super) offset: Option<usize>,
}

/// Rows of the linear problem that belong to one segment. Their columns are its initial state, the
/// globals (in units of their scales) and the right-hand side.
pub(super) struct LinearSegment {
    /// One row a datum.
    pub(super) data: DMatrix<f64>,
    /// One row for each component of the state at the end; the last column is that component.
    pub(super) end: DMatrix<f64>,
}

impl LinearSegment {
    /// Returns the rows with the columns of the initial state and of some of the globals.
    pub(super) fn only(&self, globals: &[usize]) -> Self {
        let n = self.end.nrows();
        let last = self.end.ncols() - 1;
        let globals = globals.iter().map(|global| n + global);
        let columns: Vec<usize> = (0..n).chain(globals).chain([last]).collect();
        Self {
            data: self.data.select_columns(&columns),
            end: self.end.select_columns(&columns),
        }
    }
}

impl FitTask<'_> {
    /// Returns the values of all parameters for given globals.
    pub(super) fn parameters(&self, globals: &[f64]) -> Vec<f64> {
        let mut values = self.values.clone();
        for (&parameter, &global) in self.unknown.iter().zip(globals) {
            values[parameter] = global;
        }
        values
    }

    /// Returns the start value of a global; 0 for offsets.
    pub(super) fn start(&self, global: usize) -> f64 {
        let parameter = self.unknown.get(global);
        parameter.map_or(0.0, |&parameter| self.values[parameter])
    }

    /// Returns true if a global with this value is at its bound.
    pub(super) fn is_at_bound(&self, global: usize, value: f64) -> bool {
        self.bounds[global].contains(&value)
    }

    /// Returns the value within the bounds of a global that is nearest to the given one.
    pub(super) fn within(&self, global: usize, value: f64) -> f64 {
        let [least, largest] = self.bounds[global];
        value.max(least).min(largest)
    }

    /// Returns the number of data in a range of samples.
    pub(super) fn count(&self, samples: &Range<usize>) -> usize {
        let angles = self.links.iter().map(|link| &link.angles[samples.clone()]);
        angles.map(|angles| angles.iter().flatten().count()).sum()
    }

    /// Integrates a segment from an initial state. Returns the residuals (angles minus data, in
    /// standard deviations) and the state at the end; `None` if the integration fails.
    pub(super) fn shoot(
        &self,
        globals: &[f64],
        state: &[f64],
        samples: &Range<usize>,
    ) -> Option<(Vec<f64>, Vec<f64>)> {
        let motion = self.family.plain(&self.parameters(globals));
        let mut residuals = Vec::with_capacity(self.count(samples));
        let options = Options {
            absolute: Tolerance::Uniform(self.tolerance),
            ..Options::with_tolerance(self.tolerance)
        };
        let end = self.follow(
            (&*motion, 1),
            options,
            state.to_vec(),
            samples,
            |sample, state| {
                for link in &self.links {
                    if let Some(residual) = link.residual(sample, state, globals) {
                        residuals.push(residual);
                    }
                }
            },
        )?;
        Some((residuals, end))
    }

    /// Linearises a segment about its initial state and the given globals. `residuals` and
    /// `reached` are the results of [`shoot`](Self::shoot).
    pub(super) fn linearise(
        &self,
        globals: &[f64],
        free: &[usize],
        state: &[f64],
        samples: &Range<usize>,
        (residuals, reached): (&[f64], &[f64]),
    ) -> Option<LinearSegment> {
        let n = self.dimension;
        let parameter = |&global: &usize| Some((*self.unknown.get(global)?, self.scales[global]));
        let unknown: Vec<(usize, f64)> = free.iter().filter_map(parameter).collect();
        let width = n + unknown.len();
        let values = self.parameters(globals);
        let system = Sensitivities::new(self.family, n, &values, &unknown);
        let options = Options {
            absolute: Tolerance::Uniform(TOLERANCE_OF_COLUMNS),
            ..Options::with_tolerance(TOLERANCE_OF_COLUMNS)
        };
        let last = n + free.len();
        let mut data = DMatrix::zeros(residuals.len(), last + 1);
        let mut rows = residuals.iter().enumerate();
        let start = system.start(state);
        let weight = width.div_ceil(WIDTH) * (1 + WIDTH);
        let end = self.follow(
            (&system, weight),
            options,
            start,
            samples,
            |sample, state| {
                for link in &self.links {
                    if link.angles[sample].is_none() {
                        continue;
                    }
                    let Some((row, residual)) = rows.next() else {
                        continue;
                    };
                    for column in 0..width {
                        let slope = state[system.state_index(column, link.component)];
                        data[(row, column)] = link.weight * slope;
                    }
                    let offset = free.iter().position(|&global| Some(global) == link.offset);
                    if let Some((column, offset)) = offset.zip(link.offset) {
                        data[(row, n + column)] = link.weight * self.scales[offset];
                    }
                    data[(row, last)] = -residual;
                }
            },
        )?;
        let end = DMatrix::from_fn(n, last + 1, |component, column| match column {
            column if column < width => end[system.state_index(column, component)],
            column if column < last => 0.0,
            _ => reached[component],
        });
        let is_finite = data.iter().chain(end.iter()).all(|value| value.is_finite());
        is_finite.then_some(LinearSegment { data, end })
    }

    /// Integrates over a segment, up to the start of the next one if there is one. An evaluation of
    /// the system counts as `weight` evaluations of the model's equations.
    fn follow(
        &self,
        (system, weight): (&dyn Ode<f64>, usize),
        options: Options<f64>,
        start: Vec<f64>,
        samples: &Range<usize>,
        mut visit: impl FnMut(usize, &[f64]),
    ) -> Option<Vec<f64>> {
        let times = &self.times[samples.start..(samples.end + 1).min(self.times.len())];
        let start = State::new(*times.first()?, start);
        let mut sample = samples.start;
        let mut end = Vec::new();
        if !self.effort.may_continue() {
            return None;
        }
        let weight = (weight * self.dimension / 2) as u64;
        let system = Counted::new(system, self.effort, weight, samples.len());
        let run = Dop853::new(options).sample(&system, &start, times, |_, state| {
            if sample < samples.end {
                visit(sample, state);
            }
            sample += 1;
            end.clear();
            end.extend_from_slice(state);
        });
        let is_whole = run.is_ok() && sample == samples.start + times.len();
        is_whole.then_some(end)
    }
}

impl LinkData<'_> {
    fn residual(&self, sample: usize, state: &[f64], globals: &[f64]) -> Option<f64> {
        let angle = self.angles.get(sample).copied().flatten()?;
        let offset = self.offset.map_or(0.0, |offset| globals[offset]);
        Some(self.weight * (state[self.component] + offset - angle))
    }
}

/// Divides the times into segments of this length (s) or slightly more, as ranges of at least two
/// samples. A remainder of less than half of the length is added to the last segment.
pub(super) fn split(times: &[f64], length: f64) -> Vec<Range<usize>> {
    let Some(&last) = times.last().filter(|_| times.len() > 1) else {
        return Vec::new();
    };
    let mut segments = Vec::new();
    let mut start = 0;
    for (sample, time) in times.iter().enumerate().skip(2) {
        // Sums of steps need not reach a length exactly.
        let is_long = time - times[start] >= length * (1.0 - 1e-9);
        let is_last = last - time < 0.5 * length || times.len() - sample < 2;
        if is_long && !is_last && sample - start >= 2 {
            segments.push(start..sample);
            start = sample;
        }
    }
    segments.push(start..times.len());
    segments
}
