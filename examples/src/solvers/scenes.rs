//! The trees that integrators are compared on, with their Taylor coefficients.

use branched_pendulum::branched_pendulum;

/// The paper's apparatus. Its numbers are those of
/// [`branched_double::scenes`](crate::branched_double::scenes).
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ],
    emit(energies, taylor),
)]
pub struct Ideal;

/// The paper's apparatus with viscous friction in every pivot.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27, friction = friction) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3, friction = friction) * 2
    ],
    emit(taylor),
)]
pub struct Damped;

/// Uniform rods: every rod carries two of half its mass and seven tenths of its
/// length.
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
    /// Seven uniform rods: every rod carries two of half its mass and seven tenths
    /// of its length.
    Rods: 3 generations
}
rods! {
    /// Seven rods with one generation more: fifteen.
    FifteenRods: 4 generations
}
rods! {
    /// Seven rods with two generations more: thirty-one.
    ThirtyOneRods: 5 generations
}
