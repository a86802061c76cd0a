//! Choice of the cheapest model, method and setting that is accurate enough: `Tree.advise`.

use branched_pendulum::system::{Model, State};
use branched_pendulum_advice::{
    Advice, AdviceError, Criterion, Measured, SettingRange, TimeLimit, TreeOutput, TreeScene,
    UnknownOutput,
};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::IntegrationError;
use crate::arguments::{Entries, named};
use crate::arrays::{Numbers, Times, axes};
use crate::interrupts::detached;
use crate::memory::{bytes, need};
use crate::results::result;
use crate::tree::{Tree, wrong};

/// Number of samples if only a span of time is given.
const SAMPLES: u32 = 100;

/// Approximate number of values stored per component of a state and time, for the memory check.
const COPIES: usize = 12;

/// Returns the first time, which is the time of the starts, and the times of the samples after it.
fn samples(t: &Times<'_>) -> PyResult<(f64, Vec<f64>)> {
    let times = t.numbers.list("t")?;
    if let Some(time) = times.iter().find(|time| !time.is_finite()) {
        return Err(PyValueError::new_err(format!(
            "t must be finite, got {time}"
        )));
    }
    let mut steps = times.windows(2).map(|pair| pair[1] - pair[0]);
    let mut same = steps.clone();
    if !(steps.all(|step| step >= 0.0) || same.all(|step| step <= 0.0)) {
        return Err(PyValueError::new_err("t must ascend or descend"));
    }
    match times[..] {
        [begin, end] if t.is_span => {
            let sample = |index| begin + (end - begin) * f64::from(index) / f64::from(SAMPLES);
            Ok((begin, (1..=SAMPLES).map(sample).collect()))
        }
        [begin, ref samples @ ..] if !samples.is_empty() => Ok((begin, samples.to_vec())),
        _ => Err(PyValueError::new_err(format!(
            "t must have the time of the starts and at least one more, got {}",
            times.len()
        ))),
    }
}

/// Converts the name of an output and its largest allowed error.
fn wanted((name, most): (String, f64)) -> PyResult<(TreeOutput, f64)> {
    let output = name.parse();
    let output = output.map_err(|error: UnknownOutput| PyKeyError::new_err(error.to_string()))?;
    if !(most.is_finite() && most > 0.0) {
        let text = format!("right[{name:?}] must be above 0, got {most}");
        return Err(PyValueError::new_err(text));
    }
    Ok((output, most))
}

fn limit(step: Option<f64>, sample: Option<f64>) -> PyResult<Option<TimeLimit>> {
    let checked = |name: &str, seconds: f64| match seconds > 0.0 {
        true => Ok(seconds),
        false => {
            let text = format!("{name} must be a time above 0 s, got {seconds}");
            Err(PyValueError::new_err(text))
        }
    };
    match (step, sample) {
        (None, None) => Ok(None),
        (Some(step), None) => Ok(Some(TimeLimit::Step(checked("step_limit", step)?))),
        (None, Some(sample)) => Ok(Some(TimeLimit::Sample(checked("sample_limit", sample)?))),
        _ => Err(PyValueError::new_err(
            "give step_limit= or sample_limit=, not both",
        )),
    }
}

pub(crate) fn refused(py: Python<'_>, error: AdviceError) -> PyErr {
    match error {
        AdviceError::Tree(error) => wrong(py, error),
        AdviceError::Reference(cause) => {
            let text = format!("there is no reference to measure errors against: {cause}");
            IntegrationError::new_err(text)
        }
        error => PyValueError::new_err(error.to_string()),
    }
}

/// Returns the arguments of `integrate`, or of `ensemble` for runs in lanes, by name.
fn arguments<'py>(
    py: Python<'py>,
    advice: &Advice,
    run: &Measured,
) -> PyResult<Option<Bound<'py, PyDict>>> {
    let Some(method) = advice.method(run) else {
        return Ok(None);
    };
    let named = PyDict::new(py);
    named.set_item("method", method.to_string())?;
    let setting = match method.is_adaptive() {
        true => "rtol",
        false => "step",
    };
    named.set_item(setting, run.setting)?;
    Ok(Some(named))
}

/// Returns the Python call that performs a run.
fn call(advice: &Advice, run: &Measured) -> Option<String> {
    let method = advice.method(run)?;
    let setting = match method.is_adaptive() {
        true => format!("rtol={:e}", run.setting),
        false => format!("step={}", run.setting),
    };
    Some(match advice.names[run.candidate].in_lanes {
        true => format!("tree.ensemble(starts, t, method=\"{method}\", {setting})"),
        false => format!("tree.integrate(y0, t, method=\"{method}\", {setting})"),
    })
}

fn measured<'py>(
    py: Python<'py>,
    advice: &Advice,
    run: &Measured,
    samples: usize,
) -> PyResult<Bound<'py, PyAny>> {
    let name = &advice.names[run.candidate];
    let number = |value: f64| value.into_pyobject(py).map(Bound::into_any);
    let words = |value: &str| value.into_pyobject(py).map(Bound::into_any);
    let worst = run.worst.as_ref();
    let output = worst.and_then(|worst| advice.outputs.get(worst.output));
    let criterion = worst.map(|worst| match worst.criterion {
        Criterion::Values => "values",
        Criterion::Conserved => "conserved",
        Criterion::Statistics => "statistics",
    });
    // Beyond the outputs stands what the motion keeps.
    let judged = worst.map(|_| output.map_or("energy", |output| output.name.as_str()));
    let unit = worst.map(|_| output.map_or("J", |output| output.unit));
    let (kind, setting) = match advice.range(run) {
        SettingRange::Tolerance { .. } => (Some("rtol"), Some(run.setting)),
        SettingRange::Step { .. } => (Some("step"), Some(run.setting)),
        SettingRange::Fixed => (None, None),
    };
    let fields = [
        ("model", words(&name.model)?),
        ("method", words(&name.method)?),
        ("scalar", words(name.scalar)?),
        (
            "in_lanes",
            name.in_lanes.into_pyobject(py)?.to_owned().into_any(),
        ),
        ("setting_name", kind.into_pyobject(py)?.into_any()),
        ("setting", setting.into_pyobject(py)?.into_any()),
        ("ratio", number(run.ratio())?),
        ("output", judged.into_pyobject(py)?.into_any()),
        ("criterion", criterion.into_pyobject(py)?.into_any()),
        (
            "error",
            number(worst.map_or(f64::NAN, |worst| worst.error))?,
        ),
        ("unit", unit.into_pyobject(py)?.into_any()),
        ("time", number(worst.map_or(f64::NAN, |worst| worst.time))?),
        ("seconds", number(run.seconds)?),
        (
            "seconds_per_sample",
            number(run.seconds / samples.max(1) as f64)?,
        ),
        ("steps", number(run.steps)?),
        ("failure", run.failure.clone().into_pyobject(py)?.into_any()),
        (
            "arguments",
            arguments(py, advice, run)?.into_pyobject(py)?.into_any(),
        ),
        ("words", words(&advice.describe(run))?),
        ("evidence", words(&advice.evidence(run))?),
    ];
    result(py, "MeasuredRun", &fields)
}

fn advice_for_python<'py>(
    py: Python<'py>,
    mut advice: Advice,
    samples: usize,
) -> PyResult<Bound<'py, PyAny>> {
    let run = |run: &Measured| measured(py, &advice, run, samples);
    let some = |of: Option<&Measured>| of.map(run).transpose();
    let all = |runs: &mut dyn Iterator<Item = &Measured>| -> PyResult<Bound<'py, PyList>> {
        let list = PyList::empty(py);
        for own in runs {
            list.append(run(own)?)?;
        }
        Ok(list)
    };
    let outputs = PyDict::new(py);
    for output in &advice.outputs {
        let own = PyDict::new(py);
        own.set_item("unit", output.unit)?;
        own.set_item("tolerance", output.tolerance)?;
        own.set_item("reference_error", output.reference_error)?;
        own.set_item("known_until", output.chaotic_from)?;
        outputs.set_item(&output.name, own)?;
    }
    let fields = [
        (
            "choice",
            some(advice.chosen())?.into_pyobject(py)?.into_any(),
        ),
        (
            "runner_up",
            some(advice.runner_up())?.into_pyobject(py)?.into_any(),
        ),
        (
            "next_cheaper",
            some(advice.next_cheaper())?.into_pyobject(py)?.into_any(),
        ),
        (
            "closest",
            some(advice.closest())?.into_pyobject(py)?.into_any(),
        ),
        ("ranking", all(&mut advice.ranked())?.into_any()),
        ("runs", all(&mut advice.runs.iter())?.into_any()),
        ("outputs", outputs.into_any()),
        (
            "reference",
            advice.reference.clone().into_pyobject(py)?.into_any(),
        ),
        ("growth", advice.growth.into_pyobject(py)?.into_any()),
    ];
    let best = advice.best_full().and_then(|(run, _)| call(&advice, run));
    advice.to_write = best.into_iter().collect();
    let words = advice.to_string().trim_end().into_pyobject(py)?.into_any();
    result(py, "Advice", &[&fields[..], &[("words", words)]].concat())
}

#[pymethods]
impl Tree {
    /// Measures which model, integration method and setting is the cheapest that is accurate enough
    /// for given motions.
    ///
    /// Candidates are the equations of motion by every method, of several starts in vector
    /// registers too, in double and single precision, and the linear model about the place of rest
    /// where the times are evenly spaced. Errors are those against a reference that is good to a
    /// hundredth of the tolerances. Where the motion is chaotic, values are compared as long as
    /// double precision knows them, and beyond the drift of the energy counts, or means. Costs
    /// are measured on this machine, for one start on one core; it takes as long as some ten runs
    /// of each candidate.
    ///
    /// Parameters
    /// ----------
    /// starts : array, shape (..., 2 n)
    ///     A state, or several, at the first time.
    /// t : array, shape (m,), or a pair in parentheses
    ///     Times (s) at which states are wanted; of a pair, `(0, 10)`, a hundred between them.
    /// right : dict of float
    ///     Outputs with the largest errors that they may have: "angles" (rad), "energy" (J),
    ///     "pixels" (of the ends of links, 1000 a metre), "transfer" (W into the first difference
    ///     between copies). By default angles to 1e-6 rad.
    /// step_limit, sample_limit : float
    ///     Longest time (s) that a step may take, or a sample: a frame of a game.
    ///
    /// Returns
    /// -------
    /// Advice
    ///     The choice and all runs with errors and costs; `print(advice)` says it in words,
    ///     `tree.integrate(y0, t, **advice.arguments)` follows it.
    ///
    /// Raises
    /// ------
    /// IntegrationError
    ///     There is no reference: the motion could not be followed.
    ///
    /// Examples
    /// --------
    /// >>> rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = 1)")
    /// >>> advice = rod.advise([1.0, 0.0], (0, 2), {"angles": 1e-8})
    /// >>> advice.choice.ratio <= 1.0, advice.choice.model
    /// (True, 'full')
    /// >>> motion = rod.integrate([1.0, 0.0], (0, 2), **advice.arguments)
    #[pyo3(signature = (starts, t, right = None, *, step_limit = None, sample_limit = None))]
    fn advise<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::starts)] starts: Numbers<'py>,
        #[pyo3(from_py_with = named::t)] t: Times<'py>,
        #[pyo3(from_py_with = named::right)] right: Option<Entries<f64>>,
        #[pyo3(from_py_with = named::step_limit)] step_limit: Option<f64>,
        #[pyo3(from_py_with = named::sample_limit)] sample_limit: Option<f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let tree = self.tree();
        let dimension = 2 * tree.links();
        axes("starts", &starts, dimension)?;
        let (begin, times) = samples(&t)?;
        let numbers = starts.to_vec();
        if let Some(number) = numbers.iter().find(|number| !number.is_finite()) {
            return Err(PyValueError::new_err(format!(
                "starts must be finite, got {number}"
            )));
        }
        let rows = numbers.chunks_exact(dimension.max(1));
        let starts: Vec<State<f64>> = rows.map(|row| State::new(begin, row.to_vec())).collect();
        need(
            "states of all candidates",
            bytes(&[starts.len(), times.len(), dimension], COPIES),
        )?;
        let right = match right {
            None => vec![(TreeOutput::Angles, 1e-6)],
            Some(Entries(right)) => right.into_iter().map(wanted).collect::<PyResult<_>>()?,
        };
        let scene = TreeScene {
            starts,
            times,
            right,
            limit: limit(step_limit, sample_limit)?,
        };
        let advice = detached(py, || scene.advise(tree))?;
        let advice = advice.map_err(|error| refused(py, error))?;
        advice_for_python(py, advice, scene.times.len())
    }
}
