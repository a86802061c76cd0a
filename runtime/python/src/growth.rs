//! Growth of small differences: `Pendulum.growth`.

use branched_pendulum::analysis::growth::{Checked, Grown, Growth, GrowthError};
use branched_pendulum::analysis::variational::Copies;
use branched_pendulum::ensemble::Ensemble;
use branched_pendulum::system::{Ode, State};
use branched_pendulum_trees::DifferenceGrowth;
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;

use crate::failures::Failures;
use crate::interrupts::detached;
use crate::memory::{bytes, need};
use crate::motions::Motions;
use crate::results::{array, result};

/// Returns the sets of links that are copies and in phase at all starts, given the names of the
/// links.
pub(crate) fn copies(
    motions: &dyn Motions,
    alike: &[Vec<String>],
    starts: &[State<f64>],
) -> PyResult<Copies> {
    let names = motions.names();
    let place = |name: &String| {
        let found = names.iter().position(|own| own == name);
        found.ok_or_else(|| PyKeyError::new_err(format!("there is no link `{name}`")))
    };
    let of = |set: &Vec<String>| -> PyResult<Vec<usize>> { set.iter().map(place).collect() };
    let places: Vec<Vec<usize>> = alike.iter().map(of).collect::<PyResult<_>>()?;
    let sets: Vec<&[usize]> = places.iter().map(Vec::as_slice).collect();
    let copies = motions.copies(&sets, starts);
    copies.ok_or_else(|| no_copies(alike))
}

fn no_copies(alike: &[Vec<String>]) -> PyErr {
    let sets = alike.iter();
    let sets: Vec<String> = sets
        .map(|set| format!("`{}`", set.join("` and `")))
        .collect();
    let text = format!(
        "{} are not copies that start in phase: links that differ by `each(…)` have no motion in phase, \
         and copies need equal angles and velocities at every start",
        sets.join(" or ")
    );
    PyValueError::new_err(text)
}

/// Growth that is asked for.
pub(crate) struct GrowthTask {
    pub(crate) starts: Vec<State<f64>>,
    pub(crate) horizons: Vec<f64>,
    pub(crate) frequency_hz: Option<f64>,
    pub(crate) tolerance: f64,
}

impl GrowthTask {
    /// Computes the growth of a difference between two links, given by name, along all motions.
    pub(crate) fn grown<'py>(
        self,
        py: Python<'py>,
        motions: &dyn Motions,
        pair: &[String],
        ensemble: &Ensemble<'_>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let [one, other] = pair else {
            let text = format!("pair must be two names of links, got {}", pair.len());
            return Err(PyValueError::new_err(text));
        };
        let alike = [vec![one.clone(), other.clone()]];
        let copies = copies(motions, &alike, &self.starts)?;
        let (horizons, tolerance) = (self.horizons.clone(), self.tolerance);
        let differences = motions.differences(&copies, horizons, tolerance);
        let mut differences = differences.map_err(|_| no_copies(&alike))?;
        if let Some(frequency_hz) = self.frequency_hz {
            differences = differences.looked_at(frequency_hz);
        }
        self.check_memory(&differences)?;
        let grown = detached(py, || differences.in_lanes(ensemble, &self.starts))?;
        let grown = grown.map_err(|_| no_copies(&alike))?;
        let mut failures = Failures::default();
        let mut all = Vec::with_capacity(grown.len());
        for (place, grown) in grown.into_iter().enumerate() {
            all.push(match grown {
                Ok(grown) => Some(grown),
                Err(GrowthError::Integration(failure)) => {
                    failures.note(place, &failure)?;
                    None
                }
                Err(error) => return Err(PyValueError::new_err(error.to_string())),
            });
        }
        failures.warn(py, all.len())?;
        self.result(py, &all)
    }

    /// Checks that memory suffices for the times of all samples, and for the states of all motions
    /// at the samples that are kept at a time.
    fn check_memory(&self, differences: &DifferenceGrowth) -> PyResult<()> {
        let last = self.horizons.last().copied().unwrap_or(0.0);
        let looks = Growth::LOOKS_A_PERIOD * differences.growth().frequency_hz * last;
        let kept = (Growth::LOOKS_A_SCALE + 1).min(looks.max(0.0) as usize + 1);
        let numbers = differences.system().dimension() + 1;
        let states = bytes(&[self.starts.len(), kept, numbers], 2);
        let all = bytes(&[looks.max(0.0) as usize], 2).zip(states);
        let all = all.and_then(|(times, states)| times.checked_add(states));
        need("growth up to the last horizon", all)
    }

    fn result<'py>(&self, py: Python<'py>, all: &[Option<Grown>]) -> PyResult<Bound<'py, PyAny>> {
        let columns = self.horizons.len();
        let nowhere = Checked {
            value: f64::NAN,
            difference: f64::NAN,
        };
        let factors: Vec<Checked> = all
            .iter()
            .flat_map(|grown| match grown {
                Some(grown) => grown.factors.clone(),
                None => vec![nowhere; columns],
            })
            .collect();
        let of_factors = |of: fn(&Checked) -> f64| {
            array(py, factors.iter().map(of).collect(), &[all.len(), columns])
        };
        let each = |of: fn(&Grown) -> f64| {
            let values = all.iter().map(|grown| grown.as_ref().map_or(f64::NAN, of));
            array(py, values.collect(), &[all.len()])
        };
        let fields = [
            ("factors", of_factors(|factor| factor.value)?),
            ("factor_changes", of_factors(|factor| factor.difference)?),
            ("rates", each(|grown| grown.rate.value)?),
            ("rate_changes", each(|grown| grown.rate.difference)?),
            ("frequencies", each(|grown| grown.frequency_hz.value)?),
            ("horizons", array(py, self.horizons.clone(), &[columns])?),
        ];
        result(py, "Growth", &fields)
    }
}
