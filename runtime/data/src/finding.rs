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

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { basis, text } = self;
        write!(f, "{basis}: {text}")
    }
}
