//! Files of measured angles, as programs that analyse them take them.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use branched_pendulum_data::{
    AngleColumns, AngleUnit, AngleZero, Basis, Clock, Finding, LinkMarkers, Markers, Recording,
    Repeated, Sample, Table, TableOptions, read_angles,
};
use clap::{Args, ValueEnum};

use crate::Failure;
use crate::frame::command_line::{number, parts};

/// A file of angles or of dots against time, and what is known of it.
#[derive(Args, Clone, Debug, Default, PartialEq)]
pub struct MeasuredFile {
    /// file of measurements; without it they are simulated
    #[arg(value_name = "FILE")]
    pub file: Option<PathBuf>,
    /// columns of the angles of the links, parent first; all that may be angles without it
    #[arg(long, value_name = "A,B,...", value_parser = names, default_value = "")]
    // By its full path, clap takes it for one value.
    pub columns: ::std::vec::Vec<String>,
    /// unit of angles whose columns do not name it
    #[arg(long, value_name = "UNIT", value_parser = unit())]
    pub unit: Option<AngleUnit>,
    /// direction of angle 0; detected without it
    #[arg(long, value_enum, value_name = "WAY")]
    pub zero: Option<Zero>,
    /// dots of the links, UPPER:LOWER for each, in place of angles; a place that does not move
    /// is `origin` or X,Y, as in `origin:a,a:b`
    #[arg(verbatim_doc_comment, long, value_name = "U:L,...", value_parser = pairs, default_value = "")]
    pub dots: ::std::vec::Vec<(String, String)>,
    /// place of the pivot, X,Y or `origin`, where no dot is at it: the dots of the file are the
    /// ends of a chain of links from it, in their order
    #[arg(verbatim_doc_comment, long, value_name = "X,Y", value_parser = place, allow_hyphen_values = true)]
    pub pivot: Option<[f64; 2]>,
    /// y of dots grows downwards, as rows of a picture
    #[arg(long)]
    pub y_down: bool,
    /// y of dots grows upwards
    #[arg(long, conflicts_with = "y_down")]
    pub y_up: bool,
    /// angles of all links but the first are counted from the links on which they hang
    #[arg(long)]
    pub relative: bool,
    /// the angle that a link shows which hangs at rest, degrees from -180 to 180: camera or
    /// encoder are not plumb
    #[arg(verbatim_doc_comment, long, value_name = "DEG", value_parser = number(-180.0..=180.0, "°"), allow_hyphen_values = true)]
    pub tilt: Option<f64>,
    /// stretches of time that are left out, s
    #[arg(long, value_name = "FROM:TO,...", value_parser = stretches, default_value = "", allow_hyphen_values = true)]
    pub leave_out: ::std::vec::Vec<[f64; 2]>,
    /// column of the times; found by its name without it
    #[arg(long, value_name = "COLUMN", conflicts_with = "frame_rate")]
    pub time: Option<String>,
    /// pictures a second, 1 to 1e5; needed for files that number them
    #[arg(long, value_name = "HZ", value_parser = number(1.0..=1e5, "Hz"))]
    pub frame_rate: Option<f64>,
    /// drops rows that repeat a time, but for the one that counts: the first without a value
    #[arg(long, value_enum, value_name = "COUNTS", num_args = 0..=1, default_missing_value = "first")]
    pub drop_repeated: Option<Counts>,
}

/// Direction of angle 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Zero {
    /// Hanging.
    Down,
    /// Standing.
    Up,
}

/// The row that counts of those with one time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Counts {
    /// The first.
    First,
    /// The last.
    Last,
}

impl MeasuredFile {
    /// Names of the options that say something of the file.
    pub const OPTIONS: [&str; 13] = [
        "columns",
        "unit",
        "zero",
        "dots",
        "pivot",
        "y_down",
        "y_up",
        "relative",
        "tilt",
        "leave_out",
        "time",
        "frame_rate",
        "drop_repeated",
    ];

    /// Reads `file` with what is known of it, as a pendulum whose links hang on these `parents`.
    ///
    /// # Errors
    /// [`Failure::Reading`] or [`Failure::Links`].
    pub fn read(&self, file: &Path, parents: &[Option<usize>]) -> Result<Recording, Failure> {
        self.angles(&Table::read(file, &TableOptions::default())?, parents)
    }

    /// Takes the angles of links that hang on these `parents` out of a table.
    ///
    /// # Errors
    /// Errors of [`read`](Self::read).
    pub fn angles(&self, table: &Table, parents: &[Option<usize>]) -> Result<Recording, Failure> {
        let links = parents.len();
        let clock = self.clock();
        let mut table = Cow::Borrowed(table);
        if let Some(counts) = self.drop_repeated {
            let counts = match counts {
                Counts::First => Repeated::First,
                Counts::Last => Repeated::Last,
            };
            table = Cow::Owned(table.into_owned().without_repeated_times(&clock, counts)?);
        }
        if !self.leave_out.is_empty() {
            table = Cow::Owned(table.into_owned().leaving_out(&clock, &self.leave_out)?);
        }
        let relative_to = self.relative.then(|| parents.to_vec());
        let columns = AngleColumns {
            clock: clock.clone(),
            columns: self.columns.clone(),
            unit: self.unit,
            zero: self.zero.map(|zero| match zero {
                Zero::Down => AngleZero::Down,
                Zero::Up => AngleZero::Up,
            }),
            relative_to: relative_to.unwrap_or_default(),
            ..AngleColumns::default()
        };
        let dots = self.dots.iter().cloned();
        let markers = Markers {
            clock,
            links: dots
                .map(|(upper, lower)| LinkMarkers { upper, lower })
                .collect(),
            pivot: self.pivot,
            y_down: (self.y_down || self.y_up).then_some(self.y_down),
            ..Markers::default()
        };
        let mut recording = read_angles(&table, &columns, &markers)?;
        let found = recording.links.len();
        if found != links {
            return Err(Failure::Links {
                path: table.path().to_path_buf(),
                found,
                needed: links,
            });
        }
        if let Some(tilt) = self.tilt {
            turn_back(&mut recording, tilt);
        }
        if !self.leave_out.is_empty() {
            trim(&mut recording);
        }
        Ok(recording)
    }

    /// Returns true where angles follow from the dots of a table.
    pub fn is_of_dots(&self, table: &Table) -> bool {
        let of_columns =
            !self.columns.is_empty() || self.unit.is_some() || self.zero.is_some() || self.relative;
        !of_columns && !table.tracks().is_empty()
    }

    /// The dots of the links, UPPER and LOWER, named or as they stand in a table.
    pub fn dots_of(&self, table: &Table) -> Vec<(String, String)> {
        if !self.dots.is_empty() {
            return self.dots.clone();
        }
        let tracks: Vec<&String> = table.tracks().iter().map(|track| &track.name).collect();
        match self.pivot {
            Some([x, y]) => {
                let pivot = format!("{x},{y}");
                let uppers = std::iter::once(&pivot).chain(tracks.iter().copied());
                let pairs = uppers.zip(&tracks);
                pairs.map(|(a, b)| (a.clone(), (*b).clone())).collect()
            }
            None => {
                let (pairs, _) = tracks.as_chunks::<2>();
                pairs
                    .iter()
                    .map(|[a, b]| ((*a).clone(), (*b).clone()))
                    .collect()
            }
        }
    }

    fn clock(&self) -> Clock {
        match (&self.time, self.frame_rate) {
            (Some(column), _) => Clock::Column(column.clone()),
            (None, Some(rate)) => Clock::FrameRate(rate),
            (None, None) => Clock::Detect,
        }
    }

    /// Refuses options of angles beside those of dots.
    ///
    /// # Errors
    /// A sentence about the options.
    pub fn check(&self) -> Result<(), String> {
        let of_columns = [
            ("--columns", !self.columns.is_empty()),
            ("--unit", self.unit.is_some()),
            ("--zero", self.zero.is_some()),
            ("--relative", self.relative),
        ];
        let of_dots = [
            ("--dots", !self.dots.is_empty()),
            ("--pivot", self.pivot.is_some()),
            ("--y-down", self.y_down),
            ("--y-up", self.y_up),
        ];
        let given = |options: &[(&'static str, bool)]| {
            let mut given = options.iter().filter(|(_, is_given)| *is_given);
            given.next().map(|(option, _)| *option)
        };
        let (columns, dots) = (given(&of_columns), given(&of_dots));
        if let (Some(columns), Some(dots)) = (columns, dots) {
            return Err(format!(
                "{dots} is of dots and {columns} of columns of angles: angles come from one of them"
            ));
        }
        if self.pivot.is_some() && !self.dots.is_empty() {
            return Err(
                "--pivot beside --dots: name its place among them, as in `0,0:a,a:b`".into(),
            );
        }
        Ok(())
    }
}

/// Counts angles from the direction that gravity has at `tilt` (degrees).
fn turn_back(recording: &mut Recording, tilt: f64) {
    let offset = tilt.to_radians();
    for sample in recording
        .links
        .iter_mut()
        .flat_map(|link| &mut link.samples)
    {
        match sample {
            Sample::Measured(angle) | Sample::Outlier(angle) | Sample::Unlikely(angle) => {
                *angle -= offset;
            }
            _ => {}
        }
    }
    recording.findings.push(Finding {
        basis: Basis::Given,
        text: format!("angles less {tilt}°, at which a link hangs at rest"),
    });
}

/// Begins and ends a recording with a time at which something was measured.
fn trim(recording: &mut Recording) {
    let is_measured = |row: &usize| {
        recording
            .links
            .iter()
            .any(|link| link.angle(*row).is_some())
    };
    let count = recording.times.len();
    let first = (0..count).find(is_measured).unwrap_or(count);
    let last = (0..count).rfind(is_measured).map_or(count, |last| last + 1);
    recording.times.truncate(last);
    recording.times.drain(..first);
    for link in &mut recording.links {
        link.samples.truncate(last);
        link.samples.drain(..first);
    }
}

fn names(text: &str) -> Result<Vec<String>, String> {
    Ok(parts(text).map(str::to_owned).collect())
}

/// Reads the short name of a unit of angles.
fn unit() -> impl clap::builder::TypedValueParser<Value = AngleUnit> {
    use clap::builder::TypedValueParser;
    let words = AngleUnit::ALL.map(|(word, _)| word);
    clap::builder::PossibleValuesParser::new(words).map(|word| {
        let found = AngleUnit::ALL.iter().find(|(own, _)| *own == word);
        found.map_or(AngleUnit::Radians, |(_, unit)| *unit)
    })
}

/// Reads a place, X,Y or `origin`.
fn place(text: &str) -> Result<[f64; 2], String> {
    let number = |part: &str| part.trim().parse().ok().filter(|x: &f64| x.is_finite());
    let place = match text.split_once(',') {
        Some((x, y)) => number(x).zip(number(y)).map(|(x, y)| [x, y]),
        None => (text == "origin").then_some([0.0; 2]),
    };
    place.ok_or_else(|| "two numbers with a comma between, X,Y, or `origin`".to_owned())
}

/// Reads stretches of time.
fn stretches(text: &str) -> Result<Vec<[f64; 2]>, String> {
    let number = |part: &str| part.trim().parse().ok().filter(|x: &f64| x.is_finite());
    let stretch = |part: &str| {
        let (from, to) = part.split_once(':')?;
        let [from, to] = [number(from)?, number(to)?];
        (from <= to).then_some([from, to])
    };
    let all = parts(text).map(stretch).collect::<Option<_>>();
    all.ok_or_else(|| "two times with a colon between, the earlier first: FROM:TO".to_owned())
}

/// Reads pairs of dots; the comma of a place X,Y parts no pairs.
fn pairs(text: &str) -> Result<Vec<(String, String)>, String> {
    let mut before = String::new();
    let mut pairs = Vec::new();
    for part in parts(text) {
        let Some((upper, lower)) = part.split_once(':') else {
            before = format!("{before}{part},");
            continue;
        };
        if upper.is_empty() || lower.is_empty() {
            before = part.to_owned();
            break;
        }
        pairs.push((std::mem::take(&mut before) + upper, lower.to_owned()));
    }
    match before.is_empty() {
        true => Ok(pairs),
        false => Err("two names with a colon between for each link: UPPER:LOWER".to_owned()),
    }
}

#[cfg(test)]
mod tests;
