//! Names of the methods of emitted models.

/// Methods that emitted models may have, asked for or not. A test holds the
/// list against the fixtures.
#[rustfmt::skip]
const METHODS: &[&str] = &[
    "accelerations", "accelerations_into", "canonical_rates", "cast", "centre_torques",
    "centre_velocities", "centres", "check_parameters", "children", "clone", "default",
    "degrees_of_freedom", "end_torques", "end_velocities", "ends", "eq", "evaluate", "fmt", "from",
    "from_parameters_unchecked", "from_symmetric", "hamiltonian", "into", "kinetic_energy",
    "kinetic_energy_of", "link_body", "link_properties", "mass_matrix", "momenta", "new", "part",
    "pivot_torques", "pivot_velocities", "pivots", "point_torques_into",
    "point_velocities_into", "points_into", "potential_energy", "potential_energy_of",
    "small_energy", "small_energy_of", "stiffness_matrix", "symmetric_accelerations", "symmetric_accelerations_into",
    "symmetric_momenta", "symmetric_velocities", "taylor_coefficients",
    "taylor_coefficients_into", "to_symmetric", "transfers_into", "velocities", "with_parameters",
];

/// Beginnings of names of methods that are many.
const METHOD_FAMILIES: &[&str] = &[
    "accelerations_prescribed",
    "accelerations_under",
    "antiphase_drive_power",
    "antiphase_energy",
    "antiphase_friction_power",
    "antiphase_outside_power",
    "budget_",
    "drive_power",
    "friction_power",
    "outside_power",
    "sector_transfers",
    "small_accelerations",
    "symmetric_",
    "transverse_",
    "transfer_amplitude_",
    "transfer_angle_",
    "transfer_exact",
    "transfer_forcing",
    "transfer_growth",
    "transfer_matrix",
    "transfer_quadratic_form",
];

/// Returns true if emitted models may have a method of that name, asked for or not.
pub fn is_method(name: &str) -> bool {
    METHODS.contains(&name) || METHOD_FAMILIES.iter().any(|f| name.starts_with(f))
}
