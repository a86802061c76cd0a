//! Trees in loops at every stage: the balance of a link, its functions and constants, and
//! the code of it.

use crate::snapshots::{function, pretty};
use branched_pendulum_codegen::functions::LinkFunction;
use branched_pendulum_codegen::program::worth;
use branched_pendulum_compiler_tests::source::stages_of;

/// All stages of a tree, the code of its links and its model.
fn all_stages(name: &str, text: &str) {
    let stages = stages_of(&format!("#[branched_pendulum({text})] pub struct Sample;"));
    insta::assert_snapshot!(format!("{name}_scene"), stages.scene.to_string());
    insta::assert_snapshot!(format!("{name}_mechanics"), stages.mechanics.to_string());
    insta::assert_snapshot!(format!("{name}_program"), stages.program.to_string());
    insta::assert_snapshot!(
        format!("{name}_passes"),
        worth(&stages.scene, &stages.mechanics)
    );
    let functions = LinkFunction::ALL.map(|link| function(stages.tokens(), link.name()));
    insta::assert_snapshot!(format!("{name}_code_link"), functions.concat());
    let constructor = match stages.scene.parameters.is_empty() {
        true => "default",
        false => "from_parameters_unchecked",
    };
    let constructor = function(stages.tokens(), constructor);
    insta::assert_snapshot!(format!("{name}_code_constants"), constructor);
    assert!(!pretty(stages.tokens().clone()).is_empty());
}

#[test]
fn by_rule() {
    all_stages(
        "rule_loops",
        "gravity = 9.80665, code = loops, tree: generations(count = 4, branching = 2, shape = rod, \
         mass = 0.12, length = 0.3, mass_ratio = 0.5, length_ratio = 0.7)",
    );
}

#[test]
fn bush() {
    all_stages(
        "bush_loops",
        "gravity = 9.80665, code = loops, trunk: rod(mass = 0.3, length = 0.3) [ \
            left: rod(mass = 0.2, length = 0.2) [ tip: rod(mass = 0.05, length = 0.1) * 2 ], \
            right: rod(mass = 0.1, length = 0.25, friction = c) ]",
    );
}

#[test]
fn several_attachments() {
    all_stages(
        "several_loops",
        "gravity = 9.80665, code = loops, trunk: rod(mass = 0.3, length = 0.3) [ \
            left: rod(mass = 0.2, length = 0.2, at = 0.1) [ tip: rod(mass = 0.05, length = 0.1) ], \
            right: rod(mass = 0.1, length = 0.25, at = (0.2, 0.05)) ]",
    );
}

#[test]
fn driven() {
    all_stages(
        "shaken_loops",
        "gravity = 9.80665, code = loops, tree: generations(count = 3, branching = 2, \
         mass = 0.12, com = (0.14, 0.02), inertia = 1e-3, joint = (0.3, 0.05), \
         mass_ratio = 0.5, length_ratio = 0.7, friction = 1e-4), \
         drive(torque = push * cos(3 * t), x = 0.01 * sin(6 * t)), emit(energies)",
    );
}

/// Lines between points: their constants, and the energy and the power of all.
#[test]
fn strung() {
    let stages = stages_of(
        "#[branched_pendulum(
            gravity = 9.80665,
            tree: generations(count = 3, branching = 2, shape = rod, mass = 0.12, length = 0.3,
                code = loops),
            siblings(tree_3, at = (0.2, 0.01), spring = k, repulsion = 1e-4, exponent = 3),
            between(tree_1, tree_3_1_2, at = each(0.2, 0.1), friction = c),
            guy(tree_2_1, at = 0.1, to = (0.2, 0.1), spring = 2, rest = 0.1),
            emit(energies, forces)
        )] pub struct Sample;",
    );
    for name in [
        "from_parameters_unchecked",
        "potential_energy_with",
        "friction_power",
    ] {
        let snapshot = format!("strung_loops_code_{name}");
        insta::assert_snapshot!(snapshot, function(stages.tokens(), name));
    }
    let program = stages.program.to_string();
    let lines: Vec<&str> = (program.lines())
        .filter(|line| line.starts_with("line of"))
        .collect();
    insta::assert_snapshot!("strung_loops_program_lines", lines.join("\n"));
}

/// Derivatives of the accelerations: the constants of the virtual power and their derivatives, and the
/// functions.
#[test]
fn differentiated() {
    let stages = stages_of(
        "#[branched_pendulum(
            gravity = 9.80665, code = loops,
            trunk: rod(mass = m, length = 0.3, friction(viscous = c, coulomb = 2 * c)) [
                left: rod(mass = 0.2, length = l, spring = 0.1),
                right: point(mass = 0.05, length = l / 2)
            ],
            drive(torque = push * cos(3 * t)),
            emit(gradient(accelerations))
        )] pub struct Sample;",
    );
    for name in [
        "from_parameters_unchecked",
        "accelerations_pullback",
        "drive_pullback",
        "compute_with",
    ] {
        let snapshot = format!("differentiated_loops_code_{name}");
        insta::assert_snapshot!(snapshot, function(stages.tokens(), name));
    }
    let program = stages.program.to_string();
    let power = program
        .split_once("virtual power")
        .expect("it is printed")
        .1;
    let (power, _) = power.split_once("leaf(").expect("functions follow");
    insta::assert_snapshot!("differentiated_loops_program_power", power);
}

/// Links that may be held: one equation for those that are and those that are not.
#[test]
fn held() {
    let stages = stages_of(
        "#[branched_pendulum(
            gravity = 9.80665, code = loops,
            trunk: rod(mass = 0.3, length = 0.3) [
                left: rod(mass = 0.2, length = 0.2, friction = 1e-3) [
                    tip: rod(mass = 0.05, length = l) * 2
                ]
            ],
            prescribed(tip_1), prescribed(trunk, left)
        )] pub struct Sample;",
    );
    insta::assert_snapshot!("held_loops_scene", stages.scene.to_string());
    let functions = LinkFunction::ALL.map(|link| function(stages.tokens(), link.name()));
    insta::assert_snapshot!("held_loops_code_link", functions.concat());
}
