//! Writing of comma-separated values: one row of numbers and texts per sample.

use core::fmt;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Name and unit of a column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Name in the header.
    pub name: String,
    /// Unit; empty for none.
    pub unit: String,
}

impl Column {
    /// Creates the column `name` with the unit `unit`; an empty unit is left out of the header.
    pub fn new(name: impl Into<String>, unit: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            unit: unit.into(),
        }
    }
}

impl fmt::Display for Column {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, unit } = self;
        if unit.is_empty() {
            write!(f, "{name}")
        } else {
            write!(f, "{name} [{unit}]")
        }
    }
}

/// One cell of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Cell<'a> {
    /// A number, written with the fewest digits that read back as the same `f64`; a number that is
    /// infinite or NaN becomes an empty cell.
    Number(f64),
    /// A number of things.
    Count(u64),
    /// A text; in the file it is quoted if it contains commas, quotation marks or line breaks (RFC
    /// 4180).
    Text(&'a str),
}

impl From<f64> for Cell<'_> {
    fn from(value: f64) -> Self {
        Self::Number(value)
    }
}

impl From<&f64> for Cell<'_> {
    fn from(value: &f64) -> Self {
        Self::Number(*value)
    }
}

impl From<u64> for Cell<'_> {
    fn from(count: u64) -> Self {
        Self::Count(count)
    }
}

impl<'a> From<&'a str> for Cell<'a> {
    fn from(text: &'a str) -> Self {
        Self::Text(text)
    }
}

impl fmt::Display for Cell<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            // `Debug` writes very large and small numbers with an exponent,
            // where `Display` would write hundreds of zeros.
            Self::Number(value) if value.is_finite() => write!(f, "{value:?}"),
            Self::Number(_) => Ok(()),
            Self::Count(count) => write!(f, "{count}"),
            Self::Text(text) => f.write_str(text),
        }
    }
}

/// A CSV file that is being written.
///
/// The first line names the columns with their units, `theta_1 [rad]`; each
/// further line is a row of [`Cell`]s. Lines end with a line feed.
///
/// # Examples
///
/// ```
/// use branched_pendulum_data::{Cell, Column, CsvWriter};
///
/// let columns = [Column::new("method", ""), Column::new("time", "s"), Column::new("H", "J")];
/// let mut csv = CsvWriter::new(Vec::new(), "memory", &columns)?;
/// csv.row([Cell::from("8(5,3)"), 0.0.into(), 0.1.into()])?;
/// csv.row([Cell::from("Taylor"), 0.5.into(), 1e-9.into()])?;
/// let text = String::from_utf8(csv.finish()?).unwrap();
/// assert_eq!(text, "method,time [s],H [J]\n\"8(5,3)\",0.0,0.1\nTaylor,0.5,1e-9\n");
///
/// let path = std::env::temp_dir().join("branched-pendulum-csv-example.csv");
/// let mut csv = CsvWriter::create(&path, &columns[1..])?;
/// csv.row(&[0.5, 1e-9])?;
/// csv.finish()?;
/// # std::fs::remove_file(&path).unwrap();
/// # Ok::<(), branched_pendulum_data::CsvError>(())
/// ```
#[derive(Debug)]
pub struct CsvWriter<W: Write = BufWriter<File>> {
    path: PathBuf,
    file: csv::Writer<W>,
    columns: usize,
    rows: u64,
    empty: u64,
}

impl CsvWriter {
    /// Creates the file, or empties it if it exists, and writes its header. A writer that is
    /// dropped before [`CsvWriter::finish`] also writes its remaining data, but cannot report an
    /// error.
    ///
    /// # Errors
    ///
    /// [`CsvError::NoColumns`], or [`CsvError::Io`] if the file cannot be
    /// created or written.
    pub fn create(path: impl AsRef<Path>, columns: &[Column]) -> Result<Self, CsvError> {
        let path = path.as_ref();
        require_columns(path, columns)?;
        let file = File::create(path).map_err(|source| CsvError::io(path, "create", source))?;
        Self::new(BufWriter::new(file), path, columns)
    }
}

impl<W: Write> CsvWriter<W> {
    /// Starts a table in `file` by writing its header; `path` is the name of the file in errors.
    ///
    /// # Errors
    ///
    /// [`CsvError::NoColumns`], or [`CsvError::Io`] if it cannot be written.
    pub fn new(file: W, path: impl AsRef<Path>, columns: &[Column]) -> Result<Self, CsvError> {
        let path = path.as_ref();
        require_columns(path, columns)?;
        let mut writer = Self {
            path: path.to_path_buf(),
            file: csv::Writer::from_writer(file),
            columns: columns.len(),
            rows: 0,
            empty: 0,
        };
        writer.record(columns.iter().map(ToString::to_string))?;
        Ok(writer)
    }

    /// Writes one row.
    ///
    /// # Errors
    ///
    /// [`CsvError::ColumnCount`] unless there is one cell for each column;
    /// [`CsvError::Io`] if it cannot be written.
    pub fn row<'a, C: Into<Cell<'a>>>(
        &mut self,
        cells: impl IntoIterator<Item = C>,
    ) -> Result<(), CsvError> {
        let cells = cells.into_iter().map(Into::into);
        let cells: Vec<String> = cells.map(|cell: Cell<'_>| cell.to_string()).collect();
        if cells.len() != self.columns {
            return Err(CsvError::ColumnCount {
                path: self.path.clone(),
                row: self.rows,
                expected: self.columns,
                found: cells.len(),
            });
        }
        let empty = cells.iter().filter(|cell| cell.is_empty()).count();
        self.record(cells)?;
        self.rows += 1;
        self.empty += empty as u64;
        Ok(())
    }

    /// Returns the number of rows written, without the header.
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// Returns the number of empty cells written: numbers that are infinite or NaN, and empty
    /// texts.
    pub fn empty_cells(&self) -> u64 {
        self.empty
    }

    /// Writes the remaining data, and returns the underlying file.
    ///
    /// # Errors
    ///
    /// [`CsvError::Io`] if that fails.
    pub fn finish(self) -> Result<W, CsvError> {
        let Self { path, file, .. } = self;
        let written = file.into_inner().map_err(csv::IntoInnerError::into_error);
        let flushed = written.and_then(|mut file| file.flush().map(|()| file));
        flushed.map_err(|source| CsvError::io(&path, "write", source))
    }

    fn record(&mut self, cells: impl IntoIterator<Item = String>) -> Result<(), CsvError> {
        self.file.write_record(cells).map_err(|error| {
            // Records of one length each fail for no other reason.
            let source = match error.into_kind() {
                csv::ErrorKind::Io(source) => source,
                other => io::Error::other(format!("{other:?}")),
            };
            CsvError::io(&self.path, "write", source)
        })
    }
}

fn require_columns(path: &Path, columns: &[Column]) -> Result<(), CsvError> {
    if columns.is_empty() {
        return Err(CsvError::NoColumns {
            path: path.to_path_buf(),
        });
    }
    Ok(())
}

/// Reason why a CSV file could not be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CsvError {
    /// The operating system refused.
    #[error("cannot {action} {}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// `"create"` or `"write"`.
        action: &'static str,
        /// The system's error.
        source: io::Error,
    },
    /// A table without columns.
    #[error("the table for {} has no columns", path.display())]
    NoColumns {
        /// The file.
        path: PathBuf,
    },
    /// A row has more or fewer values than there are columns.
    #[error("row {row} of {} has {found} values, but the table has {expected} columns", path.display())]
    ColumnCount {
        /// The file.
        path: PathBuf,
        /// Index of the row.
        row: u64,
        /// Number of columns.
        expected: usize,
        /// Number of values given.
        found: usize,
    },
}

impl CsvError {
    fn io(path: &Path, action: &'static str, source: io::Error) -> Self {
        let path = path.to_path_buf();
        Self::Io {
            path,
            action,
            source,
        }
    }
}
