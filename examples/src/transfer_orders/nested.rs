//! The same question for a nested tree: two arms with a hand each, whose
//! antiphase sector has two coordinates.

use std::f64::consts::PI;

use branched_pendulum::{Transfer, branched_pendulum};

use super::cost::{Costs, median, time};
use super::error_curve::{Point, Sums};
use super::forms::{FORMS, Powers};
use super::random::Random;

/// Two jointed arms on a body, with W of every sector in all forms of
/// [`FORMS`].
#[branched_pendulum(
    gravity = 9.80665,
    body: rod(mass = 0.2, length = 0.3) [
        arm: rod(mass = 0.1, length = 0.2) [hand: rod(mass = 0.05, length = 0.15)] * 2
    ],
    emit(
        symmetric, momenta,
        budget(
            canonical, angle = 1, amplitude = 2, amplitude = 4, amplitude = 6, amplitude = 8
        )
    ),
)]
pub struct Arms;

/// Index of the antiphase sector in the model's list.
const ANTIPHASE: usize = 1;

/// Bounds of the in-phase angles, rad, and of their rates, rad/s.
const BOUNDS: [f64; 2] = [1.0, 5.0];

/// Angular frequency that relates differences and their rates, rad/s: about
/// those of the sector's two modes.
const FREQUENCY: f64 = 10.0;

/// Symmetric coordinates and their rates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    coordinates: [f64; 5],
    rates: [f64; 5],
}

impl Motion {
    fn scaled(&self, amplitude: f64) -> Self {
        let mut scaled = *self;
        // The means of body, arms and hands come first.
        for value in scaled.coordinates[3..]
            .iter_mut()
            .chain(&mut scaled.rates[3..])
        {
            *value *= amplitude;
        }
        scaled
    }

    fn momenta(&self) -> [f64; 5] {
        Arms::new().symmetric_momenta(&self.coordinates, &self.rates)
    }
}

/// `count` states with a uniformly random in-phase motion and differences of the
/// amplitude 1 rad at random phases; the same at each call.
pub fn unit_states(count: usize) -> Vec<Motion> {
    let mut random = Random::new(1);
    let mut state = || {
        let mut motion = Motion {
            coordinates: [0.0; 5],
            rates: [0.0; 5],
        };
        for index in 0..5 {
            let (angle, rate) = if index < 3 {
                (random.within(BOUNDS[0]), random.within(BOUNDS[1]))
            } else {
                let (sin, cos) = random.within(PI).sin_cos();
                (cos, FREQUENCY * sin)
            };
            motion.coordinates[index] = angle;
            motion.rates[index] = rate;
        }
        motion
    };
    (0..count).map(|_| state()).collect()
}

fn powers(motion: &Motion) -> Powers {
    let model = Arms::new();
    let (q, p) = (&motion.coordinates, &motion.momenta());
    let of = |transfers: [Transfer<f64>; 2]| transfers[ANTIPHASE].total();
    Powers {
        forms: [
            of(model.sector_transfers_angle_1(q, p)),
            of(model.sector_transfers_amplitude_2(q, p)),
            of(model.sector_transfers_amplitude_4(q, p)),
            of(model.sector_transfers_amplitude_6(q, p)),
            of(model.sector_transfers_amplitude_8(q, p)),
        ],
        exact: of(model.symmetric_sector_transfers(q, &motion.rates)),
    }
}

/// Relative error of W into the antiphase sector at each amplitude, rad.
pub fn phase_average(states: &[Motion], amplitudes: &[f64]) -> Vec<Point> {
    let point = |&amplitude: &f64| {
        let mut sums = Sums::default();
        for state in states {
            sums.add(&powers(&state.scaled(amplitude)));
        }
        sums.point(amplitude)
    };
    amplitudes.iter().filter_map(point).collect()
}

/// What W of both sectors costs from (q, p); the exact form solves for the
/// velocities first.
pub fn costs() -> Costs {
    const REPEATS: usize = 21;
    let model = Arms::new();
    let states: Vec<_> = unit_states(1024)
        .iter()
        .map(|state| (state.coordinates, state.momenta()))
        .collect();
    let mut times: [Vec<f64>; FORMS.len() + 1] = Default::default();
    for _ in 0..REPEATS {
        let pass = [
            time(&states, |q, p| model.sector_transfers_angle_1(q, p)),
            time(&states, |q, p| model.sector_transfers_amplitude_2(q, p)),
            time(&states, |q, p| model.sector_transfers_amplitude_4(q, p)),
            time(&states, |q, p| model.sector_transfers_amplitude_6(q, p)),
            time(&states, |q, p| model.sector_transfers_amplitude_8(q, p)),
            time(&states, |q, p| {
                let rates = model.symmetric_velocities(q, p);
                model.symmetric_sector_transfers(q, &rates)
            }),
        ];
        for (times, time) in times.iter_mut().zip(pass) {
            times.push(time);
        }
    }
    let [a, b, c, d, e, exact_ns] = times.map(median);
    Costs {
        ratios: [a, b, c, d, e].map(|time| time / exact_ns),
        exact_ns,
    }
}

#[cfg(test)]
mod tests {
    use super::{phase_average, unit_states};

    /// Amplitude order 2, 4, 6, 8 are that accurate; the angles' order is not.
    #[test]
    fn each_order_falls_as_its_own_power() {
        let states = unit_states(200);
        let curve = phase_average(&states, &[0.02, 0.04]);
        let [small, large] = [&curve[0], &curve[1]];
        let slope = |form: usize| (large.errors[form] / small.errors[form]).log2();
        // Relative to W, which is quadratic.
        for (form, expected) in [(1, 2.0), (2, 4.0), (3, 6.0)] {
            assert!(
                (slope(form) - expected).abs() < 0.1,
                "{form}: {}",
                slope(form)
            );
        }
        assert!(slope(0).abs() < 0.1 && small.errors[0] > 0.1);
        assert!(small.errors[4] < 1e-9);
    }
}
