//! Birkhoff normal forms: from the Hamiltonian they give the frequencies of a motion as functions
//! of its amplitudes, and the releases from which small differences between copies grow
//! ([`NormalForm`]). The derivation is in `docs/theory.md`.

mod coupling;
mod error;
mod evaluation;
mod expansion;
mod flow;
mod lattice;
mod lie;
mod options;
mod period;
mod prediction;
mod refusal;
mod resonance;
mod subspace;
mod tongue;

use std::collections::BTreeSet;
use std::f64::consts::TAU;

use self::coupling::{Averaged, is_in_phase, powers_of};
pub use self::error::NormalFormError;
use self::evaluation::{Complex, Monomials, Powers, times};
use self::expansion::ExpandedHamiltonian;
use self::flow::{SlowEquations, SlowFlow};
use self::lattice::slow_phases;
use self::lie::Lie;
pub use self::options::NormalFormOptions;
use self::period::{SlowMotion, SlowOrbit};
use self::prediction::Level;
pub use self::prediction::{Agreement, DegreeEstimate, Prediction};
pub use self::refusal::Refusal;
pub use self::resonance::{Resonance, ResonanceKind};
pub use self::subspace::MotionSubspace;
pub use self::tongue::{Tongue, Tongues};
use crate::scalar::{Exponents, Polynomial, Terms};
use crate::system::{Energy, Model};

/// Resonant normal form of an in-phase motion with small differences between copies.
#[derive(Clone, Debug)]
pub struct NormalForm {
    options: NormalFormOptions,
    subspace: MotionSubspace,
    rest: Vec<f64>,
    expansion: ExpandedHamiltonian,
    resonances: Vec<Resonance>,
    /// Resonances of order 4 that would let differences grow, but are removed because they are far
    /// at rest.
    far: Vec<Resonance>,
    /// Mismatch below which one of them is no longer far, Hz.
    near_hz: f64,
    averaged: Averaged,
    /// Slow motion by the two highest degrees.
    flows: [SlowFlow; 2],
    /// Normal coordinates of the motion in phase, as polynomials of the linear ones.
    coordinates: Vec<Monomials>,
    /// Normal coordinates of releases from rest, whose linear ones are real.
    at_rest: Vec<Monomials>,
}

/// Mismatch at which a removed resonance is no longer far, as a part of the bound of kept ones.
const NEAR: f64 = 0.5;

/// Largest number of monomials of an expansion.
const MOST_MONOMIALS: f64 = 2e6;

impl NormalForm {
    /// Largest number of modes.
    pub const MOST_MODES: usize = Exponents::MOST_VARIABLES / 2;

    /// Derives the normal form of a model about its equilibrium `rest` (rad, one angle for each
    /// link). Friction and drive are neglected.
    ///
    /// # Errors
    ///
    /// [`NormalFormError`].
    pub fn new<M>(
        model: &M,
        rest: &[f64],
        subspace: &MotionSubspace,
        options: NormalFormOptions,
    ) -> Result<Self, NormalFormError>
    where
        M: Model<f64>,
        M::Of<Polynomial>: Energy<Polynomial>,
    {
        let degree = options.degree;
        let modes = subspace.in_phase() + subspace.differences();
        check(degree, modes)?;
        let expansion = ExpandedHamiltonian::of(model, rest, subspace, degree)?;
        let (in_phase, differences) = (subspace.in_phase(), subspace.differences());
        let frequencies = &expansion.frequencies;
        let reference = frequencies
            .iter()
            .skip(in_phase)
            .copied()
            .fold(f64::INFINITY, f64::min);
        let reference = match reference.is_finite() {
            true => reference,
            false => frequencies.iter().copied().fold(f64::INFINITY, f64::min),
        };
        let keeps = |resonance: &Resonance| {
            let order = f64::from(resonance.order().max(4) - 4);
            let bound = options.bound * reference * 0.5_f64.powf(0.5 * order);
            resonance.mismatch(frequencies).abs() <= bound
                && !options.removed.contains(&resonance.canonical())
        };
        let lie = Lie {
            in_phase,
            differences,
            frequencies,
            keeps,
        };
        let normalised = lie.normalise(&expansion.by_degree);
        let own = |exponents: Exponents| is_in_phase(exponents, in_phase, modes);
        let variables: Vec<usize> = (0..in_phase).chain(modes..modes + in_phase).collect();
        let coordinates = (0..in_phase).map(|mode| lie.coordinate(mode, &normalised, &own));
        let coordinates: Vec<Vec<Terms>> = coordinates.collect();
        let kept = normalised.hamiltonian.iter().flat_map(|terms| terms.iter());
        let kept = kept.map(|(exponents, _)| lie.resonance(exponents).canonical());
        let kept: BTreeSet<Resonance> = kept.filter(|own| !own.is_zero()).collect();
        let resonances: Vec<Resonance> = kept.into_iter().collect();
        let flows = [degree - 2, degree]
            .map(|degree| SlowFlow::of(&normalised.hamiltonian, degree, in_phase, differences));
        let of_both = |own: &Vec<Terms>| Monomials::of(own, &variables);
        let of_real = |own: &Vec<Terms>| Monomials::of(&real(own, modes), &variables[..in_phase]);
        let far = Resonance::of_growth(in_phase, differences).into_iter();
        let far = far.filter(|own| !keeps(own) && !options.removed.contains(&own.canonical()));
        let far: Vec<Resonance> = far.collect();
        let near_hz = NEAR * options.bound * reference / TAU;
        Ok(Self {
            far,
            near_hz,
            averaged: Averaged::of(&normalised.hamiltonian, in_phase, differences),
            flows,
            resonances,
            subspace: subspace.clone(),
            rest: rest.to_vec(),
            at_rest: coordinates.iter().map(of_real).collect(),
            coordinates: coordinates.iter().map(of_both).collect(),
            expansion,
            options,
        })
    }

    /// Returns the settings.
    pub fn options(&self) -> &NormalFormOptions {
        &self.options
    }

    /// Returns the number of in-phase modes.
    pub fn in_phase(&self) -> usize {
        self.subspace.in_phase()
    }

    /// Returns the frequencies of small motions, in Hz: in-phase modes first, in ascending order,
    /// then those of the differences.
    pub fn linear_frequencies_hz(&self) -> Vec<f64> {
        let own = self.expansion.frequencies.iter();
        own.map(|frequency| frequency / TAU).collect()
    }

    /// Returns the kept resonances.
    pub fn resonances(&self) -> &[Resonance] {
        &self.resonances
    }

    /// Returns the normal coordinates z_j of the in-phase motion, computed with each of the two
    /// highest degrees, from the angles (rad) and momenta (kg m²/s) of all links; I_j = |z_j|² are
    /// the actions.
    fn normal_coordinates(&self, theta: &[f64], momenta: &[f64]) -> [Vec<Complex>; 2] {
        let count = self.subspace.in_phase();
        let from_rest: Vec<f64> = theta.iter().zip(&self.rest).map(|(a, b)| a - b).collect();
        let positions = self.subspace.coordinates(&from_rest);
        let own = self.subspace.directions.iter().take(count);
        let momenta: Vec<f64> = own
            .map(|direction| {
                let parts = direction
                    .iter()
                    .map(|(link, weight)| weight * momenta.get(*link).copied().unwrap_or(f64::NAN));
                parts.sum()
            })
            .collect();
        let sum = |row: &[f64], values: &[f64]| -> f64 {
            row.iter().zip(values).map(|(a, b)| a * b).sum()
        };
        let linear = (0..count).map(|j| {
            let x = sum(&self.expansion.to_normal[j], &positions);
            let y = sum(&self.expansion.shapes[j], &momenta);
            [x, y].map(|part| part * std::f64::consts::FRAC_1_SQRT_2)
        });
        let linear: Vec<Complex> = linear.collect();
        let degrees = self.degrees().map(|degree| degree - 1);
        if linear.iter().all(|[_, y]| *y == 0.0) {
            let real: Vec<f64> = linear.iter().map(|[x, _]| *x).collect();
            let powers = powers_of(&real, self.options.degree);
            return degrees.map(|degree| {
                let own = self.at_rest.iter();
                own.map(|own| [own.value(&powers, degree), 0.0]).collect()
            });
        }
        let conjugates = linear.iter().map(|[x, y]| [*x, -y]);
        let all: Vec<Complex> = linear.iter().copied().chain(conjugates).collect();
        let powers = Powers::new(&all, self.options.degree, [1.0, 0.0], times);
        let values = self
            .coordinates
            .iter()
            .map(|own| own.complex_values(&powers, degrees));
        let mut both = [Vec::with_capacity(count), Vec::with_capacity(count)];
        for [lower, higher] in values {
            both[0].push(lower);
            both[1].push(higher);
        }
        both
    }

    fn degrees(&self) -> [u32; 2] {
        [self.options.degree - 2, self.options.degree]
    }

    /// Returns the actions of the in-phase motion through a state, in J s, given the angles (rad)
    /// and momenta (kg m²/s) of all links.
    pub fn actions(&self, theta: &[f64], momenta: &[f64]) -> Vec<DegreeEstimate> {
        let [lower, higher] = self.normal_coordinates(theta, momenta);
        let action = |[x, y]: Complex| x * x + y * y;
        let both = lower.into_iter().zip(higher);
        both.map(|(low, high)| DegreeEstimate::of([action(low), action(high)]))
            .collect()
    }

    /// Returns the frequencies ∂H/∂I_j of the modes in phase at these actions (J s), in hertz.
    /// Resonances among them, by which actions change, are left out.
    pub fn frequencies_hz(&self, actions: &[f64]) -> Vec<DegreeEstimate> {
        let own = (0..self.in_phase()).map(|j| actions.get(j).map_or(f64::NAN, |own| own.sqrt()));
        let amplitudes: Vec<f64> = own.collect();
        let powers = powers_of(&amplitudes, self.options.degree);
        let [lower, higher] = self
            .degrees()
            .map(|degree| self.averaged.at(&powers, degree).in_phase);
        let both = lower.into_iter().zip(higher);
        both.map(|(low, high)| DegreeEstimate::of([low / TAU, high / TAU]))
            .collect()
    }

    /// Returns the frequencies and the growth of differences of the motion in phase through a
    /// state, from angles (rad) and momenta (kg m²/s) of all links; momenta are zero at a
    /// release from rest.
    ///
    /// # Errors
    ///
    /// [`Refusal`].
    pub fn predict(&self, theta: &[f64], momenta: &[f64]) -> Result<Prediction, Refusal> {
        let both = self.normal_coordinates(theta, momenta);
        let degrees = self.degrees();
        if !both.iter().flatten().flatten().all(|own| own.is_finite()) {
            return Err(Refusal::NotFinite);
        }
        let amplitudes = both
            .each_ref()
            .map(|both| both.iter().map(|[x, y]| x.hypot(*y)).collect::<Vec<f64>>());
        let rates = [0, 1].map(|level| {
            let powers = powers_of(&amplitudes[level], degrees[level]);
            self.averaged.at(&powers, degrees[level])
        });
        let active = self.averaged.active(&amplitudes[1], &rates[1], degrees[1]);
        let slow = slow_phases(&active);
        let is_single = self.averaged.differences.len() <= 1 && slow.is_empty();
        let levels = match active.is_empty() || is_single {
            true => rates.map(|own| Level::of(&self.averaged, own)),
            false => {
                let level = |place: usize| {
                    let motion = self.slow_motion(place, &both[place], &active, &slow)?;
                    Ok(Level::of_slow(&self.averaged, &rates[place], motion))
                };
                [level(0)?, level(1)?]
            }
        };
        let prediction = Prediction::of(&self.averaged, levels, degrees, self.options.agreement)?;
        self.check_removed(&prediction)?;
        Ok(prediction)
    }

    /// Refuses a prediction if the frequencies at its amplitude bring a resonance near that was
    /// removed because it is far at rest.
    fn check_removed(&self, prediction: &Prediction) -> Result<(), Refusal> {
        let both = [
            &prediction.frequencies_hz,
            &prediction.difference_frequencies_hz,
        ];
        let frequencies = both.into_iter().flatten();
        let frequencies: Vec<f64> = frequencies.map(|own| own.value).collect();
        let nearest = self.far.iter().map(|own| (own, own.mismatch(&frequencies)));
        let nearest = nearest.min_by(|(_, a), (_, b)| a.abs().total_cmp(&b.abs()));
        match nearest {
            Some((resonance, mismatch_hz)) if mismatch_hz.abs() < self.near_hz => {
                Err(Refusal::Approached {
                    name: resonance.to_string(),
                    mismatch_hz,
                })
            }
            _ => Ok(()),
        }
    }

    /// Averages the motion under the active resonances, by one of the two degrees.
    fn slow_motion(
        &self,
        level: usize,
        start: &[Complex],
        active: &[Resonance],
        slow: &[Vec<i64>],
    ) -> Result<SlowMotion, Refusal> {
        let refused = || Refusal::Resonances {
            names: names(active),
        };
        let frequencies = &self.expansion.frequencies;
        let equations = SlowEquations::new(&self.flows[level], frequencies, active);
        let slow_phase = match slow {
            [] => None,
            [own] => Some(own.as_slice()),
            _ => return Err(refused()),
        };
        let orbit = SlowOrbit {
            equations: equations.ok_or_else(refused)?,
            resonances: active,
            slow_phase,
            longest: self.options.following,
        };
        orbit.averages(start)
    }
}

/// Returns the names of resonances, with commas.
fn names<'a>(resonances: impl IntoIterator<Item = &'a Resonance>) -> String {
    let names: Vec<String> = resonances.into_iter().map(ToString::to_string).collect();
    names.join(", ")
}

/// Returns polynomials of n coordinates and their conjugates where all of them are real.
fn real(by_degree: &[Terms], modes: usize) -> Vec<Terms> {
    let joined = |exponents: Exponents| {
        (0..modes).fold(exponents, |own, j| {
            let powers = 0..own.of(modes + j);
            powers.fold(own, |own, _| match own.without(modes + j) {
                Some(rest) => rest.times(Exponents::of_variable(j)),
                None => own,
            })
        })
    };
    let own = by_degree.iter();
    own.map(|terms| {
        terms
            .iter()
            .map(|(exponents, value)| (joined(exponents), value))
            .collect()
    })
    .collect()
}

fn check(degree: u32, modes: usize) -> Result<(), NormalFormError> {
    if !(4..=12).contains(&degree) || !degree.is_multiple_of(2) {
        return Err(NormalFormError::Degree(degree));
    }
    if modes > NormalForm::MOST_MODES {
        return Err(NormalFormError::TooManyModes {
            modes,
            most: NormalForm::MOST_MODES,
        });
    }
    // Binomial coefficient (2n + degree) over degree.
    let variables = 2.0 * modes as f64;
    let factors = (1..=degree).map(|k| (variables + f64::from(k)) / f64::from(k));
    let monomials = factors.product::<f64>();
    if monomials > MOST_MONOMIALS {
        return Err(NormalFormError::TooManyMonomials {
            monomials,
            most: MOST_MONOMIALS,
            degree,
        });
    }
    Ok(())
}
