//! Events whose functions are Python's.

use std::cell::RefCell;
use std::ops::ControlFlow;

use branched_pendulum::integrate::{
    AnyIntegrator, Crossing, Event, IntegrationError, Occurrence, Solution,
};
use branched_pendulum::system::State;
use numpy::PyArray1;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

use crate::arguments::Argument;
use crate::motions::Motions;

/// A Python function whose zeros are events, as in SciPy: its attributes `terminal` and `direction`
/// are used.
pub(crate) struct Watched<'py> {
    /// Name for the function's value in messages.
    value_name: String,
    function: Bound<'py, PyAny>,
    crossing: Crossing,
    /// Number of the occurrence at which the motion ends; 0 if it never ends the motion.
    terminal: u32,
}

impl<'py> Watched<'py> {
    /// Reads the events from one Python function, or from a list of functions.
    pub(crate) fn all(events: &Bound<'py, PyAny>) -> PyResult<Vec<Self>> {
        if events.is_callable() {
            return Ok(vec![Self::of("events".to_owned(), events.clone())?]);
        }
        let Ok(several) = events.try_iter() else {
            let text = format!("events must be a function f(t, y) or a list of them, got {events}");
            return Err(PyTypeError::new_err(text));
        };
        let several = several.enumerate();
        several
            .map(|(index, function)| Self::of(format!("events[{index}]"), function?))
            .collect()
    }

    fn of(name: String, function: Bound<'py, PyAny>) -> PyResult<Self> {
        if !function.is_callable() {
            let text = format!("{name} must be a function f(t, y), got {function}");
            return Err(PyTypeError::new_err(text));
        }
        let attribute = |word: &str| -> PyResult<f64> {
            match function.getattr_opt(word)? {
                Some(value) if !value.is_none() => f64::of(&format!("{name}.{word}"), &value),
                _ => Ok(0.0),
            }
        };
        let (direction, terminal) = (attribute("direction")?, attribute("terminal")?);
        if !(terminal >= 0.0 && terminal.fract() == 0.0) {
            let text = format!(
                "{name}.terminal must be True, False or a positive integer, got {terminal}"
            );
            return Err(PyValueError::new_err(text));
        }
        // More than a run can have end none.
        let terminal = terminal as u32;
        let crossing = match direction {
            up if up > 0.0 => Crossing::Rising,
            down if down < 0.0 => Crossing::Falling,
            _ => Crossing::Either,
        };
        Ok(Self {
            value_name: format!("the value of {name}"),
            function,
            crossing,
            terminal,
        })
    }

    fn value(&self, time: f64, state: &[f64]) -> PyResult<f64> {
        // Functions that are no Python look at no signals.
        self.function.py().check_signals()?;
        let state = PyArray1::from_slice(self.function.py(), state);
        let value = self.function.call1((time, state))?;
        f64::of(&self.value_name, &value)
    }
}

/// Times and states of all occurrences of each event.
pub(crate) type Crossings = Vec<(Vec<f64>, Vec<f64>)>;

/// Events found along a motion, as far as it was computed, and how it ended.
pub(crate) struct FoundEvents {
    pub(crate) crossings: Crossings,
    pub(crate) outcome: Result<Solution<f64>, IntegrationError<f64>>,
}

/// Finds events along a motion. Their functions are called in Python, so that other Python threads
/// wait meanwhile.
///
/// # Errors
/// The exception that a function or the handler of a signal has raised.
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
        .map(|(function, watched)| {
            Event::new(watched.crossing, function).with_terminal(watched.terminal)
        })
        .collect();
    let mut crossings = vec![(Vec::new(), Vec::new()); watched.len()];
    let mut visit = |occurrence: Occurrence<'_, f64>| {
        if let Some((times, states)) = crossings.get_mut(occurrence.event) {
            times.push(occurrence.time);
            states.extend_from_slice(occurrence.state);
        }
        ControlFlow::Continue(())
    };
    let outcome = motions.events(method, start, end, &events, &mut visit);
    match error.take() {
        Some(error) => Err(error),
        None => Ok(FoundEvents { crossings, outcome }),
    }
}
