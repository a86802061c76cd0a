//! Names instead of literals: the same pendulum, and refusal of what cannot be
//! one.

use branched_pendulum::ParameterError;
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::scenes::paper::Paper;

use crate::fixtures::{NAMED, Named, NamedParameters};
use crate::support::{Worst, compile_item};

const PAPER: NamedParameters = NamedParameters {
    g: 9.80665,
    m_1: 0.12880,
    d_1: 0.084,
    i_1: 1.88e-3,
    l: 0.27,
    m_2: 0.10531,
    d_2: 0.043,
    i_2: 0.516e-3,
    c: 0.0,
};

/// Constants of the model with names are rounded at every operation, those of
/// the model with literals once.
#[test]
fn named_parameters_give_the_literal_model() {
    let named = Named::new(PAPER).expect("the paper's numbers");
    let literal = Paper::new();
    let mut constants = Worst::default();
    for (name, found, expected) in [
        ("M_1", named.inertia_parent(), literal.inertia_parent()),
        ("M_2", named.inertia_child(), literal.inertia_child()),
        (
            "μ",
            named.coupling_child_parent(),
            literal.coupling_child_parent(),
        ),
        ("G_1", named.gravity_parent(), literal.gravity_parent()),
        ("G_2", named.gravity_child(), literal.gravity_child()),
    ] {
        constants.note(found - expected, expected, || name.into());
    }
    constants.assert_below(4.0 * f64::EPSILON, "constants");
    let mut worst = Worst::default();
    let mut random = Random::new(1);
    for count in 0..1000 {
        let theta = [(); 3].map(|()| random.between(-3.0, 3.0));
        let omega = [(); 3].map(|()| random.between(-8.0, 8.0));
        let found = named.accelerations(&theta, &omega);
        let expected = literal.accelerations(&theta, &omega);
        let scale = expected.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
        for i in 0..3 {
            worst.note(found[i] - expected[i], scale, || format!("state {count}"));
        }
        let (q, v) = (literal.to_symmetric(&theta), literal.to_symmetric(&omega));
        let p = literal.symmetric_momenta(&q, &v);
        let found = named.transfer_exact(&q, &p).total();
        let expected = literal.transfer_exact(&q, &p).total();
        worst.note(found - expected, scale, || format!("W, state {count}"));
    }
    worst.assert_below(1e-12, "accelerations and transfer");
}

/// The program interprets parameters as the compiled code does.
#[test]
fn the_program_takes_the_same_parameters() {
    let compiled = compile_item(NAMED);
    let values: Vec<f64> = compiled
        .scene
        .parameters
        .iter()
        .map(|parameter| match parameter.name.as_str() {
            "g" => PAPER.g,
            "m_1" => PAPER.m_1,
            "d_1" => PAPER.d_1,
            "i_1" => PAPER.i_1,
            "l" => PAPER.l,
            "m_2" => PAPER.m_2,
            "d_2" => PAPER.d_2,
            "i_2" => PAPER.i_2,
            "c" => 7e-5,
            other => panic!("an unknown parameter `{other}`"),
        })
        .collect();
    let model = Named::new(NamedParameters { c: 7e-5, ..PAPER }).expect("the paper's numbers");
    let (theta, omega) = ([0.7, -1.1, 2.0], [3.0, -2.0, 1.0]);
    let found = compiled.evaluate_with(&values, "accelerations", &[&theta, &omega]);
    assert_eq!(found, model.accelerations(&theta, &omega));
}

/// The error about the paper's parameters after a change.
fn refuse(change: fn(&mut NamedParameters)) -> ParameterError {
    let mut parameters = PAPER;
    change(&mut parameters);
    match Named::new(parameters) {
        Err(error) => error,
        Ok(_) => panic!("accepted {parameters:?}"),
    }
}

#[test]
fn impossible_parameters_are_refused() {
    let negative_mass = refuse(|p| p.m_1 = -0.1);
    assert_eq!(negative_mass.what, "mass of `parent`");
    assert_eq!(negative_mass.value, -0.1);
    assert_eq!(
        negative_mass.to_string(),
        "mass of `parent` is -0.1, must be finite and not negative"
    );
    assert_eq!(refuse(|p| p.i_2 = -1.0).what, "inertia of `child`");
    assert_eq!(refuse(|p| p.c = -1e-9).what, "friction of `child`");
    assert!(refuse(|p| p.g = f64::NAN).value.is_nan());
    for infinite in [
        refuse(|p| p.l = f64::INFINITY),
        refuse(|p| p.m_1 = f64::INFINITY),
        refuse(|p| p.c = f64::INFINITY),
        refuse(|p| p.g = f64::INFINITY),
    ] {
        assert_eq!(infinite.value, f64::INFINITY);
        assert!(
            infinite.to_string().contains(" is inf, must be finite"),
            "{infinite}"
        );
    }
}

/// A child without mass and inertia, or a parent that nothing gives inertia,
/// makes the mass matrix singular.
#[test]
fn parameters_without_inertia_are_refused() {
    refuse(|p| (p.m_2, p.i_2) = (0.0, 0.0));
    refuse(|p| (p.d_2, p.i_2) = (0.0, 0.0));
    refuse(|p| (p.d_1, p.i_1, p.l) = (0.0, 0.0, 0.0));
}
