//! Motion step by step at the caller's pace: `Tree.stepper`.

use std::sync::{Arc, Mutex, PoisonError};

use branched_pendulum::integrate::{
    AnyIntegrator, IntegrationError as Failure, Integrator, Stepper,
};
use branched_pendulum::system::{Model, RatesOnly, State, Torques, UnderTorques};
use branched_pendulum_trees::PendulumTree;
use numpy::{IntoPyArray, PyArray1};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

use crate::arrays::{Numbers, Row};
use crate::failures::failed;
use crate::interrupts::detached;
use crate::results::report;
use crate::stepping::Stepping;
use crate::tree::Tree;

/// Where torques come from.
enum Source {
    /// Torques that stay as they are, N m.
    Constant(Vec<f64>),
    /// A function `f(t, y)` of Python.
    Function(Py<PyAny>),
}

/// Torques from outside, and what their function has raised.
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

    /// Torques on so many links, as they are given: a function, numbers, or none.
    fn from_python(torques: Option<&Bound<'_, PyAny>>, links: usize) -> PyResult<Self> {
        let Some(torques) = torques else {
            return Ok(Self::of(Source::Constant(vec![0.0; links])));
        };
        if torques.is_callable() {
            return Ok(Self::of(Source::Function(torques.clone().unbind())));
        }
        let numbers = torques.extract::<Numbers<'_>>().map_err(|error| {
            let reason = error.value(torques.py());
            let text = format!("torques: {reason}; it must be a function f(t, y) or an array");
            PyTypeError::new_err(text)
        })?;
        Ok(Self::of(Source::Constant(numbers.row("torques", links)?)))
    }

    fn call(&self, function: &Py<PyAny>, time: f64, state: &[f64]) -> PyResult<Vec<f64>> {
        Python::attach(|py| {
            // Functions that are no Python look at no signals.
            py.check_signals()?;
            let value = function
                .bind(py)
                .call1((time, PyArray1::from_slice(py, state)))?;
            let numbers = value.extract::<Numbers<'_>>().map_err(|error| {
                let reason = error.value(py);
                PyTypeError::new_err(format!("the value of torques: {reason}"))
            })?;
            numbers.row("the value of torques", state.len() / 2)
        })
    }
}

impl Torques<f64> for Acting {
    fn torques_into(&self, time: f64, theta: &[f64], omega: &[f64], torques: &mut [f64]) {
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

/// A motion under way, from `Tree.stepper`: the caller asks for its steps or its frames.
///
/// Between any two requests state and torques may be changed; the method then starts anew from
/// there. After an exception the state is that at the end of the last step that was made; after
/// Ctrl-C that before the call.
#[pyclass(name = "Stepper", module = "branched_pendulum")]
pub(crate) struct PyStepper {
    tree: PendulumTree,
    method: AnyIntegrator<f64>,
    acting: Acting,
    stepper: Under,
}

impl PyStepper {
    /// Makes a request of the stepper.
    ///
    /// # Errors
    /// What the function of torques or the handler of a signal has raised; that of a failure.
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
        let raised = self
            .acting
            .raised
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .take();
        match raised {
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

#[pymethods]
impl PyStepper {
    /// The time, s.
    #[getter]
    fn t(&self) -> f64 {
        self.stepper.time()
    }

    /// The state: angles (rad), angular velocities (rad/s), shape (2 n,).
    #[getter]
    fn y<'py>(&self, py: Python<'py>) -> Row<'py> {
        self.stepper.state().to_vec().into_pyarray(py)
    }

    /// The account of all steps so far.
    #[getter]
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        report(py, self.stepper.report())
    }

    /// Torques from outside: an array, shape (n,), N m, or a function `f(t, y)` of it; to be set.
    #[getter]
    fn torques<'py>(&self, py: Python<'py>) -> Bound<'py, PyAny> {
        match &*self.acting.source {
            Source::Constant(values) => values.clone().into_pyarray(py).into_any(),
            Source::Function(function) => function.bind(py).clone(),
        }
    }

    #[setter]
    fn set_torques(&mut self, torques: Option<Bound<'_, PyAny>>) -> PyResult<()> {
        self.acting = Acting::from_python(torques.as_ref(), self.tree.links())?;
        // By this the next step starts anew.
        *self.stepper.ode_mut() = system(&self.tree, &self.acting);
        Ok(())
    }

    /// Goes on from another time and state.
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
    fn set_state(&mut self, t: f64, y: Numbers<'_>) -> PyResult<()> {
        let state = y.row("y", 2 * self.tree.links())?;
        let set = self.stepper.set_state(t, &state);
        set.map_err(|error| failed(error.into()))
    }

    /// Makes one step, of the length that the method chooses.
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
    fn step(&mut self, py: Python<'_>, until: Option<f64>) -> PyResult<bool> {
        self.request(py, |stepper| match until {
            Some(end) => Ok(stepper.step_to(end)?.is_some()),
            None => stepper.step().map(|_| true),
        })
    }

    /// Moves time and state by a frame, in steps as long as the method makes them.
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
    fn advance<'py>(&mut self, py: Python<'py>, duration: f64) -> PyResult<Row<'py>> {
        if !duration.is_finite() {
            let text = format!("duration must be a finite time, got {duration} s");
            return Err(PyValueError::new_err(text));
        }
        self.request(py, |stepper| stepper.advance(duration))?;
        Ok(self.y(py))
    }

    fn __repr__(&self) -> String {
        let (time, steps) = (self.stepper.time(), self.stepper.report().accepted);
        format!("Stepper at t = {time} s after {steps} steps")
    }
}

#[pymethods]
impl Tree {
    /// Begins a motion that goes step by step, or frame by frame, under torques from outside.
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
    #[pyo3(signature = (y0, t = 0.0, *, torques = None, method = "dop853", rtol = 1e-9, atol = None, step = None, first_step = None, max_step = None, max_steps = 1_000_000))]
    #[allow(clippy::too_many_arguments)]
    fn stepper<'py>(
        &self,
        y0: Numbers<'py>,
        t: f64,
        torques: Option<Bound<'py, PyAny>>,
        method: &str,
        rtol: f64,
        atol: Option<Numbers<'py>>,
        step: Option<f64>,
        first_step: Option<f64>,
        max_step: Option<f64>,
        max_steps: i128,
    ) -> PyResult<PyStepper> {
        let tree = self.tree();
        let dimension = 2 * tree.links();
        let stepping = Stepping {
            method,
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
        let raised = acting
            .raised
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .take();
        if let Some(error) = raised {
            return Err(error);
        }
        Ok(PyStepper {
            tree: tree.clone(),
            stepper: stepper.map_err(failed)?,
            method,
            acting,
        })
    }
}
