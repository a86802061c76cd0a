//! Methods by name, and what they leave.

use std::num::NonZeroUsize;

use ::branched_pendulum::ensemble::{Ensemble, Samples};
use ::branched_pendulum::integrate::{Report, Tolerance};
use ::branched_pendulum::prelude::{Dop853, Dopri5, Options, State, Verner98};
use branched_pendulum_trees::PendulumTree;
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::IntegrationError;

/// A method with step-size control.
#[derive(Clone)]
pub(crate) enum Method {
    Dop853(Dop853<f64>),
    Dopri5(Dopri5<f64>),
    Verner98(Verner98<f64>),
}

/// States of a motion at the times asked for, one after the other, and its account.
pub(crate) type Motion = (Vec<f64>, Report<f64>);

impl Method {
    pub(crate) fn named(name: &str, rtol: f64, atol: Option<f64>) -> PyResult<Self> {
        let mut options = Options::with_tolerance(rtol);
        if let Some(atol) = atol {
            options.absolute = Tolerance::Uniform(atol);
        }
        Ok(match name.to_ascii_lowercase().as_str() {
            "dop853" => Self::Dop853(Dop853::new(options)),
            "dopri5" => Self::Dopri5(Dopri5::new(options)),
            "verner98" => Self::Verner98(Verner98::new(options)),
            _ => {
                let known = "`dop853`, `dopri5`, `verner98`";
                return Err(PyValueError::new_err(format!(
                    "unknown method `{name}`: there are {known}"
                )));
            }
        })
    }

    pub(crate) fn sample(
        &self,
        tree: &PendulumTree,
        start: &State<f64>,
        times: &[f64],
    ) -> PyResult<Motion> {
        let mut values = Vec::with_capacity(times.len() * start.values.len());
        let visit = |_: f64, state: &[f64]| values.extend_from_slice(state);
        let solution = match self {
            Self::Dop853(method) => method.sample(tree, start, times, visit),
            Self::Dopri5(method) => method.sample(tree, start, times, visit),
            Self::Verner98(method) => method.sample(tree, start, times, visit),
        };
        let solution = solution.map_err(|error| IntegrationError::new_err(error.to_string()))?;
        Ok((values, solution.report))
    }

    /// Samples of many motions, several in the lanes of a register on each thread.
    pub(crate) fn sample_all(
        &self,
        threads: Option<NonZeroUsize>,
        tree: &PendulumTree,
        starts: &[State<f64>],
        times: &[f64],
    ) -> Vec<Samples<f64>> {
        let ensemble = match threads {
            Some(threads) => Ensemble::new().threads(threads),
            None => Ensemble::new(),
        };
        match self {
            Self::Dop853(method) => ensemble.sample_in_lanes(method, tree, starts, times),
            Self::Dopri5(method) => ensemble.sample_in_lanes(method, tree, starts, times),
            Self::Verner98(method) => ensemble.sample_in_lanes(method, tree, starts, times),
        }
    }
}

/// A motion at the times asked for.
#[pyclass(frozen, module = "branched_pendulum")]
pub(crate) struct Solution {
    /// Times, s.
    #[pyo3(get)]
    pub(crate) t: Py<PyArray1<f64>>,
    /// States, a row for each time: angles (rad), angular velocities (rad/s).
    #[pyo3(get)]
    pub(crate) y: Py<PyArray2<f64>>,
    pub(crate) report: Report<f64>,
}

#[pymethods]
impl Solution {
    /// The account of the run, in words.
    #[getter]
    fn report(&self) -> String {
        self.report.to_string()
    }

    /// Accepted steps.
    #[getter]
    fn steps(&self) -> u64 {
        self.report.accepted
    }

    /// Evaluations of the accelerations.
    #[getter]
    fn evaluations(&self) -> u64 {
        self.report.evaluations
    }

    fn __repr__(&self) -> String {
        format!("Solution({})", self.report)
    }
}
