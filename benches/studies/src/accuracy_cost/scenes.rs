//! Trees for the advisor, in all the forms in which their motion can be computed.

use branched_pendulum::branched_pendulum;

/// The paper's apparatus with its children in phase.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ],
    in_phase(child),
    emit(taylor),
)]
pub struct PaperInPhase;

/// Six generations of rods: each rod carries two rods with half its mass and 0.7 times its length.
macro_rules! cascade {
    ($(#[$doc:meta])* $name:ident: $($entries:tt)*) => {
        $(#[$doc])*
        #[branched_pendulum(
            gravity = 9.80665,
            arm: generations(count = 6, branching = 2, shape = rod, mass = 0.12, length = 0.3,
                mass_ratio = 0.5, length_ratio = 0.7),
            $($entries)*
        )]
        pub struct $name;
    };
}

cascade! {
    /// A cascade of 63 links, in loops.
    Cascade: emit(energies, positions),
}
cascade! {
    /// The cascade, written out link by link.
    CascadeWrittenOut: code = unrolled,
}
cascade! {
    /// The cascade with all copies in phase: six links.
    CascadeInPhase: in_phase(all), emit(taylor),
}

/// A branch: five generations of springy rods with friction.
macro_rules! branch {
    ($(#[$doc:meta])* $name:ident: $($entries:tt)*) => {
        $(#[$doc])*
        #[branched_pendulum(
            gravity = 9.80665,
            limb: generations(count = 5, branching = 2, shape = rod, mass = 0.4, length = 0.5,
                mass_ratio = 0.4, length_ratio = 0.7, spring = 4, spring_ratio = 0.25,
                friction = 0.02, friction_ratio = 0.25),
            $($entries)*
        )]
        pub struct $name;
    };
}

branch! {
    /// A branch of 31 links.
    Branch: emit(energies, positions, taylor),
}
branch! {
    /// The branch, in loops.
    BranchLoops: code = loops,
}
branch! {
    /// The branch with all copies in phase: five links.
    BranchInPhase: in_phase(all), emit(taylor),
}
