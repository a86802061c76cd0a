//! The cost of one evaluation of W.

use std::hint::black_box;
use std::time::Instant;

use branched_pendulum::analysis::truncation::{CanonicalState, PhaseAverage, TruncationError};
use branched_pendulum::{Transfer, TransferForm, TransferForms};

/// States in one pass: a pass takes long enough for the clock, and its states
/// fit into the processor's second cache.
const STATES: usize = 2048;

/// Passes over the states; the median of their times is taken.
const REPEATS: usize = 51;

/// Median times for W into all receivers from (q, p).
#[derive(Clone, Debug, PartialEq)]
pub struct Costs {
    /// Of the truncated forms, over that of the exact form.
    pub ratios: Vec<f64>,
    /// Of the exact form, ns.
    pub exact_ns: f64,
}

impl Costs {
    /// Measures at random states, one after the other, so that the processor may
    /// overlap them as it does in a table of samples. The forms take turns: a
    /// change of the processor's clock then meets all of them.
    ///
    /// # Errors
    /// As [`PhaseAverage::canonical_states`].
    pub fn measure<M: TransferForms<f64>>(
        model: &M,
        average: &PhaseAverage,
    ) -> Result<Self, TruncationError> {
        let states = PhaseAverage {
            states: STATES,
            ..average.clone()
        }
        .canonical_states(model, 1.0)?;
        let mut times = vec![Vec::with_capacity(REPEATS); M::TRANSFER_FORMS.len()];
        for _ in 0..REPEATS {
            for (form, times) in times.iter_mut().enumerate() {
                times.push(time(model, form, &states));
            }
        }
        let times: Vec<f64> = times.into_iter().map(median).collect();
        let exact = M::TRANSFER_FORMS.iter().zip(&times);
        let exact = exact.filter(|(form, _)| **form == TransferForm::Exact);
        let exact_ns = exact.map(|(_, time)| *time).sum();
        let all = M::TRANSFER_FORMS.iter().zip(&times);
        let truncated = all.filter(|(form, _)| **form != TransferForm::Exact);
        Ok(Self {
            ratios: truncated.map(|(_, time)| time / exact_ns).collect(),
            exact_ns,
        })
    }
}

/// Time for one evaluation in one pass over the states, ns.
fn time<M: TransferForms<f64>>(model: &M, form: usize, states: &[CanonicalState]) -> f64 {
    let mut transfers = vec![Transfer::default(); M::RECEIVERS.len()];
    let start = Instant::now();
    for (q, p) in black_box(states) {
        model.transfers_into(form, q, p, &mut transfers);
        black_box(&mut transfers);
    }
    start.elapsed().as_secs_f64() * 1e9 / states.len() as f64
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
