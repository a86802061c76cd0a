//! Detection of rows at which a motion leaps, from its smoothness only.

use super::timing::{median, quantile};

/// Number of samples in a window, and number of powers in the polynomial that is fitted to them.
const WINDOW: usize = 10;
const POWERS: usize = 7;
/// Longest time between two samples of a window, in usual intervals: windows with missing or marked
/// rows are not used.
const LONGEST: f64 = 1.5;
/// Number of samples at the ends of a window where the fit can follow a leap.
const BLIND: usize = 3;
/// Number of windows on each side from which the usual residual is computed.
const NEAR: usize = 3 * WINDOW;
/// Ratios of a window's squared residual to the usual ones of the record and of its surroundings,
/// above which the motion leaps within the window.
const OF_RECORD: f64 = 50.0;
const OF_SURROUNDINGS: f64 = 40.0;
/// Largest fraction of all windows that may have leaps; if there are more, the motion is too fast
/// for the sampling rate.
const PART: f64 = 0.2;
/// Smallest standard deviation of angles that is assumed, in rad; smaller residuals are rounding of
/// a simulation.
const NOISE: f64 = 1e-4;
/// Variance of the error of rounding to whole numbers.
const ROUNDING: f64 = 1.0 / 12.0;

/// Returns the ranges of rows, first and last, within which a link leaps: angles before and after
/// are smooth, but no polynomial fits both. Linear in the number of rows.
pub(crate) fn leaps(
    times: &[f64],
    interval: f64,
    angle: impl Fn(usize) -> Option<f64>,
    resolution: f64,
) -> Vec<[usize; 2]> {
    let rows = (0..times.len()).filter_map(|row| Some((row, [times[row], angle(row)?])));
    let (rows, points): (Vec<usize>, Vec<[f64; 2]>) = rows.unzip();
    let squares: Vec<Option<f64>> = points
        .windows(WINDOW)
        .map(|window| {
            let mut steps = window.windows(2).map(|pair| pair[1][0] - pair[0][0]);
            let is_whole = steps.all(|step| step <= LONGEST * interval);
            is_whole.then(|| left_by_polynomial(window))
        })
        .collect();
    let all: Vec<f64> = squares.iter().flatten().copied().collect();
    let freedom = (WINDOW - POWERS) as f64;
    let floor = freedom * (ROUNDING * resolution * resolution).max(NOISE * NOISE);
    let usual = median(all.clone()).max(floor);
    let has_leap = |index: &usize| {
        let Some(square) = squares[*index] else {
            return false;
        };
        if square <= OF_RECORD * usual {
            return false;
        }
        let near = index.saturating_sub(NEAR)..squares.len().min(index + NEAR + 1);
        let near = near.filter(|other| other.abs_diff(*index) >= WINDOW);
        let near: Vec<f64> = near.filter_map(|other| squares[other]).collect();
        square > OF_SURROUNDINGS * quantile(near, 0.9)
    };
    let found: Vec<usize> = (0..squares.len()).filter(has_leap).collect();
    if found.len() as f64 > PART * all.len() as f64 {
        return Vec::new();
    }
    let runs = found.chunk_by(|a, b| a + 1 == *b);
    let runs = runs.filter_map(|run| {
        // The leap is near the end of the first window and near the start of the last.
        let ends = [run.first()? + WINDOW - 1 - BLIND, run.last()? + BLIND];
        Some([rows[ends[0].min(ends[1])], rows[ends[0].max(ends[1])]])
    });
    runs.collect()
}

/// Returns the sum of squared residuals of some points after a least-squares fit by a polynomial.
/// It uses polynomials that are orthogonal on the points' times.
fn left_by_polynomial(points: &[[f64; 2]]) -> f64 {
    let middle = 0.5 * (points[0][0] + points[points.len() - 1][0]);
    let scale = points[points.len() - 1][0] - middle;
    let mut at = [0.0; WINDOW];
    let mut left = [0.0; WINDOW];
    for (index, [time, value]) in points.iter().enumerate() {
        at[index] = (time - middle) / scale;
        left[index] = value - points[0][1];
    }
    let mut basis = [[0.0; WINDOW]; POWERS];
    for power in 0..POWERS {
        let mut own = match power.checked_sub(1) {
            None => [1.0; WINDOW],
            Some(before) => std::array::from_fn(|index| at[index] * basis[before][index]),
        };
        // Twice, since the first leaves a rounding.
        for _ in 0..2 {
            for other in &basis[..power] {
                let part = dot(&own, other);
                own.iter_mut()
                    .zip(other)
                    .for_each(|(own, other)| *own -= part * other);
            }
        }
        let length = dot(&own, &own).sqrt();
        own.iter_mut().for_each(|own| *own /= length);
        basis[power] = own;
        let part = dot(&left, &own);
        left.iter_mut()
            .zip(&own)
            .for_each(|(left, own)| *left -= part * own);
    }
    dot(&left, &left)
}

fn dot(a: &[f64; WINDOW], b: &[f64; WINDOW]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
