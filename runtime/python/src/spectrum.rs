//! Spectra of time series and their lines: the class `Lines`.

use branched_pendulum_measure::{
    LineSearch, Lines as Found, SpectralLine, Spectrum, SpectrumError, SpectrumOptions, Window,
};
use numpy::{IntoPyArray, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::arguments::{Entries, named};
use crate::arrays::{Numbers, Row, Table, whole};
use crate::interrupts::on_own_thread;

fn refused(error: SpectrumError) -> PyErr {
    PyValueError::new_err(error.to_string())
}

fn window(power: i128) -> PyResult<Window> {
    Ok(match whole("window", power, 0)? {
        0 => Window::Rectangular,
        power => Window::HannPower(power),
    })
}

/// Returns the amplitude spectrum of a series. A sine wave of amplitude a, at one of the
/// frequencies, has the value a in the spectrum.
///
/// Parameters
/// ----------
/// x : array, shape (m,)
///     Samples.
/// sample_rate : float
///     Samples a second, Hz.
/// frequencies : array, shape (k,)
///     Frequencies (Hz), by default those of Fourier.
/// window : int
///     Power of Hann's window by which samples are weighed, 0 for none.
/// remove_mean : bool
///     True to take off the mean before.
///
/// Returns
/// -------
/// frequencies, amplitudes : arrays, shape (k,)
///     Hz, and the unit of `x`.
///
/// Examples
/// --------
/// >>> x = 2 * np.sin(2 * np.pi * 5 * np.arange(100) / 100)
/// >>> bp.analysis.spectrum(x, 100, [5.0])[1].round(6)
/// array([2.])
#[pyfunction]
#[pyo3(signature = (x, sample_rate, frequencies = None, window = 1, remove_mean = true))]
pub(crate) fn spectrum<'py>(
    py: Python<'py>,
    #[pyo3(from_py_with = named::x)] x: Numbers<'py>,
    #[pyo3(from_py_with = named::sample_rate)] sample_rate: f64,
    #[pyo3(from_py_with = named::frequencies)] frequencies: Option<Numbers<'py>>,
    #[pyo3(from_py_with = named::window)] window: i128,
    #[pyo3(from_py_with = named::remove_mean)] remove_mean: bool,
) -> PyResult<(Row<'py>, Row<'py>)> {
    let samples = x.list("x")?;
    let frequencies = frequencies.map(|frequencies| frequencies.list("frequencies"));
    let frequencies = frequencies.transpose()?;
    let options = SpectrumOptions {
        remove_mean,
        window: self::window(window)?,
    };
    let found = on_own_thread(py, move || match frequencies {
        None => Spectrum::at_fourier_frequencies(&samples, sample_rate, options),
        Some(all) => Spectrum::at_frequencies(&samples, sample_rate, &all, options),
    })?;
    let Spectrum {
        frequencies_hz,
        amplitudes,
    } = found.map_err(refused)?;
    Ok((frequencies_hz.into_pyarray(py), amplitudes.into_pyarray(py)))
}

/// Spectral lines of a series, the strongest first. The series is a drift plus waves `amplitude *
/// cos(2π frequency t + phase)`, with t from the first sample.
#[pyclass(frozen, module = "branched_pendulum.analysis")]
pub(crate) struct Lines {
    found: Found,
    /// Arguments with which the lines were found.
    arguments: Py<PyTuple>,
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

    /// Standard deviations of the frequencies (Hz), if everything except the line itself is
    /// considered noise.
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

    /// Phases at the first sample, in rad, from −π to π.
    #[getter]
    fn phases<'py>(&self, py: Python<'py>) -> Row<'py> {
        self.each(py, |line| line.phase)
    }

    /// Mean of the series.
    #[getter]
    fn mean(&self) -> f64 {
        self.found.mean
    }

    /// Drift of the series: coefficients of the powers 0, 1, … of the time (s) measured from the
    /// middle of the record.
    #[getter]
    fn trend<'py>(&self, py: Python<'py>) -> Row<'py> {
        self.found.trend.clone().into_pyarray(py)
    }

    /// Amplitude of the strongest remaining component that is slower than one cycle over the
    /// record; 0 if it is not above the noise. Such a component may hide lines: use a larger
    /// `trend`.
    #[getter]
    fn slow(&self) -> f64 {
        self.found.slow
    }

    /// Root mean square of the series after drift and lines are subtracted.
    #[getter]
    fn residual(&self) -> f64 {
        self.found.residual
    }

    /// Frequency difference (Hz) below which two lines cannot be separated: one cycle over the
    /// record.
    #[getter]
    fn resolution(&self) -> f64 {
        self.found.resolution_hz
    }

    fn __len__(&self) -> usize {
        self.found.lines.len()
    }

    /// Returns the sum of drift and lines at the given times (s), measured from the first sample.
    fn __call__<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::t)] t: Numbers<'py>,
    ) -> PyResult<Table<'py>> {
        let shape = t.shape().to_vec();
        let times = t.to_vec();
        let values = times.iter().map(|time| self.found.value(*time));
        values.collect::<Vec<f64>>().into_pyarray(py).reshape(shape)
    }

    /// Returns the name of each line as a combination of fundamental frequencies.
    ///
    /// Parameters
    /// ----------
    /// fundamentals : dict
    ///     Frequencies (Hz) by name.
    /// order : int
    ///     Largest sum of the combination's numbers.
    /// tolerance : float
    ///     Distance (Hz) within which a line is a combination.
    ///
    /// Returns
    /// -------
    /// list of str or None
    ///     "2f_+ − f_-" and the like; None where no combination is near.
    ///
    /// Examples
    /// --------
    /// >>> x = 2 * np.sin(2 * np.pi * 5.3 * np.arange(500) / 100)
    /// >>> bp.analysis.lines(x, 100).named({"f": 5.3})
    /// ['f']
    #[pyo3(signature = (fundamentals, order = 5, tolerance = 0.01))]
    fn named(
        &self,
        #[pyo3(from_py_with = named::fundamentals)] fundamentals: Entries<f64>,
        #[pyo3(from_py_with = named::order)] order: i128,
        #[pyo3(from_py_with = named::tolerance)] tolerance: f64,
    ) -> PyResult<Vec<Option<String>>> {
        let (names, frequencies): (Vec<String>, Vec<f64>) = fundamentals.0.into_iter().unzip();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let order = whole("order", order, 1)?;
        let tones = self.found.named(&frequencies, order, tolerance).into_iter();
        Ok(tones.map(|tone| Some(tone?.named(&names))).collect())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Py<PyTuple>)> {
        let find = py.import("branched_pendulum.analysis")?.getattr("lines")?;
        Ok((find, self.arguments.clone_ref(py)))
    }

    /// Compares with another object; true if it has the same lines.
    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        let other = other.cast::<Self>();
        other.is_ok_and(|other| self.found == other.get().found)
    }

    fn __repr__(&self) -> String {
        let lines = self.found.lines.iter();
        let lines: Vec<String> = lines
            .map(|line| format!("{:.4} Hz: {:.3e}", line.frequency_hz, line.amplitude))
            .collect();
        format!("Lines({})", lines.join(", "))
    }
}

/// Finds the lines of a series, by numerical analysis of fundamental frequencies (NAFF, after
/// Laskar) with all lines fitted together.
///
/// Parameters
/// ----------
/// x : array, shape (m,)
///     Samples.
/// sample_rate : float
///     Samples a second, Hz.
/// most : int
///     Lines at most.
/// smallest : float
///     Amplitude below which no line is looked for, of that of the strongest; none is below
///     what noise would show.
/// window : int
///     Power of Hann's window.
/// trend : int
///     Largest degree of the polynomial that follows a drift of the series, 0 for its mean alone.
///     The degree is raised only while something slower than a cycle over the record is left.
///
/// Returns
/// -------
/// Lines
///
/// Examples
/// --------
/// >>> t = np.arange(500) / 100
/// >>> x = 2 * np.sin(2 * np.pi * 5.3 * t)
/// >>> bp.analysis.lines(x, 100).frequencies.round(6)
/// array([5.3])
///
/// A drift hides no line:
///
/// >>> found = bp.analysis.lines(x + 7 * t, 100)
/// >>> found.frequencies.round(6), found.trend.round(6)[1]
/// (array([5.3]), np.float64(7.0))
#[pyfunction]
#[pyo3(signature = (x, sample_rate, most = 12, smallest = 1e-9, window = 1, trend = 3))]
pub(crate) fn lines(
    py: Python<'_>,
    #[pyo3(from_py_with = named::x)] x: Numbers<'_>,
    #[pyo3(from_py_with = named::sample_rate)] sample_rate: f64,
    #[pyo3(from_py_with = named::most)] most: i128,
    #[pyo3(from_py_with = named::smallest)] smallest: f64,
    #[pyo3(from_py_with = named::window)] window: i128,
    #[pyo3(from_py_with = named::trend)] trend: i128,
) -> PyResult<Lines> {
    let power = window;
    let samples = x.list("x")?;
    let search = LineSearch {
        window: self::window(window)?,
        most: whole("most", most, 1)?,
        smallest,
        trend: whole("trend", trend, 0)?,
    };
    let found = on_own_thread(py, move || search.find(&samples, sample_rate))?;
    let arguments = (x.array(), sample_rate, most, smallest, power, trend).into_pyobject(py)?;
    Ok(Lines {
        found: found.map_err(refused)?,
        arguments: arguments.unbind(),
    })
}

/// Returns the integral of a series from the first time to each time.
///
/// Parameters
/// ----------
/// t : array, shape (m,)
///     Times (s), even or not.
/// x : array, shape (m,)
///     Values.
///
/// Returns
/// -------
/// array, shape (m,)
///     Integrals, in the unit of `x` times s: of fourth order in the interval.
///
/// Examples
/// --------
/// >>> t = np.linspace(0, 1, 11)
/// >>> round(float(bp.analysis.running_integral(t, 3 * t**2)[-1]), 6)
/// 1.0
#[pyfunction]
pub(crate) fn running_integral<'py>(
    py: Python<'py>,
    #[pyo3(from_py_with = named::t)] t: Numbers<'py>,
    #[pyo3(from_py_with = named::x)] x: Numbers<'py>,
) -> PyResult<Row<'py>> {
    let (times, values) = (t.list("t")?, x.list("x")?);
    if times.len() != values.len() {
        let (times, values) = (times.len(), values.len());
        let text = format!("t has {times} times for {values} values in x");
        return Err(PyValueError::new_err(text));
    }
    Ok(branched_pendulum_measure::running_integral(&times, &values).into_pyarray(py))
}
