//! Unmarked faults in a record, found by the equations of motion.

use std::ops::Range;

use branched_pendulum_data::{Basis, Finding};

use super::source::Source;
use super::subject::MeasuredTree;
use crate::Failure;

/// Number of leaps that a finding lists before it only counts the others.
const NAMED: usize = 6;

/// Ranges of rows within which the motion of a record leaps.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Leaps {
    /// Rows of each leap: from the first one to after the last one.
    pub rows: Vec<Range<usize>>,
    /// First and last times, s.
    pub times: Vec<[f64; 2]>,
}

impl Leaps {
    /// Searches for leaps in the record of a tree.
    ///
    /// # Errors
    /// [`Failure::Smoothing`].
    pub fn of(subject: &MeasuredTree, source: &Source) -> Result<Self, Failure> {
        let rows = subject.leaps(source.record())?;
        let ends = |rows: &Range<usize>| [source.times[rows.start], source.times[rows.end - 1]];
        Ok(Self {
            times: rows.iter().map(ends).collect(),
            rows,
        })
    }

    /// Returns the finding about the leaps; `None` if there are none.
    pub fn finding(&self) -> Option<Finding> {
        // Rounded outwards, so that an option names them in few digits.
        let rounded = |[from, to]: &[f64; 2]| [(1e4 * from).floor() / 1e4, (1e4 * to).ceil() / 1e4];
        let times: Vec<[f64; 2]> = self.times.iter().map(rounded).collect();
        let (first, last) = (times.first()?, times.last()?);
        let named = times.iter().take(NAMED);
        let named = named.map(|[from, to]| format!("{from} s to {to} s"));
        let more = self.times.len().saturating_sub(NAMED);
        let more = (more > 0).then(|| format!("{more} more"));
        let places: Vec<String> = named.chain(more).collect();
        let text = format!(
            "the record leaps where the equations of motion do not: {}. There, or between two of them, \
             angles may step, change their sign, be frozen, late or exchanged, or rows be lost; \
             `--leave-out {}:{}` leaves the rows out",
            places.join(", "),
            first[0],
            if self.times.len() == 2 {
                last[1]
            } else {
                first[1]
            },
        );
        let basis = Basis::Doubtful;
        Some(Finding { basis, text })
    }
}
