//! Quantities computed from an estimated motion, with their standard deviations.

/// Means and standard deviations of several quantities at each time. A row of quantities is an
/// array or a vector.
#[derive(Clone, Debug, PartialEq)]
pub struct Bands<R> {
    /// Means of the quantities, one row per time.
    pub means: Vec<R>,
    /// Standard deviations of the quantities, one row per time.
    pub deviations: Vec<R>,
}

/// Returns means and standard deviations over `draws` random motions, and the number of motions
/// that counted. `draw` returns the quantities of one motion, a row for each time: the motion of
/// one or several [`SmoothedMotion`](super::SmoothedMotion)s, or energies, transfers and integrals
/// over time that are computed from it.
///
/// Motions are left out if the number or the length of their rows differs from those of the first,
/// or if a number is not finite.
///
/// # Examples
///
/// ```
/// use branched_pendulum_measure::{KinematicSmoother, bands};
///
/// let times: Vec<f64> = (0..100).map(|i| 0.01 * f64::from(i)).collect();
/// let data: Vec<_> = times.iter().map(|t| Some((5.0 * t).sin())).collect();
/// let smoother = KinematicSmoother { noise: Some(1e-3), jerk: None };
/// let series = smoother.smooth(&times, &data)?;
///
/// let mut state = 1_u32;
/// let mut normal = || {
///     let sum: f64 = (0..12)
///         .map(|_| {
///             state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
///             f64::from(state) / f64::from(u32::MAX)
///         })
///         .sum();
///     sum - 6.0
/// };
/// // Kinetic energy of a body of 2 kg m².
/// let (energy, count) = bands(100, || {
///     series.draw(&mut normal).iter().map(|[_, rate, _]| [rate * rate]).collect()
/// });
/// assert_eq!(count, 100);
/// let exact = (5.0 * (5.0 * times[50]).cos()).powi(2);
/// assert!((energy.means[50][0] - exact).abs() < 4.0 * energy.deviations[50][0]);
/// # Ok::<(), branched_pendulum_measure::SmoothingError>(())
/// ```
pub fn bands<R: AsRef<[f64]> + AsMut<[f64]> + Clone>(
    draws: usize,
    mut draw: impl FnMut() -> Vec<R>,
) -> (Bands<R>, usize) {
    let mut means: Vec<R> = Vec::new();
    let mut squares: Vec<R> = Vec::new();
    let mut count = 0_u32;
    for _ in 0..draws {
        let rows = draw();
        if means.is_empty() {
            means = rows.clone();
            means.iter_mut().for_each(|row| row.as_mut().fill(0.0));
            squares = means.clone();
        }
        let [own, first] = [&rows, &means].map(|rows| rows.iter().map(|row| row.as_ref().len()));
        let mut values = rows.iter().flat_map(|row| row.as_ref());
        if !own.eq(first) || !values.all(|value| value.is_finite()) {
            continue;
        }
        count += 1;
        // Welford's update of the mean and the sum of squares.
        let weight = 1.0 / f64::from(count);
        for ((mean, square), row) in means.iter_mut().zip(&mut squares).zip(&rows) {
            let both = mean.as_mut().iter_mut().zip(square.as_mut());
            for ((mean, square), value) in both.zip(row.as_ref()) {
                let change = value - *mean;
                *mean += weight * change;
                *square += change * (value - *mean);
            }
        }
    }
    let last = f64::from(count.max(2) - 1);
    for square in squares.iter_mut().flat_map(|row| row.as_mut()) {
        *square = (*square / last).sqrt();
    }
    let bands = Bands {
        means,
        deviations: squares,
    };
    (bands, count as usize)
}
