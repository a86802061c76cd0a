//! Parameters of a tree from its measured motion and frequencies: `Tree.identify`.

use branched_pendulum_measure::identification::{
    AngleErrors, AngleRecord, Fit, FittedFrequency, Frequency, Identification, IdentificationError,
    SearchFailure, Shooting, Standing, Unfound,
};
use branched_pendulum_trees::{ParameterUse, TreeDescription};
use pyo3::exceptions::{PyKeyError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::arrays::Numbers;
use crate::interrupts::on_own_thread;
use crate::memory::{bytes, need};
use crate::results::{array, result};
use crate::smoothing::rows;
use crate::tree::Tree;

/// Sizes of coefficients of friction that are searched for from 0: viscous and Coulomb friction
/// (N m s, N m), and quadratic (N m s²).
const FRICTION: [f64; 2] = [1e-4, 1e-5];

/// Numbers that a fit keeps of a datum, about.
const NUMBERS_OF_A_DATUM: usize = 100;

/// What is looked for.
struct Search {
    task: Identification<TreeDescription>,
    record: AngleRecord,
    /// The part that is fitted ends there, s.
    until: f64,
    window: f64,
}

/// What was found.
struct Found {
    fit: Fit,
    failure: Option<String>,
    errors: AngleErrors,
}

impl Search {
    /// Fits windows, then one motion that goes on from them; without a motion frequencies alone.
    fn find(&self) -> Result<Found, IdentificationError> {
        if self.record.times().is_empty() {
            return match self.task.fit_to_frequencies() {
                Err(IdentificationError::NotFound(unfound)) => {
                    self.found(unfound.best.clone(), Some(&unfound))
                }
                fit => self.found(fit?, None),
            };
        }
        let fitted = self.record.between(f64::NEG_INFINITY, self.until);
        let short = self.task.clone().with_shooting(Shooting {
            first: self.window,
            longest: self.window,
            ..Shooting::default()
        });
        let windows = match short.fit(&fitted) {
            Err(IdentificationError::NotFound(unfound))
                if matches!(unfound.failure, SearchFailure::Lost { .. }) =>
            {
                short.fit_in_segments(&fitted)
            }
            found => found,
        };
        let found = match windows {
            Ok(windows) => match self.task.fit_from(&windows, &fitted) {
                // A chaotic motion is lost as one, and has its windows.
                Err(IdentificationError::NotFound(unfound)) => Found {
                    errors: self.errors(&unfound.best)?,
                    failure: Some(unfound.to_string()),
                    fit: windows,
                },
                fit => self.found(fit?, None)?,
            },
            Err(IdentificationError::NotFound(unfound)) => {
                self.found(unfound.best.clone(), Some(&unfound))?
            }
            Err(error) => return Err(error),
        };
        Ok(found)
    }

    fn found(&self, fit: Fit, unfound: Option<&Unfound>) -> Result<Found, IdentificationError> {
        Ok(Found {
            errors: self.errors(&fit)?,
            failure: unfound.map(ToString::to_string),
            fit,
        })
    }

    /// Errors of one motion, to the end of the record; none of windows.
    fn errors(&self, fit: &Fit) -> Result<AngleErrors, IdentificationError> {
        match fit.starts.len() {
            1 => self.task.errors(fit, &self.record),
            _ => Ok(AngleErrors::default()),
        }
    }
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

/// A measured frequency: its value and its standard error, with the number of its mode or without.
pub(crate) struct MeasuredFrequency(Frequency);

impl<'a, 'py> FromPyObject<'a, 'py> for MeasuredFrequency {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let wrong = || {
            PyTypeError::new_err(format!(
                "{} is no frequency with its standard error (Hz): must be (hertz, deviation), or \
                 (hertz, deviation, mode) with the number of its mode, 1 for the slowest",
                object
                    .repr()
                    .map_or_else(|_| "it".to_owned(), |text| text.to_string())
            ))
        };
        let numbers: Vec<f64> = object.extract().map_err(|_| wrong())?;
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

/// Names of unknowns with the values from which they are searched.
#[derive(FromPyObject)]
pub(crate) enum GuessesOrNames {
    Guesses(std::collections::BTreeMap<String, f64>),
    Names(Vec<String>),
}

impl Tree {
    /// Angles of all links against time.
    fn record(&self, t: &Numbers<'_>, theta: &Numbers<'_>) -> PyResult<AngleRecord> {
        let (times, angles) = (t.list("t")?, rows("theta", theta, t.shape())?);
        let names = self.tree().names();
        let columns = angles.first().map_or(0, Vec::len);
        if columns != names.len() {
            let links = names.len();
            let text = format!("theta has {columns} columns, must have {links}, one for each link");
            return Err(PyValueError::new_err(text));
        }
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
            GuessesOrNames::Guesses(guesses) => guesses.into_iter().collect(),
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

fn refused(error: IdentificationError) -> PyErr {
    PyValueError::new_err(error.to_string())
}

#[pymethods]
impl Tree {
    /// Finds parameters of the tree from its measured motion, from frequencies of small motions,
    /// or from both.
    ///
    /// Windows are fitted first, then one motion that goes on from them; where that is lost, as
    /// chaotic ones are, the windows count. Frequencies weigh by their standard errors, and angles
    /// beside them by what is left over of them.
    ///
    /// Parameters
    /// ----------
    /// t : array, shape (m,)
    ///     Times (s), ascending. Without them frequencies alone are fitted.
    /// theta : array, shape (m, n)
    ///     Angles (rad from the downward vertical, without jumps), a column for each link; NaN
    ///     where they are missing.
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
        t: Option<Numbers<'py>>,
        theta: Option<Numbers<'py>>,
        unknown: Option<GuessesOrNames>,
        frequencies: Vec<MeasuredFrequency>,
        until: Option<f64>,
        offsets: bool,
        nonnegative: Vec<String>,
        window: f64,
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
        let found = on_own_thread(py, move || search.find())?.map_err(refused)?;
        found.result(py, self, until)
    }
}
