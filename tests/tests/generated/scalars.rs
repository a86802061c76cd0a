//! One body of emitted code with every scalar: lanes and batches have the bits
//! of plain numbers, dual numbers the derivatives, double-double the digits.

use branched_pendulum::Pendulum;
use branched_pendulum::batch::{Batch, BatchError};
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::{Double, Dual, InstructionSet, Lane, Lanes};
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::scenes::{
    chain::Chain, generations::Generations, paper::Paper, triplet::Triplet,
};
use std::array::from_fn;

/// 31 rods with friction: more lines than one function takes, and velocities
/// that several of them read.
#[branched_pendulum(
    gravity = 9.80665,
    arm: generations(count = 5, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7, friction = 1e-4),
)]
struct Rods;

/// Angles and velocities of `count` states, link by link.
fn states(links: usize, count: usize) -> (Vec<Vec<f64>>, Vec<Vec<f64>>) {
    let mut random = Random::new(23);
    let mut columns = |size: f64| -> Vec<Vec<f64>> {
        (0..links)
            .map(|_| {
                (0..count)
                    .map(|_| random.array::<1>(-size, size)[0])
                    .collect()
            })
            .collect()
    };
    (columns(40.0), columns(9.0))
}

/// Batches of every count up to two registers and a half, and of some up to two
/// pairs of registers and a half, for every instruction set, against one state
/// after the other: through `accelerations_into` where the registers fuse, by the
/// plain function where they do not.
fn batch_agrees<T: Lane, P: Pendulum<T>, const N: usize>(
    model: &P,
    plain: impl Fn(&[T; N], &[T; N]) -> [T; N],
    convert: fn(f64) -> T,
    bits: fn(T) -> u64,
) {
    let number = |column: Vec<f64>| -> Vec<T> { column.into_iter().map(convert).collect() };
    for count in (0..40).chain(63..82) {
        let (theta, omega) = states(N, count);
        let mut theta: Vec<Vec<T>> = theta.into_iter().map(number).collect();
        let omega: Vec<Vec<T>> = omega.into_iter().map(number).collect();
        if let Some(angle) = theta[0].get_mut(2) {
            // Beyond the common range of sine and cosine.
            *angle = convert(1e9);
        }
        if let Some(angle) = theta[1].get_mut(37) {
            *angle = convert(-1e9);
        }
        for set in InstructionSet::ALL {
            let mut alpha = vec![vec![convert(0.0); count]; N];
            let mut batch = Batch::new(model).no_wider_than(set);
            batch
                .accelerations(convert(0.0), &theta, &omega, &mut alpha)
                .unwrap();
            for i in 0..count {
                let at = |columns: &[Vec<T>]| -> [T; N] { from_fn(|link| columns[link][i]) };
                let expected = if batch.instructions() == InstructionSet::Build {
                    plain(&at(&theta), &at(&omega))
                } else {
                    let mut alpha = [convert(0.0); N];
                    model.accelerations_into(convert(0.0), &at(&theta), &at(&omega), &mut alpha);
                    alpha
                };
                assert_eq!(
                    at(&alpha).map(bits),
                    expected.map(bits),
                    "state {i} of {count}, {set}"
                );
            }
        }
    }
}

macro_rules! batches_agree {
    ($model:ident, $n:literal) => {
        let model = $model::<f64>::new();
        batch_agrees::<f64, _, $n>(
            &model,
            |t, w| model.accelerations(t, w),
            |x| x,
            f64::to_bits,
        );
        let model = $model::<f32>::default();
        batch_agrees::<f32, _, $n>(
            &model,
            |t, w| model.accelerations(t, w),
            |x| x as f32,
            |x| u64::from(x.to_bits()),
        );
    };
}

#[test]
fn batches_have_the_bits_of_single_states() {
    batches_agree!(Paper, 3);
    batches_agree!(Chain, 2);
    batches_agree!(Triplet, 4);
    batches_agree!(Generations, 15);
    batches_agree!(Rods, 31);
}

/// Lanes do not fuse: each has the bits of a plain number.
#[test]
fn lanes_have_the_bits_of_plain_numbers() {
    let (plain, lanes) = (Paper::new(), Paper::<Lanes<f64, 8>>::default());
    let (theta, omega) = states(3, 8);
    let all = |columns: &[Vec<f64>]| -> [Lanes<f64, 8>; 3] {
        from_fn(|link| Lanes(from_fn(|i| columns[link][i])))
    };
    let alpha = lanes.accelerations(&all(&theta), &all(&omega));
    for i in 0..8 {
        let at = |columns: &[Vec<f64>]| -> [f64; 3] { from_fn(|link| columns[link][i]) };
        let expected = plain.accelerations(&at(&theta), &at(&omega));
        assert_eq!(
            alpha.map(|lanes| lanes.0[i].to_bits()),
            expected.map(f64::to_bits)
        );
    }
}

fn one_state_without_answer<P: Pendulum<f64>>(model: &P, link: usize) {
    let (mut theta, omega) = states(model.links(), 11);
    theta[link][4] = f64::NAN;
    let mut alpha = vec![vec![0.0; 11]; model.links()];
    Batch::new(model)
        .accelerations(0.0, &theta, &omega, &mut alpha)
        .unwrap();
    for column in &alpha {
        for (i, value) in column.iter().enumerate() {
            assert_eq!(value.is_nan(), i == 4, "state {i}");
        }
    }
}

#[test]
fn a_state_without_answer_spoils_no_other() {
    one_state_without_answer(&Paper::new(), 1);
    one_state_without_answer(&Generations::new(), 9);
}

#[test]
fn a_batch_that_does_not_fit_is_refused() {
    let model = Paper::new();
    let mut batch = Batch::new(&model);
    let three = [[0.0; 5]; 3];
    let mut alpha = [[1.0; 5]; 3];
    let links = batch
        .accelerations(0.0, &three[..2], &three, &mut alpha)
        .unwrap_err();
    assert_eq!(
        links.to_string(),
        "`theta` needs one slice for each of 3 links, but has 2"
    );
    let uneven = [&[0.0; 5][..], &[0.0; 4], &[0.0; 5]];
    let states = batch
        .accelerations(0.0, &three, &uneven, &mut alpha)
        .unwrap_err();
    assert_eq!(
        states,
        BatchError::States {
            argument: "omega",
            link: 1,
            expected: 5,
            found: 4
        }
    );
    assert_eq!(
        states.to_string(),
        "`omega[1]` holds 4 states, but the first slice of all holds 5"
    );
    let refused = batch.accelerations(0.0, &three, &three, &mut alpha[..1]);
    assert!(matches!(
        refused,
        Err(BatchError::Links {
            argument: "alpha",
            ..
        })
    ));
    assert_eq!(alpha, [[1.0; 5]; 3], "nothing is written");
}

/// Derivatives by dual numbers against central differences in double-double
/// numbers, whose error is the square of the step: 10⁻²⁰.
#[test]
fn dual_numbers_give_the_jacobian() {
    const STEP: f64 = 1e-10;
    let mut random = Random::new(5);
    let duals = Paper::<Dual<f64, 6>>::default();
    let wide = Paper::<Double>::default();
    for _ in 0..50 {
        let theta: [f64; 3] = random.array(-3.0, 3.0);
        let omega: [f64; 3] = random.array(-6.0, 6.0);
        let dual = duals.accelerations(
            &std::array::from_fn(|i| Dual::variable(theta[i], i)),
            &std::array::from_fn(|i| Dual::variable(omega[i], 3 + i)),
        );
        let plain = Paper::new().accelerations(&theta, &omega);
        for direction in 0..6 {
            let shifted = |by: f64| {
                let at = |values: [f64; 3], first: usize| {
                    std::array::from_fn(|i| {
                        let shift = if first + i == direction { by } else { 0.0 };
                        Double::sum(values[i], shift)
                    })
                };
                wide.accelerations(&at(theta, 0), &at(omega, 3))
            };
            let (above, below) = (shifted(STEP), shifted(-STEP));
            for link in 0..3 {
                let slope = (above[link] - below[link]).high() / (2.0 * STEP);
                let found = dual[link].tangents[direction];
                assert!(
                    (found - slope).abs() < 1e-10 * (1.0 + slope.abs()),
                    "{found} {slope}"
                );
                assert_eq!(dual[link].value.to_bits(), plain[link].to_bits());
            }
        }
    }
}

/// M_parent of the paper's pendulum has ten decimals, and no `f64` has its value.
#[test]
fn constants_have_the_digits_of_the_scalar() {
    let exact = Double::from_f64(181_430_108.0) / Double::from_f64(1e10);
    let wide = Paper::<Double>::default().inertia_parent();
    assert_ne!(exact.low(), 0.0);
    let error = ((wide - exact) / exact).high().abs();
    assert!(error < 1e-31, "{error}");
    assert_eq!(wide.high(), Paper::new().inertia_parent());
    let dual = Paper::<Dual<Double, 1>>::default().inertia_parent();
    assert_eq!(dual.value, wide);
}

/// K = ½ ωᵀp, where kinetic energy and momenta are functions of their own.
#[test]
fn double_double_keeps_thirty_digits() {
    let mut random = Random::new(11);
    let wide = Paper::<Double>::default();
    for _ in 0..50 {
        let theta = random.array::<3>(-3.0, 3.0).map(Double::from_f64);
        let omega = random.array::<3>(-6.0, 6.0).map(Double::from_f64);
        let kinetic = wide.kinetic_energy(&theta, &omega);
        let momenta = wide.momenta(&theta, &omega);
        let sum = momenta[0] * omega[0] + momenta[1] * omega[1] + momenta[2] * omega[2];
        let error = ((Double::from_f64(0.5) * sum - kinetic) / kinetic)
            .high()
            .abs();
        // The terms may be ten times their sum.
        assert!(error < 1e-29, "{error}");
    }
}
