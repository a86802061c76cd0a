//! Positions in files.

use core::fmt;

/// Position in a text file or spreadsheet: line (row) and column counted from 1, and the column's name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Line of the file, or row of the sheet.
    pub line: u64,
    /// Number of the cell in that line; `None` if the whole line is meant.
    pub column: Option<usize>,
    /// Name of the column, if it has one.
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

/// Sheet of a spreadsheet from which a table comes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sheet {
    /// Name of the sheet.
    pub name: String,
    /// Number of the table's first column in the sheet, counted from 0.
    pub first_column: usize,
}

impl Sheet {
    /// Returns the name of a cell as spreadsheets print it, such as `B17`. `line` counts from 1,
    /// `column` from 1 at the table's first column.
    fn cell(&self, line: u64, column: usize) -> String {
        let mut letters = Vec::new();
        let mut rest = self.first_column + column;
        while rest > 0 {
            letters.push(char::from(b'A' + ((rest - 1) % 26) as u8));
            rest = (rest - 1) / 26;
        }
        let letters: String = letters.iter().rev().collect();
        format!("{letters}{line}")
    }

    /// Returns the position of a row, or of a cell in it, as spreadsheets print it.
    pub(crate) fn position(&self, place: &Place) -> String {
        let name = place.name.as_ref().map(|name| format!(" (`{name}`)"));
        let name = name.unwrap_or_default();
        match place.column {
            Some(column) => format!("{self}, cell {}{name}", self.cell(place.line, column)),
            None => format!("{self}, row {}{name}", place.line),
        }
    }
}

impl fmt::Display for Sheet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "sheet `{}`", self.name)
    }
}
