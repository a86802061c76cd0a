//! Arrays of NumPy and slices of numbers.

use numpy::{
    AllowTypeChange, IntoPyArray, PyArray1, PyArray2, PyArrayDyn, PyArrayLikeDyn, PyArrayMethods,
    PyReadonlyArrayDyn, PyUntypedArray, PyUntypedArrayMethods,
};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple};

pub(crate) type Row<'py> = Bound<'py, PyArray1<f64>>;
pub(crate) type Matrix<'py> = Bound<'py, PyArray2<f64>>;
pub(crate) type Table<'py> = Bound<'py, PyArrayDyn<f64>>;

/// Real numbers in any shape: an array, a list, what NumPy makes an array of. What would lose
/// a part is refused; PyO3 puts the argument's name before the reason.
pub(crate) struct Numbers<'py>(PyReadonlyArrayDyn<'py, f64>);

impl<'a, 'py> FromPyObject<'a, 'py> for Numbers<'py> {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if object.is_exact_instance_of::<PyUntypedArray>()
            && let Ok(array) = object.cast::<PyArrayDyn<f64>>()
        {
            return Ok(Self(array.readonly()));
        }
        Self::converted(&object).map_err(|error| {
            let reason = error.value(object.py());
            PyTypeError::new_err(reason.to_string())
        })
    }
}

impl<'py> Numbers<'py> {
    fn converted(object: &Bound<'py, PyAny>) -> PyResult<Self> {
        // NumPy makes a NaN of it.
        if object.is_none() {
            return Err(PyTypeError::new_err("None is no real number"));
        }
        let numpy = object.py().import("numpy")?;
        let is_masked = |object: &Bound<'py, PyAny>| -> PyResult<bool> {
            let answer = numpy.getattr("ma")?.call_method1("is_masked", (object,))?;
            answer.is_truthy()
        };
        let mut masked = is_masked(object)?;
        if object.is_instance_of::<PyList>() || object.is_instance_of::<PyTuple>() {
            for part in object.try_iter()? {
                masked |= is_masked(&part?)?;
            }
        }
        if masked {
            let text = "some numbers are masked, and the mask would be lost: take those that are \
                        not, or fill them, `filled(numpy.nan)` where NaN means missing";
            return Err(PyTypeError::new_err(text));
        }
        let array = numpy.call_method1("asarray", (object,))?;
        let kind: String = array.getattr("dtype")?.getattr("kind")?.extract()?;
        match &*kind {
            "b" | "i" | "u" | "f" | "O" => {}
            "c" => {
                let text = "the numbers are complex, and their imaginary parts would be lost: \
                            give `.real`";
                return Err(PyTypeError::new_err(text));
            }
            _ => {
                let text = format!("{} are no real numbers", array.getattr("dtype")?);
                return Err(PyTypeError::new_err(text));
            }
        }
        let array: PyArrayLikeDyn<'py, f64, AllowTypeChange> = array.extract()?;
        Ok(Self((*array).clone()))
    }

    pub(crate) fn shape(&self) -> &[usize] {
        self.0.shape()
    }

    /// All numbers, the last axis running first.
    pub(crate) fn to_vec(&self) -> Vec<f64> {
        self.0.as_array().iter().copied().collect()
    }

    /// The numbers of one axis, however many.
    pub(crate) fn list(&self, name: &str) -> PyResult<Vec<f64>> {
        match self.shape() {
            [_] => Ok(self.to_vec()),
            shape => Err(PyValueError::new_err(format!(
                "{name} must have one axis, got shape {}",
                shown(shape)
            ))),
        }
    }

    /// The numbers of one axis, as many as are wanted.
    pub(crate) fn row(&self, name: &str, wanted: usize) -> PyResult<Vec<f64>> {
        match self.shape() {
            [found] if *found == wanted => Ok(self.to_vec()),
            shape => Err(PyValueError::new_err(format!(
                "{name} must have shape ({wanted},), got {}",
                shown(shape)
            ))),
        }
    }

    /// The numbers of two axes, the second one as long as is wanted.
    pub(crate) fn rows(&self, name: &str, wanted: usize) -> PyResult<Vec<Vec<f64>>> {
        match self.shape() {
            [_, found] if *found == wanted => {
                let rows = self.0.as_array();
                Ok(rows
                    .outer_iter()
                    .map(|row| row.iter().copied().collect())
                    .collect())
            }
            shape => Err(PyValueError::new_err(format!(
                "{name} must have shape (n, {wanted}), got {}",
                shown(shape)
            ))),
        }
    }
}

/// A shape as Python writes it.
pub(crate) fn shown(shape: &[usize]) -> String {
    match shape {
        [one] => format!("({one},)"),
        axes => {
            let axes: Vec<String> = axes.iter().map(ToString::to_string).collect();
            format!("({})", axes.join(", "))
        }
    }
}

/// A real number: of Python or NumPy, or an array that holds one.
pub(crate) struct Number(pub(crate) f64);

impl<'a, 'py> FromPyObject<'a, 'py> for Number {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if object.is_instance_of::<pyo3::types::PyFloat>() {
            return Ok(Self(object.extract()?));
        }
        let numbers: Numbers<'py> = object.extract()?;
        match numbers.to_vec()[..] {
            [number] => Ok(Self(number)),
            _ => {
                let shape = shown(numbers.shape());
                let text = format!("an array of shape {shape} is no number");
                Err(PyTypeError::new_err(text))
            }
        }
    }
}

/// A whole number from `least` to the largest of its type.
pub(crate) fn whole<T>(name: &str, value: i128, least: T) -> PyResult<T>
where
    T: TryFrom<i128> + PartialOrd + std::fmt::Display,
{
    T::try_from(value)
        .ok()
        .filter(|value| *value >= least)
        .ok_or_else(|| {
            let bound = match T::try_from(value) {
                Err(_) if value > 0 => format!("less than 2^{}", 8 * size_of::<T>()),
                _ => format!("at least {least}"),
            };
            PyValueError::new_err(format!("{name} must be {bound}, got {value}"))
        })
}

pub(crate) fn matrix<'py>(
    py: Python<'py>,
    values: Vec<f64>,
    columns: usize,
) -> PyResult<Matrix<'py>> {
    let rows = values.len() / columns.max(1);
    values.into_pyarray(py).reshape([rows, columns])
}

/// The axes of states before that of their components.
pub(crate) fn axes_of_states(states: &Numbers<'_>, dimension: usize) -> PyResult<Vec<usize>> {
    match states.shape() {
        [axes @ .., last] if *last == dimension => Ok(axes.to_vec()),
        shape => Err(PyValueError::new_err(format!(
            "the last axis of y must have {dimension} numbers, those of a state: its shape is {}",
            shown(shape)
        ))),
    }
}

/// Results for each state of an array whose last axis is that of the components; in the place
/// of that axis stands the one of results, if there are several.
pub(crate) fn by_state<'py, const RESULTS: usize>(
    py: Python<'py>,
    states: &Numbers<'py>,
    dimension: usize,
    function: impl Fn(&[f64]) -> [f64; RESULTS],
) -> PyResult<Table<'py>> {
    let mut shape = axes_of_states(states, dimension)?;
    let numbers = states.to_vec();
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
