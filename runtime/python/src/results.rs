//! Results, whose classes are Python's: `branched_pendulum._results`.

use branched_pendulum::integrate::{Report, Trajectory};
use numpy::{IntoPyArray, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::arrays::{Numbers, Table};
use crate::memory::room;

/// Makes an object of a class of results.
pub(crate) fn result<'py>(
    py: Python<'py>,
    class: &str,
    fields: &[(&str, Bound<'py, PyAny>)],
) -> PyResult<Bound<'py, PyAny>> {
    let named = PyDict::new(py);
    for (name, value) in fields {
        named.set_item(name, value)?;
    }
    let module = py.import("branched_pendulum._results")?;
    module.getattr(class)?.call((), Some(&named))
}

/// An array of this shape.
pub(crate) fn array<'py>(
    py: Python<'py>,
    values: Vec<f64>,
    shape: &[usize],
) -> PyResult<Bound<'py, PyAny>> {
    Ok(values.into_pyarray(py).reshape(shape.to_vec())?.into_any())
}

/// The account of a run.
pub(crate) fn report<'py>(py: Python<'py>, of: &Report<f64>) -> PyResult<Bound<'py, PyAny>> {
    let number = |value: f64| value.into_pyobject(py).map(Bound::into_any);
    let count = |value: u64| value.into_pyobject(py).map(Bound::into_any);
    let fields = [
        ("accepted", count(of.accepted)?),
        ("rejected", count(of.rejected)?),
        ("evaluations", count(of.evaluations)?),
        ("shortest_step", number(of.shortest_step)?),
        ("longest_step", number(of.longest_step)?),
        ("stop", of.stop.to_string().into_pyobject(py)?.into_any()),
        ("words", of.to_string().into_pyobject(py)?.into_any()),
    ];
    result(py, "Report", &fields)
}

/// All steps of a motion: the dense output of a `Solution`.
#[pyclass(frozen, eq, module = "branched_pendulum._native")]
#[derive(PartialEq)]
pub(crate) struct DenseOutput {
    pub(crate) trajectory: Trajectory<f64>,
    pub(crate) dimension: usize,
}

#[pymethods]
impl DenseOutput {
    /// Returns the states at times (s) of any shape, components along the last axis.
    fn __call__<'py>(&self, py: Python<'py>, t: Numbers<'py>) -> PyResult<Table<'py>> {
        let shape = [t.shape(), &[self.dimension]].concat();
        let mut values = room(&shape)?;
        for time in t.to_vec() {
            let state = self.trajectory.at(time);
            values.extend(state.map_err(|error| PyValueError::new_err(error.to_string()))?);
        }
        values.into_pyarray(py).reshape(shape)
    }

    #[staticmethod]
    fn _read(bytes: &[u8], dimension: usize) -> PyResult<Self> {
        let trajectory = postcard::from_bytes(bytes);
        Ok(Self {
            trajectory: trajectory.map_err(|error| PyValueError::new_err(error.to_string()))?,
            dimension,
        })
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let bytes = postcard::to_stdvec(&self.trajectory);
        let bytes = bytes.map_err(|error| PyValueError::new_err(error.to_string()))?;
        let read = py.get_type::<Self>().getattr("_read")?;
        let given = (PyBytes::new(py, &bytes), self.dimension);
        Ok((read, given).into_pyobject(py)?.into_any())
    }
}
