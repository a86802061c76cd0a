//! Writing comma-separated values: one row of numbers a sample.

use core::fmt;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Name and unit of a column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Name, as it stands in the header.
    pub name: String,
    /// Unit; empty for none.
    pub unit: String,
}

impl Column {
    /// The column `name`, in `unit`; an empty unit is left out of the header.
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

/// A CSV file being written.
///
/// The first line names the columns with their units, `theta_1 [rad]`; each
/// further line is a row of numbers, written with the fewest digits that read
/// back as the same `f64`; `NaN`, `inf` and `-inf` stand for themselves. Lines
/// end with a line feed. Names that hold commas, quotes or line breaks are
/// quoted (RFC 4180).
///
/// # Examples
///
/// ```
/// use branched_pendulum::data::{Column, CsvWriter};
///
/// let path = std::env::temp_dir().join("branched-pendulum-csv-example.csv");
/// let mut csv = CsvWriter::create(&path, &[Column::new("time", "s"), Column::new("H", "J")])?;
/// csv.row(&[0.0, 0.1])?;
/// csv.row(&[0.5, 1e-9])?;
/// csv.finish()?;
/// let text = std::fs::read_to_string(&path).unwrap();
/// assert_eq!(text, "time [s],H [J]\n0.0,0.1\n0.5,1e-9\n");
/// # std::fs::remove_file(&path).unwrap();
/// # Ok::<(), branched_pendulum::data::CsvError>(())
/// ```
#[derive(Debug)]
pub struct CsvWriter {
    path: PathBuf,
    file: BufWriter<File>,
    columns: usize,
    rows: u64,
}

impl CsvWriter {
    /// Creates the file, or empties it if it exists, and writes its header.
    ///
    /// # Errors
    ///
    /// [`CsvError::NoColumns`], or [`CsvError::Io`] if the file cannot be
    /// created or written.
    pub fn create(path: impl AsRef<Path>, columns: &[Column]) -> Result<Self, CsvError> {
        let path = path.as_ref();
        if columns.is_empty() {
            return Err(CsvError::NoColumns {
                path: path.to_path_buf(),
            });
        }
        let file = File::create(path).map_err(|source| CsvError::io(path, "create", source))?;
        let mut writer = Self {
            path: path.to_path_buf(),
            file: BufWriter::new(file),
            columns: columns.len(),
            rows: 0,
        };
        let header: Vec<String> = columns
            .iter()
            .map(|column| quoted(column.to_string()))
            .collect();
        writer.write(|file| writeln!(file, "{}", header.join(",")))?;
        Ok(writer)
    }

    /// Writes one row.
    ///
    /// # Errors
    ///
    /// [`CsvError::ColumnCount`] unless there is one value for each column;
    /// [`CsvError::Io`] if it cannot be written.
    pub fn row(&mut self, values: &[f64]) -> Result<(), CsvError> {
        if values.len() != self.columns {
            return Err(CsvError::ColumnCount {
                path: self.path.clone(),
                row: self.rows,
                expected: self.columns,
                found: values.len(),
            });
        }
        self.write(|file| {
            for (column, value) in values.iter().enumerate() {
                let separator = if column == 0 { "" } else { "," };
                // `Debug` writes very large and small numbers with an exponent,
                // where `Display` would write hundreds of zeros.
                write!(file, "{separator}{value:?}")?;
            }
            writeln!(file)
        })?;
        self.rows += 1;
        Ok(())
    }

    /// Number of rows written, the header not counted.
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// Writes what is still in memory and closes the file. A writer that is
    /// dropped instead does so too, but cannot say if it failed.
    ///
    /// # Errors
    ///
    /// [`CsvError::Io`] if that fails.
    pub fn finish(mut self) -> Result<(), CsvError> {
        self.write(|file| file.flush())
    }

    fn write(
        &mut self,
        write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    ) -> Result<(), CsvError> {
        write(&mut self.file).map_err(|source| CsvError::io(&self.path, "write", source))
    }
}

fn quoted(text: String) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text
    }
}

/// Why a CSV file was not written.
#[derive(Debug)]
#[non_exhaustive]
pub enum CsvError {
    /// The operating system refused.
    Io {
        /// The file.
        path: PathBuf,
        /// `"create"` or `"write"`.
        action: &'static str,
        /// Message of the system.
        source: io::Error,
    },
    /// A table without columns.
    NoColumns {
        /// The file.
        path: PathBuf,
    },
    /// A row has more or fewer values than there are columns.
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
        Self::Io {
            path: path.to_path_buf(),
            action,
            source,
        }
    }
}

impl fmt::Display for CsvError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io {
                path,
                action,
                source: _,
            } => {
                write!(f, "cannot {action} {}", path.display())
            }
            Self::NoColumns { path } => write!(f, "no columns for {}", path.display()),
            Self::ColumnCount {
                path,
                row,
                expected,
                found,
            } => write!(
                f,
                "row {row} of {} has {found} values for {expected} columns",
                path.display()
            ),
        }
    }
}

impl std::error::Error for CsvError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Io { source, .. } => Some(source),
            Self::NoColumns { .. } | Self::ColumnCount { .. } => None,
        }
    }
}
