//! One motion: `Pendulum.integrate`.

use branched_pendulum::integrate::{AnyIntegrator, Method, Report, RunError, Trajectory};
use branched_pendulum::system::State;
use numpy::IntoPyArray;
use pyo3::exceptions::{PyMemoryError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyList;

use crate::IntegrationError;
use crate::arrays::{Numbers, Times, matrix};
use crate::events::{Crossings, Watched, find_events};
use crate::failures::failed;
use crate::interrupts::detached;
use crate::kept::{End, KeepError, Kept, OutputTimes};
use crate::memory::allocate;
use crate::motions::Motions;
use crate::pendulum::Pendulum;
use crate::results::{Compared, DenseOutput, report, result};
use crate::stepping::Stepping;

/// A motion to follow.
struct Motion<'a> {
    motions: &'a dyn Motions,
    name: Method,
    method: AnyIntegrator<f64>,
    start: State<f64>,
    dense: bool,
    /// Method and precision (rad) of a second run to compare with; `None` without comparison.
    finer: Option<(AnyIntegrator<f64>, f64)>,
}

impl Motion<'_> {
    /// Integrates the motion. If it fails, the results up to the last good state are returned too.
    fn follow(&self, py: Python<'_>, wanted: OutputTimes<'_>) -> PyResult<(Kept, End)> {
        let dimension = self.start.values.len();
        let (times, states) = match wanted {
            OutputTimes::At { times, .. } => (
                allocate(&[times.len()])?,
                allocate(&[times.len(), dimension])?,
            ),
            OutputTimes::AllSteps(_) => (Vec::new(), Vec::new()),
        };
        let mut kept = Kept {
            times,
            states,
            trajectory: self.dense.then(|| Trajectory::new(self.start.clone())),
        };
        let end = detached(py, || {
            self.motions
                .follow(&self.method, &self.start, wanted, &mut kept)
        })?;
        if let Err(error) = &end
            && let RunError::Integration(failure) = &**error
            && let Some(last) = failure.last_state()
            && kept.times.last() != Some(&last.time)
        {
            // Without room for it the failure counts.
            drop(kept.push(last.time, &last.values));
        }
        Ok((kept, end))
    }

    fn solution<'py>(
        &self,
        py: Python<'py>,
        kept: Kept,
        account: &Report<f64>,
        crossings: Crossings,
    ) -> PyResult<Bound<'py, PyAny>> {
        let dimension = self.start.values.len();
        let compared = self.compared(py, &kept)?;
        let (t_events, y_events) = (PyList::empty(py), PyList::empty(py));
        for (times, states) in crossings {
            t_events.append(times.into_pyarray(py))?;
            y_events.append(matrix(py, states, dimension)?)?;
        }
        let dense = kept.trajectory.map(|trajectory| DenseOutput {
            trajectory,
            dimension,
        });
        let fields = [
            ("t", kept.times.into_pyarray(py).into_any()),
            ("y", matrix(py, kept.states, dimension)?.into_any()),
            ("t_events", t_events.into_any()),
            ("y_events", y_events.into_any()),
            ("report", report(py, self.name, account, compared)?),
            ("names", self.motions.names().into_pyobject(py)?.into_any()),
            ("dense", dense.into_pyobject(py)?.into_any()),
        ];
        result(py, "Solution", &fields)
    }

    /// Compares the motion with a run of the finer method, if there is one.
    fn compared(&self, py: Python<'_>, kept: &Kept) -> PyResult<Option<Compared>> {
        let Some((finer, precision)) = &self.finer else {
            return Ok(None);
        };
        let found = detached(py, || {
            let motions = self.motions;
            motions.differs_from([&self.method, finer], &self.start, &kept.times, *precision)
        })?;
        Ok(Some(Compared {
            precision: *precision,
            differs_from: found.map_err(failed)?,
        }))
    }

    /// Returns the solution, or raises an exception that contains the results so far.
    fn end<'py>(
        &self,
        py: Python<'py>,
        (kept, end): (Kept, End),
        crossings: Crossings,
    ) -> PyResult<Bound<'py, PyAny>> {
        let error = match end {
            Ok(account) => return self.solution(py, kept, &account, crossings),
            Err(error) => *error,
        };
        let failure = match error {
            RunError::Integration(failure) => failure,
            RunError::Observer { error, .. } => {
                return Err(match error {
                    KeepError::Memory => PyMemoryError::new_err("no memory for all steps is left"),
                    KeepError::Dense(error) => IntegrationError::new_err(error.to_string()),
                });
            }
            _ => return Err(IntegrationError::new_err("the motion could not be kept")),
        };
        let account = failure.report().copied();
        let error = failed(failure);
        if let Some(account) = account {
            let solution = self.solution(py, kept, &account, crossings)?;
            error.value(py).setattr("solution", solution)?;
        }
        Err(error)
    }
}

impl Pendulum {
    #[allow(clippy::too_many_arguments)]
    pub(crate) fn follow<'py>(
        &self,
        py: Python<'py>,
        y0: &Numbers<'py>,
        t: &Times<'py>,
        stepping: &Stepping<'_, 'py>,
        events: Option<&Bound<'py, PyAny>>,
        dense: bool,
        precision: Option<f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let motions = &*self.motions;
        let dimension = motions.dimension();
        let method = stepping.integrator(dimension)?;
        let finer = match precision {
            None => None,
            Some(precision) if precision > 0.0 && precision.is_finite() => {
                Some((stepping.finer(dimension)?, precision))
            }
            Some(precision) => {
                let text = format!("precision is {precision}, must be positive and finite");
                return Err(PyValueError::new_err(text));
            }
        };
        let mut times = t.numbers.list("t")?;
        let (Some(&first), Some(&last)) = (times.first(), times.last()) else {
            return Err(PyValueError::new_err("t has no times"));
        };
        let motion = Motion {
            motions,
            name: stepping.method()?,
            method,
            start: State::new(first, y0.row("y0", dimension)?),
            dense,
            finer,
        };
        let watched = match events {
            Some(events) => Watched::all(events)?,
            None => Vec::new(),
        };
        if watched.is_empty() {
            let kept = motion.follow(py, wanted(t.is_span, &times, last))?;
            return motion.end(py, kept, Vec::new());
        }
        let found = find_events(motions, &motion.method, &motion.start, last, &watched)?;
        let (end, account) = match found.outcome {
            Ok(solution) => (solution.state.time, Ok(solution.report)),
            Err(failure) => match failure.last_state() {
                Some(last) => (last.time, Err(Box::new(RunError::Integration(failure)))),
                None => return Err(failed(failure)),
            },
        };
        if end != last {
            times.retain(|time| (first..=end).contains(time) || (end..=first).contains(time));
        }
        // The motion goes its way again: the search for events keeps no states, and calls of
        // Python take most of its time.
        let (kept, own) = motion.follow(py, wanted(t.is_span, &times, end))?;
        motion.end(py, (kept, own.and(account)), found.crossings)
    }
}

fn wanted(is_span: bool, times: &[f64], end: f64) -> OutputTimes<'_> {
    match is_span {
        true => OutputTimes::AllSteps(end),
        false => OutputTimes::At { times, end },
    }
}
