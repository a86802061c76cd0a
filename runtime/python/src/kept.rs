//! States of a motion that are kept for Python, as far as the motion was computed.

use branched_pendulum::integrate::{DenseError, Report, RunError, Trajectory};

/// Times at which states of a motion are requested.
#[derive(Clone, Copy)]
pub(crate) enum OutputTimes<'a> {
    At {
        times: &'a [f64],
        /// End of the motion: the last of these times, or a later event.
        end: f64,
    },
    /// The ends of all steps up to this time.
    AllSteps(f64),
}

/// States of a motion at the requested times, up to its end.
pub(crate) struct Kept {
    pub(crate) times: Vec<f64>,
    pub(crate) states: Vec<f64>,
    /// All steps of the motion, if dense output is requested.
    pub(crate) trajectory: Option<Trajectory<f64>>,
}

/// Why nothing more is kept.
pub(crate) enum KeepError {
    Dense(DenseError<f64>),
    Memory,
}

impl Kept {
    /// Adds a state.
    pub(crate) fn push(&mut self, time: f64, state: &[f64]) -> Result<(), KeepError> {
        let is_there = self.times.try_reserve(1).is_ok();
        if !(is_there && self.states.try_reserve(state.len()).is_ok()) {
            return Err(KeepError::Memory);
        }
        self.times.push(time);
        self.states.extend_from_slice(state);
        Ok(())
    }

    /// Adds the states at those requested times that the steps have reached; all of them if the
    /// motion reached its end.
    pub(crate) fn sample(&mut self, times: &[f64], at_end: bool) -> Result<(), KeepError> {
        let Some(trajectory) = self.trajectory.take() else {
            return Ok(());
        };
        for &time in times {
            match trajectory.at(time) {
                Ok(state) => self.push(time, &state)?,
                Err(DenseError::OutsideStep { .. }) if !at_end => break,
                Err(error) => return Err(KeepError::Dense(error)),
            }
        }
        self.trajectory = Some(trajectory);
        Ok(())
    }
}

/// Outcome of a run: its report, or the error that ended it early.
pub(crate) type End = Result<Report<f64>, Box<RunError<f64, KeepError>>>;
