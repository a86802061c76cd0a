//! Trees that several programs use.

use branched_pendulum::branched_pendulum;

/// The paper's apparatus with ideal joints, and the requested forms of W: to first order in θ_d as
/// published, to orders 2 to 8 in the amplitude (θ_d and p_d together), and exact.
///
/// Lengths and masses were measured, the moments of inertia fitted to the three eigenfrequencies
/// (the paper, sections 4 and 5). The paper does not state g; for a motion that starts from rest,
/// another g only changes the time scale.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ],
    emit(
        energies, momenta, modes, symmetric, positions, taylor,
        transfer(angle = 1, amplitude = 2, amplitude = 4, amplitude = 6, amplitude = 8, exact)
    ),
)]
pub struct BranchedDouble;

/// The apparatus with viscous friction in its joints. It is a separate scene because most runs are
/// without friction and then need not compute any.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27, friction = friction_root) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3, friction = friction_children) * 2
    ],
    emit(symmetric, taylor, transfer(exact)),
)]
pub struct DampedBranchedDouble;

/// Uniform rods: each rod carries two rods with half its mass and 0.7 times its length.
macro_rules! rods {
    ($(#[$doc:meta])* $name:ident: $generations:tt generations) => {
        $(#[$doc])*
        #[branched_pendulum(
            gravity = 9.80665,
            rod: generations(count = $generations, branching = 2, shape = rod, mass = 0.12,
                length = 0.3, mass_ratio = 0.5, length_ratio = 0.7),
            emit(taylor),
        )]
        pub struct $name;
    };
}

rods! {
    /// Seven uniform rods: each carries two rods with half its mass and 0.7 times its length.
    Rods: 3 generations
}
rods! {
    /// The seven rods with one more generation: fifteen rods.
    FifteenRods: 4 generations
}
rods! {
    /// The seven rods with two more generations: thirty-one rods.
    ThirtyOneRods: 5 generations
}
