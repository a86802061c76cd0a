//! How the cells of a line are parted and how their numbers are written.

use core::fmt;

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
    /// Any number of spaces and tabs.
    Spaces,
}

/// Ways of writing numbers side by side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Format {
    pub(crate) delimiter: Delimiter,
    pub(crate) decimal: DecimalMark,
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let cells = match self.delimiter {
            Delimiter::Comma => "commas",
            Delimiter::Semicolon => "semicolons",
            Delimiter::Tab => "tabs",
            Delimiter::Spaces => "spaces",
        };
        let decimal = match self.decimal {
            DecimalMark::Point => "points",
            DecimalMark::Comma => "commas",
        };
        write!(f, "{cells} between cells, decimal {decimal}")
    }
}

/// A line with its number in the file, cut into cells.
#[derive(Clone, Debug)]
pub(crate) struct TextLine {
    pub(crate) number: u64,
    pub(crate) cells: Vec<String>,
}

impl Format {
    /// All of them, the more distinct first: what is between cells is least likely to be
    /// something else where it is a tab.
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

    /// Returns the format in which most of the lines from the last backwards hold numbers
    /// alone, or that with most numbers where columns of text stand beside them, or with most
    /// cells that begin with a digit where none are numbers; among those that agree with what
    /// is given.
    pub(crate) fn detect(
        text: &str,
        delimiter: Option<Delimiter>,
        decimal: Option<DecimalMark>,
    ) -> Option<Self> {
        const SAMPLE: usize = 200;
        let lines: Vec<&str> = text
            .lines()
            .filter(|line| !line.trim().is_empty())
            .collect();
        // A tail is read: the head of a file may be prose. Half of a short file may be.
        let sample = &lines[lines.len().saturating_sub(SAMPLE)..];
        let agrees = |format: &&Self| {
            delimiter.is_none_or(|given| given == format.delimiter)
                && decimal.is_none_or(|given| given == format.decimal)
        };
        let candidates = || Self::ALL.iter().filter(agrees).copied();
        let by = |worth: fn(Self, &[&str]) -> usize| {
            let score = |format: Self| {
                let cut = sample.iter().map(|line| format.split(line));
                let lines = cut.filter(|cells| cells.len() >= 2);
                lines.map(|cells| worth(format, &cells)).sum::<usize>()
            };
            let scored = candidates().map(|format| (score(format), format));
            // The first of the best.
            let best = scored.rev().max_by_key(|(score, _)| *score);
            best.filter(|(score, _)| *score > 0)
        };
        let best = by(|format, cells| usize::from(format.is_row(cells)))
            .or_else(|| by(Self::numbers_beside_text))
            .or_else(|| by(|_, cells| cells.iter().filter(|cell| begins_as_number(cell)).count()));
        best.map(|(_, format)| format)
    }

    /// Returns true for cells that are numbers or missing, one number at least.
    pub(crate) fn is_row(self, cells: &[impl AsRef<str>]) -> bool {
        let entries = || cells.iter().map(|cell| self.entry(cell.as_ref()));
        cells.len() >= 2
            && entries().any(Entry::is_number)
            && entries().all(|entry| entry != Entry::Text)
    }

    /// The number of numbers, where at least two stand beside each other.
    fn numbers_beside_text(self, cells: &[&str]) -> usize {
        let numbers = cells.iter().filter(|cell| self.entry(cell).is_number());
        match numbers.count() {
            0 | 1 => 0,
            several => several,
        }
    }

    /// Cuts one line without quotes into trimmed cells.
    fn split(self, line: &str) -> Vec<&str> {
        let part = |mark: char| line.split(mark).map(unquoted).collect();
        match self.delimiter {
            Delimiter::Comma => part(','),
            Delimiter::Semicolon => part(';'),
            Delimiter::Tab => part('\t'),
            Delimiter::Spaces => line.split_whitespace().map(unquoted).collect(),
        }
    }

    /// Cuts a text into lines of cells; blank lines are left out.
    pub(crate) fn lines(self, text: &str) -> Result<Vec<TextLine>, csv::Error> {
        let delimiter = match self.delimiter {
            Delimiter::Comma => b',',
            Delimiter::Semicolon => b';',
            Delimiter::Tab => b'\t',
            Delimiter::Spaces => {
                let lines = text.lines().zip(1..);
                let cut = lines.map(|(line, number)| TextLine {
                    number,
                    cells: self.split(line).into_iter().map(str::to_owned).collect(),
                });
                return Ok(cut.filter(|line| !line.cells.is_empty()).collect());
            }
        };
        let mut reader = csv::ReaderBuilder::new()
            .delimiter(delimiter)
            .has_headers(false)
            .flexible(true)
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        let mut lines = Vec::new();
        for record in reader.records() {
            let record = record?;
            if record.iter().all(str::is_empty) {
                continue;
            }
            let number = record.position().map_or(0, csv::Position::line);
            lines.push(TextLine {
                number,
                cells: record.iter().map(str::to_owned).collect(),
            });
        }
        Ok(lines)
    }

    pub(crate) fn entry(self, cell: &str) -> Entry<'_> {
        Entry::read(cell, self.decimal)
    }
}

/// Returns true for what might have been meant as a number.
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
