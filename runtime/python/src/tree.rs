//! The class `Tree`.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::{Arc, OnceLock};

use branched_pendulum::ensemble::{Ensemble, Samples};
use branched_pendulum::integrate::Taylor;
use branched_pendulum::system::{AbsoluteAngles, Model, Positions};
use branched_pendulum::transfer::SymmetricTree;
use branched_pendulum_trees::{PendulumTree, TreeDescription, TreeError};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::DescriptionError;
use crate::arguments::{Argument, named};
use crate::measured_model::{MeasuredModel, Releases};
use crate::pendulum::Pendulum;

/// Links whose names are shown.
const MOST_NAMES: usize = 8;

/// A pendulum tree that is described by a text.
///
/// The text is `gravity = ...` and one root link with its children, with commas between them;
/// `//` begins a comment. Values are numbers in SI units, names, and what `+ - * / ^` make of
/// them. Names are parameters: `Tree(text, m=0.2)`. Where gravity is written as negative the tree
/// stands, and angles are those from the upward vertical.
///
/// ============================  ======================================================
/// `arm(mass = ..., ...)`        a link: `mass` (kg), `com` (m, centre of mass from the pivot),
///                               `inertia` (kg m², about the centre of mass), `joint` (m,
///                               where children hang)
/// `arm: rod(mass, length)`      a body by its shape: `point`, `rod`, `rod_with_bob`,
///                               `cylinder`, `plate`, `disc`, `ring`, `ball`, `shell`
/// `arm(...) [a(...), b(...)]`   children in brackets; `at` (m) is where a child hangs
///                               instead of its parent's `joint`
/// `child(...) * 2`              two copies, `child_1` and `child_2`, with all below them;
///                               `mass = each(0.1, 0.11)` has a value for each
/// `tree: generations(...)`      all generations by a rule: `count`, `branching`, `shape`, what
///                               the shape takes, and ratios from one generation to the next,
///                               `mass_ratio`, `length_ratio`, `friction_ratio`
/// `friction = c`                viscous friction in the pivot, N m s
/// `friction(viscous = c,        and Coulomb friction (N m), quadratic friction (N m s²),
/// coulomb = ..., ...)`          smooth below the rate `width` (rad/s); `static` friction (N m)
///                               falls to Coulomb friction past the rate `stribeck` (rad/s)
/// `drag = c`, `drag(...)`       the same against the ground
/// `spring = k, rest = r`        a spring in the pivot, N m/rad, at rest at r (rad)
/// `between(a, b, spring = k,    a spring and friction on the difference of two links' angles;
/// friction = c)`                `siblings(child, ...)` between all copies of a node under one link
/// `between(a, b, at = p, ...)`  the same along the line between points of the links: `spring`
///                               (N/m), `rest` (m), `friction` (N s/m), or a `repulsion` A (J mⁿ)
///                               with its `exponent` n; `guy(a, at = p, to = (x, y), ...)` to a
///                               peg, `siblings(child, at = p, ...)` between copies
/// `in_phase(child)`             copies that move alike, as one link; `locked(arm, 0.3)` a link
///                               that does not turn against its parent, at that angle (rad)
/// `drive(y = a * cos(w * t))`   motion of the root's pivot, `x` and `y` (m), or a `torque`
///                               (N m) on the root, as functions of the time `t` (s)
/// ============================  ======================================================
///
/// A page with pictures of all of it is docs/tutorials/python.md; `branched_pendulum.examples`
/// has trees under names. Mistakes raise `DescriptionError`, all at once, each marked in its line.
///
/// Parameters
/// ----------
/// text : str
///     The description.
/// **parameters : float
///     Values of the names in it.
///
/// Examples
/// --------
/// >>> tree = bp.Tree('''
/// ...     gravity = 9.81,
/// ...     arm: rod(mass = 0.2, length = 0.5, friction = 1e-4) [
/// ...         hand: rod(mass = m, length = 0.3) * 2,
/// ...     ]
/// ... ''', m=0.1)
/// >>> tree.names, tree.parameters
/// (['arm', 'hand_1', 'hand_2'], {'m': 0.1})
#[pyclass(frozen, extends = Pendulum, module = "branched_pendulum")]
pub(crate) struct Tree {
    system: Arc<AbsoluteAngles<PendulumTree>>,
    text: Arc<str>,
    /// Symmetric form of the tree, computed at its first use.
    symmetric: OnceLock<SymmetricTree<f64>>,
}

impl MeasuredModel for PendulumTree {
    type Series<'a> = &'a AbsoluteAngles<Self>;

    fn series(system: &AbsoluteAngles<Self>) -> Self::Series<'_> {
        system
    }

    fn mass_rows(&self, theta: &[f64]) -> Vec<Vec<f64>> {
        self.mass_matrix(theta)
    }

    fn as_tree(&self) -> Result<Cow<'_, Self>, TreeError> {
        Ok(Cow::Borrowed(self))
    }

    fn with_values(&self, values: &[(&str, f64)]) -> Result<Self, String> {
        let changed = values
            .iter()
            .try_fold(self.clone(), |tree, (name, value)| tree.with(name, *value));
        changed.map_err(|error| error.to_string())
    }

    fn series_ensemble(
        method: &Taylor<f64>,
        releases: Releases<'_, Self>,
        ensemble: &Ensemble<'_>,
        times: &[f64],
    ) -> Option<Vec<Samples<f64>>> {
        Some(releases.sample(method, ensemble, times))
    }

    fn link_parents(&self) -> Vec<Option<usize>> {
        let links = 0..self.links();
        links.map(|link| self.properties_of(link)?.parent).collect()
    }
}

pub(crate) fn wrong(py: Python<'_>, error: TreeError) -> PyErr {
    match error {
        TreeError::Description(error) => {
            let refused = DescriptionError::new_err(format!("\n{error}"));
            let mistakes = error.mistakes().iter();
            let mistakes = mistakes.map(|mistake| (mistake.line, mistake.column, &mistake.message));
            let reported = refused
                .value(py)
                .setattr("mistakes", mistakes.collect::<Vec<_>>());
            reported.err().unwrap_or(refused)
        }
        TreeError::UnknownParameter { .. } => PyKeyError::new_err(error.to_string()),
        _ => PyValueError::new_err(error.to_string()),
    }
}

/// Converts parameters from Python to names and values.
fn values(parameters: Option<Bound<'_, PyDict>>) -> PyResult<Vec<(String, f64)>> {
    let parameters = parameters.into_iter().flatten();
    let value = |(name, value): (Bound<'_, PyAny>, Bound<'_, PyAny>)| {
        let name: String = name.extract()?;
        let value = f64::of(&format!("parameter `{name}`"), &value)?;
        Ok((name, value))
    };
    parameters.map(value).collect()
}

fn class(tree: PendulumTree, text: Arc<str>) -> PyClassInitializer<Tree> {
    let system = Arc::new(AbsoluteAngles(tree));
    let motions = system.clone();
    PyClassInitializer::from(Pendulum { motions }).add_subclass(Tree {
        system,
        text,
        symmetric: OnceLock::new(),
    })
}

impl Tree {
    /// Returns the system of equations of the tree.
    pub(crate) fn system(&self) -> &AbsoluteAngles<PendulumTree> {
        &self.system
    }

    pub(crate) fn tree(&self) -> &PendulumTree {
        &self.system.0
    }

    /// Returns the tree in its symmetric coordinates.
    ///
    /// # Errors
    /// ValueError if the tree has no copies.
    pub(crate) fn symmetric(&self, py: Python<'_>) -> PyResult<&SymmetricTree<f64>> {
        if let Some(known) = self.symmetric.get() {
            return Ok(known);
        }
        let tree = self.tree().symmetric();
        let tree = tree.map_err(|error| wrong(py, error))?;
        Ok(self.symmetric.get_or_init(|| tree))
    }
}

#[pymethods]
impl Tree {
    #[new]
    #[pyo3(signature = (text, /, **parameters))]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = named::text)] text: &str,
        parameters: Option<Bound<'_, PyDict>>,
    ) -> PyResult<PyClassInitializer<Self>> {
        let parameters = values(parameters)?;
        let values: Vec<(&str, f64)> = parameters.iter().map(|(name, x)| (&**name, *x)).collect();
        let description = TreeDescription::parse(text).map_err(|error| wrong(py, error.into()))?;
        let tree = description.tree(&values);
        Ok(class(tree.map_err(|error| wrong(py, error))?, text.into()))
    }

    /// Returns the same tree with other values of some parameters.
    ///
    /// Parameters
    /// ----------
    /// **parameters : float
    ///     Values by name, in SI units.
    ///
    /// Returns
    /// -------
    /// Tree
    ///
    /// Examples
    /// --------
    /// >>> tree = bp.Tree("gravity = 9.81, rod: rod(mass = m, length = 1)", m=0.2)
    /// >>> tree.changed(m=0.3).parameters
    /// {'m': 0.3}
    #[pyo3(signature = (**parameters))]
    pub(crate) fn changed(
        &self,
        py: Python<'_>,
        parameters: Option<Bound<'_, PyDict>>,
    ) -> PyResult<Py<Self>> {
        let mut tree = self.tree().clone();
        for (name, value) in values(parameters)? {
            tree = tree.with(&name, value).map_err(|error| wrong(py, error))?;
        }
        Py::new(py, class(tree, self.text.clone()))
    }

    /// The description.
    #[getter]
    fn text(&self) -> &str {
        &self.text
    }

    /// Values of the parameters by name, in SI units.
    #[getter]
    pub(crate) fn parameters(&self) -> BTreeMap<String, f64> {
        let names = self.tree().description().parameters();
        names
            .filter_map(|name| Some((name.to_owned(), self.tree().value(name)?)))
            .collect()
    }

    /// Index of each link's parent; None for the root.
    #[getter]
    fn parents(&self) -> Vec<Option<usize>> {
        self.tree().link_parents()
    }

    /// Draws the tree.
    ///
    /// Parameters
    /// ----------
    /// theta : array, shape (n,)
    ///     Angles (rad); without them children are spread out.
    ///
    /// Returns
    /// -------
    /// Picture
    ///     Shown by notebooks; `picture.svg` is its text, `picture.save("tree.svg")` writes it.
    ///
    /// Examples
    /// --------
    /// >>> bp.Tree(bp.examples.BRANCH).draw()
    /// Picture of 31 links
    #[pyo3(signature = (theta = None))]
    fn draw<'py>(
        slf: &Bound<'py, Self>,
        theta: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let module = slf.py().import("branched_pendulum._drawing")?;
        module.call_method1("draw", (slf, theta))
    }

    fn __repr__(&self) -> String {
        let names = self.tree().names();
        match names {
            [first, second, .., last] if names.len() > MOST_NAMES => {
                format!(
                    "Tree of {} links: {first}, {second}, …, {last}",
                    names.len()
                )
            }
            _ => format!("Tree of {}", names.join(", ")),
        }
    }

    /// Compares two trees; they are equal if they have the same text and the same values.
    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        let bits =
            |tree: &Self| -> Vec<u64> { tree.parameters().values().map(|x| x.to_bits()).collect() };
        let other = other.cast::<Self>();
        other.is_ok_and(|other| {
            let other = other.get();
            self.text == other.text && bits(self) == bits(other)
        })
    }

    fn __hash__(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        self.text.hash(&mut hasher);
        let values = self.parameters();
        values.values().for_each(|x| x.to_bits().hash(&mut hasher));
        hasher.finish()
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let make = py
            .import("branched_pendulum._results")?
            .getattr("make_tree")?;
        let given = (&*self.text, self.parameters());
        Ok((make, given).into_pyobject(py)?.into_any())
    }
}
