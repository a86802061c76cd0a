//! Spectra of series whose amplitudes and frequencies are known.

use core::f64::consts::TAU;

use branched_pendulum_measure::{Spectrum, SpectrumOptions, Window};

fn series(count: usize, rate: f64, parts: &[(f64, f64)]) -> Vec<f64> {
    (0..count)
        .map(|i| {
            let time = i as f64 / rate;
            parts
                .iter()
                .map(|(f, a)| a * (TAU * f * time + 0.3).cos())
                .sum()
        })
        .collect()
}

#[test]
fn amplitudes_on_the_grid_are_exact_under_both_windows() {
    let samples = series(1000, 100.0, &[(1.0, 0.7), (3.0, 0.2)]);
    for window in [Window::Rectangular, Window::Hann] {
        let options = SpectrumOptions {
            remove_mean: false,
            window,
        };
        let spectrum = Spectrum::at_fourier_frequencies(&samples, 100.0, options).unwrap();
        assert_eq!(spectrum.frequencies_hz.len(), 501);
        assert_eq!(spectrum.frequencies_hz[500], 50.0);
        assert!((spectrum.amplitudes[10] - 0.7).abs() < 1e-12);
        assert!((spectrum.amplitudes[30] - 0.2).abs() < 1e-12);
        assert!(spectrum.amplitudes[20] < 1e-12);
    }
}

#[test]
fn the_mean_is_the_amplitude_at_zero_unless_removed() {
    let samples: Vec<f64> = series(64, 8.0, &[(1.0, 0.5)])
        .iter()
        .map(|x| x + 2.0)
        .collect();
    let amplitude = |remove_mean| {
        let options = SpectrumOptions {
            remove_mean,
            window: Window::Rectangular,
        };
        Spectrum::at_frequencies(&samples, 8.0, &[0.0], options)
            .unwrap()
            .amplitudes[0]
    };
    assert!((amplitude(false) - 2.0).abs() < 1e-13);
    assert!(amplitude(true) < 1e-13);
}

#[test]
fn half_the_sample_rate_is_counted_once() {
    let samples: Vec<f64> = (0..32)
        .map(|i| if i % 2 == 0 { 0.4 } else { -0.4 })
        .collect();
    let options = SpectrumOptions {
        remove_mean: false,
        window: Window::Rectangular,
    };
    let spectrum = Spectrum::at_frequencies(&samples, 10.0, &[5.0], options).unwrap();
    assert!((spectrum.amplitudes[0] - 0.4).abs() < 1e-13);
}

#[test]
fn long_series_do_not_lose_the_phase() {
    let count = 200_000;
    let frequency = 1.0 / 8.0 + 1.0 / 400_000.0 * 2.0;
    let samples = series(count, 1.0, &[(frequency, 1.0)]);
    let options = SpectrumOptions {
        remove_mean: false,
        window: Window::Rectangular,
    };
    let spectrum = Spectrum::at_frequencies(&samples, 1.0, &[frequency], options).unwrap();
    assert!((spectrum.amplitudes[0] - 1.0).abs() < 1e-10);
}

#[test]
fn refusals() {
    let message = |samples: &[f64], rate: f64, frequencies: &[f64]| {
        Spectrum::at_frequencies(samples, rate, frequencies, SpectrumOptions::default())
            .unwrap_err()
            .to_string()
    };
    let samples = [0.0, 1.0, 0.0, -1.0];
    assert_eq!(
        message(&[1.0], 1.0, &[]),
        "a spectrum needs at least two samples, but got 1"
    );
    assert_eq!(
        message(&[1.0, f64::NAN], 1.0, &[]),
        "sample 1 is NaN: samples must be finite"
    );
    assert_eq!(
        message(&samples, 0.0, &[]),
        "the sample rate is 0 Hz: it must be finite and positive"
    );
    assert_eq!(
        message(&samples, 10.0, &[1.0, 6.0]),
        "frequency 1 is 6 Hz: it must be between 0 and 5 Hz, half the sample rate"
    );
    assert_eq!(
        message(&samples, 10.0, &[2.0, 1.0]),
        "frequency 1 is 1 Hz, after 2 Hz: frequencies must ascend"
    );
    assert!(Spectrum::at_fourier_frequencies(&[], 1.0, SpectrumOptions::default()).is_err());
}
