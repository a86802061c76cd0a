//! Findings about a file that is read: statements about how it was interpreted.

use core::fmt;

/// Basis of a statement about a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Basis {
    /// The caller has specified it.
    Given,
    /// The file shows it.
    Detected,
    /// Nothing in the file shows it, but it is the usual case.
    Assumed,
    /// The statement is about samples that were marked, or changed by whole turns.
    Marked,
    /// It may be wrong, with large consequences: the caller should check it and specify it if
    /// possible.
    Doubtful,
}

impl fmt::Display for Basis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Given => "given",
            Self::Detected => "detected",
            Self::Assumed => "assumed",
            Self::Marked => "marked",
            Self::Doubtful => "doubtful",
        })
    }
}

/// Statement about how a file was interpreted, which the user can check.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// The source of the statement.
    pub basis: Basis,
    /// The statement, as text.
    pub text: String,
}

impl Finding {
    pub(crate) fn new(basis: Basis, text: impl Into<String>) -> Self {
        Self {
            basis,
            text: text.into(),
        }
    }
}

/// Number of items that a finding lists before it only counts the others.
const NAMED: usize = 3;

/// Lists the first of many items, and the number of the others.
pub(crate) fn listed<T: fmt::Display>(things: impl ExactSizeIterator<Item = T>) -> String {
    let more = things.len().saturating_sub(NAMED);
    let named: Vec<String> = things.take(NAMED).map(|thing| thing.to_string()).collect();
    match more {
        0 => named.join(", "),
        more => format!("{} and {more} more", named.join(", ")),
    }
}

/// Formats a number of things: "1 jump", "2 jumps".
pub(crate) fn counted(count: usize, thing: &str) -> String {
    match count {
        1 => format!("1 {thing}"),
        _ => format!("{count} {thing}s"),
    }
}

/// Formats a number with up to `digits` digits, without trailing zeros.
pub(crate) fn rounded(value: f64, digits: i32) -> String {
    let before = value.abs().log10().floor();
    let decimals = if before.is_finite() {
        digits - 1 - before as i32
    } else {
        0
    };
    let text = format!("{value:.*}", decimals.clamp(0, 17) as usize);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

/// Formats a time (s) with as many digits as distinguish samples that are `interval` (s) apart.
pub(crate) fn moment(time: f64, interval: f64) -> String {
    let digits = 3.0 + (time / interval).abs().log10().floor().max(0.0);
    format!("{} s", rounded(time, digits as i32))
}

/// Lists the times of the first few rows, followed by the number of the remaining rows.
pub(crate) fn moments(times: &[f64], rows: &[usize], interval: f64) -> String {
    listed(rows.iter().map(|&row| moment(times[row], interval)))
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { basis, text } = self;
        write!(f, "{basis}: {text}")
    }
}
