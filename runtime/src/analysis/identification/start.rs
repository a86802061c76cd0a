//! States to begin with: angles and velocities as the data show them.

use std::ops::Range;

use super::error::IdentificationError;
use super::fit::Fit;
use super::record::AngleRecord;
use super::task::FitTask;
use crate::analysis::KinematicSmoother;

impl FitTask<'_> {
    /// The segments of a fit; none where it is one of other times or of another tree.
    pub(super) fn segments_of(&self, fit: &Fit) -> Option<Vec<Range<usize>>> {
        let sample = |time: f64| self.times.iter().position(|own| *own == time);
        let firsts = fit.starts.iter().map(|start| sample(start.time));
        let firsts: Vec<usize> = firsts.collect::<Option<_>>()?;
        let is_whole = fit.until == self.times.last().copied() && firsts.first() == Some(&0);
        let mut starts = fit.starts.iter();
        let is_alike = starts.all(|start| start.values.len() == self.dimension);
        let ends = firsts.iter().copied().skip(1).chain([self.times.len()]);
        let segments = firsts.iter().zip(ends).map(|(&first, end)| first..end);
        (is_whole && is_alike).then(|| segments.collect())
    }

    /// A state for the start of each segment: of measured links by smoothness, of others as
    /// the motion of the segment before leaves them, and at rest in the beginning.
    pub(super) fn first_states(
        &self,
        record: &AngleRecord,
        globals: &[f64],
        segments: &[Range<usize>],
    ) -> Result<Vec<Vec<f64>>, IdentificationError> {
        let links = self.dimension / 2;
        let mut measured = Vec::with_capacity(self.links.len());
        for (data, link) in self.links.iter().zip(&record.links) {
            let smoothed = KinematicSmoother::default().smooth(self.times, data.angles);
            measured.push(smoothed.map_err(|error| IdentificationError::Velocities {
                link: link.name.clone(),
                error,
            })?);
        }
        let mut states = Vec::with_capacity(segments.len());
        let mut state = vec![0.0; self.dimension];
        for samples in segments {
            for (data, motion) in self.links.iter().zip(&measured) {
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
        Ok(states)
    }
}
