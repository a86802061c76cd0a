//! Construction of the result of an identification from its last stage.

use super::convergence::Convergence;
use super::covariance::{Curvature, TimeBlocks};
use super::error::IdentificationError;
use super::family::Family;
use super::fit::{AngleErrors, Fit};
use super::fitted::FittedGlobals;
use super::least_squares::{FitStage, Residuals, Solved};
use super::record::MeasuredLink;
use super::record::no_motion;
use super::search::{Rung, Search};
use super::task::{FitTask, LinkData};
use branched_pendulum::system::State;

/// Number of blocks of time if no length is given.
const BLOCKS: f64 = 30.0;

/// Standard deviation of the data below which residuals are considered rounding.
const ROUNDING: f64 = 1e-5;

impl<F: Family> Search<'_, F> {
    pub(super) fn report(&self, rung: Rung) -> Result<Fit, IdentificationError> {
        let (task, record) = (&self.task, self.record);
        let Rung {
            mut stage,
            solved: Solved {
                residuals, held, ..
            },
            reports,
            convergence,
            ..
        } = rung;
        let times = record.times();
        stage.free = (0..task.names.len()).collect();
        let linear = stage.linearise(task, &residuals);
        let linear = linear.ok_or_else(|| no_motion(record))?;
        let elimination = stage.eliminate(&linear, None);
        let variance = stage.variance(task, &residuals);
        let globals = &stage.globals;
        let open = task.open_directions(globals, &elimination.globals, variance.sqrt(), &held);
        let is_free = |&index: &usize| {
            !open.held.contains(&index) && !task.is_at_bound(index, globals[index])
        };
        let free: Vec<usize> = (0..task.names.len()).filter(is_free).collect();
        let length = self.block_length();
        let fitted = FittedGlobals {
            task,
            globals,
            curvature: Curvature::new(&elimination.globals, &free),
            variance,
            blocks: TimeBlocks::new(task, &stage, &linear, &elimination, length),
            open,
            free,
        };
        let estimates = fitted.estimates();
        let ratios = fitted.ratios(&estimates);
        let distance = fitted.curvature.distance(variance.sqrt().max(ROUNDING));
        let starts = stage.segments.iter().zip(&stage.starts);
        let values = task.parameters(globals);
        Ok(Fit {
            estimates,
            ratios,
            convergence: Convergence {
                distance,
                ..convergence
            },
            blocks: fitted.blocks.as_ref().map_or(0, TimeBlocks::count),
            identifiability: fitted.open.with_names(&task.names),
            frequencies: task.fitted_frequencies(globals).unwrap_or_default(),
            alternatives: Vec::new(),
            starts: starts
                .map(|(samples, start)| State::new(times[samples.start], start.clone()))
                .collect(),
            until: times.last().copied(),
            stages: reports,
            impossible: self.identification.family.check(&values).err(),
            values,
            offsets: self.offsets(globals),
        })
    }

    /// Returns the length of the blocks of time, s.
    fn block_length(&self) -> f64 {
        let times = self.record.times();
        let ends = times.last().zip(times.first());
        let span = ends.map_or(0.0, |(last, first)| last - first);
        let length = self.shooting.block.unwrap_or(span / BLOCKS);
        length.max(f64::MIN_POSITIVE)
    }

    /// Returns the offsets of the measured links (rad), with their names.
    fn offsets(&self, globals: &[f64]) -> Vec<(String, f64)> {
        let links = self.record.links.iter().zip(&self.task.links);
        let offset = |(link, data): (&MeasuredLink, &LinkData<'_>)| {
            let offset = data.offset.map_or(0.0, |offset| globals[offset]);
            (link.name.clone(), offset)
        };
        links.map(offset).collect()
    }
}

impl FitTask<'_> {
    /// Returns the angles of the model minus the data of a stage, rad.
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
