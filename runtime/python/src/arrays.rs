//! Arrays of NumPy and slices of numbers.

use numpy::{
    AllowTypeChange, IntoPyArray, PyArray1, PyArray2, PyArrayDyn, PyArrayLike1, PyArrayLikeDyn,
    PyArrayMethods, PyUntypedArrayMethods,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Numbers, from an array or a list.
pub(crate) type Values<'py> = PyArrayLike1<'py, f64, AllowTypeChange>;

/// Numbers in any shape.
pub(crate) type AnyShape<'py> = PyArrayLikeDyn<'py, f64, AllowTypeChange>;

pub(crate) type Row<'py> = Bound<'py, PyArray1<f64>>;
pub(crate) type Matrix<'py> = Bound<'py, PyArray2<f64>>;
pub(crate) type Table<'py> = Bound<'py, PyArrayDyn<f64>>;

/// The numbers of an array, as many as are wanted.
pub(crate) fn numbers(name: &str, array: &Values<'_>, wanted: usize) -> PyResult<Vec<f64>> {
    let numbers = array.as_array().to_vec();
    match numbers.len() == wanted {
        true => Ok(numbers),
        false => Err(PyValueError::new_err(format!(
            "{name} has {} numbers, must have {wanted}",
            numbers.len()
        ))),
    }
}

pub(crate) fn matrix<'py>(
    py: Python<'py>,
    values: Vec<f64>,
    columns: usize,
) -> PyResult<Matrix<'py>> {
    let rows = values.len() / columns.max(1);
    values.into_pyarray(py).reshape([rows, columns])
}

/// Results for each state of an array whose last axis is that of the components; in the place
/// of that axis stands the one of results, if there are several.
pub(crate) fn by_state<'py, const RESULTS: usize>(
    py: Python<'py>,
    states: &AnyShape<'py>,
    dimension: usize,
    function: impl Fn(&[f64]) -> [f64; RESULTS],
) -> PyResult<Table<'py>> {
    let mut shape = states.shape().to_vec();
    if shape.pop() != Some(dimension) {
        return Err(PyValueError::new_err(format!(
            "the last axis of y must have {dimension} numbers, those of a state: its shape is {:?}",
            states.shape()
        )));
    }
    let numbers: Vec<f64> = states.as_array().iter().copied().collect();
    let results = numbers.chunks_exact(dimension).flat_map(function);
    let results: Vec<f64> = results.collect();
    if RESULTS > 1 {
        shape.push(RESULTS);
    }
    results.into_pyarray(py).reshape(shape)
}

/// Names of the components of a state: `theta_parent` to `omega_child_2`.
pub(crate) fn state_names(links: &[String]) -> Vec<String> {
    let of = |letter: &'static str| links.iter().map(move |name| format!("{letter}_{name}"));
    of("theta").chain(of("omega")).collect()
}

/// A `pandas.DataFrame` of rows against times.
pub(crate) fn frame<'py>(
    py: Python<'py>,
    times: &Py<PyArray1<f64>>,
    rows: &Py<PyArray2<f64>>,
    columns: Vec<String>,
) -> PyResult<Bound<'py, PyAny>> {
    let pandas = py.import("pandas")?;
    let name = PyDict::new(py);
    name.set_item("name", "t")?;
    let index = pandas.call_method("Index", (times,), Some(&name))?;
    pandas.call_method1("DataFrame", (rows, index, columns))
}
