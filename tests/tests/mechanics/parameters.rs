//! Names instead of literals: the same pendulum, and refusal of what cannot be
//! one.

use branched_pendulum::prelude::*;
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

/// Finite values that no pendulum has are refused, with the parameter and the range.
#[test]
fn parameters_out_of_range_are_refused() {
    let (mass, length) = (
        "0 or of a magnitude from 1e-60 to 1e40 kg",
        "of a magnitude up to 1e30 m",
    );
    let inertia = "0 or of a magnitude from 1e-120 to 1e100 kg m²";
    for (error, what, value, range) in [
        (
            refuse(|p| p.m_1 = 1e300),
            "mass of `parent` (parameter `m_1`)",
            1e300,
            mass,
        ),
        (
            refuse(|p| p.m_2 = 1e-200),
            "mass of `child` (parameter `m_2`)",
            1e-200,
            mass,
        ),
        (
            refuse(|p| p.d_2 = -2e200),
            "centre of mass of `child` (parameter `d_2`)",
            -2e200,
            length,
        ),
        (
            refuse(|p| p.l = f64::MAX),
            "joint of `parent` (parameter `l`)",
            f64::MAX,
            length,
        ),
        (
            refuse(|p| p.i_1 = 1e101),
            "inertia of `parent` (parameter `i_1`)",
            1e101,
            inertia,
        ),
        (
            refuse(|p| p.i_2 = 1e-300),
            "inertia of `child` (parameter `i_2`)",
            1e-300,
            inertia,
        ),
        (
            refuse(|p| p.g = 3e77),
            "gravity (parameter `g`)",
            3e77,
            "of a magnitude up to 1e30 m/s²",
        ),
        (
            refuse(|p| p.c = 1e250),
            "friction of `child` (parameter `c`)",
            1e250,
            "of a magnitude up to 1e100 N m s",
        ),
    ] {
        assert_eq!(
            (error.what, error.value, error.requirement),
            (what, value, range)
        );
    }
    let error = refuse(|p| p.m_1 = 1e300).to_string();
    let expected = "mass of `parent` (parameter `m_1`) is 1e300, must be 0 or of a magnitude from 1e-60 to 1e40 kg";
    assert_eq!(error, expected);
}

/// A distance that is too small for a regular mass matrix counts as zero.
#[test]
fn negligible_distances_are_refused() {
    for error in [
        refuse(|p| (p.d_2, p.i_2) = (1e-170, 0.0)),
        refuse(|p| (p.d_2, p.i_2) = (-1e-31, 0.0)),
        refuse(|p| (p.d_2, p.i_2) = (f64::MIN_POSITIVE, 0.0)),
    ] {
        let (what, end) = (
            "moment of inertia of `child",
            "` about its pivot, in some configuration,",
        );
        assert!(
            error.what.starts_with(what) && error.what.ends_with(end),
            "{error}"
        );
    }
}

/// Everything that a parameter can be.
#[branched_pendulum(
    gravity = g,
    trunk(mass = m, com = (d, e), inertia = i, joint = l, friction(viscous = c, coulomb = k, quadratic = q, width = w)) [
        twig: rod(mass = n, length = 2 * r + b, spring = s, rest = a, drag(quadratic = q, width = w)) * 2,
        leaf: generations(count = 3, branching = 1, shape = rod, mass = n, length = r, mass_ratio = u, length_ratio = v),
    ],
    drive(torque = k * cos(f * t), x = l * sin(f * t) / f),
)]
struct Everything;

const EVERYTHING: EverythingParameters = EverythingParameters {
    g: 9.8,
    m: 0.1,
    d: 0.1,
    e: -0.02,
    i: 1e-3,
    l: 0.2,
    c: 1e-3,
    k: 1e-2,
    q: 1e-4,
    w: 0.01,
    n: 0.05,
    r: 0.1,
    b: 0.05,
    s: 0.1,
    a: 0.2,
    f: 3.0,
    u: 0.5,
    v: 0.8,
};

/// Of all values from the smallest to the largest numbers, those that are accepted have finite
/// accelerations.
#[test]
fn accepted_parameters_have_finite_accelerations() {
    let mut random = Random::new(17);
    let (mut accepted, mut refused) = (0, 0);
    for count in 0..20_000 {
        let spread = [3.0, 30.0, 300.0][count % 3];
        let mut drawn = |usual: f64| match random.below(3) {
            0 => usual * 10.0_f64.powf(random.between(-spread, spread)),
            _ => usual,
        };
        let usual = EVERYTHING;
        let parameters = EverythingParameters {
            g: drawn(usual.g),
            m: drawn(usual.m),
            d: drawn(usual.d),
            e: drawn(usual.e),
            i: drawn(usual.i),
            l: drawn(usual.l),
            c: drawn(usual.c),
            k: drawn(usual.k),
            q: drawn(usual.q),
            w: drawn(usual.w),
            n: drawn(usual.n),
            r: drawn(usual.r),
            b: drawn(usual.b),
            s: drawn(usual.s),
            a: drawn(usual.a),
            f: drawn(usual.f),
            u: drawn(usual.u),
            v: drawn(usual.v),
        };
        let Ok(model) = Everything::new(parameters) else {
            refused += 1;
            continue;
        };
        accepted += 1;
        let theta = [(); 6].map(|()| random.between(-3.0, 3.0));
        let omega = [(); 6].map(|()| random.between(-8.0, 8.0));
        let alpha = model.accelerations(random.between(-1.0, 1.0), &theta, &omega);
        assert!(
            alpha.iter().all(|alpha| alpha.is_finite()),
            "{parameters:?}: {alpha:?}"
        );
    }
    println!("{accepted} accepted, {refused} refused");
    assert!(accepted > 5_000 && refused > 5_000, "{accepted} {refused}");
}

/// The last generation of a rule, a divisor of the drive and sums are checked too.
#[test]
fn values_that_are_formed_of_parameters_are_refused() {
    let refuse = |change: fn(&mut EverythingParameters)| {
        let mut parameters = EVERYTHING;
        change(&mut parameters);
        Everything::new(parameters).expect_err("out of range")
    };
    for (error, what) in [
        (
            refuse(|p| p.v = 1e20),
            "length of `leaf_3` (parameters `r`, `v`)",
        ),
        (
            refuse(|p| p.b = 1e40),
            "length of `twig` (parameters `r`, `b`)",
        ),
        (
            refuse(|p| p.f = 1e-200),
            "part of the position x of the root's pivot (parameter `f`)",
        ),
        (
            refuse(|p| p.w = 1e-35),
            "width of friction of `trunk` (parameter `w`)",
        ),
    ] {
        assert_eq!(error.what, what);
        assert!(error.requirement.contains("of a magnitude "), "{error}");
    }
}

/// By their names, as a command line has them.
#[test]
fn parameters_are_set_by_name() {
    let mut parameters = PAPER;
    parameters.set("l", 0.3).expect("it has a length");
    parameters.set("c", 1e-4).expect("it has friction");
    let expected = NamedParameters {
        l: 0.3,
        c: 1e-4,
        ..PAPER
    };
    assert_eq!(parameters, expected);
    let unknown = parameters
        .set("m_3", 1.0)
        .expect_err("it has no third mass");
    assert_eq!(unknown.name, "m_3");
    let known = <Named as branched_pendulum::Parametric<f64>>::PARAMETERS;
    assert_eq!(unknown.known, known);
    assert_eq!(
        unknown.to_string(),
        "no parameter `m_3`: there are `g`, `m_1`, `d_1`, `i_1`, `l`, `m_2`, `d_2`, `i_2`, `c`"
    );
    // Nothing has changed.
    assert_eq!(parameters, expected);
}
