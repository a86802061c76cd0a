//! Emitted code depends on no name of its surroundings.

use branched_pendulum::Pendulum as _;

/// Code that the tool wrote stands under the lints of the user's own.
#[deny(unreachable_pub, clippy::pedantic)]
#[rustfmt::skip]
#[path = "../../fixtures/expanded/paper.rs"]
mod committed;

#[test]
fn committed_code_has_no_warnings() {
    let model = committed::Paper::new();
    let alpha = model.accelerations(&[0.3, 0.1, 0.1], &[0.0; 3]);
    assert_eq!(alpha[1], alpha[2]);
}

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
    pub(super) struct Budget;
    pub(super) struct Sector;
    pub(super) struct SectorCoordinate;
    pub(super) struct Sectors;
    pub(super) struct TryFrom;
    pub(super) mod core {}
    pub(super) mod std {}
    pub(super) mod branched_pendulum {}

    #[::branched_pendulum::branched_pendulum(
        gravity = 9.80665,
        core(mass = 1, com = 0.1, joint = 0.2, inertia = 0.01) [
            std(mass = 0.5, com = 0.1, inertia = 1e-3) * 2
        ],
        emit(energies, momenta, modes, symmetric, taylor,
            transfer(angle = 1, amplitude = 2, exact)),
    )]
    pub(super) struct Hostile;

    #[::branched_pendulum::branched_pendulum(
        gravity = g,
        a(mass = parameters, com = thetas, joint = omegas, inertia = value) [
            b(mass = 0.5, com = 0.1, inertia = coupling_b_a, friction = alpha) * 3
        ],
        emit(energies, taylor, transfer(exact), budget(canonical, parseval, matrix, amplitude = 2)),
    )]
    pub(super) struct Shadowed;

    #[::branched_pendulum::branched_pendulum(
        gravity = square,
        a(mass = 1, com = 0.1, joint = 0.2, inertia = 0.01) [
            b(mass = 0.5, com = 0.1, inertia = 1e-3, friction = 1e-4) * 2
        ],
        emit(momenta),
        observe(
            sin = sin(theta_a + 2 * theta_b_1) * square,
            rates = omega_d * cos(theta_d),
            coordinates = sqrt(1 + square * p_b_2^2),
            f = 0,
        ),
    )]
    pub(super) struct Observing;
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
        thetas: 0.1,
        omegas: 0.3,
        value: 1e-3,
        alpha: 1e-4,
        coupling_b_a: 1e-3,
    })
    .expect("possible parameters");
    let (theta, omega) = ([0.1, 0.3, -0.2, 0.5], [1.0, 2.0, -0.5, 0.7]);
    let kinetic = model.kinetic_energy(&theta, &omega);
    assert!(kinetic > 0.0);
    let energies: f64 = model.budget_parseval(&theta, &omega).energies.iter().sum();
    let energy = kinetic + model.potential_energy(&theta);
    assert!((energies / energy - 1.0).abs() < 1e-14);
}

#[test]
fn observables_named_like_functions_and_arguments() {
    let model = hostile::Observing::new(hostile::ObservingParameters { square: 4.0 })
        .expect("possible parameters");
    let (theta, omega) = ([0.1, 0.2, 0.3], [0.4, 0.5, 0.6]);
    assert_eq!(model.sin(&theta, &omega), f64::sin(0.1 + 2.0 * 0.2) * 4.0);
    assert_eq!(model.rates(&[0.1, 0.2, 0.0], &omega), 0.6);
    let p = model.momenta(&theta, &omega)[2];
    let expected = f64::sqrt(1.0 + 4.0 * p * p);
    assert!((model.coordinates(&theta, &omega) - expected).abs() < 1e-15);
    assert_eq!(model.f_rate(&theta, &omega), 0.0);
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

mod namesakes {
    //! Parameters and links spelled like symbols of ours.
    use branched_pendulum::prelude::*;

    #[branched_pendulum(
        gravity = c_d,
        m(mass = 1, com = 0.1, inertia = inertia_d, joint = 0.3, friction = k_d) [
            d(mass = p_d_1, com = 0.1, inertia = 1e-3, friction = c_d, drag = w_m, spring = k_d) * 2
        ],
        emit(energies, momenta, modes, symmetric, transfer(angle = 1, amplitude = 4, exact)),
    )]
    pub(super) struct Named;

    #[branched_pendulum(
        gravity = 0.5,
        root(mass = 1, com = 0.1, inertia = 0.02, joint = 0.3, friction = 0.03) [
            leaf(mass = 0.4, com = 0.1, inertia = 1e-3, friction = 0.5, drag = 0.06, spring = 0.03) * 2
        ],
        emit(energies, momenta, modes, symmetric, transfer(angle = 1, amplitude = 4, exact)),
    )]
    pub(super) struct Literal;
}

#[test]
fn names_like_ours_mean_what_the_user_means() {
    let named = namesakes::Named::new(namesakes::NamedParameters {
        c_d: 0.5,
        inertia_d: 0.02,
        k_d: 0.03,
        p_d_1: 0.4,
        w_m: 0.06,
    })
    .expect("possible parameters");
    let literal = namesakes::Literal::new();
    let (q, v) = ([0.3, -0.7, 0.2], [1.0, -2.0, 0.5]);
    let close = |a: f64, b: f64| assert!((a - b).abs() <= 1e-14 * (1.0 + b.abs()), "{a} {b}");
    for (a, b) in named
        .accelerations(&q, &v)
        .iter()
        .zip(literal.accelerations(&q, &v))
    {
        close(*a, b);
    }
    let p = literal.symmetric_momenta(&q, &v);
    close(named.hamiltonian(&q, &p), literal.hamiltonian(&q, &p));
    let (a, b) = (
        named.transfer_amplitude_4(&q, &p),
        literal.transfer_amplitude_4(&q, &p),
    );
    close(a.total(), b.total());
    close(named.inertia_d(), literal.inertia_leaf());
}

mod driven {
    //! Functions of time with parameters and links spelled like locals of ours.
    #[::branched_pendulum::branched_pendulum(
        gravity = 9.8,
        cos_drive(mass = 1, com = 0.1, joint = 0.2, inertia = 0.01) [
            leaf(mass = 0.5, com = 0.1, inertia = 1e-3) * 3
        ],
        drive(
            torque = drive_torque * sin(cos(a_x) + 2 * sin_drive),
            x = pivot_acceleration_x * t^2 / 2,
            y = 0.1 * t - 3,
        ),
        emit(energies, symmetric, taylor),
    )]
    pub(super) struct Driven;

    #[::branched_pendulum::branched_pendulum(
        gravity = 9.8,
        rod: rod(mass = 1, length = 1),
        drive(x = 0.5 * t, y = 0),
        emit(energies),
    )]
    pub(super) struct Steady;
}

#[test]
fn functions_of_time_named_like_locals() {
    let model = driven::Driven::new(driven::DrivenParameters {
        drive_torque: 0.3,
        a_x: 0.2,
        sin_drive: 0.4,
        pivot_acceleration_x: 2.0,
    })
    .expect("possible parameters");
    let (theta, omega) = ([0.3, -0.2, 0.1, 0.7], [0.0; 4]);
    let torque = 0.3 * (0.2_f64.cos() + 0.8).sin();
    // h = m d + l (three leaves), and that of a leaf.
    let levers = [0.1 + 0.2 * 1.5, 0.05, 0.05, 0.05];
    let power = |omega: &[f64; 4]| model.drive_power(1.5, &theta, omega);
    for link in 0..4 {
        let mut unit = [0.0; 4];
        unit[link] = 1.0;
        let mut expected = -2.0 * levers[link] * theta[link].cos();
        if link == 0 {
            expected += torque;
        }
        assert!((power(&unit) - expected).abs() < 1e-14, "{link}");
    }
    let mut alpha = [0.0; 4];
    model.accelerations_into(1.5, &theta, &omega, &mut alpha);
    // Fused or not, the same numbers but for rounding.
    for (fused, plain) in alpha.iter().zip(model.accelerations(1.5, &theta, &omega)) {
        assert!(
            (fused - plain).abs() < 1e-13 * plain.abs(),
            "{fused} {plain}"
        );
    }
}

/// A pivot at constant velocity drives nothing, and the time is not read.
#[test]
fn a_steady_pivot_is_no_drive() {
    let model = driven::Steady::new();
    assert_eq!(model.drive_power(2.0, &[0.3], &[0.7]), 0.0);
    assert_eq!(
        model.accelerations(2.0, &[0.3], &[0.7]),
        model.accelerations(f64::NAN, &[0.3], &[0.7])
    );
}
