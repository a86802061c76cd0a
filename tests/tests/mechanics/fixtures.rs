//! Compiled scenes beside those of the library: the attribute stands on real
//! types, and the text of each is kept for the pipeline.

#![allow(missing_docs)]

use branched_pendulum::branched_pendulum;

/// Compiles the item and keeps its text.
macro_rules! fixture {
    ($text:ident, $($item:tt)*) => {
        $($item)*

        pub(crate) const $text: &str = stringify!($($item)*);
    };
}

fixture! { FRICTIONAL,
    /// The paper's apparatus with friction in all joints.
    #[branched_pendulum(
        gravity = 9.80665,
        parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27, friction = 4e-4) [
            child(mass = 0.10531, com = 0.043, inertia = 0.516e-3, friction = 7e-5, drag = 3e-5, spring = 0.02) * 2
        ],
        emit(energies, momenta, symmetric, transfer),
    )]
    pub struct Frictional;
}

fixture! { NAMED,
    /// The paper's apparatus with a name for every number.
    #[branched_pendulum(
        gravity = g,
        parent(mass = m_1, com = d_1, inertia = i_1, joint = l) [
            child(mass = m_2, com = d_2, inertia = i_2, friction = c) * 2
        ],
        emit(energies, momenta, modes, symmetric, transfer),
    )]
    pub struct Named;
}

fixture! { TRIPLE,
    /// Three children with friction beside a fourth that is unlike them, on a
    /// parent with lateral offsets.
    #[branched_pendulum(
        gravity = 9.80665,
        parent(mass = 0.3, com = (0.1, 0.02), inertia = 2e-3, joint = (0.25, -0.03), friction = 5e-4) [
            child(mass = 0.1, com = 0.05, inertia = 0.4e-3, friction = 6e-5, drag = 2e-5, spring = 0.03) * 3,
            other: rod(mass = 0.08, length = 0.2, at = 0.1),
        ],
        emit(energies, momenta, symmetric, transfer),
    )]
    pub struct Triple;
}

/// Two arms with two hands each.
#[branched_pendulum(
    gravity = 9.80665,
    body: rod(mass = 0.4, length = 0.3) [
        arm: rod(mass = 0.2, length = 0.2) [
            hand: point(mass = 0.1, length = 0.1) * 2,
        ] * 2,
    ],
    emit(energies, momenta, symmetric),
)]
pub struct Nested;
