//! Motions estimated step by step, and their errors, against the same normal distributions
//! solved at once: dense matrices of covariances in closed form.

use branched_pendulum::analysis::variational::WithDerivative;
use branched_pendulum::integrate::{Dop853, Options};
use branched_pendulum_measure::{
    KinematicSmoother, LocalPolynomials, ModelSmoother, SmoothedMotion, bands,
};
use nalgebra::{DMatrix, DVector};

use crate::normal::Normal;
use branched_pendulum::system::OdeFn;

/// A motion whose `order`th derivative is white noise of density `density`, without any
/// knowledge of its start, and data with errors of deviation `noise`.
struct Regression<'a> {
    order: usize,
    density: f64,
    noise: f64,
    times: &'a [f64],
    data: &'a [Option<f64>],
}

fn taylor(time: f64, power: usize) -> f64 {
    (1..=power).fold(1.0, |product, factor| product * time / factor as f64)
}

impl Regression<'_> {
    /// Covariance of derivatives at two times, for a start that is known:
    /// q ∫ (s − u)^a/a! (t − u)^b/b! du up to the earlier one, by Gauss's rule of degree 5.
    fn covariance(&self, [s, t]: [f64; 2], derivatives: [usize; 2]) -> f64 {
        let [a, b] = derivatives.map(|derivative| self.order - 1 - derivative);
        let end = s.min(t);
        let root = 0.6_f64.sqrt();
        let nodes = [(-root, 5.0 / 18.0), (0.0, 8.0 / 18.0), (root, 5.0 / 18.0)];
        let parts = nodes.iter().map(|(node, weight)| {
            let u = 0.5 * end * (1.0 + node);
            weight * taylor(s - u, a) * taylor(t - u, b)
        });
        self.density * end * parts.sum::<f64>()
    }

    /// Mean and standard deviation of a derivative at a time.
    fn at(&self, time: f64, derivative: usize) -> [f64; 2] {
        let (variance, trend, values) = self.dense();
        let inverse = variance.try_inverse().unwrap();
        let found = self.found();
        let beside = DVector::from_fn(found.len(), |i, _| {
            self.covariance([time, found[i][0]], [derivative, 0])
        });
        let own_trend = DVector::from_fn(self.order, |power, _| {
            power
                .checked_sub(derivative)
                .map_or(0.0, |power| taylor(time, power))
        });
        let information = (trend.transpose() * &inverse * &trend)
            .try_inverse()
            .unwrap();
        let start = &information * trend.transpose() * &inverse * &values;
        let mean = own_trend.dot(&start) + beside.dot(&(&inverse * (values - &trend * &start)));
        let unknown = &own_trend - trend.transpose() * &inverse * &beside;
        let variance = self.covariance([time; 2], [derivative; 2])
            - beside.dot(&(&inverse * &beside))
            + unknown.dot(&(information * &unknown));
        [mean, variance.sqrt()]
    }

    /// Logarithm of the likelihood of the data whatever the start, but for a constant:
    /// −½ (ln det V + ln det Bᵀ V⁻¹ B + the squares that are left).
    fn log_likelihood(&self) -> f64 {
        let (variance, trend, values) = self.dense();
        let inverse = variance.clone().try_inverse().unwrap();
        let information = trend.transpose() * &inverse * &trend;
        let start =
            information.clone().try_inverse().unwrap() * trend.transpose() * &inverse * &values;
        let left = values - trend * start;
        let squares = left.dot(&(inverse * &left));
        -0.5 * (variance.determinant().ln() + information.determinant().ln() + squares)
    }

    /// Variance of the data for a start that is known, what the start does to them, and they.
    fn dense(&self) -> (DMatrix<f64>, DMatrix<f64>, DVector<f64>) {
        let found = self.found();
        let count = found.len();
        let variance = DMatrix::from_fn(count, count, |i, j| {
            let own = if i == j { self.noise * self.noise } else { 0.0 };
            own + self.covariance([found[i][0], found[j][0]], [0, 0])
        });
        let trend = DMatrix::from_fn(count, self.order, |i, power| taylor(found[i][0], power));
        (variance, trend, DVector::from_fn(count, |i, _| found[i][1]))
    }

    /// Times and data that are not missing.
    fn found(&self) -> Vec<[f64; 2]> {
        let all = self.times.iter().zip(self.data);
        all.filter_map(|(t, y)| Some([*t, (*y)?])).collect()
    }

    /// Asserts that smoothed states have the means and deviations of the regression: their numbers
    /// from `first` on, every `stride`th, are the value and its derivatives.
    fn agrees<R>(&self, smoothed: &SmoothedMotion<R>, first: usize, stride: usize)
    where
        R: AsRef<[f64]> + AsMut<[f64]> + Clone,
    {
        for (index, &time) in self.times.iter().enumerate() {
            let (means, deviations) = (smoothed.mean(index), smoothed.deviation(index));
            let numbers = means.as_ref().iter().zip(deviations.as_ref());
            let own = numbers.skip(first).step_by(stride);
            for (derivative, (own, bar)) in own.enumerate() {
                let [mean, deviation] = self.at(time, derivative);
                assert!(
                    (own - mean).abs() < 1e-3 * deviation,
                    "{index} {derivative}"
                );
                assert!((bar / deviation - 1.0).abs() < 1e-3, "{bar} {deviation}");
            }
        }
    }
}

/// Even times, uneven ones, and a gap, the latter with data missing.
fn records() -> Vec<(Vec<f64>, Vec<Option<f64>>)> {
    let mut normal = Normal(17);
    let even = |i: f64| 0.1 * i;
    let uneven = |i: f64| 0.1 * i + 0.03 * (2.3 * i).sin();
    let gap = |i: f64| if i < 7.0 { 0.05 * i } else { 0.4 + 0.05 * i };
    let places: [fn(f64) -> f64; 3] = [even, uneven, gap];
    let all = places.into_iter().enumerate().map(|(number, place)| {
        let times: Vec<f64> = (0..14).map(|i| place(f64::from(i))).collect();
        let datum = |(index, time): (usize, &f64)| {
            let value = (5.0 * time).sin() + 0.02 * normal.next();
            (number == 0 || index % 5 != 3).then_some(value)
        };
        let data = times.iter().enumerate().map(datum).collect();
        (times, data)
    });
    all.collect()
}

#[test]
fn a_white_jerk() {
    for (times, data) in records() {
        for (noise, jerk) in [(0.02, 30.0), (0.1, 1.0), (1e-3, 30.0)] {
            let smoother = KinematicSmoother {
                noise: Some(noise),
                jerk: Some(jerk),
            };
            let exact = Regression {
                order: 3,
                density: jerk,
                noise,
                times: &times,
                data: &data,
            };
            exact.agrees(&smoother.smooth(&times, &data).unwrap(), 0, 1);
        }
    }
}

/// What is found is likelier than all beside it.
#[test]
fn the_likeliest_jerk_and_noise() {
    for (times, data) in records() {
        let given = [(None, None), (Some(0.03), None), (None, Some(50.0))];
        for (noise, jerk) in given {
            let found = KinematicSmoother { noise, jerk }
                .smooth(&times, &data)
                .unwrap();
            let likelihood = |of_noise: f64, of_jerk: f64| {
                let exact = Regression {
                    order: 3,
                    density: of_jerk * found.densities()[0],
                    noise: of_noise * found.noise(),
                    times: &times,
                    data: &data,
                };
                exact.log_likelihood()
            };
            let best = likelihood(1.0, 1.0);
            for factor in [0.9, 1.1] {
                if noise.is_none() {
                    assert!(
                        likelihood(factor, 1.0) < best,
                        "{noise:?} {jerk:?} {factor}"
                    );
                }
                if jerk.is_none() {
                    assert!(
                        likelihood(1.0, factor) < best,
                        "{noise:?} {jerk:?} {factor}"
                    );
                }
            }
        }
    }
}

/// Errors of polynomials are those of the noise, and the noise has no bias.
#[test]
fn polynomials_know_their_noise() {
    let times: Vec<f64> = (0..50)
        .map(|i| 0.1 * f64::from(i) + 0.02 * (1.7 * f64::from(i)).sin())
        .collect();
    let truth = |t: f64| [1.0 - t + 0.2 * t.powi(3), 0.6 * t * t - 1.0, 1.2 * t];
    let draws = 600;
    for window in [7, 15] {
        let smoother = LocalPolynomials {
            degree: 3,
            window: Some(window),
            noise: None,
        };
        let places = [0, 20, 49];
        let (mut noise, mut errors, mut reported) = (0.0, [[0.0; 3]; 3], [[0.0; 3]; 3]);
        for seed in 1..=draws {
            let mut normal = Normal(seed * 0x9e37_79b9);
            let data: Vec<_> = times
                .iter()
                .map(|&t| Some(truth(t)[0] + normal.next()))
                .collect();
            let found = smoother.smooth(&times, &data).unwrap();
            noise += found.noise().powi(2) / draws as f64;
            for (number, place) in places.into_iter().enumerate() {
                let (mean, deviation) = (found.mean(place), found.deviation(place));
                for (part, truth) in truth(times[place]).into_iter().enumerate() {
                    errors[number][part] += (mean[part] - truth).powi(2);
                    reported[number][part] += deviation[part].powi(2);
                }
            }
        }
        assert!((noise - 1.0).abs() < 0.04, "{window} {noise}");
        for (error, reported) in errors.iter().flatten().zip(reported.iter().flatten()) {
            assert!(
                (reported / error - 1.0).abs() < 0.2,
                "{window} {reported} {error}"
            );
        }
    }
}

/// Bands of few draws are those of their sample.
#[test]
fn bands_have_the_deviations_of_their_draws() {
    let mut values = [[1.0], [3.0], [f64::NAN], [8.0]].into_iter();
    let (found, count) = bands(4, || values.next().into_iter().collect());
    assert_eq!((count, found.means[0]), (3, [4.0]));
    // (9 + 1 + 16)/2.
    assert!((found.deviations[0][0] - 13.0_f64.sqrt()).abs() < 1e-14);
}

/// Bodies that turn freely under white torques, each for itself: as many as there are inertias.
fn white_torques_on(inertias: &[f64], [noise, density]: [f64; 2]) {
    let count = inertias.len();
    let free = WithDerivative::new(
        OdeFn::new(2 * count, move |_: f64, y: &[f64], rates: &mut [f64]| {
            rates.fill(0.0);
            rates[..count].copy_from_slice(&y[count..]);
        }),
        move |_: f64, _: &[f64], v: &[f64], out: &mut [f64]| {
            out.fill(0.0);
            out[..count].copy_from_slice(&v[count..]);
        },
    );
    let mass = |_: &[f64]| -> Vec<Vec<f64>> {
        let row = |own: usize| {
            let entry = |other: usize| if other == own { inertias[own] } else { 0.0 };
            (0..count).map(entry).collect()
        };
        (0..count).map(row).collect()
    };
    let method = Dop853::new(Options::with_tolerance(1e-10));
    for (times, data) in records() {
        let smoother = ModelSmoother {
            noise: Some(noise),
            density: Some(density),
            ..ModelSmoother::default()
        };
        // Each body misses other data, and turns by an angle of its own more.
        let datum = |time: usize, body: usize| {
            let is_seen = body == 0 || (time + body) % 4 != 2;
            Some(data[time]? + body as f64).filter(|_| is_seen)
        };
        let rows = (0..times.len()).map(|time| (0..count).map(|body| datum(time, body)).collect());
        let rows: Vec<Vec<Option<f64>>> = rows.collect();
        let guess = vec![vec![0.0; 2 * count]; times.len()];
        let smoothed = smoother.smooth(&method, &free, mass, &times, &rows, &guess);
        let smoothed = smoothed.unwrap();
        for (body, inertia) in inertias.iter().enumerate() {
            let data: Vec<Option<f64>> = rows.iter().map(|row| row[body]).collect();
            let exact = Regression {
                order: 2,
                density: density / (inertia * inertia),
                noise,
                times: &times,
                data: &data,
            };
            exact.agrees(&smoothed, body, count);
        }
    }
}

#[test]
fn white_torques() {
    white_torques_on(&[1.0], [0.02, 5.0]);
    white_torques_on(&[0.2], [0.1, 0.3]);
    white_torques_on(&[3.0], [1e-3, 40.0]);
}

#[test]
fn white_torques_on_eight_bodies() {
    let inertias = [0.5, 1.0, 0.7, 2.0, 0.3, 1.5, 3.0, 0.9];
    white_torques_on(&inertias, [0.02, 5.0]);
}
