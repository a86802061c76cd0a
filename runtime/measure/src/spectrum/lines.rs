//! Spectral lines of a quasi-periodic series, found in a short record.

use core::f64::consts::TAU;

use super::combination::CombinationTone;
use super::error::{SpectrumError, check};
use super::fit::{Wave, WaveFit, phase_at_start};
use super::transform::at_grid;
use super::trend::powers;
use super::window::Window;

/// A search for the lines of a series, the strongest first.
///
/// As in J. Laskar's frequency analysis (Icarus 88 (1990); Physica D 67 (1993)), the frequency at
/// which the windowed residual is strongest is added to the lines. Then the frequencies, amplitudes
/// and phases of all lines, and a polynomial, are fitted together by weighted least squares; this
/// replaces the successive orthogonal projections, so that a line causes no error in its
/// neighbours. For samples that are a sum of a few waves, the frequencies are accurate to rounding;
/// with white noise, up to the Cramér–Rao bound, except for the information that the window
/// discards.
///
/// The search ends with [`most`](Self::most) lines, or when the strongest of what is left is
/// below [`smallest`](Self::smallest), or one that white noise of its size would show. A drift of
/// the record would hide all lines in this way: it is part of the fit ([`trend`](Self::trend)).
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
    /// Weights of the samples. With a higher power of the window, lines that are not found disturb
    /// the others less, and noise disturbs them more.
    pub window: Window,
    /// Largest number of lines.
    pub most: usize,
    /// Amplitude below which no line is searched for, relative to the strongest line.
    pub smallest: f64,
    /// Largest degree of the polynomial that describes a drift of the record; 0 for a mean value
    /// only. The degree is 1 at first, and is raised while a component slower than one cycle over
    /// the record remains.
    pub trend: usize,
}

impl Default for LineSearch {
    fn default() -> Self {
        Self {
            window: Window::Hann,
            most: 12,
            smallest: 1e-9,
            trend: 3,
        }
    }
}

/// One spectral line: amplitude · cos(2π frequency t + phase), with the time t from the first
/// sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectralLine {
    /// Frequency in hertz.
    pub frequency_hz: f64,
    /// Standard deviation of the frequency in Hz, if the remainder near the line were noise.
    pub deviation_hz: f64,
    /// Amplitude of the line, in the units of the series.
    pub amplitude: f64,
    /// Standard deviation of the amplitude.
    pub amplitude_deviation: f64,
    /// Phase at the first sample, in rad, from −π to π.
    pub phase: f64,
}

/// Spectral lines of a series, and the remainder of the series without them.
#[derive(Clone, Debug, PartialEq)]
pub struct Lines {
    /// Mean.
    pub mean: f64,
    /// Drift of the record: coefficients c_k of the polynomial Σ c_k s^k, in units of the series
    /// per s^k, where s is the time from the middle of the record in seconds.
    pub trend: Vec<f64>,
    /// The lines, the strongest first.
    pub lines: Vec<SpectralLine>,
    /// Root mean square of the remainder, weighted by the window.
    pub residual: f64,
    /// Frequency difference in Hz below which two lines cannot be separated: one cycle over the
    /// record.
    pub resolution_hz: f64,
    /// Amplitude of the strongest remaining component that is slower than one cycle over the
    /// record; 0 if it is not above the noise. If it is not 0, it may hide lines: raise
    /// [`trend`](LineSearch::trend), or subtract the drift beforehand.
    pub slow: f64,
    /// Time from the first sample to the middle of the record, in s.
    middle: f64,
}

impl Lines {
    /// Returns the sum of drift and lines at a time (s) measured from the first sample.
    pub fn value(&self, time: f64) -> f64 {
        let waves = self.lines.iter();
        let wave = |line: &SpectralLine| {
            line.amplitude * (TAU * line.frequency_hz * time + line.phase).cos()
        };
        let from_middle = time - self.middle;
        let trend = self.trend.iter().rev();
        trend.fold(0.0, |sum, c| sum * from_middle + c) + waves.map(wave).sum::<f64>()
    }

    /// Returns the name of each line as a [`CombinationTone`] of fundamental frequencies; `None` if
    /// no combination up to `order` is within `tolerance_hz` (Hz).
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

/// Smallest distance between two lines, and of a line from zero frequency, in cycles over the
/// record.
const APART: f64 = 1.0;
/// Probability that white noise would show a line.
const CHANCE: f64 = 1e-3;
/// Largest degree of a drift; polynomials of higher degree follow waves.
const MOST_DEGREES: usize = 20;
/// Residual that rounding leaves after a fit, relative to the largest sample.
const ROUNDING: f64 = 1e-12;
/// Length of the Fourier transform in which lines are searched for, relative to that of the record.
const PADDED: usize = 4;
/// Range of distances from a line, in cycles over the record, in which the strength of the
/// remainder near the line is measured.
const NEIGHBOURHOOD: [f64; 2] = [1.0, 5.0];
/// Number of degrees of freedom from which on this local strength is used instead of the strength
/// of the whole remainder.
const FEWEST: f64 = 4.0;

impl LineSearch {
    /// Finds the lines of samples taken at `sample_rate_hz`.
    ///
    /// Each line costs a Fourier transform and some fitting steps over all samples with all lines:
    /// 12 lines in 3,200 samples take a few tenths of a second.
    ///
    /// # Errors
    ///
    /// [`SpectrumError`] for fewer than two samples, a sample that is not finite, a sample
    /// rate that is not finite and positive, a smallest amplitude that is negative or NaN, a degree of
    /// the trend above 20.
    pub fn find(&self, samples: &[f64], sample_rate_hz: f64) -> Result<Lines, SpectrumError> {
        check(samples, sample_rate_hz)?;
        if self.smallest.is_nan() || self.smallest < 0.0 {
            return Err(SpectrumError::Option {
                name: "smallest amplitude",
                value: self.smallest,
            });
        }
        if self.trend > MOST_DEGREES {
            return Err(SpectrumError::Option {
                name: "largest degree of the trend",
                value: self.trend as f64,
            });
        }
        let weights = self.window.weights(samples.len());
        let mut degree = self.trend.min(1);
        loop {
            let (fit, left) = self.search(samples, &weights, degree);
            if degree >= self.trend || left.slow() == 0.0 {
                return Ok(self.lines(&fit, &left, samples.len(), sample_rate_hz));
            }
            degree += 1;
        }
    }

    /// Finds the lines, and fits them together with a polynomial of this degree.
    fn search<'a>(
        &self,
        samples: &'a [f64],
        weights: &'a [f64],
        degree: usize,
    ) -> (WaveFit<'a>, Left) {
        let mut fit = WaveFit::new(samples, weights, degree);
        let mut left = Left::of(&fit, weights);
        while fit.waves.len() < self.most {
            let Some(cycles) = left.strongest(&fit.waves, self.smallest) else {
                break;
            };
            let mut more = fit.clone();
            more.add(cycles);
            more.refine();
            if !are_apart(&more.waves, samples.len()) {
                // A wave that becomes slower than a cycle over the record is no line but a drift.
                if more.waves.iter().any(|wave| wave.cycles < APART) {
                    left.drift = left.near(cycles);
                }
                break;
            }
            fit = more;
            left = Left::of(&fit, weights);
        }
        (fit, left)
    }

    fn lines(&self, fit: &WaveFit<'_>, left: &Left, count: usize, rate: f64) -> Lines {
        let unit = rate / count as f64;
        let squares: Vec<f64> = self.window.weights(count).iter().map(|w| w * w).collect();
        let correlation = at_grid(&squares, PADDED * count);
        let unknown = || vec![[f64::NAN; 2]; fit.waves.len()];
        let variances = fit.variances().unwrap_or_else(unknown);
        let line = |(wave, [cycles, amplitude]): (&Wave, [f64; 2])| {
            let noise = left.noise_near(wave, &fit.waves, &correlation);
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
            mean: fit.trend.first().copied().unwrap_or_default(),
            trend: powers(&fit.trend, 0.5 / unit),
            lines,
            residual: left.mean_square.sqrt(),
            resolution_hz: APART * unit,
            slow: left.slow(),
            middle: 0.5 * (count as f64 - 1.0) / rate,
        }
    }
}

/// Returns true if no two waves are too close to each other, and none is too close to zero or the
/// highest frequency.
fn are_apart(waves: &[Wave], count: usize) -> bool {
    let most = 0.5 * count as f64 - APART;
    waves.iter().enumerate().all(|(index, wave)| {
        (APART..=most).contains(&wave.cycles)
            && waves[..index]
                .iter()
                .all(|other| (other.cycles - wave.cycles).abs() >= APART)
    })
}

/// Remainder of samples without waves.
struct Left {
    /// Amplitudes of the remainder at multiples of 1/`PADDED` cycles over the record.
    amplitudes: Vec<f64>,
    mean_square: f64,
    /// Squared amplitude that white noise of variance 1 would have.
    noise: f64,
    /// Largest sample, by its size.
    size: f64,
    /// Amplitude of a wave whose fitted frequency became lower than that of a line can be.
    drift: f64,
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
            size: fit.largest(),
            drift: 0.0,
        }
    }

    /// Returns the amplitude at the frequency nearest to a number of cycles over the record.
    fn near(&self, cycles: f64) -> f64 {
        let bin = (cycles * PADDED as f64).round() as usize;
        self.amplitudes.get(bin).copied().unwrap_or_default()
    }

    /// Returns the amplitude that white noise as strong as the remainder exceeds anywhere with a
    /// small probability.
    fn by_chance(&self) -> f64 {
        // As many chances as amplitudes: those between Fourier frequencies count nearly so.
        let chances = (self.amplitudes.len() as f64 / CHANCE).ln();
        (chances * self.noise * self.mean_square).sqrt()
    }

    /// Returns the largest amplitude at frequencies lower than those of lines; 0 if noise or
    /// rounding could cause it.
    fn slow(&self) -> f64 {
        let bins = (APART * PADDED as f64) as usize;
        let slow = self.amplitudes.iter().take(bins).copied();
        let slow = slow.fold(self.drift, f64::max);
        match slow > self.by_chance().max(ROUNDING * self.size) {
            true => slow,
            false => 0.0,
        }
    }

    /// Returns the frequency (in cycles) of the strongest remaining wave that is apart from the
    /// lines found, refined by a parabola through logarithms; `None` if no wave is above the noise.
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
        if at <= self.by_chance() || at <= smallest * largest {
            return None;
        }
        let (left, right) = ((at / before).ln(), (at / after).ln());
        let shift = 0.5 * (left - right) / (left + right);
        let is_peak = left >= 0.0 && right >= 0.0 && shift.is_finite();
        Some(cycles(best) + if is_peak { shift / PADDED as f64 } else { 0.0 })
    }

    /// Returns the standard deviation of white noise as strong as the remainder near a wave. It is
    /// estimated from few amplitudes, so that errors relative to it follow Student's distribution;
    /// it is enlarged accordingly. `correlation` is the correlation of amplitudes as a function of their
    /// distance, up to a factor.
    fn noise_near(&self, wave: &Wave, waves: &[Wave], correlation: &[f64]) -> f64 {
        let [near, far] = NEIGHBOURHOOD;
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
            .map(|distance| (correlation[distance] / correlation[0]).powi(2))
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
