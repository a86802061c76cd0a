//! Checkpoints from files, which may say anything.

use alloc::vec::Vec;

use super::Checkpoint;
use crate::errors::errors;
use crate::integrate::report::Report;
use crate::scalar::Real;
use crate::system::State;

/// A checkpoint as a file has it.
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
    /// Why data are no checkpoint.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum CheckpointDataError {
        /// A number that is none.
        NotFinite { field: &'static str } => "`{field}` is not finite",
        /// Neither forwards nor backwards.
        Direction => "`direction` must be 1 or -1",
        /// More than can have been counted.
        Count { field: &'static str, count: u64 }
            => "`report.{field}` is {count}: no run has counted so far",
    }
}

/// More steps and evaluations than are made in a thousand years.
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
