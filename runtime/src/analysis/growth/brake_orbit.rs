//! Nonlinear normal modes: periodic motions between two states at rest.

use nalgebra::{DMatrix, DVector};

use super::GrowthError;
use crate::analysis::variational::{Linearised, flow_jacobian};
use crate::integrate::{Dop853, Options};
use crate::system::State;

/// A periodic motion that starts from rest, is at rest again half a period later, and then returns
/// along the same path: the nonlinear continuation of a linear mode.
#[derive(Clone, Debug, PartialEq)]
pub struct BrakeOrbit {
    /// Angles at the release, rad.
    pub release: Vec<f64>,
    /// Angles half a period later, at the second state of rest, rad.
    pub turn: Vec<f64>,
    /// Period, s.
    pub period: f64,
}

impl BrakeOrbit {
    /// Returns true if the second half of the motion mirrors the first one (angles change sign), as
    /// for trees with mirror symmetry.
    pub fn is_symmetric(&self) -> bool {
        let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
        let size = largest(&mut self.release.iter().map(|angle| angle.abs()));
        let both = self.release.iter().zip(&self.turn);
        largest(&mut both.map(|(a, b)| (a + b).abs())) <= 1e-6 * size
    }
}

/// Settings of the continuation of a linear mode to motions of any amplitude, without friction and
/// drive.
///
/// The release angles a and half periods τ at which the velocities vanish, ω(τ) = 0, form a curve.
/// The curve is followed from the equilibrium by steps along its tangent, each corrected by
/// Newton's method perpendicular to the tangent; derivatives of the flow come from the variational
/// equations. Source: R. Seydel, *Practical Bifurcation and Stability Analysis*, 3rd edition,
/// Springer 2010, chapters 4 and 7.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Continuation {
    /// Absolute and relative tolerance of the integration.
    pub tolerance: f64,
    /// Longest step along the curve, rad.
    pub step: f64,
    /// Largest angle from the equilibrium up to which the curve is followed, in rad.
    pub largest: f64,
}

/// Largest number of iterations of Newton's method at one point of the curve.
const ITERATIONS: usize = 8;

/// Fraction of the longest step below which the curve is no longer followed.
const SHORTEST: f64 = 1e-3;

/// Largest number of steps along the curve.
const MOST_STEPS: usize = 10_000;

impl Continuation {
    /// Returns the motions on the curve, from small to large amplitudes. `system` is a model in its
    /// angles, [`linearised`](crate::analysis::variational::linearised); `shape` and `frequency_hz`
    /// (Hz) are those of its linear mode about `equilibrium` (rad), as in
    /// [`Modes`](crate::analysis::Modes).
    ///
    /// The curve ends if an angle reaches [`largest`](Self::largest), or if it turns so sharply
    /// that even a thousandth of the step is too long.
    ///
    /// # Errors
    ///
    /// [`GrowthError::Mode`] for a frequency or shape that does not fit the system, or
    /// [`GrowthError::NoOrbit`] if no motion of the curve is found.
    pub fn orbits<L: Linearised<f64>>(
        &self,
        system: &L,
        equilibrium: &[f64],
        shape: &[f64],
        frequency_hz: f64,
    ) -> Result<Vec<BrakeOrbit>, GrowthError> {
        let n = equilibrium.len();
        let size = shape.iter().map(|part| part * part).sum::<f64>().sqrt();
        let valid = frequency_hz > 0.0 && size > 0.0 && n > 0;
        if !valid || shape.len() != n || system.dimension() != 2 * n {
            return Err(GrowthError::Mode);
        }
        let shooting = RestToRest {
            system,
            equilibrium,
            method: Dop853::new(Options::with_tolerance(self.tolerance)),
            half_period: 0.5 / frequency_hz,
        };
        let mut place = DVector::zeros(n + 1);
        place[n] = 1.0;
        let mut tangent =
            DVector::from_iterator(n + 1, shape.iter().map(|part| part / size).chain([0.0]));
        let mut step = self.step;
        let mut orbits = Vec::new();
        for _ in 0..MOST_STEPS {
            if step < SHORTEST * self.step {
                break;
            }
            let guess = &place + step * &tangent;
            let Some((found, next)) = shooting.correct(&guess, &tangent, self.tolerance) else {
                step *= 0.5;
                continue;
            };
            if found.rows(0, n).amax() > self.largest {
                break;
            }
            orbits.push(shooting.orbit(&found)?);
            // Makes the next step shorter where the curve bends.
            let turn = next.dot(&tangent);
            step = (step * if turn > 0.995 { 1.5 } else { 0.7 }).min(self.step);
            (place, tangent) = (found, next);
        }
        if orbits.is_empty() {
            return Err(GrowthError::NoOrbit);
        }
        Ok(orbits)
    }
}

/// Motions of a system that is released at rest. A point of the curve consists of the angles from
/// the equilibrium (rad) and the half period relative to that of the linear mode.
struct RestToRest<'a, L> {
    system: &'a L,
    equilibrium: &'a [f64],
    method: Dop853<f64>,
    half_period: f64,
}

impl<L: Linearised<f64>> RestToRest<'_, L> {
    fn start(&self, place: &DVector<f64>) -> State<f64> {
        let angles = self.equilibrium.iter().zip(place.iter());
        let angles: Vec<f64> = angles.map(|(middle, angle)| middle + angle).collect();
        State::at_rest(0.0, &angles)
    }

    /// Returns the point at which the curve crosses the plane through `guess` that is perpendicular
    /// to the tangent, and the tangent of the curve there.
    fn correct(
        &self,
        guess: &DVector<f64>,
        tangent: &DVector<f64>,
        tolerance: f64,
    ) -> Option<(DVector<f64>, DVector<f64>)> {
        let n = self.equilibrium.len();
        let mut place = guess.clone();
        for _ in 0..ITERATIONS {
            let (velocities, mut matrix) = self.velocities(&place)?;
            matrix.set_row(n, &tangent.transpose());
            let solver = matrix.lu();
            let mut residual = DVector::zeros(n + 1);
            residual.rows_mut(0, n).copy_from(&velocities);
            residual[n] = tangent.dot(&(&place - guess));
            let change = solver.solve(&residual)?;
            place -= &change;
            // The error that remains is about the square of this change.
            if change.amax() < tolerance.sqrt() {
                let mut along = DVector::zeros(n + 1);
                along[n] = 1.0;
                let next = solver.solve(&along)?;
                return Some((place, next.normalize()));
            }
            if change.amax() > 1.0 {
                return None;
            }
        }
        None
    }

    /// Returns the velocities half a period after the release and their derivatives by the point of
    /// the curve, with an additional row for the tangent.
    fn velocities(&self, place: &DVector<f64>) -> Option<(DVector<f64>, DMatrix<f64>)> {
        let n = self.equilibrium.len();
        let start = self.start(place);
        let time = self.half_period * place[n];
        let (end, columns) = flow_jacobian(&self.method, self.system, &start, time).ok()?;
        let mut rates = vec![0.0; 2 * n];
        self.system.rates(end.time, &end.values, &mut rates);
        let velocities = DVector::from_column_slice(end.velocities());
        let matrix = DMatrix::from_fn(n + 1, n + 1, |row, column| match (row, column) {
            (row, _) if row == n => 0.0,
            (row, column) if column == n => self.half_period * rates[n + row],
            (row, column) => columns[column * 2 * n + n + row],
        });
        Some((velocities, matrix))
    }

    fn orbit(&self, place: &DVector<f64>) -> Result<BrakeOrbit, GrowthError> {
        let start = self.start(place);
        let half = self.half_period * place[self.equilibrium.len()];
        let (end, _) = flow_jacobian(&self.method, self.system, &start, half)?;
        Ok(BrakeOrbit {
            turn: end.positions().to_vec(),
            release: start.positions().to_vec(),
            period: 2.0 * half,
        })
    }
}
