//! NumPy arrays, and their conversion to slices of numbers.

use numpy::{
    IntoPyArray, PyArray1, PyArray2, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn,
    PyUntypedArrayMethods,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use branched_pendulum::interruption;

use crate::interrupts::detached;
use crate::memory::{allocate, shown};

pub(crate) type Row<'py> = Bound<'py, PyArray1<f64>>;
pub(crate) type Matrix<'py> = Bound<'py, PyArray2<f64>>;
pub(crate) type Table<'py> = Bound<'py, PyArrayDyn<f64>>;

/// Real numbers of any shape: an array, a list, or anything else that NumPy converts to an array
/// without loss.
pub(crate) struct Numbers<'py>(PyReadonlyArrayDyn<'py, f64>);

impl<'py> From<PyReadonlyArrayDyn<'py, f64>> for Numbers<'py> {
    fn from(array: PyReadonlyArrayDyn<'py, f64>) -> Self {
        Self(array)
    }
}

/// Times; a pair in parentheses is a span of time, as SciPy's `t_span`.
pub(crate) struct Times<'py> {
    pub(crate) numbers: Numbers<'py>,
    pub(crate) is_span: bool,
}

impl<'py> Numbers<'py> {
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

    /// Returns an array of zeros with one axis.
    pub(crate) fn zeros(py: Python<'py>, len: usize) -> Self {
        let zeros = PyArray1::<f64>::zeros(py, len, false);
        Self(zeros.to_dyn().readonly())
    }

    /// Returns all numbers, in an order in which the last axis varies fastest.
    pub(crate) fn to_vec(&self) -> Vec<f64> {
        self.0.as_array().iter().copied().collect()
    }

    /// Returns the numbers of a one-dimensional array of any length.
    pub(crate) fn list(&self, name: &str) -> PyResult<Vec<f64>> {
        match self.shape() {
            [_] => Ok(self.to_vec()),
            shape => Err(PyValueError::new_err(format!(
                "{name} must have one axis, got shape {}",
                shown(shape)
            ))),
        }
    }

    /// Returns the numbers of a one-dimensional array, after checking that it has `wanted`
    /// elements.
    pub(crate) fn row(&self, name: &str, wanted: usize) -> PyResult<Vec<f64>> {
        match self.shape() {
            [found] if *found == wanted => Ok(self.to_vec()),
            shape => Err(PyValueError::new_err(format!(
                "{name} must have shape ({wanted},), got {}",
                shown(shape)
            ))),
        }
    }

    /// Returns the rows of a two-dimensional array, after checking that they have `wanted`
    /// elements.
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

/// Converts a whole number, after checking that it is at least `least` and fits into its type.
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

/// Returns the axes of an array before its last one, after checking that the last one has the
/// length `wanted`.
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

/// Arguments whose last axes have given lengths, and whose other axes are combined by NumPy's
/// broadcasting rules.
pub(crate) struct Together {
    /// The common axes of all arguments.
    shape: Vec<usize>,
    arguments: Vec<(Vec<f64>, usize)>,
}

/// Code for arguments with one number per state, which have no last axis for the numbers of a
/// state.
pub(crate) const ONE_EACH: usize = 0;

/// An argument with its name and the required length of its last axis.
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

    /// Calls a function for each state; it writes `result.iter().product()` numbers. Long
    /// computations let other Python threads run, and can be interrupted by signals.
    pub(crate) fn each<'py>(
        &self,
        py: Python<'py>,
        result: &[usize],
        mut function: impl FnMut(&[&[f64]], &mut [f64]) + Send,
    ) -> PyResult<Bound<'py, PyAny>> {
        let shape = [&self.shape[..], result].concat();
        let mut values = allocate(&shape)?;
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

/// Number of values below which a computation is so short that it need not be interruptible.
const SHORT: usize = 10_000;

/// Returns the common shape of two shapes by NumPy's broadcasting rules.
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

/// Converts an array without axes to a number.
fn plain(array: Bound<'_, PyAny>) -> PyResult<Bound<'_, PyAny>> {
    match array.getattr("ndim")?.extract::<usize>()? {
        0 => array.get_item(PyTuple::empty(array.py())),
        1.. => Ok(array),
    }
}

/// Computes results for each state of an array whose last axis has the components. In the result
/// this axis is replaced by the axis of the results, if there are several.
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

/// Returns the names of the components of a state: `theta_parent` to `omega_child_2`.
pub(crate) fn state_names(links: &[String]) -> Vec<String> {
    let of = |letter: &'static str| links.iter().map(move |name| format!("{letter}_{name}"));
    of("theta").chain(of("omega")).collect()
}

/// Creates a `pandas.DataFrame` from rows at the given times.
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
