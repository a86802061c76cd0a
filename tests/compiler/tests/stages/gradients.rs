//! Emitted derivatives in reverse mode.

use crate::snapshots::{emitted_functions, function};
use branched_pendulum_compiler_tests::source::{fixture, scene, stages_of};

#[test]
fn derivatives_are_readable() {
    let stages = scene("gradients");
    for name in [
        "accelerations_under_pullback",
        "potential_energy_gradient",
        "reach_gradient",
    ] {
        insta::assert_snapshot!(name, function(stages.tokens(), name));
    }
    let operations = stages.program.entries.iter().map(|entry| {
        let operations = stages.program.operations(&entry.outputs);
        format!("{:<31} {operations}\n", entry.name)
    });
    insta::assert_snapshot!("operations", operations.collect::<String>());
}

/// A request for derivatives changes no token of the functions that are differentiated.
#[test]
fn functions_do_not_depend_on_their_derivatives() {
    for name in ["gradients", "paper", "observed", "driven", "nested"] {
        let path = fixture(&format!("scenes/{name}.rs"));
        let text = std::fs::read_to_string(path).expect("the fixture exists");
        let without = text.replacen(", gradient", "", 1);
        let with = without.replacen("emit(", "emit(gradient, ", 1);
        let [without, with] = [without, with].map(|text| stages_of(&text));
        assert!(with.program.entries.len() > without.program.entries.len());
        let [before, after] = [&without, &with].map(|stages| emitted_functions(stages.tokens()));
        for entry in &without.program.entries {
            let named = |all: &[syn::ImplItemFn]| -> Option<syn::ImplItemFn> {
                all.iter().find(|own| own.sig.ident == entry.name).cloned()
            };
            let function = named(&before);
            assert!(function.is_some(), "`{}` of {name}", entry.name);
            assert!(function == named(&after), "`{}` of {name}", entry.name);
        }
    }
}
