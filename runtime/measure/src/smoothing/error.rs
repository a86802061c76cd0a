//! Errors in smoothing data.

use core::fmt;

/// Reason why data could not be smoothed.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum SmoothingError {
    /// The number of data, or of states of a guess, is not the number of times.
    Length {
        /// Number of times.
        times: usize,
        /// Name of the argument with another number of rows: `data` or `guess`.
        rows: &'static str,
        /// Number of its rows.
        found: usize,
    },
    /// There are too few data that are not missing. Smoothing needs four; polynomials need two more
    /// than their degree, equations of motion one more than the number of components of a state.
    TooFew {
        /// Number of data given.
        found: usize,
        /// Number of data needed.
        needed: usize,
    },
    /// A time is not finite, or not later than the one before.
    Time {
        /// Index of the time.
        index: usize,
        /// The time, s.
        value: f64,
    },
    /// A datum is infinite or NaN.
    Datum {
        /// Index of the datum.
        index: usize,
        /// Value of the datum.
        value: f64,
    },
    /// The system's dimension is odd, but a state is angles followed by their rates.
    Dimension {
        /// Dimension of the system.
        dimension: usize,
    },
    /// A row does not have one number for each angle of the system, or, in a guess, one for each
    /// angle and rate.
    Row {
        /// Name of the argument with the row: `data`, `guess`, `disturbances` or `frictions`.
        rows: &'static str,
        /// Index of the row, in `frictions` within its kind.
        index: usize,
        /// Number of entries in the row.
        found: usize,
        /// Number of entries needed.
        needed: usize,
    },
    /// The model's motion departs from the data, or its integration failed.
    Diverged,
    /// The mass matrix at a time is not positive definite, or does not have a row and a column for
    /// each angle.
    Mass {
        /// Index of the time.
        index: usize,
        /// Number of angles.
        angles: usize,
    },
    /// An option is invalid: a noise, jerk or density that is not finite and positive, or a degree
    /// or window of polynomials outside its range.
    Option {
        /// Name of the option.
        name: &'static str,
        /// The value given.
        value: f64,
    },
}

impl fmt::Display for SmoothingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Length { times, rows, found } => match *rows {
                "data" => write!(f, "{times} times for {found} data"),
                rows => write!(f, "{times} times for {found} states of the {rows}"),
            },
            Self::TooFew { found, needed } => write!(
                f,
                "{found} data that are not missing; smoothing needs {needed}"
            ),
            Self::Time { index, value } => write!(
                f,
                "time {index} is {value} s: times are finite and each later than the one before"
            ),
            Self::Datum { index, value } => {
                write!(f, "datum {index} is {value}; write missing ones as `None`")
            }
            Self::Dimension { dimension } => write!(
                f,
                "a system of dimension {dimension}: a state is angles, followed by as many rates"
            ),
            Self::Row {
                rows,
                index,
                found,
                needed,
            } => write!(
                f,
                "row {index} of the {rows} has {found} numbers; the equations of motion need {needed}"
            ),
            Self::Diverged => write!(f, "the motion of the model does not stay near the data"),
            Self::Mass { index, angles } => write!(
                f,
                "the mass matrix at time {index} is not positive definite with a row and a column \
                 for each of {angles} angles"
            ),
            Self::Option {
                name: name @ ("degree" | "window"),
                value,
            } => write!(
                f,
                "the {name} is {value}: degrees are 2 to 8, windows wider"
            ),
            Self::Option { name, value } => {
                write!(f, "the {name} is {value}: it must be finite and positive")
            }
        }
    }
}

impl core::error::Error for SmoothingError {}

/// Smallest number of data: a parabola passes through any three.
const FEWEST: usize = 4;

/// Checks the data and the times: there must be one datum for each time and enough of them, all
/// must be finite, and times must ascend.
pub(super) fn check_data(times: &[f64], data: &[Option<f64>]) -> Result<(), SmoothingError> {
    check_length(times, "data", data.len())?;
    let (found, needed) = (data.iter().flatten().count(), FEWEST);
    if found < needed {
        return Err(SmoothingError::TooFew { found, needed });
    }
    for (index, datum) in data.iter().enumerate() {
        if let Some(value) = *datum
            && !value.is_finite()
        {
            return Err(SmoothingError::Datum { index, value });
        }
    }
    check_times(times)
}

/// Checks that the number of rows is the number of times.
pub(super) fn check_length(
    times: &[f64],
    rows: &'static str,
    found: usize,
) -> Result<(), SmoothingError> {
    let times = times.len();
    match times == found {
        true => Ok(()),
        false => Err(SmoothingError::Length { times, rows, found }),
    }
}

/// Returns the first time that is not finite or not later than the one before, with its index;
/// `None` if there is none.
pub(crate) fn misplaced(times: &[f64]) -> Option<(usize, f64)> {
    let is_misplaced = |&(index, time): &(usize, &f64)| {
        !(time.is_finite() && (index == 0 || *time > times[index - 1]))
    };
    let found = times.iter().enumerate().find(is_misplaced);
    found.map(|(index, &time)| (index, time))
}

pub(super) fn check_times(times: &[f64]) -> Result<(), SmoothingError> {
    match misplaced(times) {
        Some((index, value)) => Err(SmoothingError::Time { index, value }),
        None => Ok(()),
    }
}

pub(super) fn check_option(name: &'static str, value: Option<f64>) -> Result<(), SmoothingError> {
    match value {
        Some(value) if !(value.is_finite() && value > 0.0) => {
            Err(SmoothingError::Option { name, value })
        }
        _ => Ok(()),
    }
}

/// Returns the median of the intervals between two or more times.
pub(super) fn usual_interval(times: &[f64]) -> f64 {
    let mut intervals: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let middle = intervals.len() / 2;
    *intervals.select_nth_unstable_by(middle, f64::total_cmp).1
}
