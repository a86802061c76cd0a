//! Motions estimated from noisy data, against the motions that they were made from.

use branched_pendulum_measure::{
    KinematicSmoother, LocalPolynomials, SmoothedMotion, SmoothingError, running_integral,
};

use crate::normal::Normal;

fn signal(time: f64) -> [f64; 3] {
    let waves = [(0.8, 4.1, 0.3), (0.3, 9.7, 1.1), (0.1, 17.0, 2.0)];
    waves
        .iter()
        .fold([0.0; 3], |[y, v, a], &(size, pace, phase)| {
            let (sine, cosine) = (pace * time + phase).sin_cos();
            [
                y + size * sine,
                v + size * pace * cosine,
                a - size * pace * pace * sine,
            ]
        })
}

/// In how many of all cases angle and rate lie within 1.96 deviations. (Those of the second
/// derivative are too wide: the signal is smoother than the integral of a white jerk.)
fn coverage(
    smooth: impl Fn(&[f64], &[Option<f64>]) -> SmoothedMotion,
    times: &[f64],
    noise: f64,
    missing: impl Fn(usize) -> bool,
    looked_at: impl Fn(usize) -> bool,
) -> [f64; 2] {
    let (mut inside, mut count) = ([0_u32; 2], 0_u32);
    for seed in 1..=100 {
        let mut normal = Normal(seed * 0x9e37_79b9);
        let data: Vec<Option<f64>> = times
            .iter()
            .enumerate()
            .map(|(index, &time)| {
                let datum = signal(time)[0] + noise * normal.next();
                (!missing(index)).then_some(datum)
            })
            .collect();
        let smoothed = smooth(times, &data);
        for (index, &time) in times
            .iter()
            .enumerate()
            .filter(|(index, _)| looked_at(*index))
        {
            let (mean, deviation) = (smoothed.mean(index), smoothed.deviation(index));
            count += 1;
            for (part, truth) in signal(time).into_iter().take(2).enumerate() {
                inside[part] += u32::from((mean[part] - truth).abs() < 1.96 * deviation[part]);
            }
        }
    }
    inside.map(|inside| f64::from(inside) / f64::from(count))
}

fn by_smoothness(times: &[f64], data: &[Option<f64>]) -> SmoothedMotion {
    KinematicSmoother::default().smooth(times, data).unwrap()
}

fn by_polynomials(times: &[f64], data: &[Option<f64>]) -> SmoothedMotion {
    LocalPolynomials::default().smooth(times, data).unwrap()
}

#[test]
fn bars_hold_what_they_say() {
    let even: Vec<f64> = (0..400).map(|i| f64::from(i) / 120.0).collect();
    // Uneven by a third of an interval.
    let uneven: Vec<f64> = (0..400)
        .map(|i| (f64::from(i) + 0.33 * (2.3 * f64::from(i)).sin()) / 120.0)
        .collect();
    for times in [even, uneven] {
        for noise in [3e-4, 3e-3] {
            let all = coverage(by_smoothness, &times, noise, |_| false, |_| true);
            assert!(
                all.iter().all(|part| (0.93..0.995).contains(part)),
                "{noise}: {all:?}"
            );
        }
        // A gap of 12 pictures, and every seventh picture lost.
        let lost = |index: usize| (200..212).contains(&index) || index % 7 == 3;
        let within = coverage(by_smoothness, &times, 1e-3, lost, |index| {
            (200..212).contains(&index)
        });
        assert!(
            within.iter().all(|part| (0.85..=1.0).contains(part)),
            "gap: {within:?}"
        );
    }
}

/// What polynomials do not follow is not in their bars, which are nearly as good.
#[test]
fn bars_of_polynomials_hold_nearly_what_they_say() {
    let even: Vec<f64> = (0..400).map(|i| f64::from(i) / 120.0).collect();
    let uneven: Vec<f64> = (0..400)
        .map(|i| (f64::from(i) + 0.33 * (2.3 * f64::from(i)).sin()) / 120.0)
        .collect();
    for times in [even, uneven] {
        for noise in [3e-4, 3e-3] {
            let lost = |index: usize| index % 7 == 3;
            let all = coverage(by_polynomials, &times, noise, lost, |_| true);
            assert!(
                all.iter().all(|part| (0.9..0.995).contains(part)),
                "{noise}: {all:?}"
            );
        }
    }
}

#[test]
fn polynomials_of_their_own_degree_are_met_exactly() {
    let times: Vec<f64> = (0..30)
        .map(|i| 0.1 * f64::from(i) + 0.003 * f64::from(i * i % 7))
        .collect();
    let value = |t: f64| {
        [
            1.0 - t + 0.5 * t * t - 0.1 * t.powi(4),
            -1.0 + t - 0.4 * t.powi(3),
            1.0 - 1.2 * t * t,
        ]
    };
    let data: Vec<_> = times
        .iter()
        .enumerate()
        .map(|(i, &t)| (i % 5 != 2).then_some(value(t)[0]))
        .collect();
    for window in [None, Some(9)] {
        let smoother = LocalPolynomials {
            window,
            noise: Some(1e-3),
            ..LocalPolynomials::default()
        };
        let smoothed = smoother.smooth(&times, &data).unwrap();
        for (index, &time) in times.iter().enumerate() {
            for (found, exact) in smoothed.mean(index).iter().zip(value(time)) {
                assert!((found - exact).abs() < 1e-8, "{window:?} {index}");
            }
        }
    }
    let refused = |degree, window| {
        let noise = None;
        let smoother = LocalPolynomials {
            degree,
            window,
            noise,
        };
        smoother.smooth(&times, &data).unwrap_err().to_string()
    };
    assert_eq!(
        refused(1, None),
        "the degree is 1: degrees are 2 to 8, windows wider"
    );
    assert_eq!(
        refused(4, Some(5)),
        "the window is 5: degrees are 2 to 8, windows wider"
    );
    assert_eq!(
        refused(4, Some(99)),
        "the window is 99: degrees are 2 to 8, windows wider"
    );
}

/// A swing is integrated nearly as well as by Simpson's rule with its true middles.
#[test]
fn integrals_over_time_are_close() {
    for step in (1..=30).map(|count| 0.01 * f64::from(count)) {
        let times: Vec<f64> = (0..100).map(|i| step * f64::from(i)).collect();
        let swing: Vec<f64> = times.iter().map(|t| (t + 0.3).cos()).collect();
        let integral = running_integral(&times, &swing);
        let off = times.iter().zip(&integral);
        let off = off.map(|(t, sum)| (sum - (t + 0.3).sin() + 0.3_f64.sin()).abs());
        let off = off.fold(0.0, f64::max);
        assert!(off < step.powi(4) / 2000.0 && off > 0.0, "{step} {off}");
    }
    assert!(running_integral(&[], &[]).is_empty());
    assert_eq!(running_integral(&[0.0, 0.5], &[1.0, 3.0]), [0.0, 1.0]);
}

#[test]
fn draws_have_the_deviations_of_the_estimate() {
    let times: Vec<f64> = (0..200).map(|i| f64::from(i) / 100.0).collect();
    let mut normal = Normal(3);
    let data: Vec<_> = times
        .iter()
        .map(|&t| Some(signal(t)[0] + 1e-3 * normal.next()))
        .collect();
    assert!(by_smoothness(&times, &data).whiteness().abs() < 3.0);
    for smoothed in [by_smoothness(&times, &data), by_polynomials(&times, &data)] {
        check_draws(&smoothed, &mut normal);
    }
}

fn check_draws(smoothed: &SmoothedMotion, normal: &mut Normal) {
    assert!(
        (smoothed.noise() / 1e-3 - 1.0).abs() < 0.15,
        "{}",
        smoothed.noise()
    );
    let draws: Vec<_> = (0..2000).map(|_| smoothed.draw(|| normal.next())).collect();
    for index in [0, 57, 199] {
        let (mean, deviation) = (smoothed.mean(index), smoothed.deviation(index));
        for part in 0..3 {
            let values = draws.iter().map(|draw| draw[index][part] - mean[part]);
            let (sum, squares) = values.fold((0.0, 0.0), |(s, q), x| (s + x, q + x * x));
            let spread = (squares / 2000.0_f64).sqrt();
            assert!((sum / 2000.0).abs() < 0.1 * deviation[part]);
            assert!(
                (spread / deviation[part] - 1.0).abs() < 0.08,
                "{index} {part}"
            );
        }
    }
}

/// With the noise given and the jerk to be found, and the other way round, the same motion
/// comes out as with both found.
#[test]
fn what_is_given_is_kept() {
    let times: Vec<f64> = (0..300).map(|i| f64::from(i) / 100.0).collect();
    let mut normal = Normal(11);
    let data: Vec<_> = times
        .iter()
        .map(|&t| Some(signal(t)[0] + 1e-3 * normal.next()))
        .collect();
    let smooth = |noise, jerk| {
        KinematicSmoother { noise, jerk }
            .smooth(&times, &data)
            .unwrap()
    };
    let free = smooth(None, None);
    let both = smooth(Some(free.noise()), Some(free.densities()[0]));
    let noise = smooth(Some(free.noise()), None);
    let jerk = smooth(None, Some(free.densities()[0]));
    for other in [&both, &noise, &jerk] {
        assert!((other.noise() / free.noise() - 1.0).abs() < 0.05);
        assert!((other.densities()[0] / free.densities()[0] - 1.0).abs() < 0.3);
        let [_, one, _] = free.mean(150);
        let [_, two, _] = other.mean(150);
        assert!((one - two).abs() < 0.2 * free.deviation(150)[1]);
    }
}

#[test]
fn impossible_data_are_refused() {
    let smooth = |times: &[f64], data: &[Option<f64>]| {
        KinematicSmoother::default()
            .smooth(times, data)
            .unwrap_err()
            .to_string()
    };
    let times = [0.0, 0.1, 0.2, 0.3, 0.4];
    assert_eq!(smooth(&times, &[None; 4]), "5 times for 4 data");
    assert_eq!(
        smooth(&times, &[None; 5]),
        "0 data that are not missing; smoothing needs 4"
    );
    let infinite = [Some(1.0), Some(2.0), Some(f64::INFINITY), Some(1.0), None];
    assert_eq!(
        smooth(&times, &infinite),
        "datum 2 is inf; write missing ones as `None`"
    );
    let back = [0.0, 0.1, 0.1, 0.3, 0.4];
    assert_eq!(
        smooth(&back, &[Some(1.0); 5]),
        "time 2 is 0.1 s: times are finite and each later than the one before"
    );
    let error = KinematicSmoother {
        noise: Some(0.0),
        jerk: None,
    }
    .smooth(&times, &[Some(1.0); 5]);
    assert_eq!(
        error,
        Err(SmoothingError::Option {
            name: "noise",
            value: 0.0
        })
    );
}
