//! Why parameters were not identified.

use core::fmt;

use super::family::ImpossibleValue;
use super::fit::Unfound;
use crate::SmoothingError;

/// Why parameters were not identified.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum IdentificationError {
    /// The model has no parameter with this name.
    UnknownParameter {
        /// The name given.
        name: String,
        /// Names that there are.
        parameters: Vec<String>,
    },
    /// The model has no link with this name.
    UnknownLink {
        /// The name given.
        name: String,
        /// Names that there are.
        links: Vec<String>,
    },
    /// A parameter or a link was given twice.
    Twice {
        /// Name of the parameter or link.
        name: String,
    },
    /// A parameter was given neither as known nor as unknown.
    Missing {
        /// Name of the parameter.
        name: String,
    },
    /// A number is not finite, or not positive although it must be.
    Number {
        /// Meaning of the number.
        what: String,
        /// The number.
        value: f64,
    },
    /// No model exists with the values at the start of the search.
    Start(ImpossibleValue),
    /// A time is not finite, or not later than the one before.
    Time {
        /// Index of the time.
        index: usize,
        /// The time, s.
        value: f64,
    },
    /// The number of angles of a link is not the number of times.
    Length {
        /// Name of the link.
        link: String,
        /// Number of times.
        times: usize,
        /// Number of angles.
        angles: usize,
    },
    /// A measured angle is infinite or NaN.
    Datum {
        /// Name of the link.
        link: String,
        /// Index of its time.
        index: usize,
        /// The angle.
        value: f64,
    },
    /// There are fewer data than unknowns.
    TooFew {
        /// Number of data.
        found: usize,
        /// Smallest number of data that is needed.
        needed: usize,
    },
    /// A frequency, or its standard error, is not positive and finite.
    Frequency {
        /// The frequency, Hz.
        hertz: f64,
        /// Standard error of the frequency, Hz.
        deviation: f64,
    },
    /// A frequency was given for a mode that the model does not have.
    Mode {
        /// Number of the mode.
        mode: usize,
        /// Number of modes that oscillate.
        modes: usize,
    },
    /// Frequencies were given without mode numbers, but there is not one for each mode.
    Unnumbered {
        /// Number of frequencies without a number.
        unnumbered: usize,
        /// Number of all frequencies.
        frequencies: usize,
        /// Number of modes that oscillate.
        modes: usize,
    },
    /// No equilibrium was found near the hanging tree.
    NoRest,
    /// Initial velocities could not be estimated from the angles of a link.
    Velocities {
        /// Name of the link.
        link: String,
        /// The smoother's error.
        error: SmoothingError,
    },
    /// The motion could not be integrated with the parameters at the start of the search.
    NoMotion {
        /// Start of the segment, s.
        time: f64,
    },
    /// The search was interrupted before it had found anything.
    Ended,
    /// The search has no valid result; contains the best values that it found.
    NotFound(Box<Unfound>),
    /// The data do not determine a parameter.
    NotDetermined {
        /// Name of the parameter.
        name: String,
        /// Other unknowns: if they change together with this unknown, the motion stays the same.
        with: Vec<String>,
    },
}

impl fmt::Display for IdentificationError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownParameter { name, parameters } => write!(
                f,
                "the model has no parameter `{name}`; it has {}",
                list(parameters)
            ),
            Self::UnknownLink { name, links } => {
                write!(f, "the model has no link `{name}`; it has {}", list(links))
            }
            Self::Twice { name } => write!(f, "`{name}` is given twice"),
            Self::Missing { name } => write!(
                f,
                "parameter `{name}` is neither known nor unknown; give its value or its start"
            ),
            Self::Number { what, value } => write!(f, "{what} is {value}: it makes no sense"),
            Self::Start(_) => write!(f, "no model has the parameters of the start"),
            Self::Time { index, value } => write!(
                f,
                "time {index} is {value} s: times are finite and each later than the one before"
            ),
            Self::Length {
                link,
                times,
                angles,
            } => write!(f, "{angles} angles of `{link}` for {times} times"),
            Self::Datum { link, index, value } => write!(
                f,
                "angle {index} of `{link}` is {value}; write missing ones as `None`"
            ),
            Self::TooFew { found, needed } => write!(
                f,
                "{found} data for {needed} unknown numbers or more: give more data, or leave fewer \
                 unknown"
            ),
            Self::Frequency { hertz, deviation } => write!(
                f,
                "a frequency of {hertz} Hz with the standard error {deviation} Hz: both have to be \
                 positive and finite"
            ),
            Self::Mode { mode, modes } => write!(
                f,
                "a frequency of mode {mode}, but {modes} modes oscillate about rest: they have the \
                 numbers from 1 on, in ascending order"
            ),
            Self::Unnumbered {
                unnumbered,
                frequencies,
                modes,
            } if unnumbered < frequencies => write!(
                f,
                "{unnumbered} of {frequencies} frequencies have no number of a mode, of {modes} that \
                 oscillate: give the numbers of all modes or of none"
            ),
            Self::Unnumbered {
                frequencies, modes, ..
            } => write!(
                f,
                "{frequencies} frequencies without the numbers of their modes, where {modes} modes \
                 oscillate about rest: give the number of each one's mode"
            ),
            Self::NoRest => write!(
                f,
                "no place at which the tree rests was found from hanging on, and frequencies are \
                 those of small motions about it: start from other parameters"
            ),
            Self::Velocities { link, error: _ } => {
                write!(f, "the velocity of `{link}` could not be estimated")
            }
            Self::NoMotion { time } => write!(
                f,
                "the motion from {time} s on cannot be integrated with the parameters of the start"
            ),
            Self::Ended => write!(
                f,
                "the search was interrupted before it had followed any part of the record"
            ),
            Self::NotFound(unfound) => unfound.fmt(f),
            Self::NotDetermined { name, with } if with.is_empty() => {
                write!(f, "the data do not determine `{name}`")
            }
            Self::NotDetermined { name, with } => write!(
                f,
                "the data do not determine `{name}`: it can change together with {}",
                list(with)
            ),
        }
    }
}

impl core::error::Error for IdentificationError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        if let Self::Velocities { error, .. } = self {
            return Some(error);
        }
        let Self::Start(error) = self else {
            return None;
        };
        Some(error)
    }
}

fn list(names: &[String]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match quoted.as_slice() {
        [] => "none".to_owned(),
        [one] => one.clone(),
        [others @ .., last] => format!("{} and {last}", others.join(", ")),
    }
}

pub(super) fn finite(what: &str, value: f64) -> Result<(), IdentificationError> {
    number(what, value, value.is_finite())
}

pub(super) fn positive(what: &str, value: f64) -> Result<(), IdentificationError> {
    number(what, value, value > 0.0)
}

pub(super) fn number(what: &str, value: f64, is_possible: bool) -> Result<(), IdentificationError> {
    let what = what.to_owned();
    match is_possible {
        true => Ok(()),
        false => Err(IdentificationError::Number { what, value }),
    }
}
