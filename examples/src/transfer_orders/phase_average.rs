//! Relative error over states with random phases.

use std::f64::consts::PI;

use super::error_curve::{Point, Sums};
use super::forms::{Motion, Powers, antiphase_frequency};
use super::random::Random;

/// Bounds of the in-phase state (θ_1, θ_m), rad, and of its rates, rad/s: what
/// the paper's apparatus goes through after a release from some 48°.
const ANGLES: [f64; 2] = [0.8, 2.0];
const RATES: [f64; 2] = [4.0, 10.0];

/// `count` states with a uniformly random in-phase motion and an antiphase
/// oscillation of the amplitude 1 rad at a random phase; the same at each call.
pub fn unit_states(count: usize) -> Vec<Motion> {
    let mut random = Random::new(0);
    let frequency = antiphase_frequency();
    let mut state = || {
        let [theta_1, theta_m] = ANGLES.map(|bound| random.within(bound));
        let [omega_1, omega_m] = RATES.map(|bound| random.within(bound));
        let (sin, cos) = random.within(PI).sin_cos();
        Motion {
            coordinates: [theta_1, theta_m, cos],
            rates: [omega_1, omega_m, frequency * sin],
        }
    };
    (0..count).map(|_| state()).collect()
}

/// The state with its antiphase oscillation made `amplitude` (rad) times as
/// large.
pub fn scaled(state: &Motion, amplitude: f64) -> Motion {
    let mut scaled = *state;
    scaled.coordinates[2] *= amplitude;
    scaled.rates[2] *= amplitude;
    scaled
}

/// Relative error at each amplitude, rad. The states differ in nothing but the
/// amplitude, so that the curves are smooth.
pub fn phase_average(states: &[Motion], amplitudes: &[f64]) -> Vec<Point> {
    let point = |&amplitude: &f64| {
        let mut sums = Sums::default();
        for state in states {
            sums.add(&Powers::at(&scaled(state, amplitude)));
        }
        sums.point(amplitude)
    };
    amplitudes.iter().filter_map(point).collect()
}
