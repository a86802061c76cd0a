//! Every message, as a user sees it.

use std::collections::BTreeSet;

use crate::support::{errors, run_source};

/// The name of a golden and the source with the mistake.
const CASES: &[(&str, &str)] = &[
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
    // Links.
    (
        "unknown_shape",
        "#[branched_pendulum(gravity = 9.8, a: rdo(mass = 1) [ b: banana(mass = 1) ])] struct Pendulum;",
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
    // Values.
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
        "singular",
        "#[branched_pendulum(gravity = 9.8, trunk: rod(mass = 1, length = 1) [
    massless_leaf: rod(mass = 0, length = 1),
    massless_arm: rod(mass = 0, length = 1) [ bob: point(mass = 0.1, length = 1) ],
    hung_at_its_centre(mass = 1, com = 0, inertia = 0),
])] struct Pendulum;",
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
        "not_exact",
        "#[branched_pendulum(gravity = pi^2, a: rod(mass = 1, length = tau))] struct Pendulum;",
    ),
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
        "budget_without_siblings",
        "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1, length = 1), emit(budget))] struct Pendulum;",
    ),
    (
        "nested_groups",
        "#[branched_pendulum(gravity = 1,
    a: generations(count = 3, branching = 2, shape = rod, mass = 1, length = 1),
    emit(transfer(exact)))] struct Pendulum;",
    ),
    // Observables.
    (
        "observables",
        "#[branched_pendulum(gravity = g, a: rod(mass = theta_b, length = 1) [ b: rod(mass = 1, length = 1) * 2 ],
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
        "#[branched_pendulum(gravity = g, a: rod(mass = theta_b_1, length = 1) [ b: rod(mass = 1, length = 1) * 2 ],
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
        Twist = theta_b_1,
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
];

/// A source with brackets deeper than any tree needs.
fn nested_too_deeply() -> String {
    let (open, close) = ("(".repeat(65), ")".repeat(65));
    format!(
        "#[branched_pendulum(gravity = {open}1{close}, a: rod(mass = 1, length = 1))] struct Pendulum;"
    )
}

#[test]
fn messages_read_as_in_the_goldens() {
    for (name, source) in CASES {
        insta::assert_snapshot!(*name, errors(source));
    }
    insta::assert_snapshot!("nesting", errors(&nested_too_deeply()));
}

/// One that adds a message adds a golden.
#[test]
fn every_message_has_a_golden() {
    let catalogue = include_str!("../../../codegen/src/report/message.rs");
    let catalogue = syn::parse_file(catalogue).expect("the catalogue is Rust");
    let messages: BTreeSet<String> = catalogue
        .items
        .iter()
        .filter_map(|item| match item {
            syn::Item::Enum(item) if item.ident == "Message" => Some(&item.variants),
            _ => None,
        })
        .flatten()
        .map(|variant| variant.ident.to_string())
        .collect();
    assert!(!messages.is_empty());
    // The front end does not run the algebra.
    let messages: BTreeSet<String> = messages
        .into_iter()
        .filter(|name| name != "Algebra" && name != "ConstantRange")
        .collect();
    let deep = nested_too_deeply();
    let sources = CASES
        .iter()
        .map(|(_, source)| *source)
        .chain([deep.as_str()]);
    let seen: BTreeSet<String> = sources
        .flat_map(|source| {
            let report = run_source(source).report;
            let diagnostics = report.diagnostics().iter();
            let named = diagnostics.map(|diagnostic| {
                let shown = format!("{:?}", diagnostic.message);
                let end = shown.find([' ', '(', '{']).unwrap_or(shown.len());
                shown[..end].to_owned()
            });
            named.collect::<Vec<_>>()
        })
        .collect();
    assert_eq!(seen, messages);
}

/// Compile errors carry the text and the hint.
#[test]
fn compile_errors_say_the_same() {
    let source = "#[branched_pendulum(a: rod(mass = -1, length = 1))] struct Pendulum;";
    let report = run_source(source).report;
    insta::assert_snapshot!(report.to_compile_errors());
}

/// The deepest brackets that are allowed fit the stack of a test's thread.
#[test]
fn deepest_nesting_is_read() {
    let (open, close) = ("(".repeat(64), ")".repeat(64));
    let values = format!(
        "#[branched_pendulum(gravity = {open}1{close}, a: rod(mass = 1, length = 1))] struct Deep;"
    );
    assert!(run_source(&values).scene.is_some());
    let mut links = String::from("l0: rod(mass = 1, length = 1)");
    for i in 1..64 {
        links = format!("l{i}: rod(mass = 1, length = 1) [ {links} ]");
    }
    let links = format!("#[branched_pendulum(gravity = 1, {links})] struct Deep;");
    let scene = run_source(&links).scene;
    assert_eq!(scene.map(|scene| scene.links.len()), Some(64));
}

/// What only the derivation knows to be zero is refused at its place too.
#[test]
fn divisors_that_vanish_in_the_model() {
    let source = "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1, length = 1),
        observe(fine = 1 / inertia_a, bad = theta_a + omega_a / lateral_gravity_a))]
        struct Pendulum;";
    let (attribute, item) = crate::support::split(source);
    let report = match branched_pendulum_codegen::stages(attribute, item) {
        Err((report, _)) => report,
        Ok(_) => panic!("accepted a division by zero"),
    };
    insta::assert_snapshot!("vanishing_divisor", report.render(source));
}

/// Values that a product of literals takes out of range are refused, and do
/// not end the compiler.
#[test]
fn constants_out_of_range() {
    for (name, values) in [
        (
            "constant_overflow",
            "gravity = 1e200, a: rod(mass = 1e200, length = 1)",
        ),
        (
            "observable_underflow",
            "gravity = 1, a: rod(mass = 1, length = 1),
             observe(tiny = 1e-200 * theta_a * 1e-200 * omega_a)",
        ),
        (
            "constant_underflow",
            "gravity = 1e-200, a: rod(mass = 1e-200, length = 1)",
        ),
    ] {
        let source = format!("#[branched_pendulum({values})] struct Pendulum;");
        let (attribute, item) = crate::support::split(&source);
        let report = match branched_pendulum_codegen::stages(attribute, item) {
            Err((report, _)) => report,
            Ok(_) => panic!("accepted {values}"),
        };
        insta::assert_snapshot!(name, report.render(&source));
    }
}
