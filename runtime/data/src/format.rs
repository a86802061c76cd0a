//! Format of a table: how cells are separated and how numbers are written.

use core::fmt;
use core::ops::ControlFlow;

use super::cell::{DecimalMark, Entry};

/// Separator of cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Delimiter {
    /// `,`
    Comma,
    /// `;`
    Semicolon,
    /// A tab.
    Tab,
    /// Any number of spaces and tabs between two cells.
    Spaces,
}

impl Delimiter {
    /// All separators, the most distinctive first.
    pub(crate) const ALL: [Self; 4] = [Self::Tab, Self::Semicolon, Self::Comma, Self::Spaces];

    /// A text that separates cells.
    pub(crate) const fn text(self) -> &'static str {
        match self {
            Self::Comma => ",",
            Self::Semicolon => ";",
            Self::Tab => "\t",
            Self::Spaces => " ",
        }
    }

    /// Name in sentences.
    pub(crate) const fn word(self) -> &'static str {
        match self {
            Self::Comma => "commas",
            Self::Semicolon => "semicolons",
            Self::Tab => "tabs",
            Self::Spaces => "spaces",
        }
    }

    /// Splits a line into trimmed cells, ignoring quotation marks.
    pub(crate) fn split(self, line: &str) -> Vec<&str> {
        let part = |mark: char| line.split(mark).map(unquoted).collect();
        match self {
            Self::Comma => part(','),
            Self::Semicolon => part(';'),
            Self::Tab => part('\t'),
            Self::Spaces => line.split_whitespace().map(unquoted).collect(),
        }
    }
}

/// Format of a table: separator of cells and decimal mark.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Format {
    pub(crate) delimiter: Delimiter,
    pub(crate) decimal: DecimalMark,
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let cells = self.delimiter.word();
        let decimal = match self.decimal {
            DecimalMark::Point => "points",
            DecimalMark::Comma => "commas",
        };
        write!(f, "{cells} between cells, decimal {decimal}")
    }
}

/// A line, split into cells, with its number in the file.
#[derive(Clone, Debug)]
pub(crate) struct Line<C> {
    pub(crate) number: u64,
    pub(crate) cells: Vec<C>,
}

/// A line that is kept.
pub(crate) type TextLine = Line<String>;

/// Returns the number of cells without empty ones at the end.
pub(crate) fn used(cells: &[impl AsRef<str>]) -> usize {
    let last = cells.iter().rposition(|cell| !cell.as_ref().is_empty());
    last.map_or(0, |last| last + 1)
}

impl Format {
    /// All combinations of separator and decimal mark, the most distinctive separator first,
    /// because a tab is least likely to have another meaning.
    const ALL: [Self; 7] = [
        Self::of(Delimiter::Tab, DecimalMark::Point),
        Self::of(Delimiter::Tab, DecimalMark::Comma),
        Self::of(Delimiter::Semicolon, DecimalMark::Point),
        Self::of(Delimiter::Semicolon, DecimalMark::Comma),
        Self::of(Delimiter::Comma, DecimalMark::Point),
        Self::of(Delimiter::Spaces, DecimalMark::Point),
        Self::of(Delimiter::Spaces, DecimalMark::Comma),
    ];

    const fn of(delimiter: Delimiter, decimal: DecimalMark) -> Self {
        Self { delimiter, decimal }
    }

    /// Detects the format, among those that agree with the given settings. Of the lines, counted
    /// backwards from the last one, most must contain only numbers; if there are columns of text,
    /// most numbers; if there are no numbers, most cells that begin with a digit.
    pub(crate) fn detect(
        text: &str,
        delimiter: Option<Delimiter>,
        decimal: Option<DecimalMark>,
    ) -> Option<Self> {
        const SAMPLE: usize = 200;
        let lines = text.lines().rev().filter(|line| !line.trim().is_empty());
        // A tail is read: the head of a file may be prose. Half of a short file may be.
        let mut sample: Vec<&str> = lines.take(SAMPLE).collect();
        sample.reverse();
        let agrees = |format: &&Self| {
            delimiter.is_none_or(|given| given == format.delimiter)
                && decimal.is_none_or(|given| given == format.decimal)
        };
        let candidates = || Self::ALL.iter().filter(agrees).copied();
        let by = |worth: fn(Self, &[&str]) -> usize| {
            let score = |format: Self| {
                let cut = sample.iter().map(|line| format.delimiter.split(line));
                let lines = cut.filter(|cells| cells.len() >= 2);
                lines.map(|cells| worth(format, &cells)).sum::<usize>()
            };
            let scored = candidates().map(|format| (score(format), format));
            // The first of the best.
            let best = scored.rev().max_by_key(|(score, _)| *score);
            best.filter(|(score, _)| *score > 0)
        };
        let best = by(|format, cells| usize::from(format.is_row(cells)))
            .or_else(|| by(Self::adjacent_numbers))
            .or_else(|| by(|_, cells| cells.iter().filter(|cell| begins_as_number(cell)).count()));
        best.map(|(_, format)| format)
    }

    /// Returns true if all cells are numbers or missing, and at least one is a number.
    pub(crate) fn is_row(self, cells: &[impl AsRef<str>]) -> bool {
        let entries = || cells.iter().map(|cell| self.entry(cell.as_ref()));
        cells.len() >= 2
            && entries().any(Entry::is_number)
            && entries().all(|entry| entry != Entry::Text)
    }

    /// Returns the number of cells that are numbers, if at least two of them are neighbours.
    fn adjacent_numbers(self, cells: &[&str]) -> usize {
        let numbers = cells.iter().filter(|cell| self.entry(cell).is_number());
        match numbers.count() {
            0 | 1 => 0,
            several => several,
        }
    }

    /// Calls `visit` with each line of a text, split into cells, until it returns `Break`; blank
    /// lines are skipped.
    pub(crate) fn each_line(
        self,
        text: &str,
        mut visit: impl FnMut(&Line<&str>) -> ControlFlow<()>,
    ) -> Result<(), csv::Error> {
        let delimiter = match self.delimiter {
            Delimiter::Comma => b',',
            Delimiter::Semicolon => b';',
            Delimiter::Tab => b'\t',
            Delimiter::Spaces => {
                for (line, number) in text.lines().zip(1..) {
                    let cells = self.delimiter.split(line);
                    if !cells.is_empty() && visit(&Line { number, cells }).is_break() {
                        break;
                    }
                }
                return Ok(());
            }
        };
        let mut reader = csv::ReaderBuilder::new()
            .delimiter(delimiter)
            .has_headers(false)
            .flexible(true)
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        let mut record = csv::StringRecord::new();
        while reader.read_record(&mut record)? {
            if record.iter().all(str::is_empty) {
                continue;
            }
            let number = record.position().map_or(0, csv::Position::line);
            let cells = record.iter().collect();
            if visit(&Line { number, cells }).is_break() {
                break;
            }
        }
        Ok(())
    }

    /// Returns the first lines of a text, with limits on the number of lines and of cells.
    pub(crate) fn head(
        self,
        text: &str,
        [lines, cells]: [usize; 2],
    ) -> Result<Vec<TextLine>, csv::Error> {
        let mut head: Vec<TextLine> = Vec::new();
        let mut count = 0;
        self.each_line(text, |line| {
            count += line.cells.len();
            head.push(Line {
                number: line.number,
                cells: line.cells.iter().map(|&cell| cell.to_owned()).collect(),
            });
            match head.len() < lines && count < cells {
                true => ControlFlow::Continue(()),
                false => ControlFlow::Break(()),
            }
        })?;
        Ok(head)
    }

    pub(crate) fn entry(self, cell: &str) -> Entry<'_> {
        Entry::read(cell, self.decimal)
    }
}

/// Returns true for a cell that was probably meant as a number.
pub(crate) fn begins_as_number(cell: &str) -> bool {
    let rest = cell.trim_start_matches(['+', '-', '\u{2212}', '.', ',', '[', '(']);
    rest.starts_with(|c: char| c.is_ascii_digit())
}

fn unquoted(cell: &str) -> &str {
    let cell = cell.trim();
    cell.strip_prefix('"')
        .and_then(|rest| rest.strip_suffix('"'))
        .unwrap_or(cell)
}
