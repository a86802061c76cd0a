//! The order in which accelerations read their state and ask for sines and
//! cosines: at once where there are registers for all, else one by one where
//! they are needed.

use super::snapshots::pretty;
use branched_pendulum_compiler_tests::source::{scene, stages_of};

/// The lines of `evaluate`.
fn evaluate(code: &str) -> Vec<&str> {
    let start = code.find("fn evaluate(").expect("models have it");
    let end = start + code[start..].find("\n    }").expect("it ends");
    code[start..end].lines().map(str::trim).collect()
}

#[test]
fn short_accelerations_ask_at_once() {
    for name in ["paper", "nested"] {
        let code = pretty(scene(name).tokens().clone());
        assert!(code.contains("T::sin_cos_each(theta)"), "{name}");
        assert!(!code.contains("SinCosPairs::among"), "{name}");
    }
}

#[test]
fn long_accelerations_ask_where_they_need() {
    let code = pretty(scene("generations").tokens().clone());
    let lines = evaluate(&code);
    let place = |what: &str| lines.iter().position(|line| line.contains(what));
    let asked: Vec<usize> = (0..lines.len())
        .filter(|&line| lines[line].contains("sin_cos.of("))
        .collect();
    // Fifteen angles, four together; the last ones when others are done.
    assert_eq!(asked.len(), 4);
    assert!(place("let inverse_articulated_inertia_") < asked.last().copied());
    // A velocity is squared as soon as it is read, each in its own place.
    for (line, text) in lines.iter().enumerate() {
        if let Some(name) = text.strip_prefix("let omega_") {
            let name = name.split(' ').next().unwrap_or_default();
            let next = lines[line + 1..].iter().take(8);
            let used = next.filter(|text| text.contains(&format!("omega_{name}")));
            assert!(used.count() > 0, "{text}");
        }
    }
    // Each result is handed over before the next is formed.
    let results = lines.iter().filter(|line| line.starts_with("alpha("));
    assert_eq!(results.count(), 15);
    assert!(place("alpha(0,") < place("let alpha_arm_2_1"));
}

/// In parts, which share one array, where one function would be too long.
#[test]
fn longer_accelerations_ask_in_parts() {
    let stages = stages_of(
        "/// Rods.
        #[branched_pendulum(
            gravity = 9.80665,
            arm: generations(count = 5, branching = 2, shape = rod, mass = 0.12, length = 0.3,
                mass_ratio = 0.5, length_ratio = 0.7),
        )]
        pub struct Tree;",
    );
    let code = pretty(stages.tokens().clone());
    let lines = evaluate(&code);
    assert!(lines.len() < 100, "{}", lines.len());
    assert!(
        lines
            .iter()
            .any(|line| line.contains("accelerations_part_2"))
    );
    assert_eq!(code.matches("sin_cos.of(").count(), 8);
}
