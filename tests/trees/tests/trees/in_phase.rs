//! Motions in phase and small differences beside them, against the equations of the whole tree
//! and their derivatives.

use branched_pendulum::analysis::variational::{Copies, Linearised, linearised};
use branched_pendulum::prelude::*;
use branched_pendulum::system::{Positions, Workspace};
use branched_pendulum_trees::{InPhaseTree, PendulumTree, TreeError};

use super::plain::Numbers;

/// Trees with links of them that are copies: all that acts in a tree, and copies of each shape.
const TREES: [(&str, &[usize]); 14] = [
    // Straight rods, two copies and three.
    (
        "trunk: rod(mass = 0.4, length = 0.3) [twig: rod(mass = 0.1, length = 0.2) * 2]",
        &[1, 2],
    ),
    (
        "trunk: rod(mass = 0.4, length = 0.3) [twig: rod(mass = 0.1, length = 0.2) * 3]",
        &[1, 2, 3],
    ),
    // Subtrees, with copies in copies that move each in its own way.
    (
        "trunk: rod(mass = 0.4, length = 0.3) [
            arm: rod(mass = 0.2, length = 0.2) [hand: rod(mass = 0.1, length = 0.1) * 2] * 2,
            stone: rod(mass = 0.3, length = 0.1)
        ]",
        &[1, 4],
    ),
    // Copies below a link that is none, and deeper ones alone.
    (
        "trunk: rod(mass = 0.4, length = 0.3) [neck: rod(mass = 0.2, length = 0.2) [
            arm: rod(mass = 0.2, length = 0.2) [hand: rod(mass = 0.1, length = 0.1)] * 2
        ], stone: rod(mass = 0.3, length = 0.1)]",
        &[2, 4],
    ),
    // Two of four.
    (
        "trunk: rod(mass = 0.4, length = 0.3) [twig: rod(mass = 0.1, length = 0.2) * 4]",
        &[2, 4],
    ),
    // Springs, drag and viscous friction, links that are bent, pivots aside.
    (
        "trunk: rod(mass = 0.4, length = 0.3, friction = 1e-3, spring = 0.2, rest = 0.1) [
            arm(mass = 0.2, com = (0.1, 0.03), inertia = 1e-3, joint = (0.05, -0.02),
                spring = 0.05, rest = 0.3, drag = 2e-3) [
                hand: rod(mass = 0.1, length = 0.15, friction = 2e-3)
            ] * 2
        ]",
        &[1, 3],
    ),
    // Friction that is not viscous.
    (
        "trunk: rod(mass = 0.4, length = 0.3, friction(coulomb = 1e-3)) [
            arm: rod(mass = 0.2, length = 0.2, friction(coulomb = 2e-3, static = 3e-3, stribeck = 0.6, width = 0.5), \
                drag(quadratic = 1e-3)) [
                hand: rod(mass = 0.1, length = 0.15, friction(quadratic = 2e-3, width = 0.3))
            ] * 3
        ]",
        &[1, 3, 5],
    ),
    // A drive of the pivot and of the root.
    (
        "trunk: rod(mass = 0.4, length = 0.3) [twig: rod(mass = 0.1, length = 0.2) * 2],
        drive(torque = 0.3 * cos(2 * t), x = 0.1 * sin(3 * t), y = 0.05 * cos(5 * t))",
        &[1, 2],
    ),
    // Springs and friction between copies, and between copies and other links.
    (
        "trunk: rod(mass = 0.4, length = 0.3) [
            arm: rod(mass = 0.2, length = 0.2) [hand: rod(mass = 0.1, length = 0.1)] * 3
        ],
        siblings(arm, spring = 0.2, friction(viscous = 1e-3, coulomb = 1e-2, width = 0.4)),
        between(trunk, hand_1, spring = 0.1, rest = 0.2, friction = 1e-3),
        between(trunk, hand_2, spring = 0.1, rest = 0.2, friction = 1e-3),
        between(trunk, hand_3, spring = 0.1, rest = 0.2, friction = 1e-3)",
        &[1, 3, 5],
    ),
    // Straight springs: a guy, lines from a link to each copy, with repulsions, and one between
    // copies that is as long as they are apart.
    (
        "trunk: rod(mass = 0.4, length = 0.3) [
            arm: rod(mass = 0.2, length = 0.2) [hand: rod(mass = 0.1, length = 0.1)] * 2
        ],
        guy(trunk, at = 0.2, to = (0.4, 0.1), spring = 3, rest = 0.2, friction = 0.1),
        between(trunk, hand_1, at = each(0.05, 0.1), spring = 2, rest = 0.1, friction = 0.05,
            repulsion = 1e-3, exponent = 3),
        between(trunk, hand_2, at = each(0.05, 0.1), spring = 2, rest = 0.1, friction = 0.05,
            repulsion = 1e-3, exponent = 3),
        siblings(arm, at = 0.15, spring = 4)",
        &[1, 3],
    ),
    // Copies of unlike masses, which move alike all the same, with a spring between them.
    (
        "trunk: rod(mass = 0.4, length = 0.3) [
            light: rod(mass = 0.1, length = 0.2) [end: rod(mass = 0.05, length = 0.1)],
            heavy: rod(mass = 0.3, length = 0.2) [tip: rod(mass = 0.15, length = 0.1)]
        ],
        between(light, heavy, spring = 0.3, friction = 1e-2)",
        &[1, 3],
    ),
    // Copies on the axes of links that are not in phase.
    (
        "trunk: rod(mass = 0.4, length = 0.3) [
            wheel(mass = 0.2, com = 0.02, inertia = 1e-3, joint = 0) [
                spoke: rod(mass = 0.1, length = 0.2)
            ] * 2
        ]",
        &[2, 4],
    ),
    // By rule: links of one generation stand side by side.
    (
        "code = loops, tree: generations(count = 3, branching = 2, shape = rod, mass = 0.2, length = 0.2)",
        &[1, 2],
    ),
    // Hanging upwards.
    (
        "gravity = -9.80665, trunk: rod(mass = 0.4, length = 0.3, spring = 9) [
            twig: rod(mass = 0.1, length = 0.2, spring = 2) * 2
        ]",
        &[1, 2],
    ),
];

fn parents(tree: &PendulumTree) -> Vec<Option<usize>> {
    let links = 0..tree.names().len();
    let parents = links.map(|link| tree.properties_of(link).unwrap().parent);
    parents.collect()
}

fn parse(text: &str) -> PendulumTree {
    let text = match text.contains("gravity") {
        true => text.to_owned(),
        false => format!("gravity = 9.80665, {text}"),
    };
    PendulumTree::parse(&text).unwrap_or_else(|error| panic!("{error}"))
}

/// Accelerations in phase and of the differences, by the derivative of the whole tree's equations
/// along the differences.
fn of_the_whole(
    tree: &PendulumTree,
    copies: &Copies,
    in_phase: &InPhaseTree,
    time: f64,
    [angles, rates]: [&[f64]; 2],
) -> Vec<f64> {
    let (own, links) = (in_phase.links(), tree.names().len());
    let sector = copies.first_difference();
    let whole = |values: &[f64]| {
        let mut deviation = vec![0.0; links];
        for (coordinate, difference) in sector.coordinates().iter().zip(&values[own..]) {
            for &(link, weight) in coordinate.weights() {
                deviation[link] = weight * difference;
            }
        }
        (in_phase.whole(&values[..own]), deviation)
    };
    let ((theta, delta), (omega, delta_rate)) = (whole(angles), whole(rates));
    let (mut found, mut changes) = (vec![0.0; 2 * links], vec![0.0; 2 * links]);
    linearised(AbsoluteAngles(tree)).linearised_rates(
        &mut Workspace::new(),
        time,
        &[theta, omega].concat(),
        &[delta, delta_rate].concat(),
        &mut found,
        &mut changes,
    );
    let motion = in_phase.of_whole(&found[links..].iter().map(rounded).collect::<Vec<_>>());
    let differences = sector.coordinates().iter();
    let differences = differences.map(|own| own.of(&changes[links..]));
    motion.unwrap().into_iter().chain(differences).collect()
}

/// A number without its last digits, in which copies differ.
fn rounded(value: &f64) -> f64 {
    let unit = value.abs().max(1e-3).log2().floor().exp2() * 1e-11;
    (value / unit).round() * unit
}

#[test]
fn rates_are_those_of_the_whole_tree() {
    let mut numbers = Numbers(3);
    for (text, links) in TREES {
        let tree = parse(text);
        let copies = Copies::of_links(&parents(&tree), &[links]).expect(text);
        let in_phase = tree.in_phase(&copies).expect(text);
        let in_phase = in_phase.with_differences(&copies).expect(text);
        let half = in_phase.dimension() / 2;
        assert_eq!(
            half - in_phase.links(),
            copies.first_difference().coordinates().len()
        );
        for _ in 0..20 {
            let mut state = |range: f64| -> Vec<f64> {
                (0..half).map(|_| numbers.between(-range, range)).collect()
            };
            let (angles, rates) = (state(3.0), state(5.0));
            let expected = of_the_whole(&tree, &copies, &in_phase, 0.7, [&angles, &rates]);
            let mut found = vec![0.0; 2 * half];
            in_phase.rates(0.7, &[&angles[..], &rates].concat(), &mut found);
            assert_eq!(found[..half], rates);
            let size = expected
                .iter()
                .fold(1.0_f64, |size, value| size.max(value.abs()));
            for (found, expected) in found[half..].iter().zip(&expected) {
                let apart = (found - expected).abs();
                assert!(apart < 1e-10 * size, "{found} {expected} of {size}: {text}");
            }
        }
    }
}

/// All copies of a tree in phase, with the differences of the first two.
fn with_differences(tree: &PendulumTree) -> InPhaseTree {
    let copies = tree.all_copies();
    let in_phase = tree.in_phase(&copies).unwrap();
    in_phase.with_differences(&copies).unwrap()
}

/// Differences of a start that is not in phase are not small ones beside it.
#[test]
fn a_start_out_of_phase_has_no_state_in_phase() {
    let tree = parse(TREES[0].0);
    let in_phase = with_differences(&tree);
    let of = |angles: &[f64]| in_phase.start(&State::at_rest(0.0, angles));
    assert_eq!(of(&[0.3, 0.1, 0.2]), None);
    assert_eq!(of(&[0.3, 0.1]), None);
    assert_eq!(of(&[]), None);
    let start = of(&[0.3, 0.1, 0.1]).unwrap();
    assert_eq!(start.values, [0.3, 0.1, 1.0, 0.0, 0.0, 0.0]);
}

#[test]
fn links_that_do_not_move_alike_are_refused() {
    let unequal = parse(
        "trunk: rod(mass = 0.4, length = 0.3) [
            twig: rod(mass = 0.1, length = each(0.2, 0.21)) * 2
        ]",
    );
    let refused = unequal.in_phase(&unequal.all_copies()).unwrap_err();
    assert_eq!(refused, TreeError::NotInPhase);
    assert!(
        refused.to_string().contains("do not stay in phase"),
        "{refused}"
    );
    // One of them has a spring to the trunk's parent, and a chain has no copies.
    let held = parse(
        "trunk: rod(mass = 0.4, length = 0.3) [neck: rod(mass = 0.2, length = 0.2) [
            twig: rod(mass = 0.1, length = 0.2) * 2
        ]], between(trunk, twig_1, spring = 0.1)",
    );
    let copies = Copies::of_links(&parents(&held), &[&[2, 3]]).unwrap();
    assert_eq!(held.in_phase(&copies).unwrap_err(), TreeError::NotInPhase);
    let chain = parse("rod: rod(mass = 0.1, length = 0.2)");
    assert!(chain.all_copies().groups().is_empty());
    assert!(chain.in_phase(&chain.all_copies()).is_err());
}

/// All copies of a nested tree in phase, with the difference of the outer ones: that of the whole
/// tree whose hands are in phase.
#[test]
fn copies_of_copies_are_one_link() {
    let tree = parse(TREES[2].0);
    let all = with_differences(&tree);
    // Trunk, arm, hand, stone; differences of arm and hand.
    assert_eq!((all.links(), all.dimension()), (4, 12));
    let arms = Copies::of_links(&parents(&tree), &[&[1, 4]]).unwrap();
    let arms = tree
        .in_phase(&arms)
        .unwrap()
        .with_differences(&arms)
        .unwrap();
    // Trunk, arm, two hands, stone; differences of arm and hands.
    assert_eq!((arms.links(), arms.dimension()), (5, 16));
    let [angles, rates] = [
        [0.7, -0.4, 1.2, 0.3, 0.5, -0.8],
        [1.0, 2.0, -1.5, 0.4, 0.9, -0.6],
    ];
    let with_both_hands = |[trunk, arm, hand, stone, outer, inner]: [f64; 6]| {
        [trunk, arm, hand, hand, stone, outer, inner, inner]
    };
    let (mut found, mut expected) = ([0.0; 12], [0.0; 16]);
    all.rates(0.0, &[angles, rates].concat(), &mut found);
    let state = [angles, rates].map(with_both_hands).concat();
    arms.rates(0.0, &state, &mut expected);
    let found = with_both_hands(found[6..].try_into().unwrap());
    for (found, expected) in found.iter().zip(&expected[8..]) {
        assert!(
            (found - expected).abs() < 1e-11 * (1.0 + expected.abs()),
            "{found} {expected}"
        );
    }
}

/// The difference of two hands of one arm, all else in phase, is that beside the arms and other hands
/// each in its own way; two hands of different arms move these, and are refused.
#[test]
fn inner_copies_differ_beside_all_others_in_phase() {
    let tree = parse(TREES[2].0);
    let of = |pair: &[usize]| Copies::of_links(&parents(&tree), &[pair]).unwrap();
    let in_phase = tree.in_phase(&tree.all_copies()).unwrap();
    let hands = of(&[2, 3]);
    let all = in_phase.with_differences(&hands).unwrap();
    let pair = tree.in_phase(&hands).unwrap();
    let pair = pair.with_differences(&hands).unwrap();
    assert_eq!((all.dimension(), pair.dimension()), (10, 16));
    let whole = State::new(
        0.0,
        [
            [0.7, -0.4, 1.2, 1.2, -0.4, 1.2, 1.2, 0.3],
            [1.0, 2.0, -1.5, -1.5, 2.0, -1.5, -1.5, 0.4],
        ]
        .concat(),
    );
    let difference = [&all, &pair].map(|system| {
        let state = system.start(&whole).unwrap();
        let mut rates = vec![0.0; state.values.len()];
        system.rates(0.0, &state.values, &mut rates);
        rates[rates.len() - 1]
    });
    let [found, expected] = difference;
    assert!(
        (found - expected).abs() < 1e-12 * expected.abs(),
        "{found} {expected}"
    );
    for refused in [&[2, 5][..], &[7, 1]] {
        let copies = Copies::new(vec![refused.to_vec()]);
        let error = in_phase.with_differences(&copies).unwrap_err();
        assert_eq!(error, TreeError::NotInPhase);
    }
}

/// Lanes move as each state alone, but for rounding.
#[test]
fn lanes_move_as_one_state_does() {
    let tree = parse(TREES[8].0);
    let system = with_differences(&tree);
    let starts: Vec<State<f64>> = (0..9)
        .map(|number| {
            let angle = 0.2 * f64::from(number);
            let arms = [angle, 0.1, 0.3, 0.1, 0.3, 0.1, 0.3];
            system.start(&State::at_rest(0.0, &arms)).unwrap()
        })
        .collect();
    let method = Rk4::new(0.01);
    let ensemble = Ensemble::new();
    let lanes = ensemble.integrate_in_lanes(&method, &system, &starts, 1.0);
    let alone = ensemble.integrate(&method, &system, &starts, 1.0);
    for (lane, alone) in lanes.iter().zip(&alone) {
        let [lane, alone] = [lane, alone].map(|end| &end.as_ref().unwrap().state.values);
        for (lane, alone) in lane.iter().zip(alone) {
            assert!((lane - alone).abs() < 1e-12, "{lane} {alone}");
        }
    }

    // Two twigs of three that are in phase are another system than two others.
    let tree = parse(TREES[1].0);
    let pairs = [[1, 2], [2, 3]].map(|pair| {
        let copies = Copies::of_links(&parents(&tree), &[&pair]).unwrap();
        let system = tree.in_phase(&copies).unwrap();
        (system, State::at_rest(0.0, &[0.3, 0.1, 0.2]))
    });
    let ends = ensemble.integrate_models_in_lanes(&method, &pairs, 0.1);
    assert!(ends[0].is_ok() && ends[1].is_err(), "{ends:?}");
}
