//! Rule `neutral` of the builder of programs.

use branched_pendulum_codegen::functions::Argument;
use branched_pendulum_codegen::program::Builder;

#[test]
fn neutral_operands_leave_no_operation() {
    let mut builder = Builder::default();
    let x = builder.input(Argument::Theta, 0);
    let (zero, one) = (builder.integer(0), builder.integer(1));
    let length = builder.definitions.len();
    assert_eq!(builder.add(zero, x), x);
    assert_eq!(builder.sub(x, zero), x);
    assert_eq!(builder.mul(x, one), x);
    assert_eq!(builder.div(x, one), x);
    assert_eq!(builder.mul(x, zero), zero);
    assert_eq!(builder.sub(x, x), zero);
    assert_eq!(builder.definitions.len(), length);
}

#[test]
fn twice_a_value_is_a_product() {
    let mut builder = Builder::default();
    let x = builder.input(Argument::Theta, 0);
    let two = builder.integer(2);
    assert_eq!(builder.add(x, x), builder.mul(two, x));
}
