//! Initial states: angles and velocities estimated from the data.

use std::ops::Range;

use super::convergence::{Convergence, ROUNDING};
use super::error::IdentificationError;
use super::fit::{AngleErrors, Fit};
use super::record::{AngleRecord, MeasuredLink};
use super::release::{bends, resolution};
use super::task::FitTask;
use crate::KinematicSmoother;
use crate::smoothing::SmoothedMotion;

/// Estimates from the data that assume only that the motion is smooth.
pub(super) struct SmoothedRecord {
    links: Vec<SmoothedMotion>,
    /// Root mean square of the data's errors, rad.
    pub(super) noise: f64,
    /// Root mean square of the motion about its mean, rad, at most 1.
    pub(super) swing: f64,
}

impl SmoothedRecord {
    pub(super) fn new(record: &AngleRecord) -> Result<Self, IdentificationError> {
        let mut all = Self {
            links: Vec::with_capacity(record.links.len()),
            noise: 0.0,
            swing: 0.0,
        };
        let mut number = 0.0;
        for MeasuredLink { name, angles, .. } in &record.links {
            let smoothed = KinematicSmoother::default().smooth(record.times(), angles);
            let smoothed = smoothed.map_err(|error| IdentificationError::Velocities {
                link: name.clone(),
                error,
            })?;
            let data: Vec<f64> = angles.iter().flatten().copied().collect();
            let count = data.len() as f64;
            let mean = data.iter().sum::<f64>() / count;
            let errors = smoothed.noise().max(resolution(data.iter().copied()));
            all.noise += count * errors * errors;
            let from_mean = data.iter().map(|angle| (angle - mean).powi(2));
            all.swing += from_mean.sum::<f64>();
            number += count;
            all.links.push(smoothed);
        }
        let root = |squares: f64| (squares / f64::max(number, 1.0)).sqrt();
        (all.noise, all.swing) = (root(all.noise), root(all.swing).min(1.0));
        Ok(all)
    }
}

impl SmoothedRecord {
    /// Computes from the residuals `errors` whether and how well a search has converged.
    pub(super) fn compare(&self, before: &Convergence, errors: &AngleErrors) -> Convergence {
        let mut squares = 0.0;
        let mut count = 0;
        for link in 0..self.links.len() {
            let errors: Vec<f64> = errors.rows.iter().filter_map(|row| row[link]).collect();
            squares += bends(&errors);
            count += errors.len().saturating_sub(2);
        }
        let rough = (squares / count.max(1) as f64).sqrt();
        Convergence {
            noise: self.noise,
            ..*before
        }
        .with_residual(errors.rms(), rough)
    }
}

impl FitTask<'_> {
    /// Returns the errors of the angles, estimated from smoothness, in units of the given standard
    /// deviations; 1 if there are no angles.
    pub(super) fn spread(&self, smoothed: &SmoothedRecord) -> f64 {
        if self.links.is_empty() {
            return 1.0;
        }
        let weights: f64 = self.links.iter().map(|link| link.weight).sum();
        let noise = smoothed.noise.max(ROUNDING * smoothed.swing);
        noise * weights / self.links.len() as f64
    }

    /// Returns the segments of an earlier fit; `None` if it has other times or another tree.
    pub(super) fn segments_of(&self, fit: &Fit) -> Option<Vec<Range<usize>>> {
        let sample = |time: f64| self.times.iter().position(|own| *own == time);
        let firsts = fit.starts.iter().map(|start| sample(start.time));
        let firsts: Vec<usize> = firsts.collect::<Option<_>>()?;
        let is_whole = fit.until == self.times.last().copied() && firsts.first() == Some(&0);
        let mut starts = fit.starts.iter();
        let is_same_minimum = starts.all(|start| start.values.len() == self.dimension);
        let ends = firsts.iter().copied().skip(1).chain([self.times.len()]);
        let segments = firsts.iter().zip(ends).map(|(&first, end)| first..end);
        (is_whole && is_same_minimum).then(|| segments.collect())
    }

    /// Returns an initial state for each segment: for measured links from smoothing, for other
    /// links from the motion of the previous segment; in the first segment these are at rest.
    pub(super) fn first_states(
        &self,
        smoothed: &SmoothedRecord,
        globals: &[f64],
        segments: &[Range<usize>],
    ) -> Vec<Vec<f64>> {
        let links = self.dimension / 2;
        let mut states = Vec::with_capacity(segments.len());
        let mut state = vec![0.0; self.dimension];
        for samples in segments {
            for (data, motion) in self.links.iter().zip(&smoothed.links) {
                let [angle, velocity, _] = motion.mean(samples.start);
                let offset = data.offset.map_or(0.0, |offset| globals[offset]);
                state[data.component] = angle - offset;
                state[links + data.component] = velocity;
            }
            states.push(state.clone());
            if self.links.len() < links
                && let Some((_, end)) = self.shoot(globals, &state, samples)
            {
                state = end;
            }
        }
        states
    }
}
