//! Identification of a tree's parameters from its measured motion and frequencies: `Tree.identify`.

use std::ops::ControlFlow;

use branched_pendulum_measure::identification::{
    AngleErrors, AngleRecord, Fit, FittedFrequency, Frequency, Identification, IdentificationError,
    Standing,
};
use branched_pendulum_trees::{ParameterUse, TreeDescription};
use pyo3::exceptions::{PyKeyError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyMapping};

use crate::arguments::{Argument, Entries, named, refused};
use crate::arrays::Numbers;
use crate::interrupts::on_own_thread;
use crate::jumps::refuse_jumps;
use crate::memory::{bytes, need};
use crate::results::{array, result};
use crate::smoothing::rows;
use crate::tree::Tree;

/// Typical sizes of friction coefficients whose search starts at 0: viscous and Coulomb friction (N
/// m s, N m), and quadratic (N m s²).
const FRICTION: [f64; 2] = [1e-4, 1e-5];

/// Approximate number of values that a fit stores per measured value, for the memory check.
const NUMBERS_OF_A_DATUM: usize = 100;

/// Unknowns.
struct Search {
    task: Identification<TreeDescription>,
    record: AngleRecord,
    /// End time of the part of the record that is fitted, in s.
    until: f64,
    window: f64,
}

/// Results.
struct Found {
    fit: Fit,
    failure: Option<String>,
    errors: AngleErrors,
}

impl Search {
    /// Fits short windows first, and then one motion over the whole record, starting from their
    /// result. Without a record of a motion, fits only the frequencies.
    fn find(&self) -> Result<Found, IdentificationError> {
        let fitted = self.record.between(f64::NEG_INFINITY, self.until);
        // Signals of Python end the computation by themselves.
        let observer = |_: &_| ControlFlow::Continue(());
        let found = self
            .task
            .fit_by_windows(&fitted, self.window, None, &observer)?;
        let failure = found.one_motion.as_ref().err().map(ToString::to_string);
        let driving = found.one_motion.as_ref().ok().and_then(driving);
        let errors = self.task.motion_errors(&found, &self.record)?;
        let errors = errors.unwrap_or_else(|| AngleErrors::missing(&self.record));
        // A chaotic motion is lost as one, and has its windows.
        let fit = match found.result() {
            Ok(fit) => fit.clone(),
            Err(unfound) => unfound.best.clone(),
        };
        Ok(Found {
            fit,
            failure: failure.or(driving),
            errors,
        })
    }
}

/// Returns a warning if a fit found negative friction, which adds energy; such a fit has no
/// standard deviations.
fn driving(fit: &Fit) -> Option<String> {
    let impossible = fit.driving_friction()?;
    Some(format!(
        "no fit with friction that brakes: {impossible}; the law of friction is not that of the real \
         pendulum; help: name the coefficient in `nonnegative`"
    ))
}

impl Found {
    fn result<'py>(&self, py: Python<'py>, tree: &Tree, until: f64) -> PyResult<Bound<'py, PyAny>> {
        let estimates = PyDict::new(py);
        for own in &self.fit.estimates {
            let standing = match &own.standing {
                Standing::Determined => "determined".to_owned(),
                Standing::GoesWith(others) => format!("goes with {}", others.join(", ")),
                Standing::Held => "held".to_owned(),
                Standing::AtBound => "at its bound".to_owned(),
            };
            let fields = [
                ("value", own.value.into_pyobject(py)?.into_any()),
                ("deviation", own.deviation().into_pyobject(py)?.into_any()),
                ("standing", standing.into_pyobject(py)?.into_any()),
            ];
            estimates.set_item(&own.name, result(py, "Estimate", &fields)?)?;
        }
        let names = tree.tree().description().parameters();
        let values = PyDict::new(py);
        for (name, value) in names.zip(self.fit.parameters()) {
            values.set_item(name, value)?;
        }
        let stages = PyList::empty(py);
        for stage in &self.fit.stages {
            stages.append((stage.segments, stage.length, stage.rms))?;
        }
        let frequencies = PyList::empty(py);
        for own in &self.fit.frequencies {
            frequencies.append(fitted(py, own)?)?;
        }
        let alternatives = PyList::empty(py);
        for values in &self.fit.alternatives {
            let other = PyDict::new(py);
            for (own, value) in self.fit.estimates.iter().zip(values) {
                other.set_item(&own.name, value)?;
            }
            alternatives.append(other)?;
        }
        let rms = |from: f64, until: f64| self.errors.rms_between(from, until);
        let rows = self.errors.rows.iter().flatten();
        let residuals = rows.map(|error| error.unwrap_or(f64::NAN)).collect();
        let shape = [self.errors.rows.len(), self.errors.links.len()];
        let words = self.fit.convergence.to_string();
        let number = |value: f64| value.into_pyobject(py).map(Bound::into_any);
        let fields = [
            ("estimates", estimates.into_any()),
            ("values", values.into_any()),
            ("rms", number(self.fit.rms())?),
            ("rms_fitted", number(rms(f64::NEG_INFINITY, until))?),
            ("rms_predicted", number(rms(until, f64::INFINITY))?),
            ("residuals", array(py, residuals, &shape)?),
            ("stages", stages.into_any()),
            ("frequencies", frequencies.into_any()),
            ("alternatives", alternatives.into_any()),
            ("convergence", words.into_pyobject(py)?.into_any()),
            (
                "failure",
                self.failure.clone().into_pyobject(py)?.into_any(),
            ),
        ];
        result(py, "Identification", &fields)
    }
}

fn fitted<'py>(py: Python<'py>, own: &FittedFrequency) -> PyResult<Bound<'py, PyAny>> {
    let number = |value: f64| value.into_pyobject(py).map(Bound::into_any);
    let fields = [
        ("mode", own.mode.into_pyobject(py)?.into_any()),
        ("hertz", number(own.hertz)?),
        ("deviation", number(own.deviation)?),
        ("fitted", number(own.fitted)?),
    ];
    result(py, "FittedFrequency", &fields)
}

/// A measured frequency: its value and standard error, optionally with the number of its mode.
pub(crate) struct MeasuredFrequency(Frequency);

impl Argument<'_, '_> for MeasuredFrequency {
    fn of(name: &str, object: &Bound<'_, PyAny>) -> PyResult<Self> {
        let wrong = || {
            let accepted = "a frequency with its standard error in Hz, (hertz, deviation), or with \
                            the number of its mode, (hertz, deviation, mode), 1 for the slowest";
            refused(name, accepted, object)
        };
        let numbers = Vec::<f64>::of(name, object).map_err(|_| wrong())?;
        let (hertz, deviation, mode) = match *numbers {
            [hertz, deviation] => (hertz, deviation, None),
            [hertz, deviation, mode] if mode >= 0.0 && mode.fract() == 0.0 => {
                (hertz, deviation, Some(mode as usize))
            }
            _ => return Err(wrong()),
        };
        Ok(Self(Frequency {
            hertz,
            deviation,
            mode,
        }))
    }
}

/// Names of the unknown parameters, optionally with values at which the search starts.
pub(crate) enum GuessesOrNames {
    Guesses(Entries<f64>),
    Names(Vec<String>),
}

impl Argument<'_, '_> for GuessesOrNames {
    fn of(name: &str, object: &Bound<'_, PyAny>) -> PyResult<Self> {
        match object.cast::<PyMapping>().is_ok() {
            true => Entries::of(name, object).map(Self::Guesses),
            false => Vec::of(name, object).map(Self::Names),
        }
    }
}

impl Tree {
    /// Converts times and measured angles of all links to a record for the fit.
    fn record(&self, t: &Numbers<'_>, theta: &Numbers<'_>) -> PyResult<AngleRecord> {
        let (times, angles) = (t.list("t")?, rows("theta", theta, t.shape())?);
        let names = self.tree().names();
        let columns = angles.first().map_or(0, Vec::len);
        if columns != names.len() {
            let links = names.len();
            let text = format!("theta has {columns} columns, must have {links}, one for each link");
            return Err(PyValueError::new_err(text));
        }
        refuse_jumps(&angles)?;
        need(
            "the fit",
            bytes(&[times.len(), columns], NUMBERS_OF_A_DATUM),
        )?;
        let links = names.iter().enumerate();
        Ok(
            links.fold(AngleRecord::new(&times), |record, (link, name)| {
                let column: Vec<Option<f64>> = angles.iter().map(|row| row[link]).collect();
                record.with_link(name, &column, 1.0)
            }),
        )
    }

    fn task(
        &self,
        unknown: GuessesOrNames,
        nonnegative: &[String],
    ) -> PyResult<Identification<TreeDescription>> {
        let tree = self.tree();
        let family = tree.description().clone();
        let missing = |name: &str| {
            let names = family.parameters().collect::<Vec<_>>().join(", ");
            PyKeyError::new_err(format!("there is no parameter `{name}`: there are {names}"))
        };
        let guesses: Vec<(String, f64)> = match unknown {
            GuessesOrNames::Guesses(Entries(guesses)) => guesses,
            GuessesOrNames::Names(names) => names
                .into_iter()
                .map(|name| {
                    let value = tree.value(&name).ok_or_else(|| missing(&name))?;
                    Ok((name, value))
                })
                .collect::<PyResult<_>>()?,
        };
        let mut given = guesses.iter().map(|(name, _)| name).chain(nonnegative);
        if let Some(name) = given.find(|name| tree.value(name).is_none()) {
            return Err(missing(name));
        }
        let mut task = Identification::new(family.clone());
        for name in family.parameters() {
            let guess = guesses.iter().find(|(own, _)| *own == name);
            task = match guess {
                Some((_, 0.0)) => {
                    let uses = tree.description().uses_of(name);
                    let quadratic = uses.contains(&ParameterUse::QuadraticFriction);
                    task.unknown_from_zero(name, FRICTION[usize::from(quadratic)])
                }
                Some((_, guess)) => task.unknown(name, *guess),
                None => task.known(name, tree.value(name).unwrap_or(f64::NAN)),
            };
        }
        Ok(nonnegative
            .iter()
            .fold(task, |task, name| task.at_least(name, 0.0)))
    }
}

fn unfit(error: IdentificationError) -> PyErr {
    PyValueError::new_err(error.to_string())
}

#[pymethods]
impl Tree {
    /// Finds parameters of the tree from its measured motion, from frequencies of small motions,
    /// or from both.
    ///
    /// Short windows are fitted first, then one motion over the whole record, starting from their
    /// result; if that fit fails, as for chaotic motions, the result of the windows is returned.
    /// The number of evaluations is bounded, in proportion to times and unknowns: a search that
    /// needs more ends with the best result so far and a `failure`. So does a search that ends at
    /// constants that are not physical; these have no standard deviations. Frequencies are weighted
    /// by their standard errors; angles, if both are given, by their residuals.
    ///
    /// Parameters
    /// ----------
    /// t : array, shape (m,)
    ///     Times (s), ascending. Without them frequencies alone are fitted.
    /// theta : array, shape (m, n)
    ///     Angles (rad from the downward vertical, without jumps), a column for each link; NaN
    ///     where they are missing. Angles that jump by more than half a turn are refused.
    /// unknown : list of str, or dict of guesses
    ///     Parameters that are looked for, from within some 30 % of their guesses or of the values
    ///     that the tree has; friction from 0. All others have the values of the tree.
    /// frequencies : list of (hertz, deviation) or (hertz, deviation, mode)
    ///     Measured frequencies of small motions without friction, their standard errors (Hz) and
    ///     the numbers of their modes: 1 is the slowest of those that oscillate. Without numbers
    ///     they are as many as these modes, in any order.
    /// until : float
    ///     Time (s) before which the motion is fitted; what follows is predicted. By default all.
    /// offsets : bool
    ///     True to find the zero of each link's angles too.
    /// nonnegative : list of str
    ///     Unknowns that are not to be below 0.
    /// window : float
    ///     Length of the windows, s.
    ///
    /// Returns
    /// -------
    /// Identification
    ///
    /// Examples
    /// --------
    /// >>> tree = bp.Tree('''gravity = 9.81,
    /// ...     rod: rod(mass = 0.2, length = l, friction = c)''', l=0.5, c=1e-3)
    /// >>> t = np.arange(0, 8, 0.01)
    /// >>> seen = tree.integrate([1.0, 0.0], t, rtol=1e-11).y[:, :1]
    /// >>> seen = seen + np.random.default_rng(1).normal(0, 1e-3, seen.shape)
    /// >>> found = tree.changed(l=0.45, c=0).identify(t, seen, ["l", "c"])
    /// >>> bool(abs(found.values["l"] - 0.5) < 1e-3), bool(abs(found.values["c"] - 1e-3) < 1e-4)
    /// (True, True)
    ///
    /// The moments of inertia of the paper's apparatus from its three frequencies:
    ///
    /// >>> text = bp.examples.PAPER.replace("1.88e-3", "i1").replace("0.516e-3", "i2")
    /// >>> tree = bp.Tree(text, i1=1e-3, i2=1e-3, friction=0)
    /// >>> measured = [(0.88, 0.005), (1.26, 0.005), (1.58, 0.005)]
    /// >>> found = tree.identify(unknown=["i1", "i2"], frequencies=measured)
    /// >>> i1, i2 = found.estimates["i1"], found.estimates["i2"]
    /// >>> f"({1e3 * i1.value:.2f} ± {1e3 * i1.deviation:.2f})e-3 kg m²"
    /// '(1.79 ± 0.23)e-3 kg m²'
    /// >>> f"({1e3 * i2.value:.3f} ± {1e3 * i2.deviation:.3f})e-3 kg m²"
    /// '(0.518 ± 0.005)e-3 kg m²'
    #[pyo3(signature = (t = None, theta = None, unknown = None, *, frequencies = Vec::new(), until = None, offsets = true, nonnegative = Vec::new(), window = 1.0))]
    #[allow(clippy::too_many_arguments)]
    fn identify<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::t)] t: Option<Numbers<'py>>,
        #[pyo3(from_py_with = named::theta)] theta: Option<Numbers<'py>>,
        #[pyo3(from_py_with = named::unknown)] unknown: Option<GuessesOrNames>,
        #[pyo3(from_py_with = named::frequencies)] frequencies: Vec<MeasuredFrequency>,
        #[pyo3(from_py_with = named::until)] until: Option<f64>,
        #[pyo3(from_py_with = named::offsets)] offsets: bool,
        #[pyo3(from_py_with = named::nonnegative)] nonnegative: Vec<String>,
        #[pyo3(from_py_with = named::window)] window: f64,
    ) -> PyResult<Bound<'py, PyAny>> {
        let unknown = unknown.ok_or_else(|| {
            PyTypeError::new_err("unknown is missing: name the parameters that are looked for")
        })?;
        let record = match (t, theta) {
            (Some(t), Some(theta)) => self.record(&t, &theta)?,
            (None, None) if frequencies.is_empty() => {
                let text = "neither a motion nor frequencies: give t and theta, or frequencies";
                return Err(PyValueError::new_err(text));
            }
            (None, None) if until.is_some() => {
                let text = "until is of a motion, and none is given: give t and theta, or no until";
                return Err(PyValueError::new_err(text));
            }
            (None, None) => AngleRecord::default(),
            _ => {
                let text = "t and theta are one motion: give both or none of them";
                return Err(PyValueError::new_err(text));
            }
        };
        let mut task = self.task(unknown, &nonnegative)?;
        if offsets {
            task = task.with_offsets();
        }
        for MeasuredFrequency(frequency) in frequencies {
            task = task.with_frequency(frequency);
        }
        let until = until.unwrap_or(f64::INFINITY);
        let search = Search {
            task,
            record,
            until,
            window,
        };
        let found = on_own_thread(py, move || search.find())?.map_err(unfit)?;
        found.result(py, self, until)
    }
}
