//! Samples that do not fit their neighbours.

use super::recording::Sample;
use super::timing::median;

/// Offsets of the neighbours whose polynomials tell what a sample should be. A bad sample
/// deviates from all of them; a good one beside it, and one of a fast motion, agrees with
/// some.
const NEIGHBOURS: [&[isize]; 5] = [
    &[-2, -1, 1, 2],
    &[-3, -2, 2, 3],
    &[-4, -3, 3, 4],
    &[-3, -2, -1],
    &[1, 2, 3],
];
/// Samples on each side whose deviations are the usual ones there.
const WINDOW: usize = 12;
/// Samples on each side that are left out of those.
const OWN: usize = 2;
/// Median of |x| of a normal distribution of deviation 1, inverted.
const NORMAL: f64 = 1.4826;
/// Largest part of a record that can be called exceptional.
const LARGEST_PART: f64 = 0.05;

/// Samples that were marked.
pub(crate) enum Marked {
    /// So many samples.
    Some(usize),
    /// None: so many would be no exceptions.
    TooMany(usize),
}

/// Marks measured samples whose deviation from their neighbours is more than `threshold`
/// times the usual one, of the record and of the surroundings. Linear in their number.
pub(crate) fn mark(times: &[f64], samples: &mut [Sample], threshold: f64) -> Marked {
    let used: Vec<(usize, f64)> = samples
        .iter()
        .enumerate()
        .filter_map(|(index, sample)| match sample {
            Sample::Measured(value) => Some((index, *value)),
            _ => None,
        })
        .collect();
    let points: Vec<[f64; 2]> = used
        .iter()
        .map(|&(index, value)| [times[index], value])
        .collect();
    let deviations: Vec<f64> = (0..points.len()).map(|at| deviation(&points, at)).collect();
    let all = NORMAL * median(deviations.clone());
    let is_outlier = |at: &usize| {
        let size = deviations[*at];
        size > threshold * all && size > threshold * around(&deviations, *at)
    };
    let outliers: Vec<usize> = (0..used.len()).filter(is_outlier).collect();
    if outliers.len() as f64 > LARGEST_PART * used.len() as f64 {
        return Marked::TooMany(outliers.len());
    }
    for &at in &outliers {
        let (index, value) = used[at];
        samples[index] = Sample::Outlier(value);
    }
    Marked::Some(outliers.len())
}

/// Smallest distance of a point from the polynomials through its neighbours; 0 where fewer
/// than two of them tell.
fn deviation(points: &[[f64; 2]], at: usize) -> f64 {
    let [time, value] = points[at];
    let mut smallest = f64::INFINITY;
    let mut count = 0;
    for offsets in NEIGHBOURS {
        let neighbour = |offset: &isize| points.get(at.checked_add_signed(*offset)?).copied();
        let Some(nodes) = offsets.iter().map(neighbour).collect::<Option<Vec<_>>>() else {
            continue;
        };
        smallest = smallest.min((value - interpolated(&nodes, time)).abs());
        count += 1;
    }
    if count < 2 { 0.0 } else { smallest }
}

/// The polynomial through points, at a time (Lagrange's form).
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

/// The deviation that nine of ten samples around one stay below.
fn around(deviations: &[f64], at: usize) -> f64 {
    let window = at.saturating_sub(WINDOW)..(at + WINDOW + 1).min(deviations.len());
    let others = window.filter(|other| other.abs_diff(at) > OWN);
    let mut others: Vec<f64> = others.map(|other| deviations[other]).collect();
    if others.is_empty() {
        return 0.0;
    }
    let place = (others.len() * 9 / 10).min(others.len() - 1);
    *others.select_nth_unstable_by(place, f64::total_cmp).1
}
