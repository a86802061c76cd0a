//! Motions estimated from measured angles: the class `SmoothedMotion`.

use std::sync::Arc;

use branched_pendulum::interruption;
use branched_pendulum_measure::SmoothingError;
use numpy::{
    IntoPyArray, PyArray1, PyArray2, PyArray3, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

use crate::arguments::{Argument, named};
use crate::arrays::{Numbers, Table, frame, matrix, state_names, whole};
use crate::estimates::{Draw, Estimate};
use crate::interrupts::detached;
use crate::memory::allocate;
use crate::memory::shown;

/// Converts an array with one row per time to data of several columns; NaN marks missing values.
pub(crate) fn rows(
    name: &str,
    array: &Numbers<'_>,
    times: &[usize],
) -> PyResult<Vec<Vec<Option<f64>>>> {
    let columns = match array.shape() {
        [rows] if [*rows] == times => 1,
        [rows, columns] if [*rows] == times => *columns,
        shape => {
            let (shape, times) = (shown(shape), shown(times));
            return Err(PyValueError::new_err(format!(
                "{name} must have a row for each time, a column for each coordinate: its shape \
                 is {shape}, that of t is {times}"
            )));
        }
    };
    let datum = |value: &f64| Some(*value).filter(|value| !value.is_nan());
    let numbers = array.to_vec();
    let rows = numbers.chunks(columns.max(1));
    Ok(rows.map(|row| row.iter().map(datum).collect()).collect())
}

pub(crate) fn refused(error: SmoothingError) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// A motion estimated from data, at the times of the data, with standard deviations. Random draws
/// are motions that agree with the data, in proportion to their probability; from these, `estimate`
/// computes quantities that depend on the motion, and their errors.
#[pyclass(frozen, module = "branched_pendulum.analysis")]
pub(crate) struct SmoothedMotion {
    /// Times, s.
    #[pyo3(get)]
    t: Py<PyArray1<f64>>,
    /// Most probable states, one row per time: angles (rad), or the given coordinates, then their
    /// rates (1/s).
    #[pyo3(get)]
    y: Py<PyArray2<f64>>,
    /// Standard deviations of the states.
    #[pyo3(get)]
    y_error: Py<PyArray2<f64>>,
    /// Accelerations (rad/s²), one row per time; `None` for a motion estimated by equations of
    /// motion.
    #[pyo3(get)]
    acceleration: Option<Py<PyArray2<f64>>>,
    /// Standard deviations of the accelerations.
    #[pyo3(get)]
    acceleration_error: Option<Py<PyArray2<f64>>>,
    /// Standard deviation of the data of each smoothed coordinate, estimated from the data.
    #[pyo3(get)]
    noise: Py<PyArray1<f64>>,
    /// Correlation of the one-step prediction errors of the data, in units of its standard
    /// deviation; the largest of all coordinates. Above about 3 the motion does not satisfy the
    /// assumptions of the smoother, and errors are larger than stated. NaN for polynomials.
    #[pyo3(get)]
    whiteness: f64,
    /// Friction (N m s) in the pivot of each link that the equations of motion lack; 0 if the data
    /// do not require any; empty unless it was requested.
    #[pyo3(get)]
    frictions: Py<PyArray1<f64>>,
    names: Vec<String>,
    draw: Arc<Draw>,
    /// Function that estimated the motion, with its arguments.
    origin: Origin,
}

/// A Python function and its arguments.
pub(crate) type Origin = (Py<PyAny>, Py<PyTuple>);

impl SmoothedMotion {
    pub(crate) fn of(
        py: Python<'_>,
        times: Vec<f64>,
        names: Vec<String>,
        estimate: Estimate,
        origin: Origin,
    ) -> PyResult<Self> {
        let links = names.len();
        let array = |values: Vec<f64>, columns: usize| -> PyResult<Py<PyArray2<f64>>> {
            Ok(matrix(py, values, columns)?.unbind())
        };
        let [y, y_error] = estimate.states;
        let (acceleration, acceleration_error) = match estimate.accelerations {
            Some([mean, error]) => (Some(array(mean, links)?), Some(array(error, links)?)),
            None => (None, None),
        };
        Ok(Self {
            t: times.into_pyarray(py).unbind(),
            y: array(y, 2 * links)?,
            y_error: array(y_error, 2 * links)?,
            acceleration,
            acceleration_error,
            noise: estimate.noise.into_pyarray(py).unbind(),
            whiteness: estimate.whiteness,
            frictions: estimate.frictions.into_pyarray(py).unbind(),
            names,
            draw: estimate.draw.into(),
            origin,
        })
    }

    fn normal(seed: u64) -> impl FnMut() -> f64 {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        move || StandardNormal.sample(&mut random)
    }
}

#[pymethods]
impl SmoothedMotion {
    /// Returns random motions drawn from the distribution of motions that agree with the data.
    ///
    /// Parameters
    /// ----------
    /// count : int
    ///     How many.
    /// seed : int
    ///     Seed of the random numbers.
    ///
    /// Returns
    /// -------
    /// array, shape (count, m, 2 n)
    ///     States by draw, time and component.
    ///
    /// Examples
    /// --------
    /// >>> motion = bp.analysis.smooth(np.arange(50) / 10, np.sin(np.arange(50) / 10))
    /// >>> motion.draws(3).shape
    /// (3, 50, 2)
    #[pyo3(signature = (count = 200, seed = 0))]
    fn draws<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::count)] count: i128,
        #[pyo3(from_py_with = named::seed)] seed: i128,
    ) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let (count, seed) = (whole("count", count, 0)?, whole("seed", seed, 0)?);
        let times = self.t.bind(py).len();
        let shape = [count, times, 2 * self.names.len()];
        let mut values = allocate(&shape)?;
        let draw = &self.draw;
        detached(py, || {
            let mut normal = Self::normal(seed);
            for _ in 0..count {
                interruption::look();
                values.extend(draw(&mut normal));
            }
        })?;
        values.into_pyarray(py).reshape(shape)
    }

    /// Returns the mean and the standard deviation of a function of the motion, computed from
    /// random draws.
    ///
    /// Parameters
    /// ----------
    /// function : function
    ///     Of the states of one motion, shape (m, 2 n): an array of any shape.
    ///     `model.antiphase_energy` gives H_d (J) at each time,
    ///     `lambda y: running_integral(t, model.transfer(y))` the energy (J) that flowed.
    /// count, seed : int
    ///     Motions drawn, and the seed.
    ///
    /// Returns
    /// -------
    /// mean, deviation : arrays of the function's shape
    ///
    /// Examples
    /// --------
    /// >>> motion = bp.analysis.smooth(np.arange(50) / 10, np.sin(np.arange(50) / 10))
    /// >>> mean, error = motion.estimate(lambda y: y[:, 0] ** 2, count=20)
    /// >>> mean.shape, error.shape
    /// ((50,), (50,))
    #[pyo3(signature = (function, count = 200, seed = 0))]
    fn estimate<'py>(
        &self,
        py: Python<'py>,
        function: Bound<'py, PyAny>,
        #[pyo3(from_py_with = named::count)] count: i128,
        #[pyo3(from_py_with = named::seed)] seed: i128,
    ) -> PyResult<(Table<'py>, Table<'py>)> {
        let count: usize = whole("count", count, 2)?;
        let mut normal = Self::normal(whole("seed", seed, 0)?);
        let (mut shape, mut means, mut squares) = (Vec::new(), Vec::new(), Vec::new());
        for number in 1..=count {
            let states = detached(py, || (self.draw)(&mut normal))?;
            let states = matrix(py, states, 2 * self.names.len())?;
            let values = function.call1((states,))?;
            let values = Numbers::of("the value of function", &values)?;
            if number == 1 {
                shape = values.shape().to_vec();
                means = vec![0.0; shape.iter().product()];
                squares = means.clone();
            } else if shape != values.shape() {
                let text = "the function returns arrays of different shapes for different motions";
                return Err(PyValueError::new_err(text));
            }
            // Welford's update.
            let places = means.iter_mut().zip(&mut squares);
            for ((mean, square), value) in places.zip(values.to_vec()) {
                let change = value - *mean;
                *mean += change / number as f64;
                *square += change * (value - *mean);
            }
        }
        let last = count as f64 - 1.0;
        let deviations: Vec<f64> = squares
            .iter()
            .map(|square| (square / last).sqrt())
            .collect();
        let table = |values: Vec<f64>| -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
            values.into_pyarray(py).reshape(shape.clone())
        };
        Ok((table(means)?, table(deviations)?))
    }

    /// Returns the states as a `pandas.DataFrame`, with one row per time (s) and columns
    /// `theta_parent` (rad) to `omega_child_2` (rad/s).
    fn frame<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        frame(py, &self.t, &self.y, state_names(&self.names))
    }

    /// Compares two motions; they are equal if they come from the same data and function.
    fn __eq__(&self, other: &Bound<'_, PyAny>) -> PyResult<bool> {
        let py = other.py();
        let Ok(other) = other.cast::<Self>() else {
            return Ok(false);
        };
        let other = other.get();
        let same = py.import("numpy")?.getattr("array_equal")?;
        let arrays = [(&self.y, &other.y), (&self.y_error, &other.y_error)];
        for (own, other) in arrays {
            if !same.call1((own, other))?.is_truthy()? {
                return Ok(false);
            }
        }
        same.call1((&self.t, &other.t))?.is_truthy()
    }

    fn __reduce__(&self, py: Python<'_>) -> (Py<PyAny>, Py<PyTuple>) {
        let (function, arguments) = &self.origin;
        (function.clone_ref(py), arguments.clone_ref(py))
    }

    fn __repr__(&self, py: Python<'_>) -> String {
        let (names, times) = (self.names.join(", "), self.t.bind(py).len());
        format!("SmoothedMotion of {names} at {times} times")
    }
}
