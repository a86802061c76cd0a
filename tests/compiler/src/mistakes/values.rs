//! Mistakes in values.

use super::Mistake;

pub(super) const MISTAKES: &[Mistake] = &[
    (
        "negative",
        "#[branched_pendulum(gravity = -9.8, a(mass = -0.1, com = -1, inertia = 1 - 2, friction = -2e-5) [
    b: rod(mass = 1, length = -1, at = -1),
])] struct Pendulum;",
    ),
    (
        "not_positive",
        "#[branched_pendulum(gravity = 0, a: rod(mass = 1, length = 0) [
    b: plate(mass = 1, length = 0.2, width = 0.1, margin = 0.1),
])] struct Pendulum;",
    ),
    (
        "numbers_by_cancelling",
        "#[branched_pendulum(gravity = 9.8,
    a(mass = 1, com = 1, inertia = -p / p) [
        b(mass = 1, com = 1, inertia = 2 * (p + q) / (-p - q)),
        c(mass = (p - q) / (q - p), com = 1, inertia = 1),
        d(mass = p ^ -2 * p ^ 2 - 2, com = 1, inertia = -(p / q) * (q / p)),
        e: rod(mass = 1, length = p / (q / q - 1)),
    ],
)] struct Pendulum;",
    ),
    (
        "singular",
        "#[branched_pendulum(gravity = 9.8, trunk: rod(mass = 1, length = 1) [
    massless_leaf: rod(mass = 0, length = 1),
    massless_arm: rod(mass = 0, length = 1) [ bob: point(mass = 0.1, length = 1) ],
    hung_at_its_centre(mass = 1, com = 0, inertia = 0),
])] struct Pendulum;",
    ),
    (
        "static_friction",
        "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1, length = 1,
    friction(coulomb = 0.2, static = 0.1, stribeck = 1)) [
    b: rod(mass = 1, length = 1, friction(static = 0.1)),
    c: rod(mass = 1, length = 1, friction(coulomb = 0.1, stribeck = 1)),
    d: rod(mass = 1, length = 1, drag(static = 1)),
], between(b, c, friction(coulomb = 1, static = 0.5, stribeck = 1)))] struct Pendulum;",
    ),
    (
        "division_by_zero",
        "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1 / (1 - 1), length = 0^-1))] struct Pendulum;",
    ),
    (
        "not_decimal",
        "#[branched_pendulum(gravity = 9.8f64, a: rod(mass = 0x10, length = \"1\"))] struct Pendulum;",
    ),
    (
        "number_range",
        "#[branched_pendulum(gravity = 1e309, a: rod(mass = 1e-330, length = 1e999999999))] struct Pendulum;",
    ),
    (
        "magnitudes",
        "#[branched_pendulum(gravity = 1e77,
    a(mass = 1e300, com = (0.1, -1e200), inertia = 2e100, joint = 0.3) [
        b: rod(mass = 0.1, length = 1e31, friction(coulomb = 1e150, width = 1e-40)) * 2,
        c: rod(mass = 0.1, length = 0.2, spring = 1e101, rest = 1e31),
        d(mass = 1e-200, com = 0.1, inertia = 1e-150),
    ],
    drive(torque = 1e200, x = 0.1 * cos(1e60 * t)),
)] struct Pendulum;",
    ),
    (
        "negligible_values",
        "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1, length = 1) [
    b(mass = 0.1, com = 1e-170, inertia = 0),
    c(mass = 0.1, com = (1e-35, -1e-31), inertia = 0),
    d(mass = 1e-59, com = 1e-29, inertia = 0),
])] struct Pendulum;",
    ),
    (
        "growing_generations",
        "#[branched_pendulum(gravity = 9.8, tree: generations(count = 60, branching = 1,
    shape = rod, mass = 1, length = 1, length_ratio = 10))] struct Pendulum;",
    ),
    (
        "number_length",
        "#[branched_pendulum(gravity = 9.8^5000, a: rod(mass = 1, length = 2^8000 * 3^5000))] struct Pendulum;",
    ),
    (
        "exponent",
        "#[branched_pendulum(gravity = 9.8^0.5, a: rod(mass = 2^n, length = 2^(1 + 1)))] struct Pendulum;",
    ),
    (
        "degree",
        "#[branched_pendulum(gravity = g^100000000, a: rod(mass = m^-9, length = ((l^4)^2)^2))] struct Pendulum;",
    ),
    (
        "chained_power",
        "#[branched_pendulum(gravity = 9.8^2^3, a: rod(mass = 1, length = 1))] struct Pendulum;",
    ),
    (
        "function_call",
        "#[branched_pendulum(gravity = sqrt(96), a: rod(mass = 1, length = 1))] struct Pendulum;",
    ),
    (
        "two_meanings",
        "#[branched_pendulum(gravity = 9.8,
    a: rod(mass = 1, length = 1, friction = gravity) [
        b: rod(mass = kinetic_energy, length = 2 * p_a, spring = p_d) * 2,
        c: rod(mass = 2 * potential_energy, length = p_q),
    ],
    drive(torque = theta_a * cos(omega * t + omega_a)),
)] struct Pendulum;",
    ),
    (
        "two_meanings_declared",
        "#[branched_pendulum(gravity = 2 * gravity, parameters(theta_a, gravity, omega_m, m), a: rod(mass = m, length = 1) [
    b: rod(mass = m, length = 1) * 2 ], drive(x = omega_m * cos(theta_a * t)),
)] struct Pendulum;",
    ),
    (
        "not_exact",
        "#[branched_pendulum(gravity = pi^2, a: rod(mass = 1, length = tau))] struct Pendulum;",
    ),
    (
        "rest_without_spring",
        "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1, length = 1, rest = 0.1))] struct Pendulum;",
    ),
    (
        "laws_of_friction",
        "#[branched_pendulum(gravity = 9.8,
    a: rod(mass = 1, length = 1, friction(width = 0.1), drag(coulomb = 1, quadratic = 2)) [
        b: rod(mass = 1, length = 1, friction = 1, friction(viscous = 2, coulomb = -1, width = 0)),
        c: rod(mass = 1, length = 1, friction(columb = 1, quadratic 2), coulomb = 1, spring(rest = 1)),
        d: rod(mass = 1, length = 1, friction(), drag(quadratic = omega_d)),
    ])] struct Pendulum;",
    ),
    (
        "locked_drag",
        "#[branched_pendulum(gravity = 9.8,
    a: rod(mass = 1, length = 1, drag(quadratic = 1)) [
        b: rod(mass = 1, length = 1, drag(quadratic = 1, width = 0.1)),
    ],
    locked(b, 0.1))] struct Pendulum;",
    ),
    (
        "declared_parameters",
        "#[branched_pendulum(
    gravity = g,
    parameters(g, mass_of_a, r, mass_of_a),
    a: rod(mass = mas_of_a, length = prism),
)] struct Pendulum;",
    ),
    (
        "unused_parameter",
        "#[branched_pendulum(parameters(g, m), gravity = g, a: rod(mass = 1, length = 1))] struct Pendulum;",
    ),
];
