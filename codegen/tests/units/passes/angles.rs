//! Sines and cosines of differences of angles.

use branched_pendulum_codegen::functions::Argument;
use branched_pendulum_codegen::program::Pass;
use branched_pendulum_codegen::stages_without;
use quote::quote;

/// Checks that two links need two pairs of sine and cosine instead of three, and that the
/// accelerations do not change.
#[test]
fn differences_take_no_sines_of_their_own() {
    let [added, direct] = [None, Some(Pass::AngleAddition)].map(|off| {
        let attribute = quote!(
            gravity = 9.8,
            solve = factorization,
            a: rod(mass = 1, length = 1) [b: rod(mass = 2, length = 0.5)]
        );
        let stages = stages_without(
            off,
            attribute,
            quote!(
                struct Two;
            ),
        );
        stages.expect("the scene is right").program
    });
    let sines = |program: &branched_pendulum_codegen::program::Program| {
        program.operations(&program.entries[0].outputs).sin_cos
    };
    assert_eq!((sines(&added), sines(&direct)), (2, 3));
    for step in 0..20 {
        let input = |argument: Argument, index: usize| match argument {
            Argument::Theta => 0.3 * f64::from(step) - index as f64,
            _ => 1.0 + index as f64 - 0.1 * f64::from(step),
        };
        let [added, direct] = [&added, &direct].map(|program| {
            let outputs = program.evaluate(f64::sin_cos, "accelerations", &[], input);
            outputs.expect("the entry is there")
        });
        for (added, direct) in added.iter().zip(&direct) {
            assert!(
                (added - direct).abs() < 1e-14 * (100.0 + direct.abs()),
                "{added} {direct}"
            );
        }
    }
}
