//! Copies that differ: against bodies in numbers, against the tree of equal copies, and W
//! by growth and forcing against the motion.

mod nested;

use std::ops::ControlFlow;

use branched_pendulum::prelude::*;
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::scenes::paper::Paper;

use crate::support::{Worst, compile};
use crate::transfer::rate;

/// The paper's apparatus with children of two masses.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = each(left, right), com = 0.043, inertia = 0.516e-3) * 2
    ],
    emit(energies, momenta, transfer(exact)),
)]
struct TwoMasses;

/// Children that differ in everything.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27, friction = 1e-4) [
        child(
            mass = each(0.10531, 0.112), com = each(0.043, 0.045), inertia = each(0.516e-3, 0.5e-3),
            at = each(0.27, (0.265, 0.004)), friction = each(2e-5, 0), drag = each(0, 3e-5),
            spring = each(0.01, 0.012), rest = each(0.1, 0),
        ) * 2
    ],
    drive(x = 0.01 * sin(5 * t)),
    emit(energies, momenta, transfer(exact)),
)]
struct AllDiffer;

/// Three copies that differ, beside two that do not.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.2, com = 0.1, inertia = 2e-3, joint = 0.25) [
        child(mass = each(0.1, 0.11, 0.095), com = 0.05, inertia = 5e-4) * 3,
        twin(mass = 0.05, com = 0.06, inertia = 1e-4, at = 0.1) * 2,
    ],
    emit(energies, momenta, transfer),
)]
struct Several;

/// With equal values the model is that of `* 2`, and nothing forces.
#[test]
fn equal_values_give_equal_copies() {
    let parameters = TwoMassesParameters {
        left: 0.10531,
        right: 0.10531,
    };
    let model = TwoMasses::new(parameters).expect("positive masses");
    let paper = Paper::new();
    let mut random = Random::new(5);
    let mut worst = Worst::default();
    for count in 0..200 {
        let draw = |random: &mut Random, size| {
            let drawn = random.around_zero(3, size);
            [drawn[0], drawn[1], drawn[2]]
        };
        let (q, v) = (draw(&mut random, 1.5), draw(&mut random, 4.0));
        let p = model.symmetric_momenta(&q, &v);
        let place = || format!("state {count}");
        for (own, equal) in model
            .symmetric_accelerations(&q, &v)
            .iter()
            .zip(paper.symmetric_accelerations(&q, &v))
        {
            worst.note(own - equal, 1e3, place);
        }
        worst.note(
            model.antiphase_energy(&q, &p) - paper.antiphase_energy(&q, &p),
            1.0,
            place,
        );
        let expected = paper.transfer_exact(&q, &p);
        let scale = 1.0 + expected.kinetic.abs() + expected.potential.abs();
        for found in [
            model.transfer_exact(&q, &p),
            model.transfer_growth(&q, &p),
            model.transfer_growth_from_rates(&q, &v),
        ] {
            worst.note(found.kinetic - expected.kinetic, scale, place);
            worst.note(found.potential - expected.potential, scale, place);
        }
        for forcing in [
            model.transfer_forcing(&q, &p),
            model.transfer_forcing_from_rates(&q, &v),
        ] {
            assert_eq!((forcing.kinetic, forcing.potential), (0.0, 0.0));
        }
    }
    worst.assert_below(1e-13, "equal values");
    // Numbers that are equal make copies that are equal.
    let [each, plain] = ["each(0.1, 0.1)", "0.1"].map(|mass| {
        compile(&format!(
            "gravity = 9.8, a: rod(mass = 1, length = 1) [b: rod(mass = {mass}, length = 1) * 2],
            emit(energies, transfer)"
        ))
    });
    assert_eq!(each.scene, plain.scene);
    assert_eq!(each.program, plain.program);
}

/// Compares W with the rate of H_d along the motion, and with growth and forcing.
macro_rules! assert_split {
    ($model:expr, $links:literal, $energy:ident, $exact:ident, $rates:ident, $growth:ident,
     $forcing:ident, $growth_rates:ident, $forcing_rates:ident, $power:expr) => {{
        let model = $model;
        let power = $power;
        let mut random = Random::new(6);
        let (mut along, mut parts) = (Worst::default(), Worst::default());
        let mut largest = 0.0_f64;
        for count in 0..100 {
            let theta: [f64; $links] = random.around_zero($links, 1.5).try_into().expect("links");
            let omega: [f64; $links] = random.around_zero($links, 4.0).try_into().expect("links");
            let (q, v) = (model.to_symmetric(&theta), model.to_symmetric(&omega));
            let p = model.symmetric_momenta(&q, &v);
            let exact = model.$exact(&q, &p);
            let measured = rate(&model, &theta, &omega, |theta, omega| {
                let q = model.to_symmetric(theta.try_into().expect("links"));
                let v = model.to_symmetric(omega.try_into().expect("links"));
                model.$energy(&q, &model.symmetric_momenta(&q, &v))
            });
            let scale = 10.0 * (model.kinetic_energy(&theta, &omega) + model.$energy(&q, &p));
            let place = || format!("state {count}");
            along.note(
                exact.total() + power(&model, &q, &v) - measured,
                scale,
                place,
            );
            for (growth, forcing) in [
                (model.$growth(&q, &p), model.$forcing(&q, &p)),
                (model.$growth_rates(&q, &v), model.$forcing_rates(&q, &v)),
            ] {
                largest = largest.max(forcing.total().abs() / scale);
                parts.note(
                    growth.kinetic + forcing.kinetic - exact.kinetic,
                    scale,
                    place,
                );
                parts.note(
                    growth.potential + forcing.potential - exact.potential,
                    scale,
                    place,
                );
            }
            let rates = model.$rates(&q, &v);
            parts.note(rates.total() - exact.total(), scale, place);
        }
        assert!(largest > 1e-4, "{largest}");
        along.assert_below(1e-12, "rate of H_d");
        parts.assert_below(1e-13, "growth and forcing");
    }};
}

#[test]
fn transfer_is_the_rate_of_the_energy() {
    let parameters = TwoMassesParameters {
        left: 0.10531,
        right: 0.1064,
    };
    assert_split!(
        TwoMasses::new(parameters).expect("positive masses"),
        3,
        antiphase_energy,
        transfer_exact,
        transfer_exact_from_rates,
        transfer_growth,
        transfer_forcing,
        transfer_growth_from_rates,
        transfer_forcing_from_rates,
        |_: &TwoMasses, _: &[f64; 3], _: &[f64; 3]| 0.0
    );
    assert_split!(
        AllDiffer::new(),
        3,
        antiphase_energy,
        transfer_exact,
        transfer_exact_from_rates,
        transfer_growth,
        transfer_forcing,
        transfer_growth_from_rates,
        transfer_forcing_from_rates,
        |model: &AllDiffer, q: &[f64; 3], v: &[f64; 3]| {
            model.antiphase_friction_power_from_rates(q, v)
                + model.antiphase_drive_power_from_rates(0.0, q, v)
        }
    );
}

#[test]
fn each_difference_has_growth_and_forcing() {
    assert_split!(
        Several::new(),
        6,
        antiphase_energy_child_d1,
        transfer_exact_child_d1,
        transfer_exact_from_rates_child_d1,
        transfer_growth_child_d1,
        transfer_forcing_child_d1,
        transfer_growth_from_rates_child_d1,
        transfer_forcing_from_rates_child_d1,
        |_: &Several, _: &[f64; 6], _: &[f64; 6]| 0.0
    );
    assert_split!(
        Several::new(),
        6,
        antiphase_energy_child_d2,
        transfer_exact_child_d2,
        transfer_exact_from_rates_child_d2,
        transfer_growth_child_d2,
        transfer_forcing_child_d2,
        transfer_growth_from_rates_child_d2,
        transfer_forcing_from_rates_child_d2,
        |_: &Several, _: &[f64; 6], _: &[f64; 6]| 0.0
    );
}

/// Of small differences growth is quadratic and forcing linear, and forcing is linear in the
/// mismatch.
#[test]
fn growth_is_quadratic_and_forcing_linear() {
    let at = |mismatch: f64, size: f64| {
        let parameters = TwoMassesParameters {
            left: 0.10531 * (1.0 + mismatch),
            right: 0.10531 * (1.0 - mismatch),
        };
        let model = TwoMasses::new(parameters).expect("positive masses");
        let (q, v) = ([0.5, 0.3, 0.7 * size], [1.0, -2.0, 2.0 * size]);
        // Momenta of the differences are small with them.
        let mut p = Paper::new().symmetric_momenta(&q, &v);
        p[2] = 1e-3 * size;
        let (growth, forcing) = (
            model.transfer_growth(&q, &p),
            model.transfer_forcing(&q, &p),
        );
        [growth.total(), forcing.total()]
    };
    let [growth, forcing] = at(1e-3, 1e-3);
    let [smaller, weaker] = at(1e-3, 1e-4);
    assert!(
        (growth / smaller / 100.0 - 1.0).abs() < 1e-3,
        "{growth} {smaller}"
    );
    assert!(
        (forcing / weaker / 10.0 - 1.0).abs() < 1e-2,
        "{forcing} {weaker}"
    );
    let [same, halved] = at(5e-4, 1e-3);
    assert!((growth / same - 1.0).abs() < 1e-9);
    assert!(
        (forcing / halved / 2.0 - 1.0).abs() < 1e-2,
        "{forcing} {halved}"
    );
}

/// From a start in phase the difference grows in proportion to the mismatch.
#[test]
fn the_difference_grows_linearly_in_the_mismatch() {
    let largest = |mismatch: f64| {
        let parameters = TwoMassesParameters {
            left: 0.10531 * (1.0 + mismatch),
            right: 0.10531,
        };
        let model = TwoMasses::new(parameters).expect("positive masses");
        let start = State::at_rest(0.0, &[0.3, 0.3, 0.3]);
        let mut largest = 0.0_f64;
        let method = Dop853::new(Options::with_tolerance(1e-12));
        let run = method.integrate(&AbsoluteAngles(&model), &start, 5.0, |step| {
            let [.., left, right] = step.end()[..3] else {
                return ControlFlow::Break(());
            };
            largest = largest.max(((left - right) / 2.0).abs());
            ControlFlow::Continue(())
        });
        assert!(run.is_ok());
        largest
    };
    for mismatch in [0.0025, 0.005, 0.01, 0.02] {
        let slope = largest(mismatch) / mismatch;
        println!(
            "mismatch {mismatch}: largest difference {} rad",
            largest(mismatch)
        );
        assert!(
            (slope / (largest(0.001) / 0.001) - 1.0).abs() < 0.05,
            "{slope}"
        );
    }
    assert_eq!(largest(0.0), 0.0);
}

/// Means and mismatches of constants have names that observables know.
#[test]
fn constants_of_copies_have_means_and_mismatches() {
    let compiled = compile(
        "gravity = 9.80665,
        parent(mass = 0.1288, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
            child(mass = each(0.1, 0.12), com = 0.05, inertia = each(5e-4, 6e-4)) * 2
        ],
        emit(momenta, transfer(exact)),
        observe(
            own = p_d^2 / (4 * inertia_child) + gravity_child * sin(theta_d)^2,
            apart = inertia_child_1 - inertia_child_2 - 2 * mismatch_inertia_d
                + coupling_child_1_parent - coupling_child_parent - mismatch_coupling_d_parent,
        )",
    );
    let (q, v) = ([0.4, 0.3, 0.2], [1.0, -2.0, 0.5]);
    let p = compiled.evaluate("symmetric_momenta", &[&q, &v]);
    let own = compiled.evaluate("own_from_momenta", &[&q, &p])[0];
    let energy = compiled.evaluate("antiphase_energy", &[&q, &p])[0];
    assert!((own / energy - 1.0).abs() < 1e-14, "{own} {energy}");
    let rate = compiled.evaluate("own_rate_from_momenta", &[&q, &p])[0];
    let transfer: f64 = compiled.evaluate("transfer_exact", &[&q, &p]).iter().sum();
    assert!((rate / transfer - 1.0).abs() < 1e-11, "{rate} {transfer}");
    assert!(compiled.evaluate("apart", &[&[0.0; 3], &[0.0; 3]])[0].abs() < 1e-18);
}
