//! Why a file of measurements was not read.

use core::fmt;
use std::io;
use std::path::PathBuf;

use super::cell::hint;
use super::finding::counted;

/// A place in a file: line and column counted from 1, and the column's name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Line of the file.
    pub line: u64,
    /// Number of the cell in that line; none where the whole line is meant.
    pub column: Option<usize>,
    /// Name of the column, where it has one.
    pub name: Option<String>,
}

impl Place {
    pub(crate) fn line(line: u64) -> Self {
        Self {
            line,
            column: None,
            name: None,
        }
    }

    pub(crate) fn cell(line: u64, index: usize, name: Option<&str>) -> Self {
        Self {
            line,
            column: Some(index + 1),
            name: name.map(str::to_owned),
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { line, column, name } = self;
        write!(f, "line {line}")?;
        if let Some(column) = column {
            write!(f, ", column {column}")?;
        }
        if let Some(name) = name {
            write!(f, " (`{name}`)")?;
        }
        Ok(())
    }
}

/// A file that was not read: where, and why.
#[derive(Debug)]
pub struct ReadError {
    /// The file.
    pub path: PathBuf,
    /// Place in it, where there is one.
    pub place: Option<Place>,
    /// The reason.
    pub kind: Box<ReadErrorKind>,
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { path, place, kind } = self;
        write!(f, "{}", path.display())?;
        if let Some(place) = place {
            write!(f, ", {place}")?;
        }
        write!(f, ": {kind}")
    }
}

impl std::error::Error for ReadError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        std::error::Error::source(&self.kind)
    }
}

/// Reasons for which a file is not read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadErrorKind {
    /// The operating system refused.
    #[error("cannot be read")]
    Io(#[source] io::Error),
    /// Bytes that are no text.
    #[error("is no text but {what}; save it as text (UTF-8)")]
    NotText {
        /// Kind of the bytes.
        what: &'static str,
    },
    /// Text that is no table of numbers.
    #[error("is no table of numbers but {what}; {remedy}")]
    NotTable {
        /// Kind of the text.
        what: &'static str,
        /// How a table is made of it.
        remedy: &'static str,
    },
    /// Nothing but blank lines.
    #[error("is empty")]
    Empty,
    /// No line of numbers.
    #[error("has no line of numbers in at least two columns")]
    NoNumbers,
    /// Fewer rows of numbers than a motion needs.
    #[error("has {} of numbers; at least {needed} are needed", counted(*found, "row"))]
    TooFewRows {
        /// Number of rows.
        found: usize,
        /// Smallest number.
        needed: usize,
    },
    /// A cell that is neither a number nor one of the words for a missing one.
    #[error("`{text}` is no number{}", hint(text))]
    Number {
        /// The cell.
        text: String,
    },
    /// A number that is not finite.
    #[error("`{text}` is not finite; leave the cell of a missing value empty")]
    NotFinite {
        /// The cell.
        text: String,
    },
    /// A number with another unit than those above it, or than the header's.
    #[error("`{text}` is not in the unit of its column ({})", if unit.is_empty() { "none" } else { unit })]
    CellUnit {
        /// The cell.
        text: String,
        /// Unit of the column.
        unit: String,
    },
    /// A row with more or fewer cells than the header.
    #[error("{} where the table has {}", counted(*found, "cell"), counted(*expected, "column"))]
    CellCount {
        /// Number of columns.
        expected: usize,
        /// Number of cells.
        found: usize,
    },
    /// Rows of a header that do not fit each other.
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
    /// No column or track has that name.
    #[error("there is no {what} `{name}`{}; there are: {}", nearest(name, known), known.join(", "))]
    Unknown {
        /// Kind of thing: column or track.
        what: &'static str,
        /// The name.
        name: String,
        /// Names that there are.
        known: Vec<String>,
    },
    /// Nothing in the table tells the time.
    #[error("no column is the time; name it, or give the frame rate")]
    NoTime,
    /// A column that counts frames was about to be taken for seconds.
    #[error(
        "column `{name}` counts frames; give the frame rate (frames are never taken for seconds)"
    )]
    FrameNumbers {
        /// The column.
        name: String,
    },
    /// Times that are whole numbers of nothing: frames, or milliseconds.
    #[error(
        "column `{name}` holds whole numbers and names no unit; give the frame rate, or the unit \
         behind the name (frames are never taken for seconds)"
    )]
    WholeTimes {
        /// The column.
        name: String,
    },
    /// A frame rate that is no positive number.
    #[error("a frame rate of {value} Hz; it must be finite and positive")]
    FrameRate {
        /// The rate.
        value: f64,
    },
    /// A row without a time.
    #[error("the time is missing")]
    TimeMissing,
    /// A time that is not later than the one before.
    #[error("time {time} s does not come after {previous} s{}", repeated(*previous, *time))]
    TimeOrder {
        /// Time of the row before.
        previous: f64,
        /// Time of the row.
        time: f64,
    },
    /// No column is left for angles, or no tracks for markers.
    #[error("{what}")]
    Nothing {
        /// Name of the missing thing.
        what: String,
    },
    /// The unit of angles cannot be made out.
    #[error(
        "column `{name}` names no unit, and its values, up to {largest}, may be degrees or radians; say which"
    )]
    AngleUnit {
        /// The column.
        name: String,
        /// Largest magnitude.
        largest: f64,
    },
    /// A column that nobody named as one of angles is called like something else.
    #[error(
        "column `{name}` is called like {quantity}, not like an angle; name the columns of the \
         angles, or the points"
    )]
    NotAngle {
        /// The column.
        name: String,
        /// What its name is one of.
        quantity: &'static str,
    },
    /// An angle of more than 10^6 rad.
    #[error("an angle of `{name}` is {value} rad")]
    Angle {
        /// The link.
        name: String,
        /// The angle.
        value: f64,
    },
    /// Angles that jump too often to be those of a link.
    #[error(
        "`{name}` jumps in {count} of {measured} samples (first {first}): the frame rate is too low \
         for this motion, or it is no angle of a link"
    )]
    Jumps {
        /// The link.
        name: String,
        /// Number of samples that follow none before.
        count: usize,
        /// Number of all.
        measured: usize,
        /// Moments of the first ones.
        first: String,
    },
    /// A column's unit is none of an angle or of a time.
    #[error("column `{name}` is in `{unit}`, which is no unit of {quantity}")]
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

impl ReadErrorKind {
    pub(crate) fn at(self, path: impl Into<PathBuf>, place: Option<Place>) -> ReadError {
        ReadError {
            path: path.into(),
            place,
            kind: Box::new(self),
        }
    }
}

/// What helps where a time stands in two rows.
fn repeated(previous: f64, time: f64) -> &'static str {
    if time == previous {
        "; say which row of one time counts, the first or the last"
    } else {
        ""
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
