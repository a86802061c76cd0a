//! Error of the linear model, measured by comparison with the full model.

use alloc::vec;
use alloc::vec::Vec;

use super::linear::Linear;
use super::slopes::RestSlopes;
use crate::integrate::{Frames, longest_sub_step};
use crate::system::{AbsoluteAngles, Ode, OdeFn, Pendulum, State};

/// Amplitudes (rad) at which errors are measured. They are so small that relative errors consist of
/// a part proportional to the amplitude and a part proportional to its square.
const AMPLITUDES: [f64; 2] = [0.01, 0.05];

/// Number of frames in the second over which errors are measured.
const FRAMES: u32 = 60;

/// Returns for each mode the coefficients E₁ and E₂ of its error. In a motion of the mode alone
/// from rest, whose largest angle is a, the largest error of an angle over one second is E₁ a² + E₂
/// a³.
///
/// E₁ is zero if the tree is symmetric about the equilibrium.
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

/// Returns the largest difference of an angle (rad) between the motions of two systems in the
/// second after a start. Both are integrated by the same method with the same steps.
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
