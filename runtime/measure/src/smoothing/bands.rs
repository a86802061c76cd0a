//! Quantities of an estimated motion, with their errors.

/// Means and standard deviations of `N` quantities at every time.
#[derive(Clone, Debug, PartialEq)]
pub struct Bands<const N: usize> {
    /// Means.
    pub means: Vec<[f64; N]>,
    /// Standard deviations.
    pub deviations: Vec<[f64; N]>,
}

/// Returns means and deviations over `draws` draws of a motion, each made by `draw` as one
/// row of quantities a time: of a [`SmoothedMotion`](super::SmoothedMotion), or of several,
/// the energies that follow from them, their transfers, integrals over time.
///
/// Draws whose number of rows is not that of the first are left out, and so is one with a
/// number that is not finite: the number of those that count stands beside the bands.
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
pub fn bands<const N: usize>(
    draws: usize,
    mut draw: impl FnMut() -> Vec<[f64; N]>,
) -> (Bands<N>, usize) {
    let mut means: Vec<[f64; N]> = Vec::new();
    let mut squares: Vec<[f64; N]> = Vec::new();
    let mut count = 0_u32;
    for _ in 0..draws {
        let rows = draw();
        if means.is_empty() {
            means = vec![[0.0; N]; rows.len()];
            squares = means.clone();
        }
        if rows.len() != means.len() || !rows.iter().flatten().all(|value| value.is_finite()) {
            continue;
        }
        count += 1;
        // Welford's update.
        let weight = 1.0 / f64::from(count);
        for ((mean, square), row) in means.iter_mut().zip(&mut squares).zip(&rows) {
            for ((mean, square), value) in mean.iter_mut().zip(square).zip(row) {
                let change = value - *mean;
                *mean += weight * change;
                *square += change * (value - *mean);
            }
        }
    }
    let last = f64::from(count.max(2) - 1);
    for square in squares.iter_mut().flatten() {
        *square = (*square / last).sqrt();
    }
    let bands = Bands {
        means,
        deviations: squares,
    };
    (bands, count as usize)
}
