//! Quantities of an estimated motion, with their errors.

/// Means and standard deviations of a row of quantities at every time: an array, or a vector.
#[derive(Clone, Debug, PartialEq)]
pub struct Bands<R> {
    /// Means.
    pub means: Vec<R>,
    /// Standard deviations.
    pub deviations: Vec<R>,
}

/// Returns means and deviations over `draws` draws of a motion, each made by `draw` as one
/// row of quantities a time: of a [`SmoothedMotion`](super::SmoothedMotion), or of several,
/// the energies that follow from them, their transfers, integrals over time.
///
/// Draws whose rows are not as many and as long as those of the first are left out, and so is one
/// with a number that is not finite: the number of those that count stands beside the bands.
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
        // Welford's update.
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
