//! Resonances: integer combinations of frequencies that are nearly zero.

use std::fmt;

use crate::scalar::Exponents;

/// Integer combination Σ n_j f_j, of the frequencies of the in-phase motion (f) and of the
/// differences (d), that is nearly zero.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Resonance {
    /// Multiples of the frequencies of the in-phase modes.
    pub in_phase: Vec<i32>,
    /// Multiples of the frequencies of the differences.
    pub differences: Vec<i32>,
}

/// Effect of a resonance on a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ResonanceKind {
    /// In-phase modes exchange energy with each other.
    InPhase,
    /// Differences grow: the in-phase motion drives two of them, or one at twice its frequency.
    Growth,
    /// Two differences exchange energy.
    Exchange,
}

impl Resonance {
    /// Returns the combination of frequencies that belongs to a monomial, for `in_phase` in-phase
    /// modes and `differences` differences.
    pub(super) fn of(exponents: Exponents, in_phase: usize, differences: usize) -> Self {
        let n = in_phase + differences;
        let multiple = |j: usize| exponents.of(j) as i32 - exponents.of(n + j) as i32;
        Self {
            in_phase: (0..in_phase).map(multiple).collect(),
            differences: (in_phase..n).map(multiple).collect(),
        }
    }

    /// Returns all resonances of order 4 that let differences grow: two frequencies of modes in phase
    /// and two of differences.
    pub(super) fn of_growth(in_phase: usize, differences: usize) -> Vec<Self> {
        let mut all = Vec::new();
        for driven in pairs(differences, 1) {
            let same = pairs(in_phase, 1);
            let opposite = pairs(in_phase, -1);
            for driving in same.into_iter().chain(opposite) {
                for sign in [1, -1] {
                    all.push(Self {
                        in_phase: driving.iter().map(|n| sign * n).collect(),
                        differences: driven.iter().map(|n| -n).collect(),
                    });
                }
            }
        }
        all.retain(|own| own.order() == 4);
        all
    }

    /// Returns all multiples.
    pub(super) fn multiples(&self) -> impl Iterator<Item = i32> + '_ {
        self.in_phase.iter().chain(&self.differences).copied()
    }

    /// Returns true if all multiples of the combination are zero.
    pub(super) fn is_zero(&self) -> bool {
        self.multiples().all(|n| n == 0)
    }

    /// Returns the same resonance with the sign in which it is listed: the sum of the multiples of
    /// the differences is negative, or, if it is zero, the first multiple is positive.
    #[must_use]
    pub fn canonical(&self) -> Self {
        let sum: i32 = self.differences.iter().sum();
        let first = self.multiples().find(|n| *n != 0).unwrap_or(1);
        let sign = if sum > 0 || sum == 0 && first < 0 {
            -1
        } else {
            1
        };
        let signed = |values: &[i32]| values.iter().map(|n| sign * n).collect();
        Self {
            in_phase: signed(&self.in_phase),
            differences: signed(&self.differences),
        }
    }

    /// Returns the order Σ |n|.
    pub fn order(&self) -> u32 {
        self.multiples().map(i32::unsigned_abs).sum()
    }

    /// Returns the value of the combination for these frequencies, in-phase modes first.
    pub fn mismatch(&self, frequencies: &[f64]) -> f64 {
        let both = self.multiples().zip(frequencies);
        both.map(|(n, frequency)| f64::from(n) * frequency).sum()
    }

    /// Returns the effect of the resonance.
    pub fn kind(&self) -> ResonanceKind {
        let sum: i32 = self.differences.iter().sum();
        match self.differences.iter().all(|n| *n == 0) {
            true => ResonanceKind::InPhase,
            false if sum == 0 => ResonanceKind::Exchange,
            false => ResonanceKind::Growth,
        }
    }
}

/// Returns the multiples e_i + `sign` e_j of `count` frequencies, for each pair i ≤ j.
fn pairs(count: usize, sign: i32) -> Vec<Vec<i32>> {
    let mut pairs = Vec::new();
    for i in 0..count {
        for j in i..count {
            let mut multiples = vec![0; count];
            multiples[i] += 1;
            multiples[j] += sign;
            pairs.push(multiples);
        }
    }
    pairs
}

impl fmt::Display for Resonance {
    /// Writes the resonance as an equation between sums, as in `f_1 + f_2 = 2 d_1`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let letters = [("f", &self.in_phase), ("d", &self.differences)];
        let side = |sign: i32| {
            let parts = letters.iter().flat_map(|(letter, multiples)| {
                let own = multiples.iter().enumerate().filter(|(_, n)| **n * sign > 0);
                own.map(move |(j, n)| match n.abs() {
                    1 => format!("{letter}_{}", j + 1),
                    n => format!("{n} {letter}_{}", j + 1),
                })
            });
            let parts: Vec<String> = parts.collect();
            if parts.is_empty() {
                "0".to_owned()
            } else {
                parts.join(" + ")
            }
        };
        write!(f, "{} = {}", side(1), side(-1))
    }
}
