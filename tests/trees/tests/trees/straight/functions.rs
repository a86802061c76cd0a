//! Observables, parameters and refusals of straight springs.

use branched_pendulum::ensemble::Ensemble;
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Dual;
use branched_pendulum::transfer::StateInput;
use branched_pendulum_trees::{ParameterUse, PendulumTree, TreeDescription};

use super::GUYED;

/// Observables know the energy of straight springs, and their rates what dampers take.
#[test]
fn observables_know_straight_springs() {
    let text = GUYED.replace("rest = 0.3)", "rest = 0.3, friction = 0.2)");
    let tree = format!("{text}, observe(energy = kinetic_energy + potential_energy)");
    let tree = PendulumTree::parse(&tree).unwrap();
    let energy = tree.observable("energy").unwrap();
    let theta = [0.3, 0.8, -0.4, 0.2, 1.1, -0.7, 0.5];
    let omega = [1.0, -2.0, 0.5, 1.5, -0.3, 2.0, -1.0];
    let given = StateInput::Absolute {
        theta: &theta,
        omega: &omega,
    };
    assert!((energy.value(given) - tree.energy_of(&theta, &omega)).abs() < 1e-13);
    let power = tree.friction_power(&theta, &omega);
    assert!(power < -0.01);
    assert!(
        (energy.rate(0.0, given) - power).abs() < 1e-12,
        "{}",
        energy.rate(0.0, given)
    );
    assert!((energy.friction_rate(given) - power).abs() < 1e-12);
}

/// Parameters are those of any quantity of a straight spring, and derivatives by them come of dual
/// numbers.
#[test]
fn parameters_of_straight_springs_have_derivatives() {
    let text = "gravity = 9.81, rod: rod(mass = 0.2, length = 0.3),
        guy(rod, at = p, to = (x, 0), spring = k, rest = l, repulsion = a, exponent = 3, friction = c)";
    let description = TreeDescription::parse(text).unwrap();
    let values = [0.25, 0.4, 20.0, 0.1, 1e-3, 0.3];
    assert_eq!(description.uses_of("a"), [ParameterUse::Joint]);
    let state = [0.5, 2.0];
    let rates = |values: [Dual<f64, 1>; 6]| {
        let mut rates = [Dual::constant(0.0); 2];
        let state = state.map(Dual::constant);
        description
            .equations(&values)
            .rates(Dual::constant(0.0), &state, &mut rates);
        rates[1]
    };
    for place in 0..6 {
        let mut dual = values.map(Dual::constant);
        dual[place] = Dual::variable(values[place], 0);
        let step = 1e-5;
        let [high, low] = [step, -step].map(|step| {
            let mut moved = values.map(Dual::constant);
            moved[place] = Dual::constant(values[place] + step);
            rates(moved).value
        });
        let (found, expected) = (rates(dual).tangents[0], (high - low) / (2.0 * step));
        assert!(
            (found - expected).abs() < 1e-5 * (1.0 + expected.abs()),
            "{found} {expected}"
        );
    }
    let refused = [0.25, 0.4, -20.0, 0.1, -1e-3, 0.3];
    let names = description.parameters().map(str::to_owned);
    let named: Vec<(String, f64)> = names.zip(refused).collect();
    let named: Vec<(&str, f64)> = named
        .iter()
        .map(|(name, value)| (name.as_str(), *value))
        .collect();
    let error = description.tree::<f64>(&named).unwrap_err();
    assert!(
        error.to_string().contains("spring of `guy(rod)`"),
        "{error}"
    );
}

/// The law of Lennard-Jones is two clauses, whose forces cancel at the distance of least energy, and
/// a spring and a repulsion on one line are those on two.
#[test]
fn laws_of_one_line_add() {
    let tree = |clauses: &str| {
        PendulumTree::parse(&format!(
            "gravity = 0, rod: point(mass = 1, length = 0.3), {clauses}"
        ))
        .unwrap()
    };
    let guy = "guy(rod, at = 0.3, to = (0.4, 0.1)";
    let one = tree(&format!(
        "{guy}, spring = 3, rest = 0.1, repulsion = 1e-3, exponent = 3)"
    ));
    let two = tree(&format!(
        "{guy}, spring = 3, rest = 0.1), {guy}, repulsion = 1e-3, exponent = 3)"
    ));
    assert_eq!(two.translational_spring_dampers().iter().count(), 2);
    for angle in [-2.0, 0.3, 1.1] {
        let [own, other] = [&one, &two].map(|tree| tree.accelerations(0.0, &[angle], &[0.0])[0]);
        assert!((own - other).abs() < 1e-13 * own.abs(), "{own} {other}");
        let [own, other] = [&one, &two].map(|tree| tree.potential_energy_of(&[angle]));
        assert!((own - other).abs() < 1e-13 * own.abs(), "{own} {other}");
    }
    // U = A/ℓ¹² − B/ℓ⁶ is least at ℓ⁶ = 2 A/B, −B²/(4 A) there.
    let (depth, sixth) = (2.0, f64::powi(0.2, 6));
    let [repulsion, attraction] = [depth * sixth * sixth, 2.0 * depth * sixth];
    let guy = "guy(rod, at = 0.3, to = (0, -0.5)";
    let pair = tree(&format!(
        "{guy}, repulsion = {repulsion}, exponent = 12), {guy}, repulsion = {}, exponent = 6)",
        -attraction
    ));
    assert!((pair.potential_energy_of(&[0.0]) + depth).abs() < 1e-13);
    // cos θ of the angle at which the end is as far from the peg once more, beside it.
    let near = tree(&format!("{guy}, repulsion = {attraction}, exponent = 6)"));
    let angle = 1e-3;
    let bound = pair.accelerations(0.0, &[angle], &[0.0])[0].abs();
    let pushed = near.accelerations(0.0, &[angle], &[0.0])[0].abs();
    assert!(pushed > 0.01 && bound < 1e-3 * pushed, "{bound} {pushed}");
}

/// Each lane has magnets of its own strength.
#[test]
fn lanes_have_repulsions_of_their_own() {
    let tree = |strength: f64| {
        let own = format!("repulsion = {strength}, exponent = 3");
        PendulumTree::parse(&GUYED.replace("repulsion = 0.002, exponent = 3", &own)).unwrap()
    };
    let trees: Vec<PendulumTree> = (1..7)
        .map(|number| tree(0.001 * f64::from(number)))
        .collect();
    let start = State::at_rest(0.0, &[0.3, 0.8, -0.4, 0.2, 1.1, -0.7, 0.5]);
    let method = Dop853::new(Options::with_tolerance(1e-12));
    let lanes: Vec<_> = trees
        .iter()
        .map(|tree| (AbsoluteAngles(tree), start.clone()))
        .collect();
    let moved = Ensemble::new().integrate_models_in_lanes(&method, &lanes, 0.5);
    let mut before = start.values.clone();
    for (tree, moved) in trees.iter().zip(moved) {
        let alone = method.run(&AbsoluteAngles(tree), &start, 0.5);
        let [own, alone] = [moved, alone].map(|end| end.unwrap().state.values);
        for (own, alone) in own.iter().zip(&alone) {
            assert!((own - alone).abs() < 1e-9, "{own} {alone}");
        }
        let changed = own.iter().zip(&before).any(|(a, b)| (a - b).abs() > 1e-4);
        assert!(changed, "{own:?}");
        before = own;
    }
}

#[test]
fn clauses_that_say_nothing_are_refused() {
    let tree = "gravity = 9.81, a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2]";
    for (clause, message) in [
        (
            "between(a, b_1, at = 0.3)",
            "neither spring, friction nor repulsion",
        ),
        (
            "between(a, b_1, at = 0.3, spring = 1, rest = -1)",
            "rest of `between(a, b_1)`",
        ),
        (
            "between(a, b_1, at = 0.3, rest = 1, friction = 1)",
            "rest length, but no spring",
        ),
        (
            "between(a, b_1, at = 0.3, repulsion = 1)",
            "has no `exponent`",
        ),
        (
            "between(a, b_1, at = 0.3, exponent = 3)",
            "an exponent, but no repulsion",
        ),
        (
            "between(a, b_1, at = 0.3, repulsion = 1, exponent = 0)",
            "not a whole number from 1 to 12",
        ),
        ("siblings(b, repulsion = 1, exponent = 3)", "has no `at`"),
        (
            "between(a, b_1, at = 1, repulsion = 1, exponent = 3), emit(symmetric)",
            "`symmetric` cannot include the repulsion",
        ),
        (
            "between(a, b_1, at = each(1, 0), spring = 1)",
            "cannot change",
        ),
        (
            "between(a, b_1, at = each(1, 0.5), spring = 1)",
            "cannot change",
        ),
        (
            "between(a, b_1, at = each(1, 0, 2), spring = 1)",
            "does not give one point for each link",
        ),
        (
            "siblings(b, at = each(1, 2), spring = 1)",
            "does not give one point for each link",
        ),
        (
            "between(a, b_1, at = 1, spring = 1, friction(coulomb = 1))",
            "no property `friction(coulomb)`",
        ),
        (
            "between(a, b_1, at = 1, to = (1, 1), spring = 1)",
            "no property `to`",
        ),
        ("guy(a, at = 1, spring = 1)", "has no `to`"),
        ("guy(a, to = (1, 1), spring = 1)", "has no `at`"),
        ("guy(a, at = 1, to = 1, spring = 1)", "`to` is not a point"),
        (
            "guy(a, b_1, at = 1, to = (1, 0), spring = 1)",
            "does not name one link",
        ),
        ("guy(a, at = 0, to = (1, 0), spring = 1)", "cannot change"),
        (
            "guy(a, at = 1, to = (1, 0), spring = 1), drive(x = t)",
            "a drive that moves the pivot",
        ),
        (
            "siblings(b, at = 1, spring = 1), in_phase(b)",
            "cannot be combined with `in_phase(...)`",
        ),
        (
            "between(a, b_1, at = 1, spring = 1), emit(symmetric)",
            "`symmetric` cannot include the straight spring",
        ),
    ] {
        let found = PendulumTree::parse(&format!("{tree}, {clause}"))
            .unwrap_err()
            .to_string();
        assert!(found.contains(message), "{clause}: {found}");
    }
    // A link may be called so.
    assert!(PendulumTree::parse("gravity = 9.81, guy(mass = 1, com = 1, inertia = 0)").is_ok());
}
