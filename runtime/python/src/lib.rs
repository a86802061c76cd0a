//! Pendulum trees for Python: the module `branched_pendulum._native`.

mod arrays;
mod branched_double;
mod events;
mod motions;
mod pendulum;
mod solution;
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

#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add("DescriptionError", py.get_type::<DescriptionError>())?;
    module.add("IntegrationError", py.get_type::<IntegrationError>())?;
    module.add_class::<pendulum::Pendulum>()?;
    module.add_class::<tree::Tree>()?;
    module.add_class::<branched_double::BranchedDouble>()?;
    module.add_class::<solution::Solution>()
}
