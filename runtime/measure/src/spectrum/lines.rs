//! The lines of a quasi-periodic series, out of a short record.

use core::f64::consts::TAU;

use super::combination::CombinationTone;
use super::error::{SpectrumError, check};
use super::fit::{Wave, WaveFit, phase_at_start};
use super::transform::at_grid;
use super::window::Window;

/// A search for the lines of a series, the strongest first.
///
/// As in J. Laskar's frequency analysis (Icarus 88 (1990); Physica D 67 (1993)) the
/// frequency at which the windowed residual is strongest joins the lines; then all lines'
/// frequencies, amplitudes and phases, and the mean, move together to the least weighted
/// squares, which takes the place of the orthogonal projection one by one and leaves no
/// error of a line in its neighbours. For samples that are a sum of a few waves the
/// frequencies are right to rounding, with white noise to the bound of Cramér and Rao but
/// for what the window wastes.
///
/// The search ends with [`most`](Self::most) lines, or when the strongest of what is left is
/// below [`smallest`](Self::smallest), or one that white noise of its size would show.
///
/// # Examples
///
/// Two waves over 20 s, whose spectrum has a line every 0.05 Hz:
///
/// ```
/// use std::f64::consts::TAU;
///
/// use branched_pendulum_measure::LineSearch;
///
/// let wave = |f: f64, t: f64| (TAU * f * t).cos();
/// let samples: Vec<f64> = (0..2000)
///     .map(|i| 0.01 * f64::from(i))
///     .map(|t| 1.0 + 0.7 * wave(0.8731, t) + 0.2 * wave(1.5826, t))
///     .collect();
/// let found = LineSearch::default().find(&samples, 100.0)?;
/// assert_eq!(found.lines.len(), 2);
/// assert!((found.lines[0].frequency_hz - 0.8731).abs() < 1e-9);
/// assert!((found.lines[1].frequency_hz - 1.5826).abs() < 1e-9);
/// assert!((found.lines[1].amplitude - 0.2).abs() < 1e-9);
/// assert!((found.mean - 1.0).abs() < 1e-9);
/// # Ok::<(), branched_pendulum_measure::SpectrumError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineSearch {
    /// Weights of the samples. The higher its power, the less lines that are not found
    /// disturb those that are, and the more noise does.
    pub window: Window,
    /// Largest number of lines.
    pub most: usize,
    /// Amplitude below which no line is sought, of that of the strongest.
    pub smallest: f64,
}

impl Default for LineSearch {
    fn default() -> Self {
        Self {
            window: Window::Hann,
            most: 12,
            smallest: 1e-9,
        }
    }
}

/// One line: amplitude · cos(2π frequency t + phase), t from the first sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectralLine {
    /// Frequency in hertz.
    pub frequency_hz: f64,
    /// Standard deviation of the frequency in hertz, if what is left beside the line were
    /// noise of the strength that it has there.
    pub deviation_hz: f64,
    /// Amplitude, in the units of the series.
    pub amplitude: f64,
    /// Standard deviation of the amplitude.
    pub amplitude_deviation: f64,
    /// Phase at the first sample, rad from −π to π.
    pub phase: f64,
}

/// Lines of a series, and what they leave of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Lines {
    /// Mean.
    pub mean: f64,
    /// The lines, the strongest first.
    pub lines: Vec<SpectralLine>,
    /// Root mean square of what is left, weighted by the window.
    pub residual: f64,
    /// Distance in hertz within which two lines are taken for one: one cycle over the record.
    pub resolution_hz: f64,
}

impl Lines {
    /// Returns the sum of mean and lines at a time (s) from the first sample.
    pub fn value(&self, time: f64) -> f64 {
        let waves = self.lines.iter();
        let wave = |line: &SpectralLine| {
            line.amplitude * (TAU * line.frequency_hz * time + line.phase).cos()
        };
        self.mean + waves.map(wave).sum::<f64>()
    }

    /// Returns the name of each line as a [`CombinationTone`] of fundamental frequencies, none
    /// where no combination up to `order` is within `tolerance_hz`.
    pub fn named(
        &self,
        fundamentals_hz: &[f64],
        order: u32,
        tolerance_hz: f64,
    ) -> Vec<Option<CombinationTone>> {
        let name = |line: &SpectralLine| {
            CombinationTone::find(line.frequency_hz, fundamentals_hz, order, tolerance_hz)
        };
        self.lines.iter().map(name).collect()
    }
}

/// Least distance of two lines, and of one from zero, in cycles over the record.
const APART: f64 = 1.0;
/// Probability with which white noise would show a line.
const CHANCE: f64 = 1e-3;
/// Length of the transform in which lines are sought, in that of the record.
const PADDED: usize = 4;
/// Distances from a line, in cycles over the record, at which the strength of what is left
/// beside it is looked at.
const BESIDE: [f64; 2] = [1.0, 5.0];
/// Degrees of freedom of that strength, beyond which it is used and not that of all that is left.
const FEWEST: f64 = 4.0;

impl LineSearch {
    /// Finds the lines of samples taken at `sample_rate_hz`.
    ///
    /// Each line costs a transform and some steps over all samples with all lines: 12 lines
    /// of 3,200 samples take some tenths of a second.
    ///
    /// # Errors
    ///
    /// [`SpectrumError`] for fewer than two samples, a sample that is not finite, a sample
    /// rate that is not finite and positive, a smallest amplitude that is negative or NaN.
    pub fn find(&self, samples: &[f64], sample_rate_hz: f64) -> Result<Lines, SpectrumError> {
        check(samples, sample_rate_hz)?;
        if self.smallest.is_nan() || self.smallest < 0.0 {
            return Err(SpectrumError::Option {
                name: "smallest amplitude",
                value: self.smallest,
            });
        }
        let weights = self.window.weights(samples.len());
        let mut fit = WaveFit::new(samples, &weights);
        let mut left = Left::of(&fit, &weights);
        while fit.waves.len() < self.most {
            let Some(cycles) = left.strongest(&fit.waves, self.smallest) else {
                break;
            };
            let mut more = fit.clone();
            more.add(cycles);
            more.refine();
            if !are_apart(&more.waves, samples.len()) {
                break;
            }
            fit = more;
            left = Left::of(&fit, &weights);
        }
        Ok(self.lines(&fit, &left, samples.len(), sample_rate_hz))
    }

    fn lines(&self, fit: &WaveFit<'_>, left: &Left, count: usize, rate: f64) -> Lines {
        let unit = rate / count as f64;
        let squares: Vec<f64> = self.window.weights(count).iter().map(|w| w * w).collect();
        let alike = at_grid(&squares, PADDED * count);
        let unknown = || vec![[f64::NAN; 2]; fit.waves.len()];
        let variances = fit.variances().unwrap_or_else(unknown);
        let line = |(wave, [cycles, amplitude]): (&Wave, [f64; 2])| {
            let noise = left.beside(wave, &fit.waves, &alike);
            SpectralLine {
                frequency_hz: unit * wave.cycles,
                deviation_hz: unit * noise * cycles.sqrt(),
                amplitude: wave.amplitude(),
                amplitude_deviation: noise * amplitude.sqrt(),
                phase: phase_at_start(wave, count),
            }
        };
        let mut lines: Vec<SpectralLine> = fit.waves.iter().zip(variances).map(line).collect();
        lines.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude));
        Lines {
            mean: fit.mean,
            lines,
            residual: left.mean_square.sqrt(),
            resolution_hz: APART * unit,
        }
    }
}

/// Returns true if no two waves are too near to each other, nor one to the ends.
fn are_apart(waves: &[Wave], count: usize) -> bool {
    let most = 0.5 * count as f64 - APART;
    waves.iter().enumerate().all(|(index, wave)| {
        (APART..=most).contains(&wave.cycles)
            && waves[..index]
                .iter()
                .all(|other| (other.cycles - wave.cycles).abs() >= APART)
    })
}

/// Remainder of samples beside waves.
struct Left {
    /// Amplitudes at multiples of 1/PADDED cycles over the record.
    amplitudes: Vec<f64>,
    mean_square: f64,
    /// Amplitude, squared, of white noise of variance 1.
    noise: f64,
}

impl Left {
    fn of(fit: &WaveFit<'_>, weights: &[f64]) -> Self {
        let residual = fit.residual();
        let weighted: Vec<f64> = weights.iter().zip(&residual).map(|(w, r)| w * r).collect();
        let total: f64 = weights.iter().sum();
        let count = residual.len();
        let magnitudes = at_grid(&weighted, PADDED * count);
        let squares: f64 = weights.iter().map(|weight| weight * weight).sum();
        Self {
            amplitudes: magnitudes.iter().map(|x| 2.0 * x / total).collect(),
            mean_square: fit.mean_square(&residual),
            noise: 4.0 * squares / (total * total),
        }
    }

    /// Cycles of the strongest wave that is left apart from those found, refined by a
    /// parabola through logarithms; none that is more than noise.
    fn strongest(&self, waves: &[Wave], smallest: f64) -> Option<f64> {
        let is_apart = |cycles: f64| {
            cycles >= APART
                && waves
                    .iter()
                    .all(|wave| (wave.cycles - cycles).abs() >= APART)
        };
        let cycles = |bin: usize| bin as f64 / PADDED as f64;
        let inner = 1..self.amplitudes.len().saturating_sub(1);
        let bins = inner.filter(|&bin| is_apart(cycles(bin)));
        let best = bins.max_by(|&a, &b| self.amplitudes[a].total_cmp(&self.amplitudes[b]))?;
        let [before, at, after] = [best - 1, best, best + 1].map(|bin| self.amplitudes[bin]);
        let largest = waves.iter().map(Wave::amplitude).fold(0.0, f64::max);
        // As many chances as amplitudes: those between Fourier frequencies count nearly so.
        let by_chance = (self.amplitudes.len() as f64 / CHANCE).ln();
        let is_line = at * at > by_chance * self.noise * self.mean_square;
        if !is_line || at <= smallest * largest {
            return None;
        }
        let (left, right) = ((at / before).ln(), (at / after).ln());
        let shift = 0.5 * (left - right) / (left + right);
        let is_peak = left >= 0.0 && right >= 0.0 && shift.is_finite();
        Some(cycles(best) + if is_peak { shift / PADDED as f64 } else { 0.0 })
    }

    /// Standard deviation of white noise as strong as what is left beside a wave. It is known
    /// from few amplitudes, so that errors over it follow Student's distribution: it is larger
    /// by as much as that is wider than the normal one. `alike` is the correlation of
    /// amplitudes by their distance, but for a factor.
    fn beside(&self, wave: &Wave, waves: &[Wave], alike: &[f64]) -> f64 {
        let [near, far] = BESIDE;
        let cycles = |bin: usize| bin as f64 / PADDED as f64;
        let is_free = |bin: &usize| {
            let distance = (cycles(*bin) - wave.cycles).abs();
            let others = waves
                .iter()
                .map(|other| (other.cycles - cycles(*bin)).abs());
            distance <= far && others.fold(f64::INFINITY, f64::min) >= near
        };
        let bins: Vec<usize> = (0..self.amplitudes.len()).filter(is_free).collect();
        let squares = bins
            .iter()
            .map(|&bin| self.amplitudes[bin].powi(2) / self.noise);
        let mean = squares.sum::<f64>() / bins.len() as f64;
        let pairs = bins
            .iter()
            .flat_map(|a| bins.iter().map(|b| a.abs_diff(*b)));
        let together: f64 = pairs
            .map(|distance| (alike[distance] / alike[0]).powi(2))
            .sum();
        // Two squares of normal numbers an independent amplitude.
        let freedom = 2.0 * (bins.len() as f64).powi(2) / together;
        if freedom > FEWEST {
            (mean * freedom / (freedom - 2.0)).sqrt()
        } else {
            self.mean_square.sqrt()
        }
    }
}
