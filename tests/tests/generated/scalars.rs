//! One body of emitted code with every scalar: lanes and batches have the bits
//! of plain numbers, dual numbers the derivatives, double-double the digits.

use branched_pendulum::batch::{Batch, BatchError};
use branched_pendulum::scalar::{Double, Dual, InstructionSet, Lane, Lanes};
use branched_pendulum::{Pendulum, Scalar};
use branched_pendulum_tests::random::Random;
use branched_pendulum_tests::scenes::{chain::Chain, paper::Paper, triplet::Triplet};

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

/// Batches of every count up to three blocks and a half, for every instruction
/// set, against one state after the other.
fn batch_agrees<T, P, B, const N: usize>(
    plain: &P,
    lanes: &B,
    convert: fn(f64) -> T,
    bits: fn(T) -> u64,
) where
    T: Lane,
    P: Pendulum<T>,
    B: Pendulum<Lanes<T, N>>,
{
    let number = |column: Vec<f64>| -> Vec<T> { column.into_iter().map(convert).collect() };
    for count in 0..3 * N + N / 2 {
        let (theta, omega) = states(P::LINKS, count);
        let mut theta: Vec<Vec<T>> = theta.into_iter().map(number).collect();
        let omega: Vec<Vec<T>> = omega.into_iter().map(number).collect();
        if let Some(angle) = theta[0].get_mut(2) {
            // Beyond the common range of sine and cosine.
            *angle = convert(1e9);
        }
        for set in InstructionSet::ALL {
            let mut alpha = vec![vec![convert(0.0); count]; P::LINKS];
            let mut batch = Batch::new(lanes).no_wider_than(set);
            batch
                .accelerations(convert(0.0), &theta, &omega, &mut alpha)
                .unwrap();
            for i in 0..count {
                let at = |columns: &[Vec<T>]| -> Vec<T> { columns.iter().map(|c| c[i]).collect() };
                let mut expected = vec![convert(0.0); P::LINKS];
                plain.accelerations_into(convert(0.0), &at(&theta), &at(&omega), &mut expected);
                let expected: Vec<u64> = expected.into_iter().map(bits).collect();
                let found: Vec<u64> = at(&alpha).into_iter().map(bits).collect();
                assert_eq!(found, expected, "state {i} of {count}, {set}");
            }
        }
    }
}

#[test]
fn batches_have_the_bits_of_single_states() {
    let single = |x: f64| x as f32;
    let single_bits = |x: f32| u64::from(x.to_bits());
    let double = |x: f64| x;
    batch_agrees::<f64, _, _, 4>(
        &Paper::<f64>::new(),
        &Paper::default(),
        double,
        f64::to_bits,
    );
    batch_agrees::<f64, _, _, 8>(
        &Paper::<f64>::new(),
        &Paper::default(),
        double,
        f64::to_bits,
    );
    batch_agrees::<f64, _, _, 8>(
        &Chain::<f64>::new(),
        &Chain::default(),
        double,
        f64::to_bits,
    );
    batch_agrees::<f64, _, _, 8>(
        &Triplet::<f64>::new(),
        &Triplet::default(),
        double,
        f64::to_bits,
    );
    batch_agrees::<f32, _, _, 8>(
        &Paper::<f32>::default(),
        &Paper::default(),
        single,
        single_bits,
    );
    batch_agrees::<f32, _, _, 16>(
        &Paper::<f32>::default(),
        &Paper::default(),
        single,
        single_bits,
    );
}

#[test]
fn a_state_without_answer_spoils_no_other() {
    let lanes = Paper::<Lanes<f64, 8>>::default();
    let (mut theta, omega) = states(3, 11);
    theta[1][4] = f64::NAN;
    let mut alpha = vec![vec![0.0; 11]; 3];
    Batch::new(&lanes)
        .accelerations(0.0, &theta, &omega, &mut alpha)
        .unwrap();
    for column in &alpha {
        for (i, value) in column.iter().enumerate() {
            assert_eq!(value.is_nan(), i == 4, "state {i}");
        }
    }
}

#[test]
fn a_batch_that_does_not_fit_is_refused() {
    let lanes = Paper::<Lanes<f64, 8>>::default();
    let mut batch = Batch::new(&lanes);
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
        "`omega[1]` holds 4 states, but `theta[0]` holds 5"
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
