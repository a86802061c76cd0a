//! Conversion of the text of a file to a table.

use std::collections::{BTreeSet, TryReserveError};
use std::fs;
use std::ops::ControlFlow;
use std::path::Path;

use super::{Fault, Table, TableOptions, UnitFrom, Why};
use crate::cell::Entry;
use crate::error::{ReadError, ReadErrorKind};
use crate::finding::{Basis, Finding, counted, listed};
use crate::format::{Delimiter, Format, Line, TextLine, used};
use crate::header::{FileKind, Header};
use crate::place::{Place, Sheet};
use crate::spreadsheet::{self, SheetText};
use crate::track::Track;
use crate::units::{Unit, bare};
use crate::{rows, text};

/// Numbers of lines and cells in which the first row is searched for: at first, and at most, if it
/// is not among them.
const HEAD: [usize; 2] = [2_000, 1_000_000];
const LONG_HEAD: [usize; 2] = [1_000_000, 10_000_000];

/// Beginning and number of the rows of a text.
struct Outline {
    /// The lines above them.
    above: Vec<TextLine>,
    /// Number, in the file, of the line with the first row.
    start: u64,
    /// Number of columns of the first row, without columns at its end that are empty in all rows
    /// and in the header.
    width: usize,
    /// Number of lines from the first row to the end.
    rows: usize,
}

impl Outline {
    fn of(text: &str, format: Format) -> Result<Self, (ReadErrorKind, Option<Place>)> {
        let in_file = |error: csv::Error| unreadable(&error);
        let mut head = format.head(text, HEAD).map_err(in_file)?;
        let mut first = rows::first_row(&head, format);
        if first.is_none() {
            head = format.head(text, LONG_HEAD).map_err(in_file)?;
            first = rows::first_row(&head, format);
        }
        let Some(first) = first else {
            return Err(rows::no_rows(&head, format));
        };
        let (start, cells) = (head[first].number, head[first].cells.len());
        head.truncate(first);
        let mut most = head.last().map_or(0, |line| used(&line.cells));
        let mut rows = 0;
        let visited = format.each_line(text, |line| {
            if line.number >= start {
                most = most.max(used(&line.cells));
                rows += 1;
            }
            ControlFlow::Continue(())
        });
        visited.map_err(in_file)?;
        Ok(Self {
            above: head,
            start,
            width: most.min(cells),
            rows,
        })
    }
}

/// Returns the error for a text whose lines cannot be split into cells.
fn unreadable(error: &csv::Error) -> (ReadErrorKind, Option<Place>) {
    let place = error.position();
    let place = place.map(|position| Place::line(position.line()));
    let what = error.to_string();
    (ReadErrorKind::Header { what }, place)
}

impl Table {
    /// Reads a table from a file.
    ///
    /// # Errors
    /// [`ReadError`] with line and column: the file cannot be opened, is not text, is not a table
    /// or has no numbers, a row has a wrong number of cells, or two columns have the same name.
    pub fn read(path: impl AsRef<Path>, options: &TableOptions) -> Result<Self, ReadError> {
        let path = path.as_ref();
        let refused = |kind: ReadErrorKind| kind.at(path, None);
        let bytes = fs::read(path).map_err(|source| refused(ReadErrorKind::Io(source)))?;
        if spreadsheet::is_workbook(&bytes) {
            return Self::of_workbook(path, &bytes, options);
        }
        if options.sheet.is_some() {
            let what = "is a file of text, which has no sheets; leave the sheet out";
            return Err(refused(ReadErrorKind::NotSpreadsheet { what }));
        }
        let (text, finding) = text::decoded(bytes).map_err(refused)?;
        let mut table = Self::parse(path, &text, options)?;
        table.findings.splice(0..0, finding);
        Ok(table)
    }

    /// Reads a sheet of a spreadsheet.
    fn of_workbook(path: &Path, bytes: &[u8], options: &TableOptions) -> Result<Self, ReadError> {
        let refused = |kind: ReadErrorKind| kind.at(path, None);
        if options.delimiter.is_some() {
            let what = "is a spreadsheet, which has no separator of cells; leave the separator out";
            return Err(refused(ReadErrorKind::NotSpreadsheet { what }));
        }
        let read = spreadsheet::read(bytes, options.sheet.as_deref(), options.decimal);
        let SheetText {
            sheet,
            text,
            decimal,
            finding,
        } = read.map_err(refused)?;
        let as_text = TableOptions {
            delimiter: Some(Delimiter::Tab),
            decimal: Some(decimal),
            sheet: None,
        };
        let mut table = Self::parsed(path, Some(sheet), &text, &as_text)?;
        // Tabs and decimal marks are those of the conversion.
        table
            .findings
            .retain(|finding| finding.basis != Basis::Given);
        table.findings.insert(0, finding);
        Ok(table)
    }

    /// Reads a table from a text; `path` is the name of the file in errors.
    ///
    /// # Errors
    /// Errors of [`read`](Self::read).
    pub fn parse(
        path: impl AsRef<Path>,
        text: &str,
        options: &TableOptions,
    ) -> Result<Self, ReadError> {
        Self::parsed(path.as_ref(), None, text, options)
    }

    /// Parses the text of a file, or of a sheet of it.
    fn parsed(
        path: &Path,
        sheet: Option<Sheet>,
        text: &str,
        options: &TableOptions,
    ) -> Result<Self, ReadError> {
        let refused = |kind: ReadErrorKind, place: Option<Place>| {
            let sheet = sheet.clone();
            ReadError {
                sheet,
                ..kind.at(path, place)
            }
        };
        let text = text::plain(text).map_err(|kind| refused(kind, None))?;
        let format = Format::detect(&text, options.delimiter, options.decimal)
            .ok_or_else(|| refused(ReadErrorKind::NoNumbers, None))?;
        let outline = Outline::of(&text, format).map_err(|(kind, place)| refused(kind, place))?;
        let width = outline.width;
        let header = Header::read(&outline.above, width, format.delimiter)
            .map_err(|error| refused(*error.kind, error.place))?;
        let memory = |_: TryReserveError| {
            let (rows, columns) = (outline.rows, width);
            refused(ReadErrorKind::Memory { rows, columns }, None)
        };
        // A row of the table has a character for each cell at least.
        let rows = outline.rows.min(text.len() / width.max(1) + 1);
        let mut values = Vec::with_capacity(width);
        for _ in 0..width {
            let mut column = Vec::new();
            column.try_reserve_exact(rows).map_err(memory)?;
            values.push(column);
        }
        let mut numbers = Vec::new();
        numbers.try_reserve_exact(rows).map_err(memory)?;
        let mut table = Self {
            path: path.to_path_buf(),
            sheet: sheet.clone(),
            kind: header.kind,
            values,
            faults: vec![None; width],
            columns: header.columns,
            written: header.written,
            tracks: header.tracks,
            lines: numbers,
            findings: Vec::new(),
        };
        table.fill(&text, format, outline.start)?;
        table.describe(format, options, header.preamble, outline.above.is_empty());
        if let Some(delimiter) = header.delimiter {
            let text = format!(
                "names of columns between {}, unlike the cells",
                delimiter.word()
            );
            table.findings.push(Finding::new(Basis::Detected, text));
        }
        Ok(table)
    }

    /// Appends the rows of a text, beginning with line number `start`.
    fn fill(&mut self, text: &str, format: Format, start: u64) -> Result<(), ReadError> {
        let units = self.columns.iter().map(|c| match c.unit.as_str() {
            "" => UnitFrom::Nowhere,
            _ => UnitFrom::Header,
        });
        let mut units: Vec<UnitFrom> = units.collect();
        let mut refusal = None;
        let read = format.each_line(text, |line| {
            if line.number < start {
                return ControlFlow::Continue(());
            }
            match self.push(line, format, &mut units) {
                Ok(()) => ControlFlow::Continue(()),
                Err(error) => {
                    refusal = Some(error);
                    ControlFlow::Break(())
                }
            }
        });
        read.map_err(|error| {
            let (kind, place) = unreadable(&error);
            self.located(kind, place)
        })?;
        refusal.map_or(Ok(()), Err)
    }

    /// Appends a row of a file to the table.
    fn push(
        &mut self,
        row: &Line<&str>,
        format: Format,
        units: &mut [UnitFrom],
    ) -> Result<(), ReadError> {
        let width = self.columns.len();
        let surplus = row.cells.get(width..).unwrap_or_default();
        let found = row.cells.len();
        if surplus.iter().any(|cell| !cell.is_empty()) || found < width {
            let expected = width;
            let kind = ReadErrorKind::CellCount { expected, found };
            return Err(self.located(kind, Some(Place::line(row.number))));
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
                        None => (*cell).to_owned(),
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
        let mut reported = vec![Finding::new(basis, format.to_string())];
        let mut add = |text: String| reported.push(Finding::new(Basis::Detected, text));
        match self.kind {
            FileKind::Wide => {}
            FileKind::Tracker => add("an export of Tracker".to_owned()),
            FileKind::DeepLabCut => add("a table of DeepLabCut".to_owned()),
        }
        if preamble > 0 {
            let lines = counted(preamble, "line");
            add(format!("{lines} above the names of the columns"));
        }
        if bare {
            add("no names of columns".to_owned());
        }
        let missing = self.missing();
        reported.extend(missing.map(|text| Finding::new(Basis::Detected, text)));
        self.findings = reported;
    }

    /// Describes how many values are missing in each column, where a track counts as one column;
    /// `None` if none are missing.
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
        let of_track = |track: &Track| [Some(track.x), Some(track.y), track.likelihood];
        let of_tracks = self.tracks.iter().flat_map(of_track).flatten();
        let of_tracks: BTreeSet<usize> = of_tracks.collect();
        let is_alone = |column: &usize| !of_tracks.contains(column);
        let alone = (0..self.columns.len()).filter(is_alone);
        let alone = alone.map(|column| (missing(column), &self.columns[column].name));
        let reported: Vec<String> = tracks
            .chain(alone)
            .filter(|(count, _)| *count > 0)
            .map(|(count, name)| format!("{count} of `{name}`"))
            .collect();
        let rows = counted(self.rows(), "row");
        (!reported.is_empty())
            .then(|| format!("values missing in {rows}: {}", listed(reported.into_iter())))
    }
}
