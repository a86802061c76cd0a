//! Pictures whose angles are not those of the motion before and behind.

use super::estimate::{Estimate, Measured};

/// Distance of an angle from the motion, in usual ones, that is too far.
const FAR: f64 = 6.0;
/// Median of |x| of a normal distribution of deviation 1, inverted.
const NORMAL: f64 = 1.4826;
/// Pictures beside a wrong one that are left out with it; wrong ones so near are one stretch.
const BESIDE: usize = 3;
/// Most stretches, and the largest part of a record that they may take.
const STRETCHES: usize = 5;
const PART: f64 = 0.15;

/// Stretches of time (s) in which pictures are wrong as likely as not, in up to two ways: each that is
/// far from the motion, and all that lies between the first and the last.
pub fn stretches<const N: usize>(
    measured: &Measured<'_, N>,
    estimate: &Estimate<N>,
) -> Vec<Vec<[f64; 2]>> {
    let times = measured.record.times;
    let apart = |row: usize| {
        let links = measured.record.angles[row];
        if links.iter().any(Option::is_none) {
            return None;
        }
        let seen = measured
            .subject
            .coordinates(&links.map(|angle| angle.unwrap_or_default()));
        let [motion, _] = estimate.motion[row];
        Some(std::array::from_fn(|of| (seen[of] - motion[of]).abs()))
    };
    let apart: Vec<Option<[f64; N]>> = (0..times.len()).map(apart).collect();
    let usual: [f64; N] = std::array::from_fn(|of| {
        let mut all: Vec<f64> = apart.iter().flatten().map(|row| row[of]).collect();
        all.sort_unstable_by(f64::total_cmp);
        NORMAL * all.get(all.len() / 2).copied().unwrap_or_default()
    });
    let is_far =
        |row: &usize| apart[*row].is_some_and(|row| (0..N).any(|of| row[of] > FAR * usual[of]));
    let mut rows: Vec<[usize; 2]> = Vec::new();
    for row in (0..times.len()).filter(is_far) {
        match rows.last_mut() {
            Some([_, last]) if row - *last <= 2 * BESIDE => *last = row,
            _ => rows.push([row, row]),
        }
    }
    let (Some([first, _]), Some([_, last])) = (rows.first(), rows.last()) else {
        return Vec::new();
    };
    let whole = vec![[*first, *last]];
    let mut ways = vec![rows];
    if ways[0] != whole {
        ways.push(whole);
    }
    let of_rows = |rows: Vec<[usize; 2]>| {
        let rows = rows.into_iter().map(|[first, last]| {
            [
                first.saturating_sub(BESIDE),
                (last + BESIDE).min(times.len() - 1),
            ]
        });
        let rows: Vec<[usize; 2]> = rows.collect();
        let count = rows
            .iter()
            .map(|[first, last]| last - first + 1)
            .sum::<usize>();
        let is_small = rows.len() <= STRETCHES && count as f64 <= PART * times.len() as f64;
        is_small.then(|| rows.iter().map(|row| row.map(|row| times[row])).collect())
    };
    ways.into_iter().filter_map(of_rows).collect()
}
