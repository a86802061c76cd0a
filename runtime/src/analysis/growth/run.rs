//! Integration of motions with differences, one by one or in the lanes of vector registers.

use std::ops::Range;
use std::sync::Arc;

use super::Growth;
use super::error::GrowthError;
use super::record::GrowthRecord;
use crate::ensemble::Ensemble;
use crate::integrate::Dop853;
use crate::system::{CastOde, State};

/// Index ranges of the differences and their rates in a state.
#[derive(Clone, Debug)]
pub(super) struct DifferenceRanges {
    pub(super) angles: Range<usize>,
    pub(super) rates: Range<usize>,
}

/// A motion at its present state, with the record of its differences.
pub(super) struct GrowthRun {
    pub(super) state: State<f64>,
    pub(super) place: DifferenceRanges,
    pub(super) record: GrowthRecord,
}

impl GrowthRun {
    pub(super) fn add_sample(&mut self, time: f64, state: &[f64]) {
        let DifferenceRanges { angles, rates } = self.place.clone();
        self.record.add_sample(time, &state[angles], &state[rates]);
    }

    /// Divides these components of the state, which include the differences, by the amplitude of
    /// the differences, so that they do not overflow.
    pub(super) fn scale(&mut self, components: &[Range<usize>]) {
        let factor = self.record.scale();
        for place in components {
            for value in &mut self.state.values[place.clone()] {
                *value /= factor;
            }
        }
    }
}

/// Integrates runs in lanes, each from one time at which differences are rescaled to the next. A
/// run that fails is replaced by its error.
pub(super) fn follow_in_lanes<O>(
    method: &Dop853<f64>,
    ensemble: &Ensemble<'_>,
    releases: &[(O, State<f64>)],
    looks: &[Arc<[f64]>],
    runs: &mut [Result<GrowthRun, GrowthError>],
) where
    O: CastOde<f64> + Sync,
{
    for number in 0.. {
        // For each run without an error, the times until differences are scaled back.
        let both = runs.iter().zip(looks);
        let pieces = both.map(|(run, looks)| {
            let times = scale(looks, number)?;
            run.is_ok().then_some(times)
        });
        let pieces: Vec<Option<&[f64]>> = pieces.collect();
        let times: Vec<&[f64]> = pieces.iter().copied().flatten().collect();
        if times.is_empty() {
            break;
        }
        let all = runs.iter().zip(&pieces).zip(releases);
        let moving = all.filter_map(|((run, piece), (ode, _))| {
            let run = run.as_ref().ok()?;
            piece.map(|_| (ode, run.state.clone()))
        });
        let cases: Vec<_> = moving.collect();
        let samples = ensemble.sample_models_at_own_times(method, &cases, &times);
        let moving = runs.iter_mut().zip(&pieces);
        let moving = moving.filter_map(|(run, piece)| Some((run, (*piece)?)));
        for ((place, times), samples) in moving.zip(samples) {
            let Ok(run) = place else { continue };
            for (&time, state) in times.iter().zip(samples.states()).skip(1) {
                run.add_sample(time, state);
            }
            match samples.end {
                Ok(end) => {
                    run.state = end.state;
                    let DifferenceRanges { angles, rates } = run.place.clone();
                    run.scale(&[angles, rates]);
                }
                Err(error) => *place = Err(error.into()),
            }
        }
    }
}

/// Returns part number `number` of the sample times, between two times at which differences are
/// rescaled; `None` after the last. Each part begins where the one before ends.
fn scale(times: &[f64], number: usize) -> Option<&[f64]> {
    let start = number * Growth::LOOKS_A_SCALE;
    let end = (start + Growth::LOOKS_A_SCALE + 1).min(times.len());
    (start + 1 < times.len()).then(|| &times[start..end])
}

/// Iterates over the parts of the sample times between which differences are rescaled.
pub(super) fn scales(times: &[f64]) -> impl Iterator<Item = &[f64]> {
    (0..).map_while(|number| scale(times, number))
}
