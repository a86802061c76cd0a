//! Prose in emitted docs means as Markdown what it says.

use branched_pendulum_codegen::layout;
use branched_pendulum_compiler_tests::source::scene;

/// A line without its code spans.
fn plain(line: &str) -> String {
    line.split('`').step_by(2).collect()
}

/// Brackets are links to functions, which are code; anything else in them would be
/// taken for a link too.
fn has_stray_bracket(prose: &str) -> bool {
    prose
        .match_indices('[')
        .any(|(at, _)| !prose[at + 1..].starts_with(']'))
}

/// A sign at the start of a line begins a list.
fn begins_a_list(prose: &str) -> bool {
    ["+ ", "* "].iter().any(|sign| prose.starts_with(sign))
}

#[test]
fn emitted_prose_has_no_stray_brackets_and_lists() {
    let scenes = [
        "paper",
        "triplet",
        "unequal",
        "blades",
        "nested",
        "observed",
        "driven",
        "series",
        "driven_series",
        "sweep",
        "driven_loops",
    ];
    for name in scenes {
        let text = layout(scene(name).tokens().clone()).expect("emitted code is Rust");
        let docs = text.lines().filter_map(|line| {
            let line = line.trim_start().strip_prefix("///")?;
            Some(line.strip_prefix(' ').unwrap_or(line))
        });
        let mut in_block = false;
        for line in docs {
            let fence = line.starts_with("```");
            in_block ^= fence;
            if fence || in_block {
                continue;
            }
            let prose = plain(line);
            assert!(!has_stray_bracket(&prose), "{name}: {line}");
            assert!(!begins_a_list(line), "{name}: {line}");
        }
        assert!(!in_block, "{name}: a block of code has no end");
    }
}
