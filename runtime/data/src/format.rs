//! How the cells of a line are parted and how their numbers are written.

use core::fmt;

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

/// The mark between whole numbers and fractions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DecimalMark {
    /// `0.5`
    Point,
    /// `0,5`
    Comma,
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

/// A cell of a table of numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Entry {
    Number(f64),
    Missing,
    Infinite,
    Text,
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
    /// in at least two columns, among those that agree with what is given.
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
        let score = |format: Self| {
            let numeric = |line: &&&str| {
                let cells = format.split(line);
                let numbers = cells
                    .iter()
                    .filter(|cell| matches!(format.entry(cell), Entry::Number(_)));
                cells.len() >= 2
                    && numbers.count() >= 1
                    && cells.iter().all(|cell| format.entry(cell) != Entry::Text)
            };
            sample.iter().filter(numeric).count()
        };
        let mut best = None;
        for format in Self::ALL {
            if delimiter.is_some_and(|given| given != format.delimiter)
                || decimal.is_some_and(|given| given != format.decimal)
            {
                continue;
            }
            let lines = score(format);
            if lines > best.map_or(0, |(most, _)| most) {
                best = Some((lines, format));
            }
        }
        best.map(|(_, format)| format)
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

    pub(crate) fn entry(self, cell: &str) -> Entry {
        const MISSING: [&str; 9] = ["", "nan", "na", "n/a", "-", "--", "none", "null", "?"];
        let cell = cell.trim();
        if MISSING.iter().any(|word| word.eq_ignore_ascii_case(cell)) {
            return Entry::Missing;
        }
        let plain = match self.decimal {
            DecimalMark::Point => cell.to_owned(),
            DecimalMark::Comma if cell.contains('.') => return Entry::Text,
            DecimalMark::Comma => cell.replacen(',', ".", 1),
        };
        // Minus signs of typography, as spreadsheets write them.
        let plain = plain.replace('\u{2212}', "-");
        match plain.parse::<f64>() {
            Ok(value) if value.is_finite() => Entry::Number(value),
            Ok(_) => Entry::Infinite,
            Err(_) => Entry::Text,
        }
    }
}

fn unquoted(cell: &str) -> &str {
    let cell = cell.trim();
    cell.strip_prefix('"')
        .and_then(|rest| rest.strip_suffix('"'))
        .unwrap_or(cell)
}
