//! Products that are fused with sums.

use super::program_of;
use branched_pendulum_codegen::functions::{Argument, Purpose};
use branched_pendulum_codegen::program::Builder;
use branched_pendulum_codegen::program::ValueId;

fn inputs(builder: &mut Builder) -> [ValueId; 4] {
    std::array::from_fn(|index| builder.input(Argument::Theta, index))
}

#[test]
fn products_in_sums_alone_are_fused() {
    let mut builder = Builder::default();
    let [a, b, c, d] = inputs(&mut builder);
    let (ab, cd) = (builder.mul(a, b), builder.mul(c, d));
    let sum = builder.add(ab, cd);
    let minus = builder.sub(c, ab);
    let program = program_of(builder.clone(), Purpose::Accelerations, vec![sum, minus]);
    let fused = program.fused(&program.entries[0]);
    // The second of two products in a sum; the first is computed separately for both.
    assert_eq!(fused[&sum].product, cd);
    assert!(!fused.contains_key(&minus));
    let program = program_of(builder, Purpose::Accelerations, vec![minus]);
    let fused = program.fused(&program.entries[0]);
    assert!(fused[&minus].product == ab && fused[&minus].minus_product);
}

#[test]
fn differences_of_products_and_other_functions_are_not() {
    let mut builder = Builder::default();
    let [a, b, c, d] = inputs(&mut builder);
    let (ab, cd) = (builder.mul(a, b), builder.mul(c, d));
    let (difference, sum) = (builder.sub(ab, cd), builder.add(ab, cd));
    let program = program_of(builder.clone(), Purpose::Accelerations, vec![difference]);
    assert!(program.fused(&program.entries[0]).is_empty());
    let program = program_of(builder, Purpose::KineticEnergy, vec![sum]);
    assert!(program.fused(&program.entries[0]).is_empty());
}
