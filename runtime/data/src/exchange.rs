//! Correction of series that are exchanged in some pictures, because a tracker has confused two
//! points.

use std::f64::consts::TAU;
use std::ops::Range;

use super::finding::{Basis, Finding, counted, listed, moments};
use super::timing::median;

/// A moving position: an angle, or a point in the plane.
pub(crate) trait Position: Copy {
    /// Returns the sum of this position and `part` times `other`.
    fn plus(self, part: f64, other: Self) -> Self;
    /// Returns the distance of the position from the origin.
    fn length(self) -> f64;
}

impl Position for [f64; 2] {
    fn plus(self, part: f64, other: Self) -> Self {
        [self[0] + part * other[0], self[1] + part * other[1]]
    }

    fn length(self) -> f64 {
        self[0].hypot(self[1])
    }
}

/// An angle between minus and plus half a turn.
#[derive(Clone, Copy)]
pub(crate) struct Angle(pub(crate) f64);

impl Position for Angle {
    fn plus(self, part: f64, other: Self) -> Self {
        let wrapped = |angle: f64| angle - (angle / TAU).round() * TAU;
        Self(wrapped(self.0 + part * wrapped(other.0)))
    }

    fn length(self) -> f64 {
        self.0.abs()
    }
}

/// Two series, and the rows in which they were exchanged.
pub(crate) struct Exchange {
    pub(crate) series: [usize; 2],
    pub(crate) rows: Vec<usize>,
}

/// Returns the findings about all exchanges; those that last to the start or the end of the record
/// are doubtful.
pub(crate) fn exchange_findings(
    exchanges: &[Exchange],
    names: &[&str],
    times: &[f64],
    interval: f64,
) -> impl Iterator<Item = Finding> {
    let of = |is_open: bool| {
        let ends = [0, times.len() - 1];
        let wanted = exchanges.iter();
        let wanted = wanted.filter(|one| ends.iter().any(|end| one.rows.contains(end)) == is_open);
        let each = wanted.map(|Exchange { series, rows }| {
            let [one, other] = series.map(|index| names[index]);
            let (count, places) = (counted(rows.len(), "row"), moments(times, rows, interval));
            format!("`{one}` and `{other}` in {count} ({places})")
        });
        each.collect::<Vec<String>>()
    };
    let reported = [
        (Basis::Marked, of(false), "exchanged, and changed back"),
        (
            Basis::Doubtful,
            of(true),
            "exchanged up to an end of the record, and changed back, though the other part may be \
             the one that is exchanged",
        ),
    ];
    let reported = reported.into_iter().filter(|(_, each, _)| !each.is_empty());
    reported.map(|(basis, each, how)| {
        Finding::new(basis, format!("{how}: {}", listed(each.into_iter())))
    })
}

/// Distance from the predicted position, relative to the usual distance, that counts as too far.
const FAR: f64 = 6.0;
/// Distance from the predicted position, relative to the usual distance, that counts as small.
const QUIET: f64 = 1.5;
/// Distance from the predicted position, relative to the distances in the last rows, that counts as
/// too far. It prevents a fast motion from being mistaken for an exchange.
const FAR_OF_LATE: f64 = 3.0;
/// Factor by which exchanging two series must bring their difference closer to its prediction.
const BETTER: f64 = 3.0;
/// Number of successive rows that may be skipped before tracking of a series restarts.
const PASSED: usize = 3;
/// Largest time step, in units of the usual interval, over which the next position is predicted.
const NEAR: f64 = 4.5;

/// Finds and corrects exchanges of two series, which may last from one row to any later one. Where
/// an exchange begins or ends, their difference changes its sign while their sum continues
/// smoothly. It assumes that most rows are correct. `resolutions` are the steps to which positions
/// are rounded. The effort is linear in the number of rows.
pub(crate) fn mend<V: Copy, P: Position>(
    times: &[f64],
    interval: f64,
    resolutions: &[f64],
    series: &mut [Vec<Option<V>>],
    place: impl Fn(V) -> P,
) -> Vec<Exchange> {
    let mut exchanges = Vec::new();
    for other in 1..series.len() {
        let (before, rest) = series.split_at_mut(other);
        for (one, own) in before.iter_mut().enumerate() {
            let values = own.iter().zip(&rest[0]);
            let combined = |part: f64| -> Vec<Option<P>> {
                let values = values.clone();
                values
                    .map(|(a, b)| Some(place((*a)?).plus(part, place((*b)?))))
                    .collect()
            };
            let floor = resolutions[one].max(resolutions[other]);
            let pair = Pair {
                times,
                interval,
                difference: Path::new(times, combined(-1.0), floor),
                sum: Path::new(times, combined(1.0), floor),
            };
            let rows = pair.exchanged();
            for &row in &rows {
                std::mem::swap(&mut own[row], &mut rest[0][row]);
            }
            if !rows.is_empty() {
                exchanges.push(Exchange {
                    series: [one, other],
                    rows,
                });
            }
        }
    }
    exchanges
}

/// Positions against time, and their usual distance from the positions predicted by earlier ones.
struct Path<P> {
    places: Vec<Option<P>>,
    usual: f64,
}

impl<P: Position> Path<P> {
    fn new(times: &[f64], places: Vec<Option<P>>, floor: f64) -> Self {
        let bends = (2..times.len()).filter_map(|row| bend(times, row, |row| places[row]));
        let usual = median(bends.collect()).max(floor);
        Self { places, usual }
    }
}

/// Returns the distance of the position in a row from the position predicted by the two rows
/// before.
fn bend<P: Position>(times: &[f64], row: usize, place: impl Fn(usize) -> Option<P>) -> Option<f64> {
    let at = |row: usize| Some((times[row], place(row)?));
    let expected = ahead(at(row - 2)?, at(row - 1)?, times[row]);
    Some(place(row)?.plus(-1.0, expected).length())
}

/// Extrapolates two positions to a later time.
fn ahead<P: Position>((start, from): (f64, P), (end, to): (f64, P), time: f64) -> P {
    to.plus((time - end) / (end - start), to.plus(-1.0, from))
}

/// Two series, stored as their difference and their sum.
struct Pair<'a, P> {
    times: &'a [f64],
    interval: f64,
    difference: Path<P>,
    sum: Path<P>,
}

impl<P: Position> Pair<'_, P> {
    /// Returns the rows in which the two series are exchanged.
    fn exchanged(&self) -> Vec<usize> {
        let count = self.times.len();
        let Some(seed) = self.quiet_row() else {
            return Vec::new();
        };
        let mut is_exchanged = vec![false; count];
        self.follow(seed..count, &mut is_exchanged);
        self.follow((0..seed + PASSED).rev(), &mut is_exchanged);
        let most = 2 * is_exchanged.iter().filter(|one| **one).count() > count;
        let is_exchanged = |row: usize| is_exchanged[row] != most;
        let mut rows = Vec::new();
        let mut row = 0;
        while row < count {
            let end = (row..count)
                .find(|&row| !is_exchanged(row))
                .unwrap_or(count);
            if row < end && self.is_smoother(row..end) {
                rows.extend(row..end);
            }
            row = end + 1;
        }
        rows
    }

    /// Returns the row nearest to the middle at which the difference continues smoothly and is so
    /// large that its sign is clear.
    fn quiet_row(&self) -> Option<usize> {
        let Path { places, usual } = &self.difference;
        let is_quiet = |row: &usize| {
            let bend = bend(self.times, row + 2, |row| places[row]);
            let is_apart = places[row + 1].is_some_and(|place| place.length() > FAR * usual);
            is_apart && bend.is_some_and(|bend| bend <= QUIET * usual)
        };
        let middle = self.times.len() / 2;
        let last = (self.times.len() + 1).saturating_sub(PASSED);
        (middle..last)
            .find(is_quiet)
            .or_else(|| (0..middle.min(last)).rev().find(is_quiet))
    }

    /// Goes through the rows and marks those at which the difference changes its sign while the sum
    /// continues smoothly.
    fn follow(&self, rows: impl Iterator<Item = usize>, is_exchanged: &mut [bool]) {
        let mut differences = Tracker::new(self.interval, self.difference.usual);
        let mut sums = Tracker::new(self.interval, self.sum.usual);
        let mut is_now = false;
        for row in rows {
            let time = self.times[row];
            if let (Some(difference), Some(sum)) =
                (self.difference.places[row], self.sum.places[row])
            {
                let turned = difference.plus(-2.0, difference);
                let [as_it_is, changed] =
                    [difference, turned].map(|one| differences.distance(time, one));
                let goes_on = sums
                    .distance(time, sum)
                    .is_none_or(|distance| !sums.is_far(distance));
                // If both readings are possible, the rows stay as they are.
                if let (Some(as_it_is), Some(changed)) = (as_it_is, changed) {
                    is_now = differences.is_far(as_it_is)
                        && (is_now || (goes_on && BETTER * changed <= as_it_is));
                }
                differences.go_on(time, if is_now { turned } else { difference });
                sums.go_on(time, sum);
            }
            is_exchanged[row] = is_now;
        }
    }

    /// Returns true if reversing the sign of the difference in these rows makes it as smooth as
    /// usual at both ends, and if it is much less smooth without. In a fast motion, a single
    /// position is not enough evidence.
    fn is_smoother(&self, rows: Range<usize>) -> bool {
        let Path { places, usual } = &self.difference;
        let as_it_is = |row: usize| places[row];
        let changed = |row: usize| {
            let place = places[row]?;
            Some(if rows.contains(&row) {
                place.plus(-2.0, place)
            } else {
                place
            })
        };
        let lasts = [rows.start, rows.start + 1, rows.end, rows.end + 1];
        let lasts = lasts
            .into_iter()
            .filter(|last| (2..places.len()).contains(last));
        let bends = lasts.filter_map(|last| {
            Some([
                bend(self.times, last, as_it_is)?,
                bend(self.times, last, changed)?,
            ])
        });
        let bends: Vec<[f64; 2]> = bends.collect();
        let sum = |which: usize| bends.iter().map(|bends| bends[which]).sum::<f64>();
        let is_smooth = bends.iter().all(|[_, changed]| *changed <= FAR * usual);
        is_smooth && sum(0) > 0.0 && BETTER * sum(1) <= sum(0)
    }
}

/// Number of most recent distances from which the speed of the motion is judged.
const LATE: usize = 6;

/// The most recent positions that agreed with their predictions.
struct Tracker<P> {
    interval: f64,
    usual: f64,
    last: Option<(f64, P)>,
    before: Option<(f64, P)>,
    passed: usize,
    late: [f64; LATE],
}

impl<P: Position> Tracker<P> {
    fn new(interval: f64, usual: f64) -> Self {
        Self {
            interval,
            usual,
            last: None,
            before: None,
            passed: 0,
            late: [0.0; LATE],
        }
    }

    /// Returns the distance of a position from the predicted one; `None` if there is no prediction.
    fn distance(&self, time: f64, place: P) -> Option<f64> {
        let (last, before) = (self.last?, self.before?);
        let is_near = (time - last.0).abs() <= NEAR * self.interval;
        is_near.then(|| place.plus(-1.0, ahead(before, last, time)).length())
    }

    fn is_far(&self, distance: f64) -> bool {
        let late = self.late.iter().copied().fold(0.0, f64::max);
        distance > FAR * self.usual && distance > FAR_OF_LATE * late
    }

    /// Adds a position, unless it is far from the predicted one.
    fn go_on(&mut self, time: f64, place: P) {
        let step = self.last.map(|last| (time - last.0).abs());
        let mut is_known = step.is_some_and(|step| step <= NEAR * self.interval);
        if let Some(distance) = self.distance(time, place) {
            let is_far = self.is_far(distance);
            if is_far && self.passed < PASSED {
                self.passed += 1;
                return;
            }
            is_known &= !is_far;
            self.late.rotate_left(1);
            self.late[LATE - 1] = distance;
        }
        self.before = self.last.filter(|_| is_known);
        self.last = Some((time, place));
        self.passed = 0;
    }
}
