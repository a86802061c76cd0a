//! Averages over time and their errors: `analysis.average`, `analysis.transient`.

use branched_pendulum::analysis::statistics::{Average, StatisticsError};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arguments::named;
use crate::arrays::Numbers;

fn refused(error: StatisticsError) -> PyErr {
    PyValueError::new_err(format!("x: {error}"))
}

/// Returns the mean of a steady motion's samples, and its error, which accounts for the correlation
/// of successive samples.
///
/// Parameters
/// ----------
/// x : array, shape (m,) or (k, m)
///     Samples at equal distances in time: one series, or k independent ones.
///
/// Returns
/// -------
/// dict
///     "mean"; its standard "error"; the "deviation" of the samples; their "correlation_time", in
///     samples, 1 where they are independent; the number of "samples".
///
/// Raises
/// ------
/// ValueError
///     There are too few samples, or they are too long correlated.
///
/// Examples
/// --------
/// >>> x = np.random.default_rng(1).normal(5.0, 1.0, (4, 1000))
/// >>> found = bp.analysis.average(x)
/// >>> abs(found["mean"] - 5) < 4 * found["error"], 0.01 < found["error"] < 0.03
/// (True, True)
#[pyfunction]
pub(crate) fn average<'py>(
    py: Python<'py>,
    #[pyo3(from_py_with = named::x)] x: Numbers<'py>,
) -> PyResult<Bound<'py, PyDict>> {
    let (samples, numbers) = match *x.shape() {
        [samples] | [_, samples] => (samples, x.to_vec()),
        ref shape => {
            let text = format!(
                "x must have shape (m,) or (k, m), got {}",
                crate::memory::shown(shape)
            );
            return Err(PyValueError::new_err(text));
        }
    };
    let series: Vec<&[f64]> = numbers.chunks_exact(samples.max(1)).collect();
    let average = Average::of(&series).map_err(refused)?;
    let found = PyDict::new(py);
    found.set_item("mean", average.mean)?;
    found.set_item("error", average.error)?;
    found.set_item("deviation", average.deviation)?;
    found.set_item("correlation_time", average.correlation_time)?;
    found.set_item("samples", average.samples)?;
    Ok(found)
}

/// Returns how many samples at the start of a series belong to its transient, by the rule MSER-5.
///
/// Parameters
/// ----------
/// x : array, shape (m,)
///     Samples at equal distances in time.
///
/// Returns
/// -------
/// int
///
/// Raises
/// ------
/// ValueError
///     There are too few samples, or the series has not settled.
///
/// Examples
/// --------
/// >>> t = np.arange(1000)
/// >>> x = np.exp(-t / 20) + np.random.default_rng(1).normal(0, 0.01, 1000)
/// >>> 50 <= bp.analysis.transient(x) <= 200
/// True
#[pyfunction]
pub(crate) fn transient(#[pyo3(from_py_with = named::x)] x: Numbers<'_>) -> PyResult<usize> {
    branched_pendulum::analysis::statistics::transient(&x.list("x")?).map_err(refused)
}
