//! Recording of the sizes of differences along one motion.

use std::f64::consts::TAU;

use super::rotation::TurnCount;
use super::{Growth, GrowthError};

/// Largest sizes and amplitudes of differences over the samples of a motion, stored as logarithms
/// so that large growth does not overflow.
#[derive(Clone, Debug)]
pub(super) struct GrowthRecord {
    frequency: f64,
    start: f64,
    horizons: Vec<f64>,
    /// Logarithm of the product of all factors by which differences have been divided.
    scale: f64,
    last: DifferenceSample,
    /// Logarithm of the amplitude at the start, relative to which growth is measured.
    first: f64,
    largest: f64,
    factors: Vec<f64>,
    /// Logarithms of the largest amplitudes in the two halves of the last time span.
    halves: [f64; 2],
    turns: TurnCount,
}

/// One sample of a difference δ: |δ|² with its rate of change, and the squared amplitude.
#[derive(Clone, Copy, Debug)]
struct DifferenceSample {
    time: f64,
    square: f64,
    rate: f64,
    amplitude: f64,
}

impl DifferenceSample {
    fn new(time: f64, angles: &[f64], rates: &[f64], frequency: f64) -> Self {
        let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
        let square = dot(angles, angles);
        Self {
            time,
            square,
            rate: 2.0 * dot(angles, rates),
            amplitude: square + dot(rates, rates) / (frequency * frequency),
        }
    }

    /// Returns the largest |δ|² between the sample `before` and this one, from the cubic polynomial
    /// through the values and rates of both.
    fn largest_since(&self, before: &Self) -> f64 {
        let step = self.time - before.time;
        let (from, to) = (step * before.rate, step * self.rate);
        let rise = self.square - before.square;
        let (b, c, d) = (from, 3.0 * rise - 2.0 * from - to, from + to - 2.0 * rise);
        let at = |x: f64| before.square + x * (b + x * (c + x * d));
        // Zeros of the derivative b + 2 c x + 3 d x².
        let q = -(c + c.signum() * (c * c - 3.0 * b * d).sqrt());
        let inside = [q / (3.0 * d), b / q].into_iter();
        let inside = inside.filter(|x| (0.0..=1.0).contains(x)).map(at);
        inside.fold(self.square.max(before.square), f64::max)
    }
}

impl GrowthRecord {
    pub(super) fn new(
        growth: &Growth,
        start: f64,
        angles: &[f64],
        rates: &[f64],
    ) -> Result<Self, GrowthError> {
        let frequency = TAU * growth.frequency_hz;
        let last = DifferenceSample::new(start, angles, rates, frequency);
        let point = angles.first().zip(rates.first());
        let (Some((&angle, &rate)), Some(&span)) = (point, growth.horizons.last()) else {
            return Err(GrowthError::Difference);
        };
        let first = 0.5 * last.amplitude.ln();
        if !first.is_finite() {
            return Err(GrowthError::Difference);
        }
        Ok(Self {
            frequency,
            start,
            horizons: growth.horizons.clone(),
            scale: 0.0,
            last,
            first,
            largest: 0.5 * last.square.ln(),
            factors: Vec::new(),
            halves: [first, f64::NEG_INFINITY],
            turns: TurnCount::new(start, span, (angle, rate / frequency)),
        })
    }

    pub(super) fn add_sample(&mut self, time: f64, angles: &[f64], rates: &[f64]) {
        let look = DifferenceSample::new(time, angles, rates, self.frequency);
        let largest = 0.5 * look.largest_since(&self.last).ln() + self.scale;
        self.largest = self.largest.max(largest);
        let half = &mut self.halves[usize::from(time - self.start > 0.5 * self.span())];
        *half = half.max(0.5 * look.amplitude.ln() + self.scale);
        self.turns
            .add_sample(time, (angles[0], rates[0] / self.frequency));
        self.last = look;
        let next = self.horizons.get(self.factors.len());
        if next.is_some_and(|horizon| time >= self.start + horizon) {
            self.factors.push(self.largest - self.first);
        }
    }

    /// Returns the amplitude by which the caller must divide the differences, and divides the
    /// record's last sample by it.
    pub(super) fn scale(&mut self) -> f64 {
        let factor = self.last.amplitude.sqrt();
        let DifferenceSample {
            square,
            rate,
            amplitude,
            ..
        } = &mut self.last;
        for value in [square, rate, amplitude] {
            *value /= factor * factor;
        }
        self.scale += factor.ln();
        factor
    }

    pub(super) fn span(&self) -> f64 {
        self.horizons.last().copied().unwrap_or(f64::NAN)
    }

    /// Returns the logarithms of the growth factors, one for each horizon reached.
    pub(super) fn factors(&self) -> &[f64] {
        &self.factors
    }

    pub(super) fn rate(&self) -> f64 {
        (self.halves[1] - self.halves[0]) / (0.5 * self.span())
    }

    pub(super) fn turns(&self) -> f64 {
        self.turns.a_second()
    }
}

#[cfg(test)]
mod tests {
    use super::GrowthRecord;
    use crate::analysis::growth::Growth;
    use std::f64::consts::{E, TAU};

    /// Checks the record for the difference e^(0.3 t) cos(2 π t), which is rescaled during the
    /// motion.
    #[test]
    fn a_growing_oscillation() {
        let growth = Growth {
            frequency_hz: 1.0,
            horizons: vec![4.0, 10.0],
            tolerance: 1e-9,
        };
        let times = growth.looks(2.0);
        assert!(times.contains(&6.0) && times.ends_with(&[12.0]));
        let state = |time: f64| {
            let t = time - 2.0;
            let size = (0.3 * t).exp();
            let (sine, cosine) = (TAU * t).sin_cos();
            (size * cosine, size * (0.3 * cosine - TAU * sine))
        };
        let mut record = GrowthRecord::new(&growth, 2.0, &[1.0], &[0.0]).unwrap();
        let mut scale = 1.0;
        for (number, &time) in times.iter().enumerate().skip(1) {
            let (angle, rate) = state(time);
            record.add_sample(time, &[angle / scale], &[rate / scale]);
            if number % 50 == 0 {
                scale *= record.scale();
            }
        }
        let [short, long] = record.factors() else {
            panic!()
        };
        assert!((short - 1.2).abs() < 1e-3 && (long - 3.0).abs() < 1e-3);
        assert!((record.rate() - 0.3).abs() < 0.01, "{}", record.rate());
        assert!((record.turns() - 1.0).abs() < 1e-6, "{}", record.turns());
        assert!(long.exp() < E.powi(3) * 1.01);
    }

    /// Checks that the largest value is found if its peak lies between two samples, for one and for
    /// two differences, with and without rescaling.
    #[test]
    fn peaks_between_looks() {
        let growth = Growth {
            frequency_hz: 1.0,
            horizons: vec![3.0],
            tolerance: 1e-9,
        };
        for eighths in 0..8 {
            // The phase between two samples is 2π/32.
            let phase = f64::from(eighths) * TAU / 256.0;
            let state = |time: f64, width: f64| {
                let (sine, cosine) = (TAU * time + phase).sin_cos();
                ([sine, width * cosine], [TAU * cosine, -TAU * width * sine])
            };
            for (width, scaled) in [(0.0, false), (0.0, true), (0.6, false), (0.6, true)] {
                let (angles, rates) = state(0.0, width);
                let mut record = GrowthRecord::new(&growth, 0.0, &angles, &rates).unwrap();
                let mut scale = 1.0;
                for time in growth.looks(0.0).into_iter().skip(1) {
                    let (angles, rates) = state(time, width);
                    let [angles, rates] = [angles, rates].map(|all| all.map(|x| x / scale));
                    record.add_sample(time, &angles, &rates);
                    if scaled {
                        scale *= record.scale();
                    }
                }
                // The amplitude at the start is that of both differences; the largest size is 1.
                let factor = record.factors()[0] + 0.5 * width.mul_add(width, 1.0).ln();
                assert!(factor.abs() < 5e-5, "{eighths} {width} {factor}");
                assert!(record.rate().abs() < 1e-6);
            }
        }
    }
}
