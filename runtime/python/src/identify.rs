//! Parameters of a tree from its measured motion: `Tree.identify`.

use branched_pendulum_measure::identification::{
    AngleErrors, AngleRecord, Fit, Identification, IdentificationError, SearchFailure, Shooting,
    Standing, Unfound,
};
use branched_pendulum_trees::{ParameterUse, TreeDescription};
use pyo3::exceptions::{PyKeyError, PyValueError};
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
    /// Fits windows, then one motion that goes on from them.
    fn find(&self) -> Result<Found, IdentificationError> {
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
            ("convergence", words.into_pyobject(py)?.into_any()),
            (
                "failure",
                self.failure.clone().into_pyobject(py)?.into_any(),
            ),
        ];
        result(py, "Identification", &fields)
    }
}

/// Names of unknowns with the values from which they are searched.
#[derive(FromPyObject)]
pub(crate) enum GuessesOrNames {
    Guesses(std::collections::BTreeMap<String, f64>),
    Names(Vec<String>),
}

impl Tree {
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
    /// Finds parameters of the tree from its measured motion.
    ///
    /// Windows are fitted first, then one motion that goes on from them; where that is lost, as
    /// chaotic ones are, the windows count.
    ///
    /// Parameters
    /// ----------
    /// t : array, shape (m,)
    ///     Times (s), ascending.
    /// theta : array, shape (m, n)
    ///     Angles (rad from the downward vertical, without jumps), a column for each link; NaN
    ///     where they are missing.
    /// unknown : list of str, or dict of guesses
    ///     Parameters that are looked for, from within some 30 % of their guesses or of the values
    ///     that the tree has; friction from 0. All others have the values of the tree.
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
    #[pyo3(signature = (t, theta, unknown, *, until = None, offsets = true, nonnegative = Vec::new(), window = 1.0))]
    #[allow(clippy::too_many_arguments)]
    fn identify<'py>(
        &self,
        py: Python<'py>,
        t: Numbers<'py>,
        theta: Numbers<'py>,
        unknown: GuessesOrNames,
        until: Option<f64>,
        offsets: bool,
        nonnegative: Vec<String>,
        window: f64,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (times, angles) = (t.list("t")?, rows("theta", &theta, t.shape())?);
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
        let mut task = self.task(unknown, &nonnegative)?;
        if offsets {
            task = task.with_offsets();
        }
        let mut record = AngleRecord::new(&times);
        for (link, name) in names.iter().enumerate() {
            let column: Vec<Option<f64>> = angles.iter().map(|row| row[link]).collect();
            record = record.with_link(name, &column, 1.0);
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
