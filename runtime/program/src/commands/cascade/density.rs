//! Histogram of the values of a power.

use serde::{Deserialize, Serialize};

/// Power (W) below which values fall into the middle bin.
const LEAST: f64 = 1e-9;

/// Number of bins per factor of e.
const BINS: f64 = 12.0;

/// Number of bins on either side of the middle: up to more than 100 W.
const SIDE: usize = 320;

/// Histogram of a power, with bins that widen with the power, and its moments. Histograms of
/// several starts can be added.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Density {
    counts: Vec<u32>,
    /// Sums of the power P, P², P³ and P⁴.
    sums: [f64; 4],
}

/// Shape of a density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moments {
    /// W̄ = ⟨W⟩.
    pub mean: f64,
    /// Standard deviation σ.
    pub deviation: f64,
    /// Skewness ⟨(W − W̄)³⟩/σ³: zero for a symmetric distribution.
    pub skewness: f64,
    /// Flatness ⟨(W − W̄)⁴⟩/σ⁴: three for a normal distribution, larger if bursts are rare and
    /// strong.
    pub flatness: f64,
}

impl Default for Density {
    fn default() -> Self {
        Self {
            counts: vec![0; 2 * SIDE + 1],
            sums: [0.0; 4],
        }
    }
}

impl Density {
    /// Counts a power.
    pub fn count(&mut self, power: f64) {
        let place = (BINS * (power / LEAST).asinh()).round() + SIDE as f64;
        let last = self.counts.len() - 1;
        if let Some(count) = self.counts.get_mut((place.max(0.0) as usize).min(last)) {
            *count += 1;
        }
        for (order, sum) in self.sums.iter_mut().enumerate() {
            *sum += power.powi(order as i32 + 1);
        }
    }

    /// Adds the histogram of another start.
    pub fn add(&mut self, other: &Self) {
        for (count, more) in self.counts.iter_mut().zip(&other.counts) {
            *count += more;
        }
        for (sum, more) in self.sums.iter_mut().zip(other.sums) {
            *sum += more;
        }
    }

    /// Number of samples.
    pub fn samples(&self) -> f64 {
        self.counts.iter().map(|count| f64::from(*count)).sum()
    }

    /// Returns mean, standard deviation, skewness and flatness of the distribution.
    pub fn moments(&self) -> Moments {
        let number = self.samples();
        let [mean, second, third, fourth] = self.sums.map(|sum| sum / number);
        let variance = second - mean * mean;
        let cube = third - 3.0 * mean * second + 2.0 * mean.powi(3);
        let square = mean * mean;
        let fourth = fourth - 4.0 * mean * third + 6.0 * square * second - 3.0 * square * square;
        Moments {
            mean,
            deviation: variance.sqrt(),
            skewness: cube / variance.powf(1.5),
            flatness: fourth / (variance * variance),
        }
    }

    /// Returns the density of (W − W̄)/σ at the middles of all bins that are not empty. Bins
    /// narrower than `width` are joined.
    pub fn standardised(&self, width: f64) -> Vec<(f64, f64)> {
        let Moments {
            mean, deviation, ..
        } = self.moments();
        let edge = |place: f64| LEAST * ((place - SIDE as f64) / BINS).sinh();
        let mut points = Vec::new();
        let (mut low, mut sum) = (edge(-0.5), 0.0);
        for (place, count) in self.counts.iter().enumerate() {
            sum += f64::from(*count);
            let high = edge(place as f64 + 0.5);
            if high - low < width * deviation {
                continue;
            }
            if sum > 0.0 {
                let middle = (0.5 * (low + high) - mean) / deviation;
                points.push((middle, sum * deviation / (self.samples() * (high - low))));
            }
            (low, sum) = (high, 0.0);
        }
        points
    }
}

#[cfg(test)]
mod tests {
    use super::{Density, Moments};

    #[test]
    fn moments_and_density_are_those_of_the_samples() {
        let mut halves = [Density::default(), Density::default()];
        // Exponentially distributed: mean and deviation 1, skewness 2, flatness 9.
        for i in 0..100_000 {
            let share = (f64::from(i) + 0.5) / 1e5;
            halves[i as usize % 2].count(-(share.ln()));
        }
        let [mut all, other] = halves;
        all.add(&other);
        let Moments {
            mean,
            deviation,
            skewness,
            flatness,
        } = all.moments();
        assert!((mean - 1.0).abs() < 1e-4 && (deviation - 1.0).abs() < 1e-3);
        assert!((skewness - 2.0).abs() < 0.02 && (flatness - 9.0).abs() < 0.1);
        for (place, density) in all.standardised(0.1) {
            if (-0.8..3.0).contains(&place) {
                assert!(
                    (density / (-(place + 1.0)).exp() - 1.0).abs() < 0.05,
                    "{place}"
                );
            }
        }
    }
}
