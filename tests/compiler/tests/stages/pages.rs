//! Pages of `docs/` that show output show the output of today.

use branched_pendulum_codegen::program::worth;
use branched_pendulum_compiler_tests::source::{fixture, scene, stages_of};

#[test]
fn pipeline_shows_every_stage() {
    let page = std::fs::read_to_string(fixture("../../docs/pipeline.md")).expect("it exists");
    let source = std::fs::read_to_string(fixture("scenes/simple.rs")).expect("it exists");
    let stages = scene("simple");
    let code = super::snapshots::pretty(stages.tokens().clone());
    let start = code
        .find("    /// Angular accelerations")
        .expect("it is documented");
    let function = &code[start..];
    let end = function.find("\n    }\n").expect("it ends");
    let function = &function[..end + "\n    }\n".len()];
    for (what, text) in [
        ("source", source.as_str()),
        ("description", &stages.description.to_string()),
        ("scene", &stages.scene.to_string()),
        ("mechanics", &stages.mechanics.to_string()),
        ("program", &stages.program.to_string()),
        ("code", function),
    ] {
        assert!(!text.is_empty() && page.contains(text), "{what}:\n{text}");
    }
}

#[test]
fn pipeline_shows_a_tree_in_loops() {
    let page = std::fs::read_to_string(fixture("../../docs/pipeline.md")).expect("it exists");
    let start = page.find("    code = loops,").expect("its source");
    let start = page[..start]
        .rfind("#[branched_pendulum(")
        .expect("its source");
    let end = start + page[start..].find("```").expect("it ends");
    let stages = stages_of(&page[start..end]);
    let program = stages.program.to_string();
    let part = |from: &str, to: &str| {
        let start = program.find(from).expect("its beginning");
        let end = start + program[start..].find(to).expect("its end");
        program[start..end].to_owned()
    };
    let code = super::snapshots::function(stages.tokens(), "inner");
    let code = code
        .strip_prefix("impl Model {\n")
        .expect("a function alone");
    let code = code.strip_suffix("}\n").expect("a function alone");
    for text in [
        stages.scene.to_string(),
        stages.mechanics.to_string(),
        part("strips\n", "leaf(constants"),
        part("inner(constants", "pivot(constants"),
        code.to_owned(),
    ] {
        assert!(!text.is_empty() && page.contains(&text), "{text}");
    }
}

#[test]
fn pipeline_shows_what_passes_are_worth() {
    let page = std::fs::read_to_string(fixture("../../docs/pipeline.md")).expect("it exists");
    for name in ["paper", "triplet", "nested"] {
        let stages = scene(name);
        let table = worth(&stages.scene, &stages.mechanics);
        assert!(page.contains(&table), "{name}:\n{table}");
    }
}
