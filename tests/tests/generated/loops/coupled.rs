//! Springs and friction between links that are not parent and child, in loops.

use branched_pendulum::prelude::*;
use branched_pendulum::system::OdeFn;
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_trees::TreeDescription;

use super::{Powered, agree, array, balance, order, pair, placed, powered, states};

pair!(CoupledLoops, CoupledUnrolled, COUPLED:
    tree: generations(count = 4, branching = 2, mass = 0.2, com = (0.1, 0.01), inertia = 1e-3,
        joint = (0.3, 0.02), mass_ratio = 0.5, length_ratio = 0.7),
    siblings(tree_2, spring = 0.3),
    siblings(tree_4, spring = 0.02, friction(viscous = 1e-3, coulomb = 4e-3, width = 0.2)),
    siblings(tree_4, friction(quadratic = 1e-4)),
    between(tree_1, tree_3_2_1, spring = 0.1, rest = 0.4, friction = 2e-3),
    drive(torque = 0.4 * cos(3 * t), x = 0.2 * sin(5 * t), y = 0.1 * cos(4 * t))
);
powered!(CoupledLoops, CoupledUnrolled, braked);
// Every two of three, and joints that have friction besides.
pair!(ThreesLoops, ThreesUnrolled, THREES:
    tree: generations(count = 3, branching = 3, shape = rod, mass = 0.2, length = 0.3,
        mass_ratio = 0.4, length_ratio = 0.8, friction = 1e-4, spring = 1e-3),
    siblings(tree_2, friction(viscous = 1e-3, quadratic = 1e-3, width = 0.1)),
    siblings(tree_3, spring = 0.05, friction(coulomb = 1e-3)),
    drive(torque = 0.4 * cos(3 * t), x = 0.2 * sin(5 * t), y = 0.1 * cos(4 * t))
);
powered!(ThreesLoops, ThreesUnrolled, braked);
// A table, whose strips have an order of their own.
pair!(CoupledTable, TableUnrolled, TABLE:
    trunk(mass = 0.2, com = 0.03, inertia = 1e-3, joint = 0.2, friction(coulomb = 1e-2)) [
        arm(mass = 0.1, com = (0.1, 0.01), inertia = 1e-3, joint = 0.2, spring = 0.01) [
            hand(mass = 0.04, com = 0.1, inertia = 1e-4) * 3,
            fork: generations(count = 3, branching = 2, mass = 0.02, com = 0.05,
                inertia = 1e-5, joint = 0.1, length_ratio = 0.8, at = 0.15),
        ] * 2,
        tail: point(mass = 0.03, length = 0.3),
    ],
    siblings(arm, spring = 0.1, friction = 1e-3),
    siblings(hand, friction(coulomb = 1e-3, quadratic = 1e-4)),
    between(tail, hand_2_3, spring = 0.05, rest = -0.3),
    between(trunk, tail, friction(viscous = 1e-3, quadratic = 1e-3)),
    drive(torque = 0.4 * cos(3 * t), x = 0.2 * sin(5 * t), y = 0.1 * cos(4 * t))
);
powered!(CoupledTable, TableUnrolled, braked);

#[test]
fn coupled_generations_agree_with_code_written_out_and_with_the_oracle() {
    let (loops, unrolled) = (CoupledLoops::<f64>::new(), CoupledUnrolled::<f64>::new());
    agree(&loops, &unrolled, COUPLED, [true, true]);
    balance(&loops, &unrolled);
}

#[test]
fn every_two_of_three_siblings_agree() {
    let (loops, unrolled) = (ThreesLoops::<f64>::new(), ThreesUnrolled::<f64>::new());
    agree(&loops, &unrolled, THREES, [true, true]);
    balance(&loops, &unrolled);
}

#[test]
fn coupled_tables_agree_with_code_written_out_and_with_the_oracle() {
    let (table, unrolled) = (CoupledTable::<f64>::new(), TableUnrolled::<f64>::new());
    agree(&table, &unrolled, TABLE, [true, true]);
    balance(&table, &unrolled);
}

/// A rule in loops without being asked for, by parameters.
#[branched_pendulum(
    gravity = 9.80665,
    arm: generations(count = 6, branching = 2, shape = rod, mass = 0.2, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.8),
    siblings(arm_6, spring = spring, friction(viscous = viscous, coulomb = coulomb,
        quadratic = quadratic, width = 0.3)),
    siblings(arm_3, spring = 2 * spring, friction = viscous / 2),
    emit(energies, forces, positions),
)]
struct Rule;

/// One that is small enough for motions in builds without optimisation.
#[branched_pendulum(
    gravity = 9.80665,
    arm: generations(count = 3, branching = 2, shape = rod, mass = 0.2, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.8, code = loops),
    siblings(arm_3, spring = spring, friction(viscous = viscous, coulomb = coulomb,
        quadratic = quadratic, width = 0.3)),
    emit(energies, forces),
)]
struct SmallRule;

/// The text of that model, read at run time with the same values.
#[test]
fn a_rule_agrees_with_the_tree_at_run_time() {
    let source = include_str!("coupled.rs");
    let (rest, _) = source.split_once(")]\nstruct Rule;").expect("it ends");
    let (_, text) = rest
        .rsplit_once("#[branched_pendulum(")
        .expect("it is above");
    let description = TreeDescription::parse(text).expect("the compiler takes it");
    let given = [0.02, 1e-3, 2e-3, 1e-4];
    let names = ["spring", "viscous", "coulomb", "quadratic"];
    let values: Vec<(&str, f64)> = names.into_iter().zip(given).collect();
    let tree = description.tree(&values).expect("the model takes them");
    let model = Rule::new(RuleParameters {
        spring: given[0],
        viscous: given[1],
        coulomb: given[2],
        quadratic: given[3],
    });
    let model = model.expect("nothing is negative");
    let (order, n) = (order(&model, &tree), model.links());
    assert_eq!(n, 63);
    for state in states(n, 50) {
        let (theta, omega) = (&state.theta, &state.omega);
        let torques: Vec<f64> = theta.iter().map(|angle| 0.1 * angle).collect();
        let [own_theta, own_omega, own_torques] =
            [theta, omega, &torques].map(|values| placed(&order, values));
        let [mut free, mut under, mut other] = [(); 3].map(|()| vec![0.0; n]);
        model.accelerations_into(0.0, &own_theta, &own_omega, &mut free);
        model.accelerations_under_into(0.0, &own_theta, &own_omega, &own_torques, &mut under);
        for (found, given) in [(free, None), (under, Some(&torques))] {
            match given {
                None => other = tree.accelerations(0.0, theta, omega),
                Some(torques) => {
                    tree.accelerations_under_into(0.0, theta, omega, torques, &mut other);
                }
            }
            let size = other.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
            for (link, &place) in order.iter().enumerate() {
                let (own, other) = (found[place], other[link]);
                assert!((own - other).abs() < 1e-11 * size, "{own} {other}");
            }
        }
        let (own, other) = (
            model.friction_power(&own_omega),
            tree.friction_power(theta, omega),
        );
        assert!((own / other - 1.0).abs() < 1e-13, "{own} {other}");
        let (own, other) = (
            model.potential_energy_of(&own_theta),
            tree.potential_energy_of(theta),
        );
        assert!((own - other).abs() < 1e-13 * (1.0 + other.abs()));
    }
    let short = [0.0; 62];
    assert!(model.friction_power(&short).is_nan() && model.potential_energy(&short).is_nan());
}

/// ∫P dt is what the energy loses, the integral beside the motion as one more variable: by
/// each law alone, by all, and by none.
#[test]
fn the_energy_is_balanced_along_a_run() {
    const LINKS: usize = 7;
    let none = SmallRuleParameters {
        spring: 0.05,
        viscous: 0.0,
        coulomb: 0.0,
        quadratic: 0.0,
    };
    let [mut viscous, mut coulomb, mut quadratic, mut all] = [none; 4];
    viscous.viscous = 2e-3;
    coulomb.coulomb = 4e-3;
    (quadratic.quadratic, quadratic.spring) = (1e-3, 0.0);
    (all.viscous, all.coulomb, all.quadratic) = (2e-3, 4e-3, 1e-3);
    for (parameters, least) in [
        (none, 0.0),
        (viscous, 0.05),
        (coulomb, 0.05),
        (quadratic, 0.05),
        (all, 0.1),
    ] {
        let model = SmallRule::new(parameters).expect("nothing is negative");
        let ode = OdeFn::new(2 * LINKS + 1, |_: f64, state: &[f64], rates: &mut [f64]| {
            let (theta, omega) = (&state[..LINKS], &state[LINKS..2 * LINKS]);
            rates[..LINKS].copy_from_slice(omega);
            model.accelerations_into(0.0, theta, omega, &mut rates[LINKS..2 * LINKS]);
            rates[2 * LINKS] = model.friction_power(omega);
        });
        let energy = |state: &[f64]| model.energy_of(&state[..LINKS], &state[LINKS..2 * LINKS]);
        let mut random = Random::new(8);
        let mut values = random.around_zero(LINKS, 2.0);
        values.extend(random.around_zero(LINKS, 4.0));
        values.push(0.0);
        let start = State::new(0.0, values);
        let method = Dop853::new(Options::with_tolerance(1e-14));
        let end = method.run(&ode, &start, 5.0);
        let end = end.expect("a smooth motion").state.values;
        let before = energy(&start.values);
        let lost = before - energy(&end);
        assert!(lost >= least * before - 1e-9, "{lost} of {before}");
        let error = lost + end[2 * LINKS];
        assert!(error.abs() < 1e-10, "{error:e} of {lost}");
    }
}

/// Copies in phase feel nothing of what acts between them.
#[test]
fn copies_in_phase_go_with_loops() {
    pair!(PhaseLoops, PhaseUnrolled, PHASE:
        beam: rod(mass = 0.3, length = 0.4) [
            bar: rod(mass = 0.1, length = 0.3) [stick: rod(mass = 0.03, length = 0.1) * 2] * 3,
        ],
        siblings(bar, spring = 0.2, friction = 1e-3),
        siblings(stick, spring = 0.1, friction = 1e-3),
        in_phase(bar)
    );
    let (loops, unrolled) = (PhaseLoops::<f64>::new(), PhaseUnrolled::<f64>::new());
    assert!(PHASE.contains("in_phase"));
    let order = order(&loops, &unrolled);
    for state in states(loops.links(), 50) {
        let (theta, omega) = (placed(&order, &state.theta), placed(&order, &state.omega));
        let [mut own, mut other] = [(); 2].map(|()| vec![0.0; loops.links()]);
        loops.accelerations_into(0.0, &theta, &omega, &mut own);
        unrolled.accelerations_into(0.0, &state.theta, &state.omega, &mut other);
        let size = other.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
        for (link, &place) in order.iter().enumerate() {
            assert!((own[place] - other[link]).abs() < 1e-12 * size);
        }
        let potential = [
            loops.potential_energy_of(&theta),
            unrolled.potential_energy_of(&state.theta),
        ];
        assert!((potential[0] - potential[1]).abs() < 1e-13 * (1.0 + potential[1].abs()));
    }
}
