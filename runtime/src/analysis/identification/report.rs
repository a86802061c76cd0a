//! From the last stage to what users see of it.

use super::covariance::{TimeBlocks, by_curvature};
use super::error::IdentificationError;
use super::family::Family;
use super::fit::{AngleErrors, Fit, ParameterEstimate, StageReport};
use super::least_squares::{FitStage, Residuals};
use super::problem::{Identification, no_motion};
use super::record::{AngleRecord, MeasuredLink};
use super::task::{FitTask, LinkData};
use crate::system::State;

/// Number of blocks where no length is asked for.
const BLOCKS: f64 = 30.0;

impl<F: Family> Identification<F> {
    pub(super) fn report(
        &self,
        task: &FitTask<'_>,
        mut stage: FitStage,
        held: &[usize],
        residuals: &Residuals,
        stages: Vec<StageReport>,
        record: &AngleRecord,
    ) -> Result<Fit, IdentificationError> {
        let times = record.times();
        stage.free = (0..task.names.len()).collect();
        let linear = stage.linearise(task, residuals);
        let linear = linear.ok_or_else(|| no_motion(record))?;
        let elimination = stage.eliminate(&linear, None);
        let triangle = elimination
            .globals
            .columns(0, task.names.len())
            .into_owned();
        let angles: usize = residuals.angles.iter().map(Vec::len).sum();
        let data = angles + task.frequencies.len();
        // A junction takes as many away as a start adds.
        let unknown = task.names.len() + task.dimension.min(angles);
        let variance = residuals.squares / data.saturating_sub(unknown).max(1) as f64;
        let (identifiability, held) =
            task.identifiability(&stage.globals, &triangle, variance.sqrt(), held);
        let free = (0..task.names.len()).filter(|index| !held.contains(index));
        let free: Vec<usize> = free.collect();
        let span = times
            .last()
            .zip(times.first())
            .map_or(0.0, |(last, first)| last - first);
        let length = self
            .shooting
            .block
            .unwrap_or(span / BLOCKS)
            .max(f64::MIN_POSITIVE);
        let blocks = TimeBlocks::new(task, &stage, &linear, &elimination, length);
        let deviations = |variances: Option<Vec<f64>>| {
            let variances = variances.unwrap_or_else(|| vec![f64::INFINITY; free.len()]);
            let mut all = vec![None; task.names.len()];
            for (&index, variance) in free.iter().zip(variances) {
                all[index] = Some(task.scales[index] * variance.sqrt());
            }
            all
        };
        let naive = deviations(by_curvature(&triangle, &free, variance));
        let by_blocks = deviations(blocks.as_ref().and_then(|blocks| blocks.variances(&free)));
        let estimate = |(index, name): (usize, &String)| ParameterEstimate {
            name: name.clone(),
            value: stage.globals[index],
            naive: naive[index],
            by_blocks: by_blocks[index],
        };
        let starts = stage.segments.iter().zip(&stage.starts);
        let offset = |(index, link): (usize, &MeasuredLink)| {
            let offset = task.links[index]
                .offset
                .map_or(0.0, |offset| stage.globals[offset]);
            (link.name.clone(), offset)
        };
        Ok(Fit {
            estimates: task.names.iter().enumerate().map(estimate).collect(),
            identifiability,
            starts: starts
                .map(|(samples, start)| State::new(times[samples.start], start.clone()))
                .collect(),
            until: times.last().copied(),
            stages,
            blocks: blocks.map_or(0, |blocks| blocks.count()),
            impossible: self.family.check(&task.parameters(&stage.globals)).err(),
            values: task.parameters(&stage.globals),
            offsets: record.links.iter().enumerate().map(offset).collect(),
        })
    }
}

impl FitTask<'_> {
    /// Angles less data of a stage, rad.
    pub(super) fn errors(&self, stage: &FitStage, residuals: &Residuals) -> AngleErrors {
        let mut rows = Vec::new();
        for (samples, residuals) in stage.segments.iter().zip(&residuals.angles) {
            let mut next = residuals.iter();
            rows.extend(samples.clone().map(|sample| {
                let error = |link: &LinkData<'_>| {
                    let _ = link.angles[sample]?;
                    next.next().map(|residual| residual / link.weight)
                };
                self.links.iter().map(error).collect::<Vec<_>>()
            }));
        }
        AngleErrors {
            times: self.times.to_vec(),
            links: Vec::new(),
            rows,
        }
    }
}
