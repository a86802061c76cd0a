//! The class `Pendulum`: methods that trees and compiled models share.

use std::num::NonZeroUsize;
use std::sync::Arc;

use branched_pendulum::ensemble::Ensemble;
use branched_pendulum::system::State;
use numpy::{IntoPyArray, PyArray3, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arguments::{Argument, Entries, named};
use crate::arrays::{Numbers, ONE_EACH, Times, Together, by_state, whole};
use crate::failures::Failures;
use crate::interrupts::detached;
use crate::memory::{allocate, shown};
use crate::motions::Motions;
use crate::stepping::Stepping;

/// A pendulum whose motions can be computed: a tree described by a text, or a compiled model.
///
/// SI units; angles are absolute, in radians from the downward vertical. A state is the angles
/// (rad) followed by the angular velocities (rad/s), both in the order of `names`: 2 n numbers for
/// n links. Functions of a state accept arrays of states of any shape; the last axis contains the
/// numbers of one state.
#[pyclass(frozen, subclass, module = "branched_pendulum")]
pub(crate) struct Pendulum {
    pub(crate) motions: Arc<dyn Motions>,
}

/// Creates an ensemble that uses all cores, or the given number of threads.
pub(crate) fn ensemble(threads: Option<i128>) -> PyResult<Ensemble<'static>> {
    let Some(threads) = threads else {
        return Ok(Ensemble::new());
    };
    let threads = NonZeroUsize::new(whole("threads", threads, 1)?);
    Ok(Ensemble::new().threads(threads.unwrap_or(NonZeroUsize::MIN)))
}

/// Number of sampled values that are stored between two checks of the available memory.
const BLOCK: usize = 4 << 20;

/// Smallest number of starts that are computed together, so that threads do not wait for each
/// other.
const LEAST_STARTS: usize = 512;

#[pymethods]
impl Pendulum {
    /// Names of the links, in the order of the angles.
    #[getter]
    fn names(&self) -> Vec<String> {
        self.motions.names()
    }

    fn __len__(&self) -> usize {
        self.motions.names().len()
    }

    /// Returns the rates of change of states, as `scipy.integrate.solve_ivp` needs them.
    ///
    /// Parameters
    /// ----------
    /// t : float or array
    ///     Time, s: of account where a drive acts.
    /// y : array, shape (..., 2 n)
    ///     States.
    /// axis : int
    ///     Axis of `y` along which the numbers of one state stand: the last by default, 0 for
    ///     arrays of shape (2 n, k) as `solve_ivp(..., vectorized=True)` passes them.
    ///
    /// Returns
    /// -------
    /// array of the shape of `y`
    ///     Angular velocities (rad/s), then angular accelerations (rad/s²).
    ///
    /// Examples
    /// --------
    /// >>> rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = 1)")
    /// >>> rod.rhs(0.0, [[np.pi / 2, 0.0], [0.0, 2.0]]).round(3) + 0.0
    /// array([[  0.   , -14.715],
    ///        [  2.   ,   0.   ]])
    ///
    /// SciPy's implicit methods, which evaluate several states at once:
    ///
    /// >>> from functools import partial
    /// >>> from scipy.integrate import solve_ivp
    /// >>> rates = partial(rod.rhs, axis=0)
    /// >>> solve_ivp(rates, (0, 1), [0.1, 0.0], "Radau", vectorized=True).success
    /// True
    #[pyo3(signature = (t, y, axis = -1))]
    fn rhs<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::t)] t: Numbers<'py>,
        #[pyo3(from_py_with = named::y)] y: Numbers<'py>,
        #[pyo3(from_py_with = named::axis)] axis: i128,
    ) -> PyResult<Bound<'py, PyAny>> {
        if axis == -1 {
            return self.rates(py, &t, &y);
        }
        let axes = y.shape().len() as i128;
        if !(-axes..axes).contains(&axis) {
            let text = format!("axis must be one of the {axes} axes of y, got {axis}");
            return Err(PyValueError::new_err(text));
        }
        let turn = py.import("numpy")?.getattr("moveaxis")?;
        let states = turn.call1((y.array(), axis, -1))?;
        let rates = self.rates(py, &t, &Numbers::of("y", &states)?)?;
        turn.call1((rates, -1, axis))
    }

    /// Returns the energy K + U (J) of states.
    ///
    /// Parameters
    /// ----------
    /// y : array, shape (..., 2 n)
    ///     States.
    ///
    /// Returns
    /// -------
    /// array, shape (...), or float of one state
    ///     Energies, J; in the frame that moves with the root's pivot.
    ///
    /// Examples
    /// --------
    /// >>> rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = 1)")
    /// >>> float(rod.energy([0.0, 3.0]) - rod.energy([0.0, 0.0]))
    /// 1.5
    fn energy<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::y)] y: Numbers<'py>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let motions = &*self.motions;
        by_state(py, &y, motions.dimension(), |state| [motions.energy(state)])
    }

    /// Integrates the motion from a state.
    ///
    /// Parameters
    /// ----------
    /// y0 : array, shape (2 n,)
    ///     The state at the first time.
    /// t : array, shape (m,), or a pair in parentheses
    ///     Times (s) at which states are wanted, ascending or descending; of a pair in
    ///     parentheses, `(0, 10)`, the ends of all steps between them, as SciPy's `t_span`.
    /// method : str
    ///     "dop853", "dopri5", "verner98" and, of a `Tree`, "taylor" choose their steps;
    ///     "rk4", "gauss2" to "gauss8" and "animation" go by steps of the length `step`.
    ///     "auto" takes the one of the first four that is usually the fastest for this model and
    ///     tolerance; `report.method` names it.
    /// rtol, atol : float; atol also an array of shape (2 n,)
    ///     Tolerances of one step; `atol` (rad, rad/s) is by default a thousandth of `rtol`.
    /// step : float
    ///     Length of all steps (s), of methods with one.
    /// first_step, max_step : float
    ///     First step that is tried and the longest one (s), of methods that choose.
    /// events : function or list of functions
    ///     Functions `f(t, y)` whose zeros are found, as SciPy's are: with `f.terminal = True`
    ///     the motion ends at the first, with `f.terminal = k` at the k-th; `f.direction` above
    ///     or below zero counts rising or falling ones alone. All events at the time of the
    ///     last one are reported, so that a motion from there repeats none and misses none.
    /// dense_output : bool
    ///     True to have the state at any time: `solution(t)`.
    /// max_steps : int
    ///     Steps after which the motion fails.
    /// precision : float
    ///     Error of angles (rad) up to which the motion is compared with a second run, by a finer
    ///     tolerance or step and from a start that differs by rounding: `report.differs_from` is
    ///     the first time at which they differ by more, of the times `t` and of the ends of all
    ///     steps. Chaos makes later states arbitrary.
    ///
    /// Returns
    /// -------
    /// Solution
    ///     Times `t`, states `y` of shape (m, 2 n), `t_events`, `y_events`, `report`.
    ///
    /// Raises
    /// ------
    /// RequestError
    ///     The motion cannot be followed as it was asked for.
    /// IntegrationError
    ///     It could not be followed to its end: `error.solution` has it up to there.
    ///
    /// Examples
    /// --------
    /// >>> rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = 1)")
    /// >>> motion = rod.integrate([0.1, 0.0], [0.0, 0.5, 1.0], rtol=1e-12)
    /// >>> motion.y.round(4)
    /// array([[ 0.1   ,  0.    ],
    ///        [-0.0339, -0.3607],
    ///        [-0.077 ,  0.2446]])
    /// >>> def bottom(t, y):
    /// ...     return y[0]
    /// >>> rod.integrate([0.1, 0.0], (0, 2), events=bottom).t_events[0].round(3)
    /// array([0.41 , 1.229])
    /// >>> print(rod.integrate([0.1, 0.0], (0, 2), precision=1e-6).report.differs_from)
    /// None
    #[pyo3(signature = (y0, t, method = "auto", rtol = 1e-9, atol = None, step = None, events = None, dense_output = false, max_steps = 1_000_000, *, first_step = None, max_step = None, precision = None))]
    #[allow(clippy::too_many_arguments)]
    fn integrate<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::y0)] y0: Numbers<'py>,
        #[pyo3(from_py_with = named::t)] t: Times<'py>,
        #[pyo3(from_py_with = named::method)] method: &str,
        #[pyo3(from_py_with = named::rtol)] rtol: f64,
        #[pyo3(from_py_with = named::atol)] atol: Option<Numbers<'py>>,
        #[pyo3(from_py_with = named::step)] step: Option<f64>,
        events: Option<Bound<'py, PyAny>>,
        #[pyo3(from_py_with = named::dense_output)] dense_output: bool,
        #[pyo3(from_py_with = named::max_steps)] max_steps: i128,
        #[pyo3(from_py_with = named::first_step)] first_step: Option<f64>,
        #[pyo3(from_py_with = named::max_step)] max_step: Option<f64>,
        #[pyo3(from_py_with = named::precision)] precision: Option<f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let stepping = Stepping {
            method,
            automatic: self.motions.fastest_method(rtol),
            rtol,
            atol: atol.as_ref(),
            step,
            first_step,
            max_step,
            max_steps,
        };
        let events = events.as_ref();
        self.follow(py, &y0, &t, &stepping, events, dense_output, precision)
    }

    /// Integrates many motions, in vector registers on all cores.
    ///
    /// Parameters
    /// ----------
    /// starts : array, shape (k, 2 n)
    ///     The states at the first time, a row for each motion.
    /// t : array, shape (m,)
    ///     Times, s.
    /// method : str
    ///     "dop853", "dopri5", "verner98" and, of a `Tree`, "taylor"; "auto" takes the one that is
    ///     usually the fastest for this model and this `rtol`.
    /// rtol, atol, first_step, max_step, max_steps
    ///     As those of `integrate`.
    /// threads : int
    ///     Number of threads, by default as many as there are cores.
    /// parameters : dict of arrays, shape (k,)
    ///     Values of parameters of a `Tree` by name, one for each start.
    ///
    /// Returns
    /// -------
    /// array, shape (k, m, 2 n)
    ///     States, NaN from where a motion could not be followed: the warning `FailedMotions`
    ///     has the reason of each in `reasons`, by the index of its start. To have them,
    ///     `warnings.simplefilter("error", FailedMotions)` makes an exception of it, and
    ///     `warnings.catch_warnings(record=True)` keeps it with the states.
    ///
    /// Examples
    /// --------
    /// >>> rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = 1)")
    /// >>> rod.ensemble([[0.1, 0.0], [0.2, 0.0]], [0.0, 1.0])[:, -1, 0].round(4)
    /// array([-0.077, -0.155])
    /// >>> rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = l)", l=1)
    /// >>> rod.ensemble([[0.1, 0.0]] * 2, [0.0, 1.0], parameters={"l": [1, 2]})[:, -1, 0].round(4)
    /// array([-0.077 , -0.0909])
    #[pyo3(signature = (starts, t, method = "auto", rtol = 1e-9, atol = None, threads = None, max_steps = 1_000_000, *, first_step = None, max_step = None, parameters = None))]
    #[allow(clippy::too_many_arguments)]
    fn ensemble<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::starts)] starts: Numbers<'py>,
        #[pyo3(from_py_with = named::t)] t: Numbers<'py>,
        #[pyo3(from_py_with = named::method)] method: &str,
        #[pyo3(from_py_with = named::rtol)] rtol: f64,
        #[pyo3(from_py_with = named::atol)] atol: Option<Numbers<'py>>,
        #[pyo3(from_py_with = named::threads)] threads: Option<i128>,
        #[pyo3(from_py_with = named::max_steps)] max_steps: i128,
        #[pyo3(from_py_with = named::first_step)] first_step: Option<f64>,
        #[pyo3(from_py_with = named::max_step)] max_step: Option<f64>,
        #[pyo3(from_py_with = named::parameters)] parameters: Option<Entries<Numbers<'py>>>,
    ) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let dimension = self.motions.dimension();
        let refused = || {
            PyValueError::new_err(format!(
                "ensembles go by `dop853`, `dopri5`, `verner98` and, of trees, `taylor`, not by \
                 `{method}`"
            ))
        };
        let stepping = Stepping {
            method,
            automatic: self.motions.fastest_in_lanes(rtol),
            rtol,
            atol: atol.as_ref(),
            // Methods with steps of one length are refused as such.
            step: None,
            first_step,
            max_step,
            max_steps,
        };
        if ["rk4", "animation"].contains(&method) || method.starts_with("gauss") {
            return Err(refused());
        }
        let chosen = stepping.integrator(dimension)?;
        let times = t.list("t")?;
        let Some(&first) = times.first() else {
            return Err(PyValueError::new_err("t has no times"));
        };
        let starts = self.starts(&starts, first)?;
        let ensemble = ensemble(threads)?;
        let parameters: Option<Vec<(String, Vec<f64>)>> = parameters
            .map(|Entries(all)| {
                let values = all.into_iter().map(|(name, values)| {
                    let values = values.row(&format!("parameters[{name:?}]"), starts.len())?;
                    Ok((name, values))
                });
                values.collect::<PyResult<_>>()
            })
            .transpose()?;
        let shape = [starts.len(), times.len(), dimension];
        let mut values = allocate(&shape)?;
        let length = dimension * times.len();
        let mut failures = Failures::default();
        let block = (BLOCK / length.max(1)).max(LEAST_STARTS);
        for starts in starts.chunks(block) {
            let begin = values.len() / length.max(1);
            let own = parameters.as_ref().map(|all| {
                let part = |values: &Vec<f64>| values[begin..begin + starts.len()].to_vec();
                let all = all.iter();
                all.map(|(name, values)| (name.clone(), part(values)))
                    .collect::<Vec<_>>()
            });
            let motions = &self.motions;
            let samples = detached(py, || match &own {
                None => Ok(motions.ensemble(&chosen, &ensemble, starts, &times)),
                Some(own) => motions.ensemble_of_models(&chosen, &ensemble, own, starts, &times),
            })?;
            let samples = samples.map_err(PyValueError::new_err)?;
            for sample in &samples.ok_or_else(refused)? {
                let begin = values.len();
                if let Err(failure) = &sample.end {
                    failures.note(begin / length.max(1), failure)?;
                }
                let states = sample.states();
                states.for_each(|state| values.extend_from_slice(state));
                values.resize(begin + length, f64::NAN);
            }
        }
        failures.warn(py, shape[0])?;
        values.into_pyarray(py).reshape(shape)
    }
}

impl Pendulum {
    /// Returns the rates of change of states whose numbers are along the last axis.
    fn rates<'py>(
        &self,
        py: Python<'py>,
        t: &Numbers<'py>,
        y: &Numbers<'py>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let dimension = self.motions.dimension();
        if let [first, .., last] = *y.shape()
            && first == dimension
            && last != dimension
        {
            return Err(PyValueError::new_err(format!(
                "y must have {dimension} numbers along its last axis, got {}; help: pass axis=0 if \
                 they are along its first, as in solve_ivp(..., vectorized=True)",
                shown(y.shape())
            )));
        }
        let (times, single) = (t.to_vec(), t.shape().is_empty());
        let motions = &*self.motions;
        if let ([time], true) = (&times[..], single) {
            let together = Together::of(&[("y", y, dimension)])?;
            let rates = |given: &[&[f64]], out: &mut [f64]| motions.rates(*time, given[0], out);
            return together.each(py, &[dimension], rates);
        }
        let together = Together::of(&[("t", t, ONE_EACH), ("y", y, dimension)])?;
        let rates = |given: &[&[f64]], out: &mut [f64]| motions.rates(given[0][0], given[1], out);
        together.each(py, &[dimension], rates)
    }

    /// Converts the rows of an array to states, all at the given time.
    pub(crate) fn starts(&self, starts: &Numbers<'_>, time: f64) -> PyResult<Vec<State<f64>>> {
        let rows = starts.rows("starts", self.motions.dimension())?;
        Ok(rows.into_iter().map(|row| State::new(time, row)).collect())
    }
}
