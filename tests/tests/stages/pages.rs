//! Pages of `docs/` that show output show the output of today.

use branched_pendulum_codegen::program::worth;
use branched_pendulum_tests::source::{fixture, scene};

#[test]
fn pipeline_shows_every_stage() {
    let page = std::fs::read_to_string(fixture("../../docs/pipeline.md")).expect("it exists");
    let source = std::fs::read_to_string(fixture("scenes/simple.rs")).expect("it exists");
    let stages = scene("simple");
    let code = super::snapshots::pretty(stages.tokens);
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
fn pipeline_shows_what_passes_are_worth() {
    let page = std::fs::read_to_string(fixture("../../docs/pipeline.md")).expect("it exists");
    for name in ["paper", "triplet", "nested"] {
        let stages = scene(name);
        let table = worth(&stages.scene, &stages.mechanics);
        assert!(page.contains(&table), "{name}:\n{table}");
    }
}
