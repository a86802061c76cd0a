//! The class `Tree`.

use std::collections::BTreeMap;
use std::sync::Arc;

use branched_pendulum::system::{
    AbsoluteAngles, Energy, Forced, LinkPoint, Model, Pendulum as _, Positions,
};
use branched_pendulum_trees::{PendulumTree, TreeDescription, TreeError};
use numpy::IntoPyArray;
use pyo3::exceptions::{PyKeyError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::DescriptionError;
use crate::arrays::{Matrix, Number, Numbers, Row, Table, by_state, matrix};
use crate::budget::ScaleBudget;
use crate::motions::MeasuredModel;
use crate::pendulum::Pendulum;

/// A pendulum tree that a text describes:
/// `Tree("gravity = 9.81, rod: rod(mass = m, length = 1)", m=0.2)`.
///
/// The text is what stands between the parentheses of the attribute `branched_pendulum`; names
/// in it are parameters, in SI units. Mistakes raise `DescriptionError`, each marked in its line.
#[pyclass(frozen, extends = Pendulum, module = "branched_pendulum")]
pub(crate) struct Tree {
    system: Arc<AbsoluteAngles<PendulumTree>>,
}

impl MeasuredModel for PendulumTree {
    type Series<'a> = &'a AbsoluteAngles<Self>;

    fn series(system: &AbsoluteAngles<Self>) -> Self::Series<'_> {
        system
    }

    fn mass_rows(&self, theta: &[f64]) -> Vec<Vec<f64>> {
        self.mass_matrix(theta)
    }

    fn link_parents(&self) -> Vec<Option<usize>> {
        let links = 0..self.links();
        links
            .map(|link| self.properties_of(link)?.parent)
            .collect()
    }
}

fn wrong(py: Python<'_>, error: TreeError) -> PyErr {
    match error {
        TreeError::Description(error) => {
            let refused = DescriptionError::new_err(format!("\n{error}"));
            let mistakes = error.mistakes().iter();
            let mistakes = mistakes.map(|mistake| (mistake.line, mistake.column, &mistake.message));
            let told = refused
                .value(py)
                .setattr("mistakes", mistakes.collect::<Vec<_>>());
            told.err().unwrap_or(refused)
        }
        TreeError::UnknownParameter { .. } => PyKeyError::new_err(error.to_string()),
        _ => PyValueError::new_err(error.to_string()),
    }
}

/// Values of parameters by their names.
fn values(parameters: Option<Bound<'_, PyDict>>) -> PyResult<Vec<(String, f64)>> {
    let parameters = parameters.into_iter().flatten();
    let value = |(name, value): (Bound<'_, PyAny>, Bound<'_, PyAny>)| {
        let name: String = name.extract()?;
        let value = value.extract::<Number>().map_err(|error| {
            let reason = error.value(value.py());
            PyTypeError::new_err(format!("parameter `{name}`: {reason}"))
        })?;
        Ok((name, value.0))
    };
    parameters.map(value).collect()
}

fn class(tree: PendulumTree) -> PyClassInitializer<Tree> {
    let system = Arc::new(AbsoluteAngles(tree));
    let motions = system.clone();
    PyClassInitializer::from(Pendulum { motions }).add_subclass(Tree { system })
}

impl Tree {
    fn tree(&self) -> &PendulumTree {
        &self.system.0
    }

    /// Angles that were given, or zeros.
    fn angles(&self, theta: Option<Numbers<'_>>) -> PyResult<Vec<f64>> {
        let links = self.tree().links();
        match theta {
            Some(theta) => theta.row("theta", links),
            None => Ok(vec![0.0; links]),
        }
    }
}

#[pymethods]
impl Tree {
    #[new]
    #[pyo3(signature = (text, /, **parameters))]
    fn new(
        py: Python<'_>,
        text: &str,
        parameters: Option<Bound<'_, PyDict>>,
    ) -> PyResult<PyClassInitializer<Self>> {
        let parameters = values(parameters)?;
        let values: Vec<(&str, f64)> = parameters.iter().map(|(name, x)| (&**name, *x)).collect();
        let description = TreeDescription::parse(text).map_err(|error| wrong(py, error.into()))?;
        let tree = description.tree(&values);
        Ok(class(tree.map_err(|error| wrong(py, error))?))
    }

    /// Returns the tree with other values of parameters: `tree.changed(m=0.3)`.
    #[pyo3(signature = (**parameters))]
    fn changed(&self, py: Python<'_>, parameters: Option<Bound<'_, PyDict>>) -> PyResult<Py<Self>> {
        let mut tree = self.tree().clone();
        for (name, value) in values(parameters)? {
            tree = tree.with(&name, value).map_err(|error| wrong(py, error))?;
        }
        Py::new(py, class(tree))
    }

    /// Values of the parameters, in SI units.
    #[getter]
    fn parameters(&self) -> BTreeMap<String, f64> {
        let names = self.tree().description().parameters();
        names
            .filter_map(|name| Some((name.to_owned(), self.tree().value(name)?)))
            .collect()
    }

    fn __repr__(&self) -> String {
        format!("Tree of {}", self.tree().names().join(", "))
    }

    /// Returns the angular accelerations (rad/s²) at angles `theta` (rad) and angular velocities `omega`
    /// (rad/s), at a time of the drive, under torques (N m) from outside.
    #[pyo3(signature = (theta, omega, time = 0.0, torques = None))]
    fn accelerations<'py>(
        &self,
        py: Python<'py>,
        theta: Numbers<'py>,
        omega: Numbers<'py>,
        time: f64,
        torques: Option<Numbers<'py>>,
    ) -> PyResult<Row<'py>> {
        let n = self.tree().links();
        let (theta, omega) = (theta.row("theta", n)?, omega.row("omega", n)?);
        let mut alpha = vec![0.0; n];
        match torques {
            None => self
                .tree()
                .accelerations_into(time, &theta, &omega, &mut alpha),
            Some(torques) => {
                let torques = torques.row("torques", n)?;
                self.tree().accelerations_under_into(time, &theta, &omega, &torques, &mut alpha);
            }
        }
        Ok(alpha.into_pyarray(py))
    }

    /// Returns the kinetic energy (J) at angles `theta` (rad) and angular velocities `omega`
    /// (rad/s), in the frame that moves with the root's pivot.
    fn kinetic_energy(&self, theta: Numbers<'_>, omega: Numbers<'_>) -> PyResult<f64> {
        let n = self.tree().links();
        let (theta, omega) = (theta.row("theta", n)?, omega.row("omega", n)?);
        Ok(self.tree().kinetic_energy_of(&theta, &omega))
    }

    /// Returns the potential energy (J) at angles `theta` (rad).
    fn potential_energy(&self, theta: Numbers<'_>) -> PyResult<f64> {
        let theta = theta.row("theta", self.tree().links())?;
        Ok(self.tree().potential_energy_of(&theta))
    }

    /// Returns the power (W) of friction and drag, never positive, of each state of an array
    /// whose last axis is that of the components.
    fn friction_power<'py>(&self, py: Python<'py>, y: Numbers<'py>) -> PyResult<Table<'py>> {
        let n = self.tree().links();
        by_state(py, &y, 2 * n, |state| {
            [self.tree().friction_power(state.get(n..).unwrap_or_default())]
        })
    }

    /// Returns energies (J) by scale, transfers between scales and powers on them (W), of each
    /// state of an array whose last axis is that of the components; `t` are the times (s) of
    /// the drive, one for all states or one for each. Trees whose links of one generation
    /// differ have no scales, and those of trees of more than 34 generations are not known.
    #[pyo3(signature = (y, t = None))]
    fn budget(
        &self,
        py: Python<'_>,
        y: Numbers<'_>,
        t: Option<Numbers<'_>>,
    ) -> PyResult<ScaleBudget> {
        let times = match t {
            Some(times) => times.to_vec(),
            None => vec![0.0],
        };
        ScaleBudget::of(py, self.tree(), &y, &times)
    }

    /// Returns the generalized momenta (kg m²/s) at angles `theta` (rad) and angular
    /// velocities `omega` (rad/s).
    fn momenta<'py>(
        &self,
        py: Python<'py>,
        theta: Numbers<'py>,
        omega: Numbers<'py>,
    ) -> PyResult<Row<'py>> {
        let n = self.tree().links();
        let (theta, omega) = (theta.row("theta", n)?, omega.row("omega", n)?);
        Ok(self.tree().momenta(&theta, &omega).into_pyarray(py))
    }

    /// Returns the mass matrix (kg m²) at angles `theta` (rad).
    fn mass_matrix<'py>(&self, py: Python<'py>, theta: Numbers<'py>) -> PyResult<Matrix<'py>> {
        let theta = theta.row("theta", self.tree().links())?;
        matrix(py, self.tree().mass_matrix(&theta).concat(), theta.len())
    }

    /// Returns the second derivatives of the potential energy (N m/rad) at angles `theta` (rad).
    fn stiffness_matrix<'py>(&self, py: Python<'py>, theta: Numbers<'py>) -> PyResult<Matrix<'py>> {
        let theta = theta.row("theta", self.tree().links())?;
        matrix(py, self.tree().stiffness_matrix(&theta).concat(), theta.len())
    }

    /// Returns frequencies (Hz) and shapes of the linear modes, a row for each, about angles
    /// `theta` (rad) at which the tree is at rest: zeros, if none are given. ValueError where
    /// they are no equilibrium, with the torque there; `equilibrium` finds one near them.
    #[pyo3(signature = (theta = None))]
    fn modes<'py>(
        &self,
        py: Python<'py>,
        theta: Option<Numbers<'py>>,
    ) -> PyResult<(Row<'py>, Matrix<'py>)> {
        let n = self.tree().links();
        let theta = self.angles(theta)?;
        let modes = self.tree().modes(&theta);
        let modes = modes.map_err(|error| PyValueError::new_err(error.to_string()))?;
        let shapes = matrix(py, modes.shapes.concat(), n)?;
        Ok((modes.frequencies_hz.into_pyarray(py), shapes))
    }

    /// Returns the angles (rad) near `theta` at which the tree stays at rest, stable or not:
    /// near zeros, if none are given. The drive is left out.
    #[pyo3(signature = (theta = None))]
    fn equilibrium<'py>(&self, py: Python<'py>, theta: Option<Numbers<'py>>) -> PyResult<Row<'py>> {
        let found = self.tree().equilibrium(&self.angles(theta)?);
        let found = found.map_err(|error| PyValueError::new_err(error.to_string()))?;
        Ok(found.into_pyarray(py))
    }

    /// Returns the positions x, y (m) of a point of each link, `"pivot"`, `"centre"` or `"end"`,
    /// at angles `theta` (rad): y is upwards, from the root's pivot, in trees that stand too.
    #[pyo3(signature = (theta, point = "end"))]
    fn points<'py>(
        &self,
        py: Python<'py>,
        theta: Numbers<'py>,
        point: &str,
    ) -> PyResult<Matrix<'py>> {
        let point = match point {
            "pivot" => LinkPoint::Pivot,
            "centre" => LinkPoint::Centre,
            "end" => LinkPoint::End,
            _ => {
                let text = "points are `pivot`, `centre` and `end`";
                return Err(PyValueError::new_err(text));
            }
        };
        let theta = theta.row("theta", self.tree().links())?;
        matrix(py, self.tree().points(point, &theta).concat(), 2)
    }
}
