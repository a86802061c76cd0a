//! Cells of a table: numbers, with or without units, and other text.

use super::units::{FRAME, Unit};

/// Decimal mark: the character between the integer part and the fraction of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DecimalMark {
    /// `0.5`
    Point,
    /// `0,5`
    Comma,
}

/// The content of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Entry<'a> {
    /// A number, and the text of its unit; empty if it has none.
    Number {
        value: f64,
        unit: &'a str,
    },
    Missing,
    Infinite,
    Text,
}

impl<'a> Entry<'a> {
    /// Parses a cell.
    pub(crate) fn read(cell: &'a str, decimal: DecimalMark) -> Self {
        const MISSING: [&str; 10] = [
            "", "nan", "na", "n/a", "#n/a", "-", "--", "none", "null", "?",
        ];
        let cell = cell.trim();
        if MISSING.iter().any(|word| word.eq_ignore_ascii_case(cell)) {
            return Self::Missing;
        }
        match number(cell, decimal) {
            Some(value) if value.is_finite() => Self::Number { value, unit: "" },
            Some(_) => Self::Infinite,
            None => quantity(cell, decimal).unwrap_or(Self::Text),
        }
    }

    pub(crate) fn is_number(self) -> bool {
        matches!(self, Self::Number { .. })
    }
}

/// Parses a number as programs write it, including Fortran's `D` and separators of thousands if no
/// other reading is possible.
fn number(cell: &str, decimal: DecimalMark) -> Option<f64> {
    let usual = match decimal {
        DecimalMark::Point => cell.parse().ok(),
        DecimalMark::Comma if cell.contains('.') => None,
        DecimalMark::Comma => cell.replacen(',', ".", 1).parse().ok(),
    };
    if usual.is_some() {
        return usual;
    }
    let (mark, other) = match decimal {
        DecimalMark::Point => ('.', ','),
        DecimalMark::Comma => (',', '.'),
    };
    // Minus signs of typography, as some spreadsheets write them.
    let plain = cell.replace('\u{2212}', "-");
    let whole = plain.split(mark).next().unwrap_or_default();
    // A single separator of thousands may be a decimal mark instead, except an apostrophe or a
    // narrow space.
    let has_fraction = plain.len() > whole.len();
    let separators = [other, '\'', '\u{2019}', '\u{a0}', '\u{202f}'];
    let separator = separators.into_iter().find(|mark| whole.contains(*mark));
    let plain = match separator {
        None => plain,
        Some(separator) => {
            let is_doubtful = separator == other && !has_fraction;
            if groups_of_three(whole, separator) < 1 + usize::from(is_doubtful) {
                return None;
            }
            plain.replace(separator, "")
        }
    };
    if decimal == DecimalMark::Comma && plain.contains('.') {
        return None;
    }
    let plain = plain.replacen(mark, ".", 1);
    plain.parse().ok().or_else(|| {
        // 1.5D-01 and 1.5d-01.
        let at = plain.find(['D', 'd'])?;
        let (digits, power) = (&plain[..at], &plain[at + 1..]);
        power.parse::<i32>().ok()?;
        format!("{digits}e{power}").parse().ok()
    })
}

/// Returns the number of groups of three digits after a first group of at most three; zero if there
/// are groups of another length.
fn groups_of_three(whole: &str, separator: char) -> usize {
    let digits = |group: &str| group.bytes().all(|byte| byte.is_ascii_digit());
    let mut groups = whole.trim_start_matches(['-', '+']).split(separator);
    let first = groups.next().unwrap_or_default();
    let is_first = (1..=3).contains(&first.len()) && digits(first) && !first.starts_with('0');
    let is_three = |group: &&str| group.len() == 3 && digits(group);
    match is_first && groups.clone().all(|group| is_three(&group)) {
        true => groups.count(),
        false => 0,
    }
}

/// Parses a number with its unit, a time of day, or the number in the name of a picture.
fn quantity(cell: &str, decimal: DecimalMark) -> Option<Entry<'_>> {
    let of = |value: f64, unit| value.is_finite().then_some(Entry::Number { value, unit });
    if let Some(seconds) = clock(cell, decimal) {
        return of(seconds, "s");
    }
    if let Some(frame) = picture(cell) {
        return of(frame, FRAME);
    }
    let digit = cell.rfind(|c: char| c.is_ascii_digit())?;
    let (digits, unit) = cell.split_at(digit + 1);
    let unit = unit.trim_start_matches('.').trim();
    Unit::named(unit)?;
    of(number(digits.trim(), decimal)?, unit)
}

/// Returns the seconds of a time of day, `12:03:04.5`, or of minutes and seconds with a fraction,
/// `03:04.5`. Two whole numbers are rejected, since they may be hours and minutes.
fn clock(cell: &str, decimal: DecimalMark) -> Option<f64> {
    let parts: Vec<&str> = cell.split(':').collect();
    let whole = |part: &str, below: u32| {
        let is_short = (1..=2).contains(&part.len()) && part.bytes().all(|b| b.is_ascii_digit());
        let value: u32 = is_short.then(|| part.parse().ok())??;
        (value < below).then_some(f64::from(value))
    };
    let seconds = |part: &str| {
        let value = number(part, decimal)?;
        let is_digit = part.starts_with(|c: char| c.is_ascii_digit());
        (is_digit && value < 61.0).then_some(value)
    };
    match parts[..] {
        [hours, minutes, rest] => {
            Some(3600.0 * whole(hours, 24)? + 60.0 * whole(minutes, 60)? + seconds(rest)?)
        }
        [minutes, rest] if rest.contains(['.', ',']) => {
            Some(60.0 * whole(minutes, 60)? + seconds(rest)?)
        }
        _ => None,
    }
}

/// Returns the number at the end of the name of a picture: `labeled-data/film/img0012.png`.
fn picture(cell: &str) -> Option<f64> {
    let (stem, extension) = cell.rsplit_once('.')?;
    let kinds = ["png", "jpg", "jpeg", "tif", "tiff", "bmp"];
    if !kinds
        .iter()
        .any(|kind| kind.eq_ignore_ascii_case(extension))
    {
        return None;
    }
    let name = stem.trim_end_matches(|c: char| c.is_ascii_digit());
    stem[name.len()..].parse().ok()
}

/// Returns a guess, for a message, of what a cell that is not a number means.
pub(crate) fn hint(text: &str) -> &'static str {
    let digits = text.chars().filter(char::is_ascii_digit).count();
    let marks = text.chars().filter(|c| matches!(c, '.' | ',')).count();
    let is_plain = text
        .chars()
        .all(|c| c.is_ascii_digit() || ".,+-eE '".contains(c));
    let is_apart = !(is_plain && text.contains([' ', '\'']));
    let is_date = |mark: char| {
        let mut parts = text
            .split([' ', 'T'])
            .next()
            .unwrap_or_default()
            .split(mark);
        let all = parts
            .by_ref()
            .take(3)
            .filter(|part| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit()));
        all.count() == 3 && parts.next().is_none()
    };
    if text.starts_with('"') {
        " (a quotation mark that is not closed?)"
    } else if is_date('-') || is_date('/') || (is_date('.') && text.contains(':')) {
        " (a date; write the time in seconds)"
    } else if digits > 0 && text.contains(':') {
        " (a time of day? write hours:minutes:seconds, or seconds)"
    } else if digits > 0 && marks > usize::from(is_apart) {
        " (are thousands separated?)"
    } else if digits > 0 && is_plain && text.contains(',') {
        " (decimal commas in a file of decimal points?)"
    } else if digits > 0 && is_plain && text.contains('.') {
        " (decimal points in a file of decimal commas?)"
    } else {
        ""
    }
}
