//! Pictures whose angles do not fit to the motion before and after them.

use std::ops::Range;

use super::estimate::Measured;

/// Distance of an angle from its extrapolation from neighbours, in units of the usual one, that is
/// too large.
const FAR: f64 = 8.0;
/// Number of neighbours of a wrong picture that are left out with it; wrong pictures that are not
/// farther apart are joined.
const NEIGHBOURS: usize = 3;
/// Largest number of intervals, and largest fraction of a record that they may cover.
const STRETCHES: usize = 6;
const PART: f64 = 0.15;

/// Returns the time intervals (s) in which pictures may be wrong, for several possible
/// interpretations. At the ends of a range of wrong pictures the measured motion leaps. Therefore
/// either only the pictures at the leaps are wrong, or those between two successive leaps, or those
/// between the first and the last leap.
///
/// Leaps are found by smoothness. `by_equations` lists the rows of leaps that violate the equations
/// of motion, which show smaller leaps.
pub fn stretches(measured: &Measured<'_>, by_equations: &[Range<usize>]) -> Vec<Vec<[f64; 2]>> {
    let by_smoothness = leaps(measured);
    let by_equations = by_equations.iter().fold(Vec::new(), |mut leaps, rows| {
        add(&mut leaps, rows.clone(), measured.record.times.len());
        leaps
    });
    let pairs = |leaps: &[[usize; 2]]| match leaps.as_chunks::<2>() {
        (pairs, []) => pairs.iter().map(|[a, b]| [a[0], b[1]]).collect(),
        _ => Vec::new(),
    };
    let whole = |leaps: &[[usize; 2]]| match leaps {
        [first, .., last] => vec![[first[0], last[1]]],
        _ => Vec::new(),
    };
    let mut ways: Vec<Vec<[usize; 2]>> = Vec::new();
    for leaps in [by_smoothness, by_equations] {
        let own = [pairs(&leaps), whole(&leaps)];
        for way in std::iter::once(leaps).chain(own) {
            if !ways.contains(&way) {
                ways.push(way);
            }
        }
    }
    let times = measured.record.times;
    let count = |rows: &[[usize; 2]]| -> usize { rows.iter().map(|[a, b]| b - a + 1).sum() };
    ways.retain(|rows| {
        let part = count(rows) as f64 / times.len() as f64;
        (1..=STRETCHES).contains(&rows.len()) && part <= PART
    });
    // Rounded outwards, that an option names them in few digits.
    let ends = |[first, last]: [usize; 2]| {
        let (from, to) = (1e4 * times[first], 1e4 * times[last]);
        [from.floor() / 1e4, to.ceil() / 1e4]
    };
    let of_rows = |rows: Vec<[usize; 2]>| rows.into_iter().map(ends).collect();
    ways.into_iter().map(of_rows).collect()
}

/// Returns the first and last rows of the surroundings of each leap.
fn leaps(measured: &Measured<'_>) -> Vec<[usize; 2]> {
    let times = measured.record.times;
    let rows = 0..times.len();
    let whole = rows.filter_map(|row| {
        let links: Option<Vec<f64>> = measured.record.angles[row].iter().copied().collect();
        Some((row, measured.subject.coordinates(&links?)))
    });
    let whole: Vec<(usize, Vec<f64>)> = whole.collect();
    // Distances from the cubics through four neighbours.
    let distances = whole.windows(5).map(|window| {
        let (row, mut distance) = window[2].clone();
        let neighbours = [0, 1, 3, 4].map(|index: usize| &window[index]);
        for (own, place) in neighbours {
            let others = neighbours.iter().filter(|(other, _)| other != own);
            let weight: f64 = others
                .map(|(other, _)| (times[row] - times[*other]) / (times[*own] - times[*other]))
                .product();
            for (distance, place) in distance.iter_mut().zip(place) {
                *distance -= weight * place;
            }
        }
        distance.iter_mut().for_each(|own| *own = own.abs());
        (row, distance)
    });
    let distances: Vec<(usize, Vec<f64>)> = distances.collect();
    let links = distances.first().map_or(0, |(_, row)| row.len());
    let usual = (0..links).map(|of| {
        let mut all: Vec<f64> = distances.iter().map(|(_, row)| row[of]).collect();
        all.sort_unstable_by(f64::total_cmp);
        all.get(all.len() / 2).copied().unwrap_or_default()
    });
    let usual: Vec<f64> = usual.collect();
    let mut leaps: Vec<[usize; 2]> = Vec::new();
    for (row, distance) in distances {
        if distance
            .iter()
            .zip(&usual)
            .all(|(own, usual)| *own <= FAR * usual)
        {
            continue;
        }
        add(&mut leaps, row..row + 1, times.len());
    }
    leaps
}

/// Adds the surroundings of a leap to a list, or joins them to the last ones.
fn add(leaps: &mut Vec<[usize; 2]>, rows: Range<usize>, count: usize) {
    let first = rows.start.saturating_sub(NEIGHBOURS);
    let last = (rows.end + NEIGHBOURS).min(count) - 1;
    match leaps.last_mut() {
        Some([_, end]) if first <= *end => *end = last.max(*end),
        _ => leaps.push([first, last]),
    }
}
