//! Rows whose times do not ascend: repeated times, and several recordings in one table.

use super::clock::{Clock, TimeColumns, ignored_times};
use super::error::{ReadError, ReadErrorKind};
use super::finding::{Basis, Finding, counted};
use super::table::Table;

/// Which of several rows with the same time is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Repeated {
    /// The first.
    First,
    /// The last.
    Last,
}

/// Fewest rows of a recording.
const FEWEST: usize = 3;

/// Returns the error for a row whose time is not later than the one above, with the remedy that the
/// whole column suggests: another recording, rounded times, or repeated rows.
pub(crate) fn disorder(
    table: &Table,
    columns: &TimeColumns,
    times: &[Option<f64>],
    row: usize,
) -> ReadError {
    let [previous, time] = [row - 1, row].map(|row| times[row].unwrap_or(f64::NAN));
    let kind = match recordings(table, columns, times) {
        Some(Recordings { count, column, .. }) => ReadErrorKind::Recordings {
            previous,
            time,
            count,
            column,
        },
        None if previous == time => match rounded_rate(table, times) {
            Some((rate, digits)) => ReadErrorKind::RoundedTimes {
                time,
                rate: super::finding::rounded(rate, digits),
            },
            None => ReadErrorKind::TimeOrder { previous, time },
        },
        None => ReadErrorKind::TimeOrder { previous, time },
    };
    table.refused_at(kind, row, columns.column)
}

/// Several recordings, or tracks, in one table.
struct Recordings {
    count: usize,
    /// Index of the recording of each row, from 0.
    of_rows: Vec<usize>,
    /// The column that distinguishes tracks whose rows alternate.
    column: Option<String>,
}

/// Finds several recordings in a table: one after the other, with the time starting again, or
/// tracks whose rows alternate at equal times and are numbered by a column.
fn recordings(table: &Table, columns: &TimeColumns, times: &[Option<f64>]) -> Option<Recordings> {
    in_succession(times).or_else(|| in_turns(table, columns, times))
}

fn in_succession(times: &[Option<f64>]) -> Option<Recordings> {
    let mut of_rows = Vec::with_capacity(times.len());
    let first = times.iter().flatten().next()?;
    let (mut start, mut last, mut count) = (*first, *first, 0);
    for (row, time) in times.iter().enumerate() {
        let time = time.unwrap_or(last);
        if time < last {
            // A clock that is set back by a little does not start again, nor does one of which a
            // few times are wrong.
            let behind = times[row..].iter().take(FEWEST).flatten();
            if time - start > 0.5 * (last - start) || behind.into_iter().any(|own| *own > last) {
                return None;
            }
            start = time;
            count += 1;
        }
        last = time;
        of_rows.push(count);
    }
    let mut parts = of_rows.chunk_by(|a, b| a == b);
    let are_long = parts.all(|part| part.len() >= FEWEST);
    (count > 0 && are_long).then_some(Recordings {
        count: count + 1,
        of_rows,
        column: None,
    })
}

fn in_turns(table: &Table, columns: &TimeColumns, times: &[Option<f64>]) -> Option<Recordings> {
    let mut groups = times.chunk_by(|a, b| a == b);
    let count = groups.next()?.len();
    let is_even = count > 1 && groups.all(|group| group.len() == count);
    if !is_even || times.len() < FEWEST * count {
        return None;
    }
    let numbers = |column: &usize| {
        let Ok(values) = table.values(*column) else {
            return false;
        };
        let (first, rest) = values.split_at(count);
        let is_distinct = (1..count).all(|index| !first[..index].contains(&first[index]));
        is_distinct && rest.chunks(count).all(|group| group == first)
    };
    let own = (0..table.columns().len()).filter(|&column| !columns.contain(column));
    let column = own.into_iter().find(numbers)?;
    Some(Recordings {
        count,
        of_rows: (0..times.len()).map(|row| row % count).collect(),
        column: Some(table.columns()[column].name.clone()),
    })
}

/// Returns the rate of rows that are evenly spaced but have times with too few digits, and the
/// number of its digits that the times determine.
fn rounded_rate(table: &Table, times: &[Option<f64>]) -> Option<(f64, i32)> {
    /// Smallest fraction of rows with repeated times for which rounding is assumed to be the cause.
    const PART: f64 = 0.2;
    /// Smallest number of rows with repeated times for which rounding is assumed to be the cause.
    const REPEATED: usize = 4;
    let times: Vec<f64> = times.iter().copied().collect::<Option<_>>()?;
    let is_repeated = |row: &usize| times[*row] == times[*row - 1];
    let repeated: Vec<usize> = (1..times.len()).filter(is_repeated).collect();
    let behind = times.len() - repeated.first()?;
    let copies = repeated.iter().filter(|row| is_copy(table, **row)).count();
    if repeated.len() < REPEATED
        || (repeated.len() as f64) < PART * behind as f64
        || 2 * copies > repeated.len()
    {
        return None;
    }
    let steps = times.windows(2).map(|pair| pair[1] - pair[0]);
    let largest = steps.fold(0.0, f64::max);
    let EvenTimes { interval, farthest } = EvenTimes::through(&times);
    (farthest <= largest && interval > 0.0)
        .then(|| (1.0 / interval, digits(interval, largest, times.len())))
}

/// Returns the number of digits of a rate that times determine which are rounded to `step`.
fn digits(interval: f64, step: f64, count: usize) -> i32 {
    // Deviation of the slope.
    let error = step / (interval * (count as f64).powf(1.5));
    (-error.log10()).floor().clamp(2.0, 6.0) as i32
}

/// Evenly spaced times that come nearest to the times of rows.
struct EvenTimes {
    /// Their interval, s.
    interval: f64,
    /// Largest distance of a row's time from the even one, s.
    farthest: f64,
}

impl EvenTimes {
    /// Fits a straight line by least squares.
    fn through(times: &[f64]) -> Self {
        let count = times.len() as f64;
        let middle = 0.5 * (count - 1.0);
        let start = times.first().copied().unwrap_or_default();
        let mean = times.iter().map(|time| time - start).sum::<f64>() / count;
        let rows = || {
            let rows = times.iter().enumerate();
            rows.map(move |(row, time)| [row as f64 - middle, time - start - mean])
        };
        let sums = rows().fold([0.0; 2], |sums, [row, time]| {
            [sums[0] + row * time, sums[1] + row * row]
        });
        let interval = sums[0] / sums[1];
        let distances = rows().map(|[row, time]| (time - row * interval).abs());
        Self {
            interval,
            farthest: distances.fold(0.0, f64::max),
        }
    }
}

/// Returns a finding about times without repetition that are rounded so much that the motion is
/// distorted, although rows are evenly spaced.
pub(crate) fn rounding(times: &[f64]) -> Option<Finding> {
    /// Largest number of digits after the decimal point.
    const DIGITS: i32 = 6;
    /// Fewest rows.
    const ROWS: usize = 20;
    /// Length of an interval, in units of the last digit, from which on rounding does not matter.
    const FINE: f64 = 10.0;
    /// Fraction of intervals below which a length of them is rare.
    const RARE: f64 = 0.1;
    let is_rounded = |digits: &i32| {
        let scale = 10.0_f64.powi(*digits);
        times.iter().all(|time| {
            let scaled = time * scale;
            (scaled - scaled.round()).abs() <= 1e-6 + 4.0 * f64::EPSILON * scaled.abs()
        })
    };
    let step = 10.0_f64.powi(-(0..=DIGITS).find(is_rounded)?);
    let EvenTimes { interval, farthest } = EvenTimes::through(times);
    // Rounding alone, of all rows.
    let is_even = (0.25 * step..=0.55 * step).contains(&farthest);
    // Single rows that are lost look like a slower rate.
    let steps = times.windows(2).map(|pair| pair[1] - pair[0]);
    let shorter = steps.filter(|own| *own < interval).count() as f64 / times.len() as f64;
    let is_alternating = (RARE..=1.0 - RARE).contains(&shorter);
    let is_coarse = interval > 0.0 && interval < FINE * step;
    if times.len() < ROWS || !(is_coarse && is_even && is_alternating) {
        return None;
    }
    let rate = super::finding::rounded(1.0 / interval, digits(interval, step, times.len()));
    let text = format!(
        "times are rounded to {step} s: the rows are evenly spaced, {rate} per second; with that frame \
         rate in place of the times, errors of angles are smaller"
    );
    Some(Finding::new(Basis::Doubtful, text))
}

/// Returns true if all cells of a row equal those of the row above.
fn is_copy(table: &Table, row: usize) -> bool {
    let columns = 0..table.columns().len();
    let mut values = columns.filter_map(|column| table.values(column).ok());
    values.all(|values| values[row] == values[row - 1])
}

impl Table {
    /// Returns the table with only one of its recordings, counted from 1: the rows until the time
    /// starts again, or the rows of one of several alternating tracks.
    ///
    /// # Errors
    /// An error if the times cannot be found; [`ReadErrorKind::Option`] if the table does not
    /// contain this recording.
    pub fn recording(mut self, clock: &Clock, number: usize) -> Result<Self, ReadError> {
        let columns = TimeColumns::find(&self, clock, &mut Vec::new())?;
        let mut found = recordings(&self, &columns, &columns.seconds(&self)?);
        if found.is_none()
            && let Some(column) = ignored_times(&self)
        {
            found = recordings(&self, &columns, self.values(column)?);
        }
        let count = found.as_ref().map_or(1, |found| found.count);
        if !(1..=count).contains(&number) {
            let held = counted(count, "recording");
            let what = format!("there is no recording {number}: the table holds {held}");
            return Err(self.refused(ReadErrorKind::Option { what }));
        }
        let text = format!("recording {number} of {count}");
        self.add_finding(Finding::new(Basis::Given, text));
        let Some(found) = found else {
            return Ok(self);
        };
        let is_kept = found.of_rows.iter().map(|of| of + 1 == number);
        let is_kept: Vec<bool> = is_kept.collect();
        Ok(self.keeping(&is_kept))
    }

    /// Returns the times of all rows in s; `None` where one is missing.
    ///
    /// # Errors
    /// An error if the times cannot be found.
    pub fn times(&self, clock: &Clock) -> Result<Vec<Option<f64>>, ReadError> {
        TimeColumns::find(self, clock, &mut Vec::new())?.seconds(self)
    }

    /// Returns the table with only one of several successive rows that have the same time.
    ///
    /// # Errors
    /// An error if the times cannot be found.
    pub fn without_repeated_times(
        mut self,
        clock: &Clock,
        counts: Repeated,
    ) -> Result<Self, ReadError> {
        let times = TimeColumns::find(&self, clock, &mut Vec::new())?.seconds(&self)?;
        let mut is_kept = vec![true; times.len()];
        let mut first = 0;
        for row in 1..times.len() {
            if times[row].is_none() || times[row] != times[row - 1] {
                first = row;
                continue;
            }
            match counts {
                Repeated::First => is_kept[row] = false,
                Repeated::Last => is_kept[first..row].fill(false),
            }
        }
        let dropped = is_kept.iter().filter(|kept| !**kept).count();
        let word = match counts {
            Repeated::First => "first",
            Repeated::Last => "last",
        };
        let dropped = counted(dropped, "row");
        let text = format!("{dropped} dropped that repeat a time; the {word} counts");
        self.add_finding(Finding::new(Basis::Given, text));
        Ok(self.keeping(&is_kept))
    }

    /// Returns the table without measured values in some time intervals (s, ends included); the
    /// times of these rows stay.
    ///
    /// # Errors
    /// An error if the times cannot be found; [`ReadErrorKind::Option`] for an interval without
    /// rows.
    pub fn leaving_out(mut self, clock: &Clock, stretches: &[[f64; 2]]) -> Result<Self, ReadError> {
        let columns = TimeColumns::find(&self, clock, &mut Vec::new())?;
        let times = columns.seconds(&self)?;
        let times: Vec<f64> = times.iter().map(|time| time.unwrap_or(f64::NAN)).collect();
        for [from, to] in stretches {
            let is_left_out: Vec<bool> = times.iter().map(|t| (from..=to).contains(&t)).collect();
            let count = is_left_out.iter().filter(|left_out| **left_out).count();
            if count == 0 {
                let [first, last] =
                    [times.first(), times.last()].map(|t| t.copied().unwrap_or(f64::NAN));
                let what = format!(
                    "no row from {from} s to {to} s, to be left out, in a record from {first} s to {last} s"
                );
                return Err(self.refused(ReadErrorKind::Option { what }));
            }
            let rows = counted(count, "row");
            let text = format!("{rows} left out, from {from} s to {to} s");
            self.add_finding(Finding::new(Basis::Given, text));
            self.empty(&is_left_out, |column| columns.contain(column));
        }
        Ok(self)
    }
}

/// Largest difference between the first times of two recordings, relative to the duration of the
/// first.
const SAME_START: f64 = 0.1;

/// Returns an error if a frame rate would join several recordings of a table.
pub(crate) fn check_joined(table: &Table, columns: &TimeColumns) -> Result<(), ReadError> {
    let Some(column) = ignored_times(table).filter(|column| columns.column != Some(*column)) else {
        return Ok(());
    };
    let Ok(times) = table.values(column) else {
        return Ok(());
    };
    let Some(Recordings { count, of_rows, .. }) = in_succession(times) else {
        return Ok(());
    };
    let row = of_rows.iter().position(|of| *of == 1).unwrap_or_default();
    // A clock that wraps goes on from another time than that of the first row.
    let start = |row: usize| times.get(row).copied().flatten().unwrap_or(f64::NAN);
    if (start(row) - start(0)).abs() > SAME_START * (start(row - 1) - start(0)) {
        return Ok(());
    }
    let [previous, time] = [row - 1, row].map(|row| times[row].unwrap_or(f64::NAN));
    let kind = ReadErrorKind::Recordings {
        previous,
        time,
        count,
        column: None,
    };
    Err(table.refused_at(kind, row, Some(column)))
}
