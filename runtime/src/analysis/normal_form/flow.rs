//! Equations of the kept terms, in a frame in which all resonances are slow.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};

use super::evaluation::{Complex, Monomial, Monomials, Powers, times};
use super::resonance::Resonance;
use crate::scalar::{Exponents, Terms};
use crate::system::Ode;

/// Terms of the equations ż_j = −i ∂H/∂w_j, linear in the differences, without those of H₂.
#[derive(Clone, Debug)]
pub(super) struct SlowFlow {
    pub(super) in_phase: usize,
    pub(super) differences: usize,
    degree: u32,
    terms: Vec<FlowTerm>,
}

/// Terms of ∂H/∂w_j with one phase: a polynomial in the actions times a monomial.
#[derive(Clone, Debug)]
struct FlowTerm {
    mode: usize,
    /// Resonance that the terms belong to; none if they shift frequencies alone.
    resonance: Option<Resonance>,
    /// Powers of the modes in phase, negative ones for their conjugates.
    phase: Vec<i32>,
    /// A difference or its conjugate as a factor.
    difference: Option<(usize, bool)>,
    /// Polynomial in the actions of the modes in phase.
    strength: Monomials,
}

impl SlowFlow {
    /// Takes the kept terms up to a degree.
    pub(super) fn of(
        by_degree: &[Terms],
        degree: u32,
        in_phase: usize,
        differences: usize,
    ) -> Self {
        let n = in_phase + differences;
        let mut all: BTreeMap<_, Monomials> = BTreeMap::new();
        let up_to = by_degree.iter().take(degree as usize + 1).skip(3);
        for (exponents, value) in up_to.flat_map(Terms::iter) {
            let resonance = Resonance::of(exponents, in_phase, differences).canonical();
            let has_difference = (in_phase..n).any(|j| exponents.of(j) + exponents.of(n + j) > 0);
            let modes = if has_difference {
                in_phase..n
            } else {
                0..in_phase
            };
            for mode in modes {
                let Some(rest) = exponents.without(n + mode) else {
                    continue;
                };
                let both = |j: usize| [rest.of(j), rest.of(n + j)];
                let phase = (0..in_phase).map(both).map(|[a, b]| a as i32 - b as i32);
                let key = (
                    mode,
                    resonance.clone(),
                    phase.collect::<Vec<i32>>(),
                    factor(rest, in_phase, n),
                );
                all.entry(key).or_default().push(Monomial {
                    degree: exponents.degree(),
                    coefficient: f64::from(exponents.of(n + mode)) * value,
                    powers: (0..in_phase)
                        .map(both)
                        .map(|[a, b]| a.min(b) as u8)
                        .collect(),
                });
            }
        }
        let terms =
            all.into_iter().map(
                |((mode, resonance, phase, difference), strength)| FlowTerm {
                    mode,
                    resonance: Some(resonance).filter(|own| !own.is_zero()),
                    phase,
                    difference,
                    strength,
                },
            );
        Self {
            in_phase,
            differences,
            degree,
            terms: terms.collect(),
        }
    }
}

/// Returns the difference that is a factor of a monomial, and true if it is its conjugate.
fn factor(exponents: Exponents, in_phase: usize, modes: usize) -> Option<(usize, bool)> {
    (in_phase..modes).find_map(|j| match [exponents.of(j), exponents.of(modes + j)] {
        [1, 0] => Some((j - in_phase, false)),
        [0, 1] => Some((j - in_phase, true)),
        _ => None,
    })
}

/// Equations of the modes in phase and of the fundamental matrix of the differences, under the
/// active resonances. In the frame that rotates with Ω_j all of them have n·Ω = 0, so that nothing
/// depends on time.
///
/// A state lists the real parts of the modes in phase and their imaginary parts, the phases by
/// which they have advanced, the integrals of the mean frequencies of the differences, and the
/// columns of the matrix, each with its real parts first.
pub(super) struct SlowEquations<'a> {
    flow: &'a SlowFlow,
    active: Vec<&'a FlowTerm>,
    /// Rotation Ω of the frame, rad/s.
    pub(super) frame: Vec<f64>,
    /// Linear frequencies in that frame, rad/s.
    detunings: Vec<f64>,
}

/// Linear equations of the differences: −i (C z + D z̄).
struct Linear {
    direct: Vec<Complex>,
    conjugate: Vec<Complex>,
}

impl<'a> SlowEquations<'a> {
    /// Takes the terms of these resonances and those that belong to none. None if the resonances
    /// have no slow frame.
    pub(super) fn new(
        flow: &'a SlowFlow,
        frequencies: &[f64],
        resonances: &[Resonance],
    ) -> Option<Self> {
        let frame = slow_frame(frequencies, resonances)?;
        let is_active = |own: &&FlowTerm| match &own.resonance {
            None => true,
            Some(resonance) => resonances.contains(resonance),
        };
        Some(Self {
            active: flow.terms.iter().filter(is_active).collect(),
            detunings: frequencies.iter().zip(&frame).map(|(a, b)| a - b).collect(),
            frame,
            flow,
        })
    }

    /// Returns the places of the phases in a state.
    pub(super) fn phases(&self) -> std::ops::Range<usize> {
        2 * self.flow.in_phase..3 * self.flow.in_phase
    }

    /// Returns the places of the integrals of the frequencies of the differences.
    pub(super) fn integrals(&self) -> std::ops::Range<usize> {
        self.phases().end..self.phases().end + self.flow.differences
    }

    /// Returns the state of a motion in phase, with the unit matrix.
    pub(super) fn start(&self, in_phase: &[Complex]) -> Vec<f64> {
        let mut state: Vec<f64> = in_phase.iter().map(|own| own[0]).collect();
        state.extend(in_phase.iter().map(|own| own[1]));
        let k = self.flow.differences;
        state.resize(self.integrals().end, 0.0);
        for column in 0..2 * k {
            state.extend((0..2 * k).map(|row| f64::from(u8::from(row == column))));
        }
        state
    }

    /// Returns the modes in phase of a state.
    pub(super) fn in_phase(&self, state: &[f64]) -> Vec<Complex> {
        let m = self.flow.in_phase;
        (0..m).map(|j| [state[j], state[m + j]]).collect()
    }

    /// Returns the rate of an action, J.
    pub(super) fn action_rate(&self, mode: usize, state: &[f64]) -> f64 {
        let all = self.in_phase(state);
        let [x, y] = all[mode];
        2.0 * times(self.forces(&all)[mode], [x, -y])[1]
    }

    /// Returns ∂H/∂w_j of the modes in phase.
    fn forces(&self, in_phase: &[Complex]) -> Vec<Complex> {
        let shifts = in_phase.iter().zip(&self.detunings);
        let mut forces: Vec<Complex> = shifts.map(|([x, y], own)| [own * x, own * y]).collect();
        self.each(in_phase, true, |term, [x, y]| {
            let sum = &mut forces[term.mode];
            *sum = [sum[0] + x, sum[1] + y];
        });
        forces
    }

    /// Returns the equations of the differences next to a motion in phase.
    fn linear(&self, in_phase: &[Complex]) -> Linear {
        let k = self.flow.differences;
        let mut linear = Linear {
            direct: vec![[0.0; 2]; k * k],
            conjugate: vec![[0.0; 2]; k * k],
        };
        for (a, own) in self.detunings.iter().skip(self.flow.in_phase).enumerate() {
            linear.direct[a * k + a][0] = *own;
        }
        self.each(in_phase, false, |term, [x, y]| {
            let Some((other, is_conjugate)) = term.difference else {
                return;
            };
            let matrix = match is_conjugate {
                true => &mut linear.conjugate,
                false => &mut linear.direct,
            };
            let sum = &mut matrix[(term.mode - self.flow.in_phase) * k + other];
            *sum = [sum[0] + x, sum[1] + y];
        });
        linear
    }

    /// Computes all active terms of the modes in phase, or of the differences.
    fn each(&self, in_phase: &[Complex], of_modes: bool, mut take: impl FnMut(&FlowTerm, Complex)) {
        let actions: Vec<f64> = in_phase.iter().map(|[x, y]| x * x + y * y).collect();
        let actions = Powers::new(&actions, self.flow.degree / 2, 1.0, |a, b| a * b);
        let powers = Powers::new(in_phase, self.flow.degree, [1.0, 0.0], times);
        let own = self.active.iter();
        for term in own.filter(|own| (own.mode < self.flow.in_phase) == of_modes) {
            let mut product = [term.strength.value(&actions, self.flow.degree), 0.0];
            for (j, power) in term
                .phase
                .iter()
                .enumerate()
                .filter(|(_, power)| **power != 0)
            {
                let [x, y] = powers.of(j, power.unsigned_abs() as u8);
                product = times(product, [x, if *power < 0 { -y } else { y }]);
            }
            take(term, product);
        }
    }

    /// Returns the matrix of the differences next to modes in phase that advance steadily. The
    /// differences are counted from phases that advance by `rates` (rad/s) in this frame.
    pub(super) fn constant_matrix(&self, in_phase: &[Complex], rates: &[f64]) -> DMatrix<f64> {
        let k = self.flow.differences;
        let mut linear = self.linear(in_phase);
        for (a, own) in rates.iter().enumerate() {
            linear.direct[a * k + a][0] += own;
        }
        let mut matrix = DMatrix::zeros(2 * k, 2 * k);
        for column in 0..2 * k {
            let unit: Vec<f64> = (0..2 * k)
                .map(|row| f64::from(u8::from(row == column)))
                .collect();
            linear.rates(&unit, matrix.column_mut(column).as_mut_slice());
        }
        matrix
    }

    /// Returns the rates in this frame by which the modes in phase advance, rad/s.
    pub(super) fn phase_rates(&self, in_phase: &[Complex]) -> Vec<f64> {
        self.phase_rates_by(in_phase, &self.forces(in_phase))
    }

    fn phase_rates_by(&self, in_phase: &[Complex], forces: &[Complex]) -> Vec<f64> {
        let all = in_phase.iter().zip(forces).zip(&self.detunings);
        let rates = all.map(|(([x, y], force), detuning)| {
            let action = x * x + y * y;
            // A mode without amplitude has its linear frequency.
            match action > f64::MIN_POSITIVE {
                true => -times(*force, [*x, -y])[0] / action,
                false => -detuning,
            }
        });
        rates.collect()
    }
}

impl Linear {
    /// Computes −i (C z + D z̄) from the real parts of z, then its imaginary parts.
    fn rates(&self, values: &[f64], rates: &mut [f64]) {
        let k = values.len() / 2;
        for a in 0..k {
            let mut sum = [0.0; 2];
            for b in 0..k {
                let [x, y] = [values[b], values[k + b]];
                let one = times(self.direct[a * k + b], [x, y]);
                let two = times(self.conjugate[a * k + b], [x, -y]);
                sum = [sum[0] + one[0] + two[0], sum[1] + one[1] + two[1]];
            }
            rates[a] = sum[1];
            rates[k + a] = -sum[0];
        }
    }
}

impl Ode<f64> for SlowEquations<'_> {
    fn dimension(&self) -> usize {
        let k = self.flow.differences;
        self.integrals().end + 4 * k * k
    }

    fn rates(&self, _: f64, state: &[f64], rates: &mut [f64]) {
        let (m, k) = (self.flow.in_phase, self.flow.differences);
        let in_phase = self.in_phase(state);
        let forces = self.forces(&in_phase);
        for (j, [x, y]) in forces.iter().enumerate() {
            rates[j] = *y;
            rates[m + j] = -x;
        }
        rates[self.phases()].copy_from_slice(&self.phase_rates_by(&in_phase, &forces));
        let linear = self.linear(&in_phase);
        for (a, place) in self.integrals().enumerate() {
            rates[place] = linear.direct[a * k + a][0];
        }
        let from = self.integrals().end;
        if k > 0 {
            let columns = state[from..].chunks_exact(2 * k);
            let both = columns.zip(rates[from..].chunks_exact_mut(2 * k));
            both.for_each(|(column, rates)| linear.rates(column, rates));
        }
    }
}

/// Largest frequency that may remain in the rotating frame, relative to the lowest frequency.
const SLOW: f64 = 0.5;

/// Returns the frequencies nearest to the given ones at which all resonances are exact. None if
/// they are far.
fn slow_frame(frequencies: &[f64], resonances: &[Resonance]) -> Option<Vec<f64>> {
    let own = DVector::from_column_slice(frequencies);
    if resonances.is_empty() {
        return Some(frequencies.to_vec());
    }
    let multiples: Vec<Vec<i32>> = resonances
        .iter()
        .map(|own| own.multiples().collect())
        .collect();
    let matrix = DMatrix::from_fn(resonances.len(), frequencies.len(), |row, column| {
        f64::from(multiples[row][column])
    });
    let inverse = matrix.clone().pseudo_inverse(1e-9).ok()?;
    let frame = &own - inverse * (matrix * &own);
    let lowest = frequencies.iter().copied().fold(f64::INFINITY, f64::min);
    ((&frame - own).amax() <= SLOW * lowest).then(|| frame.iter().copied().collect())
}
