//! Sheets of spreadsheets, as the text that a table is parsed from.

use super::cell::DecimalMark;
use super::error::ReadErrorKind;
use super::finding::Finding;
use super::place::Sheet;

/// Sheet of a workbook, converted to lines with tabs between the cells.
pub(crate) struct SheetText {
    pub(crate) sheet: Sheet,
    pub(crate) text: String,
    pub(crate) decimal: DecimalMark,
    pub(crate) finding: Finding,
}

/// Returns true if `bytes` begin as those of the workbooks of current spreadsheet programs do.
pub(crate) fn is_workbook(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(&[0xd0, 0xcf, 0x11, 0xe0])
}

/// Converts a sheet of a workbook: the one called `wanted`, or else the first one with numbers.
///
/// A number in a cell of text keeps its decimal mark. If the decimal mark is not given and such
/// cells have decimal commas alone, all numbers of the text get decimal commas.
#[cfg(feature = "spreadsheets")]
pub(crate) fn read(
    bytes: &[u8],
    wanted: Option<&str>,
    decimal: Option<DecimalMark>,
) -> Result<SheetText, ReadErrorKind> {
    use super::finding::Basis;
    use calamine::{DataType, Reader};

    let not_text = |_| ReadErrorKind::NotText {
        what: "an archive or a document that is not a spreadsheet",
    };
    let mut workbook =
        calamine::open_workbook_auto_from_rs(std::io::Cursor::new(bytes)).map_err(not_text)?;
    let names = workbook.sheet_names();
    let mut range_of = |name: &String| {
        let range = workbook.worksheet_range(name);
        range.map_err(|error| ReadErrorKind::Sheet {
            sheet: name.clone(),
            what: error.to_string(),
        })
    };
    let (name, range) = match wanted {
        Some(wanted) => {
            let name = names.iter().find(|name| *name == wanted);
            let name = name.ok_or_else(|| ReadErrorKind::Unknown {
                what: "sheet",
                name: wanted.to_owned(),
                known: names.clone(),
            })?;
            (name, range_of(name)?)
        }
        None => {
            let mut chosen = None;
            for name in &names {
                let range = range_of(name)?;
                let number = |(_, _, cell): (usize, usize, &calamine::Data)| {
                    cell.is_float() || cell.is_int() || is_number_in_text(cell)
                };
                if range.used_cells().any(number) {
                    chosen = Some((name, range));
                    break;
                }
            }
            chosen.ok_or(ReadErrorKind::NoNumbers)?
        }
    };
    let decimal = decimal.unwrap_or_else(|| decimal_mark(&range));
    let (first_row, first_column) = range.start().unwrap_or_default();
    let mut text = "\n".repeat(first_row as usize);
    for row in range.rows() {
        for (index, cell) in row.iter().enumerate() {
            if index > 0 {
                text.push('\t');
            }
            write_cell(cell, decimal, &mut text);
        }
        text.push('\n');
    }
    let (basis, others) = match (wanted, names.len()) {
        (Some(_), _) => (Basis::Given, String::new()),
        (None, 1) => (Basis::Detected, String::new()),
        (None, several) => (
            Basis::Assumed,
            format!(", the first of {several} with numbers"),
        ),
    };
    Ok(SheetText {
        finding: Finding::new(basis, format!("sheet `{name}` of a spreadsheet{others}")),
        sheet: Sheet {
            name: name.clone(),
            first_column: first_column as usize,
        },
        text,
        decimal,
    })
}

/// Refuses a workbook, because this build cannot read spreadsheets.
#[cfg(not(feature = "spreadsheets"))]
pub(crate) fn read(
    _bytes: &[u8],
    _wanted: Option<&str>,
    _decimal: Option<DecimalMark>,
) -> Result<SheetText, ReadErrorKind> {
    Err(ReadErrorKind::NotText {
        what: "a zip archive (a spreadsheet?)",
    })
}

#[cfg(feature = "spreadsheets")]
fn is_number_in_text(cell: &calamine::Data) -> bool {
    use super::cell::Entry;
    let calamine::Data::String(text) = cell else {
        return false;
    };
    [DecimalMark::Point, DecimalMark::Comma]
        .into_iter()
        .any(|mark| Entry::read(text, mark).is_number())
}

/// Returns the decimal mark of the numbers in cells of text: a point unless commas are the only
/// reading.
#[cfg(feature = "spreadsheets")]
fn decimal_mark(range: &calamine::Range<calamine::Data>) -> DecimalMark {
    use super::cell::Entry;
    let texts = range.used_cells().filter_map(|(_, _, cell)| match cell {
        calamine::Data::String(text) => Some(text.as_str()),
        _ => None,
    });
    let is_number = |text: &str, mark| Entry::read(text, mark).is_number();
    let mut mark = DecimalMark::Point;
    for text in texts.filter(|text| text.contains(['.', ','])) {
        match (
            is_number(text, DecimalMark::Point),
            is_number(text, DecimalMark::Comma),
        ) {
            (true, false) => return DecimalMark::Point,
            (false, true) => mark = DecimalMark::Comma,
            _ => {}
        }
    }
    mark
}

/// Appends the text of a cell. A duration or a time of day is in seconds, with its unit; a date
/// stays a date, which a table refuses.
#[cfg(feature = "spreadsheets")]
fn write_cell(cell: &calamine::Data, decimal: DecimalMark, text: &mut String) {
    use calamine::Data;
    const SECONDS_A_DAY: f64 = 86_400.0;
    let number = |value: f64| match decimal {
        DecimalMark::Point => value.to_string(),
        DecimalMark::Comma => value.to_string().replace('.', ","),
    };
    match cell {
        Data::Empty => {}
        Data::Int(value) => text.push_str(&value.to_string()),
        Data::Float(value) => text.push_str(&number(*value)),
        Data::Bool(value) => text.push_str(&value.to_string()),
        // An error such as #DIV/0! is a missing value if it says so, and else a faulty cell.
        Data::Error(error) => text.push_str(&error.to_string()),
        Data::DateTime(time) if time.is_duration() || time.as_f64() < 1.0 => {
            // Spreadsheets keep days; a microsecond is below their resolution.
            let seconds = (time.as_f64() * SECONDS_A_DAY * 1e6).round() / 1e6;
            text.push_str(&number(seconds));
            text.push_str(" s");
        }
        Data::DateTime(time) => {
            let (year, month, day, hour, minute, second, milli) = time.to_ymd_hms_milli();
            text.push_str(&format!(
                "{year:04}-{month:02}-{day:02} {hour:02}:{minute:02}:{second:02}.{milli:03}"
            ));
        }
        Data::String(value) | Data::DateTimeIso(value) | Data::DurationIso(value) => {
            // One line of text for each row of the sheet.
            let value = value.replace(['\t', '\n', '\r'], " ");
            match value.contains('"') {
                true => text.push_str(&format!("\"{}\"", value.replace('"', "\"\""))),
                false => text.push_str(&value),
            }
        }
    }
}
