//! The two ways to solve for the accelerations: against the Cartesian oracle,
//! against each other, and their exactness.

use std::f64::consts::PI;

use branched_pendulum_codegen::program::cost;
use branched_pendulum_codegen::scene::Solve;
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_compiler_tests::source::fixture;
use branched_pendulum_tests::oracle::cartesian::Motion;
use branched_pendulum_tests::oracle::generator::{Recipe, sample};
use branched_pendulum_tests::oracle::{Link, Tree};
use nalgebra::DVector;
use serde_json::Value;

use crate::support::{Compiled, Worst, compile};

/// A description with each solve.
fn both(text: &str) -> [Compiled; 2] {
    Solve::ALL.map(|solve| {
        let compiled = compile(&format!("{text}, solve = {}", solve.name()));
        assert_eq!(compiled.program.choice.solve, solve);
        compiled
    })
}

/// Relative to the conditioning bound |M⁻¹|(|M||ω̇| + |b|); trees of 1 to 16
/// links with copies, offsets, friction, drag and springs.
#[test]
fn both_agree_with_the_oracle_and_each_other() {
    let [mut factorization, mut recursion, mut between] = [(); 3].map(|()| Worst::default());
    for seed in 0..24 {
        let recipe = Recipe {
            links: 1 + seed as usize % 16,
            copies: &[1, 1, 2, 3],
            nested: true,
            requests: "",
        };
        let sample = sample(&recipe, 500 + seed);
        let solves = both(&sample.text);
        let links = sample.tree.links.len();
        let mut random = Random::new(8000 + seed);
        for count in 0..300 {
            let theta = random.around_zero(links, PI);
            let omega = random.around_zero(links, 10.0);
            let motion = Motion::new(&sample.tree, &theta, &omega);
            let expected = motion.accelerations();
            let sensitivity = motion.sensitivity(&expected);
            let found = solves
                .each_ref()
                .map(|solve| solve.evaluate("accelerations", &[&theta, &omega]));
            for link in 0..links {
                let place = || format!("tree {seed}, state {count}, link {link}");
                let scale = sensitivity[link];
                factorization.note(found[0][link] - expected[link], scale, place);
                recursion.note(found[1][link] - expected[link], scale, place);
                between.note(found[0][link] - found[1][link], scale, place);
            }
        }
    }
    factorization.assert_below(1e-15, "factorization");
    recursion.assert_below(1e-15, "recursion");
    between.assert_below(1e-15, "one against the other");
}

/// A tree in parameters, of which some are zero and some negative.
#[test]
fn parameters_of_either_sign() {
    let solves = both(
        "gravity = g, root(mass = m, com = d, inertia = 0.1, joint = l, friction = 0.01) [
            arm: rod(mass = m, length = l) [ tip(mass = 0.3, com = d, inertia = 0.02, drag = 0.1) * 2 ] * 2,
            other(mass = 0.2, com = (0.1, d), inertia = i, at = (0.2, -0.3), spring = k),
        ]",
    );
    // gravity, m, d, l, i, k
    for (number, parameters) in [
        [9.8, 1.0, 0.2, 0.7, 0.01, 3.0],
        [9.8, 1.0, 0.0, 0.7, 0.01, 0.0],
        [0.0, 2.0, -0.1, 0.4, 0.0, 1.0],
    ]
    .iter()
    .enumerate()
    {
        let names: Vec<&str> = solves[0]
            .scene
            .parameters
            .iter()
            .map(|parameter| parameter.name.as_str())
            .collect();
        let order = ["g", "m", "d", "l", "i", "k"];
        let values: Vec<f64> = names
            .iter()
            .map(|name| parameters[order.iter().position(|n| n == name).expect("a parameter")])
            .collect();
        let mut random = Random::new(number as u64);
        for _ in 0..200 {
            let links = solves[0].scene.links.len();
            let theta = random.around_zero(links, PI);
            let omega = random.around_zero(links, 5.0);
            let [a, b] = solves.each_ref().map(|solve| {
                let found = solve.evaluate_with(&values, "accelerations", &[&theta, &omega]);
                DVector::from_vec(found)
            });
            assert!(a.iter().all(|value| value.is_finite()));
            assert!(
                (&a - &b).amax() < 1e-12 * a.amax(),
                "{parameters:?}: {a} {b}"
            );
        }
    }
}

/// The cheaper one is emitted, and each costs what the choice says.
#[test]
fn the_cheaper_solve_is_emitted() {
    let tree = |count: usize| {
        format!(
            "gravity = 9.80665, tree: generations(count = {count}, branching = 2, shape = rod, \
             mass = 0.12, length = 0.3, mass_ratio = 0.5, length_ratio = 0.7)"
        )
    };
    for count in 1..=5 {
        let chosen = compile(&tree(count)).program;
        let [factorization, recursion] = both(&tree(count)).map(|compiled| {
            let program = compiled.program;
            let entry = program.entry("accelerations").expect("always there");
            (program.operations(&entry.outputs), program.choice)
        });
        assert_eq!(Some(factorization.0), chosen.choice.factorization);
        assert_eq!(recursion.0, chosen.choice.recursion);
        let cheaper = match cost(&recursion.0) < cost(&factorization.0) {
            true => Solve::Recursion,
            false => Solve::Factorization,
        };
        assert_eq!(chosen.choice.solve, cheaper, "{count} generations");
    }
}

/// Equal siblings in equal states get accelerations equal to the bit, and a
/// hanging tree at rest exactly none, whichever way they are solved for.
#[test]
fn symmetry_is_exact() {
    let text = "gravity = 9.80665, a: rod(mass = 1.1, length = 0.7) [
        b: rod(mass = 0.3, length = 0.4, friction = 1e-3) [
            c: rod(mass = 0.1, length = 0.3) * 3
        ] * 2
    ]";
    let mut random = Random::new(77);
    for solve in both(text) {
        for _ in 0..500 {
            let [a, b, c] = [(); 3].map(|()| random.between(-PI, PI));
            let theta = [a, b, c, c, c, b, c, c, c];
            let [a, b, c] = [(); 3].map(|()| random.between(-9.0, 9.0));
            let omega = [a, b, c, c, c, b, c, c, c];
            let found = solve.evaluate("accelerations", &[&theta, &omega]);
            assert_eq!(found[1].to_bits(), found[5].to_bits());
            for leaf in [3, 4, 6, 7, 8] {
                assert_eq!(found[2].to_bits(), found[leaf].to_bits());
            }
        }
        let rest = [0.0; 9];
        let found = solve.evaluate("accelerations", &[&rest, &rest]);
        assert!(found.iter().all(|&alpha| alpha == 0.0), "{found:?}");
    }
}

/// Against 50 digits, up to seven links: the error in units of
/// u |M⁻¹|(|M||ω̇| + |b|), u = 2⁻⁵³ one rounding.
#[test]
fn both_are_as_good_as_their_conditioning() {
    let path = fixture("reference/accelerations.json");
    let text = std::fs::read_to_string(path).expect("the fixture exists");
    let data: Value = serde_json::from_str(&text).expect("the fixture is JSON");
    let link = |parent: Option<usize>, [mass, com, inertia, lever]: [f64; 4]| Link {
        parent,
        mass,
        inertia,
        com: [com, 0.0],
        pivot: [lever, 0.0],
        friction: 0.0,
        drag: 0.0,
        spring: 0.0,
        rest: 0.0,
        laws: Default::default(),
    };
    let rod = |parent, mass: f64, length: f64, lever| {
        link(
            parent,
            [mass, length / 2.0, mass * length * length / 12.0, lever],
        )
    };
    let child = link(Some(0), [0.10531, 0.043, 0.516e-3, 0.27]);
    let scenes = [
        (
            "paper",
            "parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
                child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2]",
            vec![
                link(None, [0.12880, 0.084, 1.88e-3, 0.0]),
                child.clone(),
                child,
            ],
        ),
        (
            "chain",
            "a(mass = 1.3, com = 0.4, inertia = 0.07, joint = 0.5) [
                b(mass = 0.2, com = 0.31, inertia = 0.002, joint = 0.62) [
                    c(mass = 0.7, com = 0.05, inertia = 0.01, joint = 0.3) [
                        d(mass = 0.11, com = 0.2, inertia = 0, joint = 0.41) [
                            e(mass = 0.0003, com = 0.6, inertia = 1e-5)]]]]",
            vec![
                link(None, [1.3, 0.4, 0.07, 0.0]),
                link(Some(0), [0.2, 0.31, 0.002, 0.5]),
                link(Some(1), [0.7, 0.05, 0.01, 0.62]),
                link(Some(2), [0.11, 0.2, 0.0, 0.3]),
                link(Some(3), [0.0003, 0.6, 1e-5, 0.41]),
            ],
        ),
        (
            "tree",
            "tree: generations(count = 3, branching = 2, shape = rod, mass = 0.12,
                length = 0.3, mass_ratio = 0.5, length_ratio = 0.7)",
            vec![
                rod(None, 0.12, 0.3, 0.0),
                rod(Some(0), 0.06, 0.21, 0.3),
                rod(Some(1), 0.03, 0.147, 0.21),
                rod(Some(1), 0.03, 0.147, 0.21),
                rod(Some(0), 0.06, 0.21, 0.3),
                rod(Some(4), 0.03, 0.147, 0.21),
                rod(Some(4), 0.03, 0.147, 0.21),
            ],
        ),
    ];
    let numbers = |value: &Value| -> Vec<f64> {
        let values = value.as_array().expect("a list").iter();
        values
            .map(|value| value.as_str().and_then(|text| text.parse().ok()))
            .collect::<Option<_>>()
            .expect("decimals")
    };
    for (name, text, links) in scenes {
        let tree = Tree {
            gravity: 9.80665,
            links,
            between: Vec::new(),
        };
        for solve in both(&format!("gravity = 9.80665, {text}")) {
            let mut worst = Worst::default();
            for point in data[name].as_array().expect("points") {
                let [theta, omega, alpha] =
                    ["theta", "omega", "alpha"].map(|what| numbers(&point[what]));
                let motion = Motion::new(&tree, &theta, &omega);
                let expected = DVector::from_vec(alpha);
                let sensitivity = motion.sensitivity(&expected);
                let found = solve.evaluate("accelerations", &[&theta, &omega]);
                for link in 0..found.len() {
                    // The difference is exact, the reference rounded once.
                    let error = found[link] - expected[link];
                    let bound = sensitivity[link] * f64::EPSILON / 2.0;
                    worst.note(error, bound, || format!("{name}, link {link}"));
                }
            }
            let way = solve.program.choice.solve.name();
            worst.assert_below(4.0, &format!("{name}, {way}, in roundings"));
        }
    }
}
