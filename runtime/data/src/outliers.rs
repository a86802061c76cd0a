//! Samples that do not fit their neighbours.

use super::sample::Sample;
use super::timing::{median, quantile};
use super::turns::Turns;

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
/// Standard deviation of what is lost by rounding to whole numbers.
const ROUNDING: f64 = 0.288_675;
/// Largest part of a record that can be called exceptional, and the number that can be in any.
const LARGEST_PART: f64 = 0.05;
pub(crate) const FEW: usize = 5;

/// Returns true if so many samples of a record cannot be exceptions, few of a long one aside.
pub(crate) fn are_many(wrong: usize, of: usize, few: usize) -> bool {
    wrong > few && wrong as f64 > LARGEST_PART * of as f64
}

/// Samples that were marked.
pub(crate) enum Marked {
    /// These rows.
    Rows(Vec<usize>),
    /// None: so many would be no exceptions.
    TooMany(usize),
}

/// Marks measured samples whose deviation from their neighbours is more than `threshold`
/// times the usual one, of the record and of the surroundings, and those that are far from all
/// others whatever their turns. A usual deviation is at least that of rounding to the `resolution`.
/// Linear in their number.
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
    let floor = ROUNDING * resolution;
    let all = (NORMAL * median(deviations.clone())).max(floor);
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
            || (size > threshold * all && size > threshold * around(&deviations, next).max(floor));
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

/// Smallest distance of a point from the polynomials through its neighbours, of which those next to
/// it before and behind are given; 0 where fewer than two of them tell.
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
    quantile(others.map(|other| deviations[other]).collect(), 0.9)
}

/// The step in which values are written or counted: the smallest one between any two, if it is found
/// more often than by chance; else 0.
pub(crate) fn resolution(values: impl Iterator<Item = f64>) -> f64 {
    const OFTEN: usize = 3;
    const EQUAL: f64 = 1e-3;
    let mut values: Vec<f64> = values.collect();
    values.sort_unstable_by(f64::total_cmp);
    let largest = values
        .iter()
        .fold(0.0_f64, |most, value| most.max(value.abs()));
    let steps = || values.windows(2).map(|pair| pair[1] - pair[0]);
    let steps = || steps().filter(|step| *step > 1e-12 * largest);
    let smallest = steps().fold(f64::INFINITY, f64::min);
    let often = steps()
        .filter(|step| *step <= (1.0 + EQUAL) * smallest)
        .count();
    if often >= OFTEN { smallest } else { 0.0 }
}
