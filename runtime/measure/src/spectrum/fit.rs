//! Least-squares fit of a polynomial and waves to samples, including the frequencies of the waves.

use core::f64::consts::{PI, TAU};

use nalgebra::{DMatrix, DVector};

use super::trend::legendre;

/// One wave; its phase refers to the middle of the record.
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

    /// Returns cosine and sine of the phase at a position in the record, from −1 (start) to 1
    /// (end).
    fn at(&self, place: f64) -> [f64; 2] {
        let (sine, cosine) = (PI * self.cycles * place).sin_cos();
        [cosine, sine]
    }
}

/// Number of columns of a wave in the matrix of derivatives.
const COLUMNS: usize = 3;
/// Largest number of Gauss–Newton steps.
const ITERATIONS: usize = 30;
/// Largest number of times that a step is halved if it does not reduce the residual.
const HALVINGS: usize = 5;
/// Largest change of a frequency in one step, in cycles over the record.
const LARGEST_STEP: f64 = 0.5;

/// Fit of a polynomial and waves to weighted samples.
#[derive(Clone, Debug)]
pub(super) struct WaveFit<'a> {
    samples: &'a [f64],
    weights: &'a [f64],
    /// Coefficients of the Legendre polynomials over the record: the first one is the mean.
    pub(super) trend: Vec<f64>,
    pub(super) waves: Vec<Wave>,
}

impl<'a> WaveFit<'a> {
    /// Creates the fit of a polynomial of this degree, without waves.
    pub(super) fn new(samples: &'a [f64], weights: &'a [f64], degree: usize) -> Self {
        let mut fit = Self {
            samples,
            weights,
            trend: vec![0.0; degree + 1],
            waves: Vec::new(),
        };
        fit.trend[0] = fit.weighted(samples) / weights.iter().sum::<f64>();
        if degree > 0 {
            fit.refine();
        }
        fit
    }

    fn weighted(&self, values: &[f64]) -> f64 {
        self.weights.iter().zip(values).map(|(w, x)| w * x).sum()
    }

    /// Iterates over the positions of the samples in the record, from −1 to 1.
    fn sample_positions(&self) -> impl Iterator<Item = f64> + use<> {
        let count = self.samples.len();
        (0..count).map(move |index| (2 * index + 1) as f64 / count as f64 - 1.0)
    }

    /// Samples less polynomial and waves.
    pub(super) fn residual(&self) -> Vec<f64> {
        let mut values = vec![0.0; self.trend.len()];
        let mut model = |place: f64| {
            legendre(place, &mut values);
            let trend = self.trend.iter().zip(&values).map(|(c, value)| c * value);
            let trend: f64 = trend.sum();
            let waves = self.waves.iter().map(|wave| {
                let [cosine, sine] = wave.at(place);
                wave.cosine * cosine + wave.sine * sine
            });
            trend + waves.sum::<f64>()
        };
        let pairs = self.samples.iter().zip(self.sample_positions());
        pairs.map(|(sample, place)| sample - model(place)).collect()
    }

    /// Adds a wave of the given frequency, with the amplitude and phase that it has in the
    /// residual.
    pub(super) fn add(&mut self, cycles: f64) {
        let residual = self.residual();
        let total: f64 = self.weights.iter().sum();
        let mut wave = Wave {
            cycles,
            cosine: 0.0,
            sine: 0.0,
        };
        let rows = self
            .weights
            .iter()
            .zip(&residual)
            .zip(self.sample_positions());
        for ((weight, value), place) in rows {
            let [cosine, sine] = wave.at(place);
            wave.cosine += 2.0 * weight * value * cosine / total;
            wave.sine += 2.0 * weight * value * sine / total;
        }
        self.waves.push(wave);
    }

    /// Adjusts polynomial, amplitudes and frequencies together to minimise the weighted squares, by
    /// Gauss–Newton steps that are halved if they do not reduce the residual.
    pub(super) fn refine(&mut self) {
        let mut residual = self.residual();
        let mut cost = self.cost(&residual);
        for _ in 0..ITERATIONS {
            let Some(mut step) = self.step(&residual) else {
                return;
            };
            let largest = step.iter().skip(self.trend.len() + 2).step_by(COLUMNS);
            let largest = largest.fold(0.0_f64, |largest, change| largest.max(change.abs()));
            if largest > LARGEST_STEP {
                step *= LARGEST_STEP / largest;
            }
            let mut better = None;
            for _ in 0..HALVINGS {
                let moved = self.after_step(&step);
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

    /// Returns the largest absolute value of a sample.
    pub(super) fn largest(&self) -> f64 {
        self.samples.iter().fold(0.0, |most, x| most.max(x.abs()))
    }

    fn cost(&self, residual: &[f64]) -> f64 {
        let rows = self.weights.iter().zip(residual);
        rows.map(|(weight, value)| weight * value * value).sum()
    }

    /// Returns the weighted mean square of a residual.
    pub(super) fn mean_square(&self, residual: &[f64]) -> f64 {
        self.cost(residual) / self.weights.iter().sum::<f64>()
    }

    /// Returns the derivatives of the model by the polynomial's coefficients and by each wave's
    /// cosine, sine and frequency, multiplied by the square roots of the weights.
    fn derivatives(&self) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(self.samples.len(), self.column(self.waves.len()));
        let mut values = vec![0.0; self.trend.len()];
        for (row, (weight, place)) in self.weights.iter().zip(self.sample_positions()).enumerate() {
            let root = weight.sqrt();
            legendre(place, &mut values);
            for (column, value) in values.iter().enumerate() {
                matrix[(row, column)] = root * value;
            }
            for (index, wave) in self.waves.iter().enumerate() {
                let [cosine, sine] = wave.at(place);
                let turn = PI * place * (wave.sine * cosine - wave.cosine * sine);
                let first = self.column(index);
                matrix[(row, first)] = root * cosine;
                matrix[(row, first + 1)] = root * sine;
                matrix[(row, first + 2)] = root * turn;
            }
        }
        matrix
    }

    /// Returns the index of the first column that belongs to a wave.
    fn column(&self, wave: usize) -> usize {
        self.trend.len() + COLUMNS * wave
    }

    fn step(&self, residual: &[f64]) -> Option<DVector<f64>> {
        let derivatives = self.derivatives();
        let transposed = derivatives.transpose();
        let rows = self.weights.iter().zip(residual);
        let right = DVector::from_iterator(residual.len(), rows.map(|(w, r)| w.sqrt() * r));
        let inverse = inverse(&transposed * derivatives)?;
        Some(inverse * (transposed * right))
    }

    fn after_step(&self, step: &DVector<f64>) -> Self {
        let mut moved = self.clone();
        for (own, step) in moved.trend.iter_mut().zip(step.iter()) {
            *own += step;
        }
        for (index, wave) in moved.waves.iter_mut().enumerate() {
            let first = self.column(index);
            wave.cosine += step[first];
            wave.sine += step[first + 1];
            wave.cycles += step[first + 2];
        }
        moved
    }

    /// Returns the variances of each wave's frequency (in cycles) and amplitude, for white noise of
    /// variance 1 in the samples.
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
            let first = self.column(index);
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

/// Returns the inverse of a positive definite matrix whose rows have different units.
fn inverse(matrix: DMatrix<f64>) -> Option<DMatrix<f64>> {
    let scales = matrix.diagonal().map(|x| 1.0 / x.sqrt());
    let scale = DMatrix::from_diagonal(&scales);
    let inverse = (&scale * matrix * &scale).cholesky()?.inverse();
    Some(&scale * inverse * &scale)
}

/// Returns the phase (in cycles) at the first sample, of a wave whose phase refers to the middle of
/// the record.
pub(super) fn phase_at_start(wave: &Wave, count: usize) -> f64 {
    let start = PI * wave.cycles * (1.0 / count as f64 - 1.0);
    let phase = start - wave.sine.atan2(wave.cosine);
    phase - TAU * (phase / TAU).round()
}

#[cfg(test)]
mod tests {
    use super::super::Window;
    use super::{Wave, WaveFit};

    /// Checks the variances against the sum, over all samples, of the squared changes that each
    /// sample causes; for few cycles and any phase, where cosine, sine and frequency are
    /// correlated.
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
                let mut exact = WaveFit::new(&still, &weights, 0);
                exact.waves.clone_from(&waves);
                let samples: Vec<f64> = exact.residual().iter().map(|x| 0.2 - x).collect();
                let fitted = |samples: &[f64]| -> Vec<[f64; 2]> {
                    let mut fit = WaveFit::new(samples, &weights, 0);
                    fit.trend[0] = 0.2;
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
                let mut fit = WaveFit::new(&samples, &weights, 0);
                fit.waves.clone_from(&waves);
                let reported = fit.variances().unwrap();
                for (reported, found) in reported.iter().flatten().zip(sums.iter().flatten()) {
                    assert!(
                        (reported / found - 1.0).abs() < 1e-3,
                        "{window:?} {reported} {found}"
                    );
                }
            }
        }
    }
}
