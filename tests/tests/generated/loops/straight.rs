//! Straight springs, repulsions, dampers and guys in loops: against code written out, trees at run
//! time, and the energy along their motions.

use branched_pendulum::prelude::*;
use branched_pendulum::system::{OdeFn, PrescribedMotion};
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_trees::PendulumTree;

use super::{State as Configuration, array, order, placed, states};

/// A tree in loops, the same one written out, and its text.
macro_rules! strung {
    ($loops:ident, $unrolled:ident, $text:ident: $($tree:tt)*) => {
        #[branched_pendulum(code = loops, emit(energies, forces), $($tree)*)]
        struct $loops;

        #[branched_pendulum(code = unrolled, emit(energies, forces), $($tree)*)]
        struct $unrolled;

        const $text: &str = stringify!($($tree)*);

        impl Strung for $loops {
            fn loss(&self, theta: &[f64], omega: &[f64]) -> f64 {
                self.friction_power(theta, omega)
            }
        }

        impl Strung for $unrolled {
            fn loss(&self, theta: &[f64], omega: &[f64]) -> f64 {
                self.friction_power(array(theta), array(omega))
            }
        }
    };
}

/// A model with dampers along lines.
trait Strung: Energy<f64> + Prescribed<f64> {
    fn loss(&self, theta: &[f64], omega: &[f64]) -> f64;
}

// Runs of many lines, every two of three, by all that lines store; cousins; and two guys.
strung!(StrungLoops, StrungUnrolled, STRUNG:
    gravity = 9.80665,
    tree: generations(count = 3, branching = 3, mass = 0.2, com = (0.1, 0.01), inertia = 1e-3,
        joint = (0.3, 0.02), mass_ratio = 0.5, length_ratio = 0.7),
    siblings(tree_2, at = (0.2, 0.03), spring = 3, rest = 0.05, friction = 0.02),
    siblings(tree_3, at = 0.1, spring = 2, repulsion = 1e-5, exponent = 3),
    siblings(tree_3, at = (0.05, 0.02), repulsion = 1e-4, exponent = 2, friction = 1e-2),
    siblings(tree_3, spring = 0.02, friction(viscous = 1e-3, coulomb = 4e-3, width = 0.2)),
    between(tree_3_1_2, tree_3_2_3, at = each((0.1, 0.02), 0.05), spring = 4, rest = 0.3),
    between(tree_1, tree_3_3_1, at = each(0.2, (0.1, -0.01)), friction = 0.05),
    guy(tree_3_2_1, at = 0.1, to = (0.3, 0.2), spring = 2, rest = 0.1, friction = 0.01),
    guy(tree_2_1, at = (0.1, 0.05), to = (0.2, -0.1), spring = 5),
    drive(torque = 0.4 * cos(3 * t)),
    prescribed(tree_1),
    prescribed(tree_3_2_1, tree_2_3)
);
// A table that stands, whose strips have an order of their own; copies that hang at several places.
strung!(StrungTable, TableUnrolled, TABLE:
    gravity = -9.80665,
    trunk(mass = 0.2, com = 0.03, inertia = 1e-3, joint = 0.2, friction(coulomb = 1e-2)) [
        arm(mass = 0.1, com = (0.1, 0.01), inertia = 1e-3, joint = 0.2, spring = 0.01) [
            hand(mass = 0.04, com = 0.1, inertia = 1e-4, at = (0.1, 0.03)) * 3,
            fork: generations(count = 3, branching = 2, mass = 0.02, com = 0.05,
                inertia = 1e-5, joint = 0.1, length_ratio = 0.8, at = 0.15),
        ] * 2,
        tail: point(mass = 0.03, length = 0.3),
    ],
    siblings(arm, at = 0.15, spring = 5, rest = 0.1, friction = 0.02),
    siblings(hand, at = (0.05, 0.01), repulsion = 1e-4, exponent = 1),
    between(tail, hand_2_3, at = each(0.3, (0.1, 0.02)), spring = 3, rest = 0.2, friction = 1e-2),
    between(trunk, tail, at = each((0.1, 0.1), 0.2), spring = 2),
    guy(hand_1_2, at = (0.1, 0.02), to = (0.2, 0.3), spring = 4, rest = 0.1),
    siblings(hand, friction(quadratic = 1e-4)),
    prescribed(trunk),
    prescribed(hand_1_1, arm_2)
);

/// The largest difference of two lists in units of the second one's size.
fn apart(found: &[f64], expected: &[f64]) -> f64 {
    let size = expected.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
    let pairs = found.iter().zip(expected);
    pairs.fold(0.0, |worst: f64, (a, b)| worst.max((a - b).abs() / size))
}

/// Accelerations, those under torques and of held links, energies and powers.
fn agree<L: Strung, U: Strung>(loops: &L, unrolled: &U, text: &str) {
    let (n, order) = (unrolled.links(), order(loops, unrolled));
    let tree = PendulumTree::parse(text).expect("the compiler takes it");
    let in_order = |numbers: &[f64]| -> Vec<f64> { order.iter().map(|&at| numbers[at]).collect() };
    let mut random = Random::new(19);
    let (mut worst, mut energies, mut at_run_time) = (0.0_f64, 0.0_f64, 0.0_f64);
    for Configuration { time, theta, omega } in states(n, 100) {
        let torques = random.around_zero(n, 0.3);
        let [own_theta, own_omega, own_torques] =
            [&theta, &omega, &torques].map(|values| placed(&order, values));
        let [mut found, mut expected] = [(); 2].map(|()| vec![f64::NAN; n]);
        loops.accelerations_into(time, &own_theta, &own_omega, &mut found);
        unrolled.accelerations_into(time, &theta, &omega, &mut expected);
        worst = worst.max(apart(&in_order(&found), &expected));
        at_run_time = at_run_time.max(apart(&tree.accelerations(time, &theta, &omega), &expected));

        loops.accelerations_under_into(time, &own_theta, &own_omega, &own_torques, &mut found);
        unrolled.accelerations_under_into(time, &theta, &omega, &torques, &mut expected);
        worst = worst.max(apart(&in_order(&found), &expected));

        for set in 0..2 {
            let held = unrolled.prescribed_links(set).expect("two sets").len();
            let prescribed = random.around_zero(held, 50.0);
            let motion = |theta, omega, torques| PrescribedMotion {
                theta,
                omega,
                torques,
                prescribed: &prescribed,
            };
            let [mut taken, mut other] = [(); 2].map(|()| vec![f64::NAN; held]);
            let own = motion(&own_theta, &own_omega, &own_torques);
            loops.accelerations_prescribed_into(set, time, own, &mut found, &mut taken);
            let written = motion(&theta, &omega, &torques);
            unrolled.accelerations_prescribed_into(set, time, written, &mut expected, &mut other);
            worst = worst.max(apart(&in_order(&found), &expected));
            worst = worst.max(apart(&taken, &other));
        }
        for (own, other) in [
            (
                loops.kinetic_energy_of(&own_theta, &own_omega),
                unrolled.kinetic_energy_of(&theta, &omega),
            ),
            (
                loops.potential_energy_of(&own_theta),
                unrolled.potential_energy_of(&theta),
            ),
            (
                loops.loss(&own_theta, &own_omega),
                unrolled.loss(&theta, &omega),
            ),
        ] {
            assert!(own.is_finite());
            energies = energies.max((own - other).abs() / (1.0 + other.abs()));
        }
        assert!(loops.loss(&own_theta, &own_omega) < 0.0);
    }
    println!("{n} links: {worst:.1e} accelerations, {energies:.1e} energies and powers");
    assert!(worst < 1e-12, "{worst:e}");
    assert!(energies < 1e-13, "{energies:e}");
    assert!(at_run_time < 1e-12, "{at_run_time:e}");
}

#[test]
fn strung_generations_agree_with_code_written_out() {
    agree(&StrungLoops::new(), &StrungUnrolled::new(), STRUNG);
}

#[test]
fn strung_tables_agree_with_code_written_out() {
    agree(&StrungTable::new(), &TableUnrolled::new(), TABLE);
}

/// A rule by parameters, small enough for motions in builds without optimisation.
#[branched_pendulum(
    gravity = 9.80665,
    arm: generations(count = 3, branching = 2, shape = rod, mass = 0.2, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.8, code = loops),
    siblings(arm_2, at = (reach, 0.02), spring = stiffness, rest = reach / 4, friction = damping,
        repulsion = strength, exponent = 2),
    siblings(arm_3, at = reach / 2, spring = stiffness / 4),
    between(arm_2_1, arm_3_2_2, at = each(0.2, reach), repulsion = strength, exponent = 2),
    guy(arm_3_1_1, at = 0.1, to = (height, -height), spring = stiffness / 2, rest = 0.1,
        friction = damping),
    emit(energies, forces),
)]
struct ByParameters;

fn by_parameters(damping: f64) -> ByParameters<f64> {
    let parameters = ByParametersParameters {
        reach: 0.2,
        stiffness: 4.0,
        damping,
        strength: 1e-4,
        height: 0.3,
    };
    ByParameters::new(parameters).expect("values that the model takes")
}

/// The same numbers in the text, read at run time.
#[test]
fn parameters_are_those_of_numbers() {
    let text = "gravity = 9.80665,
        arm: generations(count = 3, branching = 2, shape = rod, mass = 0.2, length = 0.3,
            mass_ratio = 0.5, length_ratio = 0.8),
        siblings(arm_2, at = (0.2, 0.02), spring = 4, rest = 0.05, friction = 0.02,
            repulsion = 1e-4, exponent = 2),
        siblings(arm_3, at = 0.1, spring = 1),
        between(arm_2_1, arm_3_2_2, at = each(0.2, 0.2), repulsion = 1e-4, exponent = 2),
        guy(arm_3_1_1, at = 0.1, to = (0.3, -0.3), spring = 2, rest = 0.1, friction = 0.02)";
    let (model, tree) = (by_parameters(0.02), PendulumTree::parse(text));
    let tree = tree.expect("the compiler takes it");
    let (order, n) = (order(&model, &tree), model.links());
    for Configuration { theta, omega, .. } in states(n, 50) {
        let (own_theta, own_omega) = (placed(&order, &theta), placed(&order, &omega));
        let mut found = vec![0.0; n];
        model.accelerations_into(0.0, &own_theta, &own_omega, &mut found);
        let expected = placed(&order, &tree.accelerations(0.0, &theta, &omega));
        assert!(apart(&found, &expected) < 1e-12);
        for (own, other) in [
            (
                model.potential_energy(&own_theta),
                tree.potential_energy_of(&theta),
            ),
            (
                model.friction_power(&own_theta, &own_omega),
                tree.friction_power(&theta, &omega),
            ),
        ] {
            assert!((own - other).abs() < 1e-13 * (1.0 + other.abs()));
        }
    }
    let short = [0.0; 6];
    assert!(model.potential_energy(&short).is_nan());
    assert!(model.friction_power(&short, &[0.0; 7]).is_nan());
    assert!(model.friction_power(&[0.0; 7], &short).is_nan());
}

/// ∫P dt is what the energy loses over 10 s, the integral beside the motion as one more variable.
#[test]
fn the_energy_is_balanced_along_a_run() {
    const LINKS: usize = 7;
    for (damping, least) in [(0.0, 0.0), (0.02, 0.05)] {
        let model = by_parameters(damping);
        let ode = OdeFn::new(2 * LINKS + 1, |_: f64, state: &[f64], rates: &mut [f64]| {
            let (theta, omega) = (&state[..LINKS], &state[LINKS..2 * LINKS]);
            rates[..LINKS].copy_from_slice(omega);
            model.accelerations_into(0.0, theta, omega, &mut rates[LINKS..2 * LINKS]);
            rates[2 * LINKS] = model.friction_power(theta, omega);
        });
        let energy = |state: &[f64]| model.energy_of(&state[..LINKS], &state[LINKS..2 * LINKS]);
        let mut random = Random::new(8);
        let mut values = random.around_zero(LINKS, 1.0);
        values.extend(random.around_zero(LINKS, 2.0));
        values.push(0.0);
        let start = State::new(0.0, values);
        let method = Dop853::new(Options::with_tolerance(1e-14));
        let end = method.run(&ode, &start, 10.0);
        let end = end.expect("a smooth motion").state.values;
        let before = energy(&start.values);
        let lost = before - energy(&end);
        assert!(lost >= least * before - 1e-9, "{lost} of {before}");
        let error = lost + end[2 * LINKS];
        assert!(error.abs() < 1e-10, "{error:e} of {lost}");
    }
}
