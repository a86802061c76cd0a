//! Emitted code depends on no name of its surroundings.

use branched_pendulum::Pendulum as _;

/// No prelude, and every name that code might lean on means something else.
#[no_implicit_prelude]
mod hostile {
    #![allow(dead_code, non_camel_case_types)]

    pub(super) struct Option;
    pub(super) struct Result;
    pub(super) struct Default;
    pub(super) struct Clone;
    pub(super) struct Copy;
    pub(super) struct Scalar;
    pub(super) struct Pendulum;
    pub(super) struct Transfer;
    pub(super) struct TryFrom;
    pub(super) mod core {}
    pub(super) mod std {}
    pub(super) mod branched_pendulum {}

    #[::branched_pendulum::branched_pendulum(
        gravity = 9.80665,
        core(mass = 1, com = 0.1, joint = 0.2, inertia = 0.01) [
            std(mass = 0.5, com = 0.1, inertia = 1e-3) * 2
        ],
        emit(energies, momenta, modes, symmetric, transfer(angle = 1, amplitude = 2, exact)),
    )]
    pub(super) struct Hostile;

    #[::branched_pendulum::branched_pendulum(
        gravity = g,
        a(mass = parameters, com = theta, joint = omega, inertia = value) [
            b(mass = 0.5, com = 0.1, inertia = 1e-3, friction = alpha) * 3
        ],
        emit(energies, transfer(exact)),
    )]
    pub(super) struct Shadowed;
}

#[test]
fn hostile_surroundings() {
    let model = hostile::Hostile::new();
    let mut alpha = [0.0; 3];
    model.accelerations_into(0.0, &[0.1, 0.2, 0.3], &[0.0; 3], &mut alpha);
    assert_eq!(alpha, model.accelerations(&[0.1, 0.2, 0.3], &[0.0; 3]));
    assert!(alpha.iter().all(|a| a.is_finite() && *a != 0.0));
}

#[test]
fn parameters_named_like_locals() {
    let model = hostile::Shadowed::new(hostile::ShadowedParameters {
        g: 9.8,
        parameters: 0.4,
        theta: 0.1,
        omega: 0.3,
        value: 1e-3,
        alpha: 1e-4,
    })
    .expect("possible parameters");
    assert!(model.kinetic_energy(&[0.1; 4], &[1.0; 4]) > 0.0);
}

#[test]
fn wrong_lengths_have_no_answer() {
    let model = hostile::Hostile::new();
    let mut alpha = [0.0; 3];
    model.accelerations_into(0.0, &[0.1, 0.2], &[0.0; 3], &mut alpha);
    assert!(alpha.iter().all(|a| a.is_nan()));
    let mut long = [0.0; 4];
    model.accelerations_into(0.0, &[0.1; 3], &[0.0; 3], &mut long);
    assert!(long.iter().all(|a| a.is_nan()));
}

mod derives {
    use branched_pendulum::prelude::*;

    /// Derives of the user's own are kept, missing ones added.
    #[branched_pendulum(gravity = 9.8, rod: rod(mass = 1, length = 1))]
    #[derive(Debug, Clone, PartialOrd)]
    #[must_use]
    pub(super) struct Derived;
}

#[test]
fn attributes_survive() {
    let model = derives::Derived::new();
    let copy = model;
    assert!(copy == model);
    assert!(model.partial_cmp(&copy).is_some());
    assert!(format!("{model:?}").starts_with("Derived {"));
}
