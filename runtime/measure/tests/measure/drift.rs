//! Lines of series that drift.

use core::f64::consts::TAU;

use branched_pendulum_measure::{LineSearch, SpectrumError};

use crate::normal::Normal;

const RATE: f64 = 50.0;

/// A wave beside a drift, with noise.
fn series(wave: [f64; 2], drift: impl Fn(f64) -> f64, noise: f64, span: f64) -> Vec<f64> {
    let mut normal = Normal(5);
    let [hertz, amplitude] = wave;
    let count = (RATE * span) as usize;
    let times = (0..count).map(|sample| sample as f64 / RATE);
    times
        .map(|t| drift(t) + amplitude * (TAU * hertz * t).cos() + noise * normal.next())
        .collect()
}

#[test]
fn a_drift_hides_no_line() {
    type Drift = (&'static str, fn(f64) -> f64);
    let drifts: [Drift; 9] = [
        ("none", |_| 0.3),
        ("slow", |t| 0.002 * t),
        ("steady", |t| 0.05 * t),
        ("whirl", |t| 3.0 * t),
        ("back", |t| -0.4 * t + 7.0),
        ("bent", |t| 0.004 * t * t),
        ("turning", |t| 0.1 * t - 0.003 * t * t),
        ("thermal", |t| 2.0 * (-t / 60.0).exp()),
        ("cubic", |t| 1e-4 * (t - 20.0).powi(3)),
    ];
    for (name, drift) in drifts {
        for (wave, noise) in [([1.1, 0.1], 0.0), ([0.87, 0.05], 1e-3), ([3.3, 0.4], 5e-3)] {
            let samples = series(wave, drift, noise, 40.0);
            let found = LineSearch::default().find(&samples, RATE).unwrap();
            let line = found
                .lines
                .iter()
                .find(|line| (line.frequency_hz - wave[0]).abs() < 1e-3);
            let line = line.unwrap_or_else(|| panic!("{name} {wave:?} {found:?}"));
            assert!(
                (line.amplitude / wave[1] - 1.0).abs() < 5e-3,
                "{name} {line:?}"
            );
            assert!(found.slow < 1e-2 * wave[1], "{name} {found:?}");
            // The sum is the series.
            for sample in [200, 777, 1800] {
                let own = samples[sample] - found.value(sample as f64 / RATE);
                assert!(own.abs() < 5.0 * noise + 2e-2 * wave[1], "{name} {own}");
            }
        }
    }
}

#[test]
fn a_straight_drift_is_reported_with_its_slope() {
    for slope in [0.05, -3.0, 1e-3] {
        let samples = series([1.1, 0.1], |t| 0.2 + slope * t, 0.0, 40.0);
        let found = LineSearch::default().find(&samples, RATE).unwrap();
        assert_eq!((found.lines.len(), found.trend.len()), (1, 2), "{found:?}");
        assert!(
            (found.trend[1] - slope).abs() < 1e-9 * slope.abs().max(1.0),
            "{found:?}"
        );
        // The middle of the samples.
        let mean = 0.2 + slope * 0.5 * 1999.0 / RATE;
        assert!((found.mean - mean).abs() < 1e-9 && (found.trend[0] - mean).abs() < 1e-9);
        assert!((found.lines[0].frequency_hz - 1.1).abs() < 1e-9);
    }
}

/// What no polynomial of the degree follows is reported, not left out in silence.
#[test]
fn what_is_slow_and_left_is_reported() {
    let steps: [fn(f64) -> f64; 3] = [|t| 0.01 * t, |t| 0.001 * t * t, |t| 5.0 - 0.3 * t];
    for drift in steps {
        let samples = series([1.1, 1e-3], drift, 0.0, 40.0);
        let found = LineSearch {
            trend: 0,
            ..LineSearch::default()
        };
        let found = found.find(&samples, RATE).unwrap();
        assert!(found.slow > 1e-2, "{found:?}");
        assert_eq!(found.trend.len(), 1);
    }
    let refused = LineSearch {
        trend: 1000,
        ..LineSearch::default()
    };
    assert!(matches!(
        refused.find(&[1.0, 2.0, 1.5], RATE),
        Err(SpectrumError::Option { .. })
    ));
}

/// White noise has no line beside any drift, with a chance of a thousandth each.
#[test]
fn noise_beside_a_drift_has_no_line() {
    let mut lines = 0;
    for seed in 1..=100 {
        let mut normal = Normal(seed);
        let slope = 0.1 * normal.next();
        let samples: Vec<f64> = (0..800)
            .map(|sample| slope * f64::from(sample) / RATE + 1e-3 * normal.next())
            .collect();
        lines += LineSearch::default()
            .find(&samples, RATE)
            .unwrap()
            .lines
            .len();
    }
    assert!(lines <= 2, "{lines}");
}
