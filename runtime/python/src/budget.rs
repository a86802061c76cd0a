//! Energies by scale: `Tree.budget`.

use branched_pendulum::Model;
use branched_pendulum::interruption;
use branched_pendulum::tree::MOST_GENERATIONS;
use branched_pendulum_trees::PendulumTree;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arrays::{Numbers, axes_of_states};
use crate::interrupts::detached;
use crate::memory::{bytes, need};
use crate::results;

/// Budgets of states at times, one for all or one for each.
pub(crate) fn scale_budget<'py>(
    py: Python<'py>,
    tree: &PendulumTree,
    states: &Numbers<'py>,
    times: &[f64],
) -> PyResult<Bound<'py, PyAny>> {
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
    need("energies by scale", bytes(&[count, scales, scales], 2))?;
    let budgets = detached(py, || {
        let states = numbers
            .chunks_exact((2 * links).max(1))
            .zip(times.iter().cycle());
        let budgets = states.map(|(state, &time)| {
            interruption::look();
            let (theta, omega) = state.split_at(links);
            tree.budget_by_scale(time, [theta, omega, &[]])
        });
        budgets.collect::<Option<Vec<_>>>().unwrap_or_default()
    })?;
    let array = |values: Vec<f64>, axes: usize| {
        let shape = [&shape[..], &vec![scales; axes]].concat();
        results::array(py, values, &shape)
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
    let fields = [
        ("energies", each(Budget::energy)?),
        ("transfers", array(transfers.collect(), 2)?),
        ("friction", each(Budget::friction_power)?),
        ("drag", each(Budget::drag_power)?),
        ("drive", each(Budget::drive_power)?),
    ];
    results::result(py, "ScaleBudget", &fields)
}
