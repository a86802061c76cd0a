//! Lines of series whose frequencies are known, and of the paper's pendulum.

use core::f64::consts::TAU;

use branched_pendulum::integrate::{Dop853, Integrator, Options};
use branched_pendulum::system::{OdeFn, State};
use branched_pendulum_measure::{LineSearch, Lines, Passages, Spectrum, Window};

use crate::normal::Normal;

/// θ_m of the paper's pendulum while both children move alike, released at rest from an
/// angle of the parent, the children vertical: closed form, apart from all generated code.
fn mean_angle(angle_deg: f64, span: f64, rate: f64) -> Vec<f64> {
    let (g, joint, m1, d1, i1) = (9.80665, 0.270, 0.12880, 0.084, 1.88e-3);
    let (m2, d2, i2) = (0.10531, 0.043, 0.516e-3);
    let a = i1 + m1 * d1 * d1 + 2.0 * m2 * joint * joint;
    let (b, c) = (2.0 * m2 * d2 * joint, 2.0 * (i2 + m2 * d2 * d2));
    let (g1, g2) = (g * (m1 * d1 + 2.0 * m2 * joint), 2.0 * g * m2 * d2);
    let equations = OdeFn::new(4, move |_: f64, y: &[f64], rates: &mut [f64]| {
        let (s, k) = (y[1] - y[0]).sin_cos();
        let one = b * s * y[3] * y[3] - g1 * y[0].sin();
        let two = -b * s * y[2] * y[2] - g2 * y[1].sin();
        let determinant = a * c - b * b * k * k;
        rates[0] = y[2];
        rates[1] = y[3];
        rates[2] = (c * one - b * k * two) / determinant;
        rates[3] = (a * two - b * k * one) / determinant;
    });
    let times: Vec<f64> = (0..(span * rate) as u32)
        .map(|i| f64::from(i) / rate)
        .collect();
    let start = State::at_rest(0.0, &[angle_deg.to_radians(), 0.0]);
    let states = Dop853::new(Options::with_tolerance(1e-14))
        .sample_to_vec(&equations, &start, &times)
        .unwrap();
    states.iter().map(|state| state.values[1]).collect()
}

/// Frequencies, amplitudes and phases of the lines of a swing.
const SWING: [[f64; 3]; 4] = [
    [0.8731696, 0.7, 0.3],
    [1.5825567, 0.4, -2.0],
    [0.1637825, 0.03, 1.0],
    [2.2919438, 0.02, 2.5],
];

fn waves(lines: &[[f64; 3]], span: f64, rate: f64) -> Vec<f64> {
    let sample = |index: u32| {
        let time = f64::from(index) / rate;
        let wave = |[f, a, phase]: &[f64; 3]| a * (TAU * f * time + phase).cos();
        0.1 + lines.iter().map(wave).sum::<f64>()
    };
    (0..(span * rate) as u32).map(sample).collect()
}

#[test]
fn lines_of_a_short_record_are_found_to_rounding() {
    for window in [
        Window::Rectangular,
        Window::Hann,
        Window::HannPower(2),
        Window::HannPower(3),
    ] {
        let search = LineSearch {
            window,
            ..LineSearch::default()
        };
        let samples = waves(&SWING, 32.0, 100.0);
        let found = search.find(&samples, 100.0).unwrap();
        assert_eq!(found.lines.len(), 4, "{window:?}");
        for (line, [f, a, phase]) in found.lines.iter().zip(&SWING) {
            assert!((line.frequency_hz - f).abs() < 1e-9, "{window:?} {line:?}");
            assert!((line.amplitude - a).abs() < 1e-9, "{window:?} {line:?}");
            assert!((line.phase - phase).abs() < 1e-7, "{window:?} {line:?}");
        }
        assert!((found.mean - 0.1).abs() < 1e-10 && found.residual < 1e-9);
        assert!((found.value(7.77) - samples[777]).abs() < 1e-9);
    }
}

/// Root mean squares of the error of the two strong lines with noise of 1 mrad: of the
/// frequency in hertz, and of frequency and amplitude in the deviations that are told.
fn errors_with_noise(draws: u64) -> [[f64; 3]; 2] {
    let mut sums = [[0.0; 3]; 2];
    let mut noise_lines = 0;
    let clean = waves(&SWING[..2], 32.0, 240.0);
    for seed in 1..=draws {
        let mut normal = Normal(seed * 0x9e37_79b9);
        let samples: Vec<f64> = clean.iter().map(|x| x + 1e-3 * normal.next()).collect();
        let found = LineSearch::default().find(&samples, 240.0).unwrap();
        // A chance of 1e-3 in each record.
        noise_lines += found.lines.len() - 2;
        assert!((found.residual / 1e-3 - 1.0).abs() < 0.05);
        for ((line, [f, a, _]), sums) in found.lines.iter().zip(&SWING).zip(&mut sums) {
            let error = line.frequency_hz - f;
            sums[0] += error.powi(2) / draws as f64;
            sums[1] += (error / line.deviation_hz).powi(2) / draws as f64;
            let error = line.amplitude - a;
            sums[2] += (error / line.amplitude_deviation).powi(2) / draws as f64;
        }
    }
    assert!(noise_lines as u64 <= draws / 100, "{noise_lines}");
    sums.map(|line| line.map(f64::sqrt))
}

#[test]
fn noise_moves_lines_as_far_as_is_told() {
    for [hertz, frequency, amplitude] in errors_with_noise(20) {
        assert!(hertz < 1.2e-6, "{hertz}");
        for deviations in [frequency, amplitude] {
            assert!((0.6..1.4).contains(&deviations), "{deviations}");
        }
    }
}

/// `cargo test -p branched-pendulum-measure --test measure 200_draws -- --ignored --nocapture`
#[test]
#[ignore = "a minute"]
fn noise_moves_lines_as_far_as_is_told_200_draws() {
    for [hertz, frequency, amplitude] in errors_with_noise(200) {
        println!("{hertz:.2e} Hz, {frequency:.2} and {amplitude:.2} deviations");
        assert!(hertz < 1.2e-6, "{hertz}");
        for deviations in [frequency, amplitude] {
            assert!((0.85..1.15).contains(&deviations), "{deviations}");
        }
    }
}

/// The paper's span of 32 s, against a record of 500 s.
fn against_a_long_record(angle_deg: f64, most: usize) -> (Lines, Lines) {
    let search = LineSearch {
        window: Window::HannPower(3),
        most: 6,
        ..LineSearch::default()
    };
    let long = search.find(&mean_angle(angle_deg, 500.0, 25.0), 25.0);
    let search = LineSearch {
        most,
        ..LineSearch::default()
    };
    let short = search.find(&mean_angle(angle_deg, 32.0, 100.0), 100.0);
    (long.unwrap(), short.unwrap())
}

#[test]
fn a_gentle_swing_in_32_s_is_known_as_in_500_s() {
    let (long, short) = against_a_long_record(20.0, 12);
    for (one, other) in long.lines.iter().zip(&short.lines).take(2) {
        let error = one.frequency_hz - other.frequency_hz;
        assert!(error.abs() < 1e-8, "{one:?} {other:?}");
    }
}

#[test]
fn lines_of_a_wide_swing_have_names() {
    let (long, short) = against_a_long_record(39.5, 18);
    for (one, other) in long.lines.iter().zip(&short.lines).take(4) {
        let error = one.frequency_hz - other.frequency_hz;
        assert!(error.abs() < 1e-5, "{one:?} {other:?}");
    }
    let fundamentals = [short.lines[0].frequency_hz, short.lines[1].frequency_hz];
    let tolerance = 0.01 * short.resolution_hz;
    let names = short.named(&fundamentals, 11, tolerance);
    let named = names.iter().take(12).flatten();
    let named: Vec<String> = named.map(|name| name.named(&["f_+", "f_−"])).collect();
    assert!(named.len() >= 10, "{named:?}");
    assert_eq!(named[..4], ["f_+", "f_−", "2f_+ − f_−", "2f_− − f_+"]);
    // The motion turns over with the angles: all orders are odd.
    assert!(
        names
            .iter()
            .take(12)
            .flatten()
            .all(|name| name.order() % 2 == 1),
        "{named:?}"
    );
}

/// Lines nearer than a cycle over the record are one, those 1.5 cycles apart two.
#[test]
fn a_record_separates_lines_more_than_a_cycle_apart() {
    for (cycles, count) in [(0.7, 1), (1.5, 2), (2.0, 2), (3.0, 2)] {
        let lines = [[1.0, 0.3, 0.0], [1.0 + cycles / 32.0, 0.2, 1.0]];
        let search = LineSearch {
            smallest: 0.3,
            ..LineSearch::default()
        };
        let found = search.find(&waves(&lines, 32.0, 100.0), 100.0).unwrap();
        assert_eq!(found.lines.len(), count, "{cycles} {found:?}");
        if count == 2 {
            for (line, [f, ..]) in found.lines.iter().zip(&lines) {
                assert!((line.frequency_hz - f).abs() < 1e-9, "{cycles} {line:?}");
            }
        }
    }
}

/// A line whose frequency falls, in stretches of time.
#[test]
fn passages_follow_a_line() {
    let frequency = |time: f64| 1.2 - 0.004 * time;
    let samples: Vec<f64> = (0..4000)
        .map(|index| f64::from(index) / 50.0)
        .map(|time| (TAU * (1.2 * time - 0.002 * time * time)).sin() * (-0.01 * time).exp())
        .collect();
    let passages = Passages {
        span: 10.0,
        step: 5.0,
    };
    let search = LineSearch {
        most: 1,
        ..LineSearch::default()
    };
    let lines = |part: &[f64]| search.find(part, 50.0);
    let found = passages.each(&samples, 50.0, lines).unwrap();
    assert_eq!(found.len(), 15);
    for passage in &found {
        let line = passage.found.lines[0];
        let error = line.frequency_hz - frequency(passage.middle);
        assert!(error.abs() < 2e-4, "{passage:?}");
        assert!((line.amplitude / (-0.01 * passage.middle).exp() - 1.0).abs() < 0.02);
    }
    let grid = [0.8, 0.9, 1.0, 1.1, 1.2];
    let spectra = passages.each(&samples, 50.0, |part| {
        Spectrum::at_frequencies(part, 50.0, &grid, Default::default())
    });
    let highest = |amplitudes: &[f64]| {
        let places = 0..amplitudes.len();
        places.max_by(|&a, &b| amplitudes[a].total_cmp(&amplitudes[b]))
    };
    let places = spectra.unwrap();
    let places = places.iter().map(|p| highest(&p.found.amplitudes).unwrap());
    assert!(places.clone().is_sorted_by(|a, b| a >= b) && places.count() == 15);
    let none = passages.each(&samples[..100], 50.0, lines).unwrap();
    assert!(none.is_empty());
    let error = Passages {
        span: f64::NAN,
        step: 1.0,
    };
    let error = error.each(&samples, 50.0, lines).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the span is NaN, outside of its accepted range"
    );
}

#[test]
fn rest_and_noise_alone_have_no_lines() {
    let search = LineSearch::default();
    assert!(search.find(&[0.5; 64], 10.0).unwrap().lines.is_empty());
    assert!(search.find(&[0.5, 0.6], 10.0).unwrap().lines.is_empty());
    let mut normal = Normal(5);
    let noise: Vec<f64> = (0..1000).map(|_| normal.next()).collect();
    assert!(search.find(&noise, 10.0).unwrap().lines.is_empty());
    let search = LineSearch {
        smallest: -1.0,
        ..search
    };
    let error = search.find(&noise, 10.0).unwrap_err().to_string();
    assert_eq!(
        error,
        "the smallest amplitude is -1, outside of its accepted range"
    );
}
