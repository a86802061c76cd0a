//! The constants of a model: in lowest terms, each once, under names that say what they are.

use branched_pendulum_codegen::Stages;
use branched_pendulum_codegen::program::ConstantOp;
use branched_pendulum_compiler_tests::source::{scene, stages_of};
use std::collections::BTreeSet;

/// The stages of a tree under the gravity of the Earth.
fn tree(description: &str) -> Stages {
    stages_of(&format!(
        "#[branched_pendulum(gravity = 9.80665, {description})] struct Tree;"
    ))
}

/// The values of constants as the mechanics show them, without units and meanings.
fn values(stages: &Stages) -> Vec<String> {
    let mechanics = stages.mechanics.to_string();
    let constants = mechanics.lines().filter(|line| line.contains(" [kg m²]: "));
    let values = constants.map(|line| line.split(" [").next().unwrap_or_default().trim());
    values.map(str::to_owned).collect()
}

/// The centre of mass of a rod with a bob is a quotient, its moment of inertia is none.
#[test]
fn quotients_are_cancelled() {
    let mixed = tree("a: rod_with_bob(mass = 0.4, length = 0.5, bob_mass = m)");
    assert_eq!(values(&mixed), ["M_a = 1 / 30 + 0.25 m"]);
    let named = tree("a: rod_with_bob(mass = m, length = l, bob_mass = b)");
    assert_eq!(values(&named), ["M_a = m l² / 3 + l² b"]);
    let equal = tree("a(mass = m * n, com = l / (m + n), inertia = 2 * m * n * l^2 / (m + n)^2)");
    assert_eq!(values(&equal), ["M_a = 3 m n l² / (2 m n + m² + n²)"]);
}

/// What does not cancel stays the sum or the quotient that is shorter.
#[test]
fn other_quotients_are_short() {
    for (inertia, value) in [
        ("x / m", "M_a = x / m"),
        ("x + 0.25 / m", "M_a = x + 0.25 / m"),
        ("x / (0.4 + m)", "M_a = x / (0.4 + m)"),
        (
            "x / (m + 0.4) + 0.5 * m / (0.4 + m)",
            "M_a = (x + 0.5 m) / (0.4 + m)",
        ),
        ("x / (2 - m)", "M_a = −x / (−2 + m)"),
        ("x * (m^2 - 1) / (m - 1)", "M_a = x + x m"),
        ("x / 3 + m / 8", "M_a = x / 3 + 0.125 m"),
    ] {
        let found = tree(&format!("a(mass = 1, com = 0, inertia = {inertia})"));
        assert_eq!(values(&found), [value]);
    }
}

/// Two rods that differ in the angles alone at which their springs are at rest.
const HAND: &str = "arm: rod_with_bob(mass = 0.4, length = 0.5, bob_mass = payload) [
        finger: rod(mass = 0.05, length = 0.2, friction = 1e-4, spring = 0.1, rest = each(0.3, -0.3)) * 2
    ],
    emit(energies, momenta, modes, symmetric, positions, transfer(exact))";

/// The names of the fields of a model, and of the functions that read them.
fn fields_and_functions(stages: &Stages) -> (Vec<String>, BTreeSet<String>) {
    let file: syn::File = syn::parse2(stages.tokens().clone()).expect("emitted code is Rust");
    let (mut fields, mut functions) = (Vec::new(), BTreeSet::new());
    for item in file.items {
        match item {
            syn::Item::Struct(item) if !item.ident.to_string().ends_with("Parameters") => {
                let names = item.fields.iter().filter_map(|field| field.ident.as_ref());
                fields.extend(names.map(|name| name.to_string()));
            }
            syn::Item::Impl(item) if item.trait_.is_none() => {
                functions.extend(item.items.iter().filter_map(|item| match item {
                    syn::ImplItem::Fn(function) => Some(function.sig.ident.to_string()),
                    _ => None,
                }));
            }
            _ => {}
        }
    }
    (fields, functions)
}

#[test]
fn equal_constants_are_one_field() {
    let stages = tree(HAND);
    let setup = &stages.program.setup;
    let mut seen = BTreeSet::new();
    for (_, definition) in setup.iter() {
        if let ConstantOp::Named(index, formed) = definition.op {
            let unit = stages.mechanics.constants[index].unit;
            let first = seen.insert((setup.get(formed).op.clone(), unit));
            assert!(first, "{} is there twice", definition.name);
        }
    }
    let (fields, functions) = fields_and_functions(&stages);
    // 55 with each constant of each copy, and 34 with what a quotient left uncancelled.
    assert_eq!(fields.len(), 32, "{fields:#?}");
    // Every letter is read by its own name.
    for letter in ["inertia_finger", "inertia_finger_1", "inertia_finger_2"] {
        assert!(functions.contains(letter), "{letter}");
    }
    assert!(!fields.contains(&"inertia_finger_1".to_owned()));
}

#[test]
fn names_read() {
    let mut numbered = Vec::new();
    for name in [
        "paper",
        "triplet",
        "unequal",
        "nested",
        "observed",
        "driven",
        "branch",
        "generations",
        "sweep",
    ] {
        let (fields, _) = fields_and_functions(&scene(name));
        let longest = fields.iter().max_by_key(|field| field.len());
        assert!(
            longest.is_some_and(|field| field.len() <= 72),
            "{name}: {longest:?}"
        );
        let plain = fields
            .into_iter()
            .filter(|field| field.starts_with("constant_"));
        numbered.extend(plain.map(|field| format!("{name}: {field}")));
    }
    // Multipliers of an elimination times the inverse of another of its inertias.
    assert!(numbered.len() <= 6, "{numbered:#?}");
    let (fields, _) = fields_and_functions(&tree(HAND));
    assert!(
        !fields.iter().any(|field| field.contains("plus")),
        "{fields:#?}"
    );
}
