//! Motions that the caller advances step by step: `Tree.stepper`.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError, TryLockError};

use branched_pendulum::integrate::{
    AnyIntegrator, IntegrationError as Failure, Integrator, Method, Stepper,
};
use branched_pendulum::system::{Action, Model, RatesOnly, State, UnderTorques};
use branched_pendulum_trees::PendulumTree;
use numpy::{IntoPyArray, PyArray1};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::{PyTraverseError, PyVisit};

use crate::arguments::{Argument, named};
use crate::arrays::{Numbers, Row};
use crate::failures::failed;
use crate::interrupts::detached;
use crate::results::report;
use crate::stepping::Stepping;
use crate::tree::Tree;

/// Source of torques.
enum Source {
    /// Constant torques, in N m.
    Constant(Vec<f64>),
    /// A Python function `f(t, y)` that returns torques.
    Function(Py<PyAny>),
}

/// External torques, and the exception that their function has raised.
#[derive(Clone)]
struct Acting {
    source: Arc<Source>,
    raised: Arc<Mutex<Option<PyErr>>>,
}

impl Acting {
    fn of(source: Source) -> Self {
        Self {
            source: Arc::new(source),
            raised: Arc::new(Mutex::new(None)),
        }
    }

    fn none(links: usize) -> Self {
        Self::of(Source::Constant(vec![0.0; links]))
    }

    /// Returns the exception that the function has raised, the first time it is called.
    fn take_raised(&self) -> Option<PyErr> {
        let mut raised = self.raised.lock().unwrap_or_else(PoisonError::into_inner);
        raised.take()
    }

    /// Converts torques on `links` links from Python: a function, numbers, or `None`.
    fn from_python(torques: Option<&Bound<'_, PyAny>>, links: usize) -> PyResult<Self> {
        let Some(torques) = torques else {
            return Ok(Self::none(links));
        };
        if torques.is_callable() {
            return Ok(Self::of(Source::Function(torques.clone().unbind())));
        }
        let numbers = Numbers::converted("torques", "a function f(t, y) or real numbers", torques)?;
        Ok(Self::of(Source::Constant(numbers.row("torques", links)?)))
    }

    fn call(&self, function: &Py<PyAny>, time: f64, state: &[f64]) -> PyResult<Vec<f64>> {
        Python::attach(|py| {
            // Functions that are no Python look at no signals.
            py.check_signals()?;
            let value = function
                .bind(py)
                .call1((time, PyArray1::from_slice(py, state)))?;
            let numbers = Numbers::of("the value of torques", &value)?;
            numbers.row("the value of torques", state.len() / 2)
        })
    }
}

impl Action<f64> for Acting {
    fn act(&self, time: f64, theta: &[f64], omega: &[f64], torques: &mut [f64]) {
        let values = match &*self.source {
            Source::Constant(values) => {
                torques.copy_from_slice(values);
                return;
            }
            Source::Function(function) => self.call(function, time, &[theta, omega].concat()),
        };
        match values {
            Ok(values) => torques.copy_from_slice(&values),
            Err(error) => {
                let mut raised = self.raised.lock().unwrap_or_else(PoisonError::into_inner);
                raised.get_or_insert(error);
                // It ends the step.
                torques.fill(f64::NAN);
            }
        }
    }
}

type System = RatesOnly<UnderTorques<PendulumTree, Acting>>;

fn system(tree: &PendulumTree, acting: &Acting) -> System {
    RatesOnly(UnderTorques::of(tree.clone(), acting.clone()))
}

type Under = Stepper<AnyIntegrator<f64>, System>;

/// A motion that the caller advances by steps or by frames; created by `Tree.stepper`.
///
/// State and torques may be changed between two calls; the method then restarts from the new state.
/// After an exception, the state is the end of the last completed step; after Ctrl-C, the state
/// before the call.
#[pyclass(frozen, name = "Stepper", module = "branched_pendulum")]
pub(crate) struct PyStepper {
    /// State of the motion, locked during each call.
    progress: Mutex<Progress>,
}

/// State of a motion between two calls.
struct Progress {
    tree: PendulumTree,
    name: Method,
    method: AnyIntegrator<f64>,
    acting: Acting,
    stepper: Under,
}

impl Progress {
    /// Replaces the torques, so that the next step restarts the method. Returns the previous
    /// torques.
    fn act(&mut self, acting: Acting) -> Acting {
        *self.stepper.ode_mut() = system(&self.tree, &acting);
        std::mem::replace(&mut self.acting, acting)
    }

    /// Runs work on the stepper.
    ///
    /// # Errors
    /// The exception that the function of torques or the handler of a signal has raised, or the
    /// exception for a failed step.
    fn request<R: Send>(
        &mut self,
        py: Python<'_>,
        work: impl FnOnce(&mut Under) -> Result<R, Failure<f64>> + Send,
    ) -> PyResult<R> {
        let outcome = match &*self.acting.source {
            Source::Function(_) => work(&mut self.stepper),
            Source::Constant(_) => {
                let before = self.stepper.to_state();
                let stepper = &mut self.stepper;
                match detached(py, || work(stepper)) {
                    Ok(outcome) => outcome,
                    Err(interrupted) => {
                        // A step was left in its middle: nothing of it is kept.
                        self.restart(&before)?;
                        return Err(interrupted);
                    }
                }
            }
        };
        match self.acting.take_raised() {
            Some(error) => Err(error),
            None => outcome.map_err(failed),
        }
    }

    fn restart(&mut self, state: &State<f64>) -> PyResult<()> {
        let system = system(&self.tree, &self.acting);
        self.stepper = self.method.start(system, state).map_err(failed)?;
        Ok(())
    }
}

impl PyStepper {
    /// Locks the motion for one call.
    ///
    /// # Errors
    /// RuntimeError if the stepper is in use: by another thread, or if the function of torques
    /// calls it during a step.
    fn progress(&self) -> PyResult<MutexGuard<'_, Progress>> {
        match self.progress.try_lock() {
            Ok(progress) => Ok(progress),
            Err(TryLockError::Poisoned(poisoned)) => Ok(poisoned.into_inner()),
            Err(TryLockError::WouldBlock) => Err(PyRuntimeError::new_err(
                "the stepper is in the middle of a step, and cannot be used until the step ends; \
                 torques f(t, y) have its time and state as arguments, t and y",
            )),
        }
    }
}

#[pymethods]
impl PyStepper {
    /// Reports the function of torques to Python's garbage collector, because it often refers to
    /// the stepper. A stepper that is making a step is in use and reports nothing.
    fn __traverse__(&self, visit: PyVisit<'_>) -> Result<(), PyTraverseError> {
        if let Ok(progress) = self.progress.try_lock()
            && let Source::Function(function) = &*progress.acting.source
        {
            visit.call(function)?;
        }
        Ok(())
    }

    fn __clear__(&self) {
        let before = self.progress().map(|mut progress| {
            let none = Acting::none(progress.tree.links());
            progress.act(none)
        });
        // Unlocked: the end of an object may call Python.
        drop(before);
    }

    /// The time, s.
    #[getter]
    fn t(&self) -> PyResult<f64> {
        Ok(self.progress()?.stepper.time())
    }

    /// The present state: angles (rad), angular velocities (rad/s), shape (2 n,).
    #[getter]
    fn y<'py>(&self, py: Python<'py>) -> PyResult<Row<'py>> {
        Ok(self.progress()?.stepper.state().to_vec().into_pyarray(py))
    }

    /// Report of all steps so far.
    #[getter]
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let progress = self.progress()?;
        report(py, progress.name, progress.stepper.report(), None)
    }

    /// External torques: an array of shape (n,) in N m, or a function `f(t, y)` that returns one.
    /// Can be assigned.
    #[getter]
    fn torques<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(match &*self.progress()?.acting.source {
            Source::Constant(values) => values.clone().into_pyarray(py).into_any(),
            Source::Function(function) => function.bind(py).clone(),
        })
    }

    #[setter]
    fn set_torques(&self, torques: Option<Bound<'_, PyAny>>) -> PyResult<()> {
        let links = self.progress()?.tree.links();
        let acting = Acting::from_python(torques.as_ref(), links)?;
        let before = self.progress()?.act(acting);
        // Unlocked: the end of an object may call Python.
        drop(before);
        Ok(())
    }

    /// Continues from another time and state.
    ///
    /// Parameters
    /// ----------
    /// t : float
    ///     Time, s.
    /// y : array, shape (2 n,)
    ///     Angles (rad), angular velocities (rad/s).
    ///
    /// Returns
    /// -------
    /// None
    ///
    /// Examples
    /// --------
    /// >>> rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = 1)")
    /// >>> stepper = rod.stepper([0.1, 0.0])
    /// >>> stepper.set_state(2.0, [0.2, 0.0])
    /// >>> stepper.t, stepper.y
    /// (2.0, array([0.2, 0. ]))
    fn set_state(
        &self,
        #[pyo3(from_py_with = named::t)] t: f64,
        #[pyo3(from_py_with = named::y)] y: Numbers<'_>,
    ) -> PyResult<()> {
        let mut progress = self.progress()?;
        let state = y.row("y", 2 * progress.tree.links())?;
        let set = progress.stepper.set_state(t, &state);
        set.map_err(|error| failed(error.into()))
    }

    /// Makes one step, whose length the method chooses.
    ///
    /// Parameters
    /// ----------
    /// until : float
    ///     Time (s) that the step does not pass; it may lie before the present one.
    ///
    /// Returns
    /// -------
    /// bool
    ///     True if a step was made, False where `until` is reached.
    ///
    /// Examples
    /// --------
    /// >>> rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = 1)")
    /// >>> stepper = rod.stepper([0.1, 0.0])
    /// >>> while stepper.step(until=1.0):
    /// ...     pass
    /// >>> stepper.t, stepper.y.round(4)
    /// (1.0, array([-0.077 ,  0.2446]))
    #[pyo3(signature = (until = None))]
    fn step(
        &self,
        py: Python<'_>,
        #[pyo3(from_py_with = named::until)] until: Option<f64>,
    ) -> PyResult<bool> {
        self.progress()?.request(py, |stepper| match until {
            Some(end) => Ok(stepper.step_to(end)?.is_some()),
            None => stepper.step().map(|_| true),
        })
    }

    /// Advances time and state by one frame. The method chooses the lengths of the steps.
    ///
    /// Parameters
    /// ----------
    /// duration : float
    ///     Length of the frame (s), backwards if it is negative.
    ///
    /// Returns
    /// -------
    /// array, shape (2 n,)
    ///     The state at its end, by the dense output of the method.
    ///
    /// Examples
    /// --------
    /// >>> rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = 1)")
    /// >>> stepper = rod.stepper([0.1, 0.0])
    /// >>> for frame in range(60):
    /// ...     y = stepper.advance(1 / 60)
    /// >>> y.round(4)
    /// array([-0.077 ,  0.2446])
    fn advance<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::duration)] duration: f64,
    ) -> PyResult<Row<'py>> {
        if !duration.is_finite() {
            let text = format!("duration must be a finite time, got {duration} s");
            return Err(PyValueError::new_err(text));
        }
        let mut progress = self.progress()?;
        progress.request(py, |stepper| stepper.advance(duration))?;
        Ok(progress.stepper.state().to_vec().into_pyarray(py))
    }

    fn __repr__(&self) -> PyResult<String> {
        let progress = self.progress()?;
        let (time, steps) = (progress.stepper.time(), progress.stepper.report().accepted);
        Ok(format!("Stepper at t = {time} s after {steps} steps"))
    }
}

#[pymethods]
impl Tree {
    /// Starts a motion that is advanced step by step, or frame by frame, under external torques.
    ///
    /// Parameters
    /// ----------
    /// y0 : array, shape (2 n,)
    ///     The state at the time `t`.
    /// t : float
    ///     Time, s.
    /// torques : function, or array, shape (n,)
    ///     Torques on the links (N m): `f(t, y)` gives an array of them, as a function of time and
    ///     state (wind, a controller, friction by a law of one's own); an array stays as it is
    ///     until `stepper.torques` is set. A torque on link i does the work `torques[i] * omega[i]`.
    /// method, rtol, atol, step, first_step, max_step
    ///     As those of `integrate`; not "taylor", which torques have no series for.
    /// max_steps : int
    ///     Steps after which one request fails.
    ///
    /// Returns
    /// -------
    /// Stepper
    ///
    /// Examples
    /// --------
    /// A controller that holds a rod upright:
    ///
    /// >>> rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = 1)")
    /// >>> def hold(t, y):
    /// ...     return [-20 * (y[0] - np.pi) - 4 * y[1]]
    /// >>> stepper = rod.stepper([3.0, 0.0], torques=hold)
    /// >>> float(stepper.advance(10.0)[0].round(6))
    /// 3.141593
    #[pyo3(signature = (y0, t = 0.0, *, torques = None, method = "auto", rtol = 1e-9, atol = None, step = None, first_step = None, max_step = None, max_steps = 1_000_000))]
    #[allow(clippy::too_many_arguments)]
    fn stepper<'py>(
        &self,
        #[pyo3(from_py_with = named::y0)] y0: Numbers<'py>,
        #[pyo3(from_py_with = named::t)] t: f64,
        torques: Option<Bound<'py, PyAny>>,
        #[pyo3(from_py_with = named::method)] method: &str,
        #[pyo3(from_py_with = named::rtol)] rtol: f64,
        #[pyo3(from_py_with = named::atol)] atol: Option<Numbers<'py>>,
        #[pyo3(from_py_with = named::step)] step: Option<f64>,
        #[pyo3(from_py_with = named::first_step)] first_step: Option<f64>,
        #[pyo3(from_py_with = named::max_step)] max_step: Option<f64>,
        #[pyo3(from_py_with = named::max_steps)] max_steps: i128,
    ) -> PyResult<PyStepper> {
        let tree = self.tree();
        let dimension = 2 * tree.links();
        let stepping = Stepping {
            method,
            automatic: Method::explicit_pair(rtol),
            rtol,
            atol: atol.as_ref(),
            step,
            first_step,
            max_step,
            max_steps,
        };
        let method = stepping.integrator(dimension)?;
        if matches!(method, AnyIntegrator::Taylor(_)) {
            let text =
                "method: torques from outside have no Taylor series, another method takes them";
            return Err(PyValueError::new_err(text));
        }
        let acting = Acting::from_python(torques.as_ref(), tree.links())?;
        let start = State::new(t, y0.row("y0", dimension)?);
        let stepper = method.start(system(tree, &acting), &start);
        if let Some(error) = acting.take_raised() {
            return Err(error);
        }
        let progress = Progress {
            tree: tree.clone(),
            stepper: stepper.map_err(failed)?,
            name: stepping.method()?,
            method,
            acting,
        };
        Ok(PyStepper {
            progress: Mutex::new(progress),
        })
    }
}
