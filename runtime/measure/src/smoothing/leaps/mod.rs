//! Rows of a record at which the motion leaps, that is, violates the equations of motion.

mod window;

use std::ops::Range;

use nalgebra::DVector;

use self::window::{MotionWindow, WindowFit};
use super::error::{SmoothingError, check_length, check_times, usual_interval};
use branched_pendulum::analysis::variational::{Linearised, Variational};
use branched_pendulum::integrate::Integrator;

/// Search for rows at which a record leaves its equations of motion for a moment: angles that step
/// or change their sign, rows that are missing although the clock continues, frozen or exchanged
/// values.
///
/// A motion that satisfies the equations is fitted to each short window of rows. In a correct
/// record, the residual of a window is the noise of the data. A leap within a window cannot be
/// fitted, however fast the motion is, and leaves a much larger residual. A small leap shows in
/// longer windows: two motions, one before and one behind it, leave a smaller residual than one
/// motion. Slightly wrong equations leave larger residuals in all neighbouring windows, which is not
/// a leap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeapSearch {
    /// Longest short window and longest long window, s.
    pub spans: [f64; 2],
    /// Smallest and largest number of rows, of a short window and of a long one.
    pub rows: [[usize; 2]; 2],
    /// Smallest standard deviation of the data that is assumed, in rad; smaller residuals are
    /// rounding of a simulation.
    pub noise: f64,
    /// Limit of a short window's mean square residual, in standard deviations that noise alone
    /// causes, above which the window has a leap.
    pub deviations: f64,
    /// Limit of the sum of squares by which two motions fit a long window better than one, in
    /// standard deviations that noise alone causes, above which the window has a leap.
    pub change_deviations: f64,
    /// Limit of the same quantities, relative to those of windows nearby, above which a window has a
    /// leap.
    pub ratio: f64,
    /// Largest fraction of all windows that may have leaps. If more do, the equations are wrong and
    /// no leap is reported.
    pub part: f64,
}

impl Default for LeapSearch {
    fn default() -> Self {
        Self {
            spans: [0.1, 0.4],
            rows: [[8, 20], [16, 64]],
            noise: 1e-5,
            deviations: 6.5,
            change_deviations: 10.0,
            ratio: 3.0,
            part: 0.3,
        }
    }
}

/// Number of window starts per length of a window.
const STRIDE: usize = 3;
/// Number of rows at the ends of a window where the fit can follow a leap.
const BLIND: usize = 2;
/// Distance, in lengths of a window, up to which windows on both sides are compared.
const NEAR: usize = 5;
/// Factor of the limit [`LeapSearch::ratio`] if only the windows on one side are below it.
const ONSET: f64 = 2.0;
/// Gain by two motions that noise alone causes at most in three of four windows, in its mean square
/// and for each number of a state.
const USUAL: f64 = 3.0;
/// Quantile of the values of windows nearby with which a window is compared.
const QUARTILE: f64 = 0.75;

/// Window of rows with the motion that is fitted to it.
struct Fitted {
    rows: Range<usize>,
    fit: WindowFit,
}

impl LeapSearch {
    /// Longest step (s) of a fourth-order method within a window: its error is far below
    /// [`noise`](Self::noise).
    pub const LONGEST_STEP: f64 = 5e-3;

    /// Returns the ranges of rows within which the motion leaps, in ascending order.
    ///
    /// | argument | meaning |
    /// |---|---|
    /// | `method` | integrates from row to row |
    /// | `system` | rates of a state of 2n numbers: n angles, followed by their rates |
    /// | `data` | for each time a row of the n angles (rad), none where one is missing |
    ///
    /// The effort is linear in the number of rows: each row is in three windows of each length.
    ///
    /// # Errors
    ///
    /// [`SmoothingError`] for data that do not fit to the times or to the system.
    pub fn find<L, M>(
        &self,
        method: &M,
        system: &L,
        times: &[f64],
        data: &[Vec<Option<f64>>],
    ) -> Result<Vec<Range<usize>>, SmoothingError>
    where
        L: Linearised<f64>,
        M: for<'a> Integrator<f64, Variational<'a, L>>,
    {
        let dimension = system.dimension();
        let links = dimension / 2;
        check_length(times, "data", data.len())?;
        if dimension != 2 * links {
            return Err(SmoothingError::Dimension { dimension });
        }
        if let Some(index) = data.iter().position(|row| row.len() != links) {
            let (rows, found, needed) = ("data", data[index].len(), links);
            return Err(SmoothingError::Row {
                rows,
                index,
                found,
                needed,
            });
        }
        check_times(times)?;
        if times.len() < 2 {
            return Ok(Vec::new());
        }
        let unit = usual_interval(times);
        let lengths = [0, 1].map(|scale| {
            let [fewest, most] = self.rows[scale];
            ((self.spans[scale] / unit).round() as usize).clamp(fewest, most)
        });
        let fitted =
            |length: usize, stride: usize, guess: &dyn Fn(usize) -> Option<DVector<f64>>| {
                let starts = (0..).step_by(stride);
                let starts = starts.take_while(|start| start + length <= times.len());
                let windows = starts.map(|start| start..start + length);
                let is_whole = |rows: &Range<usize>| {
                    times[rows.end - 1] - times[rows.start] < 2.0 * unit * length as f64
                };
                let windows = windows.filter(is_whole);
                let fitted = windows.filter_map(|rows| {
                    let window = MotionWindow {
                        times: &times[rows.clone()],
                        data: &data[rows.clone()],
                        links,
                    };
                    let fit = window.fit(method, system, guess(rows.start).as_ref())?;
                    Some(Fitted { rows, fit })
                });
                fitted.collect::<Vec<_>>()
            };
        let [short, long] = lengths;
        let stride = (short / STRIDE).max(1);
        let windows = fitted(short, stride, &|_| None);
        let mut leaps = self.in_short(&windows, short / stride);
        // The motion of a short window is the first approximation in a long one.
        let begun = |start: usize| {
            let index = windows.binary_search_by_key(&start, |own| own.rows.start);
            Some(windows[index.ok()?].fit.state.clone())
        };
        let stride = (long / STRIDE / stride).max(1) * stride;
        let windows = fitted(long, stride, &begun);
        leaps.extend(self.in_long(&windows, long / stride));
        Ok(joined(leaps))
    }

    /// Finds the short windows that have leaps, and joins those that overlap.
    fn in_short(&self, windows: &[Fitted], overlap: usize) -> Vec<Range<usize>> {
        let squares: Vec<f64> = windows.iter().map(|own| own.fit.square).collect();
        let usual = quantile(squares.clone(), 0.5).max(self.noise * self.noise);
        let has_leap = |index: &usize| {
            let WindowFit {
                square, freedom, ..
            } = windows[*index].fit;
            let near = quantile(
                nearby(&squares, *index, 2 * overlap, NEAR * overlap).concat(),
                QUARTILE,
            );
            let noise = 1.0 + self.deviations * (2.0 / freedom).sqrt();
            square > noise * usual && square > self.ratio * near.max(usual)
        };
        let found: Vec<usize> = (0..windows.len()).filter(has_leap).collect();
        if found.len() as f64 > self.part * windows.len() as f64 {
            return Vec::new();
        }
        // Windows that follow each other and have leaps show one stretch.
        let runs = found.chunk_by(|a, b| a + 1 == *b);
        let runs = runs.filter_map(|run| {
            let [first, last] = [run.first()?, run.last()?].map(|index| &windows[*index].rows);
            // The leap is near the end of the first window and near the start of the last.
            let ends = [first.end - 1 - BLIND, last.start + BLIND];
            let [start, end] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
            Some(start..end + 1)
        });
        runs.collect()
    }

    /// Finds the rows of long windows at which the change to another motion is a leap.
    fn in_long(&self, windows: &[Fitted], overlap: usize) -> Vec<Range<usize>> {
        let squares: Vec<f64> = windows.iter().map(|own| own.fit.square).collect();
        let usual = quantile(squares, 0.25).max(self.noise * self.noise);
        let gain = |own: &Fitted| own.fit.change.map_or(0.0, |change| change.gain);
        let gains: Vec<f64> = windows.iter().map(gain).collect();
        let size = windows.first().map_or(0, |own| own.fit.state.len()) as f64;
        let noise = size + self.change_deviations * (2.0 * size).sqrt();
        let has_leap = |index: &usize| {
            let sides = nearby(&gains, *index, overlap, NEAR * overlap);
            let quartile = |side: &[f64]| quantile(side.to_vec(), QUARTILE);
            let quietest = sides.into_iter().filter(|side| !side.is_empty());
            let quietest = quietest.map(quartile).fold(f64::INFINITY, f64::min);
            // Gains nearby that noise alone does not cause, in addition to its limit.
            let limit =
                |ratio: f64, near: f64| noise + ratio * (near / usual - USUAL * size).max(0.0);
            // From a fault that lasts on, the equations are wrong on one side.
            let limit = limit(self.ratio, quartile(&sides.concat()))
                .min(limit(ONSET * self.ratio, quietest));
            gains[*index] > limit * usual
        };
        let found: Vec<usize> = (0..windows.len()).filter(has_leap).collect();
        let runs: Vec<&[usize]> = found.chunk_by(|a, b| a + 1 == *b).collect();
        if runs.len() as f64 > self.part * windows.len() as f64 {
            return Vec::new();
        }
        // The first window of a run shows where it begins; the one with the largest gain, a leap.
        let stretches = runs.into_iter().flat_map(|run| {
            let largest = run.iter().max_by(|a, b| gains[**a].total_cmp(&gains[**b]));
            run.first().into_iter().chain(largest).copied()
        });
        let stretches = stretches.filter_map(|index| {
            let Fitted { rows, fit } = &windows[index];
            let row = rows.start + fit.change?.row;
            Some(row - BLIND..row + BLIND)
        });
        stretches.collect()
    }
}

/// Returns the values of windows nearby, before a window and behind it: more than `near` and at most
/// `far` windows away.
fn nearby(values: &[f64], index: usize, near: usize, far: usize) -> [&[f64]; 2] {
    let before = index.saturating_sub(far)..index.saturating_sub(near);
    let behind = index + near + 1..values.len().min(index + far + 1);
    [before, behind].map(|side| values.get(side).unwrap_or_default())
}

/// Sorts ranges, and joins those that overlap.
fn joined(mut stretches: Vec<Range<usize>>) -> Vec<Range<usize>> {
    stretches.sort_unstable_by_key(|rows| rows.start);
    let mut all: Vec<Range<usize>> = Vec::new();
    for rows in stretches {
        match all.last_mut().filter(|last| rows.start <= last.end) {
            Some(last) => last.end = last.end.max(rows.end),
            None => all.push(rows),
        }
    }
    all
}

/// Returns the quantile of the values below which the fraction `part` of them lies; 0 for no
/// values.
fn quantile(mut values: Vec<f64>, part: f64) -> f64 {
    let index = (part * values.len() as f64) as usize;
    if index >= values.len() {
        return 0.0;
    }
    *values.select_nth_unstable_by(index, f64::total_cmp).1
}
