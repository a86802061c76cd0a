//! Observables: quantities that a description defines, and their rates.

use branched_pendulum::system::Model;
use pyo3::prelude::*;

use crate::arguments::named;
use crate::arrays::{Numbers, by_state};
use crate::sectors::given;
use crate::tree::{Tree, wrong};

#[pymethods]
impl Tree {
    /// Names of the observables that the description defines, `observe(name = ...)`.
    #[getter]
    fn observables(&self) -> Vec<String> {
        self.tree().observable_names().map(str::to_owned).collect()
    }

    /// Returns an observable.
    ///
    /// Parameters
    /// ----------
    /// name : str
    ///     One of `observables`.
    /// y : array, shape (..., 2 n)
    ///     States.
    ///
    /// Returns
    /// -------
    /// array, shape (...), or float
    ///     Values.
    ///
    /// Examples
    /// --------
    /// >>> rod = bp.Tree('''gravity = 9.81, rod: rod(mass = 1, length = 1),
    /// ...     observe(height = 1 - cos(theta_rod))''')
    /// >>> float(rod.observable("height", [np.pi, 0.0]))
    /// 2.0
    fn observable<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::name)] name: &str,
        #[pyo3(from_py_with = named::y)] y: Numbers<'py>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let observable = self.tree().observable(name);
        let observable = observable.map_err(|error| wrong(py, error))?;
        by_state(py, &y, 2 * self.tree().links(), |state| {
            [observable.value(given(state))]
        })
    }

    /// Returns the rate of change of an observable along the motion, and the part of it that
    /// friction and drag cause.
    ///
    /// Parameters
    /// ----------
    /// name : str
    ///     One of `observables`.
    /// y : array, shape (..., 2 n)
    ///     States.
    /// t : float
    ///     Time of the drive, s.
    ///
    /// Returns
    /// -------
    /// array, shape (..., 2)
    ///     The rate (1/s times the observable's unit), and friction's part of it.
    ///
    /// Examples
    /// --------
    /// >>> rod = bp.Tree('''gravity = 9.81, rod: rod(mass = 1, length = 1),
    /// ...     observe(height = 1 - cos(theta_rod))''')
    /// >>> rod.observable_rate("height", [np.pi / 2, 3.0])
    /// array([3., 0.])
    #[pyo3(signature = (name, y, t = 0.0))]
    fn observable_rate<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::name)] name: &str,
        #[pyo3(from_py_with = named::y)] y: Numbers<'py>,
        #[pyo3(from_py_with = named::t)] t: f64,
    ) -> PyResult<Bound<'py, PyAny>> {
        let observable = self.tree().observable(name);
        let observable = observable.map_err(|error| wrong(py, error))?;
        by_state(py, &y, 2 * self.tree().links(), |state| {
            let given = given(state);
            [observable.rate(t, given), observable.friction_rate(given)]
        })
    }
}
