//! What to say to a command line that cannot be followed.

use std::fmt;

use super::arguments::{ANGLES, DURATION, MOST_SAMPLES, OPTIONS, PRECISION, RATE};

/// What is wrong with the command line.
#[derive(Clone, Debug, PartialEq)]
pub enum ArgumentError {
    /// There is no such option.
    Unknown {
        /// The word given.
        word: String,
        /// The option that it resembles.
        nearest: Option<&'static str>,
    },
    /// An option stands without a value.
    MissingValue {
        /// The option.
        option: &'static str,
    },
    /// An option is given twice.
    Repeated {
        /// The option.
        option: &'static str,
    },
    /// An angle is given twice.
    RepeatedAngle {
        /// The angle, degrees.
        angle: f64,
    },
    /// A range of angles is not written as one, or leads nowhere.
    NotARange {
        /// The value given.
        value: String,
    },
    /// A value is not a finite number.
    NotANumber {
        /// The option.
        option: &'static str,
        /// The value given.
        value: String,
    },
    /// A number is outside what the option takes.
    OutOfRange {
        /// The option.
        option: &'static str,
        /// The number given.
        value: f64,
        /// Least value.
        low: f64,
        /// Largest value.
        high: f64,
        /// Unit of the three; empty for none.
        unit: &'static str,
    },
    /// Neither `f64` nor `f32`.
    Precision {
        /// The value given.
        value: String,
    },
    /// Duration times rate is too large.
    TooManySamples {
        /// Number of samples asked for.
        samples: f64,
    },
}

impl ArgumentError {
    pub(super) fn unknown(word: &str) -> Self {
        Self::Unknown {
            word: word.to_owned(),
            nearest: nearest(word),
        }
    }
}

/// The option whose beginning and end together share the most letters with
/// `word`, if they are more than half of it.
fn nearest(word: &str) -> Option<&'static str> {
    let letters = word.trim_start_matches('-');
    let shared = |option: &&str| {
        let option = option.trim_start_matches('-');
        let equal = |(a, b): &(char, char)| a.eq_ignore_ascii_case(b);
        let beginning = letters.chars().zip(option.chars());
        let end = letters.chars().rev().zip(option.chars().rev());
        beginning.take_while(equal).count() + end.take_while(equal).count()
    };
    // The last of equals is taken, which is here the first in the list.
    let best = OPTIONS.into_iter().rev().max_by_key(shared)?;
    (2 * shared(&best) > letters.chars().count()).then_some(best)
}

impl fmt::Display for ArgumentError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown { word, nearest } => {
                write!(f, "there is no option `{word}`")?;
                match nearest {
                    Some(option) => write!(f, "; did you mean `{option}`?"),
                    None if word.parse::<f64>().is_ok() => {
                        write!(f, "; initial angles are given as `{ANGLES} {word}`")
                    }
                    None => Ok(()),
                }
            }
            Self::MissingValue { option } => write!(f, "`{option}` needs a value"),
            Self::Repeated { option } => write!(f, "`{option}` is given twice"),
            Self::RepeatedAngle { angle } => {
                write!(f, "`{ANGLES}` has {angle} degrees twice")
            }
            Self::NotARange { value } => write!(
                f,
                "`{value}` is no range of angles: write `FROM:TO:STEP`, as in `40:48:0.1`, \
                 with at most 10000 steps that lead from one end to the other"
            ),
            Self::NotANumber { option, value } => {
                write!(f, "`{option}` needs a number, but got `{value}`")
            }
            Self::OutOfRange {
                option,
                value,
                low,
                high,
                unit,
            } => {
                let gap = if unit.is_empty() { "" } else { " " };
                write!(
                    f,
                    "`{option}` is {value:?}, but must be from {low:?} to {high:?}{gap}{unit}"
                )
            }
            Self::Precision { value } => {
                write!(f, "`{PRECISION}` is `f64` or `f32`, but got `{value}`")
            }
            Self::TooManySamples { samples } => write!(
                f,
                "`{DURATION}` times `{RATE}` makes {samples:e} samples a run, \
                 but {MOST_SAMPLES:e} is the most"
            ),
        }
    }
}

impl std::error::Error for ArgumentError {}
