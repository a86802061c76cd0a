//! Why parameters were not identified.

use core::fmt;

use super::family::ImpossibleValue;
use super::fit::Unfound;
use crate::SmoothingError;

/// Why parameters were not identified.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum IdentificationError {
    /// A parameter that the model does not have.
    UnknownParameter {
        /// The name given.
        name: String,
        /// Names that there are.
        parameters: Vec<String>,
    },
    /// A link that the model does not have.
    UnknownLink {
        /// The name given.
        name: String,
        /// Names that there are.
        links: Vec<String>,
    },
    /// A parameter or a link that is given twice.
    Twice {
        /// Name of the parameter or link.
        name: String,
    },
    /// A parameter that is neither known nor unknown.
    Missing {
        /// Name of the parameter.
        name: String,
    },
    /// A number that is not finite, or not positive where it has to be.
    Number {
        /// Meaning of the number.
        what: String,
        /// The number.
        value: f64,
    },
    /// A start from which no model can be made.
    Start(ImpossibleValue),
    /// A time that is not finite or not later than the one before.
    Time {
        /// Index of the time.
        index: usize,
        /// The time, s.
        value: f64,
    },
    /// A link with another number of angles than times.
    Length {
        /// Name of the link.
        link: String,
        /// Number of times.
        times: usize,
        /// Number of angles.
        angles: usize,
    },
    /// An angle that is infinite or NaN.
    Datum {
        /// Name of the link.
        link: String,
        /// Index of its time.
        index: usize,
        /// The angle.
        value: f64,
    },
    /// Fewer data than numbers to be found.
    TooFew {
        /// Number of data.
        found: usize,
        /// Number of data that are needed, at least.
        needed: usize,
    },
    /// A frequency, or the standard error of one, that is not positive and finite.
    Frequency {
        /// The frequency, Hz.
        hertz: f64,
        /// Standard error of the frequency, Hz.
        deviation: f64,
    },
    /// A frequency of a mode that the model does not have.
    Mode {
        /// Number of the mode.
        mode: usize,
        /// Number of modes that oscillate.
        modes: usize,
    },
    /// Frequencies without the numbers of their modes, which are not one for each mode.
    Unnumbered {
        /// Number of frequencies without a number.
        unnumbered: usize,
        /// Number of all frequencies.
        frequencies: usize,
        /// Number of modes that oscillate.
        modes: usize,
    },
    /// No place at which the tree rests was found from hanging on.
    NoRest,
    /// Velocities at the start could not be estimated from the angles of a link.
    Velocities {
        /// Name of the link.
        link: String,
        /// The smoother's error.
        error: SmoothingError,
    },
    /// The motion could not be integrated with the parameters of the start.
    NoMotion {
        /// Start of the segment, s.
        time: f64,
    },
    /// A search that ended nowhere, with the best that it found.
    NotFound(Box<Unfound>),
    /// A parameter that the data do not determine.
    NotDetermined {
        /// Name of the parameter.
        name: String,
        /// Unknowns that can change together with it without a change of the motion.
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
                "angle {index} of `{link}` is {value}; missing ones are none"
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
        match self {
            Self::Start(error) => Some(error),
            Self::Velocities { error, .. } => Some(error),
            _ => None,
        }
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
