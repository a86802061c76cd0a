//! Rule `sharing` of the builder of programs.

use branched_pendulum_codegen::functions::Argument;
use branched_pendulum_codegen::program::Builder;

#[test]
fn equal_operations_are_one_value() {
    let mut builder = Builder::default();
    let [x, y] = [0, 1].map(|index| builder.input(Argument::Theta, index));
    assert_eq!(builder.add(x, y), builder.add(y, x));
    assert_eq!(builder.mul(x, y), builder.mul(y, x));
    assert_eq!(builder.sub(x, y), builder.sub(x, y));
    assert_ne!(builder.sub(x, y), builder.sub(y, x));
    assert_ne!(builder.div(x, y), builder.div(y, x));
}
