//! Tables of numbers, read from text files.

mod parsing;

use std::path::{Path, PathBuf};

use super::cell::DecimalMark;
use super::error::{ReadError, ReadErrorKind};
use super::finding::Finding;
use super::format::Delimiter;
use super::header::FileKind;
use super::names::{self, quoted};
use super::place::{Place, Sheet};
use super::track::Track;
use super::write::Column;

/// Known format of a file; fields that are `None` are detected.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct TableOptions {
    /// Separator of cells in a text file.
    pub delimiter: Option<Delimiter>,
    /// Decimal mark of the numbers.
    pub decimal: Option<DecimalMark>,
    /// Name of the sheet of a spreadsheet; the first sheet with numbers if it is `None`.
    pub sheet: Option<String>,
}

/// Table of numbers, some of which may be missing, and statements about how its file was read.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    path: PathBuf,
    /// Sheet of a spreadsheet; `None` for a text file.
    sheet: Option<Sheet>,
    kind: FileKind,
    columns: Vec<Column>,
    /// Names of the columns as in the file, including units.
    written: Vec<String>,
    tracks: Vec<Track>,
    values: Vec<Vec<Option<f64>>>,
    /// For each column, the first cell that is not a number, if there is one.
    faults: Vec<Option<Fault>>,
    lines: Vec<u64>,
    findings: Vec<Finding>,
}

/// A cell that is neither a number nor missing. It causes an error only if its column is used.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Fault {
    line: u64,
    text: String,
    why: Why,
}

/// Source of the unit of a column: the header, or each of its cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum UnitFrom {
    Nowhere,
    Header,
    Cells,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Why {
    NoNumber,
    Infinite,
    OtherUnit,
}

impl Table {
    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The kind of its header.
    pub fn kind(&self) -> FileKind {
        self.kind
    }

    /// Returns the names and units of the columns.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Returns the points whose two coordinates are columns; a single point without a name is
    /// `point`.
    pub fn tracks(&self) -> &[Track] {
        &self.tracks
    }

    /// Returns the number of rows.
    pub fn rows(&self) -> usize {
        self.lines.len()
    }

    /// Returns the values of a column, `None` for missing ones; empty if the column does not exist.
    ///
    /// # Errors
    /// [`ReadErrorKind::Number`], [`ReadErrorKind::NotFinite`] or [`ReadErrorKind::CellUnit`] with
    /// the position of the first cell of the column that is not a number.
    pub fn values(&self, column: usize) -> Result<&[Option<f64>], ReadError> {
        if let Some(Some(fault)) = self.faults.get(column) {
            let Column { name, unit } = &self.columns[column];
            let text = fault.text.clone();
            let kind = match fault.why {
                Why::NoNumber => ReadErrorKind::Number { text },
                Why::Infinite => ReadErrorKind::NotFinite { text },
                Why::OtherUnit => {
                    let unit = unit.clone();
                    ReadErrorKind::CellUnit { text, unit }
                }
            };
            let place = Place::cell(fault.line, column, Some(name));
            return Err(self.located(kind, Some(place)));
        }
        Ok(self.values.get(column).map_or(&[], Vec::as_slice))
    }

    /// Returns the name of a column with its unit, as in the header.
    pub(crate) fn written(&self, column: usize) -> &str {
        &self.written[column]
    }

    /// Returns true if a column contains at least one number.
    pub(crate) fn has_numbers(&self, column: usize) -> bool {
        self.values[column].iter().any(Option::is_some)
    }

    /// Returns the table with only the rows that are marked in `is_kept`.
    pub(crate) fn keeping(mut self, is_kept: &[bool]) -> Self {
        fn keep<T>(all: &mut Vec<T>, is_kept: &[bool]) {
            let mut kept = is_kept.iter();
            all.retain(|_| kept.next() != Some(&false));
        }
        for values in &mut self.values {
            keep(values, is_kept);
        }
        keep(&mut self.lines, is_kept);
        self
    }

    /// Removes the values in some rows, except in columns that `is_kept` accepts.
    pub(crate) fn empty(&mut self, rows: &[bool], is_kept: impl Fn(usize) -> bool) {
        for column in (0..self.values.len()).filter(|own| !is_kept(*own)) {
            let values = self.values[column].iter_mut().zip(rows);
            values.filter(|(_, row)| **row).for_each(|(v, _)| *v = None);
        }
    }

    /// Adds a statement about the table to the findings.
    pub(crate) fn add_finding(&mut self, finding: Finding) {
        self.findings.push(finding);
    }

    /// Facts detected and assumed.
    pub fn findings(&self) -> &[Finding] {
        &self.findings
    }

    /// Returns the index of the column with this name. The name may include the unit as in the
    /// header or not, and may contain `_` instead of blanks.
    ///
    /// # Errors
    /// [`ReadErrorKind::Unknown`] with the names of all columns.
    pub fn column(&self, name: &str) -> Result<usize, ReadError> {
        let columns = self.columns.iter().map(|column| column.name.as_str());
        let written = self.written.iter().map(String::as_str);
        called(name, columns.clone())
            .or_else(|| called(name, written))
            .ok_or_else(|| self.unknown("column", name, columns))
    }

    /// Returns the track with this name, which may contain `_` instead of blanks.
    ///
    /// # Errors
    /// [`ReadErrorKind::Unknown`] with the names of all tracks, or [`ReadErrorKind::Nothing`] if
    /// there are none.
    pub fn track(&self, name: &str) -> Result<&Track, ReadError> {
        let names = self.tracks.iter().map(|track| track.name.as_str());
        if let Some(index) = called(name, names.clone()) {
            return Ok(&self.tracks[index]);
        }
        if self.tracks.is_empty() {
            let columns: Vec<&str> = self.written.iter().map(String::as_str).collect();
            let what = format!(
                "there is no track `{name}`, nor another: the columns {} hold no NAME_x beside \
                 a NAME_y",
                quoted(&columns)
            );
            return Err(self.refused(ReadErrorKind::Nothing { what }));
        }
        Err(self.unknown("track", name, names))
    }

    fn unknown<'a>(
        &self,
        what: &'static str,
        name: &str,
        known: impl Iterator<Item = &'a str>,
    ) -> ReadError {
        let (name, known) = (name.to_owned(), known.map(str::to_owned).collect());
        self.refused(ReadErrorKind::Unknown { what, name, known })
    }

    /// Returns an error about the whole file.
    pub(crate) fn refused(&self, kind: ReadErrorKind) -> ReadError {
        self.located(kind, None)
    }

    /// Returns an error about a row, or about a cell in it.
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
        self.located(kind, Some(place))
    }

    /// Returns an error about a place in the file, or in the sheet of it.
    fn located(&self, kind: ReadErrorKind, place: Option<Place>) -> ReadError {
        ReadError {
            sheet: self.sheet.clone(),
            ..kind.at(&self.path, place)
        }
    }
}

/// Returns the index of a name in a list: an exact match, or the only match with blanks in place of
/// `_`.
fn called<'a>(name: &str, mut names: impl Iterator<Item = &'a str> + Clone) -> Option<usize> {
    let alike = names.clone().enumerate();
    let mut alike = alike.filter(|(_, other)| names::plain(other) == names::plain(name));
    let exact = names.position(|other| other == name);
    exact.or_else(|| match (alike.next(), alike.next()) {
        (Some((index, _)), None) => Some(index),
        _ => None,
    })
}
