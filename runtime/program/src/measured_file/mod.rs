//! Files of measured angles, as programs that analyse them take them.

mod angles;

use std::path::PathBuf;

use branched_pendulum_data::{AngleUnit, Table};
use clap::{Args, ValueEnum};

pub use self::angles::{MeasuredAngles, MeasuredLinks};
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
    /// a stretch of time in which all links hang at rest, s: what they show there is their direction
    /// of gravity, whatever camera, dots or encoders are turned by
    #[arg(verbatim_doc_comment, long, value_name = "FROM:TO", value_parser = stretch, allow_hyphen_values = true)]
    pub rest: Option<[f64; 2]>,
    /// time at which the motion begins, s; where links are held at first, it is found without it
    #[arg(long, value_name = "S", value_parser = number(-1e9..=1e9, "s"), allow_hyphen_values = true)]
    pub from: Option<f64>,
    /// time at which it ends, s
    #[arg(long, value_name = "S", value_parser = number(-1e9..=1e9, "s"), allow_hyphen_values = true)]
    pub to: Option<f64>,
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
    pub const OPTIONS: [&str; 16] = [
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
    ];

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

    /// Refuses options of angles beside those of dots, and a motion that ends before it begins.
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
        if let (Some(from), Some(to)) = (self.from, self.to)
            && from >= to
        {
            return Err(format!(
                "--from {from} is no earlier than --to {to}: nothing is left of the motion"
            ));
        }
        Ok(())
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
