//! What one evaluation of W costs.

use std::hint::black_box;
use std::time::Instant;

use super::forms::{Apparatus, FORMS, Motion};
use super::phase_average::unit_states;

/// States in one pass: a pass takes long enough for the clock, and its states
/// fit into the processor's second cache.
const STATES: usize = 2048;

/// Passes over the states; the median of their times is taken.
const REPEATS: usize = 101;

/// Median times for one evaluation from (q, p).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Costs {
    /// Of the forms, in the order of [`FORMS`], over that of the exact form.
    pub ratios: [f64; FORMS.len()],
    /// Of the exact form, ns.
    pub exact_ns: f64,
}

impl Costs {
    /// Measures at random states, one after the other, so that the processor may
    /// overlap them as it does in a table of samples. The forms take turns: a
    /// change of the processor's clock then meets all of them.
    pub fn measure() -> Self {
        let model = Apparatus::new();
        let canonical = |state: &Motion| {
            let q = state.coordinates;
            (q, model.symmetric_momenta(&q, &state.rates))
        };
        let states: Vec<_> = unit_states(STATES).iter().map(canonical).collect();
        let mut times: [Vec<f64>; FORMS.len() + 1] = Default::default();
        for _ in 0..REPEATS {
            let pass = [
                time(&states, |q, p| model.transfer_angle_1(q, p)),
                time(&states, |q, p| model.transfer_amplitude_2(q, p)),
                time(&states, |q, p| model.transfer_amplitude_4(q, p)),
                time(&states, |q, p| model.transfer_amplitude_6(q, p)),
                time(&states, |q, p| model.transfer_amplitude_8(q, p)),
                time(&states, |q, p| model.transfer_exact(q, p)),
            ];
            for (times, time) in times.iter_mut().zip(pass) {
                times.push(time);
            }
        }
        let [a, b, c, d, e, exact_ns] = times.map(median);
        Self {
            ratios: [a, b, c, d, e].map(|time| time / exact_ns),
            exact_ns,
        }
    }
}

/// Time for one evaluation in one pass over the states, ns.
pub(super) fn time<const N: usize, W>(
    states: &[([f64; N], [f64; N])],
    form: impl Fn(&[f64; N], &[f64; N]) -> W,
) -> f64 {
    let start = Instant::now();
    for (q, p) in black_box(states) {
        black_box(form(q, p));
    }
    start.elapsed().as_secs_f64() * 1e9 / states.len() as f64
}

pub(super) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
