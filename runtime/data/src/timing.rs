//! Times of samples.

use super::error::{ReadError, ReadErrorKind};
use super::finding::{Basis, Finding, counted, listed, moment, rounded};
use super::header::FileKind;
use super::names::{Meaning, is_frame, is_time};
use super::table::Table;
use super::units::Unit;
use super::write::Column;

/// Where the times of a table come from.
#[derive(Clone, Debug, PartialEq, Default)]
pub enum Clock {
    /// The column that is called a time, in the unit of its header, seconds without one.
    #[default]
    Detect,
    /// The column of that name.
    Column(String),
    /// Frames at that rate, in hertz: the column that numbers them, or one frame a row.
    FrameRate(f64),
}

/// How evenly samples follow each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Timing {
    /// Usual time from one sample to the next, s: the mean but for gaps, or the median of uneven
    /// times.
    pub interval: f64,
    /// Root mean square deviation from it, but for gaps, s.
    pub jitter: f64,
    /// Places where samples are missing; of uneven times those far longer than the ones beside.
    pub gaps: Vec<Gap>,
}

/// A place where rows are missing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// Time of the last sample before, s.
    pub start: f64,
    /// Time of the first one after, s.
    pub end: f64,
}

/// Intervals of so many usual ones are gaps.
const GAP: f64 = 1.5;
/// Intervals of uneven times that are so many times as long as both on either side are gaps.
const GAP_OF_UNEVEN: f64 = 10.0;
/// Part of all intervals that may be gaps in even times.
const GAPS: f64 = 0.05;

impl Timing {
    fn of(times: &[f64]) -> Self {
        let steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let middle = median(steps.clone());
        let is_uneven = are_uneven(&steps, middle);
        let is_gap = |index: &usize| {
            let beside = index.saturating_sub(2)..(index + 3).min(steps.len());
            let beside = beside.filter(|other| other != index);
            let longest = beside.map(|other| steps[other]).fold(0.0, f64::max);
            steps[*index] > GAP * middle
                && (!is_uneven || steps[*index] > GAP_OF_UNEVEN * longest.max(middle))
        };
        let (gaps, usual): (Vec<usize>, Vec<usize>) = (0..steps.len()).partition(is_gap);
        let count = usual.len().max(1) as f64;
        let interval = match is_uneven {
            true => middle,
            false => usual.iter().map(|&index| steps[index]).sum::<f64>() / count,
        };
        let square = |&index: &usize| (steps[index] - interval).powi(2);
        Self {
            interval,
            jitter: (usual.iter().map(square).sum::<f64>() / count).sqrt(),
            gaps: gaps
                .iter()
                .map(|&index| Gap {
                    start: times[index],
                    end: times[index + 1],
                })
                .collect(),
        }
    }

    /// Returns true if rows are missing between two times of samples.
    pub(crate) fn has_gap(&self, from: f64, to: f64) -> bool {
        let next = self.gaps.partition_point(|gap| gap.start < from);
        self.gaps.get(next).is_some_and(|gap| gap.end <= to)
    }

    /// The rate or the unevenness, and the gaps.
    fn findings(&self, times: &[f64]) -> [Option<Finding>; 2] {
        let steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let text = if are_uneven(&steps, self.interval) {
            let shortest = steps.iter().copied().fold(f64::INFINITY, f64::min);
            let longest = steps.iter().copied().fold(0.0, f64::max);
            let [shortest, longest, usual] =
                [shortest, longest, self.interval].map(|step| rounded(step, 3));
            format!(
                "uneven times, {shortest} s to {longest} s apart, half of them less than {usual} s"
            )
        } else {
            let rate = rounded(1.0 / self.interval, 6);
            let percent = 100.0 * self.jitter / self.interval;
            format!("{rate} samples a second, intervals even to {percent:.2} % (rms)")
        };
        let gaps = self.gaps.iter().map(|Gap { start, end }| {
            let [start, end] = [*start, *end].map(|time| moment(time, self.interval));
            format!("{start} and {end}")
        });
        let gaps = (gaps.len() > 0).then(|| format!("no rows between {}", listed(gaps)));
        [Some(text), gaps].map(|text| Some(Finding::new(Basis::Detected, text?)))
    }
}

/// Returns true if too many intervals are long for gaps, and few of those are several usual ones, as
/// they are where single rows are lost.
fn are_uneven(steps: &[f64], usual: f64) -> bool {
    let long = || {
        steps
            .iter()
            .map(|step| step / usual)
            .filter(|&part| part > GAP)
    };
    let lost = long().filter(|part| (part - part.round()).abs() < 0.1);
    let (long, lost) = (long().count(), lost.count());
    long as f64 > GAPS * steps.len() as f64 && 2 * lost < long
}

/// Returns the middle value, 0 of none.
pub(crate) fn median(values: Vec<f64>) -> f64 {
    quantile(values, 0.5)
}

/// Returns the value that such a part of all is below, 0 of none.
pub(crate) fn quantile(mut values: Vec<f64>, part: f64) -> f64 {
    let place = (part * values.len() as f64) as usize;
    if place >= values.len() {
        return 0.0;
    }
    *values.select_nth_unstable_by(place, f64::total_cmp).1
}

/// Times of a table's rows, the column that they stand in, and what was found.
pub(crate) struct Times {
    pub(crate) seconds: Vec<f64>,
    pub(crate) column: Option<usize>,
    pub(crate) timing: Timing,
    pub(crate) findings: Vec<Finding>,
}

/// Smallest number of rows that make a motion.
const ROWS: usize = 3;

impl Times {
    pub(crate) fn read(table: &Table, clock: &Clock) -> Result<Self, ReadError> {
        if table.rows() < ROWS {
            // A quotation mark that is not closed takes rows in.
            for column in 0..table.columns().len() {
                table.values(column)?;
            }
            let (found, needed) = (table.rows(), ROWS);
            return Err(table.refused(ReadErrorKind::TooFewRows { found, needed }));
        }
        let mut findings = Vec::new();
        let (column, scale) = source(table, clock, &mut findings)?;
        let mut seconds: Vec<f64> = Vec::with_capacity(table.rows());
        for (row, time) in raw(table, column)?.into_iter().enumerate() {
            let time =
                time.ok_or_else(|| table.refused_at(ReadErrorKind::TimeMissing, row, column))?;
            let time = time * scale;
            if let Some(&previous) = seconds.last()
                && !(time > previous && time.is_finite())
            {
                let kind = ReadErrorKind::TimeOrder { previous, time };
                return Err(table.refused_at(kind, row, column));
            }
            seconds.push(time);
        }
        let timing = Timing::of(&seconds);
        findings.extend(timing.findings(&seconds).into_iter().flatten());
        Ok(Self {
            seconds,
            column,
            timing,
            findings,
        })
    }
}

/// The column that the times stand in, none for one a row, and their unit in seconds.
fn source(
    table: &Table,
    clock: &Clock,
    findings: &mut Vec<Finding>,
) -> Result<(Option<usize>, f64), ReadError> {
    let (column, basis) = match clock {
        Clock::FrameRate(rate) => return frames(table, *rate, findings),
        Clock::Column(name) => (table.column(name)?, Basis::Given),
        Clock::Detect => (time_column(table)?, Basis::Detected),
    };
    Ok((Some(column), unit(table, column, basis, findings)?))
}

/// Times of the rows, in the unit of their column.
fn raw(table: &Table, column: Option<usize>) -> Result<Vec<Option<f64>>, ReadError> {
    Ok(match column {
        Some(column) => table.values(column)?.to_vec(),
        None => (0..table.rows()).map(|row| Some(row as f64)).collect(),
    })
}

/// Which row counts of those with one time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Repeated {
    /// The first.
    First,
    /// The last.
    Last,
}

impl Table {
    /// Returns the table with one row of those that follow each other with one time.
    ///
    /// # Errors
    /// Errors of a time that cannot be made out.
    pub fn without_repeated_times(
        mut self,
        clock: &Clock,
        counts: Repeated,
    ) -> Result<Self, ReadError> {
        let (column, _) = source(&self, clock, &mut Vec::new())?;
        let times = raw(&self, column)?;
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
        self.tell(Finding::new(Basis::Given, text));
        Ok(self.keeping(&is_kept))
    }
}

impl Table {
    /// Returns the table with nothing measured in stretches of time, from and to (s), ends
    /// included; the times of their rows stay.
    ///
    /// # Errors
    /// Errors of a time that cannot be made out; [`ReadErrorKind::Option`] of a stretch without rows.
    pub fn leaving_out(mut self, clock: &Clock, stretches: &[[f64; 2]]) -> Result<Self, ReadError> {
        let (column, scale) = source(&self, clock, &mut Vec::new())?;
        let times = raw(&self, column)?;
        let times: Vec<f64> = times
            .iter()
            .map(|time| time.map_or(f64::NAN, |time| scale * time))
            .collect();
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
            self.tell(Finding::new(Basis::Given, text));
            self.empty(&is_left_out, column);
        }
        Ok(self)
    }
}

/// The column that numbers frames, if there is one, and the time of a frame.
fn frames(
    table: &Table,
    rate: f64,
    findings: &mut Vec<Finding>,
) -> Result<(Option<usize>, f64), ReadError> {
    if !(rate.is_finite() && rate > 0.0) {
        return Err(table.refused(ReadErrorKind::FrameRate { value: rate }));
    }
    let columns = table.columns();
    let counts = |&column: &usize| is_frame(&columns[column]) && table.has_numbers(column);
    let column = (0..columns.len()).find(counts);
    let mut text = match column {
        Some(column) => format!("`{}` counts frames, {rate} a second", columns[column].name),
        None => format!("each row is a frame, {rate} a second"),
    };
    let of_time = |column: &&Column| Meaning::of(column, columns) == Meaning::Time;
    if let Some(time) = columns.iter().find(of_time) {
        text += &format!(", whatever `{}` says", time.name);
    }
    findings.push(Finding::new(Basis::Given, text));
    Ok((column, 1.0 / rate))
}

/// The column that is called a time; one without names is the first.
fn time_column(table: &Table) -> Result<usize, ReadError> {
    let named = table
        .columns()
        .iter()
        .position(|column| is_time(&column.name));
    if let Some(column) = named {
        return Ok(column);
    }
    let frame = table.columns().iter().find(|column| is_frame(column));
    if let Some(column) = frame {
        let name = column.name.clone();
        return Err(table.refused(ReadErrorKind::FrameNumbers { name }));
    }
    let in_seconds = |unit: &str| seconds(unit).is_some();
    let by_unit = table
        .columns()
        .iter()
        .position(|column| in_seconds(&column.unit));
    let bare = table.kind() == FileKind::Wide && table.columns()[0].name == "column 1";
    by_unit
        .or(bare.then_some(0))
        .ok_or_else(|| table.refused(ReadErrorKind::NoTime))
}

fn seconds(unit: &str) -> Option<f64> {
    match Unit::named(unit) {
        Some(Unit::Time(seconds)) => Some(seconds),
        _ => None,
    }
}

/// The unit of a column of times, in seconds. Whole numbers may be frames, some of them
/// dropped or skipped, unless their unit is named.
fn unit(
    table: &Table,
    column: usize,
    basis: Basis,
    findings: &mut Vec<Finding>,
) -> Result<f64, ReadError> {
    let (name, unit) = (&table.columns()[column].name, &table.columns()[column].unit);
    if unit.is_empty() {
        let mut values = table.values(column)?.iter().flatten();
        if values.all(|value| value.fract() == 0.0) {
            let name = name.clone();
            return Err(table.refused(ReadErrorKind::WholeTimes { name }));
        }
        findings.push(Finding::new(basis, format!("`{name}` is the time")));
        let text = format!("`{name}` is in seconds, since its header names no unit");
        findings.push(Finding::new(Basis::Assumed, text));
        return Ok(1.0);
    }
    let scale = seconds(unit).ok_or_else(|| {
        table.refused(ReadErrorKind::Unit {
            name: name.clone(),
            unit: unit.clone(),
            quantity: "time",
        })
    })?;
    findings.push(Finding::new(
        basis,
        format!("`{name}` is the time, in {unit}"),
    ));
    Ok(scale)
}
