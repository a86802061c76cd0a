//! Least squares of a mean and waves, frequencies included.

use core::f64::consts::{PI, TAU};

use nalgebra::{DMatrix, DVector};

/// One wave, about the middle of the record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Wave {
    /// Frequency in cycles over the record.
    pub(super) cycles: f64,
    pub(super) cosine: f64,
    pub(super) sine: f64,
}

impl Wave {
    pub(super) fn amplitude(&self) -> f64 {
        self.cosine.hypot(self.sine)
    }

    /// Cosine and sine of the phase at a place between −1 and 1 in the record.
    fn at(&self, place: f64) -> [f64; 2] {
        let (sine, cosine) = (PI * self.cycles * place).sin_cos();
        [cosine, sine]
    }
}

/// Columns of a wave in the matrix of derivatives.
const COLUMNS: usize = 3;
/// Steps of Gauss and Newton at most.
const ITERATIONS: usize = 30;
/// Halvings of a step that does not make the residual smaller.
const HALVINGS: usize = 5;
/// Largest change of a frequency at a step, in cycles over the record.
const LARGEST_STEP: f64 = 0.5;

/// A mean and waves beside weighted samples.
#[derive(Clone, Debug)]
pub(super) struct WaveFit<'a> {
    samples: &'a [f64],
    weights: &'a [f64],
    pub(super) mean: f64,
    pub(super) waves: Vec<Wave>,
}

impl<'a> WaveFit<'a> {
    pub(super) fn new(samples: &'a [f64], weights: &'a [f64]) -> Self {
        let mut fit = Self {
            samples,
            weights,
            mean: 0.0,
            waves: Vec::new(),
        };
        fit.mean = fit.weighted(samples) / weights.iter().sum::<f64>();
        fit
    }

    fn weighted(&self, values: &[f64]) -> f64 {
        self.weights.iter().zip(values).map(|(w, x)| w * x).sum()
    }

    /// Places of the samples: −1 and 1 are the ends of the record.
    fn places(&self) -> impl Iterator<Item = f64> + use<> {
        let count = self.samples.len();
        (0..count).map(move |index| (2 * index + 1) as f64 / count as f64 - 1.0)
    }

    /// Samples less mean and waves.
    pub(super) fn residual(&self) -> Vec<f64> {
        let model = |place: f64| {
            let waves = self.waves.iter().map(|wave| {
                let [cosine, sine] = wave.at(place);
                wave.cosine * cosine + wave.sine * sine
            });
            self.mean + waves.sum::<f64>()
        };
        let pairs = self.samples.iter().zip(self.places());
        pairs.map(|(sample, place)| sample - model(place)).collect()
    }

    /// Adds the wave of a frequency, as it stands in the residual.
    pub(super) fn add(&mut self, cycles: f64) {
        let residual = self.residual();
        let total: f64 = self.weights.iter().sum();
        let mut wave = Wave {
            cycles,
            cosine: 0.0,
            sine: 0.0,
        };
        let rows = self.weights.iter().zip(&residual).zip(self.places());
        for ((weight, value), place) in rows {
            let [cosine, sine] = wave.at(place);
            wave.cosine += 2.0 * weight * value * cosine / total;
            wave.sine += 2.0 * weight * value * sine / total;
        }
        self.waves.push(wave);
    }

    /// Moves mean, amplitudes and frequencies together to the least weighted squares (steps
    /// of Gauss and Newton, halved until they do not lead uphill).
    pub(super) fn refine(&mut self) {
        let mut residual = self.residual();
        let mut cost = self.cost(&residual);
        for _ in 0..ITERATIONS {
            let Some(mut step) = self.step(&residual) else {
                return;
            };
            let largest = step.iter().skip(3).step_by(COLUMNS);
            let largest = largest.fold(0.0_f64, |largest, change| largest.max(change.abs()));
            if largest > LARGEST_STEP {
                step *= LARGEST_STEP / largest;
            }
            let mut better = None;
            for _ in 0..HALVINGS {
                let moved = self.moved(&step);
                let residual = moved.residual();
                if moved.cost(&residual) < cost {
                    better = Some((moved, residual));
                    break;
                }
                step *= 0.5;
            }
            let Some((moved, left)) = better else { return };
            (*self, residual) = (moved, left);
            cost = self.cost(&residual);
        }
    }

    fn cost(&self, residual: &[f64]) -> f64 {
        let rows = self.weights.iter().zip(residual);
        rows.map(|(weight, value)| weight * value * value).sum()
    }

    /// Weighted mean square of a residual.
    pub(super) fn mean_square(&self, residual: &[f64]) -> f64 {
        self.cost(residual) / self.weights.iter().sum::<f64>()
    }

    /// The model's derivatives by the mean and by each wave's cosine, sine and cycles, times
    /// the root of the weights.
    fn derivatives(&self) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(self.samples.len(), 1 + COLUMNS * self.waves.len());
        for (row, (weight, place)) in self.weights.iter().zip(self.places()).enumerate() {
            let root = weight.sqrt();
            matrix[(row, 0)] = root;
            for (index, wave) in self.waves.iter().enumerate() {
                let [cosine, sine] = wave.at(place);
                let turn = PI * place * (wave.sine * cosine - wave.cosine * sine);
                let first = 1 + COLUMNS * index;
                matrix[(row, first)] = root * cosine;
                matrix[(row, first + 1)] = root * sine;
                matrix[(row, first + 2)] = root * turn;
            }
        }
        matrix
    }

    fn step(&self, residual: &[f64]) -> Option<DVector<f64>> {
        let derivatives = self.derivatives();
        let transposed = derivatives.transpose();
        let rows = self.weights.iter().zip(residual);
        let right = DVector::from_iterator(residual.len(), rows.map(|(w, r)| w.sqrt() * r));
        let inverse = inverse(&transposed * derivatives)?;
        Some(inverse * (transposed * right))
    }

    fn moved(&self, step: &DVector<f64>) -> Self {
        let mut moved = self.clone();
        moved.mean += step[0];
        for (index, wave) in moved.waves.iter_mut().enumerate() {
            let first = 1 + COLUMNS * index;
            wave.cosine += step[first];
            wave.sine += step[first + 1];
            wave.cycles += step[first + 2];
        }
        moved
    }

    /// Variances of each wave's cycles and amplitude for white noise of variance 1 in the
    /// samples.
    pub(super) fn variances(&self) -> Option<Vec<[f64; 2]>> {
        let derivatives = self.derivatives();
        let transposed = derivatives.transpose();
        let mut weighted = derivatives.clone();
        for (mut row, weight) in weighted.row_iter_mut().zip(self.weights) {
            row *= *weight;
        }
        let inverse = inverse(&transposed * derivatives)?;
        let all = &inverse * (transposed * weighted) * &inverse;
        let of = |(index, wave): (usize, &Wave)| {
            let first = 1 + COLUMNS * index;
            let (c, s) = (wave.cosine, wave.sine);
            let square = c * c + s * s;
            let amplitude = c * c * all[(first, first)]
                + 2.0 * c * s * all[(first, first + 1)]
                + s * s * all[(first + 1, first + 1)];
            [all[(first + 2, first + 2)], amplitude / square]
        };
        Some(self.waves.iter().enumerate().map(of).collect())
    }
}

/// Inverse of a positive matrix whose rows have units of their own.
fn inverse(matrix: DMatrix<f64>) -> Option<DMatrix<f64>> {
    let scales = matrix.diagonal().map(|x| 1.0 / x.sqrt());
    let scale = DMatrix::from_diagonal(&scales);
    let inverse = (&scale * matrix * &scale).cholesky()?.inverse();
    Some(&scale * inverse * &scale)
}

/// Phase in cycles at the first sample of a wave that is given about the middle.
pub(super) fn phase_at_start(wave: &Wave, count: usize) -> f64 {
    let start = PI * wave.cycles * (1.0 / count as f64 - 1.0);
    let phase = start - wave.sine.atan2(wave.cosine);
    phase - TAU * (phase / TAU).round()
}

#[cfg(test)]
mod tests {
    use super::{Wave, WaveFit};
    use crate::spectrum::Window;

    /// Variances are sums over all samples of what each of them moves, squared: few cycles
    /// and any phase, where cosine, sine and frequency are correlated.
    #[test]
    fn variances_are_those_of_samples_moved_one_by_one() {
        let wave = |cycles, cosine, sine| Wave {
            cycles,
            cosine,
            sine,
        };
        let swings = [
            vec![wave(1.3, 0.8, 0.7)],
            vec![wave(1.6, -0.3, 0.9)],
            vec![wave(1.2, 0.5, -0.5), wave(3.4, 0.1, 0.4)],
        ];
        for waves in swings {
            for window in [Window::Rectangular, Window::Hann] {
                let weights = window.weights(48);
                let still = vec![0.0; 48];
                let mut exact = WaveFit::new(&still, &weights);
                exact.waves.clone_from(&waves);
                let samples: Vec<f64> = exact.residual().iter().map(|x| 0.2 - x).collect();
                let fitted = |samples: &[f64]| -> Vec<[f64; 2]> {
                    let mut fit = WaveFit::new(samples, &weights);
                    fit.mean = 0.2;
                    fit.waves.clone_from(&waves);
                    fit.refine();
                    fit.waves
                        .iter()
                        .map(|wave| [wave.cycles, wave.amplitude()])
                        .collect()
                };
                let mut sums = vec![[0.0; 2]; waves.len()];
                for moved in 0..samples.len() {
                    let by = |step: f64| {
                        let mut samples = samples.clone();
                        samples[moved] += step;
                        fitted(&samples)
                    };
                    let (above, below) = (by(1e-4), by(-1e-4));
                    for (sum, (above, below)) in sums.iter_mut().zip(above.iter().zip(&below)) {
                        for (sum, (above, below)) in sum.iter_mut().zip(above.iter().zip(below)) {
                            *sum += ((above - below) / 2e-4).powi(2);
                        }
                    }
                }
                let mut fit = WaveFit::new(&samples, &weights);
                fit.waves.clone_from(&waves);
                let told = fit.variances().unwrap();
                for (told, found) in told.iter().flatten().zip(sums.iter().flatten()) {
                    assert!(
                        (told / found - 1.0).abs() < 1e-3,
                        "{window:?} {told} {found}"
                    );
                }
            }
        }
    }
}
