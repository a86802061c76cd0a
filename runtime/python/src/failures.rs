//! Failures of integrations, as Python exceptions and warnings.

use branched_pendulum::integrate::{InputError, IntegrationError as Failure};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyTuple, PyType};

use crate::{FailedMotions, IntegrationError};

/// Returns the exception class for invalid requests: both an `IntegrationError` and a `ValueError`.
pub(crate) fn request_error(py: Python<'_>) -> PyResult<&Bound<'_, PyType>> {
    static CLASS: PyOnceLock<Py<PyType>> = PyOnceLock::new();
    let class = CLASS.get_or_try_init(py, || {
        let bases = [
            py.get_type::<IntegrationError>(),
            py.get_type::<PyValueError>(),
        ];
        let names = PyDict::new(py);
        names.set_item("__module__", "branched_pendulum")?;
        let doc = "A motion that no method can follow as it was asked for; nothing was computed.";
        names.set_item("__doc__", doc)?;
        let class = py.get_type::<PyType>();
        let class = class.call1(("RequestError", PyTuple::new(py, bases)?, names))?;
        Ok::<_, PyErr>(class.cast_into::<PyType>()?.unbind())
    })?;
    Ok(class.bind(py))
}

/// Returns the message for a failure, with the Python argument that may avoid it.
fn words(failure: &Failure<f64>) -> String {
    match failure {
        Failure::Input(InputError::ToleranceBelowRounding { .. }) => {
            format!("{failure} (rtol, atol)")
        }
        Failure::Input(InputError::NoSeries) => {
            "method: a compiled model has no Taylor series, a Tree has them".to_owned()
        }
        Failure::StepTooSmall {
            step: 0.0, last, ..
        } => format!(
            "no step has an error below the tolerance at t = {}, since a component of the state \
             and its absolute tolerance are 0; help: give atol above 0",
            last.time
        ),
        Failure::StepLimit { .. } => format!("{failure}: more are made with max_steps="),
        failure => failure.to_string(),
    }
}

/// The exception of a failure.
pub(crate) fn failed(failure: Failure<f64>) -> PyErr {
    let text = words(&failure);
    match failure {
        Failure::Input(_) => Python::attach(|py| match request_error(py) {
            Ok(class) => PyErr::from_type(class.clone(), text),
            Err(error) => error,
        }),
        _ => IntegrationError::new_err(text),
    }
}

/// Failures among many motions: index and message of each.
#[derive(Default)]
pub(crate) struct Failures(Vec<(usize, String)>);

impl Failures {
    /// Records the failure of one motion.
    ///
    /// # Errors
    /// The failure as an exception, if it is caused by the request and not by a single start.
    pub(crate) fn note(&mut self, place: usize, failure: &Failure<f64>) -> PyResult<()> {
        match failure {
            Failure::Input(InputError::StartValue { .. }) => {}
            Failure::Input(_) => return Err(failed(failure.clone())),
            _ => {}
        }
        self.0.push((place, words(failure)));
        Ok(())
    }

    /// Issues a warning if some of the `all` motions have failed.
    pub(crate) fn warn(self, py: Python<'_>, all: usize) -> PyResult<()> {
        let Some((place, reason)) = self.0.first() else {
            return Ok(());
        };
        let count = self.0.len();
        let text = format!(
            "{count} of {all} motions could not be followed, and are NaN from there on; \
             starts[{place}]: {reason}; `reasons` of this warning has all of them"
        );
        let warning = py.get_type::<FailedMotions>().call1((text,))?;
        let reasons = PyDict::new(py);
        for (place, reason) in self.0 {
            reasons.set_item(place, reason)?;
        }
        warning.setattr("reasons", reasons)?;
        py.import("warnings")?.call_method1("warn", (warning,))?;
        Ok(())
    }
}
