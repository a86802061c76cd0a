//! H_d against what feeds it, all of coordinates and momenta.

use branched_pendulum::prelude::*;
use branched_pendulum::system::OdeFn;

use super::Unequal;

/// Children that nearly agree, with viscous joints.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(
            mass = each(0.10531, 0.1063631), com = 0.043, inertia = 0.516e-3, friction = 1e-5,
        ) * 2
    ],
    emit(energies, momenta, symmetric, transfer(exact)),
)]
struct Nearly;

/// Integrates the motion and, beside it, what feeds H_d; returns the changes of H_d and of that.
fn changes(
    accelerations: impl Fn(f64, &[f64; 3], &[f64; 3]) -> [f64; 3],
    [theta, omega]: [[f64; 3]; 2],
    feed: impl Fn(f64, &[f64; 3], &[f64; 3]) -> f64,
    energy: impl Fn(&[f64; 3], &[f64; 3]) -> f64,
) -> [f64; 2] {
    let halves = |values: &[f64]| -> [[f64; 3]; 2] {
        [0, 3].map(|from| values[from..from + 3].try_into().expect("three links"))
    };
    let system = OdeFn::new(7, |time: f64, state: &[f64], rates: &mut [f64]| {
        let [theta, omega] = halves(state);
        rates[..3].copy_from_slice(&omega);
        rates[3..6].copy_from_slice(&accelerations(time, &theta, &omega));
        rates[6] = feed(time, &theta, &omega);
    });
    let start = State::new(0.0, [&theta[..], &omega[..], &[0.0]].concat());
    let end = Dop853::new(Options::with_tolerance(1e-13))
        .run(&system, &start, 5.0)
        .expect("it goes on")
        .state;
    let of = |values: &[f64]| {
        let [theta, omega] = halves(values);
        energy(&theta, &omega)
    };
    [of(&end.values) - of(&start.values), end.values[6]]
}

/// ΔH_d = ∫ (growth + forcing + friction) dt, all of coordinates and momenta.
#[test]
fn momenta_balance_the_energy_of_free_copies() {
    let model = Nearly::new();
    let canonical = |theta: &[f64; 3], omega: &[f64; 3]| {
        let (q, v) = (model.to_symmetric(theta), model.to_symmetric(omega));
        (q, model.symmetric_momenta(&q, &v))
    };
    let conservative = |theta: &[f64; 3], omega: &[f64; 3]| {
        let (q, p) = canonical(theta, omega);
        model.transfer_growth(&q, &p).total() + model.transfer_forcing(&q, &p).total()
    };
    let energy = |theta: &[f64; 3], omega: &[f64; 3]| {
        let (q, p) = canonical(theta, omega);
        model.antiphase_energy(&q, &p)
    };
    let start =
        [[0.8, 0.0, 0.01], [1.0, -2.0, 0.5]].map(|symmetric| model.from_symmetric(&symmetric));
    let accelerations =
        |_: f64, theta: &[f64; 3], omega: &[f64; 3]| model.accelerations(theta, omega);
    let friction = |theta: &[f64; 3], omega: &[f64; 3]| {
        let (q, p) = canonical(theta, omega);
        model.antiphase_friction_power(&q, &p)
    };
    let whole = |_: f64, theta: &[f64; 3], omega: &[f64; 3]| {
        conservative(theta, omega) + friction(theta, omega)
    };
    let [change, fed] = changes(accelerations, start, whole, energy);
    assert!(
        (change - fed).abs() < 1e-11 * change.abs(),
        "{change} {fed}"
    );
    // Friction is a part of it that a balance cannot miss.
    let without = |_: f64, theta: &[f64; 3], omega: &[f64; 3]| conservative(theta, omega);
    let [change, fed] = changes(accelerations, start, without, energy);
    assert!((change - fed).abs() > 1e-3 * change.abs(), "{change} {fed}");
}

/// The same with a drive and torques from outside.
#[test]
fn momenta_balance_the_energy_of_driven_copies() {
    let model = Unequal::new();
    let torques = |time: f64, omega: &[f64; 3]| {
        [
            0.01 * (3.0 * time).sin(),
            5e-3 * (4.0 * time).cos(),
            -1e-3 * omega[2],
        ]
    };
    let canonical = |theta: &[f64; 3], omega: &[f64; 3]| {
        let (q, v) = (model.to_symmetric(theta), model.to_symmetric(omega));
        (q, model.symmetric_momenta(&q, &v))
    };
    let feed = |parts: [bool; 3]| {
        move |time: f64, theta: &[f64; 3], omega: &[f64; 3]| {
            let (q, p) = canonical(theta, omega);
            let others = [
                model.antiphase_friction_power(&q, &p),
                model.antiphase_drive_power(time, &q, &p),
                model.antiphase_outside_power(&q, &p, &torques(time, omega)),
            ];
            let others = others.into_iter().zip(parts);
            let others: f64 = others
                .filter(|(_, counts)| *counts)
                .map(|(power, _)| power)
                .sum();
            model.transfer_growth(&q, &p).total() + model.transfer_forcing(&q, &p).total() + others
        }
    };
    let accelerations = |time: f64, theta: &[f64; 3], omega: &[f64; 3]| {
        model.accelerations_under(time, theta, omega, &torques(time, omega))
    };
    let energy = |theta: &[f64; 3], omega: &[f64; 3]| {
        let (q, p) = canonical(theta, omega);
        model.antiphase_energy(&q, &p)
    };
    let start = [[0.6, 0.3, -0.2], [0.5, -1.0, 2.0]];
    let [change, fed] = changes(accelerations, start, feed([true; 3]), energy);
    assert!(
        (change - fed).abs() < 1e-10 * change.abs(),
        "{change} {fed}"
    );
    for missing in 0..3 {
        let mut parts = [true; 3];
        parts[missing] = false;
        let [change, fed] = changes(accelerations, start, feed(parts), energy);
        assert!(
            (change - fed).abs() > 1e-3 * change.abs(),
            "{missing}: {change} {fed}"
        );
    }
}
