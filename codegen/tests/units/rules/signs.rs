//! Rule `signs` of the builder of programs.

use branched_pendulum_codegen::functions::Argument;
use branched_pendulum_codegen::program::Builder;
use branched_pendulum_codegen::program::Op;

#[test]
fn signs_move_outwards() {
    let mut builder = Builder::default();
    let [x, y] = [0, 1].map(|index| builder.input(Argument::Theta, index));
    let minus_x = builder.neg(x);
    assert_eq!(builder.neg(minus_x), x);
    let sum = builder.add(y, minus_x);
    assert_eq!(*builder.op(sum), Op::Sub(y, x));
    let turned = builder.neg(sum);
    assert_eq!(*builder.op(turned), Op::Sub(x, y));
    let product = builder.mul(minus_x, y);
    let plain = builder.mul(x, y);
    assert_eq!(*builder.op(product), Op::Neg(plain));
    // (−x) y − (−x) y · z keeps a single sign.
    let difference = builder.sub(product, minus_x);
    let positive = builder.sub(x, plain);
    assert_eq!(difference, positive);
}
