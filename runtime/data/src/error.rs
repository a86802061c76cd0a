//! Errors in reading a file of measurements.

use core::fmt;
use std::io;
use std::path::PathBuf;

use super::cell::hint;
use super::finding::{counted, rounded};
use super::place::{Place, Sheet};

/// Error in reading a file: its position and reason.
#[derive(Debug)]
pub struct ReadError {
    /// The file.
    pub path: PathBuf,
    /// Sheet of a spreadsheet; `None` for a text file.
    pub sheet: Option<Sheet>,
    /// Position in the file, if the error has one.
    pub place: Option<Place>,
    /// The reason.
    pub kind: Box<ReadErrorKind>,
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            path,
            sheet,
            place,
            kind,
        } = self;
        write!(f, "{}", path.display())?;
        match (sheet, place) {
            (Some(sheet), Some(place)) => write!(f, ", {}", sheet.position(place))?,
            (Some(sheet), None) => write!(f, ", {sheet}")?,
            (None, Some(place)) => write!(f, ", {place}")?,
            (None, None) => {}
        }
        write!(f, ": {kind}")
    }
}

impl std::error::Error for ReadError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        std::error::Error::source(&self.kind)
    }
}

/// Reason why a file could not be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadErrorKind {
    /// The operating system refused.
    #[error("cannot be read")]
    Io(#[source] io::Error),
    /// Bytes that are no text.
    #[error("is not text but {what}; save it as text (UTF-8)")]
    NotText {
        /// Kind of the bytes.
        what: &'static str,
    },
    /// A sheet of a spreadsheet cannot be read.
    #[error("sheet `{sheet}` cannot be read: {what}; save it as text (CSV)")]
    Sheet {
        /// Name of the sheet.
        sheet: String,
        /// The reason.
        what: String,
    },
    /// A sheet name was given for a text file, or a cell separator for a spreadsheet.
    #[error("{what}")]
    NotSpreadsheet {
        /// The option, and the kind of file that has it.
        what: &'static str,
    },
    /// The text is not a table of numbers.
    #[error("is not a table of numbers but {what}; {remedy}")]
    NotTable {
        /// Kind of the text.
        what: &'static str,
        /// How to convert it to a table.
        remedy: &'static str,
    },
    /// Nothing but blank lines.
    #[error("is empty")]
    Empty,
    /// No line of numbers.
    #[error("has no row with numbers in at least two columns")]
    NoNumbers,
    /// The table has fewer rows of numbers than a motion needs.
    #[error("has {} of numbers; at least {needed} rows are needed", counted(*found, "row"))]
    TooFewRows {
        /// Number of rows.
        found: usize,
        /// Smallest number.
        needed: usize,
    },
    /// A cell is neither a number nor one of the words for a missing value.
    #[error("`{text}` is not a number{}", hint(text))]
    Number {
        /// The cell.
        text: String,
    },
    /// A number is infinite or NaN.
    #[error("`{text}` is not finite; leave the cell of a missing value empty")]
    NotFinite {
        /// The cell.
        text: String,
    },
    /// A number has another unit than the numbers above it or the header.
    #[error("`{text}` has another unit than its column (unit of the column: {})", if unit.is_empty() { "none" } else { unit })]
    CellUnit {
        /// The cell.
        text: String,
        /// Unit of the column.
        unit: String,
    },
    /// A row has more or fewer cells than the header.
    #[error("the row has {}, but the table has {}", counted(*found, "cell"), counted(*expected, "column"))]
    CellCount {
        /// Number of columns.
        expected: usize,
        /// Number of cells.
        found: usize,
    },
    /// The rows of a header are inconsistent.
    #[error("{what}")]
    Header {
        /// The reason.
        what: String,
    },
    /// Two columns of one name.
    #[error("two columns are called `{name}`")]
    DuplicateColumn {
        /// The name.
        name: String,
    },
    /// Name of the column, if it has one.
    #[error("there is no {what} `{name}`{}; there are: {}", nearest(name, known), known.join(", "))]
    Unknown {
        /// Kind of the named thing: column or track.
        what: &'static str,
        /// The name.
        name: String,
        /// Names that there are.
        known: Vec<String>,
    },
    /// The table has no column of times.
    #[error("found no column of times; name the column of the time, or give the frame rate")]
    NoTime,
    /// A column that counts frames would be used as times in seconds.
    #[error(
        "column `{name}` counts frames; give the frame rate (frames are never taken for seconds)"
    )]
    FrameNumbers {
        /// The column.
        name: String,
    },
    /// Times are whole numbers without a unit: they may be frames or milliseconds.
    #[error(
        "column `{name}` holds whole numbers and names no unit; give the frame rate, or the name of \
         the column with its unit, as in `{name} [ms]` (frames are never taken for seconds)"
    )]
    WholeTimes {
        /// The column.
        name: String,
    },
    /// The frame rate is not positive and finite.
    #[error("the frame rate is {value} Hz; it must be finite and positive")]
    FrameRate {
        /// The rate.
        value: f64,
    },
    /// A row without a time.
    #[error("the time is missing")]
    TimeMissing,
    /// The table contains several recordings or tracks.
    #[error(
        "time {time} s does not come after {previous} s: the table holds {count} {}; take one of \
         them", succession(column.as_deref())
    )]
    Recordings {
        /// Time of the row before.
        previous: f64,
        /// Time of the row.
        time: f64,
        /// Number of recordings.
        count: usize,
        /// The column that numbers tracks whose rows alternate; `None` for recordings that follow
        /// each other.
        column: Option<String>,
    },
    /// Times are rounded to too few digits, although rows are evenly spaced.
    #[error(
        "several rows have the time {time} s because times are rounded: the rows are evenly spaced, \
         {rate} per second; give that frame rate"
    )]
    RoundedTimes {
        /// Time of the row.
        time: f64,
        /// Number of rows per second, with the digits that the times determine.
        rate: String,
    },
    /// A time is not later than the one before.
    #[error("time {time} s does not come after {previous} s{}", repeated(*previous, *time))]
    TimeOrder {
        /// Time of the row before.
        previous: f64,
        /// Time of the row.
        time: f64,
    },
    /// No column remains for angles, or no track for markers.
    #[error("{what}")]
    Nothing {
        /// Name of the missing thing.
        what: String,
    },
    /// The unit of angles cannot be determined.
    #[error(
        "column `{name}` names no unit, and its values, up to {largest}, may be {}; give the unit",
        angle_units(*counts)
    )]
    AngleUnit {
        /// The column.
        name: String,
        /// Largest magnitude.
        largest: f64,
        /// Counts per turn of an encoder that could have such values; `None` if the values are not
        /// whole numbers.
        counts: Option<u32>,
    },
    /// The name of a column that was not explicitly chosen suggests a quantity other than an angle.
    #[error(
        "the name of column `{name}` suggests {quantity}, not an angle; name the columns of the \
         angles, or the points"
    )]
    NotAngle {
        /// The column.
        name: String,
        /// Quantity that the name suggests.
        quantity: &'static str,
    },
    /// Angles without variance.
    #[error(
        "the angles of `{name}` never change: all {count} are {} rad, so they show no motion; name the \
         columns of links that move, or leave this one out",
        rounded(*value, 5)
    )]
    Still {
        /// The link.
        name: String,
        /// Number of its angles.
        count: usize,
        /// The angle, in rad.
        value: f64,
    },
    /// More columns could be angles than a tree may have links.
    #[error(
        "{found} {things} could be links, more than the {most} allowed; name the {things} of the links"
    )]
    TooWide {
        /// Number of columns or tracks.
        found: usize,
        /// Columns or tracks.
        things: &'static str,
        /// Largest number.
        most: usize,
    },
    /// The table does not fit into memory.
    #[error(
        "the {rows} rows of {} do not fit into the memory; split the file, or keep every tenth row",
        counted(*columns, "column")
    )]
    Memory {
        /// Number of rows.
        rows: usize,
        /// Number of columns.
        columns: usize,
    },
    /// An angle is larger than 10^6 rad.
    #[error(
        "an angle of `{name}` is {value} rad; at most ±1e6 rad is accepted: check the unit of the column"
    )]
    Angle {
        /// The link.
        name: String,
        /// The angle.
        value: f64,
    },
    /// Angles jump too often to be those of a link.
    #[error(
        "`{name}` jumps in {count} of {measured} samples (first {first}): the frame rate is too low \
         for this motion, or the column is not the angle of a link"
    )]
    Jumps {
        /// The link.
        name: String,
        /// Number of the cell in that line; `None` if the whole line is meant.
        count: usize,
        /// Number of all.
        measured: usize,
        /// Moments of the first ones.
        first: String,
    },
    /// The unit of a column is not a unit of angles, or not one of times.
    #[error("column `{name}` is in `{unit}`, which is not a unit of {quantity}")]
    Unit {
        /// The column.
        name: String,
        /// Unit of the column.
        unit: String,
        /// Angles or times.
        quantity: &'static str,
    },
    /// An option that is impossible.
    #[error("{what}")]
    Option {
        /// The reason.
        what: String,
    },
}

/// Lists the units that the values could have.
fn angle_units(counts: Option<u32>) -> String {
    match counts {
        Some(counts) => format!("degrees, radians or counts of an encoder ({counts} a turn)"),
        None => "degrees or radians".to_owned(),
    }
}

impl ReadErrorKind {
    pub(crate) fn at(self, path: impl Into<PathBuf>, place: Option<Place>) -> ReadError {
        ReadError {
            path: path.into(),
            sheet: None,
            place,
            kind: Box::new(self),
        }
    }
}

/// Describes how several recordings are arranged in one table.
fn succession(column: Option<&str>) -> String {
    match column {
        Some(column) => format!("tracks, numbered by `{column}`"),
        None => "recordings behind each other".to_owned(),
    }
}

/// Returns the remedy for a row whose time is not later than the one before.
fn repeated(previous: f64, time: f64) -> &'static str {
    if time == previous {
        "; say which row of one time counts, the first or the last"
    } else {
        "; correct this time, or remove the row"
    }
}

fn nearest(name: &str, known: &[String]) -> String {
    let near = known
        .iter()
        .map(|other| (strsim::damerau_levenshtein(name, other), other))
        .min_by_key(|(distance, _)| *distance);
    match near {
        Some((distance, other)) if 2 * distance <= other.chars().count() => {
            format!(" (did you mean `{other}`?)")
        }
        _ => String::new(),
    }
}
