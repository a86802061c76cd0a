//! Removal of operations that no entry point needs.

use super::program_of;
use branched_pendulum_codegen::functions::{Argument, Purpose};
use branched_pendulum_codegen::program::Builder;
use branched_pendulum_codegen::program::Op;

#[test]
fn what_nothing_uses_is_left_out() {
    let mut builder = Builder::default();
    let [x, y] = [0, 1].map(|index| builder.input(Argument::Theta, index));
    let unused = builder.mul(x, y);
    builder.sin(unused);
    builder.sub(x, y);
    let sum = builder.add(x, y);
    let program = program_of(builder, Purpose::KineticEnergy, vec![sum]);
    assert_eq!(program.needed(&[sum]), [x, y, sum]);
    let pruned = program.without_dead_code();
    assert_eq!(pruned.verify(), Ok(()));
    let ops = pruned.definitions.iter().map(|definition| &definition.op);
    assert!(ops.clone().all(|op| !matches!(op, Op::Sub(..))));
    assert_eq!(ops.filter(|op| matches!(op, Op::Sin(_))).count(), 1);
    assert_eq!(
        *pruned
            .definition(pruned.entries[0].outputs[0])
            .op
            .operands()
            .collect::<Vec<_>>(),
        [x, y]
    );
}
