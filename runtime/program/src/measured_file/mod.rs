//! Files of measured angles, in the form that programs which analyse them read.

mod angles;
mod stretches;

use std::path::PathBuf;

use branched_pendulum_data::{AngleUnit, Table};
use clap::{Args, ValueEnum};

pub use self::angles::{MeasuredAngles, MeasuredLinks};
use crate::frame::command_line::{number, parts};

/// A file of angles or dots against time, and the options that say how to read it.
#[derive(Args, Clone, Debug, Default, PartialEq)]
pub struct MeasuredFile {
    /// file of measurements; without it, measurements are simulated
    #[arg(value_name = "FILE")]
    pub file: Option<PathBuf>,
    /// sheet of a spreadsheet; the first one with numbers without it
    #[arg(long, value_name = "NAME")]
    pub sheet: Option<String>,
    /// columns of the angles of the links, parent first; by default all columns that can be angles
    #[arg(long, value_name = "A,B,...", value_parser = names, default_value = "")]
    // By its full path, clap takes it for one value.
    pub columns: ::std::vec::Vec<String>,
    /// unit of angles whose columns do not name it: rad, deg, mrad, arcmin, arcsec, gon, turn, or
    /// counts:N for an encoder with N counts per turn
    #[arg(verbatim_doc_comment, long, value_name = "UNIT", value_parser = unit)]
    pub unit: Option<AngleUnit>,
    /// direction of angle 0; detected by default
    #[arg(long, value_enum, value_name = "WAY")]
    pub zero: Option<Zero>,
    /// dots of the links, UPPER:LOWER for each, instead of angles; a point that does not move is
    /// `origin` or X,Y, as in `origin:a,a:b`
    #[arg(verbatim_doc_comment, long, value_name = "U:L,...", value_parser = pairs, default_value = "")]
    pub dots: ::std::vec::Vec<(String, String)>,
    /// position of the pivot, X,Y or `origin`, if no dot is at it: the dots of the file are then
    /// the ends of a chain of links from it, in their order
    #[arg(verbatim_doc_comment, long, value_name = "X,Y", value_parser = place, allow_hyphen_values = true)]
    pub pivot: Option<[f64; 2]>,
    /// y of dots increases downwards, as rows of a picture do
    #[arg(long)]
    pub y_down: bool,
    /// y of dots grows upwards
    #[arg(long, conflicts_with = "y_down")]
    pub y_up: bool,
    /// angles of all links but the first are relative to the link from which they hang
    #[arg(long)]
    pub relative: bool,
    /// the measured angle of a link that hangs at rest, degrees from -180 to 180, if camera or
    /// encoder are not plumb
    #[arg(verbatim_doc_comment, long, value_name = "DEG", value_parser = number(-180.0..=180.0, "°"), allow_hyphen_values = true)]
    pub tilt: Option<f64>,
    /// a span of time in which all links hang at rest, s: the angles measured there define the
    /// direction of gravity, also if camera, dots or encoders are rotated
    #[arg(verbatim_doc_comment, long, value_name = "FROM:TO", value_parser = stretch, allow_hyphen_values = true)]
    pub rest: Option<[f64; 2]>,
    /// time at which the motion begins, s; by default it is detected if links are held at first
    #[arg(long, value_name = "S", value_parser = number(-1e9..=1e9, "s"), allow_hyphen_values = true)]
    pub from: Option<f64>,
    /// time at which the motion ends, s
    #[arg(long, value_name = "S", value_parser = number(-1e9..=1e9, "s"), allow_hyphen_values = true)]
    pub to: Option<f64>,
    /// spans of time that are left out, s
    #[arg(long, value_name = "FROM:TO,...", value_parser = stretches, default_value = "", allow_hyphen_values = true)]
    pub leave_out: ::std::vec::Vec<[f64; 2]>,
    /// name of the column of times, followed by its unit if the header does not contain it, as in
    /// `stamp [ns]`; by default the column is recognised by its name
    #[arg(
        verbatim_doc_comment,
        long,
        value_name = "COLUMN",
        conflicts_with = "frame_rate"
    )]
    pub time: Option<String>,
    /// pictures per second, 1 to 1e5; required for files that contain picture numbers instead of
    /// times
    #[arg(long, value_name = "HZ", value_parser = number(1.0..=1e5, "Hz"))]
    pub frame_rate: Option<f64>,
    /// drops rows that repeat a time, except the one that counts: by default the first
    #[arg(long, value_enum, value_name = "COUNTS", num_args = 0..=1, default_missing_value = "first")]
    pub drop_repeated: Option<Counts>,
    /// number of the recording to use, from 1, if the file contains several and the time starts
    /// again in each
    #[arg(long, value_name = "N")]
    pub recording: Option<usize>,
}

/// Direction of angle 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Zero {
    /// Hanging.
    Down,
    /// Standing.
    Up,
}

/// Which of several rows with the same time is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Counts {
    /// The first.
    First,
    /// The last.
    Last,
}

impl MeasuredFile {
    /// Names of the options that describe the file.
    pub const OPTIONS: [&str; 18] = [
        "sheet",
        "columns",
        "unit",
        "zero",
        "dots",
        "pivot",
        "y_down",
        "y_up",
        "relative",
        "tilt",
        "rest",
        "from",
        "to",
        "leave_out",
        "time",
        "frame_rate",
        "drop_repeated",
        "recording",
    ];

    /// Returns true if angles are computed from the dots of a table.
    pub fn is_of_dots(&self, table: &Table) -> bool {
        let of_columns =
            !self.columns.is_empty() || self.unit.is_some() || self.zero.is_some() || self.relative;
        !of_columns && !table.tracks().is_empty()
    }

    /// Returns true if angles are computed from the dots of a table, or from columns that are named
    /// as dots.
    fn takes_dots(&self, table: &Table) -> bool {
        let of_dots = !self.dots.is_empty() || self.pivot.is_some() || self.y_down || self.y_up;
        of_dots || self.is_of_dots(table)
    }

    /// Returns the dots of the links, UPPER and LOWER, as named or in the order of a table.
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

    /// Checks the options: options for angles cannot be combined with options for dots, and the
    /// motion must not end before it begins.
    ///
    /// # Errors
    /// A message about the options.
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
                "--pivot cannot be combined with --dots: give the pivot's position in --dots, as \
                 in `0,0:a,a:b`"
                    .into(),
            );
        }
        if let (Some(from), Some(to)) = (self.from, self.to)
            && from >= to
        {
            return Err(format!("--from {from} must be earlier than --to {to}"));
        }
        Ok(())
    }
}

fn names(text: &str) -> Result<Vec<String>, String> {
    Ok(parts(text).map(str::to_owned).collect())
}

/// Parses the short name of a unit of angles.
fn unit(text: &str) -> Result<AngleUnit, String> {
    AngleUnit::named(text).ok_or_else(|| {
        let words = AngleUnit::ALL.map(|(word, _)| word);
        format!(
            "a unit is {}, or counts:N of an encoder, N a turn",
            words.join(", ")
        )
    })
}

/// Parses a position, X,Y or `origin`.
fn place(text: &str) -> Result<[f64; 2], String> {
    let number = |part: &str| part.trim().parse().ok().filter(|x: &f64| x.is_finite());
    let place = match text.split_once(',') {
        Some((x, y)) => number(x).zip(number(y)).map(|(x, y)| [x, y]),
        None => (text == "origin").then_some([0.0; 2]),
    };
    place.ok_or_else(|| "two numbers with a comma between, X,Y, or `origin`".to_owned())
}

/// Reads a stretch of time.
fn stretch(text: &str) -> Result<[f64; 2], String> {
    let number = |part: &str| part.trim().parse().ok().filter(|x: &f64| x.is_finite());
    let ends = text.split_once(':');
    let ends = ends.and_then(|(from, to)| Some([number(from)?, number(to)?]));
    let ends = ends.filter(|[from, to]| from <= to);
    ends.ok_or_else(|| "two times with a colon between, the earlier first: FROM:TO".to_owned())
}

/// Reads stretches of time.
fn stretches(text: &str) -> Result<Vec<[f64; 2]>, String> {
    parts(text).map(stretch).collect()
}

/// Parses pairs of dots; the comma within a position X,Y does not separate pairs.
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
        false => Err("write two names separated by a colon for each link: UPPER:LOWER".to_owned()),
    }
}

#[cfg(test)]
mod tests;
