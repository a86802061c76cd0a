//! Number of values that are needed at the same time.

use super::program_of;
use branched_pendulum_codegen::functions::{Argument, Purpose};
use branched_pendulum_codegen::program::Builder;

/// Checks that four products before three sums are all counted as live, but only two if each
/// sum follows its products.
#[test]
fn what_waits_is_counted() {
    let [all_first, at_once] = [true, false].map(|all_first| {
        let mut builder = Builder::default();
        let inputs: [_; 5] = std::array::from_fn(|i| builder.input(Argument::Theta, i));
        let pairs: Vec<_> = inputs.windows(2).map(|pair| (pair[0], pair[1])).collect();
        let mut sum = builder.mul(pairs[0].0, pairs[0].1);
        let rest = &pairs[1..];
        if all_first {
            for &(a, b) in rest {
                builder.mul(a, b);
            }
        }
        for &(a, b) in rest {
            let product = builder.mul(a, b);
            sum = builder.add(sum, product);
        }
        let program = program_of(builder, Purpose::KineticEnergy, vec![sum]);
        program.live(&program.entries[0])
    });
    assert_eq!((all_first, at_once), (4, 2));
}
