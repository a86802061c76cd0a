//! Derivatives of a motion: by the discrete adjoint, against variational equations in dual numbers
//! and against differences of runs.

use branched_pendulum::Parametric;
use branched_pendulum::analysis::variational::{flow_jacobian, linearised};
use branched_pendulum::batch::Batch;
use branched_pendulum::integrate::{Crossing, InputError, MotionGradient, Solver};
use branched_pendulum::prelude::*;
use branched_pendulum::system::{At, WithIntegral, functions};
use branched_pendulum_compiler_tests::random::Random;

/// The apparatus of the paper with parameters, friction and a drive.
#[branched_pendulum(
    gravity = g,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = reach, friction = f) [
        child(mass = m, com = 0.043, inertia = 0.516e-3, friction = f / 10) * 2
    ],
    drive(torque = push * cos(3 * t)),
    emit(energies, forces, gradient),
)]
struct Branched;

/// The apparatus of the paper in numbers, without friction and drive.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ],
    emit(energies, gradient(accelerations)),
)]
struct Paper;

const VALUES: [f64; 5] = [9.80665, 0.27, 1e-3, 0.10531, 0.01];

fn branched(values: &[f64; 5]) -> Branched {
    Branched::<f64>::with_parameters(|index| values[index])
}

fn method() -> Dop853<f64> {
    Dop853::new(Options::with_tolerance(1e-13))
}

fn start() -> State<f64> {
    State::new(0.0, vec![0.4, -0.3, 0.5, 0.2, 1.0, -0.7])
}

/// Largest error, relative to the largest expected value.
fn error(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let size = expected
        .iter()
        .fold(0.0_f64, |size, value| size.max(value.abs()));
    let errors = found
        .iter()
        .zip(expected)
        .map(|(found, expected)| (found - expected).abs());
    errors.fold(0.0, f64::max) / size
}

/// The derivatives of Σ w y(10 s) by the start are Φᵀ w with the matrix Φ of the variational
/// equations.
#[test]
fn derivatives_by_the_start_are_those_of_the_variational_equations() {
    let mut random = Random::new(11);
    let weights: [f64; 6] = random.array(-1.0, 1.0);
    let cost = |_: usize, state: &[f64], slopes: &mut [f64]| {
        slopes.copy_from_slice(&weights);
        state
            .iter()
            .zip(&weights)
            .map(|(value, weight)| value * weight)
            .sum()
    };
    let paper = Paper::new();
    let ode = AbsoluteAngles(&paper);
    let gradient = method()
        .gradient(&ode, 0, &start(), &[10.0], cost)
        .expect("a motion");
    let (_, columns) =
        flow_jacobian(&method(), &linearised(ode), &start(), 10.0).expect("a motion");
    let columns: Vec<f64> = columns;
    let expected: Vec<f64> = (0..6)
        .map(|index| {
            let column = &columns[6 * index..6 * (index + 1)];
            column
                .iter()
                .zip(&weights)
                .map(|(slope, weight)| slope * weight)
                .sum()
        })
        .collect();
    let error = error(&gradient.start, &expected);
    println!("{error:.2e} after {} steps", gradient.steps);
    assert!(error < 1e-10, "{error}");
}

/// The steps of [`Gauss`] have one length: its derivatives by the start are those of the same
/// steps with the variational equations, and those by parameters are differences of runs.
#[test]
fn gauss_has_the_derivatives_of_its_steps() {
    let weights = [0.3, -0.8, 0.5, 0.1, -0.2, 0.7];
    let cost = |_: usize, state: &[f64], slopes: &mut [f64]| {
        slopes.copy_from_slice(&weights);
        let terms = state.iter().zip(&weights);
        terms.map(|(value, weight)| value * weight).sum()
    };
    for order in [
        GaussOrder::Two,
        GaussOrder::Four,
        GaussOrder::Six,
        GaussOrder::Eight,
    ] {
        let method = Gauss::new(order, 0.02);
        let run = |values: &[f64; 5], start: &State<f64>| {
            let model = branched(values);
            let found = method.gradient(&AbsoluteAngles(&model), 5, start, &[1.0, 2.01], cost);
            found.expect("a motion")
        };
        let gradient = run(&VALUES, &start());
        let (by_start, by_parameters) = differences(&|values, start| run(values, start).cost);
        let [by_parameters, by_start] = [
            error(&gradient.parameters, &by_parameters),
            error(&gradient.start, &by_start),
        ];
        println!("{order:?}: {by_parameters:.1e} {by_start:.1e} by differences");
        assert!(by_parameters.max(by_start) < 1e-8);

        let paper = Paper::new();
        let ode = AbsoluteAngles(&paper);
        let gradient = method
            .gradient(&ode, 0, &start(), &[2.01], cost)
            .expect("a motion");
        let (_, columns): (_, Vec<f64>) =
            flow_jacobian(&method, &linearised(ode), &start(), 2.01).expect("a motion");
        let columns = columns.chunks_exact(6);
        let expected: Vec<f64> = columns
            .map(|column| column.iter().zip(&weights).map(|(a, b)| a * b).sum())
            .collect();
        let error = error(&gradient.start, &expected);
        println!("{order:?}: {error:.1e} by the variational equations");
        assert!(error < 1e-12, "{error}");
    }
    // Steps that are too long for the iteration.
    let stiff = branched(&[9.80665, 0.27, 50.0, 0.10531, 0.01]);
    let method = Gauss {
        solver: Solver::Newton,
        ..Gauss::new(GaussOrder::Four, 0.1)
    };
    let found = method.gradient(&AbsoluteAngles(&stiff), 5, &start(), &[1.0], cost);
    assert!(
        matches!(found, Err(IntegrationError::NotSolved { .. })),
        "{found:?}"
    );
}

/// Of a motion of many steps only some states are kept; the others are computed again.
#[test]
fn derivatives_of_many_steps_are_those_of_few() {
    let model = branched(&VALUES);
    let ode = AbsoluteAngles(&model);
    let cost = |_: usize, state: &[f64], slopes: &mut [f64]| {
        slopes[2] = 1.0;
        state[2]
    };
    let times = [1.3, 5.0];
    let few = method()
        .gradient(&ode, 5, &start(), &times, cost)
        .expect("a motion");
    let mut options = Options::with_tolerance(1e-6);
    options.max_step = Some(5e-4);
    let many = Dopri5::new(options).gradient(&ode, 5, &start(), &times, cost);
    let many = many.expect("a motion");
    assert!(many.steps >= 10_000);
    let errors = [
        error(&many.parameters, &few.parameters),
        error(&many.start, &few.start),
    ];
    println!("{errors:?} with {} and {} steps", many.steps, few.steps);
    assert!(errors[0].max(errors[1]) < 1e-9, "{errors:?}");
}

/// Derivatives by start and parameters, from central differences of order 6.
fn differences(cost: &dyn Fn(&[f64; 5], &State<f64>) -> f64) -> (Vec<f64>, Vec<f64>) {
    let difference = |step: f64, at: &dyn Fn(f64) -> f64| {
        let pair = |steps: f64| at(steps * step) - at(-steps * step);
        (45.0 * pair(1.0) - 9.0 * pair(2.0) + pair(3.0)) / (60.0 * step)
    };
    let by_start = (0..6).map(|index| {
        difference(2e-3, &|change| {
            let mut start = start();
            start.values[index] += change;
            cost(&VALUES, &start)
        })
    });
    let by_parameters = (0..5).map(|index| {
        difference(2e-3 * VALUES[index], &|change| {
            let mut values = VALUES;
            values[index] += change;
            cost(&values, &start())
        })
    });
    (by_start.collect(), by_parameters.collect())
}

/// Sum of the squares of the angles at several times.
fn spread(model: &Branched, start: &State<f64>) -> MotionGradient<f64> {
    let cost = |index: usize, state: &[f64], slopes: &mut [f64]| {
        let weight = 1.0 + index as f64;
        let mut sum = 0.0;
        for link in 0..3 {
            slopes[link] = 2.0 * weight * state[link];
            sum += weight * state[link] * state[link];
        }
        sum
    };
    let times = [0.0, 0.7, 1.9, 4.0];
    let gradient = method().gradient(&AbsoluteAngles(model), 5, start, &times, cost);
    gradient.expect("a motion")
}

/// Derivatives of a cost of samples by start and parameters, against differences of order 6.
#[test]
fn derivatives_by_parameters_agree_with_differences_of_runs() {
    let gradient = spread(&branched(&VALUES), &start());
    let (by_start, by_parameters) =
        differences(&|values, start| spread(&branched(values), start).cost);
    for (found, expected) in gradient.parameters.iter().zip(&by_parameters) {
        assert!(
            (found - expected).abs() < 1e-8 * expected.abs(),
            "{found} {expected}"
        );
    }
    let error = error(&gradient.start, &by_start);
    assert!(error < 1e-8, "{error}");
}

/// With the weights of one link the derivatives are a row of the Jacobian matrix, by torques too.
#[test]
fn pullbacks_of_models_are_rows_of_the_jacobian_matrix() {
    let model = branched(&VALUES);
    let (theta, omega, torques) = ([0.4, -0.3, 0.5], [0.2, 1.0, -0.7], [0.01, -0.02, 0.03]);
    let (by_theta, by_omega, by_torques, _) =
        model.accelerations_under_pullback(0.3, &theta, &omega, &torques, &[0.0, 1.0, 0.0]);
    let at = |change: f64, kind: usize, link: usize| {
        let mut state = [theta, omega, torques];
        state[kind][link] += change;
        model.accelerations_under(0.3, &state[0], &state[1], &state[2])[1]
    };
    for (kind, found) in [by_theta, by_omega, by_torques].into_iter().enumerate() {
        for (link, found) in found.into_iter().enumerate() {
            let step = 1e-5;
            let expected = (at(step, kind, link) - at(-step, kind, link)) / (2.0 * step);
            assert!(
                (found - expected).abs() < 1e-6 * (1.0 + expected.abs()),
                "{found} {expected}"
            );
        }
    }
}

/// A batch gives the derivatives of each state.
#[test]
fn batches_have_pullbacks() {
    const STATES: usize = 11;
    let model = branched(&VALUES);
    let mut random = Random::new(5);
    let mut columns = || -> [[f64; STATES]; 3] { std::array::from_fn(|_| random.array(-2.0, 2.0)) };
    let [theta, omega, weights] = [columns(), columns(), columns()];
    let (mut first, mut second, mut parameters) =
        ([[0.0; STATES]; 3], [[0.0; STATES]; 3], [[0.0; STATES]; 5]);
    Batch::new(&model)
        .compute(
            functions::AccelerationsPullback,
            At::time(0.3),
            [&theta[..], &omega[..], &weights[..]],
            [&mut first[..], &mut second[..], &mut parameters[..]],
        )
        .expect("all columns have one length");
    for state in 0..STATES {
        let of = |columns: &[[f64; STATES]; 3]| columns.map(|column| column[state]);
        let expected = model.accelerations_pullback(0.3, &of(&theta), &of(&omega), &of(&weights));
        assert!(error(&of(&first), &expected.0) < 1e-13);
        assert!(error(&of(&second), &expected.1) < 1e-13);
        assert!(error(&parameters.map(|column| column[state]), &expected.2) < 1e-13);
    }
}

/// The time at which a child hangs down for the first time.
#[test]
fn derivatives_of_the_time_of_an_event_agree_with_differences() {
    let hangs = |state: &[f64], slopes: &mut [f64]| {
        slopes[1] = state[1].cos();
        state[1].sin()
    };
    let crossing = |values: &[f64; 5], start: &State<f64>| {
        let model = branched(values);
        let ode = AbsoluteAngles(&model);
        let found = method().gradient_of_crossing(&ode, 5, start, 5.0, Crossing::Either, hangs);
        found.expect("a motion").expect("it swings through")
    };
    let gradient = crossing(&VALUES, &start());
    println!("{:.3} s", gradient.cost);
    let (by_start, by_parameters) = differences(&|values, start| crossing(values, start).cost);
    let [by_parameters, by_start] = [
        error(&gradient.parameters, &by_parameters),
        error(&gradient.start, &by_start),
    ];
    println!("{by_parameters:.1e} {by_start:.1e}");
    assert!(
        by_parameters < 1e-8 && by_start < 1e-8,
        "{by_parameters} {by_start}"
    );

    // It does not hang upwards.
    let upwards = |state: &[f64], slopes: &mut [f64]| {
        slopes[1] = 1.0;
        state[1] - 3.0
    };
    let model = branched(&VALUES);
    let ode = AbsoluteAngles(&model);
    let found = method().gradient_of_crossing(&ode, 5, &start(), 5.0, Crossing::Either, upwards);
    assert_eq!(found.expect("a motion"), None);
}

/// A chaotic motion amplifies small changes without bound, a regular one does not.
#[test]
fn growth_tells_chaotic_from_regular_motions() {
    let paper = Paper::new();
    let ode = AbsoluteAngles(&paper);
    let end = |_: usize, state: &[f64], slopes: &mut [f64]| {
        slopes[0] = 1.0;
        state[0]
    };
    let growth = |degrees: f64| {
        let start = State::at_rest(0.0, &[degrees.to_radians(), 0.1, 0.0]);
        let gradient = method().gradient(&ode, 0, &start, &[20.0], end);
        gradient.expect("a motion").growth
    };
    let (regular, chaotic) = (growth(10.0), growth(120.0));
    println!("{regular:.1e} {chaotic:.1e}");
    assert!(regular < 1e3, "{regular}");
    assert!(chaotic > 1e8, "{chaotic}");
}

/// The derivatives of ∫ (θ_0² + ω_1²) dt, against differences.
#[test]
fn derivatives_of_integrals_agree_with_differences() {
    let integrand = |_: f64, state: &[f64], slopes: &mut [f64]| {
        (slopes[0], slopes[4]) = (2.0 * state[0], 2.0 * state[4]);
        state[0] * state[0] + state[4] * state[4]
    };
    let integral = |values: &[f64; 5], start: &State<f64>| {
        let model = branched(values);
        let ode = WithIntegral::new(AbsoluteAngles(&model), integrand);
        let mut start = start.clone();
        start.values.push(0.0);
        let end = |_: usize, state: &[f64], slopes: &mut [f64]| {
            slopes[6] = 1.0;
            state[6]
        };
        let found = method().gradient(&ode, 5, &start, &[3.0], end);
        found.expect("a motion")
    };
    let gradient = integral(&VALUES, &start());
    let (by_start, by_parameters) = differences(&|values, start| integral(values, start).cost);
    let [by_parameters, by_start] = [
        error(&gradient.parameters, &by_parameters),
        error(&gradient.start[..6], &by_start),
    ];
    println!("{by_parameters:.1e} {by_start:.1e}");
    assert!(by_parameters.max(by_start) < 1e-8);
    // The integral from the start on does not depend on what it was before.
    assert!((gradient.start[6] - 1.0).abs() < 1e-15);
}

/// A wrong number of parameters is refused, not answered with wrong derivatives.
#[test]
fn a_wrong_number_of_parameters_is_refused() {
    let model = branched(&VALUES);
    let cost = |_: usize, _: &[f64], _: &mut [f64]| 1.0;
    let ode = AbsoluteAngles(&model);
    for parameters in [0, 4, 6] {
        let result = method().gradient(&ode, parameters, &start(), &[1.0], cost);
        assert!(
            matches!(
                result,
                Err(IntegrationError::Input(InputError::Parameters { found })) if found == parameters
            ),
            "{parameters}"
        );
    }
}
