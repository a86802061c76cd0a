//! Energies gain as much as a drive and friction feed.

use branched_pendulum::prelude::*;
use branched_pendulum::system::OdeFn;
use branched_pendulum_tests::scenes::driven::{Driven, DrivenParameters};

fn driven() -> Driven {
    let parameters = DrivenParameters {
        push: 0.2,
        pace: 8.0,
        phase: 0.7,
        sway: 0.04,
    };
    Driven::new(parameters).expect("possible parameters")
}

/// Integrates the driven fixture and, beside it, powers; returns the largest
/// |E(t) − E(0) − ∫P dt| and the largest |E|, of all samples.
fn balance(
    energy: impl Fn(&Driven, &[f64; 3], &[f64; 3]) -> f64,
    power: impl Fn(&Driven, f64, &[f64; 3], &[f64; 3]) -> f64,
) -> (f64, f64) {
    let model = driven();
    let halves = |state: &[f64]| -> ([f64; 3], [f64; 3]) {
        let half = |part: &[f64]| part.try_into().expect("three links");
        (half(&state[..3]), half(&state[3..6]))
    };
    let system = OdeFn::new(7, |time: f64, state: &[f64], rates: &mut [f64]| {
        let (theta, omega) = halves(state);
        rates[..3].copy_from_slice(&omega);
        rates[3..6].copy_from_slice(&model.accelerations(time, &theta, &omega));
        rates[6] = power(&model, time, &theta, &omega);
    });
    let start = State::new(0.0, vec![0.9, 0.3, -0.2, 0.0, 1.0, -2.0, 0.0]);
    let of = |state: &[f64]| {
        let (theta, omega) = halves(state);
        energy(&model, &theta, &omega)
    };
    let first = of(&start.values);
    let times: Vec<f64> = (1..=200).map(|i| 0.05 * f64::from(i)).collect();
    let (mut error, mut size) = (0.0_f64, 0.0_f64);
    Dop853::new(Options::with_tolerance(1e-13))
        .sample(&system, &start, &times, |_, state| {
            let own = of(state);
            error = error.max((own - first - state[6]).abs());
            size = size.max(own.abs());
        })
        .expect("it runs");
    (error, size)
}

#[test]
fn energy_is_balanced_by_the_powers_of_drive_and_friction() {
    let energy = |model: &Driven, theta: &[f64; 3], omega: &[f64; 3]| {
        model.kinetic_energy(theta, omega) + model.potential_energy(theta)
    };
    let (error, size) = balance(energy, |model, time, theta, omega| {
        model.drive_power(time, theta, omega) + model.friction_power(omega)
    });
    println!("balance of the energy: {error:.2e} J of {size:.2e} J");
    assert!(error <= 1e-10 * size, "{error} {size}");
    // Neither power may be left out.
    let (error, size) = balance(energy, |model, time, theta, omega| {
        model.drive_power(time, theta, omega)
    });
    assert!(error > 1e-3 * size, "{error} {size}");
    let (error, size) = balance(energy, |model, _, _, omega| model.friction_power(omega));
    assert!(error > 1e-3 * size, "{error} {size}");
}

#[test]
fn antiphase_energy_is_balanced_by_transfer_friction_and_drive() {
    let symmetric = |model: &Driven, theta: &[f64; 3], omega: &[f64; 3]| {
        (model.to_symmetric(theta), model.to_symmetric(omega))
    };
    let energy = |model: &Driven, theta: &[f64; 3], omega: &[f64; 3]| {
        let (q, v) = symmetric(model, theta, omega);
        model.antiphase_energy(&q, &model.symmetric_momenta(&q, &v))
    };
    let conservative = |model: &Driven, theta: &[f64; 3], omega: &[f64; 3]| {
        let (q, v) = symmetric(model, theta, omega);
        model.transfer_exact_from_rates(&q, &v).total()
            + model.antiphase_friction_power_from_rates(&q, &v)
    };
    let (error, size) = balance(energy, |model, time, theta, omega| {
        let (q, v) = symmetric(model, theta, omega);
        conservative(model, theta, omega) + model.antiphase_drive_power_from_rates(time, &q, &v)
    });
    println!("balance of the antiphase: {error:.2e} J of {size:.2e} J");
    assert!(error <= 1e-10 * size, "{error} {size}");
    let (error, size) = balance(energy, |model, _, theta, omega| {
        conservative(model, theta, omega)
    });
    assert!(error > 1e-2 * size, "{error} {size}");
}
