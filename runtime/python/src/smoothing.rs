//! Motions behind measured angles: the class `SmoothedMotion`.

use branched_pendulum_measure::{SmoothedMotion as Smoothed, KinematicSmoother, LocalPolynomials, SmoothedCoordinates, SmoothingError};
use numpy::{
    IntoPyArray, PyArray1, PyArray2, PyArray3, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods,
};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

use crate::arrays::{Numbers, Table, frame, matrix, shown, state_names, whole};

/// Draws a motion by normal numbers: states, one after the other.
pub(crate) type Draw = dyn Fn(&mut dyn FnMut() -> f64) -> Vec<f64> + Send + Sync;

/// Means of an estimated motion and their errors, a row for each time, without Python.
pub(crate) struct Estimate {
    pub(crate) states: [Vec<f64>; 2],
    /// None where nothing is said of them.
    pub(crate) accelerations: Option<[Vec<f64>; 2]>,
    /// Standard deviation of the data of each coordinate that was smoothed.
    pub(crate) noise: Vec<f64>,
    pub(crate) whiteness: f64,
    /// Coefficients of friction that equations of motion lack, N m s.
    pub(crate) frictions: Vec<f64>,
    pub(crate) draw: Box<Draw>,
}

/// Linear maps between angles of links and the coordinates that are smoothed, a row for each
/// result.
#[derive(Clone, Debug)]
pub(crate) struct Coordinates {
    pub(crate) of_links: Vec<Vec<f64>>,
    pub(crate) links: Vec<Vec<f64>>,
}

impl Coordinates {
    /// The angles themselves.
    pub(crate) fn links(count: usize) -> Self {
        let row = |own: usize| {
            (0..count)
                .map(|at| f64::from(u8::from(at == own)))
                .collect()
        };
        let unit: Vec<Vec<f64>> = (0..count).map(row).collect();
        Self {
            of_links: unit.clone(),
            links: unit,
        }
    }

    /// Data of a coordinate: missing where a link is that it is formed of.
    fn data(&self, coordinate: usize, angles: &[Vec<Option<f64>>]) -> Vec<Option<f64>> {
        let weights = &self.of_links[coordinate];
        let sum = |row: &Vec<Option<f64>>| {
            let terms = weights
                .iter()
                .zip(row)
                .filter(|(weight, _)| **weight != 0.0);
            terms.map(|(weight, angle)| Some(weight * (*angle)?)).sum()
        };
        angles.iter().map(sum).collect()
    }

    /// Angles of the links, of values of the coordinates.
    fn angles(&self, coordinates: &[f64]) -> impl Iterator<Item = f64> {
        let sum = move |weights: &Vec<f64>| -> f64 {
            weights
                .iter()
                .zip(coordinates)
                .map(|(weight, value)| weight * value)
                .sum()
        };
        self.links.iter().map(sum)
    }

    /// Deviations of the links, of those of coordinates with independent errors.
    fn deviations(&self, coordinates: &[f64]) -> impl Iterator<Item = f64> {
        let sum = move |weights: &Vec<f64>| -> f64 {
            let terms = weights.iter().zip(coordinates);
            terms.map(|(weight, value)| (weight * value).powi(2)).sum()
        };
        self.links.iter().map(move |weights| sum(weights).sqrt())
    }

    fn state(&self, state: &[f64]) -> Vec<f64> {
        let (values, rates) = state.split_at(self.links.len());
        self.angles(values).chain(self.angles(rates)).collect()
    }
}

/// A smoother that knows no equations of motion, by its name.
#[derive(Clone, Copy)]
pub(crate) enum Smoother {
    Kinematic(KinematicSmoother),
    Polynomials(LocalPolynomials),
}

impl Smoother {
    pub(crate) fn of(method: &str, noise: Option<f64>) -> Option<Self> {
        match method {
            "kinematic" => Some(Self::Kinematic(KinematicSmoother { noise, jerk: None })),
            "polynomials" => {
                let usual = LocalPolynomials::default();
                Some(Self::Polynomials(LocalPolynomials { noise, ..usual }))
            }
            _ => None,
        }
    }

    fn smooth(self, times: &[f64], data: &[Option<f64>]) -> Result<Smoothed<3>, SmoothingError> {
        match self {
            Self::Kinematic(smoother) => smoother.smooth(times, data),
            Self::Polynomials(smoother) => smoother.smooth(times, data),
        }
    }

    /// Smooths coordinates of links, each by itself.
    pub(crate) fn estimate(
        self,
        times: &[f64],
        angles: &[Vec<Option<f64>>],
        coordinates: Coordinates,
    ) -> Result<Estimate, SmoothingError> {
        let data = (0..coordinates.of_links.len()).map(|own| coordinates.data(own, angles));
        let smoothed = SmoothedCoordinates::new(data, |data| self.smooth(times, data))?;
        let all = smoothed.coordinates();
        // Of the coordinates' values, rates and accelerations, at a time.
        let rows = |of: &dyn Fn(&Smoothed<3>) -> [f64; 3]| -> [Vec<f64>; 3] {
            let each: Vec<[f64; 3]> = all.iter().map(of).collect();
            [0, 1, 2].map(|order| each.iter().map(|own| own[order]).collect())
        };
        let mut states = [Vec::new(), Vec::new()];
        let mut accelerations = [Vec::new(), Vec::new()];
        for time in 0..times.len() {
            let [values, rates, second] = rows(&|own| own.mean(time));
            states[0].extend(
                coordinates
                    .angles(&values)
                    .chain(coordinates.angles(&rates)),
            );
            accelerations[0].extend(coordinates.angles(&second));
            let [values, rates, second] = rows(&|own| own.deviation(time));
            let [values, rates] = [&values, &rates].map(|own| coordinates.deviations(own));
            states[1].extend(values.chain(rates));
            accelerations[1].extend(coordinates.deviations(&second));
        }
        Ok(Estimate {
            states,
            accelerations: Some(accelerations),
            noise: all.iter().map(Smoothed::noise).collect(),
            whiteness: smoothed.whiteness(),
            frictions: Vec::new(),
            draw: Box::new(move |normal| {
                let drawn = smoothed.draw(normal);
                drawn
                    .iter()
                    .flat_map(|state| coordinates.state(state))
                    .collect()
            }),
        })
    }
}

/// Data of several columns, a row a time; NaN is missing.
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

/// A motion estimated from data at the times of the data, with standard deviations, and draws:
/// motions that the data allow, as likely as they are. What follows from the motion has its
/// error from draws: `estimate`.
#[pyclass(frozen, module = "branched_pendulum.analysis")]
pub(crate) struct SmoothedMotion {
    /// Times, s.
    #[pyo3(get)]
    t: Py<PyArray1<f64>>,
    /// The likeliest states, a row for each time: angles (rad), or the coordinates that were
    /// given, then their rates (1/s).
    #[pyo3(get)]
    y: Py<PyArray2<f64>>,
    /// Standard deviations of the states.
    #[pyo3(get)]
    y_error: Py<PyArray2<f64>>,
    /// Accelerations (rad/s²), a row for each time; None of a motion by its equations.
    #[pyo3(get)]
    acceleration: Option<Py<PyArray2<f64>>>,
    /// Standard deviations of the accelerations.
    #[pyo3(get)]
    acceleration_error: Option<Py<PyArray2<f64>>>,
    /// Standard deviation of the data of each coordinate that was smoothed, found from them.
    #[pyo3(get)]
    noise: Py<PyArray1<f64>>,
    /// Correlation of what each datum differs by from what those before it foretell, in its
    /// standard deviations, the largest of all coordinates: beyond some 3 the motion is not
    /// what the smoother takes it for, and errors are larger than told. NaN of polynomials.
    #[pyo3(get)]
    whiteness: f64,
    /// Friction (N m s) that the equations of motion lack, in the pivot of each link, 0 where
    /// the data ask for none; empty unless it was looked for.
    #[pyo3(get)]
    frictions: Py<PyArray1<f64>>,
    names: Vec<String>,
    draw: Box<Draw>,
}

impl SmoothedMotion {
    pub(crate) fn of(
        py: Python<'_>,
        times: Vec<f64>,
        names: Vec<String>,
        estimate: Estimate,
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
            draw: estimate.draw,
        })
    }

    fn normal(seed: u64) -> impl FnMut() -> f64 {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        move || StandardNormal.sample(&mut random)
    }
}

#[pymethods]
impl SmoothedMotion {
    /// Returns `count` motions drawn from those that the data allow, by random numbers of a
    /// seed: states by draw, time and component.
    #[pyo3(signature = (count = 200, seed = 0))]
    fn draws<'py>(
        &self,
        py: Python<'py>,
        count: i128,
        seed: i128,
    ) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let (count, seed) = (whole("count", count, 0)?, whole("seed", seed, 0)?);
        let values = py.detach(|| {
            let mut normal = Self::normal(seed);
            let draws = (0..count).flat_map(|_| (self.draw)(&mut normal));
            draws.collect::<Vec<f64>>()
        });
        let times = self.t.bind(py).len();
        let shape = [count, times, 2 * self.names.len()];
        values.into_pyarray(py).reshape(shape)
    }

    /// Returns mean and standard deviation of what `function` returns for each of `count`
    /// motions drawn (see `draws`): an array for the states of one, a row for each time.
    ///
    /// `estimate(model.antiphase_energy)` is H_d (J) at each time with its error,
    /// `estimate(lambda y: running_integral(t, model.transfer(y)))` the energy (J) that flowed.
    #[pyo3(signature = (function, count = 200, seed = 0))]
    fn estimate<'py>(
        &self,
        py: Python<'py>,
        function: Bound<'py, PyAny>,
        count: i128,
        seed: i128,
    ) -> PyResult<(Table<'py>, Table<'py>)> {
        let count: usize = whole("count", count, 2)?;
        let mut normal = Self::normal(whole("seed", seed, 0)?);
        let (mut shape, mut means, mut squares) = (Vec::new(), Vec::new(), Vec::new());
        for number in 1..=count {
            let states = py.detach(|| (self.draw)(&mut normal));
            let states = matrix(py, states, 2 * self.names.len())?;
            let values = function.call1((states,))?;
            let values = values.extract::<Numbers<'py>>().map_err(|error| {
                let reason = error.value(py);
                PyTypeError::new_err(format!("the value of function: {reason}"))
            })?;
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

    /// Returns the states as a `pandas.DataFrame`, a row for each time (s): columns
    /// `theta_parent` (rad) to `omega_child_2` (rad/s).
    fn frame<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        frame(py, &self.t, &self.y, state_names(&self.names))
    }

    fn __repr__(&self, py: Python<'_>) -> String {
        let (names, times) = (self.names.join(", "), self.t.bind(py).len());
        format!("SmoothedMotion of {names} at {times} times")
    }
}

/// Smooths data `x` (NaN where they are missing) against times `t` (s), which may be uneven: a
/// column for each coordinate, each by itself.
///
/// "kinematic" knows that a motion is smooth and no more: its jerk is white, and noise and jerk
/// are those of largest likelihood (`noise`, in the unit of the data, if it is known).
/// "polynomials" fits one near each time, a cross-check. Angles of identical branches are
/// better smoothed as means and differences: `Pendulum.smooth` does that.
#[pyfunction]
#[pyo3(signature = (t, x, method = "kinematic", noise = None))]
pub(crate) fn smooth(
    py: Python<'_>,
    t: Numbers<'_>,
    x: Numbers<'_>,
    method: &str,
    noise: Option<f64>,
) -> PyResult<SmoothedMotion> {
    let (times, data) = (t.list("t")?, rows("x", &x, t.shape())?);
    let smoother = Smoother::of(method, noise).ok_or_else(|| {
        PyValueError::new_err(format!(
            "method is {method:?}, must be \"kinematic\" or \"polynomials\""
        ))
    })?;
    let columns = data.first().map_or(0, Vec::len);
    let coordinates = Coordinates::links(columns);
    let estimate = py.detach(|| smoother.estimate(&times, &data, coordinates));
    let names = (1..=columns).map(|number| number.to_string()).collect();
    SmoothedMotion::of(py, times, names, estimate.map_err(refused)?)
}
