//! Small programs before and after the extraction of common factors.

use super::program_of;
use branched_pendulum_codegen::functions::{Argument, Purpose};
use branched_pendulum_codegen::program::Builder;
use branched_pendulum_codegen::program::common_factors;
use branched_pendulum_codegen::program::{Op, Program, ValueId};
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::{Rng, SeedableRng};

fn inputs<const N: usize>(builder: &mut Builder) -> [ValueId; N] {
    std::array::from_fn(|index| builder.input(Argument::Theta, index))
}

/// Runs the pass, and returns the program before and after it. Checks that both are valid and have
/// equal values for whole numbers, which are not rounded.
fn pass(builder: Builder, purpose: Purpose, outputs: Vec<ValueId>) -> [Program; 2] {
    let before = program_of(builder, purpose, outputs);
    let after = common_factors(before.clone());
    assert_eq!(after.verify(), Ok(()));
    for seed in 1..20_usize {
        let input = |_: Argument, index: usize| ((seed * (index + 3)) % 17) as f64 - 8.0;
        let sin_cos = |_: f64| unreachable!("there are no angles");
        let [old, new] =
            [&before, &after].map(|program| program.evaluate(sin_cos, "outputs", &[], input));
        assert_eq!(old, new);
    }
    [before, after]
}

fn total(program: &Program) -> usize {
    program.operations(&program.entries[0].outputs).total()
}

/// Checks that a b + a c + d b + d c becomes (a + d) (b + c).
#[test]
fn cofactors_are_factors_in_turn() {
    let mut builder = Builder::default();
    let [a, b, c, d] = inputs(&mut builder);
    let products = [(a, b), (a, c), (d, b), (d, c)].map(|(x, y)| builder.mul(x, y));
    let sum = products[1..]
        .iter()
        .fold(products[0], |sum, &product| builder.add(sum, product));
    let [before, after] = pass(builder, Purpose::KineticEnergy, vec![sum]);
    assert_eq!((total(&before), total(&after)), (7, 3));
}

/// Checks that 3 a b c − 5 a d becomes a (3 b c − 5 d), for all positions of signs and numbers.
#[test]
fn signs_and_numbers_stay_with_their_terms() {
    let mut builder = Builder::default();
    let [a, b, c, d] = inputs(&mut builder);
    let [three, five] = [3, 5].map(|number| builder.integer(number));
    let ab = builder.mul(a, b);
    let abc = builder.mul(ab, c);
    let first = builder.mul(three, abc);
    let ad = builder.mul(d, a);
    let second = builder.mul(five, ad);
    let sum = builder.sub(second, first);
    let [before, after] = pass(builder, Purpose::KineticEnergy, vec![sum]);
    assert_eq!((total(&before), total(&after)), (6, 5));
}

/// Checks that a product which is also used elsewhere is not computed twice.
#[test]
fn products_with_other_uses_stay() {
    let mut builder = Builder::default();
    let [a, b, c] = inputs(&mut builder);
    let (ab, ac) = (builder.mul(a, b), builder.mul(a, c));
    let sum = builder.add(ab, ac);
    let [before, after] = pass(builder, Purpose::KineticEnergy, vec![sum, ab]);
    assert_eq!(before, after);
}

#[test]
fn named_values_stay() {
    let mut builder = Builder::default();
    let [a, b, c] = inputs(&mut builder);
    let (ab, ac) = (builder.mul(a, b), builder.mul(a, c));
    builder.name(ab, "torque");
    let sum = builder.add(ab, ac);
    let [before, after] = pass(builder, Purpose::KineticEnergy, vec![sum]);
    assert_eq!(before, after);
}

/// Checks that sin a cos b − cos a sin b stays zero for a = b, even if other terms share a factor
/// with it.
#[test]
fn differences_of_products_are_opened_for_their_own_factors_only() {
    let mut builder = Builder::default();
    let [a, b, c, d, e] = inputs(&mut builder);
    let (ab, cd, ae) = (builder.mul(a, b), builder.mul(c, d), builder.mul(a, e));
    let difference = builder.sub(ab, cd);
    let sum = builder.add(difference, ae);
    let [before, after] = pass(builder, Purpose::KineticEnergy, vec![sum]);
    assert_eq!(before, after);

    let mut builder = Builder::default();
    let [a, b, c, d, e] = inputs(&mut builder);
    let (ab, ac, de) = (builder.mul(a, b), builder.mul(a, c), builder.mul(d, e));
    let difference = builder.sub(ab, ac);
    let sum = builder.add(difference, de);
    let [before, after] = pass(builder, Purpose::KineticEnergy, vec![sum]);
    assert_eq!((total(&before), total(&after)), (5, 4));
}

/// Checks that with fused operations x + a b + a c takes two operations, as does x + a (b + c).
#[test]
fn fused_products_cost_nothing_in_their_sums() {
    let sums = |[a, b, c, x]: [ValueId; 4], builder: &mut Builder| {
        let (ab, ac) = (builder.mul(a, b), builder.mul(a, c));
        let sum = builder.add(x, ab);
        builder.add(sum, ac)
    };
    for (purpose, saved) in [(Purpose::Accelerations, 0), (Purpose::KineticEnergy, 1)] {
        let mut builder = Builder::default();
        let inputs = inputs(&mut builder);
        let sum = sums(inputs, &mut builder);
        let [before, after] = pass(builder, purpose, vec![sum]);
        assert_eq!(total(&before) - total(&after), saved);
    }
}

/// Checks sums of products of two to four of six inputs, with random signs: the pass never adds
/// operations, and the values never differ by more than the error bounds of both programs.
#[test]
fn random_sums_keep_their_values_within_the_bound() {
    let mut random = SplitMix64::seed_from_u64(1);
    let mut next = |limit: usize| (random.next_u64() >> 33) as usize % limit;
    let mut smaller = 0;
    for _ in 0..300 {
        let terms: Vec<(bool, Vec<usize>)> = (0..2 + next(6))
            .map(|_| (next(2) == 0, (0..2 + next(3)).map(|_| next(6)).collect()))
            .collect();
        let mut builder = Builder::default();
        let inputs: [ValueId; 6] = inputs(&mut builder);
        let mut sum = builder.integer(0);
        for (negative, factors) in &terms {
            let mut product = inputs[factors[0]];
            for &factor in &factors[1..] {
                product = builder.mul(product, inputs[factor]);
            }
            sum = match negative {
                true => builder.sub(sum, product),
                false => builder.add(sum, product),
            };
        }
        if builder.as_constant(sum).is_some() {
            continue;
        }
        let [before, after] = pass(builder, Purpose::KineticEnergy, vec![sum]);
        assert!(total(&after) <= total(&before));
        smaller += usize::from(total(&after) < total(&before));
        let values: Vec<f64> = (0..6).map(|_| next(1 << 30) as f64 / 1e8 - 5.0).collect();
        let size = |(_, factors): &(bool, Vec<usize>)| {
            factors
                .iter()
                .map(|&index| values[index].abs())
                .product::<f64>()
        };
        let sizes: f64 = terms.iter().map(size).sum();
        let roundings = 4 + terms.len();
        let bound = 2.0 * roundings as f64 * f64::EPSILON / 2.0 * sizes;
        let sin_cos = |_: f64| unreachable!("there are no angles");
        let [old, new] = [&before, &after].map(|program| {
            let outputs = program.evaluate(sin_cos, "outputs", &[], |_, index| values[index]);
            outputs.expect("the entry is there")[0]
        });
        assert!((old - new).abs() <= bound, "{old} {new} {bound}");
    }
    assert!(smaller > 100, "{smaller}");
}

/// Checks that a (4 c b + 2 c d) becomes a (2 c (2 b + d)); 4 c is then no longer a constant of the
/// model.
#[test]
fn constants_that_are_powers_of_two_of_others_go() {
    let mut builder = Builder::default();
    let [a, b, d] = inputs(&mut builder);
    let three = builder.setup.number(3.into());
    let c = builder.setup.called(three, "c");
    let terms = [(4, b), (2, d)].map(|(number, value)| {
        let number = builder.setup.number(number.into());
        let constant = builder.setup.mul(number, c);
        let constant = builder.constant(constant);
        let product = builder.mul(constant, value);
        builder.mul(product, a)
    });
    let sum = builder.add(terms[0], terms[1]);
    let [before, after] = pass(builder, Purpose::KineticEnergy, vec![sum]);
    // Without the second rule there would be four operations too, but two constants.
    assert_eq!((total(&before), total(&after)), (5, 4));
    let read = |program: &Program| {
        let definitions = program.definitions.iter();
        let constants = definitions.filter(|one| matches!(one.op, Op::Constant(_)));
        constants.count()
    };
    assert_eq!((read(&before), read(&after)), (2, 1));
}
