//! Trajectories that are read from files, which may contain invalid data.

// The derived code of a public type names the type.
#![allow(unreachable_pub)]

use alloc::vec::Vec;

use super::{Kept, Trajectory};
use crate::errors::errors;
use crate::scalar::Real;

/// Content of a file that should contain a trajectory, before it is checked.
#[derive(serde::Deserialize)]
#[serde(rename = "Trajectory")]
pub struct Unchecked<T> {
    dimension: usize,
    times: Vec<T>,
    steps: Vec<Kept<T>>,
    numbers: Vec<T>,
}

errors! {
    /// Why data are no trajectory.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum TrajectoryDataError {
        /// There are too few numbers for a first state.
        Dimension { dimension: usize, numbers: usize }
            => "`dimension` is {dimension}, and `numbers` has {numbers} numbers: the state of the \
                start is missing",
        /// The number of times is not one more than the number of steps.
        Times { times: usize, steps: usize }
            => "`times` has {times} times, and `steps` {steps} steps: there must be one more time \
                than steps",
        /// A time is not finite, or is not in the order of the run.
        Time { index: usize }
            => "`times[{index}]` must be finite, and continue in the direction of the previous \
                times",
        /// The length of a step is not finite.
        Length { index: usize } => "`steps[{index}].length` is not finite",
        /// The index of a step's first number is wrong.
        First { index: usize, first: usize, expected: usize }
            => "`steps[{index}].first` is {first}: the numbers of this step begin at {expected}",
        /// A polynomial that is none.
        Terms { index: usize, terms: [usize; 2], dimension: usize }
            => "`steps[{index}].terms` is {terms:?}: for a state of `dimension` {dimension}, a \
                polynomial of this `form` cannot have this number of terms",
        /// There are fewer numbers than a step needs.
        Short { index: usize, numbers: usize }
            => "`numbers` has {numbers} numbers: the numbers of `steps[{index}]` are missing",
        /// Numbers of no step.
        Long { numbers: usize, expected: usize }
            => "`numbers` has {numbers} numbers: according to `dimension` and `steps` it must \
                have {expected}",
    }
}

impl<T: Real> TryFrom<Unchecked<T>> for Trajectory<T> {
    type Error = TrajectoryDataError;

    fn try_from(data: Unchecked<T>) -> Result<Self, TrajectoryDataError> {
        use TrajectoryDataError as Error;
        let Unchecked {
            dimension,
            times,
            steps,
            numbers,
        } = data;
        if times.len() != steps.len() + 1 {
            let (times, steps) = (times.len(), steps.len());
            return Err(Error::Times { times, steps });
        }
        check_times(&times)?;
        let found = numbers.len();
        let Some(mut left) = found.checked_sub(dimension) else {
            let numbers = found;
            return Err(Error::Dimension { dimension, numbers });
        };
        for (index, step) in steps.iter().enumerate() {
            let (expected, terms) = (found - left, step.terms);
            if !step.length.is_finite() {
                return Err(Error::Length { index });
            }
            if !step.form.fits(dimension, terms) {
                return Err(Error::Terms {
                    index,
                    terms,
                    dimension,
                });
            }
            if step.first != expected {
                return Err(Error::First {
                    index,
                    first: step.first,
                    expected,
                });
            }
            let own = [dimension, dimension, terms[0], terms[1]];
            let rest = own
                .iter()
                .try_fold(left, |left, &own| left.checked_sub(own));
            left = rest.ok_or(Error::Short {
                index,
                numbers: found,
            })?;
        }
        if left > 0 {
            return Err(Error::Long {
                numbers: found,
                expected: found - left,
            });
        }
        Ok(Self {
            dimension,
            times,
            steps,
            numbers,
        })
    }
}

/// Checks that times are finite, and that they all increase or all decrease.
fn check_times<T: Real>(times: &[T]) -> Result<(), TrajectoryDataError> {
    let forwards = times.first() <= times.last();
    let goes_on = |pair: &[T]| (pair[0] <= pair[1]) == forwards || pair[0] == pair[1];
    let turns = times.windows(2).position(|pair| !goes_on(pair));
    if let Some(index) = times.iter().position(|time| !time.is_finite()) {
        return Err(TrajectoryDataError::Time { index });
    }
    match turns {
        Some(index) => Err(TrajectoryDataError::Time { index: index + 1 }),
        None => Ok(()),
    }
}
