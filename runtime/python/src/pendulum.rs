//! The class `Pendulum`: what trees and compiled models have in common.

use std::num::NonZeroUsize;
use std::sync::Arc;

use branched_pendulum::analysis::variational::{Lyapunov, LyapunovError};
use branched_pendulum::ensemble::Ensemble;
use branched_pendulum::integrate::{
    AnyIntegrator, DenseError, Method, Options, RunError, Tolerance,
};
use branched_pendulum::system::State;
use numpy::{IntoPyArray, PyArray3, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::IntegrationError;
use crate::arrays::{Numbers, Row, Table, by_state, matrix, whole};
use crate::events::{FoundEvents, Watched, find_events};
use crate::failures::{Failures, failed};
use crate::growth::{Growth, GrowthTask, copies};
use crate::motions::{Deviations, Motions};
use crate::smoothing::{SmoothedMotion, Smoother, refused, rows};
use crate::solution::Solution;

/// A pendulum whose motions can be followed: a tree that a text describes, or a compiled model.
///
/// SI units; angles are absolute, in radians from the downward vertical. A state is the angles
/// (rad) followed by the angular velocities (rad/s), both in the order of `names`.
#[pyclass(frozen, subclass, module = "branched_pendulum")]
pub(crate) struct Pendulum {
    pub(crate) motions: Arc<dyn Motions>,
}

/// A method by its name, with its tolerances or its step.
struct Choice<'a> {
    name: &'a str,
    rtol: f64,
    atol: Option<f64>,
    step: Option<f64>,
    max_steps: i128,
}

impl Choice<'_> {
    fn method(&self) -> PyResult<AnyIntegrator<f64>> {
        let method: Method = self
            .name
            .parse()
            .map_err(|error| PyValueError::new_err(format!("{error}")))?;
        if !method.is_adaptive() && self.step.is_none() {
            let text = format!("`{method}` goes by steps of one length: give step=...");
            return Err(PyValueError::new_err(text));
        }
        let mut options = Options::with_tolerance(self.rtol);
        if let Some(atol) = self.atol {
            options.absolute = Tolerance::Uniform(atol);
        }
        options.initial_step = self.step;
        options.step_limit = whole("max_steps", self.max_steps, 1)?;
        Ok(method.with_options(options))
    }
}

/// An ensemble on all cores, or on as many threads as are given.
fn ensemble(threads: Option<i128>) -> PyResult<Ensemble<'static>> {
    let Some(threads) = threads else {
        return Ok(Ensemble::new());
    };
    let threads = NonZeroUsize::new(whole("threads", threads, 1)?);
    Ok(Ensemble::new().threads(threads.unwrap_or(NonZeroUsize::MIN)))
}

/// A trajectory's failure.
fn unfinished(error: RunError<f64, DenseError<f64>>) -> PyErr {
    match error {
        RunError::Integration(error) => failed(error),
        error => IntegrationError::new_err(error.to_string()),
    }
}

#[pymethods]
impl Pendulum {
    /// Names of the links, in the order of the angles.
    #[getter]
    fn names(&self) -> Vec<String> {
        self.motions.names()
    }

    fn __len__(&self) -> usize {
        self.motions.names().len()
    }

    /// Returns the rates of the state `y` at the time `t` (s), as `scipy.integrate.solve_ivp`
    /// asks for them: angular velocities (rad/s), angular accelerations (rad/s²).
    fn rhs<'py>(&self, py: Python<'py>, t: f64, y: Numbers<'py>) -> PyResult<Row<'py>> {
        let state = y.row("y", self.motions.dimension())?;
        let mut rates = vec![0.0; state.len()];
        self.motions.rates(t, &state, &mut rates);
        Ok(rates.into_pyarray(py))
    }

    /// Returns the energy (J) of a state, or of each state of an array of any shape whose last
    /// axis is that of the components.
    fn energy<'py>(&self, py: Python<'py>, y: Numbers<'py>) -> PyResult<Table<'py>> {
        let motions = &self.motions;
        by_state(py, &y, motions.dimension(), |state| [motions.energy(state)])
    }

    /// Follows the motion from the state `y0` at `t[0]`, at the times `t` (s).
    ///
    /// `method` is one of the runtime's: "dop853", "dopri5" and "verner98" take the tolerances
    /// `rtol` and `atol` (by default a thousandth of `rtol`), and `step` as the first step that
    /// is tried; "rk4", "gauss2" to "gauss8" and "animation" go by steps of the length `step`
    /// (s). With `dense_output=True` the solution has its state at any time: `solution(t)`.
    ///
    /// `events` is a function `f(t, y)` whose zeros are found, or a list of several, as SciPy's
    /// are: with `f.terminal = True` the motion ends at the first, with `f.terminal = n` at the
    /// n-th, `f.direction` above or below zero counts rising or falling ones alone. All events
    /// at the time of the last one are told, so that a motion from there tells none again and
    /// misses none. Without events other threads of Python run meanwhile.
    ///
    /// A motion of more than `max_steps` steps raises `IntegrationError`.
    #[pyo3(signature = (y0, t, method = "dop853", rtol = 1e-9, atol = None, step = None, events = None, dense_output = false, max_steps = 1_000_000))]
    #[allow(clippy::too_many_arguments)]
    fn integrate<'py>(
        &self,
        py: Python<'py>,
        y0: Numbers<'py>,
        t: Numbers<'py>,
        method: &str,
        rtol: f64,
        atol: Option<f64>,
        step: Option<f64>,
        events: Option<Bound<'py, PyAny>>,
        dense_output: bool,
        max_steps: i128,
    ) -> PyResult<Solution> {
        let choice = Choice {
            name: method,
            rtol,
            atol,
            step,
            max_steps,
        };
        let method = choice.method()?;
        let mut times = t.list("t")?;
        let (Some(&first), Some(&last)) = (times.first(), times.last()) else {
            return Err(PyValueError::new_err("t has no times"));
        };
        let dimension = self.motions.dimension();
        let start = State::new(first, y0.row("y0", dimension)?);
        let watched = match events {
            Some(events) => Watched::all(&events)?,
            None => Vec::new(),
        };
        let found = match watched.is_empty() {
            true => None,
            false => Some(find_events(
                &*self.motions,
                &method,
                &start,
                last,
                &watched,
            )?),
        };
        let end = found.as_ref().map_or(last, |found| found.end);
        if found.as_ref().is_some_and(FoundEvents::is_stopped) {
            times.retain(|time| (first..=end).contains(time) || (end..=first).contains(time));
        }
        // The motion goes its way again: the search for events keeps no states, and calls of
        // Python take most of its time.
        let motions = &*self.motions;
        let (states, report, trajectory) = py.detach(|| match dense_output {
            false => {
                let (states, report) = motions.sample(&method, &start, &times).map_err(failed)?;
                Ok::<_, PyErr>((states, report, None))
            }
            true => {
                let kept = motions.trajectory(&method, &start, end);
                let (trajectory, report) = kept.map_err(unfinished)?;
                let mut states = Vec::with_capacity(times.len() * dimension);
                for &time in &times {
                    let state = trajectory.at(time);
                    states.extend(
                        state.map_err(|error| IntegrationError::new_err(error.to_string()))?,
                    );
                }
                Ok((states, report, Some(trajectory)))
            }
        })?;
        let (report, crossings) = match found {
            Some(found) => (found.report, found.crossings),
            None => (report, Vec::new()),
        };
        let (mut t_events, mut y_events) = (Vec::new(), Vec::new());
        for (times, states) in crossings {
            t_events.push(times.into_pyarray(py).unbind());
            y_events.push(matrix(py, states, dimension)?.unbind());
        }
        Ok(Solution {
            t: times.into_pyarray(py).unbind(),
            y: matrix(py, states, dimension)?.unbind(),
            t_events,
            y_events,
            report,
            trajectory,
            names: motions.names(),
        })
    }

    /// Follows many motions, one from each row of `starts`, in vector registers on all cores or
    /// as many threads as are given: states by start, time and component, NaN from where a
    /// motion could not be followed. Methods are "dop853", "dopri5" and "verner98". Other
    /// threads of Python run meanwhile.
    ///
    /// Motions that fail, for example by more than `max_steps` steps, are told by one warning,
    /// `FailedMotions`: its `reasons` has the reason of each by the index of its start. To have
    /// them, `warnings.simplefilter("error", FailedMotions)` makes an exception of it, and
    /// `warnings.catch_warnings(record=True)` keeps it beside the states.
    #[pyo3(signature = (starts, t, method = "dop853", rtol = 1e-9, atol = None, threads = None, max_steps = 1_000_000))]
    #[allow(clippy::too_many_arguments)]
    fn ensemble<'py>(
        &self,
        py: Python<'py>,
        starts: Numbers<'py>,
        t: Numbers<'py>,
        method: &str,
        rtol: f64,
        atol: Option<f64>,
        threads: Option<i128>,
        max_steps: i128,
    ) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let choice = Choice {
            name: method,
            rtol,
            atol,
            step: None,
            max_steps,
        };
        let chosen = choice.method()?;
        let times = t.list("t")?;
        let Some(&first) = times.first() else {
            return Err(PyValueError::new_err("t has no times"));
        };
        let dimension = self.motions.dimension();
        let starts = self.starts(&starts, first)?;
        let ensemble = ensemble(threads)?;
        let samples = py.detach(|| self.motions.ensemble(&chosen, &ensemble, &starts, &times));
        let Some(samples) = samples else {
            return Err(PyValueError::new_err(format!(
                "ensembles go by `dop853`, `dopri5` or `verner98`, not by `{method}`"
            )));
        };
        let mut failures = Failures::default();
        for (place, sample) in samples.iter().enumerate() {
            if let Err(failure) = &sample.end {
                failures.note(place, failure)?;
            }
        }
        failures.warn(py, samples.len())?;
        let length = dimension * times.len();
        let mut values = Vec::with_capacity(length * samples.len());
        for sample in &samples {
            let begin = values.len();
            let states = sample.states();
            states.for_each(|state| values.extend_from_slice(state));
            values.resize(begin + length, f64::NAN);
        }
        let shape = [samples.len(), times.len(), dimension];
        values.into_pyarray(py).reshape(shape)
    }

    /// Returns the `count` largest Lyapunov exponents (1/s) of the motion from `y0` at `t0`
    /// (s), the largest first, and their standard errors: deviations in general position are
    /// made orthonormal every `interval` (s), and counted over `intervals` of them after
    /// `settling` others. Other threads of Python run meanwhile.
    ///
    /// A motion of copies in phase stays in phase, and has exponents of two kinds: `within`,
    /// of deviations that are equal in all copies, and `transverse`, of differences between
    /// copies, which grow where the largest is positive. Either takes sets of names of links
    /// that are copies, with all that hangs from them: `within=[("child_1", "child_2")]`.
    #[pyo3(signature = (y0, count = 1, interval = 0.5, settling = 20, intervals = 200, t0 = 0.0, rtol = 1e-9, within = None, transverse = None))]
    #[allow(clippy::too_many_arguments)]
    fn lyapunov<'py>(
        &self,
        py: Python<'py>,
        y0: Numbers<'py>,
        count: i128,
        interval: f64,
        settling: i128,
        intervals: i128,
        t0: f64,
        rtol: f64,
        within: Option<Vec<Vec<String>>>,
        transverse: Option<Vec<Vec<String>>>,
    ) -> PyResult<(Row<'py>, Row<'py>)> {
        let start = State::new(t0, y0.row("y0", self.motions.dimension())?);
        let exponents = Lyapunov {
            count: whole("count", count, 1)?,
            interval,
            settling: whole("settling", settling, 0)?,
            intervals: whole("intervals", intervals, 1)?,
        };
        let starts = std::slice::from_ref(&start);
        let of = |alike: Vec<Vec<String>>| copies(&*self.motions, &alike, starts);
        let deviations = match (within, transverse) {
            (None, None) => Deviations::All,
            (Some(alike), None) => Deviations::Within(of(alike)?),
            (None, Some(alike)) => Deviations::Transverse(of(alike)?),
            _ => {
                let text = "exponents are those `within` motions in phase or `transverse` to them";
                return Err(PyValueError::new_err(text));
            }
        };
        let options = Options::with_tolerance(rtol);
        let spectrum = py.detach(|| {
            self.motions
                .lyapunov(&exponents, &deviations, options, &start)
        });
        let spectrum = spectrum.map_err(|error| match error {
            LyapunovError::Count { .. }
            | LyapunovError::Interval { .. }
            | LyapunovError::NotInPhase => PyValueError::new_err(error.to_string()),
            LyapunovError::Integration(failure) => failed(failure),
            error => IntegrationError::new_err(error.to_string()),
        })?;
        let [exponents, errors] = [spectrum.exponents, spectrum.standard_errors];
        Ok((exponents.into_pyarray(py), errors.into_pyarray(py)))
    }

    /// Follows motions from each row of `starts`, at rest or not, with a vanishing difference
    /// between two identical links beside them, and returns its `Growth` up to the `horizons`
    /// (s) after the start. The links are given by their names, and start alike with all that
    /// hangs from them.
    ///
    /// Growth is looked at 32 times a period of `frequency` (Hz), by default that of the
    /// difference beside all links hanging at rest. The tolerance `rtol` is used with a
    /// hundredth of it besides, whose result is returned. All cores are used, or as many
    /// threads as are given; other threads of Python run meanwhile. Motions that could not be
    /// followed are NaN, and told by the warning `FailedMotions`, as those of `ensemble`.
    #[pyo3(signature = (starts, pair, horizons, frequency = None, rtol = 1e-9, threads = None))]
    #[allow(clippy::too_many_arguments)]
    fn growth(
        &self,
        py: Python<'_>,
        starts: Numbers<'_>,
        pair: Vec<String>,
        horizons: Numbers<'_>,
        frequency: Option<f64>,
        rtol: f64,
        threads: Option<i128>,
    ) -> PyResult<Growth> {
        let task = GrowthTask {
            starts: self.starts(&starts, 0.0)?,
            horizons: horizons.list("horizons")?,
            frequency_hz: frequency,
            tolerance: rtol,
        };
        task.grown(py, &*self.motions, &pair, &ensemble(threads)?)
    }

    /// Returns the motion behind measured angles `theta` (rad from the downward vertical, a
    /// column for each link; NaN where they are missing) at times `t` (s), which may be uneven.
    ///
    /// "kinematic" knows that the motion is smooth and no more; "polynomials" fits one near each
    /// time, a cross-check; "equations" knows the equations of motion, of pendulums of up to
    /// four links, and finds out how much they lack: errors are far smaller where they hold.
    /// With `friction` they also find friction that they lack, where the data show some. Noise
    /// is found from the data, unless `noise` (rad) is given. A compiled model is smoothed in
    /// its symmetric coordinates. Other threads of Python run meanwhile.
    #[pyo3(signature = (t, theta, method = "kinematic", noise = None, friction = false))]
    fn smooth(
        &self,
        py: Python<'_>,
        t: Numbers<'_>,
        theta: Numbers<'_>,
        method: &str,
        noise: Option<f64>,
        friction: bool,
    ) -> PyResult<SmoothedMotion> {
        let (times, angles) = (t.list("t")?, rows("theta", &theta, t.shape())?);
        let names = self.motions.names();
        let columns = angles.first().map_or(0, Vec::len);
        if columns != names.len() {
            let links = names.len();
            let text = format!("theta has {columns} columns, must have {links}, one for each link");
            return Err(PyValueError::new_err(text));
        }
        let by_equations = method == "equations";
        if friction && !by_equations {
            let text = format!("friction = True needs method = \"equations\", not {method:?}");
            return Err(PyValueError::new_err(text));
        }
        let first = if by_equations { "kinematic" } else { method };
        let smoother = Smoother::of(first, noise).ok_or_else(|| {
            let words = r#"must be "kinematic", "polynomials" or "equations""#;
            PyValueError::new_err(format!("method is {method:?}, {words}"))
        })?;
        let motions = &self.motions;
        let estimate = py.detach(|| {
            let estimate = smoother.estimate(&times, &angles, motions.smoothed_coordinates())?;
            match by_equations {
                true => motions.smooth(noise, friction, &times, &angles, &estimate.states[0]),
                false => Ok(estimate),
            }
        });
        SmoothedMotion::of(py, times, names, estimate.map_err(refused)?)
    }
}

impl Pendulum {
    /// States at a time, from the rows of an array.
    fn starts(&self, starts: &Numbers<'_>, time: f64) -> PyResult<Vec<State<f64>>> {
        let rows = starts.rows("starts", self.motions.dimension())?;
        Ok(rows.into_iter().map(|row| State::new(time, row)).collect())
    }
}
