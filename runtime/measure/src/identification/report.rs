//! From the last stage to what users see of it.

use nalgebra::DMatrix;

use super::convergence::Convergence;
use super::covariance::{Curvature, TimeBlocks};
use super::error::IdentificationError;
use super::family::Family;
use super::fit::{AngleErrors, Fit, ParameterEstimate, Standing};
use super::identifiability::SHARE;
use super::least_squares::{FitStage, Residuals, Solved};
use super::problem::no_motion;
use super::ratios::Ratios;
use super::record::MeasuredLink;
use super::search::{Rung, Search};
use super::task::{FitTask, LinkData};
use branched_pendulum::system::State;

/// Number of blocks where no length is asked for.
const BLOCKS: f64 = 30.0;

/// Deviations of the data below which rounding is all that is left over.
const ROUNDING: f64 = 1e-5;
/// By how much an unknown that is held may be off, of its size.
const HELD: f64 = 0.3;

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
        let open =
            task.open_directions(&stage.globals, &elimination.globals, variance.sqrt(), &held);
        let is_bound = |&index: &usize| task.is_at_bound(index, stage.globals[index]);
        let free = (0..task.names.len()).filter(|index| !open.held.contains(index));
        let free: Vec<usize> = free.filter(|index| !is_bound(index)).collect();
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
        let curvature = Curvature::new(&elimination.globals, &free);
        let deviations = |combinations: &DMatrix<f64>| {
            let none = || vec![f64::INFINITY; combinations.nrows()];
            let by_blocks = blocks.as_ref();
            let by_blocks = by_blocks.and_then(|blocks| blocks.variances(&free, combinations));
            [curvature.variances(combinations, variance), by_blocks]
                .map(|variances| variances.unwrap_or_else(none))
                .map(|variances| variances.into_iter().map(f64::sqrt).collect::<Vec<_>>())
        };
        let mut singles = DMatrix::zeros(free.len(), free.len());
        for (row, &global) in free.iter().enumerate() {
            singles[(row, row)] = task.scales[global];
        }
        let [naive, by_blocks] = deviations(&singles);
        let has_blocks = !times.is_empty();
        let estimate = |(index, name): (usize, &String)| {
            let place = free.iter().position(|&own| own == index);
            let naive = place.map(|place| naive[place]);
            let with = open.held.iter().enumerate().filter(|&(column, _)| {
                // What is held may be off; it matters where the bar does not cover it.
                let change = open.changes[(index, column)].abs();
                let size = change * task.unit(&stage.globals, index);
                change > SHARE || naive.is_some_and(|bar| HELD * size > 0.5 * bar)
            });
            let with: Vec<String> = with.map(|(_, &held)| task.names[held].clone()).collect();
            ParameterEstimate {
                name: name.clone(),
                value: stage.globals[index],
                standing: match () {
                    // What came to its bound before it was held did so by the data.
                    () if is_bound(&index) && stage.globals[index] != task.start(index) => {
                        Standing::AtBound
                    }
                    () if open.held.contains(&index) => Standing::Held,
                    () if is_bound(&index) => Standing::AtBound,
                    () if with.is_empty() => Standing::Determined,
                    () => Standing::GoesWith(with),
                },
                naive,
                by_blocks: place.filter(|_| has_blocks).map(|place| by_blocks[place]),
            }
        };
        let estimates: Vec<ParameterEstimate> =
            task.names.iter().enumerate().map(estimate).collect();
        let ratios = Ratios::new(task, &stage.globals, &estimates, &open.changes);
        let [naive, by_blocks] = deviations(&ratios.combinations(task, &stage.globals, &free));
        let by_blocks = has_blocks.then_some(by_blocks.as_slice());
        let ratios = ratios.estimates(task, &stage.globals, &naive, by_blocks);
        let starts = stage.segments.iter().zip(&stage.starts);
        let offset = |(index, link): (usize, &MeasuredLink)| {
            let offset = task.links[index]
                .offset
                .map_or(0.0, |offset| stage.globals[offset]);
            (link.name.clone(), offset)
        };
        Ok(Fit {
            estimates,
            ratios,
            convergence: Convergence {
                distance: curvature.distance(variance.sqrt().max(ROUNDING)),
                ..convergence
            },
            identifiability: open.tell(&task.names),
            frequencies: task.fitted_frequencies(&stage.globals).unwrap_or_default(),
            alternatives: Vec::new(),
            starts: starts
                .map(|(samples, start)| State::new(times[samples.start], start.clone()))
                .collect(),
            until: times.last().copied(),
            stages: reports,
            blocks: blocks.map_or(0, |blocks| blocks.count()),
            impossible: self
                .identification
                .family
                .check(&task.parameters(&stage.globals))
                .err(),
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
