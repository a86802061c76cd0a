//! Columns that contain the times of rows, and their units.

use super::error::{ReadError, ReadErrorKind};
use super::finding::{Basis, Finding};
use super::header::{self, FileKind};
use super::names::{Meaning, is_frame, is_time};
use super::table::Table;
use super::units::Unit;
use super::write::Column;

/// Source of the times of a table's rows.
#[derive(Clone, Debug, PartialEq, Default)]
pub enum Clock {
    /// The column whose name means time, in the unit of its header, or in seconds; or two columns,
    /// of whole seconds and of the fraction (`sec`, `nanosec`).
    #[default]
    Detect,
    /// The column with this name, or `NAME [unit]` for a column whose header states no unit.
    Column(String),
    /// Frames at this rate, in Hz: the column that numbers them, or one frame per row.
    FrameRate(f64),
}

/// Columns from which the time of a row is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TimeColumns {
    /// Column of the times or of the frame numbers; `None` for one frame per row.
    pub(crate) column: Option<usize>,
    /// Unit of that column, s.
    scale: f64,
    /// Column of the fraction of a second, and its unit in s; `None` if there is none.
    pub(crate) fraction: Option<(usize, f64)>,
}

impl TimeColumns {
    /// Finds the columns that contain the times.
    pub(crate) fn find(
        table: &Table,
        clock: &Clock,
        findings: &mut Vec<Finding>,
    ) -> Result<Self, ReadError> {
        let (column, unit, basis) = match clock {
            Clock::FrameRate(rate) => return frames(table, *rate, findings),
            Clock::Column(name) => {
                let (column, unit) = named(table, name)?;
                (column, unit, Basis::Given)
            }
            Clock::Detect => (time_column(table)?, None, Basis::Detected),
        };
        if unit.is_none()
            && let Some((fraction, size)) = fraction(table, column)?
        {
            let text = format!(
                "`{}` and `{}` together are the time",
                table.written(column),
                table.written(fraction)
            );
            findings.push(Finding::new(basis, text));
            return Ok(Self {
                column: Some(column),
                scale: 1.0,
                fraction: Some((fraction, size)),
            });
        }
        let scale = scale(table, column, unit.as_deref(), basis, findings)?;
        Ok(Self::single(Some(column), scale))
    }

    fn single(column: Option<usize>, scale: f64) -> Self {
        let fraction = None;
        Self {
            column,
            scale,
            fraction,
        }
    }

    /// Returns the times of all rows in seconds; `None` where a cell is missing.
    pub(crate) fn seconds(&self, table: &Table) -> Result<Vec<Option<f64>>, ReadError> {
        let Some(column) = self.column else {
            let rows = 0..table.rows();
            return Ok(rows.map(|row| Some(row as f64 * self.scale)).collect());
        };
        let whole = table.values(column)?.iter();
        let whole = whole.map(|value| value.map(|value| value * self.scale));
        let Some((fraction, size)) = self.fraction else {
            return Ok(whole.collect());
        };
        let parts = table.values(fraction)?.iter();
        let both = whole.zip(parts);
        Ok(both
            .map(|(whole, part)| Some(whole? + size * (*part)?))
            .collect())
    }

    /// Returns true if a column is one of those that contain the times.
    pub(crate) fn contain(&self, column: usize) -> bool {
        self.column == Some(column) || self.fraction.is_some_and(|(own, _)| own == column)
    }
}

/// Returns the column with this name, and the unit that is appended to the name: `stamp [ns]`.
fn named(table: &Table, name: &str) -> Result<(usize, Option<String>), ReadError> {
    let refused = match table.column(name) {
        Ok(column) => return Ok((column, None)),
        Err(refused) => refused,
    };
    let Column { name, unit } = header::column(name);
    match (table.column(&name), seconds(&unit)) {
        (Ok(column), Some(_)) => Ok((column, Some(unit))),
        _ => Err(refused),
    }
}

/// Returns the column that numbers frames, if there is one, and the duration of a frame.
fn frames(table: &Table, rate: f64, findings: &mut Vec<Finding>) -> Result<TimeColumns, ReadError> {
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
    if let Some(time) = ignored_times(table) {
        text += &format!(", whatever `{}` says", columns[time].name);
    }
    findings.push(Finding::new(Basis::Given, text));
    Ok(TimeColumns::single(column, 1.0 / rate))
}

/// Returns the column of times that is ignored because a frame rate is given, if there is one.
pub(crate) fn ignored_times(table: &Table) -> Option<usize> {
    let columns = table.columns();
    columns
        .iter()
        .position(|column| Meaning::of(column, columns) == Meaning::Time)
}

/// Returns the column whose name means time; in a table without names, the first column that is not
/// the number of a trial.
fn time_column(table: &Table) -> Result<usize, ReadError> {
    let columns = table.columns();
    if let Some(column) = columns.iter().position(|column| is_time(&column.name)) {
        return Ok(column);
    }
    if let Some(column) = columns.iter().find(|column| is_frame(column)) {
        let name = column.name.clone();
        return Err(table.refused(ReadErrorKind::FrameNumbers { name }));
    }
    let by_unit = columns
        .iter()
        .position(|column| seconds(&column.unit).is_some());
    if let Some(column) = by_unit {
        return Ok(column);
    }
    for column in 0..columns.len() {
        if fraction(table, column)?.is_some() {
            return Ok(column);
        }
    }
    if let Some(column) = columns.iter().position(is_unit_of_time) {
        return Ok(column);
    }
    let is_bare = table.kind() == FileKind::Wide && columns[0].name == "column 1";
    let first = (0..columns.len()).find(|&column| !is_trial(table, column));
    is_bare
        .then_some(first)
        .flatten()
        .ok_or_else(|| table.refused(ReadErrorKind::NoTime))
}

/// Returns true if the name of a column is a unit of time: `ms`, `µs`.
fn is_unit_of_time(column: &Column) -> bool {
    // A column `s` or `min` may be something else.
    const SHORTEST: usize = 2;
    let is_long = column.name.chars().count() >= SHORTEST && column.name != "min";
    column.unit.is_empty() && is_long && seconds(&column.name).is_some()
}

/// Returns true if a column contains whole numbers that mostly equal those in the row above, as the
/// number of a trial does.
fn is_trial(table: &Table, column: usize) -> bool {
    let Ok(values) = table.values(column) else {
        return false;
    };
    let equal = values.windows(2).filter(|pair| pair[0] == pair[1]).count();
    let is_whole = |value: &Option<f64>| value.is_none_or(|value| value.fract() == 0.0);
    2 * equal > values.len() && values.iter().all(is_whole)
}

/// Returns the column with the fractions of a second that belongs to a column of whole seconds, and
/// its unit in s: `nanosec` for `sec`, `tv_usec` for `tv_sec`.
fn fraction(table: &Table, whole: usize) -> Result<Option<(usize, f64)>, ReadError> {
    const WHOLE: [&str; 5] = ["seconds", "second", "secs", "sec", "s"];
    const PARTS: [(&[&str], f64); 3] = [
        (
            &[
                "nanoseconds",
                "nanosecond",
                "nanosecs",
                "nanosec",
                "nsecs",
                "nsec",
                "ns",
            ],
            1e-9,
        ),
        (
            &[
                "microseconds",
                "microsecond",
                "microsec",
                "usecs",
                "usec",
                "us",
            ],
            1e-6,
        ),
        (
            &[
                "milliseconds",
                "millisecond",
                "millisec",
                "msecs",
                "msec",
                "ms",
            ],
            1e-3,
        ),
    ];
    let name = table.written(whole).to_lowercase();
    let Some(ending) = WHOLE.iter().find(|ending| name.ends_with(**ending)) else {
        return Ok(None);
    };
    let stem = &name[..name.len() - ending.len()];
    let size = |column: usize| {
        let other = table.written(column).to_lowercase();
        let ending = other.strip_prefix(stem)?;
        let parts = PARTS.iter().find(|(names, _)| names.contains(&ending));
        parts.map(|(_, size)| *size)
    };
    let mut others = (0..table.columns().len()).filter(|other| *other != whole);
    let found = others.find_map(|column| Some((column, size(column)?)));
    let Some((column, size)) = found else {
        return Ok(None);
    };
    let is_whole = |value: &f64| value.fract() == 0.0;
    let is_part = |value: &f64| (0.0..1.0).contains(&(value * size));
    let fits = table.values(whole)?.iter().flatten().all(is_whole)
        && table.values(column)?.iter().flatten().all(is_part);
    Ok(fits.then_some((column, size)))
}

fn seconds(unit: &str) -> Option<f64> {
    match Unit::named(unit) {
        Some(Unit::Time(seconds)) => Some(seconds),
        _ => None,
    }
}

/// Returns the unit of a column of times, in seconds: the given one, or that of the header, or that
/// of whole numbers that can only be dates. Other whole numbers are rejected, because they may be
/// frame numbers.
fn scale(
    table: &Table,
    column: usize,
    given: Option<&str>,
    basis: Basis,
    findings: &mut Vec<Finding>,
) -> Result<f64, ReadError> {
    let own @ Column { name, unit } = &table.columns()[column];
    let unit = given.unwrap_or(match is_unit_of_time(own) && !is_time(name) {
        true => name,
        false => unit,
    });
    if unit.is_empty() {
        let values = || {
            table
                .values(column)
                .map(|all| all.iter().flatten().copied())
        };
        if values()?.all(|value| value.fract() == 0.0) {
            let clock = counter(name).or_else(|| date(values().ok()?));
            let (scale, words) = clock.ok_or_else(|| {
                let name = name.clone();
                table.refused(ReadErrorKind::WholeTimes { name })
            })?;
            let text = format!("`{name}` is the time, in {words}");
            findings.push(Finding::new(Basis::Detected, text));
            return Ok(scale);
        }
        findings.push(Finding::new(basis, format!("`{name}` is the time")));
        let text = format!("`{name}` is in seconds, since its header names no unit");
        findings.push(Finding::new(Basis::Assumed, text));
        return Ok(1.0);
    }
    let scale = seconds(unit).ok_or_else(|| {
        table.refused(ReadErrorKind::Unit {
            name: name.clone(),
            unit: unit.to_owned(),
            quantity: "time",
        })
    })?;
    findings.push(Finding::new(
        basis,
        format!("`{name}` is the time, in {unit}"),
    ));
    Ok(scale)
}

/// Returns the unit of times from the clock of a microcontroller, which is part of its name.
fn counter(name: &str) -> Option<(f64, &'static str)> {
    match name.to_lowercase().as_str() {
        "millis" => Some((1e-3, "milliseconds")),
        "micros" => Some((1e-6, "microseconds")),
        _ => None,
    }
}

/// Returns the unit in which all numbers are times since 1970 within the years 2001 to 2100.
fn date(values: impl Iterator<Item = f64>) -> Option<(f64, &'static str)> {
    const YEARS: std::ops::Range<f64> = 1e9..4.1e9;
    const UNITS: [(f64, &str); 4] = [
        (1.0, "seconds since 1970"),
        (1e-3, "milliseconds since 1970"),
        (1e-6, "microseconds since 1970"),
        (1e-9, "nanoseconds since 1970"),
    ];
    let ends = values.fold([f64::INFINITY, 0.0], |[least, most]: [f64; 2], value| {
        [least.min(value), most.max(value)]
    });
    let found = UNITS
        .iter()
        .find(|(size, _)| ends.iter().all(|end| YEARS.contains(&(end * size))));
    found.copied()
}
