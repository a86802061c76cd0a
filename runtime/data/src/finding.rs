//! Findings of a reader about a file.

use core::fmt;

/// Where a statement about a file comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Basis {
    /// The caller said so.
    Given,
    /// The file shows it.
    Detected,
    /// Nothing says so; it is the usual case.
    Assumed,
    /// Samples that were marked, or changed by whole turns.
    Marked,
    /// It may be wrong, and much with it: the caller should look, and say so where he can.
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

/// One statement about how a file was read, for the user to check.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// Where it comes from.
    pub basis: Basis,
    /// The statement.
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

/// Things that a finding names before it counts the others.
const NAMED: usize = 3;

/// Lists the first things of many, and how many more there are.
pub(crate) fn listed<T: fmt::Display>(things: impl ExactSizeIterator<Item = T>) -> String {
    let more = things.len().saturating_sub(NAMED);
    let named: Vec<String> = things.take(NAMED).map(|thing| thing.to_string()).collect();
    match more {
        0 => named.join(", "),
        more => format!("{} and {more} more", named.join(", ")),
    }
}

/// A number of things in words: "1 jump", "2 jumps".
pub(crate) fn counted(count: usize, thing: &str) -> String {
    match count {
        1 => format!("1 {thing}"),
        _ => format!("{count} {thing}s"),
    }
}

/// A number to so many digits, without zeros at its end.
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

/// A moment, as exactly as it takes to tell samples of an interval apart.
pub(crate) fn moment(time: f64, interval: f64) -> String {
    let digits = 3.0 + (time / interval).abs().log10().floor().max(0.0);
    format!("{} s", rounded(time, digits as i32))
}

/// The first moments of some rows, and how many more there are.
pub(crate) fn moments(times: &[f64], rows: &[usize], interval: f64) -> String {
    listed(rows.iter().map(|&row| moment(times[row], interval)))
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { basis, text } = self;
        write!(f, "{basis}: {text}")
    }
}
