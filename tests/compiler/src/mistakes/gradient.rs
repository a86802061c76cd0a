//! Wrong requests for derivatives.

use super::Mistake;

pub(super) const MISTAKES: &[Mistake] = &[
    (
        "gradient_of_nothing",
        "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1, length = 1), emit(gradient()))]
struct Pendulum;",
    ),
    (
        "gradient_of_an_unknown_function",
        "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1, length = 1),
    emit(gradient(acceleration, height)),
    observe(hight = cos(theta_a)),
)] struct Pendulum;",
    ),
    (
        "gradient_with_an_order",
        "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1, length = 1),
    emit(gradient(energies = 2)),
)] struct Pendulum;",
    ),
    (
        "gradient_of_no_transfer",
        "#[branched_pendulum(gravity = 9.8,
    a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2],
    emit(gradient(transfer)),
)] struct Pendulum;",
    ),
    (
        "gradient_in_loops",
        "#[branched_pendulum(gravity = 9.8, code = loops,
    a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2],
    emit(energies, gradient),
)] struct Pendulum;",
    ),
    (
        "gradient_with_a_taken_name",
        "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1, length = 1),
    emit(gradient(height)),
    observe(height = cos(theta_a), height_gradient = sin(theta_a)),
)] struct Pendulum;",
    ),
];
