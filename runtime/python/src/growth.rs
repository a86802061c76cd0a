//! Growth of small differences: the class `Growth`.

use branched_pendulum::analysis::growth::{Checked, Grown};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::arrays::matrix;

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

impl Growth {
    pub(crate) fn of(py: Python<'_>, horizons: Vec<f64>, all: &[Option<Grown>]) -> PyResult<Self> {
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
