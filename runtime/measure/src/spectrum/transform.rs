//! Fourier sums Σ x_n exp(−2πi f n) of samples x_n.

use core::f64::consts::TAU;

use realfft::RealFftPlanner;

/// Returns the magnitudes of the Fourier sums at f = k/L, k = 0 … ⌊L/2⌋, for samples that are
/// extended by zeros to the length L.
pub(super) fn at_grid(samples: &[f64], length: usize) -> Vec<f64> {
    let transform = RealFftPlanner::<f64>::new().plan_fft_forward(length);
    let mut input = transform.make_input_vec();
    for (slot, sample) in input.iter_mut().zip(samples) {
        *slot = *sample;
    }
    let mut output = transform.make_output_vec();
    match transform.process(&mut input, &mut output) {
        Ok(()) => output.iter().map(|sum| sum.re.hypot(sum.im)).collect(),
        // Cannot fail: both buffers have the length that the transform asks for.
        Err(_) => Vec::new(),
    }
}

/// Returns the magnitude of the Fourier sum at a frequency in cycles per sample, by direct
/// summation.
pub(super) fn at_frequency(samples: &[f64], frequency: f64) -> f64 {
    // The phase advances by rotation, which is cheap but lets rounding grow;
    // each block starts from an exact phase, so that it does not.
    const BLOCK: usize = 64;
    let (rotate_sine, rotate_cosine) = (TAU * frequency).sin_cos();
    let (mut real, mut imaginary) = (0.0, 0.0);
    for (block, values) in samples.chunks(BLOCK).enumerate() {
        let turns = frequency * (block * BLOCK) as f64;
        let (mut sine, mut cosine) = (TAU * (turns - turns.floor())).sin_cos();
        for value in values {
            real += value * cosine;
            imaginary += value * sine;
            (sine, cosine) = (
                sine * rotate_cosine + cosine * rotate_sine,
                cosine * rotate_cosine - sine * rotate_sine,
            );
        }
    }
    real.hypot(imaginary)
}
