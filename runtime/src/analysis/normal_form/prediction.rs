//! Predictions of a normal form for one motion, with their errors.

use std::f64::consts::TAU;

use super::coupling::{Averaged, Rates};
use super::period::SlowMotion;
use super::refusal::Refusal;
use super::resonance::{Resonance, ResonanceKind};

/// Result of a normal form for the highest degree and for the degree before, whose difference is
/// its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DegreeEstimate {
    /// Number by the highest degree.
    pub value: f64,
    /// Number computed with the highest degree minus two.
    pub before: f64,
}

impl DegreeEstimate {
    pub(super) fn of([before, value]: [f64; 2]) -> Self {
        Self { value, before }
    }

    /// Returns the error bar: the absolute difference between the results of the two degrees.
    pub fn error(&self) -> f64 {
        (self.value - self.before).abs()
    }
}

/// Predicted frequencies and growth rate of one in-phase motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Prediction {
    /// Frequencies of the in-phase modes, Hz.
    pub frequencies_hz: Vec<DegreeEstimate>,
    /// Frequencies of small differences, Hz; one that grows has the frequency of its resonance.
    pub difference_frequencies_hz: Vec<DegreeEstimate>,
    /// Growth rate of small differences without friction, 1/s; zero if they do not grow.
    pub growth_rate: DegreeEstimate,
    /// Largest coupling constant minus its detuning, 1/s: positive if differences grow. `None` if
    /// no resonance couples differences.
    pub margin: Option<DegreeEstimate>,
    /// The resonance with this largest margin.
    pub resonance: Option<Resonance>,
}

/// Results of one degree.
#[derive(Clone, Debug)]
pub(super) struct Level {
    /// Frequencies in phase, rad/s.
    pub(super) in_phase: Vec<f64>,
    /// Frequencies of the differences, rad/s.
    pub(super) differences: Vec<f64>,
    /// Growth caused by the strongest resonance; `None` if no resonance couples differences.
    pub(super) growth: Option<LevelGrowth>,
}

/// Growth of differences, computed with one degree.
#[derive(Clone, Debug)]
pub(super) struct LevelGrowth {
    /// Index of the coupling.
    pub(super) coupling: usize,
    /// Positive if differences grow, 1/s.
    pub(super) margin: f64,
    /// Growth rate, 1/s.
    pub(super) rate: f64,
}

impl Level {
    /// Returns the growth by the strongest coupling alone.
    pub(super) fn of(averaged: &Averaged, rates: Rates) -> Self {
        let strongest = strongest(averaged, &rates);
        let growth = strongest.map(|coupling| {
            let detuning = Averaged::mismatch(&averaged.couplings[coupling], &rates);
            let strength = rates.couplings[coupling].abs();
            let square = strength * strength - detuning * detuning;
            LevelGrowth {
                coupling,
                margin: strength - detuning.abs(),
                rate: square.max(0.0).sqrt(),
            }
        });
        let mut differences = rates.differences.clone();
        if let Some(own) = &growth {
            let coupling = &averaged.couplings[own.coupling];
            let detuning = Averaged::mismatch(coupling, &rates);
            let strength = rates.couplings[own.coupling];
            let square = (detuning * detuning - strength * strength).max(0.0);
            let shift = square.sqrt().copysign(detuning) - detuning;
            let [one, other] = coupling.pair;
            differences[one] += shift;
            if other != one {
                differences[other] += shift;
            }
        }
        Self {
            differences,
            growth,
            in_phase: rates.in_phase,
        }
    }

    /// Uses the averages of a motion that was integrated in time; its growth is assigned to the
    /// resonance whose detuning is smallest relative to its coupling.
    pub(super) fn of_slow(averaged: &Averaged, rates: &Rates, motion: SlowMotion) -> Self {
        let mut in_phase = motion.frequencies;
        let differences = in_phase.split_off(averaged.in_phase.len());
        Self {
            in_phase,
            differences,
            growth: strongest(averaged, rates).map(|coupling| LevelGrowth {
                coupling,
                margin: motion.margin,
                rate: motion.rate.max(0.0),
            }),
        }
    }
}

/// Returns the coupling by which differences can grow and whose detuning is smallest next to its
/// strength.
fn strongest(averaged: &Averaged, rates: &Rates) -> Option<usize> {
    let margin = |place: usize| {
        let detuning = Averaged::mismatch(&averaged.couplings[place], rates);
        rates.couplings[place].abs() - detuning.abs()
    };
    let growing = averaged.couplings.iter().enumerate();
    let growing = growing.filter(|(_, own)| own.kind == ResonanceKind::Growth);
    let places = growing.map(|(place, _)| place);
    places.max_by(|one, two| margin(*one).total_cmp(&margin(*two)))
}

/// Limits within which the results of two degrees count as equal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Agreement {
    /// Largest relative difference of a frequency.
    pub frequency: f64,
}

impl Prediction {
    /// Returns the growth rate minus `least`, in 1/s, continued by the negative margin where
    /// differences do not grow: it changes its sign at the edge of a tongue. It is −∞ if no
    /// resonance couples differences.
    pub fn excess(&self, least: f64) -> DegreeEstimate {
        let part = |of: fn(&DegreeEstimate) -> f64| {
            let margin = self.margin.as_ref().map_or(f64::NEG_INFINITY, of);
            match margin > 0.0 {
                true => of(&self.growth_rate) - least,
                false => margin - least,
            }
        };
        DegreeEstimate::of([part(|own| own.before), part(|own| own.value)])
    }

    /// Compares the results of two degrees and combines them into a prediction.
    pub(super) fn of(
        averaged: &Averaged,
        [lower, higher]: [Level; 2],
        degrees: [u32; 2],
        agreement: Agreement,
    ) -> Result<Self, Refusal> {
        let estimates = |one: &[f64], two: &[f64]| -> Vec<DegreeEstimate> {
            let both = one.iter().zip(two);
            both.map(|(one, two)| DegreeEstimate::of([one / TAU, two / TAU]))
                .collect()
        };
        let frequencies_hz = estimates(&lower.in_phase, &higher.in_phase);
        let difference_frequencies_hz = estimates(&lower.differences, &higher.differences);
        for (letter, all) in [("f", &frequencies_hz), ("d", &difference_frequencies_hz)] {
            for (j, own) in all.iter().enumerate() {
                // Not a number does not converge either.
                let agrees = own.error() <= agreement.frequency * own.value;
                if !agrees {
                    return Err(Refusal::NotConverged {
                        lower: degrees[0],
                        degree: degrees[1],
                        mode: format!("{letter}_{}", j + 1),
                        difference_hz: own.error(),
                    });
                }
            }
        }
        let growth = lower.growth.zip(higher.growth);
        Ok(Self {
            frequencies_hz,
            difference_frequencies_hz,
            growth_rate: DegreeEstimate::of(match &growth {
                Some((low, high)) => [low.rate, high.rate],
                None => [0.0; 2],
            }),
            margin: growth
                .as_ref()
                .map(|(low, high)| DegreeEstimate::of([low.margin, high.margin])),
            resonance: growth
                .and_then(|(_, high)| averaged.couplings.get(high.coupling))
                .map(|own| own.resonance.clone()),
        })
    }
}
