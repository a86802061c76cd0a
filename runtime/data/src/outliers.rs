//! Detection of outliers: samples that do not fit to their neighbours.

use super::sample::Sample;
use super::timing::{median, quantile};
use super::turns::Turns;

/// Offsets of the neighbours by whose polynomials a sample is predicted. A bad sample deviates from
/// all predictions; a good one agrees with some, even if a neighbour is bad or the motion is fast.
const NEIGHBOURS: [&[isize]; 5] = [
    &[-2, -1, 1, 2],
    &[-3, -2, 2, 3],
    &[-4, -3, 3, 4],
    &[-3, -2, -1],
    &[1, 2, 3],
];
/// Number of samples on each side from which the usual deviation is computed.
const WINDOW: usize = 12;
/// Number of nearest samples on each side that are excluded from it.
const EXCLUDED: usize = 2;
/// Inverse of the median of |x| for a normal distribution with standard deviation 1.
const NORMAL: f64 = 1.4826;
/// Standard deviation of the error of rounding to whole numbers.
const ROUNDING: f64 = 0.288_675;
/// Largest fraction of a record that can count as exceptional, and the number of samples that can
/// do so in any record.
const LARGEST_PART: f64 = 0.05;
pub(crate) const FEW: usize = 5;

/// Returns true if this many samples of a record are too many to be exceptions; `few` are always
/// accepted.
pub(crate) fn are_many(wrong: usize, of: usize, few: usize) -> bool {
    wrong > few && wrong as f64 > LARGEST_PART * of as f64
}

/// Samples that were marked.
pub(crate) enum Marked {
    /// These rows.
    Rows(Vec<usize>),
    /// None were marked, because this many would not be exceptions.
    TooMany(usize),
}

/// Marks measured samples as outliers: those whose deviation from their neighbours is more than
/// `threshold` times the usual deviation, both of the record and of the surroundings, and those
/// that are far from all others for any number of turns. The usual deviation is at least that of
/// rounding to the `resolution`. Linear in the number of samples.
pub(crate) fn mark(
    times: &[f64],
    samples: &mut [Sample],
    threshold: f64,
    resolution: f64,
    turns: &Turns,
) -> Marked {
    let followed = turns.followed.iter();
    let points: Vec<[f64; 2]> = followed
        .filter_map(|&row| match samples[row] {
            Sample::Measured(value) => Some([times[row], value]),
            _ => None,
        })
        .collect();
    let own = |at: usize| deviation(&points, points[at], [at.checked_sub(1), Some(at + 1)]);
    let deviations: Vec<f64> = (0..points.len()).map(own).collect();
    // The usual deviation of the record, at least that of rounding.
    let all = (NORMAL * median(deviations.clone())).max(ROUNDING * resolution);
    let mut rows = Vec::new();
    let mut measured = 0;
    let mut next = 0;
    for (row, sample) in samples.iter().enumerate() {
        let Sample::Measured(value) = *sample else {
            continue;
        };
        measured += 1;
        let is_followed = turns.followed.get(next) == Some(&row);
        let size = match is_followed {
            true => deviations[next],
            false => deviation(
                &points,
                [times[row], value],
                [next.checked_sub(1), Some(next)],
            ),
        };
        let is_outlier = turns.strays.binary_search(&row).is_ok()
            || size > threshold * all.max(around(&deviations, next));
        if is_outlier {
            rows.push(row);
        }
        next += usize::from(is_followed);
    }
    if are_many(rows.len(), measured, FEW.min(measured / 4)) {
        return Marked::TooMany(rows.len());
    }
    for &row in &rows {
        if let Sample::Measured(value) = samples[row] {
            samples[row] = Sample::Outlier(value);
        }
    }
    Marked::Rows(rows)
}

/// Returns the smallest distance of a point from the polynomials through its neighbours; the
/// indices of the nearest neighbours before and after it are given. 0 if fewer than two neighbours
/// exist.
fn deviation(
    points: &[[f64; 2]],
    [time, value]: [f64; 2],
    [before, behind]: [Option<usize>; 2],
) -> f64 {
    let mut smallest = f64::INFINITY;
    let mut count = 0;
    for offsets in NEIGHBOURS {
        let neighbour = |offset: &isize| {
            let nearest = if *offset < 0 { before } else { behind };
            let index = nearest?.checked_add_signed(offset - offset.signum())?;
            points.get(index).copied()
        };
        let Some(nodes) = offsets.iter().map(neighbour).collect::<Option<Vec<_>>>() else {
            continue;
        };
        smallest = smallest.min((value - interpolated(&nodes, time)).abs());
        count += 1;
    }
    if count < 2 { 0.0 } else { smallest }
}

/// Returns the value at a time of the polynomial through some points (Lagrange's form).
fn interpolated(nodes: &[[f64; 2]], time: f64) -> f64 {
    let weighted = nodes.iter().enumerate().map(|(own, [at, value])| {
        let others = nodes.iter().enumerate().filter(|(other, _)| *other != own);
        let weight: f64 = others
            .map(|(_, [other, _])| (time - other) / (at - other))
            .product();
        weight * value
    });
    weighted.sum()
}

/// Returns the 90th percentile of the deviations of the samples around one.
fn around(deviations: &[f64], at: usize) -> f64 {
    let window = at.saturating_sub(WINDOW)..(at + WINDOW + 1).min(deviations.len());
    let others = window.filter(|other| other.abs_diff(at) > EXCLUDED);
    quantile(others.map(|other| deviations[other]).collect(), 0.9)
}

/// Returns the step to which values are rounded: the smallest difference between two values, if it
/// occurs more often than by chance; otherwise 0. If many samples have the same value, as at rest,
/// a difference counts as often as the rarer of its two values occurs.
pub(crate) fn resolution(values: impl Iterator<Item = f64>) -> f64 {
    const OFTEN: usize = 3;
    const EQUAL: f64 = 1e-3;
    let mut values: Vec<f64> = values.collect();
    values.sort_unstable_by(f64::total_cmp);
    let largest = values
        .iter()
        .fold(0.0_f64, |most, value| most.max(value.abs()));
    // Values, each with the number of samples that have it.
    let mut levels: Vec<(f64, usize)> = Vec::new();
    for value in values {
        match levels.last_mut() {
            Some((level, count)) if value - *level <= 1e-12 * largest => *count += 1,
            _ => levels.push((value, 1)),
        }
    }
    let steps = || levels.windows(2).map(|pair| (pair[1].0 - pair[0].0, pair));
    let smallest = steps().fold(f64::INFINITY, |least, (step, _)| least.min(step));
    let often: usize = steps()
        .filter(|(step, _)| *step <= (1.0 + EQUAL) * smallest)
        .map(|(_, pair)| pair[0].1.min(pair[1].1))
        .sum();
    if often >= OFTEN { smallest } else { 0.0 }
}
