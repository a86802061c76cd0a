//! Pendulum trees for Python.

mod method;
mod tree;

use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;

pyo3::create_exception!(
    branched_pendulum,
    DescriptionError,
    PyValueError,
    "A text that is no description of a tree: all mistakes, each marked in its line."
);
pyo3::create_exception!(
    branched_pendulum,
    IntegrationError,
    PyRuntimeError,
    "A motion that could not be followed to its end."
);

/// Pendulum trees, described in text.
///
/// SI units; angles are absolute, in radians from the downward vertical. A state is the angles
/// followed by the angular velocities.
#[pymodule]
fn branched_pendulum(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add("DescriptionError", py.get_type::<DescriptionError>())?;
    module.add("IntegrationError", py.get_type::<IntegrationError>())?;
    module.add_class::<tree::Tree>()?;
    module.add_class::<method::Solution>()
}
