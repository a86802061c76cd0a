//! Growth of small differences: the class `Growth`.

use branched_pendulum::analysis::growth::{Checked, Grown, GrowthError};
use branched_pendulum::analysis::variational::Copies;
use branched_pendulum::ensemble::Ensemble;
use branched_pendulum::system::State;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;

use crate::arrays::matrix;
use crate::failures::Failures;
use crate::motions::Motions;

/// Growth of a small difference along motions, a row or a number for each of them. NaN where a
/// motion could not be followed.
///
/// Everything is computed at two tolerances: where motions are chaotic, growth over a long time
/// is a number that no tolerance finds, and `factor_changes` says so.
#[pyclass(frozen, module = "branched_pendulum")]
pub(crate) struct Growth {
    /// Growth factors up to each horizon: the largest difference over its amplitude at the
    /// start; rows are motions.
    #[pyo3(get)]
    factors: Py<PyArray2<f64>>,
    /// Relative differences of the factors between the two tolerances: beyond a hundredth they
    /// are not determined.
    #[pyo3(get)]
    factor_changes: Py<PyArray2<f64>>,
    /// Growth rates (1/s) over the last horizon; near zero where differences keep their size,
    /// though they beat.
    #[pyo3(get)]
    rates: Py<PyArray1<f64>>,
    /// Frequencies (Hz) of the differences: turns of the difference and its rate about zero.
    #[pyo3(get)]
    frequencies: Py<PyArray1<f64>>,
    /// Times after the start (s) up to which growth was asked for.
    #[pyo3(get)]
    horizons: Py<PyArray1<f64>>,
}

#[pymethods]
impl Growth {
    fn __repr__(&self, py: Python<'_>) -> String {
        let (motions, horizons) = (self.rates.bind(py).len(), self.horizons.bind(py));
        format!("Growth along {motions} motions up to {horizons} s")
    }
}

/// Sets of links that are copies and in phase at all starts, by their names.
pub(crate) fn copies(
    motions: &dyn Motions,
    alike: &[Vec<String>],
    starts: &[State<f64>],
) -> PyResult<Copies> {
    let names = motions.names();
    let place = |name: &String| {
        let found = names.iter().position(|own| own == name);
        found.ok_or_else(|| PyKeyError::new_err(format!("there is no link `{name}`")))
    };
    let of = |set: &Vec<String>| -> PyResult<Vec<usize>> { set.iter().map(place).collect() };
    let places: Vec<Vec<usize>> = alike.iter().map(of).collect::<PyResult<_>>()?;
    let sets: Vec<&[usize]> = places.iter().map(Vec::as_slice).collect();
    motions.copies(&sets, starts).ok_or_else(|| {
        let sets: Vec<String> = alike
            .iter()
            .map(|set| format!("`{}`", set.join("` and `")))
            .collect();
        let text = format!("{} are no copies that start alike", sets.join(" or "));
        PyValueError::new_err(text)
    })
}

/// Growth that is asked for.
pub(crate) struct GrowthTask {
    pub(crate) starts: Vec<State<f64>>,
    pub(crate) horizons: Vec<f64>,
    pub(crate) frequency_hz: Option<f64>,
    pub(crate) tolerance: f64,
}

impl GrowthTask {
    /// Growth of a difference between two links, by their names, along all motions.
    pub(crate) fn grown(
        self,
        py: Python<'_>,
        motions: &dyn Motions,
        pair: &[String],
        ensemble: &Ensemble<'_>,
    ) -> PyResult<Growth> {
        let [one, other] = pair else {
            let text = format!("pair must be two names of links, got {}", pair.len());
            return Err(PyValueError::new_err(text));
        };
        let alike = vec![one.clone(), other.clone()];
        let copies = copies(motions, &[alike], &self.starts)?;
        let grown = py.detach(|| {
            ensemble.map(&self.starts, |_, start| {
                motions.growth(&self, &copies, start)
            })
        });
        let mut failures = Failures::default();
        let mut all = Vec::with_capacity(grown.len());
        for (place, grown) in grown.into_iter().enumerate() {
            all.push(match grown {
                Ok(grown) => Some(grown),
                Err(GrowthError::Integration(failure)) => {
                    failures.note(place, &failure)?;
                    None
                }
                Err(error) => return Err(PyValueError::new_err(error.to_string())),
            });
        }
        failures.warn(py, all.len())?;
        Growth::of(py, self.horizons.clone(), &all)
    }
}

impl Growth {
    fn of(py: Python<'_>, horizons: Vec<f64>, all: &[Option<Grown>]) -> PyResult<Self> {
        let columns = horizons.len();
        let nowhere = Checked {
            value: f64::NAN,
            difference: f64::NAN,
        };
        let factors: Vec<Checked> = all
            .iter()
            .flat_map(|grown| match grown {
                Some(grown) => grown.factors.clone(),
                None => vec![nowhere; columns],
            })
            .collect();
        let of_factors = |of: fn(&Checked) -> f64| -> PyResult<Py<PyArray2<f64>>> {
            Ok(matrix(py, factors.iter().map(of).collect(), columns)?.unbind())
        };
        let each = |of: fn(&Grown) -> f64| -> Py<PyArray1<f64>> {
            let values = all.iter().map(|grown| grown.as_ref().map_or(f64::NAN, of));
            values.collect::<Vec<f64>>().into_pyarray(py).unbind()
        };
        Ok(Self {
            factors: of_factors(|factor| factor.value)?,
            factor_changes: of_factors(|factor| factor.difference)?,
            rates: each(|grown| grown.rate.value),
            frequencies: each(|grown| grown.frequency_hz.value),
            horizons: horizons.into_pyarray(py).unbind(),
        })
    }
}
