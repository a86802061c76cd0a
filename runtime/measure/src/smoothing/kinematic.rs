//! Smoothing of a motion whose jerk is white noise, by a Kalman filter and a Rauch–Tung–Striebel
//! smoother.

use nalgebra::{Matrix3, U3, Vector3};

use super::error::{SmoothingError, check_data, check_option, usual_interval};
use super::gaussian::{Gaussian, Innovations, Step, gains};
use super::likelihood::largest;
use super::series::{Scale, SmoothedMotion};

/// A smoother that assumes only that a motion is smooth: its third derivative is white noise of
/// spectral density q, and the data have white noise of standard deviation σ.
///
/// H. E. Rauch, F. Tung, C. T. Striebel, *Maximum likelihood estimates of linear dynamic
/// systems*, AIAA Journal 3 (1965). Times may be uneven, data may be missing.
///
/// # Examples
///
/// The velocity of an oscillation, 240 noisy pictures a second:
///
/// ```
/// use branched_pendulum_measure::KinematicSmoother;
///
/// // Noise of 1 mrad, from a generator of your choice.
/// let mut state = 1_u32;
/// let mut noise = || {
///     let sum: f64 = (0..12)
///         .map(|_| {
///             state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
///             f64::from(state) / f64::from(u32::MAX) - 0.5
///         })
///         .sum();
///     1e-3 * sum
/// };
/// let times: Vec<f64> = (0..480).map(|i| f64::from(i) / 240.0).collect();
/// let data: Vec<Option<f64>> = times.iter().map(|t| Some((6.0 * t).sin() + noise())).collect();
///
/// let smoothed = KinematicSmoother::default().smooth(&times, &data)?;
/// assert!((smoothed.noise() - 1e-3).abs() < 2e-4);
/// let [_, velocity, _] = smoothed.mean(240);
/// let [_, deviation, _] = smoothed.deviation(240);
/// assert!((velocity - 6.0 * (6.0 * times[240]).cos()).abs() < 3.0 * deviation);
/// assert!(deviation < 0.02);
/// # Ok::<(), branched_pendulum_measure::SmoothingError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct KinematicSmoother {
    /// Standard deviation σ of the data, in their unit; `None` for the most likely value.
    pub noise: Option<f64>,
    /// Spectral density q of the jerk, in the squared unit of the data over s⁵; `None` for the most
    /// likely value.
    pub jerk: Option<f64>,
}

impl KinematicSmoother {
    /// Estimates the motion at all times, also where data are missing. The effort is linear in the
    /// number of times, for each of about 50 values of q that are tried.
    ///
    /// # Errors
    ///
    /// [`SmoothingError`].
    pub fn smooth(
        &self,
        times: &[f64],
        data: &[Option<f64>],
    ) -> Result<SmoothedMotion, SmoothingError> {
        check_data(times, data)?;
        check_option("noise", self.noise)?;
        check_option("jerk", self.jerk)?;
        let unit = usual_interval(times);
        let problem = JerkFilter { times, data, unit };
        let scale = unit.powi(5);
        let likelihood = |noise: &dyn Fn(f64) -> Option<f64>| {
            let of = |log: f64| {
                problem
                    .filter(log.exp(), |_| ())
                    .log_likelihood(noise(log.exp()))
            };
            largest(of, LOG_RATIOS).exp()
        };
        let noise_of = |jerk: f64, ratio: f64| (jerk * scale / ratio).sqrt();
        let ratio = match (self.noise, self.jerk) {
            (Some(noise), Some(jerk)) => jerk * scale / (noise * noise),
            (noise, None) => likelihood(&|_| noise),
            (None, Some(jerk)) => likelihood(&|ratio| Some(noise_of(jerk, ratio))),
        };
        let mut steps = Vec::with_capacity(times.len());
        let innovations = problem.filter(ratio, |step| steps.push(step));
        let noise = match (self.noise, self.jerk) {
            (Some(noise), _) => noise,
            (None, Some(jerk)) => noise_of(jerk, ratio),
            (None, None) => innovations.noise(),
        };
        let scale = Scale {
            noise,
            densities: vec![ratio * noise * noise / scale],
            factors: Vector3::new(1.0, 1.0 / unit, 1.0 / (unit * unit)),
        };
        Ok(SmoothedMotion::new(
            times,
            &steps,
            &gains(&steps),
            innovations,
            scale,
            Into::into,
        ))
    }
}

/// Range of ln(q τ⁵/σ²) in which the most likely value is searched, with the usual interval τ.
const LOG_RATIOS: [f64; 2] = [-60.0, 20.0];
/// Variance of the state before the first datum, in units of σ²: so large that it has no weight
/// compared with the data.
pub(super) const DIFFUSE: f64 = 1e10;

/// The data, with times in units of the usual interval.
struct JerkFilter<'a> {
    times: &'a [f64],
    data: &'a [Option<f64>],
    /// The usual interval, s.
    unit: f64,
}

impl JerkFilter<'_> {
    /// Runs the filter with the ratio r = q τ⁵/σ², and passes each step to `keep`.
    fn filter(&self, ratio: f64, mut keep: impl FnMut(Step<U3>)) -> Innovations {
        let first = self.data.iter().flatten().next().copied().unwrap_or(0.0);
        let mut state = Gaussian {
            mean: Vector3::new(first, 0.0, 0.0),
            variance: Matrix3::from_diagonal_element(DIFFUSE),
        };
        let mut innovations = Innovations::new(3);
        let mut before = self.times.first().copied().unwrap_or(0.0);
        for (&time, datum) in self.times.iter().zip(self.data) {
            let (transition, noise) = step((time - before) / self.unit, ratio);
            let predicted = state.step(transition * state.mean, &transition, &noise);
            state = predicted.clone();
            if let Some(datum) = *datum {
                innovations.push(&state.update(0, datum));
            }
            keep(Step {
                transition,
                noise,
                predicted,
                updated: state.clone(),
            });
            before = time;
        }
        innovations
    }
}

/// Returns the transition matrix over h usual intervals, and the covariance that the jerk adds, in
/// units of σ² (physics §16).
fn step(h: f64, ratio: f64) -> (Matrix3<f64>, Matrix3<f64>) {
    let transition = Matrix3::new(1.0, h, 0.5 * h * h, 0.0, 1.0, h, 0.0, 0.0, 1.0);
    let factorial = [1.0, 1.0, 2.0];
    let noise = Matrix3::from_fn(|i, j| {
        let power = 5 - i - j;
        h.powi(power as i32) / (power as f64 * factorial[2 - i] * factorial[2 - j])
    });
    (transition, noise * ratio)
}
