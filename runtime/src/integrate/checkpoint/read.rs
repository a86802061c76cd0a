//! Reading of checkpoints from files, with a check of every field.

use alloc::vec::Vec;

use super::Checkpoint;
use crate::errors::errors;
use crate::integrate::report::Report;
use crate::scalar::Real;
use crate::system::State;

/// Checkpoint as read from a file, before its fields are checked.
#[derive(serde::Deserialize)]
#[serde(rename = "Checkpoint")]
pub struct Unchecked<T> {
    time: T,
    residue: T,
    reached: State<T>,
    direction: T,
    report: Report<T>,
    memory: Vec<T>,
}

errors! {
    /// Reasons why data are not a valid checkpoint.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum CheckpointDataError {
        /// A number is infinite or NaN.
        NotFinite { field: &'static str } => "`{field}` is not finite",
        /// The direction is neither 1 nor −1.
        Direction => "`direction` must be 1 or -1",
        /// A count is larger than any run can reach.
        Count { field: &'static str, count: u64 }
            => "`report.{field}` is {count}: it is larger than in any real run",
    }
}

/// Upper limit of step and evaluation counts: more than a thousand years of computing.
const MOST: u64 = 1 << 62;

impl<T: Real> TryFrom<Unchecked<T>> for Checkpoint<T> {
    type Error = CheckpointDataError;

    fn try_from(data: Unchecked<T>) -> Result<Self, CheckpointDataError> {
        let Unchecked {
            time,
            residue,
            reached,
            direction,
            report,
            memory,
        } = data;
        let numbers = [
            ("time", time),
            ("residue", residue),
            ("reached.time", reached.time),
        ];
        if let Some((field, _)) = numbers.iter().find(|(_, number)| !number.is_finite()) {
            return Err(CheckpointDataError::NotFinite { field });
        }
        if direction.abs() != T::ONE {
            return Err(CheckpointDataError::Direction);
        }
        let counts = [
            ("accepted", report.accepted),
            ("rejected", report.rejected),
            ("evaluations", report.evaluations),
        ];
        if let Some(&(field, count)) = counts.iter().find(|(_, count)| *count > MOST) {
            return Err(CheckpointDataError::Count { field, count });
        }
        Ok(Self {
            time,
            residue,
            reached,
            direction,
            report,
            memory,
        })
    }
}
