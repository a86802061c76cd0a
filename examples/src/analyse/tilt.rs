//! The direction of gravity by the energy budget.

use super::estimate::{Estimate, Measured, quantity};

/// Largest tilt that is looked for, rad.
const LARGEST: f64 = 0.8;
/// Largest change of it in a step, rad.
const STEP: f64 = 0.2;
/// Change by which derivatives are taken, rad.
const SMALL: f64 = 1e-4;
const STEPS: usize = 20;

/// The angle from which all links are to be counted for the closure to be least, in its
/// deviations, by the method of Gauss and Newton; none where it leads too far.
///
/// The closure of any motion follows from its angles and rates, and smooth motions are turned with
/// their data: nothing is to be estimated again.
pub fn by_closure<const N: usize>(
    measured: &Measured<'_, N>,
    estimate: &Estimate<N>,
) -> Option<f64> {
    let deviations = estimate.energies.deviations.iter();
    let weights = deviations.map(|row| row[quantity::CLOSURE].powi(-2));
    let weights: Vec<f64> = weights
        .map(|weight| if weight.is_finite() { weight } else { 0.0 })
        .collect();
    let mut tilt = 0.0_f64;
    for _ in 0..STEPS {
        let here = measured.closure_turned(&estimate.motion, tilt);
        let beside = measured.closure_turned(&estimate.motion, tilt + SMALL);
        let rows = here.iter().zip(&beside).zip(&weights);
        let sums = rows.fold([0.0; 2], |[own, square], ((here, beside), weight)| {
            let slope = (beside - here) / SMALL;
            [own + weight * here * slope, square + weight * slope * slope]
        });
        let step = (-sums[0] / sums[1]).clamp(-STEP, STEP);
        tilt += step;
        if !(tilt.abs() <= LARGEST) {
            return None;
        }
        if step.abs() < SMALL {
            return Some(tilt);
        }
    }
    None
}
