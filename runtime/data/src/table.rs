//! Tables of numbers out of text files.

use std::fs;
use std::path::{Path, PathBuf};

use super::error::{Place, ReadError, ReadErrorKind};
use super::finding::{Basis, Finding, counted, listed};
use super::format::{DecimalMark, Delimiter, Entry, Format, TextLine};
use super::header::{FileKind, Header, Track};
use super::write::Column;

/// Knowledge of a caller about a file; fields that are `None` are detected.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct TableOptions {
    /// Separator of cells.
    pub delimiter: Option<Delimiter>,
    /// The mark between whole numbers and fractions.
    pub decimal: Option<DecimalMark>,
}

/// A table of numbers, some of them missing, and how its file was read.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    path: PathBuf,
    kind: FileKind,
    columns: Vec<Column>,
    tracks: Vec<Track>,
    values: Vec<Vec<Option<f64>>>,
    lines: Vec<u64>,
    findings: Vec<Finding>,
}

impl Table {
    /// Reads a file.
    ///
    /// # Errors
    /// [`ReadError`] with line and column: a file that cannot be opened, that is no text or
    /// has no numbers, a cell that is neither a number nor missing, a row of another number
    /// of cells.
    pub fn read(path: impl AsRef<Path>, options: &TableOptions) -> Result<Self, ReadError> {
        let path = path.as_ref();
        let refused = |kind: ReadErrorKind| kind.at(path, None);
        let bytes = fs::read(path).map_err(|source| refused(ReadErrorKind::Io(source)))?;
        let (text, finding) =
            decoded(bytes).map_err(|what| refused(ReadErrorKind::NotText { what }))?;
        let mut table = Self::parse(path, &text, options)?;
        table.findings.splice(0..0, finding);
        Ok(table)
    }

    /// Reads the text of a file; `path` stands for it in errors.
    ///
    /// # Errors
    /// Those of [`read`](Self::read).
    pub fn parse(
        path: impl AsRef<Path>,
        text: &str,
        options: &TableOptions,
    ) -> Result<Self, ReadError> {
        let path = path.as_ref();
        let refused = |kind: ReadErrorKind, place| kind.at(path, place);
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        if text.trim().is_empty() {
            return Err(refused(ReadErrorKind::Empty, None));
        }
        let format = Format::detect(text, options.delimiter, options.decimal)
            .ok_or_else(|| refused(ReadErrorKind::NoNumbers, None))?;
        let mut lines = format.lines(text).map_err(|error| {
            let place = error
                .position()
                .map(|position| Place::line(position.line()));
            let what = error.to_string();
            refused(ReadErrorKind::Header { what }, place)
        })?;
        let first = lines.iter().position(|line| is_row(line, format));
        let first = first.ok_or_else(|| refused(ReadErrorKind::NoNumbers, None))?;
        let width = width(&lines[first..]);
        let rows = lines.split_off(first);
        let header =
            Header::read(&lines, width).map_err(|error| refused(*error.kind, error.place))?;
        let mut table = Self {
            path: path.to_path_buf(),
            kind: header.kind,
            values: vec![Vec::with_capacity(rows.len()); width],
            columns: header.columns,
            tracks: header.tracks,
            lines: Vec::with_capacity(rows.len()),
            findings: Vec::new(),
        };
        for row in &rows {
            table.push(row, format)?;
        }
        table.describe(format, options, header.preamble, lines.is_empty());
        Ok(table)
    }

    /// Appends a row of a file.
    fn push(&mut self, row: &TextLine, format: Format) -> Result<(), ReadError> {
        let width = self.columns.len();
        let surplus = row.cells.get(width..).unwrap_or_default();
        let found = row.cells.len();
        if surplus.iter().any(|cell| !cell.is_empty()) || found < width {
            let place = Some(Place::line(row.number));
            let expected = width;
            return Err(ReadErrorKind::CellCount { expected, found }.at(&self.path, place));
        }
        for (index, (cell, values)) in row.cells.iter().zip(&mut self.values).enumerate() {
            // A quotation mark that is not closed takes the lines below in.
            let text = || match cell.split_once('\n') {
                Some((first, _)) => format!("\"{first}…"),
                None => cell.clone(),
            };
            let refused = match format.entry(cell) {
                Entry::Number(value) => {
                    values.push(Some(value));
                    continue;
                }
                Entry::Missing => {
                    values.push(None);
                    continue;
                }
                Entry::Infinite => ReadErrorKind::NotFinite { text: text() },
                Entry::Text => ReadErrorKind::Number { text: text() },
            };
            let name = &self.columns[index].name;
            let place = Place::cell(row.number, index, Some(name));
            return Err(refused.at(&self.path, Some(place)));
        }
        self.lines.push(row.number);
        Ok(())
    }

    fn describe(&mut self, format: Format, options: &TableOptions, preamble: usize, bare: bool) {
        let given = options.delimiter.is_some() && options.decimal.is_some();
        let basis = if given { Basis::Given } else { Basis::Detected };
        let mut tell = |basis, text: String| self.findings.push(Finding::new(basis, text));
        tell(basis, format.to_string());
        match self.kind {
            FileKind::Wide => {}
            FileKind::Tracker => tell(Basis::Detected, "an export of Tracker".to_owned()),
            FileKind::DeepLabCut => tell(Basis::Detected, "a table of DeepLabCut".to_owned()),
        }
        if preamble > 0 {
            let plural = if preamble == 1 { "line" } else { "lines" };
            tell(
                Basis::Detected,
                format!("{preamble} {plural} above the names of the columns"),
            );
        }
        if bare {
            tell(Basis::Detected, "no names of columns".to_owned());
        }
        if let Some(text) = self.missing() {
            self.findings.push(Finding::new(Basis::Detected, text));
        }
    }

    /// How many values are missing, a track counting as one column.
    fn missing(&self) -> Option<String> {
        let missing = |column: usize| self.values[column].iter().filter(|v| v.is_none()).count();
        let tracks = self.tracks.iter().map(|track| {
            let columns = [Some(track.x), Some(track.y), track.likelihood];
            let count = columns.into_iter().flatten().map(missing).max();
            (count.unwrap_or(0), &track.name)
        });
        let is_alone = |column: &usize| {
            let is_of =
                |t: &Track| t.x == *column || t.y == *column || t.likelihood == Some(*column);
            !self.tracks.iter().any(is_of)
        };
        let alone = (0..self.columns.len()).filter(is_alone);
        let alone = alone.map(|column| (missing(column), &self.columns[column].name));
        let told: Vec<String> = tracks
            .chain(alone)
            .filter(|(count, _)| *count > 0)
            .map(|(count, name)| format!("{count} of `{name}`"))
            .collect();
        let rows = counted(self.rows(), "row");
        (!told.is_empty())
            .then(|| format!("values missing in {rows}: {}", listed(told.into_iter())))
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The kind of its header.
    pub fn kind(&self) -> FileKind {
        self.kind
    }

    /// Names and units of the columns.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Points whose two coordinates are columns.
    pub fn tracks(&self) -> &[Track] {
        &self.tracks
    }

    /// Returns the number of rows.
    pub fn rows(&self) -> usize {
        self.lines.len()
    }

    /// The values of a column, `None` where they are missing; none for an index beyond.
    pub fn values(&self, column: usize) -> &[Option<f64>] {
        self.values.get(column).map_or(&[], Vec::as_slice)
    }

    /// Facts detected and assumed.
    pub fn findings(&self) -> &[Finding] {
        &self.findings
    }

    /// Returns the index of the column with that name.
    ///
    /// # Errors
    /// [`ReadErrorKind::Unknown`] with the names that there are.
    pub fn column(&self, name: &str) -> Result<usize, ReadError> {
        let index = self.columns.iter().position(|column| column.name == name);
        index.ok_or_else(|| {
            let known = self
                .columns
                .iter()
                .map(|column| column.name.clone())
                .collect();
            self.unknown("column", name, known)
        })
    }

    /// Returns the track with that name.
    ///
    /// # Errors
    /// [`ReadErrorKind::Unknown`] with the names that there are.
    pub fn track(&self, name: &str) -> Result<&Track, ReadError> {
        let track = self.tracks.iter().find(|track| track.name == name);
        track.ok_or_else(|| {
            let known = self.tracks.iter().map(|track| track.name.clone()).collect();
            self.unknown("track", name, known)
        })
    }

    fn unknown(&self, what: &'static str, name: &str, known: Vec<String>) -> ReadError {
        let name = name.to_owned();
        self.refused(ReadErrorKind::Unknown { what, name, known })
    }

    /// An error about the whole file.
    pub(crate) fn refused(&self, kind: ReadErrorKind) -> ReadError {
        kind.at(&self.path, None)
    }

    /// An error about a row, or a cell of it.
    pub(crate) fn refused_at(
        &self,
        kind: ReadErrorKind,
        row: usize,
        column: Option<usize>,
    ) -> ReadError {
        let line = self.lines.get(row).copied().unwrap_or_default();
        let place = match column {
            Some(index) => Place::cell(
                line,
                index,
                self.columns.get(index).map(|c| c.name.as_str()),
            ),
            None => Place::line(line),
        };
        kind.at(&self.path, Some(place))
    }
}

/// Returns true for a line of numbers and missing values.
fn is_row(line: &TextLine, format: Format) -> bool {
    let entries = || line.cells.iter().map(|cell| format.entry(cell));
    line.cells.len() >= 2
        && entries().any(|entry| matches!(entry, Entry::Number(_)))
        && entries().all(|entry| entry != Entry::Text)
}

/// Number of columns: that of the first row, without empty cells at its end that end all rows.
fn width(rows: &[TextLine]) -> usize {
    let used = |line: &TextLine| {
        line.cells
            .iter()
            .rposition(|cell| !cell.is_empty())
            .map_or(0, |last| last + 1)
    };
    let most = rows.iter().map(used).max().unwrap_or(0);
    let first = rows.first().map_or(0, |line| line.cells.len());
    most.min(first)
}

/// Text out of bytes: UTF-8, or Latin-1 where it is none.
fn decoded(bytes: Vec<u8>) -> Result<(String, Option<Finding>), &'static str> {
    match bytes.as_slice() {
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => return Err("UTF-16"),
        [b'P', b'K', 3, 4, ..] => return Err("a zip archive (a spreadsheet?)"),
        [0x89, b'H', b'D', b'F', ..] => return Err("HDF5"),
        bytes if bytes.contains(&0) => return Err("binary data"),
        _ => {}
    }
    Ok(match String::from_utf8(bytes) {
        Ok(text) => (text, None),
        Err(error) => {
            let text = error.into_bytes().into_iter().map(char::from).collect();
            let finding = Finding::new(Basis::Detected, "characters in Latin-1");
            (text, Some(finding))
        }
    })
}
