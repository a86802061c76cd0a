//! Python bindings for pendulum trees: the native module `branched_pendulum._native`.

mod advise;
mod arguments;
mod arrays;
mod branched_double;
mod budget;
mod design;
mod deviations;
mod equilibria;
mod estimates;
mod events;
mod examples;
mod failures;
mod following;
mod gradients;
mod growth;
mod identify;
mod interrupts;
mod jumps;
mod kept;
mod measured_model;
mod mechanics;
mod memory;
mod model_smoothing;
mod motions;
mod normal_form;
mod observables;
mod pendulum;
mod recording;
mod results;
mod sectors;
mod smooth;
mod smoothing;
mod spectrum;
mod statistics;
mod stepper;
mod stepping;
mod tree;
mod work_precision;

use pyo3::exceptions::{PyRuntimeError, PyRuntimeWarning, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

pyo3::create_exception!(
    branched_pendulum,
    DescriptionError,
    PyValueError,
    "A text that is no description of a tree: all mistakes, each marked in its line; `mistakes` \
     has line and column, counted from 1, and message of each."
);
pyo3::create_exception!(
    branched_pendulum,
    IntegrationError,
    PyRuntimeError,
    "A motion that could not be followed to its end: `solution` has it up to there, with the \
     last good state at its end."
);
pyo3::create_exception!(
    branched_pendulum,
    FailedMotions,
    PyRuntimeWarning,
    "Some of many motions could not be followed: `reasons` has the reason of each, by the index \
     of its start."
);

pyo3::create_exception!(
    branched_pendulum.data,
    ReadError,
    PyValueError,
    "A file of measurements that is not understood: `file`, and where there is one the place in \
     it, `line` and `column` counted from 1 and the column's `name`."
);

#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    let description_error = py.get_type::<DescriptionError>();
    description_error.setattr("mistakes", PyList::empty(py))?;
    module.add("DescriptionError", description_error)?;
    let integration_error = py.get_type::<IntegrationError>();
    integration_error.setattr("solution", py.None())?;
    module.add("IntegrationError", integration_error)?;
    module.add("RequestError", failures::request_error(py)?)?;
    let failed_motions = py.get_type::<FailedMotions>();
    failed_motions.setattr("reasons", PyDict::new(py))?;
    module.add("FailedMotions", failed_motions)?;
    let read_error = py.get_type::<ReadError>();
    for place in ["file", "line", "column", "name"] {
        read_error.setattr(place, py.None())?;
    }
    module.add("ReadError", read_error)?;
    module.add_class::<pendulum::Pendulum>()?;
    module.add_class::<tree::Tree>()?;
    module.add_class::<branched_double::BranchedDouble>()?;
    module.add_class::<results::DenseOutput>()?;
    module.add_class::<recording::Recording>()?;
    module.add_class::<smoothing::SmoothedMotion>()?;
    module.add_class::<spectrum::Lines>()?;
    module.add_class::<normal_form::PyNormalForm>()?;
    module.add_class::<stepper::PyStepper>()?;
    module.add_function(wrap_pyfunction!(recording::read, module)?)?;
    module.add_function(wrap_pyfunction!(examples::example_texts, module)?)?;
    module.add_function(wrap_pyfunction!(statistics::average, module)?)?;
    module.add_function(wrap_pyfunction!(statistics::transient, module)?)?;
    module.add_function(wrap_pyfunction!(smooth::smooth, module)?)?;
    module.add_function(wrap_pyfunction!(spectrum::spectrum, module)?)?;
    module.add_function(wrap_pyfunction!(spectrum::lines, module)?)?;
    module.add_function(wrap_pyfunction!(spectrum::running_integral, module)?)
}
