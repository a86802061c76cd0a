//! Budgets by scale: energies sum up, and change as transfers and powers tell.

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Dual;
use branched_pendulum_trees::PendulumTree;

/// A tree by rule with all that links can have, in an order of its own.
const RULE: &str = "gravity = 9.81,
    trunk(mass = 0.3, com = (0.1, 0.02), inertia = 2e-3, friction = 1e-3, drag = 2e-4) [
        bough(mass = 0.1, com = (0.12, -0.01), inertia = 1e-3, at = (0.3, 0.05),
            joint = (0.2, 0.01), spring = 0.2, rest = 0.1,
            friction(viscous = 1e-3, coulomb = 0.02, static = 0.04, stribeck = 2, quadratic = 1e-3)) [
            twig: rod(mass = 0.04, length = 0.2, drag(viscous = 1e-4, quadratic = 1e-4)) * 3
        ] * 2
    ],
    siblings(bough, spring = 0.05), siblings(twig, spring = 0.3, friction(viscous = 1e-3, coulomb = 0.02)),
    between(trunk, twig_2_3, friction = 2e-3),
    drive(torque = 0.1 * cos(3 * t), x = 0.02 * sin(2 * t)^2, y = 0.01 * sin(5 * t))";

fn state(tree: &PendulumTree) -> [Vec<f64>; 3] {
    let number = |link: usize, factor: f64| (factor * (1 + link) as f64).sin();
    [1.3, 4.1, 0.7].map(|factor| (0..tree.links()).map(|link| number(link, factor)).collect())
}

#[test]
fn energies_sum_up() {
    for text in [RULE, "gravity = 9.81, rod: rod(mass = 1, length = 1)"] {
        let tree = PendulumTree::parse(text).unwrap();
        let [theta, omega, _] = state(&tree);
        let budget = tree.budget_by_scale(0.4, [&theta, &omega, &[]]).unwrap();
        let sum: f64 = (0..budget.scales()).map(|scale| budget.energy(scale)).sum();
        let energy = tree.energy_of(&theta, &omega);
        assert!(
            (sum - energy).abs() < 1e-14 * energy.abs(),
            "{sum} {energy}"
        );
    }
}

/// By derivatives along the motion, in dual numbers.
#[test]
fn energies_change_as_the_budget_tells() {
    let tree = PendulumTree::parse(RULE).unwrap();
    let [theta, omega, mut torques] = state(&tree);
    torques.iter_mut().for_each(|torque| *torque *= 0.01);
    let mut alpha = vec![0.0; tree.links()];
    let time = 0.4;
    let given = [&theta[..], &omega, &torques];
    tree.accelerations_under_into(time, &theta, &omega, &torques, &mut alpha);
    let dual = tree.cast(Dual::<f64, 1>::constant);
    let along = |values: &[f64], rates: &[f64]| -> Vec<Dual<f64, 1>> {
        let pairs = values.iter().zip(rates);
        let number = |(value, rate): (&f64, &f64)| Dual {
            value: *value,
            tangents: [*rate],
        };
        pairs.map(number).collect()
    };
    let moving = [along(&theta, &omega), along(&omega, &alpha)];
    let rates = dual.budget_by_scale(Dual::constant(time), [&moving[0], &moving[1], &[]]);
    let (rates, budget) = (rates.unwrap(), tree.budget_by_scale(time, given).unwrap());
    assert_eq!((tree.copies(), budget.scales()), (Some(&[1, 2, 3][..]), 3));
    for scale in 0..3 {
        let [rate] = rates.energy(scale).tangents;
        let reported = budget.received(scale) + budget.power(scale);
        let size = budget.received(scale).abs() + budget.power(scale).abs();
        assert!(
            (rate - reported).abs() < 1e-12 * size,
            "{scale}: {rate} {reported}"
        );
    }
    let whole = |power: &dyn Fn(usize) -> f64| (0..3).map(power).sum::<f64>();
    let near = |own: f64, other: f64| assert!((own - other).abs() < 1e-13, "{own} {other}");
    let friction = |scale| budget.friction_power(scale) + budget.drag_power(scale);
    near(whole(&friction), tree.friction_power(&theta, &omega));
    near(
        whole(&|scale| budget.drive_power(scale)),
        tree.drive_power(time, &theta, &omega),
    );
    near(
        whole(&|scale| budget.outside_power(scale)),
        tree.outside_power(&omega, &torques),
    );
}

/// Links stand bough by bough, and scales know which are copies.
#[test]
fn copies_in_phase_have_no_energy_against_each_other() {
    let tree = PendulumTree::parse(RULE).unwrap();
    assert_eq!(tree.names()[1..3], ["bough_1", "twig_1_1"]);
    let mut theta = [0.5, 0.3, 0.2, 0.2, 0.2, 0.3, 0.2, 0.2, 0.2];
    let still = [0.0; 9];
    let energies = |theta: &[f64]| {
        let budget = tree.budget_by_scale(0.0, [theta, &still, &[]]).unwrap();
        [0, 1, 2].map(|scale| budget.energy(scale))
    };
    let [_, boughs, twigs] = energies(&theta);
    assert_eq!([boughs, twigs], [0.0; 2]);
    // Twigs of both boughs differ in the same way: the boughs do not.
    for link in [2, 6] {
        theta[link] = 0.4;
    }
    let [_, boughs, twigs] = energies(&theta);
    assert!(boughs == 0.0 && twigs > 1e-4);
    theta[5] = 0.1;
    assert!(energies(&theta)[1] > 1e-4);
}

#[test]
fn other_trees_have_no_scales() {
    for (one, other) in [
        ("twig: rod(mass = 0.04", "twig: rod(mass = 0.04 + 0.01"),
        ("* 3\n", "* 3, bud: rod(mass = 0.01, length = 0.1)\n"),
    ] {
        let text = RULE.replace(one, other);
        let tree = PendulumTree::parse(&text).unwrap();
        let [theta, omega, _] = state(&tree);
        let has_scales = tree.budget_by_scale(0.0, [&theta, &omega, &[]]).is_some();
        // Of the first all links of a generation have changed.
        assert_eq!(has_scales, other.contains("0.04 + 0.01"), "{text}");
    }
    let tree = PendulumTree::parse(RULE).unwrap();
    let budget = tree.budget_by_scale(0.0, [&[0.0; 9], &[0.0; 9], &[0.0; 2]]);
    assert!(budget.unwrap().energy(0).is_nan());
}
