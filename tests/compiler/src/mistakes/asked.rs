//! Mistakes in the drive, in requests and observables.

use super::Mistake;

pub(super) const MISTAKES: &[Mistake] = &[
    // The drive.
    (
        "empty_drive",
        "#[branched_pendulum(gravity = 1, a: rod(mass = 1, length = 1), drive())] struct Pendulum;",
    ),
    (
        "unknown_drive",
        "#[branched_pendulum(gravity = 1, a: rod(mass = 1, length = 1),
    drive(torqe = 1, z = t, 3 = 4),
)] struct Pendulum;",
    ),
    (
        "duplicate_drive",
        "#[branched_pendulum(gravity = 1, a: rod(mass = 1, length = 1),
    drive(x = 1, x = 2),
    drive(y = (1, 2)),
)] struct Pendulum;",
    ),
    (
        "drive_functions",
        "#[branched_pendulum(gravity = 1, a: rod(mass = 1, length = 1),
    drive(torque = tau * coz(w * t), x = tan(t) + sin(), y = M * cos(a * t)),
)] struct Pendulum;",
    ),
    (
        "time_divisor",
        "#[branched_pendulum(gravity = 1, a: rod(mass = 1, length = 1),
    drive(torque = 1 / (1 + t), x = cos(t)^-1, y = t / (cos(w) * (1 - 1)) + t / 0),
)] struct Pendulum;",
    ),
    (
        "time_outside_drive",
        "#[branched_pendulum(gravity = t, t: rod(mass = 1, length = 2 * t + cos(t)) [ drive: rod(mass = 1, length = 1) ],
    drive(x = t),
)] struct Pendulum;",
    ),
    // Requests.
    (
        "unknown_request",
        "#[branched_pendulum(gravity = 1, a: rod(mass = 1, length = 1), emit(energy, plots))] struct Pendulum;",
    ),
    (
        "unknown_solve",
        "#[branched_pendulum(gravity = 1, a: rod(mass = 1, length = 1), solve = recursive)] struct Pendulum;",
    ),
    (
        "duplicate_solve",
        "#[branched_pendulum(gravity = 1, solve = recursion, a: rod(mass = 1, length = 1), solve = factorization)] struct Pendulum;",
    ),
    (
        "unknown_code",
        "#[branched_pendulum(gravity = 1, a: rod(mass = 1, length = 1), code = tables)] struct Pendulum;",
    ),
    (
        "no_table",
        "#[branched_pendulum(gravity = 1, code = loops, emit(momenta), a: rod(mass = 1, length = 1) [
    b: rod(mass = 1, length = 1), c: rod(mass = 1, length = 1, at = 0.5)])] struct Pendulum;",
    ),
    (
        "duplicate_request",
        "#[branched_pendulum(gravity = 1, a: rod(mass = 1, length = 1) [ b: rod(mass = 1, length = 1) * 2 ],
    emit(energies, energies, transfer(exact, exact)))] struct Pendulum;",
    ),
    (
        "request_forms",
        "#[branched_pendulum(gravity = 1, a: rod(mass = 1, length = 1), emit(modes(all)))] struct Pendulum;",
    ),
    (
        "unknown_form",
        "#[branched_pendulum(gravity = 1, a: rod(mass = 1, length = 1) [ b: rod(mass = 1, length = 1) * 2 ],
    emit(transfer(amplitud = 2, consistent)))] struct Pendulum;",
    ),
    (
        "no_form",
        "#[branched_pendulum(gravity = 1, a: rod(mass = 1, length = 1) [ b: rod(mass = 1, length = 1) * 2 ],
    emit(transfer()))] struct Pendulum;",
    ),
    (
        "orders",
        "#[branched_pendulum(gravity = 1, a: rod(mass = 1, length = 1) [ b: rod(mass = 1, length = 1) * 2 ],
    emit(transfer(angle = 9, amplitude, amplitude = 1, exact = 1)))] struct Pendulum;",
    ),
    (
        "no_siblings",
        "#[branched_pendulum(gravity = 1, a: rod(mass = 1, length = 1) [
        b: rod(mass = 1, length = 1),
        c: rod(mass = 1, length = 1),
    ],
    emit(symmetric, transfer))] struct Pendulum;",
    ),
    (
        "budget_forms",
        "#[branched_pendulum(
    gravity = 9.8,
    a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2],
    emit(budget(parsival, canonical = 2, matrix, matrix, amplitude = 9, amplitude)),
)] struct Pendulum;",
    ),
    (
        "coupled_sectors",
        "#[branched_pendulum(gravity = 9.8,
    a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2],
    between(a, b_1, friction = 1e-3), siblings(b, spring = 1), between(a, b_2, spring = 1),
    emit(transfer(exact)))] struct Pendulum;",
    ),
    (
        "coupled_by_a_rest_angle",
        "#[branched_pendulum(gravity = 9.8,
    a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2],
    between(b_1, b_2, spring = 1, rest = 0.1), emit(budget(parseval)))] struct Pendulum;",
    ),
    (
        "spring_by_scale",
        "#[branched_pendulum(gravity = 9.8,
    a: generations(count = 4, branching = 2, mass = 1, com = 1, inertia = 1, joint = 2),
    siblings(a_4, spring = 1), between(a_1, a_4_1_1_1, friction = 1),
    between(a_1, a_4_1_1_2, spring = 1), emit(budget(parseval, scales)))] struct Pendulum;",
    ),
    (
        "budget_small",
        "#[branched_pendulum(
    gravity = 9.8,
    a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2],
    emit(budget(amplitude = 2, small(e, in_phase, d, d), matrix(d))),
)] struct Pendulum;",
    ),
    (
        "budget_small_without_order",
        "#[branched_pendulum(
    gravity = 9.8,
    a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2],
    emit(budget(canonical, small(d)), transfer(exact(d))),
)] struct Pendulum;",
    ),
    (
        "budget_small_empty",
        "#[branched_pendulum(
    gravity = 9.8,
    a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2],
    emit(budget(amplitude = 2, small)),
)] struct Pendulum;",
    ),
    (
        "budget_without_form",
        "#[branched_pendulum(
    gravity = 9.8,
    a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2],
    emit(budget()),
)] struct Pendulum;",
    ),
    (
        "budget_beside_scales",
        "#[branched_pendulum(gravity = 9.8,
    tree: generations(count = 4, branching = 2, shape = rod, mass = 1, length = 1),
    emit(budget(parseval, matrix, scales)),
)] struct Pendulum;",
    ),
    (
        "budget_scales_without_rule",
        "#[branched_pendulum(gravity = 9.8,
    a: rod(mass = 1, length = 1) [ b: rod(mass = 1, length = 1) * 2 ],
    emit(budget(parseval, scales)),
)] struct Pendulum;",
    ),
    (
        "budget_scales_without_loops",
        "#[branched_pendulum(gravity = 9.8,
    tree: generations(count = 4, branching = 2, shape = rod, mass = 1, length = 1),
    emit(momenta, budget(scales)),
)] struct Pendulum;",
    ),
    (
        "budget_without_siblings",
        "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1, length = 1), emit(budget))] struct Pendulum;",
    ),
    (
        "nested_groups",
        "#[branched_pendulum(gravity = 1,
    a: generations(count = 3, branching = 2, shape = rod, mass = 1, length = 1),
    emit(transfer(exact)))] struct Pendulum;",
    ),
    // Copies that differ.
    (
        "each",
        "#[branched_pendulum(gravity = each(9.8, 9.7), drive(x = each(t, 2 * t)),
    a: rod(mass = each(1, 2), length = 1) [
        b: rod(mass = each(0.1, 0.2, 0.3), length = 2 * each(1, 2)) * 2,
        c: rod(mass = each(0.1, -0.1), length = each(m, (1, 2))) * 2,
        d: generations(count = 2, shape = rod, mass = each(1, 2), length = 1) * 2,
        e: rod(mass = each() + 1, length = each(1, 2) * 2) * 2,
    ])] struct Pendulum;",
    ),
    (
        "unequal_copies",
        "#[branched_pendulum(gravity = 9.8,
    a: rod(mass = 1, length = 1) [
        b: rod(mass = each(0.1, 0.2), length = 0.3) * 2, c: rod(mass = 1, length = 1),
    ],
    emit(transfer(exact, angle = 1, amplitude = 2), budget),
    in_phase(b), locked(c, 0.1))] struct Pendulum;",
    ),
    // Observables.
    (
        "observables",
        "#[branched_pendulum(gravity = g, a: rod(mass = weight, length = 1) [ b: rod(mass = 1, length = 1) * 2 ],
    observe(
        first = theta_b_3 + omega_a * p_c,
        second = whatever * pi,
        third = tan(theta_a) + sine(theta_a) + sin(cosine),
        fourth = theta_d / (theta_a - theta_a) + (omega_a - omega_a)^-1,
        fifth = 1 / 0 + sqrt(-2) + 1e400 * theta_a,
        sixth = theta_a * 1e300 * omega_a * 1e300,
    ))] struct Pendulum;",
    ),
    (
        "observable_names",
        "#[branched_pendulum(gravity = g, a: rod(mass = p_b_1, length = 1) [ b: rod(mass = 1, length = 1) * 2 ],
    observe(
        a = theta_a,
        theta_a = 2,
        g = theta_a,
        twist = theta_a,
        twist = omega_a,
        twist_rate = omega_a,
        hamiltonian = p_a,
        transfer_exact_d = p_a,
        inertia_b = p_a,
        loop = p_a,
        Twist = p_b_1,
        no_equals theta_a,
        no_value =,
        no_argument = sin(),
    ), observe())] struct Pendulum;",
    ),
    (
        "lateral_transfer",
        "#[branched_pendulum(gravity = 1, a: rod(mass = 1, length = 1) [
        b(mass = 1, com = (0.04, 0.03), inertia = 1) * 2
    ],
    emit(transfer(exact)))] struct Pendulum;",
    ),
    (
        "reductions",
        "#[branched_pendulum(gravity = 1,
    a: rod(mass = 1, length = 1) [
        b: rod(mass = 1, length = 1, friction = 1, spring = 1) [c: rod(mass = 1, length = 1) * 2]
    ],
    in_phase(c, d, b, c),
    locked(a, 0), locked(b, 0), locked(c, 90), locked(c, tilt), locked(e, 0),
    )] struct Pendulum;",
    ),
    (
        "prescribed",
        "#[branched_pendulum(gravity = 1,
    a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2],
    prescribed(), prescribed(b_3, a, a), prescribed(b), prescribed(b_1, b_2), prescribed(b_1, b_2),
    )] struct Pendulum;",
    ),
    (
        "spring_dampers",
        "#[branched_pendulum(gravity = 1,
    a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2],
    between(b_1, b_2, spring = 1), between(a, a, friction = 1), between(a, c, spring = 1), between(a, b_1),
    between(a, b_1, rest = 1), between(a, b_1, spring = 1, drag = 1), siblings(b, spring = 1, rest = 1),
    siblings(a, spring = 1), siblings(a, b, spring = 1), siblings(b, friction(width = 1)),
    between(a, b_1, spring = each(1, 2)),
    )] struct Pendulum;",
    ),
    (
        "straight_springs",
        "#[branched_pendulum(gravity = 1,
    a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2],
    between(a, b_1, at = 0.5), between(a, b_1, at = 1, rest = 1, friction = 1),
    between(a, b_1, at = each(1, 0), spring = 1), siblings(b, at = each(1, 2), spring = 1),
    between(a, c, at = 1, spring = 1), siblings(b, at = 1, spring = -1),
    between(a, b_1, at = 1, spring = 1, friction(coulomb = 1)), between(a, b_1, at = 1, to = (1, 0), spring = 1),
    between(a, b_1, at = 1, spring = each(1, 2)), siblings(b, at = 1, at = 2, spring = 1),
    guy(a, spring = 1), guy(a, at = 1, to = 1, spring = 1), guy(a, b_1, at = 1, to = (1, 0), spring = 1),
    )] struct Pendulum;",
    ),
    (
        "repulsions",
        "#[branched_pendulum(gravity = 1,
    a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2],
    between(a, b_1, at = 1, repulsion = 1), between(a, b_1, at = 1, exponent = 3), between(a, b_1, repulsion = 1),
    siblings(b, at = 1, repulsion = 1, exponent = 0), siblings(b, at = 1, repulsion = 1, exponent = -1),
    guy(a, at = 1, to = (1, 0), repulsion = 1, exponent = 1.5), guy(a, at = 1, to = (1, 0), repulsion = 1, exponent = n),
    siblings(b, at = 1, repulsion = 1, exponent = 13), siblings(b, at = 1, repulsion = 1, exponent = (1, 2)),
    siblings(b, at = 1, repulsion = each(1, 2), exponent = 3), guy(a, at = 1, repulsion = 1, exponent = 3),
    siblings(b, at = 1, repulsion = 1e31, exponent = 3), siblings(b, at = 1, repulsion = 1, exponent = 3, rest = 1),
    between(a, b_1, at = each(1, 0), repulsion = 1, exponent = 3))] struct Pendulum;",
    ),
    (
        "repulsions_beside_symmetric",
        "#[branched_pendulum(gravity = 1,
    a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2],
    between(a, b_1, at = each(1, 0), repulsion = 1, exponent = 3),
    siblings(b, at = 1, repulsion = 1, exponent = 3, spring = 1), emit(symmetric))] struct Pendulum;",
    ),
    (
        "repulsions_of_merged_links",
        "#[branched_pendulum(gravity = 1,
    a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2],
    siblings(b, at = 1, repulsion = 1, exponent = 3), in_phase(b))] struct Pendulum;",
    ),
    (
        "repulsions_by_scale",
        "#[branched_pendulum(gravity = 1, emit(budget(parseval, scales)),
    a: generations(count = 3, branching = 2, mass = 1, com = 1, inertia = 1, joint = 2),
    siblings(a_3, at = 1, repulsion = 1, exponent = 3))] struct Pendulum;",
    ),
    (
        "straight_springs_that_stay",
        "#[branched_pendulum(gravity = 1,
    a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2],
    between(a, b_1, at = each(1, 0), spring = 1), guy(b_1, at = 1, to = (1, 0), spring = 1),
    siblings(b, at = 1, spring = 1), drive(x = t), emit(symmetric))] struct Pendulum;",
    ),
    (
        "straight_springs_beside_transfer",
        "#[branched_pendulum(gravity = 1,
    a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 3],
    siblings(b, at = 1, spring = 1), siblings(b, at = 1, spring = 1, rest = l),
    siblings(b, at = 1, friction = 1), siblings(b, at = 1, spring = 1, repulsion = 1, exponent = 3),
    guy(b_1, at = 1, to = (3, 0), spring = 1), between(a, b_1, at = 0.5, spring = 1),
    between(b_1, b_2, at = each(1, 0.5), spring = 1), between(b_2, b_3, at = 1, spring = 1),
    emit(transfer(exact)))] struct Pendulum;",
    ),
    (
        "straight_springs_beside_a_budget",
        "#[branched_pendulum(gravity = 1,
    a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) [c: rod(mass = 1, length = 1) * 2,
        d: rod(mass = 1, length = 1, at = each(0.4, 0.5)) * 2] * 2],
    between(c_1_1, c_2_1, at = 1, spring = 1), siblings(d, at = 1, spring = 1), emit(budget(parseval)))] struct Pendulum;",
    ),
    (
        "straight_springs_of_merged_links",
        "#[branched_pendulum(gravity = 1,
    a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2],
    siblings(b, at = 1, spring = 1), in_phase(b))] struct Pendulum;",
    ),
    (
        "straight_springs_by_scale",
        "#[branched_pendulum(gravity = 1, emit(budget(parseval, scales)),
    a: generations(count = 3, branching = 2, mass = 1, com = 1, inertia = 1, joint = 2),
    siblings(a_3, at = 1, spring = 1))] struct Pendulum;",
    ),
    (
        "spring_dampers_in_phase",
        "#[branched_pendulum(gravity = 1,
    a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2],
    siblings(b, spring = 1), between(a, b, spring = 1), in_phase(b))] struct Pendulum;",
    ),
    (
        "siblings_beside_a_lock",
        "#[branched_pendulum(gravity = 1,
    a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) [c: rod(mass = 1, length = 1) * 2] * 2],
    siblings(c, spring = 1), locked(b, 0))] struct Pendulum;",
    ),
    (
        "prescribed_in_loops",
        "#[branched_pendulum(gravity = 1, code = loops,
    a: generations(count = 3, branching = 2, mass = 1, com = 1, inertia = 1, joint = 2),
    prescribed(a_1, a_2_2, a_3_2_1), prescribed(a_2), prescribed(a_3_1_3, a_3_1_1_1), prescribed(a_2_02))]
    struct Pendulum;",
    ),
    (
        "no_transverse",
        "#[branched_pendulum(gravity = 1,
    a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2], emit(transverse))] struct Pendulum;",
    ),
    (
        "small",
        "#[branched_pendulum(gravity = 1,
    a: rod(mass = 1, length = 1) [bone: rod(mass = 1, length = 1) * 2, c: rod(mass = 1, length = 1)],
    in_phase(bone), emit(small(bon, c, bone, bone, bone(a))))] struct Pendulum;",
    ),
    (
        "small_of_none",
        "#[branched_pendulum(gravity = 1,
    a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2],
    emit(small(), taylor))] struct Pendulum;",
    ),
    (
        "nothing_in_phase",
        "#[branched_pendulum(gravity = 1, a: rod(mass = 1, length = 1), in_phase(all))] struct Pendulum;",
    ),
    (
        "locked_generation",
        "#[branched_pendulum(gravity = 1,
    a: generations(count = 7, branching = 2, shape = rod, mass = 1, length = 1),
    locked(a_3, 0))] struct Pendulum;",
    ),
];
