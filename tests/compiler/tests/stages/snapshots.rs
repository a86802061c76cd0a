//! One snapshot a stage and scene; the code of large scenes by function.

use branched_pendulum_compiler_tests::source::{scene, stages_of as stages_of_text};
use proc_macro2::TokenStream;

pub(super) fn pretty(tokens: TokenStream) -> String {
    branched_pendulum_codegen::layout(tokens).expect("emitted code is Rust")
}

/// The emitted function of that name, with its docs.
pub(super) fn function(tokens: &TokenStream, name: &str) -> String {
    let all = emitted_functions(tokens).into_iter();
    let mut named = all.filter(|function| function.sig.ident == name);
    let function = named.next().unwrap_or_else(|| panic!("no function {name}"));
    pretty(quote::quote!(impl Model { #function }))
}

/// All functions in the `impl` blocks of emitted code, in their order.
pub(super) fn emitted_functions(tokens: &TokenStream) -> Vec<syn::ImplItemFn> {
    let file: syn::File = syn::parse2(tokens.clone()).expect("emitted code is Rust");
    let blocks = file.items.into_iter().filter_map(|item| match item {
        syn::Item::Impl(block) => Some(block.items),
        _ => None,
    });
    let functions = blocks.flatten().filter_map(|member| match member {
        syn::ImplItem::Fn(function) => Some(function),
        _ => None,
    });
    functions.collect()
}

fn stages_of(name: &str) {
    let stages = scene(name);
    insta::assert_snapshot!(
        format!("{name}_description"),
        stages.description.to_string()
    );
    insta::assert_snapshot!(format!("{name}_scene"), stages.scene.to_string());
    insta::assert_snapshot!(format!("{name}_mechanics"), stages.mechanics.to_string());
}

fn program(name: &str) {
    insta::assert_snapshot!(format!("{name}_program"), scene(name).program.to_string());
}

fn code(name: &str) {
    insta::assert_snapshot!(format!("{name}_code"), pretty(scene(name).tokens().clone()));
}

fn functions(name: &str, functions: &[&str]) {
    let stages = scene(name);
    for wanted in functions {
        let text = function(stages.tokens(), wanted);
        insta::assert_snapshot!(format!("{name}_code_{wanted}"), text);
    }
}

/// Cost of each function: a change here is a change of speed.
fn operations(name: &str) {
    let program = scene(name).program;
    let table: String = program
        .entries
        .iter()
        .map(|entry| {
            let operations = program.operations(&entry.outputs);
            format!("{:<31} {operations}\n", entry.name)
        })
        .collect();
    insta::assert_snapshot!(format!("{name}_operations"), table);
}

#[test]
fn simple() {
    stages_of("simple");
    program("simple");
    code("simple");
}

#[test]
fn branch() {
    stages_of("branch");
    functions(
        "branch",
        &[
            "ends",
            "end_velocities",
            "end_torques",
            "link_properties",
            "points_into",
            "accelerations_under",
        ],
    );
    operations("branch");
}

#[test]
fn chain() {
    stages_of("chain");
    program("chain");
    code("chain");
}

#[test]
fn offset() {
    stages_of("offset");
    operations("offset");
    functions("offset", &["accelerations"]);
}

#[test]
fn observed() {
    stages_of("observed");
    operations("observed");
    functions(
        "observed",
        &[
            "twist_rate",
            "antiphase",
            "antiphase_rate",
            "mixed_rate",
            "twist_rate_from_momenta",
        ],
    );
}

#[test]
fn sweep() {
    stages_of("sweep");
    operations("sweep");
    functions(
        "sweep",
        &["new", "from_parameters_unchecked", "accelerations"],
    );
}

#[test]
fn unequal() {
    operations("unequal");
    functions("unequal", &["transfer_forcing"]);
}

#[test]
fn triplet() {
    stages_of("triplet");
    operations("triplet");
    functions("triplet", &["from_symmetric", "antiphase_energy_d2"]);
}

#[test]
fn paper() {
    stages_of("paper");
    operations("paper");
    functions(
        "paper",
        &[
            "default",
            "accelerations",
            "symmetric_accelerations",
            "transfer_angle_1",
            "transfer_amplitude_2",
            "transfer_exact_from_rates",
        ],
    );
}

/// The formulas of the paper's pendulum.
#[test]
fn blades() {
    operations("blades");
    functions(
        "blades",
        &["normal_form_frequencies", "normal_form_thresholds"],
    );
}

/// Two copies with every law of friction.
#[test]
fn braked() {
    let stages = stages_of_text(
        "#[branched_pendulum(gravity = 9.80665, \
         trunk: rod(mass = 1, length = 1, friction(viscous = c, coulomb = dry, width = 0.1)) [ \
             twig: rod(mass = 0.5, length = 0.5, friction(coulomb = dry, quadratic = 1e-3), \
                 drag(quadratic = 2e-3)) * 2 ], \
         emit(energies, symmetric, forces))] struct Braked;",
    );
    insta::assert_snapshot!("braked_description", stages.description.to_string());
    insta::assert_snapshot!("braked_scene", stages.scene.to_string());
    insta::assert_snapshot!("braked_mechanics", stages.mechanics.to_string());
    for name in ["accelerations", "symmetric_accelerations", "friction_power"] {
        insta::assert_snapshot!(
            format!("braked_code_{name}"),
            function(stages.tokens(), name)
        );
    }
}

/// A leaf and its uncle, and two copies with a spring and friction between them.
#[test]
fn coupled() {
    let stages = stages_of_text(
        "#[branched_pendulum(gravity = 9.80665, \
         trunk: rod(mass = 1, length = 1) [ \
             limb: rod(mass = 0.5, length = 0.5), \
             twig: rod(mass = 0.2, length = 0.3) * 2 ], \
         between(limb, twig_1, spring = 0.1, rest = 0.2, friction = c), \
         siblings(twig, spring = stiffness, friction(coulomb = dry)), \
         emit(energies, symmetric, forces))] struct Coupled;",
    );
    insta::assert_snapshot!("coupled_description", stages.description.to_string());
    insta::assert_snapshot!("coupled_scene", stages.scene.to_string());
    insta::assert_snapshot!("coupled_mechanics", stages.mechanics.to_string());
    for name in [
        "accelerations",
        "potential_energy",
        "symmetric_accelerations",
        "friction_power",
    ] {
        insta::assert_snapshot!(
            format!("coupled_code_{name}"),
            function(stages.tokens(), name)
        );
    }
}

/// A straight spring and damper between points of two links, one without length at rest, and a
/// guy.
#[test]
fn guyed() {
    let stages = stages_of_text(
        "#[branched_pendulum(gravity = 9.80665, \
         mast: rod(mass = 1, length = 1) [ arm: rod(mass = 0.5, length = 0.5) ], \
         between(mast, arm, at = each(0.3, (0.4, 0.1)), spring = k, rest = 0.5, friction = c), \
         guy(arm, at = 0.5, to = (0.8, 0), spring = 3), \
         emit(energies, forces))] struct Guyed;",
    );
    insta::assert_snapshot!("guyed_description", stages.description.to_string());
    insta::assert_snapshot!("guyed_scene", stages.scene.to_string());
    insta::assert_snapshot!("guyed_mechanics", stages.mechanics.to_string());
    for name in ["accelerations", "potential_energy", "friction_power"] {
        insta::assert_snapshot!(
            format!("guyed_code_{name}"),
            function(stages.tokens(), name)
        );
    }
}

/// Repulsions by an odd and by an even power of the distance, the first beside a spring and a
/// damper.
#[test]
fn repelled() {
    let stages = stages_of_text(
        "#[branched_pendulum(gravity = 9.80665, \
         mast: rod(mass = 1, length = 1) [ arm: rod(mass = 0.5, length = 0.5) ], \
         between(mast, arm, at = each(0.3, 0.4), spring = 2, rest = 0.5, friction = c, \
             repulsion = magnets, exponent = 3), \
         guy(arm, at = 0.5, to = (0.8, 0), repulsion = -0.02, exponent = 2), \
         emit(energies, modes))] struct Repelled;",
    );
    insta::assert_snapshot!("repelled_description", stages.description.to_string());
    insta::assert_snapshot!("repelled_scene", stages.scene.to_string());
    insta::assert_snapshot!("repelled_mechanics", stages.mechanics.to_string());
    for name in ["accelerations", "potential_energy", "stiffness_matrix"] {
        insta::assert_snapshot!(
            format!("repelled_code_{name}"),
            function(stages.tokens(), name)
        );
    }
}

/// A rubber band between two copies, in the energies of their difference.
#[test]
fn banded() {
    let stages = stages_of_text(
        "#[branched_pendulum(gravity = 9.80665, \
         parent(mass = 0.1, com = 0.08, inertia = 2e-3, joint = 0.27) [ \
             child(mass = 0.1, com = 0.04, inertia = 5e-4) * 2 ], \
         siblings(child, at = (0.06, 0.02), spring = kappa), \
         emit(transfer(angle = 1, amplitude = 2, exact), budget(parseval)))] struct Banded;",
    );
    insta::assert_snapshot!("banded_mechanics", stages.mechanics.to_string());
    for name in [
        "antiphase_energy",
        "transfer_exact",
        "transfer_angle_1",
        "budget_parseval",
    ] {
        insta::assert_snapshot!(
            format!("banded_code_{name}"),
            function(stages.tokens(), name)
        );
    }
}

/// The pendulum of one rod: one order of its Taylor coefficients.
#[test]
fn taylor() {
    let stages = stages_of_text(
        "#[branched_pendulum(gravity = 9.80665, rod: rod(mass = 1, length = 1, friction = c), \
         emit(taylor))] struct Rod;",
    );
    insta::assert_snapshot!("taylor_program", stages.program.to_string());
    insta::assert_snapshot!(
        "taylor_code_coefficients",
        function(stages.tokens(), "taylor_coefficients")
    );
    operations("series");
}

#[test]
fn driven() {
    stages_of("driven");
    operations("driven");
    functions(
        "driven",
        &[
            "accelerations",
            "drive_power",
            "friction_power",
            "antiphase_drive_power",
        ],
    );
}

/// The equations of a link with offsets, under the root of a driven tree.
#[test]
fn driven_loops() {
    insta::assert_snapshot!(
        "driven_loops_scene",
        scene("driven_loops").scene.to_string()
    );
    functions(
        "driven_loops",
        &[
            "leaf",
            "inner",
            "accelerate",
            "accelerate_leaf",
            "drive",
            "root_drive",
            "drive_power",
            "accelerations_into",
            "cast",
            "evaluate",
        ],
    );
}

/// Functions of budgets are too long to be read; their costs are not.
#[test]
fn nested() {
    stages_of("nested");
    operations("nested");
}

#[test]
fn reductions() {
    let stages = stages_of_text(
        "#[branched_pendulum(
            gravity = 9.80665,
            trunk: rod(mass = 0.4, length = 0.5)[
                arm: rod(mass = m, length = 0.3, friction = 2e-4)[
                    finger(mass = 0.03, com = 0.04, inertia = 2e-5, joint = 0.08)[
                        nail: rod(mass = 0.01, length = 0.03, drag = 1e-6)
                    ] * 2
                ] * 2
            ],
            in_phase(arm), locked(finger, 0.5)
        )] pub struct Sample;",
    );
    insta::assert_snapshot!("reduced_description", stages.description.to_string());
    insta::assert_snapshot!("reduced_scene", stages.scene.to_string());
    insta::assert_snapshot!("reduced_code", pretty(stages.tokens().clone()));
}

#[test]
fn transverse() {
    let stages = stages_of_text(
        "#[branched_pendulum(
            gravity = 9.80665,
            parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
                child(mass = 0.10531, com = 0.043, inertia = 0.516e-3, friction = 1e-5) * 2
            ],
            in_phase(child),
            emit(transverse)
        )] pub struct Sample;",
    );
    insta::assert_snapshot!("transverse_mechanics", stages.mechanics.to_string());
    insta::assert_snapshot!("transverse_program", stages.program.to_string());
    insta::assert_snapshot!("transverse_code", pretty(stages.tokens().clone()));
}

/// Small differences that act back: what they add to the in-phase motion, and its energy.
#[test]
fn small() {
    let stages = stages_of_text(
        "#[branched_pendulum(
            gravity = 9.80665,
            parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
                child(mass = 0.10531, com = 0.043, inertia = 0.516e-3, friction = 1e-5) * 2
            ],
            in_phase(child),
            emit(small)
        )] pub struct Sample;",
    );
    insta::assert_snapshot!("small_mechanics", stages.mechanics.to_string());
    for wanted in ["small_accelerations", "small_energy"] {
        let text = function(stages.tokens(), wanted);
        insta::assert_snapshot!(format!("{wanted}_code"), text);
    }
}
