//! Rule `folding` of the builder of programs.

use branched_pendulum_codegen::exact::Rational;
use branched_pendulum_codegen::functions::Argument;
use branched_pendulum_codegen::program::Builder;
use branched_pendulum_codegen::program::Op;

#[test]
fn constants_meet_exactly() {
    let mut builder = Builder::default();
    let x = builder.input(Argument::Theta, 0);
    let [two, three] = [2, 3].map(|number| builder.integer(number));
    let third_exactly = Rational::from(3).checked_pow(-1).expect("3 is not zero");
    let third = builder.div(two, three);
    assert_eq!(
        *builder.op(third),
        Op::Number(Rational::from(2) * third_exactly)
    );
    // (2/3 x) · 3 / 2: no constant remains.
    let scaled = builder.mul(third, x);
    let back = builder.mul(scaled, three);
    assert_eq!(builder.div(back, two), x);
}
