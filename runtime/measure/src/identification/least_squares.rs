//! Levenberg–Marquardt iteration for a chain of segments.

use std::ops::Range;

use nalgebra::DMatrix;

use super::task::{FitTask, LinearSegment};

/// Largest number of steps of one stage.
const STEPS: usize = 100;
/// Relative decrease of the sum of squares below which the iteration ends: in early stages, which
/// only lead to the next one and are integrated less accurately, and in the last stage.
pub(super) const ROUGH: f64 = 3e-3;
pub(super) const FULL: f64 = 2e-6;
/// Number of steps that together must decrease the sum of squares by more than this share.
/// Otherwise the iteration moves along a valley without end, as happens with wrong models.
const WALK: usize = 10;
const WALKED: f64 = 1e-3;
/// Relative uncertainty of the sum of squares caused by the integration of long motions. A smaller
/// increase after a step does not count, and ends the iteration too.
const UNCERTAIN: f64 = 1e-4;
/// Root mean square of residuals, in standard deviations, at which the iteration ends.
const NOTHING: f64 = 1e-8;
/// Largest number of times that the relative weights of angles and frequencies are adjusted, and
/// the relative change of the angles' errors that counts as none.
const WEIGHINGS: usize = 10;
const SAME_WEIGHT: f64 = 1e-3;
/// Initial damping; the next constants are its factors of increase and decrease, and its bounds.
pub(super) const DAMPING: f64 = 1e-3;
const MORE: f64 = 6.0;
const LESS: f64 = 10.0;
const DAMPING_RANGE: [f64; 2] = [1e-10, 1e10];

/// Damping below which steps count as Gauss–Newton steps.
const NEARLY_FREE: f64 = 1e-2;

/// Largest sum of squares, relative to the previous one, at which another choice of fixed unknowns
/// is worth trying.
const WORTH: f64 = 0.99;

/// Segments of a stage, with the present estimate.
#[derive(Clone, Debug)]
pub(super) struct FitStage {
    pub(super) segments: Vec<Range<usize>>,
    pub(super) starts: Vec<Vec<f64>>,
    pub(super) globals: Vec<f64>,
    /// Indices of the globals that are fitted; the others stay fixed.
    pub(super) free: Vec<usize>,
    /// Weights of the jump between the end of a segment and the start of the next.
    pub(super) junction: Vec<f64>,
    /// Errors of the angles, in units of the given standard deviations. It sets the weight of
    /// frequencies, whose standard errors are absolute. 1 if there are no angles.
    pub(super) spread: f64,
    /// Damping of the next step. Longer segments start with the damping of shorter ones.
    pub(super) damping: f64,
}

/// Residuals of a stage, in standard deviations.
#[derive(Clone)]
pub(super) struct Residuals {
    /// Residuals of angles, segment by segment.
    pub(super) angles: Vec<Vec<f64>>,
    /// States at the ends of the segments.
    ends: Vec<Vec<f64>>,
    /// Sum of squares of all.
    pub(super) squares: f64,
    /// Sum of squares of frequencies.
    of_frequencies: f64,
}

/// A stage that is solved.
#[derive(Clone)]
pub(super) struct Solved {
    pub(super) residuals: Residuals,
    pub(super) steps: usize,
    /// Globals that were held.
    pub(super) held: Vec<usize>,
}

/// A stage with derivatives.
pub(super) struct LinearStage {
    pub(super) segments: Vec<LinearSegment>,
    /// Rows on the globals alone.
    pub(super) prior: DMatrix<f64>,
}

/// Limit on the length of a step: additional rows √λ D x = 0.
pub(super) struct Damping {
    /// Factors √λ D for the components of each initial state.
    pub(super) starts: Vec<Vec<f64>>,
    /// √λ D of the globals.
    pub(super) globals: Vec<f64>,
}

impl FitStage {
    /// Joins every two neighbouring segments into one.
    pub(super) fn merge(&mut self) {
        let pairs = self.segments.chunks(2);
        let merged = pairs.filter_map(|pair| Some(pair.first()?.start..pair.last()?.end));
        self.segments = merged.collect();
        let mut index = 0;
        self.starts.retain(|_| {
            index += 1;
            index % 2 == 1
        });
    }

    /// Computes the residuals; `None` if there is no such model or motion.
    pub(super) fn residuals(&self, task: &FitTask<'_>) -> Option<Residuals> {
        let frequencies = task.frequency_residuals(&self.globals, self.spread)?;
        let of_frequencies = sum_of_squares(&frequencies);
        let mut squares = of_frequencies;
        let mut angles = Vec::with_capacity(self.segments.len());
        let mut ends = Vec::with_capacity(self.segments.len());
        for (index, samples) in self.segments.iter().enumerate() {
            let (residuals, end) = task.shoot(&self.globals, &self.starts[index], samples)?;
            squares += sum_of_squares(&residuals);
            angles.push(residuals);
            if let Some(next) = self.starts.get(index + 1) {
                let jumps = end.iter().zip(next).zip(&self.junction);
                let jumps = jumps.map(|((end, next), weight)| weight * (end - next));
                squares += jumps.map(|jump| jump * jump).sum::<f64>();
            }
            ends.push(end);
        }
        let is_finite = squares.is_finite();
        is_finite.then_some(Residuals {
            angles,
            ends,
            squares,
            of_frequencies,
        })
    }

    /// Returns the variance of the angles in units of the given standard deviations: the sum of
    /// squared residuals divided by the number of data minus unknowns. 1 if there are no angles.
    pub(super) fn variance(&self, task: &FitTask<'_>, residuals: &Residuals) -> f64 {
        let angles: usize = residuals.angles.iter().map(Vec::len).sum();
        if angles == 0 {
            return 1.0;
        }
        // A junction takes as many away as a start adds.
        let unknown = task.names.len() + task.dimension.min(angles);
        let squares = residuals.squares - residuals.of_frequencies;
        squares.max(0.0) / angles.saturating_sub(unknown).max(1) as f64
    }

    pub(super) fn linearise(
        &self,
        task: &FitTask<'_>,
        residuals: &Residuals,
    ) -> Option<LinearStage> {
        let segments = self.segments.iter().zip(&self.starts);
        let known = residuals.angles.iter().zip(&residuals.ends);
        let segments = segments
            .zip(known)
            .map(|((samples, start), (angles, end))| {
                task.linearise(&self.globals, &self.free, start, samples, (angles, end))
            });
        Some(LinearStage {
            segments: segments.collect::<Option<_>>()?,
            prior: task.frequency_rows(&self.globals, &self.free, self.spread)?,
        })
    }

    /// Solves a stage, with those unknowns fixed that data of this kind cannot determine.
    ///
    /// The fixed values may not allow real values of others, as a mass whose inertia is too large.
    /// Then the fit does not reach the motion, the open directions change, and other unknowns are
    /// fixed from there on.
    pub(super) fn solve_determined(
        &mut self,
        task: &FitTask<'_>,
        settled: f64,
        choices: usize,
    ) -> Option<Solved> {
        let mut known = self.residuals(task)?;
        let (mut before, mut steps) = (known.squares, 0);
        for choice in 1.. {
            self.free = (0..task.names.len()).collect();
            let Some(linear) = self.linearise(task, &known) else {
                return task.effort.is_over().then_some(Solved {
                    residuals: known,
                    steps,
                    held: Vec::new(),
                });
            };
            let globals = self.eliminate(&linear, None).globals;
            let held = task.open_directions(&self.globals, &globals, 0.0, &[]).held;
            self.free.retain(|global| !held.contains(global));
            let linear = linear.only(&self.free);
            let (residuals, more) = self.solve_from(task, settled, known, linear)?;
            steps += more;
            let is_last = choice >= choices || task.effort.is_over();
            if is_last || residuals.squares > WORTH * before {
                return Some(Solved {
                    residuals,
                    steps,
                    held,
                });
            }
            before = residuals.squares;
            known = residuals;
        }
        None
    }

    /// Solves a stage as [`solve_determined`](Self::solve_determined) does; if there are both
    /// angles and frequencies, the weights are adjusted until they agree with the residuals of the
    /// angles, which maximises the likelihood.
    pub(super) fn solve_weighed(
        &mut self,
        task: &FitTask<'_>,
        settled: f64,
        choices: usize,
    ) -> Option<Solved> {
        let mut solved = self.solve_determined(task, settled, choices)?;
        if task.frequencies.is_empty() || task.links.is_empty() {
            return Some(solved);
        }
        for _ in 0..WEIGHINGS {
            let spread = self.variance(task, &solved.residuals).sqrt().max(NOTHING);
            let is_same = (spread - self.spread).abs() <= SAME_WEIGHT * self.spread;
            self.spread = spread;
            if is_same || task.effort.is_over() {
                return Some(solved);
            }
            let steps = solved.steps;
            solved = self.solve_determined(task, settled, 1)?;
            solved.steps += steps;
        }
        // Weights that come to no end are none.
        None
    }

    /// Iterates to the nearest minimum of the sum of squares, until a step decreases it by less
    /// than the share `settled`. Returns the residuals there and the number of steps; `None` if
    /// there is no motion at the start.
    pub(super) fn solve(&mut self, task: &FitTask<'_>, settled: f64) -> Option<(Residuals, usize)> {
        let residuals = self.residuals(task)?;
        let linear = self.linearise(task, &residuals)?;
        self.solve_from(task, settled, residuals, linear)
    }

    fn solve_from(
        &mut self,
        task: &FitTask<'_>,
        settled: f64,
        mut best: Residuals,
        mut linear: LinearStage,
    ) -> Option<(Residuals, usize)> {
        let count: usize = best.angles.iter().map(Vec::len).sum();
        let nothing = (count + task.frequencies.len()) as f64 * NOTHING * NOTHING;
        self.damping = self.damping.min(DAMPING);
        let mut before = f64::INFINITY;
        for step in 0..STEPS {
            let is_stuck = self.damping > DAMPING_RANGE[1];
            if best.squares <= nothing || is_stuck || task.effort.is_over() {
                return Some((best, step));
            }
            if step % WALK == 0 {
                if before - best.squares <= WALKED * best.squares {
                    return Some((best, step));
                }
                before = best.squares;
            }
            let Some((trial, residuals)) = self.step(task, &linear) else {
                self.damping *= MORE;
                continue;
            };
            let gain = best.squares - residuals.squares;
            let small = match gain > 0.0 {
                true => settled,
                false => settled.max(UNCERTAIN),
            };
            // A step that is held back changes little wherever it is.
            let is_free = self.damping <= NEARLY_FREE;
            let is_settled = is_free && gain.abs() <= small * best.squares;
            if gain > 0.0 {
                (*self, best) = (trial, residuals);
                self.damping = (self.damping / LESS).max(DAMPING_RANGE[0]);
            } else {
                self.damping *= MORE;
            }
            if is_settled {
                return Some((best, step + 1));
            }
            if gain > 0.0 {
                let Some(next) = self.linearise(task, &best) else {
                    return task.effort.is_over().then_some((best, step + 1));
                };
                linear = next;
            }
        }
        Some((best, STEPS))
    }

    /// Makes one step and returns the residuals after it. A global at its bound stays there if the
    /// step would exceed the bound.
    fn step(&self, task: &FitTask<'_>, linear: &LinearStage) -> Option<(Self, Residuals)> {
        let mut columns: Vec<usize> = (0..self.free.len()).collect();
        let mut reduced: Option<LinearStage> = None;
        let (globals, starts) = loop {
            let own = reduced.as_ref().unwrap_or(linear);
            let damping = own.damping(self.damping.sqrt());
            let (globals, starts) = self.eliminate(own, Some(&damping)).solve()?;
            let is_beyond = |(column, step): (&usize, &f64)| {
                let (global, value) = (self.free[*column], self.globals[self.free[*column]]);
                let step = step * task.scales[global];
                task.is_at_bound(global, value)
                    && task.within(global, value + step) == value
                    && step != 0.0
            };
            let inside = columns
                .iter()
                .zip(&globals)
                .filter(|&pair| !is_beyond(pair));
            let inside: Vec<usize> = inside.map(|(column, _)| *column).collect();
            if inside.len() == columns.len() {
                break (globals, starts);
            }
            columns = inside;
            reduced = Some(linear.only(&columns));
        };
        let mut trial = self.clone();
        for (&column, step) in columns.iter().zip(&globals) {
            let global = self.free[column];
            let value = trial.globals[global] + step * task.scales[global];
            trial.globals[global] = task.within(global, value);
        }
        for (start, step) in trial.starts.iter_mut().zip(&starts) {
            for (value, step) in start.iter_mut().zip(step) {
                *value += step;
            }
        }
        let residuals = trial.residuals(task)?;
        Some((trial, residuals))
    }
}

impl LinearStage {
    /// Returns the stage with only some of its globals fitted.
    fn only(&self, globals: &[usize]) -> Self {
        let last = self.prior.ncols() - 1;
        let columns: Vec<usize> = globals.iter().copied().chain([last]).collect();
        let segments = self.segments.iter();
        Self {
            segments: segments.map(|segment| segment.only(globals)).collect(),
            prior: self.prior.select_columns(&columns),
        }
    }

    /// Returns the damping in units of the lengths of the columns, which makes it independent of
    /// units.
    fn damping(&self, root: f64) -> Damping {
        let columns = self.prior.ncols() - 1;
        let mut globals: Vec<f64> = (0..columns)
            .map(|column| self.prior.column(column).norm_squared())
            .collect();
        let mut starts = Vec::with_capacity(self.segments.len());
        for LinearSegment { data, end } in &self.segments {
            let n = end.nrows();
            let length = |column: usize| data.column(column).norm_squared();
            starts.push((0..n).map(|column| rooted(root, length(column))).collect());
            for (global, square) in globals.iter_mut().enumerate() {
                *square += length(n + global);
            }
        }
        Damping {
            starts,
            globals: globals.iter().map(|&square| rooted(root, square)).collect(),
        }
    }
}

/// Returns one damping factor; a column of length zero counts as one of length 1.
fn rooted(root: f64, square: f64) -> f64 {
    match square > 0.0 {
        true => root * square.sqrt(),
        false => root,
    }
}

fn sum_of_squares(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum()
}
