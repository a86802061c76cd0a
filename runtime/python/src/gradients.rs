//! Derivatives in reverse mode: of accelerations, and of costs of motions.

use std::sync::Mutex;

use branched_pendulum::integrate::{
    AdjointMethod, AnyIntegrator, IntegrationError, Method, MotionGradient,
};
use branched_pendulum::system::{Model, State};
use numpy::IntoPyArray;
use pyo3::exceptions::{PyKeyError, PyTypeError, PyUserWarning, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arguments::{Argument, named, refused};
use crate::arrays::{Numbers, Together, matrix};
use crate::failures::failed;
use crate::interrupts::detached;
use crate::results::result;
use crate::stepping::Stepping;
use crate::tree::Tree;

/// Relative error of derivatives that is reported with a warning.
const DOUBTFUL: f64 = 0.01;

/// Message for a cost that returns something else.
const COST: &str = "cost must return a number and an array of its derivatives by y";

impl Tree {
    fn parameter_names(&self) -> Vec<String> {
        let names = self.tree().description().parameters();
        names.map(str::to_owned).collect()
    }
}

#[pymethods]
impl Tree {
    /// Returns the derivatives of a weighted sum of the angular accelerations in reverse mode: a
    /// vector-Jacobian product.
    ///
    /// All derivatives together take about five evaluations of the accelerations.
    ///
    /// Parameters
    /// ----------
    /// theta, omega : array, shape (..., n)
    ///     Angles (rad) and angular velocities (rad/s).
    /// weights : array, shape (..., n)
    ///     Weights of the accelerations in the sum.
    /// time : float
    ///     Time of the drive, s.
    /// torques : array, shape (..., n)
    ///     Torques (N m) from outside on each link.
    ///
    /// Returns
    /// -------
    /// AccelerationSlopes
    ///     With `theta`, `omega` and `torques` of the shape (..., n), and a dict `parameters` of
    ///     arrays of the shape (...).
    ///
    /// Examples
    /// --------
    /// >>> rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = l)", l=1.0)
    /// >>> slopes = rod.pullback([0.1], [0.0], [1.0])
    /// >>> slopes.theta.round(4), slopes.torques.round(4)
    /// (array([-14.6415]), array([3.]))
    /// >>> float(slopes.parameters["l"].round(4))
    /// 1.469
    #[pyo3(signature = (theta, omega, weights, time = 0.0, torques = None))]
    fn pullback<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::theta)] theta: Numbers<'py>,
        #[pyo3(from_py_with = named::omega)] omega: Numbers<'py>,
        #[pyo3(from_py_with = named::weights)] weights: Numbers<'py>,
        #[pyo3(from_py_with = named::time)] time: f64,
        #[pyo3(from_py_with = named::torques)] torques: Option<Numbers<'py>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let n = self.tree().links();
        let zero = Numbers::zeros(py, n);
        let torques = torques.as_ref().unwrap_or(&zero);
        let together = Together::of(&[
            ("theta", &theta, n),
            ("omega", &omega, n),
            ("weights", &weights, n),
            ("torques", torques, n),
        ])?;
        let (motion, names) = (self.tree().pullback(), self.parameter_names());
        let all = together.each(py, &[3 * n + names.len()], |given, out| {
            let (state, torques) = ([given[0], given[1]], Some(given[3]));
            let slopes = motion.accelerations_pullback(time, state, torques, given[2]);
            let parts = [
                &slopes.theta,
                &slopes.omega,
                &slopes.torques,
                &slopes.parameters,
            ];
            for (out, slope) in out.iter_mut().zip(parts.into_iter().flatten()) {
                *out = *slope;
            }
        })?;
        let part = |first: usize| -> PyResult<Bound<'py, PyAny>> {
            let of = pyo3::types::PySlice::new(py, first as isize, (first + n) as isize, 1);
            all.get_item((py.Ellipsis(), of))
        };
        let parameters = PyDict::new(py);
        for (place, name) in names.iter().enumerate() {
            parameters.set_item(name, all.get_item((py.Ellipsis(), 3 * n + place))?)?;
        }
        let fields = [
            ("theta", part(0)?),
            ("omega", part(n)?),
            ("torques", part(2 * n)?),
            ("parameters", parameters.into_any()),
        ];
        result(py, "AccelerationSlopes", &fields)
    }

    /// Returns the derivatives of a cost of a motion, by its start and by parameters of the tree.
    ///
    /// They are the derivatives of the numerical solution in reverse mode, and take about six
    /// runs, however many parameters there are. In a chaotic motion they grow as fast as two nearby
    /// motions separate: a warning says if `growth` is so large that they have no meaning.
    ///
    /// Parameters
    /// ----------
    /// cost : callable
    ///     `cost(y)` with the states `y` at the times `t`, shape (m, 2 n), returns a number and an
    ///     array of its derivatives by `y`.
    /// y0 : array, shape (2 n,)
    ///     The state at the first time.
    /// t : array, shape (m,)
    ///     Times, s.
    /// parameters : list of str
    ///     Names of parameters; all by default.
    /// method : str
    ///     "dop853", "dopri5", "verner98" or "gauss2" to "gauss8"; "auto" is "dop853".
    /// rtol, atol, step, max_steps
    ///     As those of `integrate`.
    ///
    /// Returns
    /// -------
    /// MotionGradient
    ///     With `cost`, the derivatives `y0` and a dict `parameters`, `growth` and `steps`.
    ///
    /// Examples
    /// --------
    /// The angle after two seconds:
    ///
    /// >>> rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = l)", l=1.0)
    /// >>> def angle(y):
    /// ...     slopes = np.zeros_like(y)
    /// ...     slopes[-1, 0] = 1.0
    /// ...     return y[-1, 0], slopes
    /// >>> found = rod.gradient(angle, [0.1, 0.0], [0.0, 2.0])
    /// >>> round(found.parameters["l"], 6)
    /// 0.376767
    #[pyo3(signature = (cost, y0, t, *, parameters = None, method = "auto", rtol = 1e-9, atol = None, step = None, max_steps = 1_000_000))]
    #[allow(clippy::too_many_arguments)]
    fn gradient<'py>(
        &self,
        py: Python<'py>,
        cost: Bound<'py, PyAny>,
        #[pyo3(from_py_with = named::y0)] y0: Numbers<'py>,
        #[pyo3(from_py_with = named::t)] t: Numbers<'py>,
        #[pyo3(from_py_with = named::parameters)] parameters: Option<Vec<String>>,
        #[pyo3(from_py_with = named::method)] method: &str,
        #[pyo3(from_py_with = named::rtol)] rtol: f64,
        #[pyo3(from_py_with = named::atol)] atol: Option<Numbers<'py>>,
        #[pyo3(from_py_with = named::step)] step: Option<f64>,
        #[pyo3(from_py_with = named::max_steps)] max_steps: i128,
    ) -> PyResult<Bound<'py, PyAny>> {
        if !cost.is_callable() {
            return Err(refused("cost", "a callable", &cost));
        }
        let dimension = 2 * self.tree().links();
        let (values, times) = (y0.row("y0", dimension)?, t.list("t")?);
        let Some(&first) = times.first() else {
            return Err(PyValueError::new_err("t must have at least one time"));
        };
        let all = self.parameter_names();
        let wanted = parameters.unwrap_or_else(|| all.clone());
        if let Some(name) = wanted.iter().find(|name| !all.contains(name)) {
            let text = format!(
                "the tree has no parameter `{name}`; it has {}",
                all.join(", ")
            );
            return Err(PyKeyError::new_err(text));
        }
        let stepping = Stepping {
            method,
            automatic: Method::Dop853,
            rtol,
            atol: atol.as_ref(),
            step,
            first_step: None,
            max_step: None,
            max_steps,
        };
        let method = stepping.integrator(dimension)?;
        let (start, motion) = (State::new(first, values), self.tree().pullback());
        let (cost, raised) = (cost.unbind(), Mutex::new(None));
        let found = detached(py, || {
            let evaluate = |samples: &[Vec<f64>], slopes: &mut [Vec<f64>]| {
                let value = Python::attach(|py| evaluated(cost.bind(py), samples, slopes));
                value.unwrap_or_else(|error| {
                    if let Ok(mut raised) = raised.lock() {
                        *raised = Some(error);
                    }
                    f64::NAN
                })
            };
            let parameters = motion.parameters();
            let (start, times) = (&start, &times);
            Some(match &method {
                AnyIntegrator::Dop853(own) => {
                    own.gradient_of_samples(&motion, parameters, start, times, evaluate)
                }
                AnyIntegrator::Dopri5(own) => {
                    own.gradient_of_samples(&motion, parameters, start, times, evaluate)
                }
                AnyIntegrator::Verner98(own) => {
                    own.gradient_of_samples(&motion, parameters, start, times, evaluate)
                }
                AnyIntegrator::Gauss(own) => {
                    own.gradient_of_samples(&motion, parameters, start, times, evaluate)
                }
                AnyIntegrator::Rk4(_) | AnyIntegrator::Taylor(_) => return None,
            })
        })?;
        if let Ok(Some(error)) = raised.into_inner() {
            return Err(error);
        }
        let Some(found): Option<Result<MotionGradient<f64>, IntegrationError<f64>>> = found else {
            let text = format!(
                "`{}` has no derivatives of motions; \"dop853\", \"dopri5\", \"verner98\" and \"gauss2\" to \
                 \"gauss8\" have",
                stepping.method()?
            );
            return Err(PyValueError::new_err(text));
        };
        let found = found.map_err(failed)?;
        if found.growth * rtol > DOUBTFUL {
            let text = format!(
                "the motion amplifies small changes by {:.1e}, so that derivatives at rtol = {rtol:e} \
                 say nothing about it; give t a shorter span, or a smaller rtol",
                found.growth
            );
            let text = std::ffi::CString::new(text)?;
            PyErr::warn(py, &py.get_type::<PyUserWarning>(), &text, 1)?;
        }
        let by_name = PyDict::new(py);
        for (name, slope) in all.iter().zip(&found.parameters) {
            if wanted.contains(name) {
                by_name.set_item(name, slope)?;
            }
        }
        let number = |value: f64| value.into_pyobject(py).map(Bound::into_any);
        let fields = [
            ("cost", number(found.cost)?),
            ("y0", found.start.into_pyarray(py).into_any()),
            ("parameters", by_name.into_any()),
            ("growth", number(found.growth)?),
            ("steps", found.steps.into_pyobject(py)?.into_any()),
        ];
        result(py, "MotionGradient", &fields)
    }
}

/// Calls the cost of a user with the states at all times; writes its derivatives and returns its
/// value.
fn evaluated(
    cost: &Bound<'_, PyAny>,
    samples: &[Vec<f64>],
    slopes: &mut [Vec<f64>],
) -> PyResult<f64> {
    let py = cost.py();
    let width = samples.first().map_or(1, Vec::len);
    let returned = cost.call1((matrix(py, samples.concat(), width)?,))?;
    let wrong = || {
        PyTypeError::new_err(format!(
            "{COST}, got {}",
            crate::arguments::value(&returned)
        ))
    };
    let parts: Vec<Bound<'_, PyAny>> = returned.extract().map_err(|_| wrong())?;
    let [value, derivatives] = &parts[..] else {
        return Err(wrong());
    };
    let derivatives = Numbers::of("derivatives of the cost", derivatives)?;
    let rows = derivatives.rows("derivatives of the cost", width)?;
    if rows.len() != slopes.len() {
        return Err(PyValueError::new_err(format!(
            "derivatives of the cost must have shape ({}, {width}), got ({}, {width})",
            slopes.len(),
            rows.len()
        )));
    }
    for (slopes, row) in slopes.iter_mut().zip(rows) {
        *slopes = row;
    }
    f64::of("cost", value)
}
