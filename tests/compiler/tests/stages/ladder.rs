//! A ladder of scenes, each with one demand more: each step adds functions of
//! its own and leaves those of the step before as they are.

use std::collections::BTreeMap;
use std::fmt::Write;

use branched_pendulum_codegen::Stages;
use branched_pendulum_compiler_tests::source::{fixture, stages_of};
use proc_macro2::{TokenStream, TokenTree};
use quote::ToTokens;

/// A demand: its name, whether there is friction, what is asked for, and the
/// functions of the step before that it changes.
struct Step {
    name: &'static str,
    friction: bool,
    requests: &'static str,
    changes: &'static [&'static str],
}

const LADDER: [Step; 8] = [
    Step {
        name: "accelerations",
        friction: false,
        requests: "",
        changes: &[],
    },
    Step {
        name: "friction",
        friction: true,
        requests: "",
        changes: &["accelerations"],
    },
    Step {
        name: "energies",
        friction: true,
        requests: "energies",
        changes: &[],
    },
    Step {
        name: "positions",
        friction: true,
        requests: "energies, positions",
        changes: &[],
    },
    Step {
        name: "outside forces",
        friction: true,
        requests: "energies, positions, forces",
        changes: &[],
    },
    Step {
        name: "symmetric coordinates",
        friction: true,
        requests: "energies, positions, forces, symmetric",
        changes: &[],
    },
    Step {
        name: "one W",
        friction: true,
        requests: "energies, positions, forces, symmetric, transfer(amplitude = 2)",
        changes: &[],
    },
    Step {
        name: "all W",
        friction: true,
        requests: "energies, positions, forces, symmetric, transfer(angle = 1, amplitude = 2, amplitude = 4, exact)",
        changes: &[],
    },
];

impl Step {
    fn stages(&self) -> Stages {
        let friction = |size: &str| match self.friction {
            true => format!(", friction = {size}"),
            false => String::new(),
        };
        let emit = match self.requests {
            "" => String::new(),
            requests => format!("emit({requests})"),
        };
        stages_of(&format!(
            "#[branched_pendulum(
                gravity = 9.80665,
                parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27{}) [
                    child(mass = 0.10531, com = 0.043, inertia = 0.516e-3{}) * 2
                ],
                {emit}
            )] struct Ladder;",
            friction("1e-4"),
            friction("3.5e-5"),
        ))
    }
}

/// The tokens of each function of an entry point, docs included.
fn functions(stages: &Stages) -> BTreeMap<String, String> {
    let file: syn::File = syn::parse2(stages.tokens().clone()).expect("emitted code is Rust");
    let mut functions = BTreeMap::new();
    for item in file.items {
        let syn::Item::Impl(block) = item else {
            continue;
        };
        for member in block.items {
            if let syn::ImplItem::Fn(function) = member {
                let name = function.sig.ident.to_string();
                if stages.program.entry(&name).is_some() && block.trait_.is_none() {
                    functions.insert(name, function.to_token_stream().to_string());
                }
            }
        }
    }
    functions
}

#[test]
fn each_step_adds_its_own_functions_and_nothing_else() {
    let mut before: BTreeMap<String, String> = BTreeMap::new();
    let mut table = String::from("| demand | adds | operations |\n|---|---|---|\n");
    for step in &LADDER {
        let stages = step.stages();
        let now = functions(&stages);
        assert_eq!(now.len(), stages.program.entries.len(), "{}", step.name);
        for (name, tokens) in &before {
            let kept = now.get(name).unwrap_or_else(|| panic!("{name} is gone"));
            let changes = step.changes.contains(&name.as_str());
            assert_eq!(kept != tokens, changes, "{name} at {}", step.name);
        }
        let mut demand = step.name;
        for entry in &stages.program.entries {
            let changed = step.changes.contains(&entry.name.as_str());
            if before.contains_key(&entry.name) && !changed {
                continue;
            }
            let operations = stages.program.operations(&entry.outputs);
            let what = if changed { " (changed)" } else { "" };
            let _ = writeln!(
                table,
                "| {demand} | `{}`{what} | {operations} |",
                entry.name
            );
            demand = "";
        }
        assert!(now.len() > before.len() || !step.changes.is_empty());
        before = now;
    }
    let page = std::fs::read_to_string(fixture("../../docs/pipeline.md")).expect("it exists");
    assert!(
        page.contains(&table),
        "docs/pipeline.md should hold\n{table}"
    );
}

/// Words in names, docs aside.
fn identifiers(tokens: TokenStream, found: &mut Vec<String>) {
    for tree in tokens {
        match tree {
            TokenTree::Ident(name) => found.push(name.to_string()),
            TokenTree::Group(group) => identifiers(group.stream(), found),
            TokenTree::Punct(_) | TokenTree::Literal(_) => {}
        }
    }
}

#[test]
fn without_friction_there_is_no_symbol_of_it() {
    let all =
        "energies, momenta, modes, symmetric, transfer(angle = 1, amplitude = 2, exact), taylor";
    for friction in [false, true] {
        let step = Step {
            name: "",
            friction,
            requests: all,
            changes: &[],
        };
        let stages = step.stages();
        let symbols = stages.mechanics.symbols.iter();
        let mut names: Vec<String> = symbols.map(|(_, symbol)| symbol.code.clone()).collect();
        identifiers(stages.tokens().clone(), &mut names);
        let any = |word: &str| names.iter().any(|name| name.contains(word));
        assert_eq!(any("friction"), friction);
        assert!(!any("drag") && !any("spring") && !any("drive"));
    }
}
