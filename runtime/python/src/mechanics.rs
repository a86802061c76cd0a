//! Mechanics of trees: accelerations, energies, momenta, matrices and positions.

use branched_pendulum::system::{Energy, LinkPoint, Model, Pendulum as _, Positions};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arguments::named;
use crate::arrays::{Numbers, Together, by_state};
use crate::budget::scale_budget;
use crate::memory::{bytes, need};
use crate::tree::Tree;

impl Tree {
    fn matrices<'py>(
        &self,
        py: Python<'py>,
        theta: &Numbers<'py>,
        of: impl Fn(&[f64]) -> Vec<Vec<f64>> + Send + Sync,
    ) -> PyResult<Bound<'py, PyAny>> {
        let n = self.tree().links();
        need("a matrix of all links", bytes(&[n, n], 2))?;
        let together = Together::of(&[("theta", theta, n)])?;
        together.each(py, &[n, n], |given, out| {
            for (row, values) in out.chunks_exact_mut(n.max(1)).zip(of(given[0])) {
                row.copy_from_slice(&values);
            }
        })
    }
}

#[pymethods]
impl Tree {
    /// Returns the angular accelerations.
    ///
    /// Parameters
    /// ----------
    /// theta, omega : array, shape (..., n)
    ///     Angles (rad) and angular velocities (rad/s).
    /// time : float
    ///     Time of the drive, s.
    /// torques : array, shape (..., n)
    ///     Torques (N m) from outside on each link.
    ///
    /// Returns
    /// -------
    /// array, shape (..., n)
    ///     Angular accelerations, rad/s².
    ///
    /// Examples
    /// --------
    /// >>> rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = 1)")
    /// >>> rod.accelerations([0.0], [0.0], torques=[1.0])
    /// array([3.])
    #[pyo3(signature = (theta, omega, time = 0.0, torques = None))]
    fn accelerations<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::theta)] theta: Numbers<'py>,
        #[pyo3(from_py_with = named::omega)] omega: Numbers<'py>,
        #[pyo3(from_py_with = named::time)] time: f64,
        #[pyo3(from_py_with = named::torques)] torques: Option<Numbers<'py>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (tree, n) = (self.tree(), self.tree().links());
        let states = [("theta", &theta, n), ("omega", &omega, n)];
        match &torques {
            None => Together::of(&states)?.each(py, &[n], |given, out| {
                tree.accelerations_into(time, given[0], given[1], out);
            }),
            Some(torques) => {
                let [theta, omega] = states;
                let all = Together::of(&[theta, omega, ("torques", torques, n)])?;
                all.each(py, &[n], |given, out| {
                    tree.accelerations_under_into(time, given[0], given[1], given[2], out);
                })
            }
        }
    }

    /// Returns the generalized torques of a given motion.
    ///
    /// Parameters
    /// ----------
    /// theta, omega, alpha : array, shape (..., n)
    ///     Angles (rad), angular velocities (rad/s) and angular accelerations (rad/s²).
    /// time : float, optional
    ///     Time of the drive (s).
    ///
    /// Returns
    /// -------
    /// array, shape (..., n)
    ///     Torques (N m) in addition to gravity, springs, friction and drive:
    ///     `accelerations` under these torques are `alpha`.
    ///
    /// Examples
    /// --------
    /// >>> rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = 1)")
    /// >>> rod.inverse_dynamics([0.0], [0.0], [3.0])
    /// array([1.])
    #[pyo3(signature = (theta, omega, alpha, time = 0.0))]
    fn inverse_dynamics<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::theta)] theta: Numbers<'py>,
        #[pyo3(from_py_with = named::omega)] omega: Numbers<'py>,
        #[pyo3(from_py_with = named::alpha)] alpha: Numbers<'py>,
        #[pyo3(from_py_with = named::time)] time: f64,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (tree, n) = (self.tree(), self.tree().links());
        let motion = [
            ("theta", &theta, n),
            ("omega", &omega, n),
            ("alpha", &alpha, n),
        ];
        Together::of(&motion)?.each(py, &[n], |given, out| {
            tree.inverse_dynamics_into(time, given[0], given[1], given[2], out);
        })
    }

    /// Returns the kinetic energy.
    ///
    /// Parameters
    /// ----------
    /// theta, omega : array, shape (..., n)
    ///     Angles (rad) and angular velocities (rad/s).
    ///
    /// Returns
    /// -------
    /// array, shape (...), or float
    ///     Kinetic energies (J), in the frame that moves with the root's pivot.
    ///
    /// Examples
    /// --------
    /// >>> rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = 1)")
    /// >>> float(rod.kinetic_energy([0.0], [3.0]))
    /// 1.5
    fn kinetic_energy<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::theta)] theta: Numbers<'py>,
        #[pyo3(from_py_with = named::omega)] omega: Numbers<'py>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (tree, n) = (self.tree(), self.tree().links());
        let together = Together::of(&[("theta", &theta, n), ("omega", &omega, n)])?;
        together.each(py, &[], |given, out| {
            out.fill(tree.kinetic_energy_of(given[0], given[1]));
        })
    }

    /// Returns the potential energy.
    ///
    /// Parameters
    /// ----------
    /// theta : array, shape (..., n)
    ///     Angles, rad.
    ///
    /// Returns
    /// -------
    /// array, shape (...), or float
    ///     Potential energies, J.
    ///
    /// Examples
    /// --------
    /// >>> rod = bp.Tree("gravity = 10, rod: rod(mass = 1, length = 1)")
    /// >>> float(rod.potential_energy([np.pi]) - rod.potential_energy([0.0]))
    /// 10.0
    fn potential_energy<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::theta)] theta: Numbers<'py>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let tree = self.tree();
        let together = Together::of(&[("theta", &theta, tree.links())])?;
        together.each(py, &[], |given, out| {
            out.fill(tree.potential_energy_of(given[0]));
        })
    }

    /// Returns the power of friction and drag.
    ///
    /// Parameters
    /// ----------
    /// y : array, shape (..., 2 n)
    ///     States.
    ///
    /// Returns
    /// -------
    /// array, shape (...), or float
    ///     Powers (W), never positive.
    ///
    /// Examples
    /// --------
    /// >>> rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = 1, friction = 0.1)")
    /// >>> float(rod.friction_power([0.0, 2.0]).round(12))
    /// -0.4
    fn friction_power<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::y)] y: Numbers<'py>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (tree, n) = (self.tree(), self.tree().links());
        by_state(py, &y, 2 * n, |state| {
            let (theta, omega) = state.split_at_checked(n).unwrap_or_default();
            [tree.friction_power(theta, omega)]
        })
    }

    /// Returns energies by scale, the energy transfers between scales, and the powers on each
    /// scale.
    ///
    /// Parameters
    /// ----------
    /// y : array, shape (..., 2 n)
    ///     States of a tree whose links of one generation are alike.
    /// t : float or array, shape (...)
    ///     Times (s) of the drive, whose axes go with those of the states: of states
    ///     `tree.ensemble(starts, t)` the times `t`.
    /// torques : array, shape (..., n)
    ///     Torques (N m) from outside on each link.
    ///
    /// Returns
    /// -------
    /// ScaleBudget
    ///     Arrays with the axes of the states, then those of scales; `budget.flux` and
    ///     `budget.losses` follow from them, and means along motions from `budget.averages()`.
    ///
    /// Examples
    /// --------
    /// >>> tree = bp.Tree('''gravity = 9.81,
    /// ...     tree: generations(count = 3, branching = 2, shape = rod, mass = 1, length = 1)''')
    /// >>> y = np.arange(14.0)
    /// >>> budget = tree.budget(y)
    /// >>> bool(np.isclose(budget.energies.sum(), tree.energy(y)))
    /// True
    #[pyo3(signature = (y, t = None, torques = None))]
    fn budget<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::y)] y: Numbers<'py>,
        #[pyo3(from_py_with = named::t)] t: Option<Numbers<'py>>,
        #[pyo3(from_py_with = named::torques)] torques: Option<Numbers<'py>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let times = t.map_or_else(|| Numbers::zero(py), Ok)?;
        scale_budget(py, self.tree(), &y, &times, torques.as_ref())
    }

    /// Returns the generalized momenta.
    ///
    /// Parameters
    /// ----------
    /// theta, omega : array, shape (..., n)
    ///     Angles (rad) and angular velocities (rad/s).
    ///
    /// Returns
    /// -------
    /// array, shape (..., n)
    ///     Momenta, kg m²/s.
    ///
    /// Examples
    /// --------
    /// >>> rod = bp.Tree("gravity = 9.81, rod: rod(mass = 3, length = 1)")
    /// >>> rod.momenta([0.0], [2.0])
    /// array([2.])
    fn momenta<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::theta)] theta: Numbers<'py>,
        #[pyo3(from_py_with = named::omega)] omega: Numbers<'py>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (tree, n) = (self.tree(), self.tree().links());
        let together = Together::of(&[("theta", &theta, n), ("omega", &omega, n)])?;
        together.each(py, &[n], |given, out| {
            out.copy_from_slice(&tree.momenta(given[0], given[1]));
        })
    }

    /// Returns mass matrices.
    ///
    /// Parameters
    /// ----------
    /// theta : array, shape (..., n)
    ///     Angles, rad.
    ///
    /// Returns
    /// -------
    /// array, shape (..., n, n)
    ///     Mass matrices, kg m².
    ///
    /// Examples
    /// --------
    /// >>> rod = bp.Tree("gravity = 9.81, rod: rod(mass = 3, length = 1)")
    /// >>> rod.mass_matrix([0.0])
    /// array([[1.]])
    fn mass_matrix<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::theta)] theta: Numbers<'py>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.matrices(py, &theta, |theta| self.tree().mass_matrix(theta))
    }

    /// Returns second derivatives of the potential energy.
    ///
    /// Parameters
    /// ----------
    /// theta : array, shape (..., n)
    ///     Angles, rad.
    ///
    /// Returns
    /// -------
    /// array, shape (..., n, n)
    ///     Stiffness matrices, N m/rad.
    ///
    /// Examples
    /// --------
    /// >>> rod = bp.Tree("gravity = 10, rod: rod(mass = 1, length = 1)")
    /// >>> rod.stiffness_matrix([0.0])
    /// array([[5.]])
    fn stiffness_matrix<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::theta)] theta: Numbers<'py>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.matrices(py, &theta, |theta| self.tree().stiffness_matrix(theta))
    }

    /// Returns positions of a point of each link.
    ///
    /// Parameters
    /// ----------
    /// theta : array, shape (..., n)
    ///     Angles, rad.
    /// point : {"end", "centre", "pivot"}
    ///     The point: where children hang, the centre of mass, or the pivot.
    ///
    /// Returns
    /// -------
    /// array, shape (..., n, 2)
    ///     Positions x, y (m) from the root's pivot; y is upwards, in trees that stand too.
    ///
    /// Examples
    /// --------
    /// >>> rod = bp.Tree("gravity = 10, rod: rod(mass = 1, length = 2)")
    /// >>> rod.points([[0.0], [np.pi / 2]]).round(12)[:, 0] + 0.0
    /// array([[ 0., -2.],
    ///        [ 2.,  0.]])
    #[pyo3(signature = (theta, point = "end"))]
    fn points<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::theta)] theta: Numbers<'py>,
        #[pyo3(from_py_with = named::point)] point: &str,
    ) -> PyResult<Bound<'py, PyAny>> {
        let point = match point {
            "pivot" => LinkPoint::Pivot,
            "centre" => LinkPoint::Centre,
            "end" => LinkPoint::End,
            _ => {
                let text = format!("point is {point:?}, must be \"pivot\", \"centre\" or \"end\"");
                return Err(PyValueError::new_err(text));
            }
        };
        let (tree, n) = (self.tree(), self.tree().links());
        let together = Together::of(&[("theta", &theta, n)])?;
        together.each(py, &[n, 2], |given, out| {
            for (place, point) in out.chunks_exact_mut(2).zip(tree.points(point, given[0])) {
                place.copy_from_slice(&point);
            }
        })
    }
}
