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

use crate::arrays::Number;
use crate::motions::Motions;

/// A function of Python whose zeros are looked for, as SciPy's: with `terminal` and
/// `direction` as attributes.
pub(crate) struct Watched<'py> {
    name: String,
    function: Bound<'py, PyAny>,
    crossing: Crossing,
    /// Number of the occurrence at which the motion ends; 0 for none.
    terminal: u32,
}

impl<'py> Watched<'py> {
    /// Watches one function, or several in a list.
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
                Some(value) if !value.is_none() => Ok(value.extract::<Number>()?.0),
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
            name,
            function,
            crossing,
            terminal,
        })
    }

    fn value(&self, time: f64, state: &[f64]) -> PyResult<f64> {
        // Functions that are no Python look at no signals.
        self.function.py().check_signals()?;
        let state = PyArray1::from_slice(self.function.py(), state);
        let value = self.function.call1((time, state))?.extract::<Number>();
        let value = value.map_err(|error| {
            let reason = error.value(self.function.py());
            PyTypeError::new_err(format!("the value of {}: {reason}", self.name))
        });
        Ok(value?.0)
    }
}

/// Times and states of each event.
pub(crate) type Crossings = Vec<(Vec<f64>, Vec<f64>)>;

/// Events along a motion, as far as it came, and its end.
pub(crate) struct FoundEvents {
    pub(crate) crossings: Crossings,
    pub(crate) outcome: Result<Solution<f64>, IntegrationError<f64>>,
}

/// Finds events along a motion; the functions are Python's, so that its other threads wait.
///
/// # Errors
/// What a function has raised, or the handler of a signal.
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
