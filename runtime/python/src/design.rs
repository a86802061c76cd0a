//! Parameters for given targets: `Tree.design`.

use std::slice;

use branched_pendulum::analysis::normal_form::NormalFormOptions;
use branched_pendulum::system::{Model, State};
use branched_pendulum_measure::design::{DesignTarget, DesignVariable, Goal};
use branched_pendulum_trees::{DesignSettings, TreeDesign};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arguments::{Argument, Entries, named, refused};
use crate::arrays::{Numbers, matrix, whole};
use crate::growth::copies;
use crate::interrupts::on_own_thread;
use crate::results::result;
use crate::tree::Tree;

/// A goal: a number, or a pair of which one is None.
struct Wanted(Goal);

impl<'py> Argument<'_, 'py> for Wanted {
    fn of(name: &str, object: &Bound<'py, PyAny>) -> PyResult<Self> {
        if let Ok(value) = object.extract::<f64>() {
            return Ok(Self(Goal::Equal(value)));
        }
        match object.extract::<(Option<f64>, Option<f64>)>() {
            Ok((Some(least), None)) => Ok(Self(Goal::AtLeast(least))),
            Ok((None, Some(most))) => Ok(Self(Goal::AtMost(most))),
            Ok((None, None) | (Some(_), Some(_))) | Err(_) => Err(refused(
                name,
                "a number, or a limit: (lowest, None) or (None, highest)",
                object,
            )),
        }
    }
}

#[pymethods]
impl Tree {
    /// Searches for parameters at which frequencies, the threshold and growth rates have given
    /// values.
    ///
    /// Thresholds and growth rates are by the normal form: nothing is simulated.
    ///
    /// Parameters
    /// ----------
    /// vary : dict of pairs
    ///     Lowest and highest value of each parameter that varies.
    /// targets : dict
    ///     Value of each quantity, or a limit: (lowest, None) or (None, highest). `mode_1`, ... are
    ///     the frequencies (Hz) of all modes, `f_1`, ... those of the modes in phase, `d_1`, ... (or
    ///     `f_d`) those of the difference, `threshold` the smallest angle (degrees) of the root's
    ///     release from which a difference grows, `growth` its rate (1/s) after the release `y0`.
    /// pair : two names
    ///     Links that are copies of each other, between which the difference is.
    /// y0 : array, shape (2 n,)
    ///     The release, copies in phase; by default all angles are zero. For the threshold the root's
    ///     angle takes the place of that in `y0`.
    /// degree : int
    ///     Degree of the normal form: 4, 6, 8, 10 or 12.
    /// least : float
    ///     Growth rate (1/s) from which on a difference counts as growing.
    ///
    /// Returns
    /// -------
    /// Design
    ///     With `tree`, `parameters`, `values`, `errors`, `slopes`, `others`, and `cause`: the reason
    ///     if no parameters within the bounds reach the targets.
    ///
    /// Examples
    /// --------
    /// >>> rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = l)", l=1.0)
    /// >>> found = rod.design({"l": (0.2, 2.0)}, {"mode_1": 1.0})
    /// >>> found.reached, round(found.parameters["l"], 4)
    /// (True, 0.3727)
    #[pyo3(signature = (vary, targets, pair = None, *, y0 = None, degree = 8, least = 0.02))]
    #[allow(clippy::too_many_arguments)]
    fn design<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::vary)] vary: Entries<[f64; 2]>,
        #[pyo3(from_py_with = named::targets)] targets: Entries<Wanted>,
        #[pyo3(from_py_with = named::pair)] pair: Option<Vec<String>>,
        #[pyo3(from_py_with = named::y0)] y0: Option<Numbers<'py>>,
        #[pyo3(from_py_with = named::degree)] degree: i128,
        #[pyo3(from_py_with = named::least)] least: f64,
    ) -> PyResult<Bound<'py, PyAny>> {
        let links = self.tree().links();
        let release = match y0 {
            Some(y0) => State::new(0.0, y0.row("y0", 2 * links)?),
            None => State::at_rest(0.0, &vec![0.0; links]),
        };
        let copies = match pair {
            Some(pair) => Some(copies(self.system(), &[pair], slice::from_ref(&release))?),
            None => None,
        };
        let settings = DesignSettings {
            release,
            least,
            form: NormalFormOptions {
                degree: whole("degree", degree, 4)?,
                ..NormalFormOptions::default()
            },
            ..DesignSettings::new(links, copies)
        };
        let variables = vary.0.into_iter();
        let variables = variables.map(|(name, range)| DesignVariable::new(name, range));
        let goals = targets.0.into_iter();
        let goals = goals.map(|(name, Wanted(goal))| DesignTarget::new(name, goal));
        let known = self.parameters();
        let known: Vec<(&str, f64)> = known.iter().map(|(name, own)| (&**name, *own)).collect();
        let design = TreeDesign::new(
            self.tree().description().clone(),
            &known,
            variables.collect(),
            goals.collect(),
            settings,
        );
        let design = design.map_err(|error| PyValueError::new_err(error.to_string()))?;
        let (design, found, values) = on_own_thread(py, move || {
            let found = design.run();
            let values = found.as_ref().map(|own| design.values(&own.parameters));
            let values = values.ok().and_then(Result::ok).unwrap_or_default();
            (design, found, values)
        })?;
        let found = found.map_err(|error| PyValueError::new_err(error.to_string()))?;
        let search = design.search();
        let by_name = |values: &[f64]| -> PyResult<Bound<'py, PyDict>> {
            let dict = PyDict::new(py);
            for (own, value) in search.variables().iter().zip(values) {
                dict.set_item(&own.name, value)?;
            }
            Ok(dict)
        };
        let (reached, errors) = (PyDict::new(py), PyDict::new(py));
        for (index, (own, value)) in search.targets().iter().zip(&found.values).enumerate() {
            reached.set_item(&own.name, value)?;
            let error = values.get(index).and_then(|computed| computed.error);
            errors.set_item(&own.name, error)?;
        }
        let others: Vec<Bound<'py, PyDict>> = found
            .others
            .iter()
            .map(|own| by_name(own))
            .collect::<PyResult<_>>()?;
        let parameters = by_name(&found.parameters)?;
        let tree = self.changed(py, Some(parameters.clone()))?;
        let cause = found.cause(search.variables());
        let slopes = matrix(py, found.sensitivities.concat(), search.variables().len())?;
        let fields = [
            ("tree", tree.into_bound(py).into_any()),
            ("parameters", parameters.into_any()),
            ("values", reached.into_any()),
            ("errors", errors.into_any()),
            ("slopes", slopes.into_any()),
            ("others", others.into_pyobject(py)?.into_any()),
            ("cause", cause.into_pyobject(py)?.into_any()),
        ];
        result(py, "Design", &fields)
    }
}
