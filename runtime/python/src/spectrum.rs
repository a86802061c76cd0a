//! Spectra of series and their lines: the class `Lines`.

use branched_pendulum_measure::{Lines as Found, LineSearch, SpectralLine, Spectrum, SpectrumError, SpectrumOptions, Window};
use numpy::{IntoPyArray, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{Numbers, Row, Table, whole};

fn refused(error: SpectrumError) -> PyErr {
    PyValueError::new_err(error.to_string())
}

fn window(power: i128) -> PyResult<Window> {
    Ok(match whole("window", power, 0)? {
        0 => Window::Rectangular,
        power => Window::HannPower(power),
    })
}

/// Returns frequencies (Hz) and amplitudes, in the unit of `x`, of samples taken `sample_rate`
/// times a second: a sine of amplitude a whose frequency is among them has the amplitude a.
///
/// Frequencies are those of Fourier, or the given ones. `window` is the power of Hann's window
/// by which samples are weighed, 0 for none; the mean is taken off before, if `remove_mean`.
#[pyfunction]
#[pyo3(signature = (x, sample_rate, frequencies = None, window = 1, remove_mean = true))]
pub(crate) fn spectrum<'py>(
    py: Python<'py>,
    x: Numbers<'py>,
    sample_rate: f64,
    frequencies: Option<Numbers<'py>>,
    window: i128,
    remove_mean: bool,
) -> PyResult<(Row<'py>, Row<'py>)> {
    let samples = x.list("x")?;
    let frequencies = frequencies.map(|frequencies| frequencies.list("frequencies"));
    let frequencies = frequencies.transpose()?;
    let options = SpectrumOptions {
        remove_mean,
        window: self::window(window)?,
    };
    let found = py.detach(|| match frequencies {
        None => Spectrum::at_fourier_frequencies(&samples, sample_rate, options),
        Some(all) => Spectrum::at_frequencies(&samples, sample_rate, &all, options),
    });
    let Spectrum {
        frequencies_hz,
        amplitudes,
    } = found.map_err(refused)?;
    Ok((frequencies_hz.into_pyarray(py), amplitudes.into_pyarray(py)))
}

/// Lines of a series, the strongest first: a mean and waves
/// `amplitude * cos(2π frequency t + phase)`, t from the first sample.
#[pyclass(frozen, module = "branched_pendulum.analysis")]
pub(crate) struct Lines {
    found: Found,
}

impl Lines {
    fn each<'py>(&self, py: Python<'py>, of: fn(&SpectralLine) -> f64) -> Row<'py> {
        let values: Vec<f64> = self.found.lines.iter().map(of).collect();
        values.into_pyarray(py)
    }
}

#[pymethods]
impl Lines {
    /// Frequencies, Hz.
    #[getter]
    fn frequencies<'py>(&self, py: Python<'py>) -> Row<'py> {
        self.each(py, |line| line.frequency_hz)
    }

    /// Standard deviations of the frequencies, Hz, were what is left beside each line noise.
    #[getter]
    fn frequency_errors<'py>(&self, py: Python<'py>) -> Row<'py> {
        self.each(py, |line| line.deviation_hz)
    }

    /// Amplitudes, in the unit of the series.
    #[getter]
    fn amplitudes<'py>(&self, py: Python<'py>) -> Row<'py> {
        self.each(py, |line| line.amplitude)
    }

    /// Standard deviations of the amplitudes.
    #[getter]
    fn amplitude_errors<'py>(&self, py: Python<'py>) -> Row<'py> {
        self.each(py, |line| line.amplitude_deviation)
    }

    /// Phases at the first sample, rad from −π to π.
    #[getter]
    fn phases<'py>(&self, py: Python<'py>) -> Row<'py> {
        self.each(py, |line| line.phase)
    }

    /// Mean of the series.
    #[getter]
    fn mean(&self) -> f64 {
        self.found.mean
    }

    /// Root mean square of what the lines leave of the series.
    #[getter]
    fn residual(&self) -> f64 {
        self.found.residual
    }

    /// Distance (Hz) within which two lines are taken for one: one cycle over the record.
    #[getter]
    fn resolution(&self) -> f64 {
        self.found.resolution_hz
    }

    fn __len__(&self) -> usize {
        self.found.lines.len()
    }

    /// Returns the sum of mean and lines at times (s) from the first sample.
    fn __call__<'py>(&self, py: Python<'py>, t: Numbers<'py>) -> PyResult<Table<'py>> {
        let shape = t.shape().to_vec();
        let times = t.to_vec();
        let values = times.iter().map(|time| self.found.value(*time));
        values.collect::<Vec<f64>>().into_pyarray(py).reshape(shape)
    }

    /// Returns each line's name as a combination of fundamental frequencies, given in Hz
    /// under their names: `{"f_+": 1.26, "f_-": 1.58}` names a line "2f_+ − f_-". None where no
    /// combination up to `order` is within `tolerance` (Hz).
    #[pyo3(signature = (fundamentals, order = 5, tolerance = 0.01))]
    fn named(
        &self,
        fundamentals: &Bound<'_, PyDict>,
        order: i128,
        tolerance: f64,
    ) -> PyResult<Vec<Option<String>>> {
        let fundamentals = fundamentals.items().extract::<Vec<(String, f64)>>()?;
        let (names, frequencies): (Vec<String>, Vec<f64>) = fundamentals.into_iter().unzip();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let order = whole("order", order, 1)?;
        let tones = self.found.named(&frequencies, order, tolerance).into_iter();
        Ok(tones.map(|tone| Some(tone?.named(&names))).collect())
    }

    fn __repr__(&self) -> String {
        let lines = self.found.lines.iter();
        let lines: Vec<String> = lines
            .map(|line| format!("{:.4} Hz: {:.3e}", line.frequency_hz, line.amplitude))
            .collect();
        format!("Lines({})", lines.join(", "))
    }
}

/// Finds the lines of samples taken `sample_rate` times a second, by numerical analysis of
/// fundamental frequencies (NAFF, after Laskar) with all lines fitted together: at most `most`
/// of them, none whose amplitude is below `smallest`, of that of the strongest, nor below what
/// noise would show. `window` is the power of Hann's window.
#[pyfunction]
#[pyo3(signature = (x, sample_rate, most = 12, smallest = 1e-9, window = 1))]
pub(crate) fn lines(
    py: Python<'_>,
    x: Numbers<'_>,
    sample_rate: f64,
    most: i128,
    smallest: f64,
    window: i128,
) -> PyResult<Lines> {
    let samples = x.list("x")?;
    let search = LineSearch {
        window: self::window(window)?,
        most: whole("most", most, 1)?,
        smallest,
    };
    let found = py.detach(|| search.find(&samples, sample_rate));
    Ok(Lines {
        found: found.map_err(refused)?,
    })
}

/// Returns the integral of `x` over the times `t` (s), from the first time to each: of fourth
/// order in the interval, for even and uneven times.
#[pyfunction]
pub(crate) fn running_integral<'py>(
    py: Python<'py>,
    t: Numbers<'py>,
    x: Numbers<'py>,
) -> PyResult<Row<'py>> {
    let (times, values) = (t.list("t")?, x.list("x")?);
    if times.len() != values.len() {
        let (times, values) = (times.len(), values.len());
        let text = format!("t has {times} times for {values} values in x");
        return Err(PyValueError::new_err(text));
    }
    Ok(branched_pendulum_measure::running_integral(&times, &values).into_pyarray(py))
}
