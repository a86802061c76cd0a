//! Small deviations from a motion: Lyapunov exponents, and the growth of differences between
//! copies.

use branched_pendulum::analysis::variational::{Lyapunov, LyapunovError};
use branched_pendulum::integrate::Options;
use branched_pendulum::system::State;
use numpy::IntoPyArray;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::IntegrationError;
use crate::arguments::named;
use crate::arrays::{Numbers, Row, whole};
use crate::failures::failed;
use crate::growth::{GrowthTask, copies};
use crate::interrupts::detached;
use crate::motions::Deviations;
use crate::pendulum::{Pendulum, ensemble};

#[pymethods]
impl Pendulum {
    /// Returns the largest Lyapunov exponents of a motion.
    ///
    /// Deviations in general position are made orthonormal after each interval, and their growth is
    /// recorded. If copies move in phase, they stay in phase, and there are exponents of two kinds:
    /// `within`, for deviations that are equal in all copies, and `transverse`, for differences
    /// between copies, which grow if the largest of these exponents is positive.
    ///
    /// Parameters
    /// ----------
    /// y0 : array, shape (2 n,)
    ///     The state at the time `t0` (s).
    /// count : int
    ///     Number of exponents.
    /// interval : float
    ///     Time (s) after which deviations are made orthonormal.
    /// settling, intervals : int
    ///     Intervals that are left out, and those that are counted after them.
    /// rtol : float
    ///     Tolerance of one step.
    /// within, transverse : list of sets of names
    ///     Links that are copies, with all that hangs from them:
    ///     `transverse=[("child_1", "child_2")]`. One of the two at most.
    ///
    /// Returns
    /// -------
    /// exponents, errors : arrays, shape (count,)
    ///     Exponents (1/s), the largest first, and their standard errors.
    ///
    /// Examples
    /// --------
    /// A rod that stands upright falls by exp(t √(3 g / 2 l)).
    ///
    /// >>> rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = 1)")
    /// >>> exponents, _ = rod.lyapunov([np.pi, 0.0], interval=0.1, intervals=20)
    /// >>> float(exponents[0].round(3)), float(np.sqrt(1.5 * 9.81).round(3))
    /// (3.836, 3.836)
    #[pyo3(signature = (y0, count = 1, interval = 0.5, settling = 20, intervals = 200, t0 = 0.0, rtol = 1e-9, within = None, transverse = None))]
    #[allow(clippy::too_many_arguments)]
    fn lyapunov<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::y0)] y0: Numbers<'py>,
        #[pyo3(from_py_with = named::count)] count: i128,
        #[pyo3(from_py_with = named::interval)] interval: f64,
        #[pyo3(from_py_with = named::settling)] settling: i128,
        #[pyo3(from_py_with = named::intervals)] intervals: i128,
        #[pyo3(from_py_with = named::t0)] t0: f64,
        #[pyo3(from_py_with = named::rtol)] rtol: f64,
        #[pyo3(from_py_with = named::within)] within: Option<Vec<Vec<String>>>,
        #[pyo3(from_py_with = named::transverse)] transverse: Option<Vec<Vec<String>>>,
    ) -> PyResult<(Row<'py>, Row<'py>)> {
        let start = State::new(t0, y0.row("y0", self.motions.dimension())?);
        let exponents = Lyapunov {
            count: whole("count", count, 1)?,
            interval,
            settling: whole("settling", settling, 0)?,
            intervals: whole("intervals", intervals, 1)?,
        };
        let starts = std::slice::from_ref(&start);
        let of = |alike: Vec<Vec<String>>| copies(&*self.motions, &alike, starts);
        let deviations = match (within, transverse) {
            (None, None) => Deviations::All,
            (Some(alike), None) => Deviations::Within(of(alike)?),
            (None, Some(alike)) => Deviations::Transverse(of(alike)?),
            _ => {
                let text = "exponents are those `within` motions in phase or `transverse` to them";
                return Err(PyValueError::new_err(text));
            }
        };
        let options = Options::with_tolerance(rtol);
        let spectrum = detached(py, || {
            self.motions
                .lyapunov(&exponents, &deviations, options, &start)
        })?;
        let spectrum = spectrum.map_err(|error| match error {
            LyapunovError::Count { .. }
            | LyapunovError::Interval { .. }
            | LyapunovError::NotInPhase => PyValueError::new_err(error.to_string()),
            LyapunovError::Integration(failure) => failed(failure),
            error => IntegrationError::new_err(error.to_string()),
        })?;
        let [exponents, errors] = [spectrum.exponents, spectrum.standard_errors];
        Ok((exponents.into_pyarray(py), errors.into_pyarray(py)))
    }

    /// Returns the growth of an infinitesimal difference between two identical links, including the
    /// links below them.
    ///
    /// All differences δ start with the same size and at rest, and their common size √(Σ δ²) is
    /// recorded, 32 times per period of the difference. Everything is computed at two tolerances;
    /// the result for the tighter one is returned.
    ///
    /// Parameters
    /// ----------
    /// starts : array, shape (k, 2 n)
    ///     States at the time 0, a row for each motion, in which both links are in phase with
    ///     all that hangs from them.
    /// pair : two names
    ///     The links.
    /// horizons : array, shape (h,)
    ///     Times (s) up to which growth is asked for, ascending.
    /// frequency : float
    ///     Frequency (Hz) of the difference, by default that beside all links hanging at rest.
    /// rtol : float
    ///     The coarser tolerance of one step; the finer is a hundredth of it.
    /// threads : int
    ///     Number of threads, by default as many as there are cores.
    ///
    /// Returns
    /// -------
    /// Growth
    ///     `factors` of shape (k, h), `rates` and `frequencies` of shape (k,). NaN where a motion
    ///     could not be followed, reported by the warning `FailedMotions` as in `ensemble`.
    ///
    /// Examples
    /// --------
    /// The paper's pendulum, below and above its threshold:
    ///
    /// >>> paper = bp.models.BranchedDouble()
    /// >>> starts = np.radians([[39.5, 0, 0], [47.8, 0, 0]])
    /// >>> starts = np.concatenate([starts, np.zeros((2, 3))], axis=1)
    /// >>> grown = paper.growth(starts, ("child_1", "child_2"), [4.0])
    /// >>> grown.factors[:, 0].round(1)
    /// array([ 1.2, 58.2])
    #[pyo3(signature = (starts, pair, horizons, frequency = None, rtol = 1e-9, threads = None))]
    #[allow(clippy::too_many_arguments)]
    fn growth<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::starts)] starts: Numbers<'py>,
        #[pyo3(from_py_with = named::pair)] pair: Vec<String>,
        #[pyo3(from_py_with = named::horizons)] horizons: Numbers<'py>,
        #[pyo3(from_py_with = named::frequency)] frequency: Option<f64>,
        #[pyo3(from_py_with = named::rtol)] rtol: f64,
        #[pyo3(from_py_with = named::threads)] threads: Option<i128>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let task = GrowthTask {
            starts: self.starts(&starts, 0.0)?,
            horizons: horizons.list("horizons")?,
            frequency_hz: frequency,
            tolerance: rtol,
        };
        task.grown(py, &*self.motions, &pair, &ensemble(threads)?)
    }
}
