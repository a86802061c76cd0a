//! Findings of a run: growth, first peak, source of the energy, and error of each form of W.

use std::array;

use branched_pendulum::analysis::{Modes, ModesError};

use super::RATE;
use super::apparatus::{BranchedDouble, EXACT, FORMS, Sample, folded};
use super::release::Run;

/// Duration (s) before and after a maximum of H_d within which H_d must not exceed it for it to
/// count as the first peak. H_d grows in pulses, about two seconds apart; a pulse followed by a
/// much larger one is not yet the peak.
pub const PEAK_REACH: f64 = 2.0;

/// Angle (rad) that |θ_d| must not yet have exceeded while the forms of W are compared: all forms
/// except the exact one are expansions for small θ_d, and mean nothing when the children turn over.
pub const SMALL_ANGLE: f64 = 0.5;

/// Findings of one run. A field is `None` if its number has no meaning, for example the growth of a
/// disturbance of zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Findings {
    /// Largest |θ_d| of the run (folded to π/2 at most), divided by |θ_d(0)|.
    pub growth: Option<f64>,
    /// The first peak of H_d.
    pub peak: Option<Peak>,
    /// For each form of W: the root mean square of its difference from dH_d/dt, divided by the root
    /// mean square of dH_d/dt. Both are means over a sampling interval: the integral of W over it,
    /// and the change of H_d. With friction, its power on H_d is added to W. Only samples before
    /// |θ_d| first exceeds [`SMALL_ANGLE`] are used.
    pub deviations: [Option<f64>; FORMS.len()],
    /// For each of the [`terms`](Sample::terms) of W: root mean square and largest magnitude in the
    /// same samples, divided by the root mean square of dH_d/dt.
    pub terms: Option<[[f64; 2]; 4]>,
}

/// The first peak of H_d.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// Sample at the peak.
    pub sample: Sample,
    /// Largest |θ_m| until then, rad.
    pub largest_mean: f64,
}

impl Peak {
    /// Returns the shares of W_K and W_P in the energy that W transfers from the release to the
    /// peak, according to the form of W with this index.
    pub fn shares(&self, form: usize) -> Option<(f64, f64)> {
        let transferred = self.sample.supplied.transfer(form);
        let whole = transferred.total();
        ratio(transferred.kinetic, whole).zip(ratio(transferred.potential, whole))
    }
}

impl Findings {
    /// Reads a run.
    pub fn new(run: &Run) -> Self {
        let samples = &run.samples;
        let end = samples
            .iter()
            .position(|sample| sample.difference.abs() > SMALL_ANGLE);
        let small = &samples[..end.unwrap_or(samples.len())];
        Self {
            growth: growth(samples),
            peak: peak(samples),
            deviations: array::from_fn(|form| deviation(small, form)),
            terms: term_sizes(small),
        }
    }
}

/// Returns the largest |θ_d|, folded to π/2 at most, divided by the first one; `None` for a
/// disturbance of zero.
pub fn growth(samples: &[Sample]) -> Option<f64> {
    let size = |sample: &Sample| folded(sample.difference).abs();
    ratio(largest(samples, size), size(samples.first()?))
}

/// Finds the first maximum of H_d that is not exceeded within [`PEAK_REACH`] before and after it,
/// as far as there are samples.
fn peak(samples: &[Sample]) -> Option<Peak> {
    let reach = (PEAK_REACH * RATE) as usize;
    let energy = |index: usize| samples[index].antiphase_energy;
    let is_peak = |&at: &usize| {
        let mut near = at.saturating_sub(reach)..samples.len().min(at + reach + 1);
        energy(at - 1) < energy(at) && near.all(|other| energy(other) <= energy(at))
    };
    let index = (1..samples.len().saturating_sub(1)).find(is_peak)?;
    Some(Peak {
        sample: samples[index],
        largest_mean: largest(&samples[..=index], |sample| sample.mean.abs()),
    })
}

fn deviation(small: &[Sample], form: usize) -> Option<f64> {
    let changes = |of: &dyn Fn(&Sample) -> f64| {
        let changes = small.windows(2).map(|pair| of(&pair[1]) - of(&pair[0]));
        changes.map(|change| change.powi(2)).sum::<f64>().sqrt()
    };
    let energy = |sample: &Sample| sample.antiphase_energy;
    let excess = |sample: &Sample| sample.supplied.total(form) - energy(sample);
    ratio(changes(&excess), changes(&energy))
}

fn term_sizes(small: &[Sample]) -> Option<[[f64; 2]; 4]> {
    let rms = |of: &dyn Fn(&Sample) -> f64| {
        let sum: f64 = small.iter().map(|sample| of(sample).powi(2)).sum();
        (sum / small.len() as f64).sqrt()
    };
    let scale = rms(&|sample| sample.powers.total(EXACT));
    let size = |term: usize| {
        let term = |sample: &Sample| sample.terms[term];
        let largest = largest(small, |sample| term(sample).abs());
        [rms(&term), largest].map(|size| size / scale)
    };
    (scale > 0.0).then(|| array::from_fn(size))
}

fn largest(samples: &[Sample], of: impl Fn(&Sample) -> f64) -> f64 {
    samples.iter().map(of).fold(0.0, f64::max)
}

fn ratio(part: f64, whole: f64) -> Option<f64> {
    let ratio = part / whole;
    ratio.is_finite().then_some(ratio)
}

/// The three eigenfrequencies, Hz.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frequencies {
    /// f_+: frequency of the slower in-phase mode.
    pub plus: f64,
    /// f_−: frequency of the faster in-phase mode.
    pub minus: f64,
    /// f_d: frequency of the antiphase mode.
    pub antiphase: f64,
}

impl Frequencies {
    /// Computes the frequencies of the small oscillations about the rest position. The antiphase
    /// frequency lies between the two others.
    ///
    /// # Errors
    /// As [`Modes::new`].
    pub fn of(model: &BranchedDouble) -> Result<Self, ModesError> {
        let rest = [0.0; 3];
        let modes = Modes::new(&model.mass_matrix(&rest), &model.stiffness_matrix(&rest))?;
        let hz = |mode: usize| modes.frequencies_hz.get(mode).copied().unwrap_or(f64::NAN);
        Ok(Self {
            plus: hz(0),
            antiphase: hz(1),
            minus: hz(2),
        })
    }
}
