//! Tables of numbers out of text files.

use std::fs;
use std::path::{Path, PathBuf};

use super::cell::{DecimalMark, Entry};
use super::error::{Place, ReadError, ReadErrorKind};
use super::finding::{Basis, Finding, counted, listed};
use super::format::{Delimiter, Format, TextLine};
use super::header::{FileKind, Header};
use super::names::{self, quoted};
use super::track::Track;
use super::units::{Unit, bare};
use super::write::Column;
use super::{rows, text};

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
    /// Names as they stand in the file, units included.
    written: Vec<String>,
    tracks: Vec<Track>,
    values: Vec<Vec<Option<f64>>>,
    /// Of each column the first cell that is no number, if there is one.
    faults: Vec<Option<Fault>>,
    lines: Vec<u64>,
    findings: Vec<Finding>,
}

/// A cell that is neither a number nor missing; it matters where its column is used.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Fault {
    line: u64,
    text: String,
    why: Why,
}

/// Where the unit of a column stands: in the header, or in each of its cells.
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
    /// Reads a file.
    ///
    /// # Errors
    /// [`ReadError`] with line and column: a file that cannot be opened, that is no text, no
    /// table or has no numbers, a row of another number of cells, two columns of one name.
    pub fn read(path: impl AsRef<Path>, options: &TableOptions) -> Result<Self, ReadError> {
        let path = path.as_ref();
        let refused = |kind: ReadErrorKind| kind.at(path, None);
        let bytes = fs::read(path).map_err(|source| refused(ReadErrorKind::Io(source)))?;
        let (text, finding) = text::decoded(bytes).map_err(refused)?;
        let mut table = Self::parse(path, &text, options)?;
        table.findings.splice(0..0, finding);
        Ok(table)
    }

    /// Reads the text of a file; `path` stands for it in errors.
    ///
    /// # Errors
    /// Errors of [`read`](Self::read).
    pub fn parse(
        path: impl AsRef<Path>,
        text: &str,
        options: &TableOptions,
    ) -> Result<Self, ReadError> {
        let path = path.as_ref();
        let refused = |kind: ReadErrorKind, place| kind.at(path, place);
        let text = text::plain(text).map_err(|kind| refused(kind, None))?;
        let format = Format::detect(&text, options.delimiter, options.decimal)
            .ok_or_else(|| refused(ReadErrorKind::NoNumbers, None))?;
        let mut lines = format.lines(&text).map_err(|error| {
            let place = error
                .position()
                .map(|position| Place::line(position.line()));
            let what = error.to_string();
            refused(ReadErrorKind::Header { what }, place)
        })?;
        let Some(first) = rows::first_row(&lines, format) else {
            let (kind, place) = rows::no_rows(&lines, format);
            return Err(refused(kind, place));
        };
        let width = rows::width(&lines[first..], lines[..first].last());
        let rows = lines.split_off(first);
        let header =
            Header::read(&lines, width).map_err(|error| refused(*error.kind, error.place))?;
        let mut table = Self {
            path: path.to_path_buf(),
            kind: header.kind,
            values: vec![Vec::with_capacity(rows.len()); width],
            faults: vec![None; width],
            columns: header.columns,
            written: header.written,
            tracks: header.tracks,
            lines: Vec::with_capacity(rows.len()),
            findings: Vec::new(),
        };
        let units = table.columns.iter().map(|c| match c.unit.as_str() {
            "" => UnitFrom::Nowhere,
            _ => UnitFrom::Header,
        });
        let mut units: Vec<UnitFrom> = units.collect();
        for row in &rows {
            table.push(row, format, &mut units)?;
        }
        table.describe(format, options, header.preamble, lines.is_empty());
        Ok(table)
    }

    /// Appends a row of a file.
    fn push(
        &mut self,
        row: &TextLine,
        format: Format,
        units: &mut [UnitFrom],
    ) -> Result<(), ReadError> {
        let width = self.columns.len();
        let surplus = row.cells.get(width..).unwrap_or_default();
        let found = row.cells.len();
        if surplus.iter().any(|cell| !cell.is_empty()) || found < width {
            let place = Some(Place::line(row.number));
            let expected = width;
            return Err(ReadErrorKind::CellCount { expected, found }.at(&self.path, place));
        }
        for (index, cell) in row.cells.iter().take(width).enumerate() {
            let column = &mut self.columns[index];
            let (value, why) = match format.entry(cell) {
                Entry::Number { value, unit } => {
                    if units[index] == UnitFrom::Nowhere {
                        units[index] = UnitFrom::Cells;
                        column.unit = bare(unit);
                    }
                    let own = || Unit::named(unit);
                    let fits = unit == column.unit
                        || unit.is_empty() && units[index] == UnitFrom::Header
                        || own().is_some() && own() == Unit::named(&column.unit);
                    match fits {
                        true => (Some(value), None),
                        false => (None, Some(Why::OtherUnit)),
                    }
                }
                Entry::Missing => (None, None),
                Entry::Infinite => (None, Some(Why::Infinite)),
                Entry::Text => (None, Some(Why::NoNumber)),
            };
            self.values[index].push(value);
            if let Some(why) = why {
                self.faults[index].get_or_insert_with(|| Fault {
                    line: row.number,
                    // A quotation mark that is not closed takes the lines below in.
                    text: match cell.split_once('\n') {
                        Some((first, _)) => format!("\"{first}…"),
                        None => cell.clone(),
                    },
                    why,
                });
            }
        }
        self.lines.push(row.number);
        Ok(())
    }

    fn describe(&mut self, format: Format, options: &TableOptions, preamble: usize, bare: bool) {
        let given = options.delimiter.is_some() && options.decimal.is_some();
        let basis = if given { Basis::Given } else { Basis::Detected };
        let mut told = vec![Finding::new(basis, format.to_string())];
        let mut tell = |text: String| told.push(Finding::new(Basis::Detected, text));
        match self.kind {
            FileKind::Wide => {}
            FileKind::Tracker => tell("an export of Tracker".to_owned()),
            FileKind::DeepLabCut => tell("a table of DeepLabCut".to_owned()),
        }
        if preamble > 0 {
            let lines = counted(preamble, "line");
            tell(format!("{lines} above the names of the columns"));
        }
        if bare {
            tell("no names of columns".to_owned());
        }
        let missing = self.missing();
        told.extend(missing.map(|text| Finding::new(Basis::Detected, text)));
        self.findings = told;
    }

    /// How many values are missing, a track counting as one column.
    fn missing(&self) -> Option<String> {
        let missing = |column: usize| match self.faults[column] {
            None => self.values[column].iter().filter(|v| v.is_none()).count(),
            Some(_) => 0,
        };
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

    /// Points whose two coordinates are columns; a single one without a name is `point`.
    pub fn tracks(&self) -> &[Track] {
        &self.tracks
    }

    /// Returns the number of rows.
    pub fn rows(&self) -> usize {
        self.lines.len()
    }

    /// Returns the values of a column, `None` where they are missing; none for an index beyond.
    ///
    /// # Errors
    /// [`ReadErrorKind::Number`], [`ReadErrorKind::NotFinite`] or [`ReadErrorKind::CellUnit`]
    /// with the place of the first cell of the column that is no number.
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
            return Err(kind.at(&self.path, Some(place)));
        }
        Ok(self.values.get(column).map_or(&[], Vec::as_slice))
    }

    /// Returns true for a column with a number in it.
    pub(crate) fn has_numbers(&self, column: usize) -> bool {
        self.values[column].iter().any(Option::is_some)
    }

    /// The same table without some of its rows.
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

    /// Takes the values of rows away, but for one column.
    pub(crate) fn empty(&mut self, rows: &[bool], but: Option<usize>) {
        for column in (0..self.values.len()).filter(|own| Some(*own) != but) {
            let values = self.values[column].iter_mut().zip(rows);
            values.filter(|(_, row)| **row).for_each(|(v, _)| *v = None);
        }
    }

    /// Adds a statement about the table.
    pub(crate) fn tell(&mut self, finding: Finding) {
        self.findings.push(finding);
    }

    /// Facts detected and assumed.
    pub fn findings(&self) -> &[Finding] {
        &self.findings
    }

    /// Returns the index of the column with that name: with its unit as it stands in the
    /// header or without, with `_` or blanks.
    ///
    /// # Errors
    /// [`ReadErrorKind::Unknown`] with the names that there are.
    pub fn column(&self, name: &str) -> Result<usize, ReadError> {
        let columns = self.columns.iter().map(|column| column.name.as_str());
        let written = self.written.iter().map(String::as_str);
        called(name, columns.clone())
            .or_else(|| called(name, written))
            .ok_or_else(|| self.unknown("column", name, columns))
    }

    /// Returns the track with that name, with `_` or blanks.
    ///
    /// # Errors
    /// [`ReadErrorKind::Unknown`] with the names that there are, or
    /// [`ReadErrorKind::Nothing`] where there are none.
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

/// The place of a name among others: as it stands, or else with blanks for `_` where this
/// leaves one.
fn called<'a>(name: &str, mut names: impl Iterator<Item = &'a str> + Clone) -> Option<usize> {
    let alike = names.clone().enumerate();
    let mut alike = alike.filter(|(_, other)| names::plain(other) == names::plain(name));
    let exact = names.position(|other| other == name);
    exact.or_else(|| match (alike.next(), alike.next()) {
        (Some((index, _)), None) => Some(index),
        _ => None,
    })
}
