//! Energies by scale: the class `ScaleBudget`.

use branched_pendulum::Model;
use branched_pendulum::tree::MOST_GENERATIONS;
use branched_pendulum_trees::PendulumTree;
use numpy::{IntoPyArray, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arrays::{Numbers, axes_of_states};

/// Energies by scale, and what changes them: dE/dt of a scale is what it receives from the
/// others and the powers on it. Scale 0 is what all copies do together, scale s what those of
/// generation s do against each other; energies are those by Parseval, which sum to K + U.
///
/// Arrays have the axes of the states, then those of scales.
#[pyclass(frozen, module = "branched_pendulum")]
pub(crate) struct ScaleBudget {
    /// Energies, J.
    #[pyo3(get)]
    energies: Py<PyArrayDyn<f64>>,
    /// Transfers (W) between scales: `transfers[..., r, s]` is what scale r gives to scale s.
    #[pyo3(get)]
    transfers: Py<PyArrayDyn<f64>>,
    /// Power (W) of friction in the pivots on each scale; it may have either sign.
    #[pyo3(get)]
    friction: Py<PyArrayDyn<f64>>,
    /// Power (W) of drag on each scale.
    #[pyo3(get)]
    drag: Py<PyArrayDyn<f64>>,
    /// Power (W) of the drive on each scale.
    #[pyo3(get)]
    drive: Py<PyArrayDyn<f64>>,
}

#[pymethods]
impl ScaleBudget {
    fn __repr__(&self, py: Python<'_>) -> String {
        let scales = self.energies.bind(py).shape().last().copied();
        format!("ScaleBudget of {} scales", scales.unwrap_or_default())
    }
}

impl ScaleBudget {
    pub(crate) fn of(
        py: Python<'_>,
        tree: &PendulumTree,
        states: &Numbers<'_>,
        times: &[f64],
    ) -> PyResult<Self> {
        let links = tree.links();
        let Some(copies) = tree.copies() else {
            let text = "links of one generation differ: such a tree has no scales";
            return Err(PyValueError::new_err(text));
        };
        let scales = copies.len();
        if scales > MOST_GENERATIONS {
            let text = format!(
                "the tree has {scales} generations, scales are known of at most {MOST_GENERATIONS}"
            );
            return Err(PyValueError::new_err(text));
        }
        let shape = axes_of_states(states, 2 * links)?;
        let numbers = states.to_vec();
        let count = numbers.len() / (2 * links).max(1);
        if times.len() != 1 && times.len() != count {
            let text = format!("t has {} times for {count} states in y", times.len());
            return Err(PyValueError::new_err(text));
        }
        let budgets = py.detach(|| {
            let states = numbers
                .chunks_exact((2 * links).max(1))
                .zip(times.iter().cycle());
            let budgets = states.map(|(state, &time)| {
                let (theta, omega) = state.split_at(links);
                tree.budget_by_scale(time, [theta, omega, &[]])
            });
            budgets.collect::<Option<Vec<_>>>().unwrap_or_default()
        });
        let array = |values: Vec<f64>, axes: usize| -> PyResult<Py<PyArrayDyn<f64>>> {
            let shape = [&shape[..], &vec![scales; axes]].concat();
            Ok(values.into_pyarray(py).reshape(shape)?.unbind())
        };
        type Budget = branched_pendulum::ScaleBudget<f64>;
        let each = |of: fn(&Budget, usize) -> f64| {
            let rows = budgets
                .iter()
                .flat_map(|budget| (0..scales).map(move |s| of(budget, s)));
            array(rows.collect(), 1)
        };
        let transfers = budgets.iter().flat_map(|budget| {
            let pairs = (0..scales).flat_map(|from| (0..scales).map(move |to| (from, to)));
            pairs.map(|(from, to)| budget.transfer(from, to))
        });
        Ok(Self {
            energies: each(Budget::energy)?,
            transfers: array(transfers.collect(), 2)?,
            friction: each(Budget::friction_power)?,
            drag: each(Budget::drag_power)?,
            drive: each(Budget::drive_power)?,
        })
    }
}
