//! Equilibria of trees, and linear modes about them.

use branched_pendulum::analysis::{Equilibrium, Stability};
use branched_pendulum::system::Model;
use numpy::IntoPyArray;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arguments::named;
use crate::arrays::{Matrix, Numbers, Row, matrix};
use crate::interrupts::on_own_thread;
use crate::memory::{bytes, need};
use crate::results::result;
use crate::tree::Tree;

/// Number of copies of a matrix that the computation of eigenvectors needs, for the memory check.
const MATRICES: usize = 6;

impl Tree {
    /// Returns the given angles, or zeros if none are given.
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
    /// Returns the linear modes about an equilibrium.
    ///
    /// Parameters
    /// ----------
    /// theta : array, shape (n,)
    ///     Angles (rad) at which the tree is at rest: those of `equilibrium()`, if none are
    ///     given. `equilibria` lists others.
    ///
    /// Returns
    /// -------
    /// frequencies : array, shape (n,)
    ///     Frequencies (Hz), ascending.
    /// shapes : array, shape (n, n)
    ///     A row for each mode.
    ///
    /// Examples
    /// --------
    /// >>> frequencies, shapes = bp.Tree(bp.examples.PAPER, friction=0).modes()
    /// >>> frequencies.round(7)
    /// array([0.8731696, 1.2580584, 1.5825567])
    #[pyo3(signature = (theta = None))]
    fn modes<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::theta)] theta: Option<Numbers<'py>>,
    ) -> PyResult<(Row<'py>, Matrix<'py>)> {
        let n = self.tree().links();
        let theta = theta.map(|theta| theta.row("theta", n)).transpose()?;
        need("modes of all links", bytes(&[n, n], MATRICES))?;
        let tree = self.tree().clone();
        let modes = on_own_thread(py, move || {
            let theta = match theta {
                Some(theta) => theta,
                None => {
                    let rest = tree.stable_equilibrium(&vec![0.0; n]);
                    rest.map_err(|error| error.to_string())?.theta
                }
            };
            tree.modes(&theta).map_err(|error| error.to_string())
        })?;
        let modes = modes.map_err(PyValueError::new_err)?;
        let shapes = matrix(py, modes.shapes.concat(), n)?;
        Ok((modes.frequencies_hz.into_pyarray(py), shapes))
    }

    /// Returns equilibrium angles, at which the tree stays at rest; the drive is neglected.
    ///
    /// From `theta`, the search descends to a minimum of the potential energy; it leaves a saddle
    /// in a direction in which the energy falls. `equilibria` lists other equilibria.
    ///
    /// Parameters
    /// ----------
    /// theta : array, shape (n,)
    ///     Angles (rad) from which it descends: zeros, if none are given.
    /// stable : bool
    ///     False for the equilibrium next to `theta` by Newton's method, stable or not.
    ///
    /// Returns
    /// -------
    /// array, shape (n,)
    ///     Angles, rad.
    ///
    /// Examples
    /// --------
    /// >>> rod = bp.Tree("gravity = 10, rod: rod(mass = 1, length = 1)")
    /// >>> rod.equilibrium([3.0]).round(6) + 0.0
    /// array([0.])
    /// >>> rod.equilibrium([3.0], stable=False).round(6)
    /// array([3.141593])
    #[pyo3(signature = (theta = None, *, stable = true))]
    fn equilibrium<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::theta)] theta: Option<Numbers<'py>>,
        #[pyo3(from_py_with = named::stable)] stable: bool,
    ) -> PyResult<Row<'py>> {
        let (tree, theta) = (self.tree().clone(), self.angles(theta)?);
        need("stiffness of all links", bytes(&[theta.len(); 2], MATRICES))?;
        let found = on_own_thread(py, move || match stable {
            true => tree.stable_equilibrium(&theta).map(|own| own.theta),
            false => tree.equilibrium(&theta),
        })?;
        let found = found.map_err(|error| PyValueError::new_err(error.to_string()))?;
        Ok(found.into_pyarray(py))
    }

    /// Returns the equilibria that a search finds; the drive is neglected.
    ///
    /// First comes the stable equilibrium to which the search descends from zero angles, then other
    /// stable ones by ascending energy, and last the unstable one near zero angles, if there is
    /// one. For trees of at most 32 links, the search also descends from 16 to 64 other starts;
    /// stable equilibria that few starts lead to may be missed.
    ///
    /// Returns
    /// -------
    /// list of Equilibrium
    ///     Angles `theta` (rad), `energy` (J) and `stability`: "stable", "unstable" or "neutral".
    ///
    /// Examples
    /// --------
    /// A standing rod that its spring does not hold upright:
    ///
    /// >>> rod = bp.Tree("gravity = -9.81, r: rod(mass = 0.4, length = 0.5, spring = 0.9)")
    /// >>> [(own.theta.round(4).tolist(), own.stability) for own in rod.equilibria()]
    /// [([0.7129], 'stable'), ([-0.7129], 'stable'), ([0.0], 'unstable')]
    fn equilibria<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let (tree, n) = (self.tree().clone(), self.tree().links());
        need("stiffness of all links", bytes(&[n, n], MATRICES))?;
        let found = on_own_thread(py, move || tree.equilibria())?;
        let found = found.map_err(|error| PyValueError::new_err(error.to_string()))?;
        let one = |own: Equilibrium| {
            let stability = match own.stability {
                Stability::Stable => "stable",
                Stability::Unstable => "unstable",
                Stability::Neutral => "neutral",
            };
            let fields = [
                ("theta", own.theta.into_pyarray(py).into_any()),
                ("energy", own.energy.into_pyobject(py)?.into_any()),
                ("stability", stability.into_pyobject(py)?.into_any()),
            ];
            result(py, "Equilibrium", &fields)
        };
        found.into_iter().map(one).collect()
    }
}
