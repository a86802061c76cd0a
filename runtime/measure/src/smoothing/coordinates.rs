//! Several coordinates of one motion, each smoothed separately.

use super::error::SmoothingError;
use super::series::SmoothedMotion;

/// A motion of several coordinates that were measured together, each of them smoothed separately. A
/// state is the coordinates followed by their rates.
///
/// # Examples
///
/// Mean and half the difference of two links' angles, which are smoothed better than the
/// angles:
///
/// ```
/// use branched_pendulum_measure::{KinematicSmoother, SmoothedCoordinates};
///
/// let times: Vec<f64> = (0..200).map(|i| 0.01 * f64::from(i)).collect();
/// // Rounded to milliradians.
/// let angle = |t: f64, off: f64| (1e3 * ((5.0 * t).sin() + off * (8.0 * t).cos())).round() * 1e-3;
/// let of = |sign: f64| {
///     let half = times.iter().map(|&t| 0.5 * (angle(t, 0.01) + sign * angle(t, -0.01)));
///     half.map(Some).collect()
/// };
/// let motion = SmoothedCoordinates::new([of(1.0), of(-1.0)], |data| {
///     KinematicSmoother::default().smooth(&times, data)
/// })?;
/// let [_, difference, _, rate] = motion.mean(100)[..] else { unreachable!() };
/// assert!((difference - 0.01 * (8.0 * times[100]).cos()).abs() < 1e-3);
/// assert!((rate + 0.08 * (8.0 * times[100]).sin()).abs() < 1e-2);
/// # Ok::<(), branched_pendulum_measure::SmoothingError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct SmoothedCoordinates {
    coordinates: Vec<SmoothedMotion>,
}

impl SmoothedCoordinates {
    /// Smooths the data of each coordinate with `smooth`; `None` for missing data.
    ///
    /// # Errors
    ///
    /// Errors of `smooth`.
    pub fn new(
        data: impl IntoIterator<Item = Vec<Option<f64>>>,
        smooth: impl Fn(&[Option<f64>]) -> Result<SmoothedMotion, SmoothingError>,
    ) -> Result<Self, SmoothingError> {
        let coordinates = data.into_iter().map(|data| smooth(&data));
        Ok(Self {
            coordinates: coordinates.collect::<Result<_, _>>()?,
        })
    }

    /// Returns the coordinates, each with its first and second derivative.
    pub fn coordinates(&self) -> &[SmoothedMotion] {
        &self.coordinates
    }

    /// Returns the mean state at the time with this index; NaN beyond the last.
    pub fn mean(&self, index: usize) -> Vec<f64> {
        state(self.coordinates.iter().map(|own| own.mean(index)))
    }

    /// Returns the largest [`whiteness`](SmoothedMotion::whiteness) of any coordinate.
    pub fn whiteness(&self) -> f64 {
        let all = self.coordinates.iter().map(SmoothedMotion::whiteness);
        let larger = |a: f64, b: f64| if a.abs() > b.abs() { a } else { b };
        all.reduce(larger).unwrap_or(f64::NAN)
    }

    /// Draws a random motion like [`SmoothedMotion::draw`]: returns the state at each time.
    pub fn draw(&self, mut normal: impl FnMut() -> f64) -> Vec<Vec<f64>> {
        let drawn = self.coordinates.iter().map(|own| own.draw(&mut normal));
        let drawn: Vec<Vec<[f64; 3]>> = drawn.collect();
        let times = drawn.first().map_or(0, Vec::len);
        let at = |index: usize| state(drawn.iter().map(|own| own[index]));
        (0..times).map(at).collect()
    }
}

/// Returns the coordinates followed by their rates.
fn state(coordinates: impl Iterator<Item = [f64; 3]> + Clone) -> Vec<f64> {
    let rates = coordinates.clone().map(|[_, rate, _]| rate);
    coordinates.map(|[own, ..]| own).chain(rates).collect()
}
