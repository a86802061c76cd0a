//! Integration methods selected by name, with their tolerances and steps.

use branched_pendulum::integrate::{AnyIntegrator, Method, MethodChoice, Options, Tolerance};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arrays::{Numbers, whole};
use crate::memory::shown;

/// An integration method selected by name, with its tolerances or step length.
pub(crate) struct Stepping<'a, 'py> {
    pub(crate) method: &'a str,
    /// Method for the name `auto`.
    pub(crate) automatic: Method,
    pub(crate) rtol: f64,
    pub(crate) atol: Option<&'a Numbers<'py>>,
    pub(crate) step: Option<f64>,
    pub(crate) first_step: Option<f64>,
    pub(crate) max_step: Option<f64>,
    pub(crate) max_steps: i128,
}

impl Stepping<'_, '_> {
    /// Returns the method, chosen by name or, for `auto`, by the program.
    pub(crate) fn method(&self) -> PyResult<Method> {
        let choice: MethodChoice = self
            .method
            .parse()
            .map_err(|error| PyValueError::new_err(format!("method: {error}")))?;
        if choice == MethodChoice::Auto && self.step.is_some() {
            return Err(PyValueError::new_err(
                "step= belongs to a method with steps of one length: give method=\"rk4\" or \
                 \"gauss2\" to \"gauss8\" with it",
            ));
        }
        Ok(choice.method(|| self.automatic))
    }

    /// Returns the method with a tighter tolerance or shorter step, for comparison.
    pub(crate) fn finer(&self, dimension: usize) -> PyResult<AnyIntegrator<f64>> {
        let method = self.method()?;
        let finer = Self {
            rtol: method.finer(self.rtol),
            step: self.step.map(|step| method.finer(step)),
            ..*self
        };
        finer.integrator(dimension)
    }

    /// Returns the method for states of `dimension` numbers.
    pub(crate) fn integrator(&self, dimension: usize) -> PyResult<AnyIntegrator<f64>> {
        let method = self.method()?;
        let mut options = Options::with_tolerance(self.rtol);
        options.step_limit = whole("max_steps", self.max_steps, 1)?;
        let refused = |text: String| Err(PyValueError::new_err(text));
        match method.is_adaptive() {
            true => {
                if self.step.is_some() {
                    return refused(format!(
                        "`{method}` chooses its steps: give first_step= or max_step= in place of \
                         step="
                    ));
                }
                options.initial_step = self.first_step;
                options.max_step = self.max_step.filter(|step| *step != f64::INFINITY);
            }
            false => {
                let of_others = [
                    ("first_step", self.first_step.is_some()),
                    ("max_step", self.max_step.is_some()),
                    ("atol", self.atol.is_some()),
                ];
                if let Some((name, _)) = of_others.iter().find(|(_, given)| *given) {
                    return refused(format!(
                        "`{method}` goes by steps of one length, step=: it has no {name}="
                    ));
                }
                if self.step.is_none() {
                    return refused(format!(
                        "`{method}` goes by steps of one length: give step=..."
                    ));
                }
                options.initial_step = self.step;
            }
        }
        if let Some(atol) = self.atol {
            options.absolute = absolute(atol, dimension)?;
        }
        Ok(method.with_options(options))
    }
}

/// Converts absolute tolerances: one for all, or one for each number of a state.
fn absolute(atol: &Numbers<'_>, dimension: usize) -> PyResult<Tolerance<f64>> {
    let values = atol.to_vec();
    match (atol.shape(), &values[..]) {
        ([], [one]) => Ok(Tolerance::Uniform(*one)),
        ([found], _) if *found == dimension => Ok(Tolerance::PerComponent(values)),
        (shape, _) => Err(PyValueError::new_err(format!(
            "atol must be one number or have shape ({dimension},), got {}",
            shown(shape)
        ))),
    }
}
