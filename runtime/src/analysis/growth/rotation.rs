//! Counting of the turns of a point about the origin.

use std::f64::consts::{PI, TAU};

/// Weighted mean of the turning rate of a point about the origin, clockwise, over a span of time.
///
/// The weights are exp(−1/(u(1 − u))), where u from 0 to 1 is the elapsed fraction of the span. For
/// motions of several frequencies such means converge faster than any power of the span, whereas a
/// plain count is accurate to one turn only. Source: S. Das, Y. Saiki, E. Sander, J. A. Yorke,
/// *Quantitative quasiperiodicity*, Nonlinearity 30 (2017) 4111–4140.
#[derive(Clone, Copy, Debug)]
pub(super) struct TurnCount {
    start: f64,
    span: f64,
    time: f64,
    angle: f64,
    sum: f64,
    weights: f64,
}

impl TurnCount {
    pub(super) fn new(start: f64, span: f64, point: (f64, f64)) -> Self {
        Self {
            start,
            span,
            time: start,
            angle: angle(point),
            sum: 0.0,
            weights: 0.0,
        }
    }

    /// Adds the next point, at `time` (s), which must be less than half a turn from the last one.
    pub(super) fn add_sample(&mut self, time: f64, point: (f64, f64)) {
        let angle = angle(point);
        let turned = (angle - self.angle + PI).rem_euclid(TAU) - PI;
        let part = (0.5 * (time + self.time) - self.start) / self.span;
        let weight = (-1.0 / (part * (1.0 - part))).exp();
        self.sum += weight * turned / TAU;
        self.weights += weight * (time - self.time);
        (self.time, self.angle) = (time, angle);
    }

    pub(super) fn a_second(&self) -> f64 {
        self.sum / self.weights
    }
}

fn angle((displacement, velocity): (f64, f64)) -> f64 {
    (-velocity).atan2(displacement)
}

/// Returns the turns per second of a displacement and its velocity, as a point in the plane, about
/// the origin: the frequency (Hz) of the largest oscillation, if it is larger than all others
/// together. The unit of the velocity does not matter over a long time; dividing it by the angular
/// frequency converges fastest. `times` (s) ascend, with less than half a turn between two.
///
/// ```
/// use branched_pendulum::analysis::growth::turns_a_second;
///
/// let times: Vec<f64> = (0..600).map(|i| 0.05 * f64::from(i)).collect();
/// let line = |f: f64, t: f64| (std::f64::consts::TAU * f * t).sin_cos();
/// let points = times.iter().map(|&t| {
///     let (large, small) = (line(1.2345, t), line(2.9, t));
///     (large.0 + 0.2 * small.0, large.1 + 0.2 * small.1)
/// });
/// assert!((turns_a_second(&times, points) - 1.2345).abs() < 1e-7);
/// ```
pub fn turns_a_second(times: &[f64], points: impl IntoIterator<Item = (f64, f64)>) -> f64 {
    let mut both = times.iter().zip(points);
    let (Some((&start, point)), Some(&end)) = (both.next(), times.last()) else {
        return f64::NAN;
    };
    let mut turns = TurnCount::new(start, end - start, point);
    both.for_each(|(&time, point)| turns.add_sample(time, point));
    turns.a_second()
}
