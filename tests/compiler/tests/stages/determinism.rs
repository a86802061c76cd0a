//! Same input, same tokens.

use branched_pendulum_codegen::expand;
use branched_pendulum_compiler_tests::source::{attributed_struct, fixture};

#[test]
fn repeated_expansions_are_equal() {
    for name in [
        "paper", "triplet", "unequal", "offset", "sweep", "driven", "observed",
    ] {
        let source = std::fs::read_to_string(fixture(&format!("scenes/{name}.rs")))
            .expect("the fixture exists");
        let (attribute, item) = attributed_struct(&source);
        let first = expand(attribute.clone(), item.clone()).to_string();
        for _ in 0..4 {
            assert_eq!(expand(attribute.clone(), item.clone()).to_string(), first);
        }
    }
}

/// A budget is long: fewer expansions show the same.
#[test]
fn expansions_of_budgets_are_equal() {
    for name in ["nested", "generations"] {
        let source = std::fs::read_to_string(fixture(&format!("scenes/{name}.rs")))
            .expect("the fixture exists");
        let (attribute, item) = attributed_struct(&source);
        let first = expand(attribute.clone(), item.clone()).to_string();
        for _ in 0..3 {
            assert_eq!(expand(attribute.clone(), item.clone()).to_string(), first);
        }
    }
}

/// Symbols live as long as the process: a scene's code must not depend on
/// which scenes were expanded before it.
#[test]
fn other_scenes_leave_no_trace() {
    let expansion = |name: &str| {
        let source = std::fs::read_to_string(fixture(&format!("scenes/{name}.rs")))
            .expect("the fixture exists");
        let (attribute, item) = attributed_struct(&source);
        expand(attribute, item).to_string()
    };
    let before = expansion("paper");
    for name in [
        "simple", "offset", "observed", "triplet", "chain", "sweep", "driven", "nested",
    ] {
        expansion(name);
    }
    assert_eq!(expansion("paper"), before);
}
