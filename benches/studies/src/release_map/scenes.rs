//! Trees in phase, beside the paper's own.

use branched_pendulum::branched_pendulum;

/// The paper's pendulum, whose children have `ratio` times their mass.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531 * ratio, com = 0.043, inertia = 0.516e-3 * ratio) * 2
    ],
    in_phase(child),
    emit(transverse),
)]
pub struct HeavyChildren;

/// Two jointed arms on a body, moving alike.
#[branched_pendulum(
    gravity = 9.80665,
    body: rod(mass = 0.4, length = 0.3) [
        upper: rod(mass = 0.1, length = 0.2) [lower: rod(mass = 0.05, length = 0.15)] * 2
    ],
    in_phase(upper),
    emit(transverse),
)]
pub struct ArmsInPhase;
