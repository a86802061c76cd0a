//! The energy transfer along the motion: dH_d/dt by finite differences, and
//! the orders of the truncated forms.

use branched_pendulum::prelude::*;
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::scenes::paper::Paper;

use crate::fixtures::{Frictional, Triple};
use crate::support::Worst;

/// Time derivative of an observable of (θ, ω) along the motion through a
/// state: central differences of eighth order over ±4 short steps, each taken
/// at once from the state. The steps' own error is of ninth order.
pub(crate) fn rate<P: Pendulum<f64>>(
    model: &P,
    theta: &[f64],
    omega: &[f64],
    observable: impl Fn(&[f64], &[f64]) -> f64,
) -> f64 {
    const STEP: f64 = 1e-3;
    const WEIGHTS: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    let start = State::from_positions_and_velocities(0.0, theta, omega).expect("equal lengths");
    let method = Dop853::new(Options::with_tolerance(1e-13));
    let value = |step: f64| {
        let state = method
            .step(&AbsoluteAngles(model), &start, step)
            .expect("a regular state");
        observable(state.positions(), state.velocities())
    };
    let sum: f64 = WEIGHTS
        .iter()
        .zip(1..)
        .map(|(weight, count)| {
            let step = f64::from(count) * STEP;
            weight * (value(step) - value(-step))
        })
        .sum();
    sum / STEP
}

/// Accuracy of the differences: those of energies over milliseconds lose three
/// digits. In units of the energy times 10 rad/s, a rate at which these
/// pendulums can exchange it.
const DIFFERENCES: f64 = 1e-12;

fn states<const N: usize>(seed: u64) -> impl Iterator<Item = ([f64; N], [f64; N])> {
    let mut random = Random::new(seed);
    std::iter::from_fn(move || {
        let theta = [(); N].map(|()| random.between(-1.5, 1.5));
        let omega = [(); N].map(|()| random.between(-4.0, 4.0));
        Some((theta, omega))
    })
    .take(200)
}

fn array<const N: usize>(slice: &[f64]) -> [f64; N] {
    slice.try_into().expect("as many values as links")
}

/// Compares W_exact + friction power with dH/dt for one difference of a model.
macro_rules! assert_rate {
    ($model:expr, $energy:ident, $exact:ident, $from_rates:ident, $($friction:ident)?) => {{
        let model = $model;
        let mut worst = Worst::default();
        let mut largest = 0.0_f64;
        for (count, (theta, omega)) in states(5).enumerate() {
            let (q, v) = (model.to_symmetric(&theta), model.to_symmetric(&omega));
            let p = model.symmetric_momenta(&q, &v);
            let exact = model.$exact(&q, &p).total();
            let by_rates = model.$from_rates(&q, &v).total();
            #[allow(unused_mut)]
            let mut friction = 0.0;
            $( friction += model.$friction(&q, &p); )?
            let measured = rate(&model, &theta, &omega, |theta, omega| {
                let q = model.to_symmetric(&array(theta));
                let v = model.to_symmetric(&array(omega));
                model.$energy(&q, &model.symmetric_momenta(&q, &v))
            });
            let scale = 10.0 * (model.kinetic_energy(&theta, &omega) + model.$energy(&q, &p));
            worst.note(exact + friction - measured, scale, || format!("state {count}"));
            worst.note(by_rates + friction - measured, scale, || format!("rates, state {count}"));
            largest = largest.max((exact / scale).abs());
        }
        // The comparison is of something.
        assert!(largest > 0.1, "{largest}");
        worst.assert_below(DIFFERENCES, stringify!($exact));
    }};
}

#[test]
fn exact_transfer_is_the_rate_of_the_energy() {
    assert_rate!(
        Paper::new(),
        antiphase_energy,
        transfer_exact,
        transfer_exact_from_rates,
    );
}

#[test]
fn with_friction_the_rate_is_transfer_and_power() {
    let model = Frictional::new();
    assert_rate!(
        model,
        antiphase_energy,
        transfer_exact,
        transfer_exact_from_rates,
        antiphase_friction_power
    );
}

#[test]
fn each_difference_of_a_triple_has_its_rate() {
    assert_rate!(
        Triple::new(),
        antiphase_energy_d1,
        transfer_exact_d1,
        transfer_exact_from_rates_d1,
        antiphase_friction_power_d1
    );
    assert_rate!(
        Triple::new(),
        antiphase_energy_d2,
        transfer_exact_d2,
        transfer_exact_from_rates_d2,
        antiphase_friction_power_d2
    );
}

/// Amplitudes that halve, from ε = 1/4.
fn amplitudes() -> impl Iterator<Item = f64> {
    (2..9).map(|power| 0.5_f64.powi(power))
}

/// The orders log₂(e(ε)/e(ε/2)) of some errors.
fn orders(errors: &[f64]) -> Vec<f64> {
    errors
        .windows(2)
        .map(|pair| (pair[0] / pair[1]).abs().log2())
        .collect()
}

/// In-phase states (θ_1, θ_m), (p_1, p_m) and the direction (θ_d, p_d) of a
/// disturbance, all of the sizes that the paper's motion has.
fn disturbances() -> impl Iterator<Item = ([f64; 2], [f64; 2], [f64; 2])> {
    let mut random = Random::new(9);
    std::iter::from_fn(move || {
        Some((
            [random.between(-1.0, 1.0), random.between(-2.0, 2.0)],
            [random.between(-0.07, 0.07), random.between(-0.02, 0.02)],
            [random.between(0.5, 1.0), random.between(-0.01, 0.01)],
        ))
    })
    .take(50)
}

/// The consistent form is W up to fourth order in the amplitude: W is even.
/// The published form holds two of the quadratic form's four terms, so that
/// its relative error tends to a constant (physics §5).
#[test]
fn orders_of_the_truncated_forms() {
    let model = Paper::new();
    let mut published_squares = 0.0;
    let mut exact_squares = 0.0;
    for ([theta_1, theta_m], [p_1, p_m], [theta_d, p_d]) in disturbances() {
        let mut consistent = Vec::new();
        let mut published = Vec::new();
        for epsilon in amplitudes() {
            let q = [theta_1, theta_m, epsilon * theta_d];
            let p = [p_1, p_m, epsilon * p_d];
            let exact = model.transfer_exact(&q, &p).total();
            consistent.push(model.transfer_amplitude_2(&q, &p).total() - exact);
            published.push(model.transfer_angle_1(&q, &p).total() - exact);
            if epsilon < 0.005 {
                published_squares += (published[published.len() - 1] / epsilon.powi(2)).powi(2);
                exact_squares += (exact / epsilon.powi(2)).powi(2);
            }
        }
        let consistent = orders(&consistent);
        let last = consistent[consistent.len() - 1];
        assert!((last - 4.0).abs() < 0.02, "{consistent:?}");
        // W itself is of second order, and so is the published form's error.
        let published = orders(&published);
        let last = published[published.len() - 1];
        assert!((last - 2.0).abs() < 0.02, "{published:?}");
    }
    let share = (published_squares / exact_squares).sqrt();
    println!("the published form's error, as a share of W in the mean square: {share}");
    assert!(share > 0.1);
}

/// Three copies have cubic terms: exchanging them maps neither difference to
/// its opposite without changing the other. Some directions have hardly any,
/// so that the order is that of the mean square over many.
#[test]
fn orders_for_a_triple() {
    let model = Triple::new();
    let mut squares = [vec![0.0; 7], vec![0.0; 7]];
    for (theta, omega) in states(11) {
        let (q, v) = (model.to_symmetric(&theta), model.to_symmetric(&omega));
        let p = model.symmetric_momenta(&q, &v);
        for (place, epsilon) in amplitudes().enumerate() {
            let (mut q, mut p) = (q, p);
            for d in [3, 4] {
                q[d] *= epsilon;
                p[d] *= epsilon;
            }
            let exact = [
                model.transfer_exact_d1(&q, &p).total(),
                model.transfer_exact_d2(&q, &p).total(),
            ];
            let truncated = [
                model.transfer_amplitude_2_d1(&q, &p).total(),
                model.transfer_amplitude_2_d2(&q, &p).total(),
            ];
            for difference in 0..2 {
                let error = truncated[difference] - exact[difference];
                squares[difference][place] += error * error;
            }
        }
    }
    for squares in squares {
        let orders = orders(&squares.iter().map(|s| s.sqrt()).collect::<Vec<f64>>());
        let last = orders[orders.len() - 1];
        assert!((last - 3.0).abs() < 0.02, "{orders:?}");
    }
}
