//! Terms that a normal form keeps of the Hamiltonian, sorted by their effect on a motion.

use std::collections::BTreeMap;

use super::evaluation::{Monomial, Monomials, Powers};
use super::resonance::{Resonance, ResonanceKind};
use crate::scalar::{Exponents, Terms};

/// Effect below which a resonance is left out, as a part of what it changes.
const WEAK: f64 = 0.02;

/// Coupling constant below which a resonance is left out, as a part of the frequency.
const NEGLIGIBLE: f64 = 1e-6;

/// Shift of a frequency, as a part of it, below which the amplitude of a mode does not matter.
const SHIFT: f64 = 1e-5;

/// A resonance that couples two differences, or one to itself, through the motion in phase.
#[derive(Clone, Debug)]
pub(super) struct Coupling {
    pub(super) resonance: Resonance,
    /// The two differences.
    pub(super) pair: [usize; 2],
    pub(super) kind: ResonanceKind,
    /// Coupling constant κ in rad/s, as a function of the amplitudes |z_j| of the in-phase modes.
    pub(super) strength: Monomials,
}

/// Frequencies and coupling constants as functions of the amplitudes of the in-phase motion.
#[derive(Clone, Debug)]
pub(super) struct Averaged {
    /// Angular frequencies ∂H/∂I_j of the in-phase modes, as functions of their amplitudes |z_j|,
    /// with the actions I_j = |z_j|².
    pub(super) in_phase: Vec<Monomials>,
    /// Monomials of the differences.
    pub(super) differences: Vec<Monomials>,
    pub(super) couplings: Vec<Coupling>,
    /// Kept resonances between in-phase modes, with the coefficient of each as a function of
    /// amplitudes.
    pub(super) internal: Vec<(Resonance, Monomials)>,
}

impl Averaged {
    pub(super) fn of(by_degree: &[Terms], in_phase: usize, differences: usize) -> Self {
        let n = in_phase + differences;
        let mut own = Self {
            in_phase: vec![Monomials::default(); in_phase],
            differences: vec![Monomials::default(); differences],
            couplings: Vec::new(),
            internal: Vec::new(),
        };
        let mut couplings: BTreeMap<(Resonance, [usize; 2]), Monomials> = BTreeMap::new();
        let mut internal: BTreeMap<Resonance, Monomials> = BTreeMap::new();
        let all = by_degree.iter().enumerate().flat_map(|(degree, terms)| {
            terms
                .iter()
                .map(move |(exponents, value)| (degree as u32, exponents, value))
        });
        for (degree, exponents, coefficient) in all {
            let monomial = |less: Option<usize>, factor: f64| Monomial {
                degree,
                coefficient: factor * coefficient,
                powers: (0..in_phase)
                    .map(|j| (exponents.of(j) + exponents.of(n + j)) as u8)
                    .enumerate()
                    .map(|(j, power)| {
                        if less == Some(j) {
                            power.saturating_sub(2)
                        } else {
                            power
                        }
                    })
                    .collect(),
            };
            let resonance = Resonance::of(exponents, in_phase, differences);
            let both = |place: usize| -> Vec<usize> {
                let own = (0..differences).flat_map(|a| {
                    let count = exponents.of(place + in_phase + a) as usize;
                    std::iter::repeat_n(a, count)
                });
                own.collect()
            };
            match (both(0).as_slice(), both(n).as_slice()) {
                ([], []) if resonance.is_zero() => {
                    for (j, frequency) in own.in_phase.iter_mut().enumerate() {
                        let power = exponents.of(j);
                        if power > 0 {
                            frequency.push(monomial(Some(j), f64::from(power)));
                        }
                    }
                }
                ([], []) if resonance == resonance.canonical() => {
                    internal
                        .entry(resonance)
                        .or_default()
                        .push(monomial(None, 1.0));
                }
                ([a], [b]) if a == b && resonance.is_zero() => {
                    own.differences[*a].push(monomial(None, 1.0));
                }
                // An internal resonance also modulates the frequency of a difference.
                ([a], [b]) if a == b && resonance == resonance.canonical() => {
                    internal.entry(resonance).or_default();
                }
                ([a], [b]) if a < b => {
                    let place = (resonance, [*a, *b]);
                    couplings
                        .entry(place)
                        .or_default()
                        .push(monomial(None, 1.0));
                }
                ([], [a, b]) => {
                    let factor = if a == b { 2.0 } else { 1.0 };
                    let place = (resonance, [*a, *b]);
                    couplings
                        .entry(place)
                        .or_default()
                        .push(monomial(None, factor));
                }
                // Conjugates of terms above.
                _ => {}
            }
        }
        own.internal = internal.into_iter().collect();
        own.couplings = couplings
            .into_iter()
            .map(|((resonance, pair), strength)| Coupling {
                kind: resonance.kind(),
                resonance,
                pair,
                strength,
            })
            .collect();
        own
    }

    /// Returns the frequencies and coupling constants of a motion, computed up to a degree of the
    /// Hamiltonian.
    pub(super) fn at(&self, powers: &Powers<f64>, degree: u32) -> Rates {
        let values = |all: &[Monomials]| all.iter().map(|own| own.value(powers, degree)).collect();
        Rates {
            in_phase: values(&self.in_phase),
            differences: values(&self.differences),
            couplings: self
                .couplings
                .iter()
                .map(|own| own.strength.value(powers, degree))
                .collect(),
        }
    }

    /// Returns the resonances that change a motion with these amplitudes and rates by more than
    /// the part [`WEAK`]: a coupling compared with its detuning, and the change of an action by a
    /// resonance of modes in phase compared with this action.
    pub(super) fn active(&self, amplitudes: &[f64], rates: &Rates, degree: u32) -> Vec<Resonance> {
        let couplings = self.couplings.iter().zip(&rates.couplings);
        let couplings = couplings.filter(|(own, strength)| {
            let [a, b] = own.pair.map(|own| rates.differences[own].abs());
            strength.abs() > WEAK * Self::mismatch(own, rates).abs()
                && strength.abs() > NEGLIGIBLE * a.min(b)
        });
        let mut all: Vec<Resonance> = couplings
            .map(|(own, _)| own.resonance.canonical())
            .collect();
        if !self.internal.is_empty() {
            all.extend(self.active_internal(amplitudes, rates, degree));
        }
        all.sort_unstable();
        all.dedup();
        all
    }

    /// Returns the active resonances among modes in phase. Modes with so small an amplitude that no
    /// frequency depends on it are left out.
    fn active_internal(
        &self,
        amplitudes: &[f64],
        rates: &Rates,
        degree: u32,
    ) -> impl Iterator<Item = Resonance> {
        let powers = powers_of(amplitudes, degree);
        let matters = |j: usize| {
            let mut others = amplitudes.to_vec();
            others[j] = 0.0;
            let without = self.at(&powers_of(&others, degree), degree);
            let pairs = [
                (&rates.in_phase, &without.in_phase),
                (&rates.differences, &without.differences),
            ];
            let mut pairs = pairs.into_iter().flat_map(|(one, two)| one.iter().zip(two));
            pairs.any(|(one, two)| (one - two).abs() > SHIFT * one.abs())
        };
        let matters: Vec<bool> = (0..amplitudes.len()).map(matters).collect();
        let active = self.internal.iter().filter(move |(own, strength)| {
            let both = own.in_phase.iter().zip(&rates.in_phase);
            let detuning: f64 = both.map(|(n, frequency)| f64::from(*n) * frequency).sum();
            let strength = 2.0 * strength.value(&powers, degree).abs();
            let modes = own.in_phase.iter().zip(amplitudes).zip(&matters);
            let mut modes = modes.filter(|(_, matters)| **matters);
            modes.any(|((n, amplitude), _)| {
                let change = f64::from(n.abs()) * strength;
                change > WEAK * detuning.abs() * amplitude * amplitude
            })
        });
        active
            .map(|(own, _)| own.clone())
            .collect::<Vec<_>>()
            .into_iter()
    }

    /// Returns the half-mismatch of a coupling: (ω_a ± ω_b + n·ω)/2.
    pub(super) fn mismatch(coupling: &Coupling, rates: &Rates) -> f64 {
        let own = coupling.resonance.in_phase.iter().zip(&rates.in_phase);
        let pump: f64 = own.map(|(n, frequency)| f64::from(*n) * frequency).sum();
        let [a, b] = coupling.pair.map(|own| rates.differences[own]);
        match coupling.kind {
            ResonanceKind::Growth => 0.5 * (a + b - pump),
            ResonanceKind::Exchange | ResonanceKind::InPhase => 0.5 * (a - b + pump),
        }
    }
}

/// Frequencies (rad/s) and coupling constants (rad/s) of one motion.
#[derive(Clone, Debug)]
pub(super) struct Rates {
    pub(super) in_phase: Vec<f64>,
    pub(super) differences: Vec<f64>,
    pub(super) couplings: Vec<f64>,
}

/// Returns the powers of amplitudes.
pub(super) fn powers_of(amplitudes: &[f64], degree: u32) -> Powers<f64> {
    Powers::new(amplitudes, degree, 1.0, |a, b| a * b)
}

/// Returns true if a monomial contains no difference.
pub(super) fn is_in_phase(exponents: Exponents, in_phase: usize, modes: usize) -> bool {
    (in_phase..modes).all(|j| exponents.of(j) == 0 && exponents.of(modes + j) == 0)
}
