//! The functions that a model may have: their purposes, with name, arguments and result of
//! each.

mod argument;
mod forms;
mod naming;
mod of_link;
mod purpose;

pub use argument::{Argument, ResultShape};
pub(crate) use forms::CANONICAL;
pub use forms::{Cause, Counting, EnergyDefinition, EntryState, PointKind};
pub use naming::{Naming, Signature};
pub use of_link::{BodyFunction, LinkFunction, ScaleFunction};
pub use purpose::Purpose;

/// Methods of models that are no functions of a program: those of traits, and what makes a
/// model.
#[rustfmt::skip]
const OTHER_METHODS: &[&str] = &[
    "accelerations_into", "accelerations_under_into", "cast", "check_parameters", "children",
    "clone", "compute", "compute_with", "default", "degrees_of_freedom", "energy_of", "eq",
    "evaluate", "fmt", "from", "from_parameters_unchecked", "into", "kinetic_energy_of",
    "link_body", "link_name", "link_names", "links", "new", "on", "part", "point_torques",
    "point_torques_into", "point_velocities", "point_velocities_into", "points", "points_into",
    "potential_energy_of", "prescribed_links", "properties_of", "small_accelerations_into",
    "small_accelerations_under_into", "small_energy_of", "stands",
    "symmetric_accelerations_into", "symmetric_momenta_into", "taylor_coefficients_into",
    "taylor_coefficients_of", "taylor_workspace", "transfers_into", "with_parameters",
];

/// Returns true if models may have a method of that name, asked for or not.
pub fn is_method(name: &str) -> bool {
    let naming = Naming::any();
    let is_function = |purpose| {
        let function = naming.signature(purpose).name;
        match function.split_once('*') {
            Some((stem, _)) => name.starts_with(stem),
            None => name == function,
        }
    };
    OTHER_METHODS.contains(&name) || naming.purposes().into_iter().any(is_function)
}
