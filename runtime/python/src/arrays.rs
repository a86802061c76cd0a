//! Arrays of NumPy and slices of numbers.

use numpy::{
    AllowTypeChange, IntoPyArray, PyArray1, PyArray2, PyArrayDyn, PyArrayLikeDyn, PyArrayMethods,
    PyReadonlyArrayDyn, PyUntypedArray, PyUntypedArrayMethods,
};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple};

use branched_pendulum::interruption;

use crate::interrupts::detached;
use crate::memory::{bytes, need, room, shown};

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
            return Self(array.readonly()).checked();
        }
        let converted = Self::converted(&object).map_err(|error| {
            let reason = error.value(object.py());
            PyTypeError::new_err(reason.to_string())
        });
        converted?.checked()
    }
}

/// Times: of which a pair in parentheses is a span, as SciPy's is.
pub(crate) struct Times<'py> {
    pub(crate) numbers: Numbers<'py>,
    pub(crate) is_span: bool,
}

impl<'a, 'py> FromPyObject<'a, 'py> for Times<'py> {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let numbers: Numbers<'py> = object.extract()?;
        let is_span = object.is_instance_of::<PyTuple>() && numbers.shape() == [2];
        Ok(Self { numbers, is_span })
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

    /// Passes numbers of which there is room for two copies.
    fn checked(self) -> PyResult<Self> {
        need("copies of it", bytes(self.shape(), 2))?;
        Ok(self)
    }

    pub(crate) fn shape(&self) -> &[usize] {
        self.0.shape()
    }

    /// The array of them.
    pub(crate) fn array(&self) -> Bound<'py, PyAny> {
        self.0.as_any().clone()
    }

    /// One number without axes: 0.
    pub(crate) fn zero(py: Python<'py>) -> PyResult<Self> {
        let zero = vec![0.0].into_pyarray(py).reshape(Vec::<usize>::new())?;
        Ok(Self(zero.readonly()))
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

/// The axes of an array before the last one, which is as long as is wanted.
pub(crate) fn axes(name: &str, numbers: &Numbers<'_>, wanted: usize) -> PyResult<Vec<usize>> {
    match numbers.shape() {
        [axes @ .., last] if *last == wanted => Ok(axes.to_vec()),
        shape => Err(PyValueError::new_err(format!(
            "{name} must have {wanted} numbers along its last axis, as in shape ({wanted},) or \
             (n, {wanted}), got {}",
            shown(shape)
        ))),
    }
}

/// Arguments whose last axes are as long as is wanted, and whose other axes go together by
/// NumPy's rules.
pub(crate) struct Together {
    /// The axes that they have in common.
    shape: Vec<usize>,
    arguments: Vec<(Vec<f64>, usize)>,
}

/// Length of the last axis of an argument that has one number for each state, and no axis for it.
pub(crate) const ONE_EACH: usize = 0;

/// An argument with its name and the length of its last axis.
pub(crate) type Argument<'a, 'py> = (&'a str, &'a Numbers<'py>, usize);

impl Together {
    pub(crate) fn of(arguments: &[Argument<'_, '_>]) -> PyResult<Self> {
        let mut shape: Vec<usize> = Vec::new();
        for (name, numbers, wanted) in arguments {
            let own = match *wanted {
                ONE_EACH => numbers.shape().to_vec(),
                wanted => axes(name, numbers, wanted)?,
            };
            shape = common(&shape, &own).ok_or_else(|| {
                let shapes = arguments.iter();
                let shapes = shapes.map(|(name, numbers, _)| {
                    format!("{name} has shape {}", shown(numbers.shape()))
                });
                let text = shapes.collect::<Vec<_>>().join(", ");
                PyValueError::new_err(format!("{text}: these do not go together"))
            })?;
        }
        let spread = arguments.iter().map(|(name, numbers, wanted)| {
            let last: &[usize] = match *wanted {
                ONE_EACH => &[],
                _ => &[*wanted],
            };
            let whole = [&shape[..], last].concat();
            let view = numbers.0.as_array();
            let view = view.broadcast(whole).ok_or_else(|| {
                PyValueError::new_err(format!("{name} does not go with the other arguments"))
            })?;
            Ok((view.iter().copied().collect(), (*wanted).max(1)))
        });
        let arguments = spread.collect::<PyResult<_>>()?;
        Ok(Self { shape, arguments })
    }

    /// Calls a function for each state: it writes `result.iter().product()` numbers. What is
    /// long lets other threads of Python run, and ends by a signal.
    pub(crate) fn each<'py>(
        &self,
        py: Python<'py>,
        result: &[usize],
        mut function: impl FnMut(&[&[f64]], &mut [f64]) + Send,
    ) -> PyResult<Bound<'py, PyAny>> {
        let shape = [&self.shape[..], result].concat();
        let mut values = room(&shape)?;
        values.resize(shape.iter().product(), 0.0);
        let length: usize = result.iter().product();
        let count: usize = self.shape.iter().product();
        let size = length + self.arguments.iter().map(|(_, width)| width).sum::<usize>();
        let pause = (4096 / size.max(1)).max(1);
        let mut fill = || {
            let mut given: Vec<&[f64]> = Vec::with_capacity(self.arguments.len());
            for (index, out) in values.chunks_exact_mut(length.max(1)).enumerate() {
                if index % pause == 0 {
                    interruption::look();
                }
                given.clear();
                let rows = self.arguments.iter();
                given.extend(rows.map(|(all, width)| &all[index * width..(index + 1) * width]));
                function(&given, out);
            }
        };
        match count * size > SHORT {
            true => detached(py, fill)?,
            false => fill(),
        }
        plain(values.into_pyarray(py).reshape(shape)?.into_any())
    }
}

/// Numbers below which a function is done before anybody waits for it.
const SHORT: usize = 10_000;

/// Axes that two shapes have together.
fn common(one: &[usize], other: &[usize]) -> Option<Vec<usize>> {
    let length = one.len().max(other.len());
    let at = |shape: &[usize], axis: usize| match (axis + shape.len()).checked_sub(length) {
        Some(own) => shape[own],
        None => 1,
    };
    let axis = |axis: usize| match (at(one, axis), at(other, axis)) {
        (1, own) | (own, 1) => Some(own),
        (own, same) => (own == same).then_some(own),
    };
    (0..length).map(axis).collect()
}

/// A number in place of an array without axes.
fn plain(array: Bound<'_, PyAny>) -> PyResult<Bound<'_, PyAny>> {
    match array.getattr("ndim")?.extract::<usize>()? {
        0 => array.get_item(PyTuple::empty(array.py())),
        1.. => Ok(array),
    }
}

/// Results for each state of an array whose last axis is that of the components; in the place
/// of that axis stands the one of results, if there are several.
pub(crate) fn by_state<'py, const RESULTS: usize>(
    py: Python<'py>,
    states: &Numbers<'py>,
    dimension: usize,
    function: impl Fn(&[f64]) -> [f64; RESULTS] + Send + Sync,
) -> PyResult<Bound<'py, PyAny>> {
    let together = Together::of(&[("y", states, dimension)])?;
    let result: &[usize] = if RESULTS > 1 { &[RESULTS] } else { &[] };
    together.each(py, result, |given, out| {
        let results = given.iter().map(|state| function(state)).next();
        out.copy_from_slice(&results.unwrap_or([f64::NAN; RESULTS]));
    })
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
