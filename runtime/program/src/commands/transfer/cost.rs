//! Cost of one evaluation of the energy transfer W.

use std::hint::black_box;
use std::time::Instant;

use branched_pendulum::analysis::truncation::{ComparedForms, PhaseAverage, TruncationError};
use branched_pendulum::{Transfer, TransferForm};

/// Number of states evaluated in one pass. A pass takes long enough for the clock, and its states
/// fit into the processor's second-level cache.
const STATES: usize = 2048;

/// Number of passes over the states, of whose times the median is taken.
const REPEATS: usize = 51;

/// Median times of evaluating W into all receivers from coordinates and momenta.
pub(super) struct Costs {
    /// Times of the truncated forms, divided by the time of the exact form.
    pub(super) ratios: Vec<f64>,
    /// Of the exact form, ns.
    pub(super) exact_ns: f64,
}

impl Costs {
    /// Measures the times at random states, evaluated one after the other, so that the processor
    /// can overlap them as it does for a table of samples. The forms are measured in turn, so that
    /// a change of the processor's clock affects all of them.
    pub(super) fn measure(
        tree: &impl ComparedForms,
        average: &PhaseAverage,
    ) -> Result<Self, TruncationError> {
        let few = PhaseAverage {
            states: STATES,
            ..average.clone()
        };
        let states = few.canonical_states(tree, 1.0)?;
        let forms = tree.forms();
        let mut transfers = vec![Transfer::default(); tree.receivers().len()];
        let mut transfers_of = tree.transfers();
        let mut times = vec![Vec::with_capacity(REPEATS); forms.len()];
        for _ in 0..REPEATS {
            for (form, times) in times.iter_mut().enumerate() {
                let start = Instant::now();
                for (coordinates, momenta) in black_box(&states) {
                    transfers_of(form, [coordinates, momenta], &mut transfers);
                    black_box(&mut transfers);
                }
                times.push(start.elapsed().as_secs_f64() * 1e9 / states.len() as f64);
            }
        }
        let times = forms.iter().zip(times.into_iter().map(median));
        let (exact, truncated): (Vec<_>, Vec<_>) =
            times.partition(|(form, _)| **form == TransferForm::Exact);
        let exact_ns = exact.iter().map(|(_, time)| time).sum();
        Ok(Self {
            ratios: truncated.iter().map(|(_, time)| time / exact_ns).collect(),
            exact_ns,
        })
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
