//! Energies by scale: `Tree.budget`.

use branched_pendulum::Model;
use branched_pendulum::ScaleBudget;
use branched_pendulum::system::Workspace;
use branched_pendulum::tree::MOST_GENERATIONS;
use branched_pendulum_trees::PendulumTree;
use numpy::{IntoPyArray, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyEllipsis, PySlice};

use crate::arrays::{Numbers, ONE_EACH, Together};
use crate::results::result;

/// Names of the tables of a budget that have one number per scale.
const TABLES: [&str; 5] = ["energies", "friction", "drag", "drive", "outside"];

/// Writes a budget to `out`: first the tables, then the transfers from each scale.
fn write(budget: &ScaleBudget<f64>, out: &mut [f64]) {
    let scales = budget.scales();
    let of: [fn(&ScaleBudget<f64>, usize) -> f64; TABLES.len()] = [
        ScaleBudget::energy,
        ScaleBudget::friction_power,
        ScaleBudget::drag_power,
        ScaleBudget::drive_power,
        ScaleBudget::outside_power,
    ];
    let tables = of
        .iter()
        .flat_map(|of| (0..scales).map(|scale| of(budget, scale)));
    let pairs = (0..scales).flat_map(|from| (0..scales).map(move |to| (from, to)));
    let transfers = pairs.map(|(from, to)| budget.transfer(from, to));
    for (place, value) in out.iter_mut().zip(tables.chain(transfers)) {
        *place = value;
    }
}

/// Computes energy budgets for states, times and torques, whose axes are combined by NumPy's
/// broadcasting rules.
pub(crate) fn scale_budget<'py>(
    py: Python<'py>,
    tree: &PendulumTree,
    states: &Numbers<'py>,
    times: &Numbers<'py>,
    torques: Option<&Numbers<'py>>,
) -> PyResult<Bound<'py, PyAny>> {
    let links = tree.links();
    let Some(freedoms) = tree.degrees_of_freedom_by_scale() else {
        let mut springs = tree.description().springs_across_scales();
        return Err(PyValueError::new_err(match springs.next() {
            Some(what) => format!("the spring `{what}` belongs to no scale"),
            None => "links of one generation differ: such a tree has no scales".to_owned(),
        }));
    };
    let scales = freedoms.len();
    if tree.lineage().is_none() && scales > MOST_GENERATIONS {
        let text = format!(
            "the tree has {scales} generations, scales are known of at most {MOST_GENERATIONS}"
        );
        return Err(PyValueError::new_err(text));
    }
    let mut given = vec![("y", states, 2 * links), ("t", times, ONE_EACH)];
    given.extend(torques.map(|torques| ("torques", torques, links)));
    let (mut workspace, mut budget) = (Workspace::new(), ScaleBudget::new());
    let width = scales * (TABLES.len() + scales);
    let all = Together::of(&given)?.each(py, &[width], |given, out| {
        let (theta, omega) = given[0].split_at(links);
        let torques = given.get(2).copied().unwrap_or_default();
        let given_time = given[1].first().copied().unwrap_or(f64::NAN);
        tree.budget_by_scale_into(
            &mut workspace,
            given_time,
            [theta, omega, torques],
            &mut budget,
        );
        write(&budget, out);
    })?;
    let part = |begin: usize, end: usize| {
        let (begin, end) = (begin * scales, end * scales);
        let columns = PySlice::new(py, begin as isize, end as isize, 1);
        all.get_item((PyEllipsis::get(py), columns))?
            .call_method0("copy")
    };
    let mut fields = Vec::with_capacity(TABLES.len() + 2);
    for (number, name) in TABLES.into_iter().enumerate() {
        fields.push((name, part(number, number + 1)?));
    }
    let transfers = part(TABLES.len(), TABLES.len() + scales)?;
    let axes: Vec<usize> = transfers.getattr("shape")?.extract()?;
    let states = axes.get(..axes.len().saturating_sub(1)).unwrap_or_default();
    let shape = [states, &[scales, scales]].concat();
    fields.push(("transfers", transfers.call_method1("reshape", (shape,))?));
    let freedoms = freedoms.into_iter().map(|own| own as i64);
    let freedoms = freedoms.collect::<Vec<_>>().into_pyarray(py);
    fields.push(("freedoms", freedoms.reshape([scales])?.into_any()));
    result(py, "ScaleBudget", &fields)
}
