//! Every message, as a user sees it.

use std::collections::BTreeSet;

use branched_pendulum_codegen::report::{
    OutputMessage, SizeMessage, SyntaxMessage, TreeMessage, ValueMessage,
};
use branched_pendulum_compiler_tests::front_end::{errors, run_source, split};
use branched_pendulum_compiler_tests::mistakes::mistakes;

/// A source with brackets deeper than any tree needs.
fn nested_too_deeply() -> String {
    let (open, close) = ("(".repeat(65), ")".repeat(65));
    format!(
        "#[branched_pendulum(gravity = {open}1{close}, a: rod(mass = 1, length = 1))] struct Pendulum;"
    )
}

#[test]
fn messages_read_as_in_the_goldens() {
    for (name, source) in mistakes() {
        insta::assert_snapshot!(name, errors(source));
    }
    insta::assert_snapshot!("nesting", errors(&nested_too_deeply()));
}

/// One that adds a message adds a golden.
#[test]
fn every_message_has_a_golden() {
    let catalogue = [
        OutputMessage::NAMES,
        SizeMessage::NAMES,
        SyntaxMessage::NAMES,
        TreeMessage::NAMES,
        ValueMessage::NAMES,
    ];
    let messages = catalogue.concat().into_iter();
    let messages: BTreeSet<String> = messages.map(str::to_owned).collect();
    assert!(!messages.is_empty());
    // The front end does not run the algebra; texts at run time are those of the package
    // `branched-pendulum-trees`.
    let messages: BTreeSet<String> = messages
        .into_iter()
        .filter(|name| {
            let elsewhere = [
                "Algebra",
                "ConstantRange",
                "TooManyTerms",
                "TooManyValues",
                "NoTokens",
                "NotAtRunTime",
                // The compiler's command line decides.
                "RenamedCrate",
            ];
            !elsewhere.contains(&name.as_str())
        })
        .collect();
    let deep = nested_too_deeply();
    let sources = mistakes().map(|(_, source)| source).chain([deep.as_str()]);
    let seen: BTreeSet<String> = sources
        .flat_map(|source| {
            let report = run_source(source).report;
            let diagnostics = report.diagnostics().iter();
            let named = diagnostics.map(|diagnostic| {
                // The part, and in parentheses the message.
                let shown = format!("{:?}", diagnostic.message);
                let (_, shown) = shown.split_once('(').expect("parts hold messages");
                let end = shown.find([' ', '(', ')', '{']).unwrap_or(shown.len());
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

/// A divisor that only the derivation knows to be zero is refused at its place
/// too.
#[test]
fn divisors_that_vanish_in_the_model() {
    let source = "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1, length = 1),
        observe(fine = 1 / inertia_a, bad = theta_a + omega_a / lateral_gravity_a))]
        struct Pendulum;";
    let (attribute, item) = split(source);
    let report = match branched_pendulum_codegen::stages(attribute, item) {
        Err((report, _)) => report,
        Ok(_) => panic!("accepted a division by zero"),
    };
    insta::assert_snapshot!("vanishing_divisor", report.render(source));
}

/// Formulas and code that would take too long are refused with the limit named.
#[test]
fn limits_of_the_derivation() {
    let source = "#[branched_pendulum(gravity = 9.8,
        a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 20],
        emit(transfer(angle = 8, amplitude = 8)))] struct Pendulum;";
    let (attribute, item) = split(source);
    let mut report = match branched_pendulum_codegen::stages(attribute, item) {
        Err((report, _)) => report,
        Ok(_) => panic!("accepted long formulas"),
    };
    // Provoked, it would take half a minute.
    let limit = branched_pendulum_codegen::program::MOST_VALUES;
    let span = report.diagnostics()[0].span;
    report.error(span, SizeMessage::TooManyValues { limit });
    insta::assert_snapshot!("limits", report.render(source));
}

/// Literals out of range, and what a product of literals takes out of range, are refused
/// and do not end the compiler.
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
            "constant_beside_a_parameter",
            "gravity = 1, a(mass = m, com = 1e200, inertia = 0)",
        ),
        (
            "constant_underflow",
            "gravity = 1e-200, a: rod(mass = 1e-200, length = 1)",
        ),
    ] {
        let source = format!("#[branched_pendulum({values})] struct Pendulum;");
        let (attribute, item) = branched_pendulum_compiler_tests::front_end::split(&source);
        let report = match branched_pendulum_codegen::stages(attribute, item) {
            Err((report, _)) => report,
            Ok(_) => panic!("accepted {values}"),
        };
        insta::assert_snapshot!(name, report.render(&source));
    }
}
