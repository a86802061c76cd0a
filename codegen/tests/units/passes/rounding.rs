//! Rounding errors of small programs.

use super::program_of;
use branched_pendulum_codegen::functions::{Argument, Purpose};
use branched_pendulum_codegen::program::Builder;
use branched_pendulum_codegen::program::Rounding;
use branched_pendulum_codegen::program::ValueId;

fn rounding(form: impl Fn(&mut Builder) -> ValueId) -> Option<Rounding> {
    let mut builder = Builder::default();
    let output = form(&mut builder);
    let program = program_of(builder, Purpose::KineticEnergy, vec![output]);
    program.rounding(&program.entries[0])
}

#[test]
fn an_operation_errs_by_half_a_unit() {
    let product = rounding(|builder| {
        let [x, y] = [0, 1].map(|index| builder.input(Argument::Theta, index));
        builder.mul(x, y)
    });
    let Rounding { ulps, states } = product.expect("angles have a size");
    assert!(ulps > 0.3 && ulps <= 0.5, "{ulps}");
    assert_eq!(states, 16);
    let twice = rounding(|builder| {
        let x = builder.input(Argument::Theta, 0);
        builder.add(x, x)
    });
    assert_eq!(twice.map(|twice| twice.ulps), Some(0.0));
}

/// Checks that (x + 1000) − 1000, which loses digits, has a correspondingly larger error.
#[test]
fn what_cancels_shows() {
    let difference = rounding(|builder| {
        let x = builder.input(Argument::Theta, 0);
        let thousand = builder.integer(1000);
        let sum = builder.add(x, thousand);
        builder.sub(sum, thousand)
    });
    assert!(difference.is_some_and(|difference| difference.ulps > 100.0));
}

#[test]
fn parameters_have_no_value() {
    let scaled = rounding(|builder| {
        let mass = builder.setup.parameter(0, "mass");
        let mass = builder.constant(mass);
        let x = builder.input(Argument::Theta, 0);
        builder.mul(x, mass)
    });
    assert_eq!(scaled, None);
}
