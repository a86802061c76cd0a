//! Values that are finite and that no pendulum has: refused in texts and as parameters, so that
//! what is accepted has finite accelerations.

use branched_pendulum::prelude::*;
use branched_pendulum_trees::{PendulumTree, TreeDescription, TreeError};

use crate::text::Random;

const PARAMETRIC: &str = "gravity = g,
    limb(mass = m, com = (d, 0.01), inertia = i, joint = l, friction(viscous = c, coulomb = k, width = w)) [
        twig: rod(mass = n, length = r, spring = s, drag(quadratic = k)) * 2,
        bob: point(mass = n, length = r),
    ],
    drive(torque = k * cos(f * t), x = l * sin(f * t) / f)";

const STRAIGHT: &str = "gravity = g,
    limb: rod(mass = m, length = l) [twig: rod(mass = n, length = r) * 2]";

const RULE: &str = "gravity = g, tree: generations(count = 4, branching = 2, shape = rod,
    mass = m, length = l, friction = c, mass_ratio = n, length_ratio = r)";

const USUAL: [(&str, f64); 12] = [
    ("g", 9.8),
    ("m", 0.1),
    ("d", 0.1),
    ("i", 1e-3),
    ("l", 0.3),
    ("c", 1e-3),
    ("k", 1e-3),
    ("w", 0.01),
    ("n", 0.5),
    ("r", 0.7),
    ("s", 0.1),
    ("f", 3.0),
];

fn tree(text: &str, value: impl Fn(&str, f64) -> f64) -> Result<PendulumTree, TreeError> {
    let description = TreeDescription::parse(text).unwrap();
    let values: Vec<(&str, f64)> = USUAL
        .into_iter()
        .filter(|(name, _)| description.parameters().any(|known| known == *name))
        .map(|(name, usual)| (name, value(name, usual)))
        .collect();
    description.tree(&values)
}

/// A number between −size and size.
fn between(random: &mut Random, size: f64) -> f64 {
    (random.below(1 << 20) as f64 / f64::from(1 << 19) - 1.0) * size
}

#[test]
fn parameters_out_of_range_are_refused_by_name() {
    for (text, parameter, own, expected) in [
        (PARAMETRIC, "m", 1e300, "mass of `limb` (parameter `m`)"),
        (
            PARAMETRIC,
            "d",
            -1e200,
            "centre of mass of `limb` (parameter `d`)",
        ),
        (
            PARAMETRIC,
            "w",
            1e-40,
            "width of friction of `limb` (parameter `w`)",
        ),
        (
            PARAMETRIC,
            "k",
            1e101,
            "Coulomb friction of `limb` (parameter `k`)",
        ),
        (
            PARAMETRIC,
            "s",
            f64::MAX,
            "spring of `twig` (parameter `s`)",
        ),
        (PARAMETRIC, "g", 1e150, "gravity (parameter `g`)"),
        (STRAIGHT, "l", 1e31, "length of `limb` (parameter `l`)"),
        (STRAIGHT, "n", 1e41, "mass of `twig` (parameter `n`)"),
        (RULE, "r", 1e20, "length of `tree_4` (parameters `l`, `r`)"),
        (RULE, "m", 1e-200, "mass of `tree` (parameter `m`)"),
        (RULE, "c", 1e160, "friction of `tree` (parameter `c`)"),
    ] {
        let found = tree(
            text,
            |name, usual| if name == parameter { own } else { usual },
        );
        let Err(TreeError::Value {
            what,
            value,
            requirement,
        }) = found
        else {
            panic!("{parameter} = {own} is answered by {found:?}");
        };
        assert_eq!(what, expected);
        assert!(value == own || what.contains("parameters"), "{value}");
        assert!(requirement.contains("of a magnitude "), "{requirement}");
    }
    let error = tree(STRAIGHT, |_, usual| usual)
        .unwrap()
        .with("m", 1e300)
        .unwrap_err();
    let expected = "mass of `limb` (parameter `m`) is 1e300, must be 0 or of a magnitude from 1e-60 to 1e40 kg";
    assert_eq!(error.to_string(), expected);
}

#[test]
fn numbers_out_of_range_are_refused_where_they_stand() {
    for (text, column, message) in [
        (
            "gravity = 1e77, a: rod(mass = 1, length = 1)",
            11,
            "gravity is too large or too small",
        ),
        (
            "gravity = 1, a: rod(mass = 1e300, length = 1)",
            28,
            "mass of `a` is too large or too small",
        ),
        (
            "gravity = 1, a: rod(mass = 1, length = 1e200)",
            40,
            "length of `a` is too large or too small",
        ),
        (
            "gravity = 1, a: point(mass = 1e-200, length = 1)",
            30,
            "mass of `a` is too large or too small",
        ),
        (
            "gravity = 1, a(mass = 1, com = 1e-170, inertia = 0)",
            14,
            "`a` can turn without kinetic energy",
        ),
        (
            "gravity = 1, a: rod(mass = 1, length = 1, spring = 1e101)",
            52,
            "spring of `a` is too large or too small",
        ),
    ] {
        let error = TreeDescription::parse(text).unwrap_err();
        let [mistake] = error.mistakes() else {
            panic!("{error}");
        };
        assert_eq!(
            (mistake.column, mistake.message.as_str()),
            (column, message)
        );
    }
}

#[test]
fn accepted_values_have_finite_accelerations() {
    let mut random = Random(3);
    for text in [PARAMETRIC, STRAIGHT, RULE] {
        let (mut accepted, mut refused) = (0, 0);
        for count in 0..1_200 {
            let spread = [3.0, 30.0, 300.0][count % 3];
            let changes: Vec<f64> = USUAL
                .iter()
                .map(|_| match random.below(3) {
                    0 => 10.0_f64.powf(between(&mut random, spread)),
                    _ => 1.0,
                })
                .collect();
            let place = |name: &str| USUAL.iter().position(|(known, _)| *known == name).unwrap();
            let Ok(tree) = tree(text, |name, usual| usual * changes[place(name)]) else {
                refused += 1;
                continue;
            };
            accepted += 1;
            let theta: Vec<f64> = (0..tree.links())
                .map(|_| between(&mut random, 3.0))
                .collect();
            let omega: Vec<f64> = (0..tree.links())
                .map(|_| between(&mut random, 8.0))
                .collect();
            let alpha = tree.accelerations(between(&mut random, 1.0), &theta, &omega);
            let finite = alpha.iter().all(|alpha| alpha.is_finite());
            assert!(
                finite,
                "{text} {:?}: {alpha:?}",
                USUAL.map(|(name, usual)| usual * changes[place(name)])
            );
        }
        println!("{accepted} accepted, {refused} refused");
        assert!(accepted > 400 && refused > 120, "{accepted} {refused}");
    }
}
