//! Events whose functions are Python's.

use std::cell::RefCell;
use std::ops::ControlFlow;

use branched_pendulum::integrate::{
    AnyIntegrator, Crossing, Event, Occurrence, Report, StopReason,
};
use branched_pendulum::system::State;
use numpy::PyArray1;
use pyo3::prelude::*;

use crate::motions::Motions;
use crate::pendulum::failed;

/// A function of Python whose zeros are looked for, as SciPy's: with `terminal` and
/// `direction` as attributes.
pub(crate) struct Watched<'py> {
    function: Bound<'py, PyAny>,
    crossing: Crossing,
    terminal: bool,
}

impl<'py> Watched<'py> {
    pub(crate) fn of(function: Bound<'py, PyAny>) -> PyResult<Self> {
        let direction = match function.getattr_opt("direction")? {
            Some(direction) => direction.extract::<f64>()?,
            None => 0.0,
        };
        let terminal = match function.getattr_opt("terminal")? {
            Some(terminal) => terminal.is_truthy()?,
            None => false,
        };
        let crossing = match direction {
            up if up > 0.0 => Crossing::Rising,
            down if down < 0.0 => Crossing::Falling,
            _ => Crossing::Either,
        };
        Ok(Self {
            function,
            crossing,
            terminal,
        })
    }

    fn value(&self, time: f64, state: &[f64]) -> PyResult<f64> {
        let state = PyArray1::from_slice(self.function.py(), state);
        self.function.call1((time, state))?.extract()
    }
}

/// Times and states of each event, the end of the run and its account.
pub(crate) struct FoundEvents {
    pub(crate) crossings: Vec<(Vec<f64>, Vec<f64>)>,
    pub(crate) end: f64,
    pub(crate) report: Report<f64>,
}

impl FoundEvents {
    /// Returns true if the run ended at a terminal event.
    pub(crate) fn is_stopped(&self) -> bool {
        self.report.stop == StopReason::StoppedByEvent
    }
}

/// Finds events along a motion; the functions are Python's, so that its other threads wait.
pub(crate) fn find_events(
    motions: &dyn Motions,
    method: &AnyIntegrator<f64>,
    start: &State<f64>,
    end: f64,
    watched: &[Watched<'_>],
) -> PyResult<FoundEvents> {
    let error = RefCell::new(None);
    let first = &error;
    let functions = watched.iter().map(|watched| {
        move |time: f64, state: &[f64]| match watched.value(time, state) {
            Ok(value) => value,
            Err(own) => {
                first.borrow_mut().get_or_insert(own);
                // It ends the run.
                f64::NAN
            }
        }
    });
    let functions: Vec<_> = functions.collect();
    let events = functions.iter().zip(watched);
    let events: Vec<Event<'_, f64>> = events
        .map(|(function, watched)| Event::new(watched.crossing, function))
        .collect();
    let mut crossings = vec![(Vec::new(), Vec::new()); watched.len()];
    let mut visit = |occurrence: Occurrence<'_, f64>| {
        if let Some((times, states)) = crossings.get_mut(occurrence.event) {
            times.push(occurrence.time);
            states.extend_from_slice(occurrence.state);
        }
        match watched
            .get(occurrence.event)
            .is_some_and(|event| event.terminal)
        {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    };
    let run = motions.events(method, start, end, &events, &mut visit);
    if let Some(error) = error.take() {
        return Err(error);
    }
    let solution = run.map_err(failed)?;
    Ok(FoundEvents {
        crossings,
        end: solution.state.time,
        report: solution.report,
    })
}
