//! Emitted models, as they are, on other numbers: variational equations, checked
//! parameters of any real type, every function for many states.

use branched_pendulum::Pendulum;
use branched_pendulum::analysis::variational::{Linearised, linearised};
use branched_pendulum::batch::{Batch, BatchError, StateFunction};
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::{Double, InstructionSet};
use branched_pendulum::state_function;
use branched_pendulum::system::{CastOde, Workspace};
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::scenes::{
    driven::{Driven, DrivenParameters},
    driven_loops::{DrivenLoops, DrivenLoopsParameters},
    generations::Generations,
    paper::Paper,
    sweep::{Sweep, SweepParameters},
};

/// Linearised rates against central differences in double-double numbers, whose error
/// is the square of the step: 10⁻²⁰.
fn derivative_agrees<O>(ode: O, size: f64)
where
    O: CastOde<f64> + Copy,
{
    const STEP: f64 = 1e-10;
    let precise = ode.cast(Double::from_f64);
    let system = linearised(ode);
    let n = ode.dimension();
    let mut random = Random::new(11);
    let mut numbers = |count: usize, size: f64| -> Vec<f64> {
        (0..count).map(|_| random.between(-size, size)).collect()
    };
    let (state, deviation) = (numbers(n, size), numbers(n, 1.0));
    let (mut rates, mut deviation_rates) = (vec![0.0; n], vec![0.0; n]);
    system.linearised_rates(
        &mut Workspace::new(),
        0.3,
        &state,
        &deviation,
        &mut rates,
        &mut deviation_rates,
    );
    let mut plain = vec![0.0; n];
    ode.rates(0.3, &state, &mut plain);
    let zero = Double::from_f64(0.0);
    let moved = |step: f64| {
        let state: Vec<Double> = state
            .iter()
            .zip(&deviation)
            .map(|(&y, &v)| Double::from_f64(y) + Double::from_f64(step) * Double::from_f64(v))
            .collect();
        let mut rates = vec![zero; n];
        precise.rates(Double::from_f64(0.3), &state, &mut rates);
        rates
    };
    let (plus, minus) = (moved(STEP), moved(-STEP));
    let largest = |values: &[f64]| values.iter().fold(0.0_f64, |max, v| max.max(v.abs()));
    let (rate_size, derivative_size) = (largest(&rates), largest(&deviation_rates));
    assert!(rate_size > 0.1 && derivative_size > 0.1);
    for i in 0..n {
        let difference = (plus[i] - minus[i]) / Double::from_f64(2.0 * STEP);
        let error = (deviation_rates[i] - difference.to_f64()).abs();
        assert!(error < 1e-11 * derivative_size, "{i}: {error}");
        assert!((rates[i] - plain[i]).abs() < 1e-12 * rate_size, "{i}");
    }
}

#[test]
fn models_are_linearised_as_they_are() {
    let paper = Paper::new();
    derivative_agrees(AbsoluteAngles(&paper), 3.0);
    derivative_agrees(AbsoluteAngles(paper), 3.0);
    derivative_agrees(SymmetricCoordinates(&paper), 3.0);
    derivative_agrees(CanonicalVariables(&paper), 0.1);
    let driven = Driven::new(DrivenParameters {
        push: 0.01,
        pace: 3.0,
        phase: 0.4,
        sway: 0.02,
    });
    derivative_agrees(AbsoluteAngles(&driven.unwrap()), 3.0);
    let loops = DrivenLoops::new(DrivenLoopsParameters {
        push: 0.2,
        pace: 3.0,
    });
    derivative_agrees(AbsoluteAngles(&loops.unwrap()), 3.0);
}

#[test]
fn parameters_are_checked_in_every_real_type() {
    let right = SweepParameters {
        g: 9.81_f32,
        trunk_mass: 0.2,
        c: 1e-3,
        twig_length: 0.15,
    };
    let model = Sweep::new(right).expect("they are right");
    assert_eq!(model, Sweep::from_parameters_unchecked(right));
    let wrong = SweepParameters {
        trunk_mass: -0.2,
        ..right
    };
    let error = Sweep::new(wrong).unwrap_err();
    assert!(error.to_string().contains("must be"), "{error}");
    let unknown = SweepParameters {
        twig_length: f32::NAN,
        ..right
    };
    assert!(Sweep::new(unknown).is_err());
    let precise = SweepParameters {
        g: Double::from_f64(9.81),
        trunk_mass: Double::from_f64(0.2),
        c: Double::from_f64(1e-3),
        twig_length: Double::from_f64(0.15),
    };
    assert!(Sweep::new(precise).is_ok());
}

/// A function in batches of several counts against one state after the other: bit for
/// bit where nothing fuses, and to rounding otherwise, with equal bits whatever the
/// place in the batch.
fn batch_agrees<P, F, const N: usize, const M: usize>(
    model: &P,
    function: impl Fn() -> F,
    plain: impl Fn(&[f64; N], &[f64; N]) -> [f64; M],
) where
    P: Pendulum<f64>,
    F: StateFunction<P, f64, 2>,
{
    for count in [0, 1, 2, 3, 5, 8, 9, 16, 21] {
        let mut random = Random::new(31);
        let mut columns = |size: f64| -> Vec<Vec<f64>> {
            let mut column = || (0..count).map(|_| random.between(-size, size)).collect();
            (0..N).map(|_| column()).collect()
        };
        let (first, second) = (columns(4.0), columns(0.01));
        for set in InstructionSet::ALL {
            let mut values = vec![vec![0.0; count]; M];
            let mut batch = Batch::new(model).no_wider_than(set);
            batch
                .evaluate(function(), 0.0, [&first, &second], &mut values)
                .unwrap();
            for state in 0..count {
                let of = |columns: &[Vec<f64>]| std::array::from_fn(|link| columns[link][state]);
                let expected = plain(&of(&first), &of(&second));
                let size = expected.iter().fold(0.0_f64, |max, v| max.max(v.abs()));
                for (value, expected) in values.iter().zip(expected) {
                    match batch.instructions() {
                        InstructionSet::Build => {
                            assert_eq!(value[state].to_bits(), expected.to_bits());
                        }
                        _ => assert!((value[state] - expected).abs() <= 1e-11 * size),
                    }
                }
                // Alone, a state gets the same bits.
                let alone = |columns: &[Vec<f64>]| -> Vec<Vec<f64>> {
                    columns.iter().map(|column| vec![column[state]]).collect()
                };
                let mut own = vec![vec![0.0]; M];
                let arguments = [&alone(&first)[..], &alone(&second)];
                batch
                    .evaluate(function(), 0.0, arguments, &mut own)
                    .unwrap();
                for (own, value) in own.iter().zip(&values) {
                    assert_eq!(own[0].to_bits(), value[state].to_bits());
                }
            }
        }
    }
}

#[test]
fn every_function_has_batches() {
    let paper = Paper::new();
    batch_agrees(
        &paper,
        || state_function!(|model: Paper, q, v| model.kinetic_energy(q, v)),
        |q, v| [paper.kinetic_energy(q, v)],
    );
    batch_agrees(
        &paper,
        || state_function!(|model: Paper, q, v| model.momenta(q, v)),
        |q, v| paper.momenta(q, v),
    );
    batch_agrees(
        &paper,
        || state_function!(|model: Paper, q, p| model.canonical_rates(q, p)),
        |q: &[f64; 3], p| {
            let [q_rates, p_rates] = paper.canonical_rates(q, p);
            std::array::from_fn::<f64, 6, _>(|i| [q_rates, p_rates].concat()[i])
        },
    );
    batch_agrees(
        &paper,
        || state_function!(|model: Paper, q, p| model.transfer_exact(q, p)),
        |q, p| {
            let transfer = paper.transfer_exact(q, p);
            [transfer.kinetic, transfer.potential]
        },
    );
    let generations = Generations::new();
    batch_agrees(
        &generations,
        || state_function!(|model: Generations, q, v| model.budget_parseval(q, v)),
        |q: &[f64; 15], v| {
            let budget = generations.budget_parseval(q, v);
            let values = [budget.energies, budget.transfers, budget.powers].concat();
            std::array::from_fn::<f64, 24, _>(|i| values[i])
        },
    );
    let loops = DrivenLoops::new(DrivenLoopsParameters {
        push: 0.2,
        pace: 3.0,
    });
    let loops = loops.unwrap();
    batch_agrees(
        &loops,
        || state_function!(|model: DrivenLoops, time; q, v| model.drive_power(time, q, v)),
        |q: &[f64; 127], v| [loops.drive_power(0.0, q, v)],
    );
}

#[test]
fn slices_for_other_values_are_refused() {
    let model = Paper::new();
    let states = [[0.0; 5]; 3];
    let mut values = [[1.0; 5]; 3];
    let transfer = state_function!(|model: Paper, q, p| model.transfer_exact(q, p));
    let error = Batch::new(&model)
        .evaluate(transfer, 0.0, [&states, &states], &mut values)
        .unwrap_err();
    assert_eq!(
        error,
        BatchError::Values {
            expected: 2,
            found: 3
        }
    );
    assert_eq!(
        error.to_string(),
        "the function has 2 values, which need one slice each, but there are 3"
    );
    assert_eq!(values, [[1.0; 5]; 3]);
}
