//! Errors of approximations of W over states with random phases.

use core::f64::consts::PI;

use super::background::Background;
use super::curve::{ErrorCurve, SquareSums, curves};
use super::error::{TruncationError, check_amplitudes, check_bounds, check_positive};
use super::motion::{Powers, sector_frequencies};
use super::{ComparedForms, small_coordinates};
use crate::analysis::random::Random;
use crate::ensemble::Ensemble;

/// Settings for the relative error of approximations of W over random states. The coordinates that
/// are not small are random within their bounds. Each small difference is at a random phase of an
/// oscillation with the given amplitude and the frequency of its sector.
///
/// Each call uses the same states, and states of two amplitudes differ only in the amplitude. The
/// cost is one evaluation of each form per state and amplitude, distributed to all cores.
#[derive(Clone, Debug, PartialEq)]
pub struct PhaseAverage {
    /// Amplitudes in rad, positive and ascending; [`logarithmic`](super::logarithmic) returns a
    /// suitable list.
    pub amplitudes: Vec<f64>,
    /// Number of states at each amplitude.
    pub states: usize,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Bounds of the coordinates that are not small.
    pub background: Background,
}

/// Symmetric coordinates (rad) and their momenta (kg m²/s).
pub type CanonicalState = (Vec<f64>, Vec<f64>);

impl PhaseAverage {
    /// Returns the errors of all truncated forms of W, one curve per receiving sector.
    ///
    /// # Errors
    ///
    /// [`TruncationError`] if amplitudes or bounds are invalid, if the model lacks the exact form,
    /// or if differences do not oscillate.
    pub fn curves(
        &self,
        model: &(impl ComparedForms + Sync),
    ) -> Result<Vec<ErrorCurve>, TruncationError> {
        check_amplitudes(&self.amplitudes)?;
        let unit = self.unit_states(model)?;
        let (n, receivers) = (model.coordinates(), model.receivers());
        let small = small_coordinates(model);
        let forms = Powers::new(model)?.forms();
        let sums = Ensemble::new().map(&self.amplitudes, |_, &amplitude| {
            let mut powers = Powers::new(model)?;
            let mut sums = SquareSums::new(receivers.len(), forms.len());
            let mut state = vec![0.0; 2 * n];
            for unit in unit.chunks_exact(2 * n) {
                scale(&small, unit, amplitude, &mut state);
                let (coordinates, rates) = state.split_at(n);
                powers.evaluate(coordinates, rates);
                sums.add(&powers.exact, &powers.truncated);
            }
            Ok::<_, TruncationError>((amplitude, sums))
        });
        let sums = sums.into_iter().collect::<Result<Vec<_>, _>>()?;
        Ok(curves(&receivers, &forms, &sums))
    }

    /// Returns the states of one amplitude (rad) in canonical variables, for programs that measure
    /// the cost of evaluating the forms.
    ///
    /// # Errors
    ///
    /// As [`curves`](Self::curves).
    pub fn canonical_states(
        &self,
        model: &impl ComparedForms,
        amplitude: f64,
    ) -> Result<Vec<CanonicalState>, TruncationError> {
        check_positive("an amplitude", amplitude)?;
        let unit = self.unit_states(model)?;
        let (n, small) = (model.coordinates(), small_coordinates(model));
        let mut momenta_of = model.momenta();
        let canonical = |unit: &[f64]| {
            let mut coordinates = vec![0.0; 2 * n];
            scale(&small, unit, amplitude, &mut coordinates);
            let rates = coordinates.split_off(n);
            let mut momenta = vec![0.0; n];
            momenta_of([&coordinates, &rates], &mut momenta);
            (coordinates, momenta)
        };
        Ok(unit.chunks_exact(2 * n).map(canonical).collect())
    }

    /// Returns states whose amplitude is 1 rad: for each state its coordinates, then its rates.
    fn unit_states(&self, model: &impl ComparedForms) -> Result<Vec<f64>, TruncationError> {
        let n = model.coordinates();
        let Background { angles, rates } = &self.background;
        check_bounds("bounds of the angles", n, angles)?;
        check_bounds("bounds of the rates", n, rates)?;
        let frequencies = sector_frequencies(model)?;
        let (small, sectors) = (small_coordinates(model), model.truncated_sectors());
        let mut random = Random::new(self.seed);
        let mut states = Vec::with_capacity(2 * n * self.states);
        for _ in 0..self.states {
            let begin = states.len();
            for (index, bound) in angles.iter().chain(rates).enumerate() {
                states.push(if small.contains(&(index % n)) {
                    0.0
                } else {
                    random.within(*bound)
                });
            }
            for (sector, frequency) in sectors.iter().zip(&frequencies) {
                for &index in &sector.coordinates {
                    let (sin, cos) = random.within(PI).sin_cos();
                    states[begin + index] = cos;
                    states[begin + n + index] = frequency * sin;
                }
            }
        }
        Ok(states)
    }
}

/// Writes the state `unit`, with its small differences multiplied by `amplitude`, to `out`.
fn scale(small: &[usize], unit: &[f64], amplitude: f64, out: &mut [f64]) {
    out.copy_from_slice(unit);
    for &index in small {
        out[index] *= amplitude;
        out[unit.len() / 2 + index] *= amplitude;
    }
}
