//! Mistakes in the item, the scene, its links and rules.

use super::Mistake;

pub(super) const MISTAKES: &[Mistake] = &[
    // The item.
    (
        "not_a_struct",
        "#[branched_pendulum(gravity = 1, a: rod(mass = 1, length = 1))] enum Pendulum {}",
    ),
    (
        "struct_fields",
        "#[branched_pendulum(gravity = 1, a: rod(mass = 1, length = 1))] struct Pendulum { x: f64 }",
    ),
    (
        "derived_default",
        "#[branched_pendulum(gravity = 1, a: rod(mass = 1, length = 1))]
#[derive(Debug, Clone, Copy, PartialEq, Default)] pub struct Pendulum;",
    ),
    (
        "derived_default_of_parameters",
        "#[branched_pendulum(gravity = 1, a: rod(mass = m, length = 1))]
#[derive(Debug)] #[derive(std::default::Default)] pub struct Pendulum;",
    ),
    (
        "derived_copy",
        "#[branched_pendulum(gravity = 1,
    a: generations(count = 7, branching = 2, shape = rod, mass = 1, length = 1))]
#[derive(Clone, Copy)] pub struct Pendulum;",
    ),
    (
        "struct_generics",
        "#[branched_pendulum(gravity = 1, a: rod(mass = 1, length = 1))] struct Pendulum<T>;",
    ),
    // The scene.
    (
        "expected",
        "#[branched_pendulum(
    gravity 9.8,
    a: rod(mass = 1, length 1),
    b: rod{mass = 1},
    = 2,
)] struct Pendulum;",
    ),
    (
        "colon",
        "#[branched_pendulum(
    gravity: 9.8,
    a: rod(mass: 1, length = 1),
)] struct Pendulum;",
    ),
    (
        "brackets",
        "#[branched_pendulum(gravity = 9.8,
    a: rod(mass = 1, length = 1) { b: rod(mass = 1, length = 1) },
    c: rod[mass = 1, length = 1],
    d { mass = 1 },
)] struct Pendulum;",
    ),
    (
        "missing_comma",
        "#[branched_pendulum(
    gravity = 9.8
    a: rod(mass = 1 length = m friction = 2) [ b: rod(mass = 1, length = 1) c: rod(mass = 1, length = 1) ],
    emit(energies momenta),
)] struct Pendulum;",
    ),
    (
        "unit",
        "#[branched_pendulum(gravity = 9.8 m/s^2, a: rod(mass = 1 kg, length = 2 * (3 m)))] struct Pendulum;",
    ),
    (
        "lookalike",
        "#[branched_pendulum(gravity = sin,
    a: rod(mass = 1, length = 1, joint = prismatic, drag = 0.1 * omega, friction = theta_a^2),
    drive(torque = exp * t),
)] struct Pendulum;",
    ),
    (
        "not_finite",
        "#[branched_pendulum(gravity = inf, a: rod(mass = -NaN, length = PI))] struct Pendulum;",
    ),
    (
        "long_number",
        "#[branched_pendulum(gravity = 9.8, a: rod(mass = -1e-300 / 3, length = 0x123456789012345678901234567890123456789012345678901234567890))] struct Pendulum;",
    ),
    (
        "ended",
        "#[branched_pendulum(
    gravity =,
    a: rod(mass = 1 +, length = 2 * (3 + )) [ b: rod ],
    emit(transfer(angle =)),
    crate
)] struct Pendulum;",
    ),
    (
        "unknown_entry",
        "#[branched_pendulum(gravty = 9.8, zeal = 1, a: rod(mass = 1, length = 1))] struct Pendulum;",
    ),
    (
        "misspelt_settings",
        "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1, length = 1),
    emitt(energies), emt(transfer(angle = 1), momenta), obsrve(x = theta_a), observ(h = cos(theta_a)),
    driv(torque = 1), drvie(x = 0.1 * cos(t)), in_phse(b), inphase(all), lockd(a, 0.3),
    perscribed(a), paramters(m, l), crat = ::bp, slove = recursion, cod = loops, emitt(),
    plots(energies), gravty(9.8), prescribd, betwen(a, b, spring = 1), sibling(b, spring = 1), gyu(a, at = 1),
)] struct Pendulum;",
    ),
    (
        "setting_forms",
        "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1, length = 1),
    emit = energies, observe = theta_a, drive = cos(t), locked = a, in_phase = all,
    parameters = (m, l), prescribed = [a], solve(recursion), code(loops), solve, emit = transfer(angle = 1),
)] struct Pendulum;",
    ),
    (
        "link_by_equals",
        "#[branched_pendulum(gravity = 9.8,
    a = rod(mass = 1, length = 1),
    tree = generations(count = 3, shape = rod, mass = 1, length = 1),
    b: rod(mass = 1, length = 1) [ c = disc(mass = 1, radius = 1, length = 1) * 2, d = rdo(length = 1) ],
    rod = rod(mass = 1, length = 1),
    e = 3,
)] struct Pendulum;",
    ),
    (
        "not_an_entry",
        "#[branched_pendulum(gravity = 9.8, 2 * a: rod(mass = 1, length = 1), -1, (b: rod(mass = 1)),
    c: rod(mass = 1, length = 1) [ 2 * d: rod(mass = 1, length = 1), 'e' ], = 2, ::bp,
)] struct Pendulum;",
    ),
    (
        "quoted",
        "#[branched_pendulum(\"gravity = 9.8, rod: rod(mass = 1, length = 1)\")] struct Pendulum;",
    ),
    (
        "lone_name",
        "#[branched_pendulum(gravity = 9.8, rod, a: rod(mass = 1, length = 1) [ tip, b * 2 ], bob)] struct Pendulum;",
    ),
    (
        "not_copies",
        "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1, length = 1) [
    b: rod(mass = 1, length = 1) * n,
    c: rod(mass = 1, length = 1) * -1,
    d: rod(mass = 1, length = 1) * 2.5,
    e: rod(mass = 1, length = 1) * (1 + 1),
    f: rod(mass = 1, length = 1) * \"2\",
    g: rod(mass = 1, length = 1) * 2 * 3,
    h: rod(mass = 1, length = 1) *,
])] struct Pendulum;",
    ),
    (
        "missing_gravity",
        "#[branched_pendulum(a: rod(mass = 1, length = 1))] struct Pendulum;",
    ),
    ("empty_tree", "#[branched_pendulum(gravity = 9.8)] struct Pendulum;"),
    (
        "second_root",
        "#[branched_pendulum(
    gravity = 9.8,
    a: rod(mass = 1, length = 1),
    b: rod(mass = 1, length = 1),
)] struct Pendulum;",
    ),
    (
        "root_copies",
        "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1, length = 1) * 2)] struct Pendulum;",
    ),
    (
        "duplicate_property",
        "#[branched_pendulum(
    gravity = 9.8,
    gravity = 9.81,
    a: rod(mass = 1, length = 1, mass = 2),
    emit(energies),
    emit(momenta),
    crate = a,
    crate = b,
)] struct Pendulum;",
    ),
    // Names.
    (
        "duplicate_name",
        "#[branched_pendulum(
    gravity = 9.8,
    a: rod(mass = child, length = 1) [
        child: rod(mass = 1, length = 1) * 2,
        child: rod(mass = 1, length = 1),
        child_1: rod(mass = 1, length = 1),
        arm: rod(mass = 1, length = 1) [ hand: rod(mass = 1, length = 1) * 2 ] * 2,
        hand_1: rod(mass = 1, length = 1),
    ],
)] struct Pendulum;",
    ),
    (
        "reserved_name",
        "#[branched_pendulum(gravity = 9.8, loop: rod(mass = type, length = 1) [
    state: rod(mass = 1, length = 1),
])] struct T;",
    ),
    (
        "not_snake_case",
        "#[branched_pendulum(gravity = 9.8, upperArm: rod(mass = M, length = r#type) [
    hand__left: rod(mass = 1, length = ℓ),
    _x: rod(mass = 1, length = 1),
])] struct Pendulum;",
    ),
    (
        "rust_constant",
        "#[branched_pendulum(gravity = G, a: rod(mass = std::f64::consts::PI, length = ::mine::MASS_1) [
    b: rod(mass = 2 * crate::M, length = 1 + Self::L),
    c: rod(mass = L_2 / 2, length = 1),
])] struct Pendulum;",
    ),
    // Links.
    (
        "unknown_shape",
        "#[branched_pendulum(gravity = 9.8, a: rdo(mass = 1) [ b: banana(mass = 1), c: sphere(mass = 1) ])] struct Pendulum;",
    ),
    (
        "shape_without_name",
        "#[branched_pendulum(gravity = 9.8, rod(mass = 0.1, length = 0.3) [
    disc(mass = 1, radius = 0.1) * 2,
    generations(count = 3, shape = rod, mass = 1, length = 1),
    rod_with_bob(bob_mass = 1),
])] struct Pendulum;",
    ),
    (
        "shape_forgotten",
        "#[branched_pendulum(gravity = 9.8, arm(mass = 0.1, length = 0.3) [
    bob(mass = 1, length = 1) * 2,
    rdo(mass = 1, length = 1),
    plat(mass = 1, com = 1, width = 1),
])] struct Pendulum;",
    ),
    (
        "unknown_property",
        "#[branched_pendulum(gravity = 9.8, a: rod(mas = 1, length = 1) [
    b(mass = 1, com = 1, inertia = 0, length = 1),
    c: generations(count = 2, shape = rod, mass = 1, length = 1, depth = 2),
])] struct Pendulum;",
    ),
    (
        "missing_property",
        "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1) [
    b(mass = 1),
    c: generations(shape = disc, mass = 1, length = 1),
])] struct Pendulum;",
    ),
    (
        "missing_joint",
        "#[branched_pendulum(gravity = 9.8, a(mass = 1, com = 1, inertia = 0) [
    b: rod(mass = 1, length = 1),
    c: generations(count = 2, mass = 1, com = 1, inertia = 1),
])] struct Pendulum;",
    ),
    (
        "root_pivot",
        "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1, length = 1, at = 1))] struct Pendulum;",
    ),
    (
        "not_a_point",
        "#[branched_pendulum(gravity = (9.8, 0), a: rod(mass = (1, 2), length = 1))] struct Pendulum;",
    ),
    // Rules.
    (
        "rule_children",
        "#[branched_pendulum(gravity = 9.8,
    a: generations(count = 2, shape = rod, mass = 1, length = 1) [ b: rod(mass = 1, length = 1) ]
)] struct Pendulum;",
    ),
    (
        "not_a_count",
        "#[branched_pendulum(gravity = 9.8,
    a: generations(count = 0, branching = n, shape = rod, mass = 1, length = 1)
)] struct Pendulum;",
    ),
    (
        "open_branching",
        "#[branched_pendulum(gravity = 9.8,
    trunk: rod(mass = 1, length = 1) [
        a: generations(count = 4, branching = 2, open = 2, shape = rod, mass = 1, length = 1),
        b: generations(count = 4, branching = 3, open = 1, shape = rod, mass = 1, length = 1),
        c: generations(count = 33, branching = 2, open = 1, shape = rod, mass = 1, length = 1),
        d: generations(count = 4, branching = 2, open = 1, shape = rod, mass = 1, length = 1),
    ]
)] struct Pendulum;",
    ),
    (
        "open_combined",
        "#[branched_pendulum(gravity = 9.8,
    a: generations(count = 3, branching = 2, open = 1, shape = rod, mass = 1, length = 1),
    between(a_1, a_3_2, spring = 1), guy(a_2_1, at = 1, to = (1, 1), spring = 1), siblings(a_1, spring = 1),
    emit(symmetric),
)] struct Pendulum;",
    ),
    (
        "not_a_shape",
        "#[branched_pendulum(gravity = 9.8,
    a: generations(count = 2, shape = 3, mass = 1, length = 1)
)] struct Pendulum;",
    ),
    (
        "too_many_links",
        "#[branched_pendulum(gravity = 9.8,
    a: generations(count = 13, branching = 2, shape = rod, mass = 1, length = 1, code = unrolled)
)] struct Pendulum;",
    ),
    (
        "too_many_pairs",
        "#[branched_pendulum(gravity = 9.8,
    a: generations(count = 111, branching = 1, shape = rod, mass = 1, length = 1, code = unrolled)
)] struct Pendulum;",
    ),
    (
        "not_a_code",
        "#[branched_pendulum(gravity = 9.8,
    a: generations(count = 3, branching = 2, shape = rod, mass = 1, length = 1, code = loop)
)] struct Pendulum;",
    ),
    (
        "no_loops",
        "#[branched_pendulum(gravity = 9.8,
    a: generations(count = 3, branching = 2, shape = rod, mass = 1, length = 1, code = loops),
    emit(modes)
)] struct Pendulum;",
    ),
    (
        "too_many_for_unrolled",
        "#[branched_pendulum(gravity = 9.8,
    a: generations(count = 13, branching = 2, shape = rod, mass = 1, length = 1),
    emit(modes)
)] struct Pendulum;",
    ),
    (
        "zero_copies",
        "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1, length = 1) [
    b: rod(mass = 1, length = 1) * 0
])] struct Pendulum;",
    ),
];
