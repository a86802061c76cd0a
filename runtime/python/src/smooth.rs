//! Functions that smooth measured angles.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arguments::named;
use crate::arrays::Numbers;
use crate::estimates::{Coordinates, Smoother};
use crate::interrupts::on_own_thread;
use crate::memory::{bytes, need};
use crate::pendulum::Pendulum;
use crate::smoothing::{SmoothedMotion, refused, rows};

/// Approximate number of values that are stored per measured value (by equations of motion: per
/// pair of values at one time), for the memory check.
const NUMBERS_OF_A_DATUM: usize = 60;

/// Checks that memory suffices to smooth this many values.
fn check_memory(data: &[usize]) -> PyResult<()> {
    need("the motion", bytes(data, NUMBERS_OF_A_DATUM))
}

/// Smooths time series of any coordinates, each separately.
///
/// For angles of identical branches it is better to smooth means and differences, as
/// `Pendulum.smooth` does.
///
/// Parameters
/// ----------
/// t : array, shape (m,)
///     Times (s), ascending, even or not.
/// x : array, shape (m,) or (m, k)
///     Data, a column for each coordinate; NaN where they are missing.
/// method : {"kinematic", "polynomials"}
///     "kinematic" knows that a motion is smooth and no more: its jerk is white, and noise and
///     jerk are those of largest likelihood. "polynomials" fits one near each time, a
///     cross-check.
/// noise : float
///     Standard deviation of the data, in their unit, if it is known.
///
/// Returns
/// -------
/// SmoothedMotion
///
/// Examples
/// --------
/// >>> t = np.linspace(0, 5, 501)
/// >>> data = np.sin(t) + np.random.default_rng(1).normal(0, 1e-3, t.size)
/// >>> motion = bp.analysis.smooth(t, data)
/// >>> bool(np.abs(motion.y[:, 1] - np.cos(t)).max() < 0.02)
/// True
#[pyfunction]
#[pyo3(signature = (t, x, method = "kinematic", noise = None))]
pub(crate) fn smooth(
    py: Python<'_>,
    #[pyo3(from_py_with = named::t)] t: Numbers<'_>,
    #[pyo3(from_py_with = named::x)] x: Numbers<'_>,
    #[pyo3(from_py_with = named::method)] method: &str,
    #[pyo3(from_py_with = named::noise)] noise: Option<f64>,
) -> PyResult<SmoothedMotion> {
    let (times, data) = (t.list("t")?, rows("x", &x, t.shape())?);
    let smoother = Smoother::of(method, noise).ok_or_else(|| {
        PyValueError::new_err(format!(
            "method is {method:?}, must be \"kinematic\" or \"polynomials\""
        ))
    })?;
    let columns = data.first().map_or(0, Vec::len);
    check_memory(&[times.len(), columns])?;
    let coordinates = Coordinates::links(columns);
    let kept = times.clone();
    let estimate = on_own_thread(py, move || smoother.estimate(&kept, &data, coordinates))?;
    let names = (1..=columns).map(|number| number.to_string()).collect();
    let function = py.import("branched_pendulum.analysis")?.getattr("smooth")?;
    let arguments = (t.array(), x.array(), method, noise).into_pyobject(py)?;
    let origin = (function.unbind(), arguments.unbind());
    SmoothedMotion::of(py, times, names, estimate.map_err(refused)?, origin)
}

#[pymethods]
impl Pendulum {
    /// Estimates the motion from noisy measured angles. For a compiled model, its symmetric
    /// coordinates are smoothed.
    ///
    /// Parameters
    /// ----------
    /// t : array, shape (m,)
    ///     Times (s), ascending, even or not.
    /// theta : array, shape (m, n)
    ///     Angles (rad from the downward vertical), a column for each link; NaN where they are
    ///     missing.
    /// method : {"kinematic", "polynomials", "equations"}
    ///     "kinematic" knows that the motion is smooth and no more; "polynomials" fits one near
    ///     each time, a cross-check; "equations" knows the equations of motion, and finds out how
    ///     much they lack: errors are far smaller where they hold.
    /// noise : float
    ///     Standard deviation of the angles (rad), found from them if it is not given.
    /// friction : bool
    ///     True to find friction that the equations lack, where the data show some.
    ///
    /// Returns
    /// -------
    /// SmoothedMotion
    ///
    /// Examples
    /// --------
    /// >>> rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = 1)")
    /// >>> t = np.linspace(0, 2, 201)
    /// >>> swing = rod.integrate([0.5, 0.0], t).y
    /// >>> seen = swing[:, :1] + np.random.default_rng(1).normal(0, 1e-3, (201, 1))
    /// >>> motion = rod.smooth(t, seen, method="equations")
    /// >>> bool(np.abs(motion.y - swing).max() < 2e-3)
    /// True
    #[pyo3(signature = (t, theta, method = "kinematic", noise = None, friction = false))]
    fn smooth<'py>(
        slf: &Bound<'py, Self>,
        #[pyo3(from_py_with = named::t)] t: Numbers<'py>,
        #[pyo3(from_py_with = named::theta)] theta: Numbers<'py>,
        #[pyo3(from_py_with = named::method)] method: &str,
        #[pyo3(from_py_with = named::noise)] noise: Option<f64>,
        #[pyo3(from_py_with = named::friction)] friction: bool,
    ) -> PyResult<SmoothedMotion> {
        let (py, motions) = (slf.py(), slf.get().motions.clone());
        let (times, angles) = (t.list("t")?, rows("theta", &theta, t.shape())?);
        let names = motions.names();
        let columns = angles.first().map_or(0, Vec::len);
        if columns != names.len() {
            let links = names.len();
            let text = format!("theta has {columns} columns, must have {links}, one for each link");
            return Err(PyValueError::new_err(text));
        }
        let by_equations = method == "equations";
        if friction && !by_equations {
            let text = format!("friction = True needs method = \"equations\", not {method:?}");
            return Err(PyValueError::new_err(text));
        }
        let first = if by_equations { "kinematic" } else { method };
        let smoother = Smoother::of(first, noise).ok_or_else(|| {
            let words = r#"must be "kinematic", "polynomials" or "equations""#;
            PyValueError::new_err(format!("method is {method:?}, {words}"))
        })?;
        let beside = if by_equations { columns } else { 1 };
        check_memory(&[times.len(), columns, beside])?;
        let kept = times.clone();
        let estimate = on_own_thread(py, move || {
            let estimate = smoother.estimate(&kept, &angles, motions.smoothed_coordinates())?;
            match by_equations {
                true => motions.smooth(noise, friction, &kept, &angles, &estimate.states[0]),
                false => Ok(estimate),
            }
        })?;
        let arguments = (t.array(), theta.array(), method, noise, friction).into_pyobject(py)?;
        let origin = (slf.getattr("smooth")?.unbind(), arguments.unbind());
        SmoothedMotion::of(py, times, names, estimate.map_err(refused)?, origin)
    }
}
