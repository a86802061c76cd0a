//! How far the linear model is from the full one.

use alloc::vec;
use alloc::vec::Vec;

use super::linear::Linear;
use super::slopes::RestSlopes;
use crate::integrate::{Frames, longest_sub_step};
use crate::system::{AbsoluteAngles, Ode, OdeFn, Pendulum, State};

/// Amplitudes at which errors are measured, rad: small ones, where they grow with the
/// amplitude and its square.
const AMPLITUDES: [f64; 2] = [0.01, 0.05];

/// Frames in the second that is followed.
const FRAMES: u32 = 60;

/// For each mode, E₁ and E₂: over a second, the largest error of an angle is
/// E₁ a² + E₂ a³ for a motion of the mode alone from rest, whose largest angle is a.
///
/// E₁ vanishes about an equilibrium to whose two sides a tree is alike.
pub(super) fn errors<P: Pendulum<f64>>(
    model: &P,
    linear: &Linear,
    slopes: &RestSlopes,
) -> Vec<[f64; 2]> {
    let n = slopes.equilibrium.len();
    let sub_step = longest_sub_step(model);
    let small = OdeFn::new(2 * n, |_: f64, state: &[f64], rates: &mut [f64]| {
        let (theta, omega) = state.split_at(n);
        let (velocities, accelerations) = rates.split_at_mut(n);
        velocities.copy_from_slice(omega);
        for (row, acceleration) in accelerations.iter_mut().enumerate() {
            let (angles, rates) = (
                &slopes.by_angles[row * n..][..n],
                &slopes.by_rates[row * n..][..n],
            );
            *acceleration = 0.0;
            for link in 0..n {
                let angle = theta[link] - slopes.equilibrium[link];
                *acceleration += angles[link] * angle + rates[link] * omega[link];
            }
        }
    });
    let error = |shape: &[f64], amplitude: f64| {
        let angles = slopes.equilibrium.iter().zip(shape);
        let angles: Vec<f64> = angles.map(|(rest, part)| rest + amplitude * part).collect();
        let start = State::at_rest(0.0, &angles);
        distance(AbsoluteAngles(model), &small, &start, sub_step) / amplitude
    };
    let measure = |mode: usize| {
        let mut shape: Vec<f64> = (0..n).map(|i| linear.shapes.at(i, mode).high()).collect();
        let peak = shape
            .iter()
            .fold(0.0, |peak, part| f64::max(peak, part.abs()));
        shape.iter_mut().for_each(|part| *part /= peak);
        let [a, b] = AMPLITUDES;
        let [at_a, at_b] = [error(&shape, a) / a, error(&shape, b) / b];
        let second = f64::max((at_b - at_a) / (b - a), 0.0);
        [f64::max(at_a - second * a, 0.0), second]
    };
    (0..n).map(measure).collect()
}

/// Largest difference of an angle between two systems in the second after a start, by
/// the same method with the same steps.
fn distance(full: impl Ode<f64>, small: &impl Ode<f64>, start: &State<f64>, sub_step: f64) -> f64 {
    let follow = (
        Frames::new(full, start, sub_step),
        Frames::new(small, start, sub_step),
    );
    let (Ok(mut full), Ok(mut small)) = follow else {
        return f64::NAN;
    };
    let mut largest = vec![0.0_f64; start.values.len() / 2];
    for _ in 0..FRAMES {
        full.advance(1.0 / f64::from(FRAMES));
        small.advance(1.0 / f64::from(FRAMES));
        for ((largest, a), b) in largest.iter_mut().zip(full.state()).zip(small.state()) {
            *largest = largest.max((a - b).abs());
        }
    }
    largest.into_iter().fold(0.0, f64::max)
}
