//! Measurement of error against computing time for every method: `Tree.work_precision`.

use branched_pendulum::integrate::Method;
use branched_pendulum::scalar::{Double, Scalar};
use branched_pendulum::system::{AbsoluteAngles, Model, State};
use branched_pendulum_advice::{AdviceError, KnownEnd, MethodRun, WorkPrecision};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::advise::refused;
use crate::arguments::named;
use crate::arrays::Numbers;
use crate::interrupts::detached;
use crate::results::{array, result};
use crate::tree::Tree;

/// Errors for which the result states the fastest method.
const ERRORS: [f64; 5] = [1e-3, 1e-6, 1e-9, 1e-11, 1e-13];

/// Returns the methods with the given names, or the usual ones if no names are given.
fn chosen(names: Option<Vec<String>>) -> PyResult<Vec<Method>> {
    let Some(names) = names else {
        return Ok(WorkPrecision::METHODS.to_vec());
    };
    let methods = names.iter().map(|name| {
        let method = name.parse::<Method>();
        method.map_err(|error| PyValueError::new_err(error.to_string()))
    });
    methods.collect()
}

fn for_python<'py>(
    py: Python<'py>,
    measured: &WorkPrecision,
    known: &KnownEnd,
) -> PyResult<Bound<'py, PyAny>> {
    let runs = measured.runs();
    let numbers =
        |of: &dyn Fn(&MethodRun) -> f64| array(py, runs.iter().map(of).collect(), &[runs.len()]);
    let methods: Vec<String> = runs.iter().map(|run| run.method.to_string()).collect();
    let table = measured.table(&ERRORS);
    let words = format!("{table}the end is known to {:.0e}", known.uncertainty);
    let fields = [
        ("methods", methods.into_pyobject(py)?.into_any()),
        ("settings", numbers(&|run| run.setting)?),
        ("errors", numbers(&|run| run.error)?),
        ("seconds", numbers(&|run| run.seconds)?),
        ("evaluations", numbers(&|run| run.evaluations as f64)?),
        (
            "end",
            array(py, known.values.clone(), &[known.values.len()])?,
        ),
        (
            "uncertainty",
            known.uncertainty.into_pyobject(py)?.into_any(),
        ),
        ("words", words.into_pyobject(py)?.into_any()),
    ];
    result(py, "WorkPrecision", &fields)
}

#[pymethods]
impl Tree {
    /// Measures error against time of the methods on one motion: a work-precision diagram.
    ///
    /// Each method runs at many tolerances or steps, each time for some 30 ms, on this machine.
    /// Errors are those at the end, against two runs in numbers of 31 digits, whose difference is
    /// the `uncertainty`: errors below that mean nothing, as those of a chaotic motion that is
    /// followed too long. A run that fails is left out: its step is too long.
    ///
    /// Parameters
    /// ----------
    /// y0 : array, shape (2 n,)
    ///     State at the start: angles (rad), then velocities (rad/s).
    /// t : pair of float
    ///     Times (s) of the start and the end.
    /// methods : sequence of str, optional
    ///     Names of methods, as `integrate` takes them; by default all with settings but
    ///     "gauss2" and "animation", which are for long steps.
    ///
    /// Returns
    /// -------
    /// WorkPrecision
    ///     Errors and times of all runs; `print(...)` has the time to given errors, `.plot()` draws.
    ///
    /// Raises
    /// ------
    /// IntegrationError
    ///     There is no reference: the motion could not be followed.
    ///
    /// Examples
    /// --------
    /// >>> rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = 1)")
    /// >>> measured = rod.work_precision([1.0, 0.0], (0, 1), ["rk4", "taylor"])
    /// >>> bool(measured.errors.min() < 1e-13)
    /// True
    #[pyo3(signature = (y0, t, methods = None))]
    fn work_precision<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::y0)] y0: Numbers<'py>,
        #[pyo3(from_py_with = named::t)] t: [f64; 2],
        #[pyo3(from_py_with = named::methods)] methods: Option<Vec<String>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let tree = self.tree();
        let [begin, end] = t;
        if !(begin.is_finite() && end.is_finite()) {
            return Err(PyValueError::new_err(format!(
                "t must be finite, got ({begin}, {end})"
            )));
        }
        let methods = chosen(methods)?;
        let start = y0.row("y0", 2 * tree.links())?;
        if let Some(number) = start.iter().find(|number| !number.is_finite()) {
            return Err(PyValueError::new_err(format!(
                "y0 must be finite, got {number}"
            )));
        }
        let start = State::new(begin, start);
        let outcome = detached(py, || {
            let wide = tree.cast(Double::from_f64);
            let known = KnownEnd::of(&AbsoluteAngles(&wide), &start, end)?;
            let system = AbsoluteAngles(tree);
            let expected = &known.values;
            let measured =
                WorkPrecision::measure(&system, &start, end, expected, &methods, |_, _| {});
            Ok::<_, AdviceError>((known, measured))
        })?;
        let (known, measured) = outcome.map_err(|error| refused(py, error))?;
        for_python(py, &measured, &known)
    }
}
