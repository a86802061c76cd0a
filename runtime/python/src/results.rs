//! Results that are objects of Python classes, defined in `branched_pendulum._results`.

use branched_pendulum::integrate::{Method, Report, Trajectory};
use numpy::{IntoPyArray, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::arguments::named;
use crate::arrays::{Numbers, Table};
use crate::memory::allocate;

/// Creates an object of a Python class of results.
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

/// Precision at which a motion was compared with a second run, and the first time at which they
/// differ by more.
#[derive(Clone, Copy)]
pub(crate) struct Compared {
    pub(crate) precision: f64,
    pub(crate) differs_from: Option<f64>,
}

/// The account of a run by a method.
pub(crate) fn report<'py>(
    py: Python<'py>,
    method: Method,
    of: &Report<f64>,
    compared: Option<Compared>,
) -> PyResult<Bound<'py, PyAny>> {
    let words = match compared {
        None => of.to_string(),
        Some(Compared {
            precision,
            differs_from: None,
        }) => format!("{of}; a finer run agrees to {precision:e} rad"),
        Some(Compared {
            precision,
            differs_from: Some(time),
        }) => {
            // Ends of steps have many digits, of which few matter.
            let time = (1e4 * time).floor() / 1e4;
            format!("{of}; a finer run differs by more than {precision:e} rad from {time} s on")
        }
    };
    let number = |value: f64| value.into_pyobject(py).map(Bound::into_any);
    let count = |value: u64| value.into_pyobject(py).map(Bound::into_any);
    let fields = [
        ("method", method.to_string().into_pyobject(py)?.into_any()),
        ("accepted", count(of.accepted)?),
        ("rejected", count(of.rejected)?),
        ("evaluations", count(of.evaluations)?),
        ("shortest_step", number(of.shortest_step)?),
        ("longest_step", number(of.longest_step)?),
        ("stop", of.stop.to_string().into_pyobject(py)?.into_any()),
        ("words", words.into_pyobject(py)?.into_any()),
        (
            "precision",
            compared.map(|own| own.precision).into_pyobject(py)?,
        ),
        (
            "differs_from",
            compared
                .and_then(|own| own.differs_from)
                .into_pyobject(py)?,
        ),
    ];
    result(py, "Report", &fields)
}

/// All steps of a motion, as the dense output of a `Solution`.
#[pyclass(frozen, eq, module = "branched_pendulum._native")]
#[derive(PartialEq)]
pub(crate) struct DenseOutput {
    pub(crate) trajectory: Trajectory<f64>,
    pub(crate) dimension: usize,
}

#[pymethods]
impl DenseOutput {
    /// Returns the states at the given times (s), an array of any shape; the components are along
    /// the last axis.
    fn __call__<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::t)] t: Numbers<'py>,
    ) -> PyResult<Table<'py>> {
        let shape = [t.shape(), &[self.dimension]].concat();
        let mut values = allocate(&shape)?;
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
