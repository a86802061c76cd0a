//! The class `Tree`.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;

use ::branched_pendulum::prelude::{Ode, State};
use ::branched_pendulum::system::{LinkPoint, Workspace};
use branched_pendulum_trees::{PendulumTree, TreeDescription, TreeError};
use numpy::{
    IntoPyArray, PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2,
};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;

use crate::method::{Method, Solution};
use crate::{DescriptionError, IntegrationError};

type Row<'py> = Bound<'py, PyArray1<f64>>;
type Matrix<'py> = Bound<'py, PyArray2<f64>>;
type Values<'py> = PyReadonlyArray1<'py, f64>;

/// A pendulum tree: `Tree("gravity = 9.81, rod: rod(mass = m, length = 1)", m=0.2)`.
///
/// The text is what stands between the parentheses of the attribute `branched_pendulum`.
#[pyclass(frozen, module = "branched_pendulum")]
pub(crate) struct Tree {
    tree: PendulumTree,
}

fn wrong(error: TreeError) -> PyErr {
    match error {
        TreeError::Description(error) => DescriptionError::new_err(format!("\n{error}")),
        TreeError::UnknownParameter { .. } => PyKeyError::new_err(error.to_string()),
        _ => PyValueError::new_err(error.to_string()),
    }
}

/// The numbers of an array, as many as are wanted.
fn numbers(name: &str, array: &Values<'_>, wanted: usize) -> PyResult<Vec<f64>> {
    let numbers = array.as_array().to_vec();
    match numbers.len() == wanted {
        true => Ok(numbers),
        false => Err(PyValueError::new_err(format!(
            "{name} has {} numbers, must have {wanted}",
            numbers.len()
        ))),
    }
}

fn matrix<'py>(py: Python<'py>, values: Vec<f64>, columns: usize) -> PyResult<Matrix<'py>> {
    let rows = values.len() / columns.max(1);
    values.into_pyarray(py).reshape([rows, columns])
}

#[pymethods]
impl Tree {
    #[new]
    #[pyo3(signature = (text, **parameters))]
    fn new(text: &str, parameters: Option<BTreeMap<String, f64>>) -> PyResult<Self> {
        let parameters = parameters.unwrap_or_default();
        let values: Vec<(&str, f64)> = parameters.iter().map(|(name, x)| (&**name, *x)).collect();
        let description = TreeDescription::parse(text).map_err(|error| wrong(error.into()))?;
        let tree = description.tree(&values).map_err(wrong)?;
        Ok(Self { tree })
    }

    /// The same tree with other values of parameters: `tree.changed(m=0.3)`.
    #[pyo3(signature = (**parameters))]
    fn changed(&self, parameters: Option<BTreeMap<String, f64>>) -> PyResult<Self> {
        let mut tree = self.tree.clone();
        for (name, value) in parameters.unwrap_or_default() {
            tree = tree.with(&name, value).map_err(wrong)?;
        }
        Ok(Self { tree })
    }

    /// Names of the links, in the order of the angles.
    #[getter]
    fn names(&self) -> Vec<String> {
        self.tree.names().to_vec()
    }

    /// Values of the parameters, in SI units.
    #[getter]
    fn parameters(&self) -> BTreeMap<String, f64> {
        let names = self.tree.description().parameters();
        names
            .filter_map(|name| Some((name.to_owned(), self.tree.value(name)?)))
            .collect()
    }

    fn __len__(&self) -> usize {
        self.tree.links()
    }

    fn __repr__(&self) -> String {
        format!("Tree of {}", self.tree.names().join(", "))
    }

    /// Angular accelerations (rad/s²) at angles `theta` (rad) and angular velocities `omega`
    /// (rad/s), at a time of the drive, under torques (N m) from outside.
    #[pyo3(signature = (theta, omega, time = 0.0, torques = None))]
    fn accelerations<'py>(
        &self,
        py: Python<'py>,
        theta: Values<'py>,
        omega: Values<'py>,
        time: f64,
        torques: Option<Values<'py>>,
    ) -> PyResult<Row<'py>> {
        let n = self.tree.links();
        let (theta, omega) = (numbers("theta", &theta, n)?, numbers("omega", &omega, n)?);
        let mut alpha = vec![0.0; n];
        let workspace = &mut Workspace::new();
        match torques {
            None => self
                .tree
                .accelerations_with(workspace, time, &theta, &omega, &mut alpha),
            Some(torques) => {
                let torques = numbers("torques", &torques, n)?;
                let given = [&theta[..], &omega, &torques];
                self.tree
                    .accelerations_under_with(workspace, time, given, &mut alpha);
            }
        }
        Ok(alpha.into_pyarray(py))
    }

    /// Rates of a state, as `scipy.integrate.solve_ivp` asks for them.
    fn rhs<'py>(&self, py: Python<'py>, t: f64, y: Values<'py>) -> PyResult<Row<'py>> {
        let state = numbers("y", &y, self.tree.dimension())?;
        let mut rates = vec![0.0; state.len()];
        self.tree.rates(t, &state, &mut rates);
        Ok(rates.into_pyarray(py))
    }

    /// Kinetic energy, J.
    fn kinetic_energy(&self, theta: Values<'_>, omega: Values<'_>) -> PyResult<f64> {
        let n = self.tree.links();
        let (theta, omega) = (numbers("theta", &theta, n)?, numbers("omega", &omega, n)?);
        Ok(self.tree.kinetic_energy(&theta, &omega))
    }

    /// Potential energy, J.
    fn potential_energy(&self, theta: Values<'_>) -> PyResult<f64> {
        let theta = numbers("theta", &theta, self.tree.links())?;
        Ok(self.tree.potential_energy(&theta))
    }

    /// Energy of each state of an array of them, or of one, J.
    fn energy<'py>(&self, py: Python<'py>, y: PyReadonlyArray2<'py, f64>) -> PyResult<Row<'py>> {
        let n = self.tree.links();
        let y = y.as_array();
        let energies = y.rows().into_iter().map(|row| {
            let state = row.to_vec();
            match state.split_at_checked(n) {
                Some((theta, omega)) if omega.len() == n => Ok(self.tree.energy(theta, omega)),
                _ => Err(PyValueError::new_err(format!(
                    "a state has {} numbers, must have {}",
                    state.len(),
                    2 * n
                ))),
            }
        });
        Ok(energies.collect::<PyResult<Vec<f64>>>()?.into_pyarray(py))
    }

    /// Generalized momenta, kg m²/s.
    fn momenta<'py>(
        &self,
        py: Python<'py>,
        theta: Values<'py>,
        omega: Values<'py>,
    ) -> PyResult<Row<'py>> {
        let n = self.tree.links();
        let (theta, omega) = (numbers("theta", &theta, n)?, numbers("omega", &omega, n)?);
        Ok(self.tree.momenta(&theta, &omega).into_pyarray(py))
    }

    /// Mass matrix, kg m².
    fn mass_matrix<'py>(&self, py: Python<'py>, theta: Values<'py>) -> PyResult<Matrix<'py>> {
        let theta = numbers("theta", &theta, self.tree.links())?;
        matrix(py, self.tree.mass_matrix(&theta).concat(), theta.len())
    }

    /// Second derivatives of the potential energy, N m/rad.
    fn stiffness_matrix<'py>(&self, py: Python<'py>, theta: Values<'py>) -> PyResult<Matrix<'py>> {
        let theta = numbers("theta", &theta, self.tree.links())?;
        matrix(py, self.tree.stiffness_matrix(&theta).concat(), theta.len())
    }

    /// Frequencies (Hz) and shapes of the linear modes, a row for each, about angles at which
    /// the tree is at rest: zeros, if none are given.
    #[pyo3(signature = (theta = None))]
    fn modes<'py>(
        &self,
        py: Python<'py>,
        theta: Option<Values<'py>>,
    ) -> PyResult<(Row<'py>, Matrix<'py>)> {
        let n = self.tree.links();
        let theta = match theta {
            Some(theta) => numbers("theta", &theta, n)?,
            None => vec![0.0; n],
        };
        let modes = self.tree.modes(&theta);
        let modes = modes.map_err(|error| PyValueError::new_err(error.to_string()))?;
        let shapes = matrix(py, modes.shapes.concat(), n)?;
        Ok((modes.frequencies_hz.into_pyarray(py), shapes))
    }

    /// Positions x, y (m) of a point of each link: `"pivot"`, `"centre"` or `"end"`.
    #[pyo3(signature = (theta, point = "end"))]
    fn points<'py>(
        &self,
        py: Python<'py>,
        theta: Values<'py>,
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
        let theta = numbers("theta", &theta, self.tree.links())?;
        matrix(py, self.tree.points(point, &theta).concat(), 2)
    }

    /// Follows the motion from the state `y0` at `t[0]`, at the times `t` (s), by `"dop853"`,
    /// `"dopri5"` or `"verner98"`. Other threads of Python run meanwhile.
    #[pyo3(signature = (y0, t, method = "dop853", rtol = 1e-9, atol = None))]
    fn integrate<'py>(
        &self,
        py: Python<'py>,
        y0: Values<'py>,
        t: Values<'py>,
        method: &str,
        rtol: f64,
        atol: Option<f64>,
    ) -> PyResult<Solution> {
        let method = Method::named(method, rtol, atol)?;
        let times = t.as_array().to_vec();
        let Some(&first) = times.first() else {
            return Err(PyValueError::new_err("t has no times"));
        };
        let values = numbers("y0", &y0, self.tree.dimension())?;
        let dimension = values.len();
        let start = State::new(first, values);
        let (states, report) = py.detach(|| method.sample(&self.tree, &start, &times))?;
        Ok(Solution {
            t: times.into_pyarray(py).unbind(),
            y: matrix(py, states, dimension)?.unbind(),
            report,
        })
    }

    /// Follows many motions, one from each row of `starts`, on all cores or as many threads as
    /// are given: states by start, time and component. NaN from where a motion could not be
    /// followed.
    #[pyo3(signature = (starts, t, method = "dop853", rtol = 1e-9, atol = None, threads = None))]
    #[allow(clippy::too_many_arguments)]
    fn ensemble<'py>(
        &self,
        py: Python<'py>,
        starts: PyReadonlyArray2<'py, f64>,
        t: Values<'py>,
        method: &str,
        rtol: f64,
        atol: Option<f64>,
        threads: Option<NonZeroUsize>,
    ) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let method = Method::named(method, rtol, atol)?;
        let times = t.as_array().to_vec();
        let (dimension, first) = (self.tree.dimension(), times.first().copied());
        let Some(first) = first else {
            return Err(PyValueError::new_err("t has no times"));
        };
        let starts = starts.as_array();
        if starts.ncols() != dimension {
            return Err(PyValueError::new_err(format!(
                "a start has {} numbers, must have {dimension}",
                starts.ncols()
            )));
        }
        let starts: Vec<State<f64>> = starts
            .rows()
            .into_iter()
            .map(|row| State::new(first, row.to_vec()))
            .collect();
        let samples = py.detach(|| method.sample_all(threads, &self.tree, &starts, &times));
        let length = dimension * times.len();
        let mut values = Vec::with_capacity(length * samples.len());
        for sample in &samples {
            let begin = values.len();
            sample
                .states()
                .for_each(|state| values.extend_from_slice(state));
            values.resize(begin + length, f64::NAN);
        }
        if let [Err(error)] = samples.iter().map(|s| s.end.as_ref()).collect::<Vec<_>>()[..] {
            return Err(IntegrationError::new_err(error.to_string()));
        }
        let shape = [samples.len(), times.len(), dimension];
        values.into_pyarray(py).reshape(shape)
    }
}
