//! A motion that was followed.

use branched_pendulum::integrate::{Report, Trajectory};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arrays::{Numbers, Table, frame, state_names};

/// A motion at the times asked for, and between them where it was asked for with
/// `dense_output=True`: `solution(t)`.
#[pyclass(frozen, module = "branched_pendulum")]
pub(crate) struct Solution {
    /// Times, s: those asked for, up to that of a terminal event.
    #[pyo3(get)]
    pub(crate) t: Py<PyArray1<f64>>,
    /// States, a row for each time: angles (rad), angular velocities (rad/s).
    #[pyo3(get)]
    pub(crate) y: Py<PyArray2<f64>>,
    /// Times (s) at which each of the events came, an array for each.
    #[pyo3(get)]
    pub(crate) t_events: Vec<Py<PyArray1<f64>>>,
    /// States at these times, a matrix for each event.
    #[pyo3(get)]
    pub(crate) y_events: Vec<Py<PyArray2<f64>>>,
    pub(crate) report: Report<f64>,
    pub(crate) trajectory: Option<Trajectory<f64>>,
    pub(crate) names: Vec<String>,
}

#[pymethods]
impl Solution {
    /// The account of the run, in words.
    #[getter]
    fn report(&self) -> String {
        self.report.to_string()
    }

    /// Number of accepted steps.
    #[getter]
    fn steps(&self) -> u64 {
        self.report.accepted
    }

    /// Number of evaluations of the accelerations.
    #[getter]
    fn evaluations(&self) -> u64 {
        self.report.evaluations
    }

    /// Returns the state at a time (s), or a state for each time of an array, its components
    /// along the last axis: the dense output of the method, as exact as the states in `y`.
    fn __call__<'py>(&self, py: Python<'py>, t: Numbers<'py>) -> PyResult<Table<'py>> {
        let Some(trajectory) = &self.trajectory else {
            let text = "no dense output was asked for: integrate(..., dense_output=True)";
            return Err(PyValueError::new_err(text));
        };
        let dimension = 2 * self.names.len();
        let mut shape = t.shape().to_vec();
        shape.push(dimension);
        let mut values = Vec::new();
        for time in t.to_vec() {
            let state = trajectory.at(time);
            values.extend(state.map_err(|error| PyValueError::new_err(error.to_string()))?);
        }
        values.into_pyarray(py).reshape(shape)
    }

    /// Returns the states as a `pandas.DataFrame`, a row for each time (s): columns
    /// `theta_parent` (rad) to `omega_child_2` (rad/s).
    fn frame<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        frame(py, &self.t, &self.y, state_names(&self.names))
    }

    fn __repr__(&self) -> String {
        format!("Solution({})", self.report)
    }
}
