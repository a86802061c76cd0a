//! Comparison of a fit with records: the fitted one, or others.

use super::effort::Effort;
use super::error::{IdentificationError, positive};
use super::family::Family;
use super::fit::{AngleErrors, Fit};
use super::least_squares::{DAMPING, FULL, FitStage};
use super::problem::Identification;
use super::record::{AngleRecord, MeasuredLink, no_motion};
use super::start::SmoothedRecord;
use super::task::split;
use crate::smoothing::misplaced;
use branched_pendulum::integrate::{Dop853, Integrator, Options};
use branched_pendulum::system::State;

/// Largest number of integration steps of a motion: a fixed number, plus a number for each time.
const STEPS: u64 = 200_000;
const STEPS_FOR_EACH: u64 = 100;

impl<F: Family> Identification<F> {
    /// Computes the motion of a fit from the start of its record: angles and velocities of all
    /// links at `times`, none of which may be before the start.
    ///
    /// # Errors
    ///
    /// [`IdentificationError::Time`], [`IdentificationError::NoMotion`].
    pub fn predict(
        &self,
        fit: &Fit,
        times: &[f64],
    ) -> Result<Vec<State<f64>>, IdentificationError> {
        let Some(start) = fit.starts.first() else {
            return Ok(Vec::new());
        };
        let before = times.first().filter(|&&first| first < start.time);
        let before = before.map(|&first| (0, first));
        if let Some((index, value)) = before.or_else(|| misplaced(times)) {
            return Err(IdentificationError::Time { index, value });
        }
        let equations = self.family.equations(fit.parameters());
        // Constants that are not physical may need steps without end.
        let method = Dop853::new(Options {
            step_limit: STEPS + STEPS_FOR_EACH * times.len() as u64,
            ..Options::with_tolerance(self.shooting.tolerance)
        });
        let motion = method.sample_to_vec(&equations, start, times);
        motion.map_err(|_| IdentificationError::NoMotion { time: start.time })
    }

    /// Compares the motion of a fit, integrated from its start without correction, with a record:
    /// the fitted one, or a later one.
    ///
    /// # Errors
    ///
    /// As [`predict`](Self::predict), and for an invalid record.
    pub fn errors(
        &self,
        fit: &Fit,
        record: &AngleRecord,
    ) -> Result<AngleErrors, IdentificationError> {
        let indices = record.check(&self.family.links())?;
        let motion = self.predict(fit, record.times())?;
        let row = |(sample, state): (usize, &State<f64>)| {
            let links = record.links.iter().zip(&indices);
            let error = |(link, &index): (&MeasuredLink, &usize)| {
                let angle = link.angles[sample]?;
                Some(state.values[index] + fit.offset(&link.name) - angle)
            };
            links.map(error).collect()
        };
        Ok(AngleErrors {
            times: record.times().to_vec(),
            links: record.links.iter().map(|link| link.name.clone()).collect(),
            rows: motion.iter().enumerate().map(row).collect(),
        })
    }

    /// Compares a fit with a record in windows of length `length` (s). Each window starts from the
    /// state that fits it best, so that errors of the model do not accumulate over windows.
    ///
    /// # Errors
    ///
    /// [`IdentificationError`].
    pub fn window_errors(
        &self,
        fit: &Fit,
        record: &AngleRecord,
        length: f64,
    ) -> Result<AngleErrors, IdentificationError> {
        positive("length of windows", length)?;
        let effort = Effort::unbounded();
        let (mut task, _) = self.task(record, &effort)?;
        task.values.clone_from(&fit.values);
        // They have no part in a motion whose parameters are found.
        task.frequencies.clear();
        let of_link = |link: &MeasuredLink| fit.offset(&link.name);
        let mut globals: Vec<f64> = task
            .unknown
            .iter()
            .map(|&index| fit.values[index])
            .collect();
        if self.offsets {
            globals.extend(record.links.iter().map(of_link));
        }
        let is_own = fit.stages.last().is_some_and(|last| last.length == length);
        let (segments, starts) = match task.segments_of(fit).filter(|_| is_own) {
            Some(own) => (own, fit.start_states()),
            None => {
                let segments = split(record.times(), length);
                let smoothed = SmoothedRecord::new(record)?;
                let starts = task.first_states(&smoothed, &globals, &segments);
                (segments, starts)
            }
        };
        let mut all = AngleErrors {
            times: record.times().to_vec(),
            links: record.links.iter().map(|link| link.name.clone()).collect(),
            rows: Vec::new(),
        };
        for (samples, start) in segments.into_iter().zip(starts) {
            let mut stage = FitStage {
                segments: vec![samples],
                starts: vec![start],
                globals: globals.clone(),
                free: Vec::new(),
                junction: Vec::new(),
                spread: 1.0,
                damping: DAMPING,
            };
            let (residuals, _) = stage.solve(&task, FULL).ok_or_else(|| no_motion(record))?;
            all.rows.extend(task.errors(&stage, &residuals).rows);
        }
        Ok(all)
    }
}
