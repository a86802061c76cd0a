//! Torques on the root and moving pivots.

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Double;
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_compiler_tests::source;

use super::{Powered, agree, array, balance, pair, powered};

pair!(TurnedLoops, TurnedUnrolled, TURNED:
    tree: generations(count = 5, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7),
    drive(torque = 0.4 * cos(3 * t))
);
powered!(TurnedLoops, TurnedUnrolled);
pair!(ShakenLoops, ShakenUnrolled, SHAKEN:
    tree: generations(count = 4, branching = 3, mass = 0.2, com = 0.05, inertia = 1e-4,
        joint = 0.2, mass_ratio = 0.4, length_ratio = 0.8, friction = 2e-4, drag = 1e-4,
        friction_ratio = 0.8, drag_ratio = 2, spring = 3e-3, spring_ratio = 0.5, rest = 0.3,
        rest_ratio = -0.7),
    drive(x = 0.2 * sin(5 * t), y = 0.1 * cos(4 * t))
);
powered!(ShakenLoops, ShakenUnrolled, braked);
pair!(ShortLoops, ShortUnrolled, SHORT:
    tree: generations(count = 2, branching = 5, shape = disc, mass = 0.3, length = 0.2,
        radius = 0.05, friction = 1e-3),
    drive(torque = 0.4 * cos(3 * t), x = 0.2 * sin(5 * t), y = 0.1 * cos(4 * t))
);
powered!(ShortLoops, ShortUnrolled, braked);
pair!(ChainLoops, ChainUnrolled, CHAIN:
    tree: generations(count = 9, branching = 1, shape = point, mass = 0.2, length = 0.1,
        drag = 1e-4),
    drive(torque = 0.4 * cos(3 * t), x = 0.2 * sin(5 * t), y = 0.1 * cos(4 * t))
);
powered!(ChainLoops, ChainUnrolled, braked);
pair!(BushTable, BushUnrolled, BUSH:
    trunk: rod(mass = 0.3, length = 0.4) [
        twig: point(mass = 0.05, length = 0.2),
        bough: rod(mass = 0.1, length = 0.3) [
            stick: rod(mass = 0.03, length = 0.1) * 3,
            leaf: disc(mass = 0.01, length = 0.05, radius = 0.02),
        ],
    ],
    drive(torque = 0.4 * cos(3 * t), x = 0.2 * sin(5 * t), y = 0.1 * cos(4 * t))
);
powered!(BushTable, BushUnrolled);
pair!(SprungTable, SprungUnrolled, SPRUNG:
    trunk(mass = 0.2, com = -0.03, inertia = 1e-3, joint = -0.2, friction = 1e-4) [
        arm: rod(mass = 0.1, length = 0.25, spring = 0.01, rest = 0.2) [
            hand(mass = 0.04, com = 0.1, inertia = 0, drag = 2e-4),
            fork: generations(count = 3, branching = 2, shape = rod, mass = 0.02, length = 0.1,
                length_ratio = 0.8, friction = 1e-5),
        ] * 2,
        tail: point(mass = 0.03, length = 0.3, spring = 0.02, rest = -0.1),
    ],
    drive(x = 0.2 * sin(5 * t), y = 0.1 * cos(4 * t))
);
powered!(SprungTable, SprungUnrolled, braked);

#[test]
fn driven_loops_agree_with_code_written_out_and_with_the_oracle() {
    let (loops, unrolled) = (TurnedLoops::<f64>::new(), TurnedUnrolled::<f64>::new());
    agree(&loops, &unrolled, TURNED, [true, false]);
    balance(&loops, &unrolled);
    let (loops, unrolled) = (ShakenLoops::<f64>::new(), ShakenUnrolled::<f64>::new());
    agree(&loops, &unrolled, SHAKEN, [false, true]);
    balance(&loops, &unrolled);
    let (loops, unrolled) = (ShortLoops::<f64>::new(), ShortUnrolled::<f64>::new());
    agree(&loops, &unrolled, SHORT, [true, true]);
    balance(&loops, &unrolled);
    let (loops, unrolled) = (ChainLoops::<f64>::new(), ChainUnrolled::<f64>::new());
    agree(&loops, &unrolled, CHAIN, [true, true]);
    balance(&loops, &unrolled);
}

#[test]
fn driven_tables_agree_with_code_written_out_and_with_the_oracle() {
    let (table, unrolled) = (BushTable::<f64>::new(), BushUnrolled::<f64>::new());
    agree(&table, &unrolled, BUSH, [true, true]);
    balance(&table, &unrolled);
    let (table, unrolled) = (SprungTable::<f64>::new(), SprungUnrolled::<f64>::new());
    agree(&table, &unrolled, SPRUNG, [false, true]);
    balance(&table, &unrolled);
}

/// 32,767 links, taken apart: the root is not in the parts.
#[branched_pendulum(
    gravity = g,
    tree: generations(count = 15, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.9),
    drive(torque = links * cos(bodies * t), x = 0.1 * sin(per_lever * t)),
    emit(energies),
)]
struct Many;

#[test]
fn a_large_driven_tree_is_the_same_in_other_scalars_and_on_more_threads() {
    let n = Many::LINKS;
    assert_eq!(n, 32_767);
    let mut model = Many::new(ManyParameters {
        g: 9.8125,
        links: 2.0,
        bodies: 3.0,
        per_lever: 7.0,
    })
    .unwrap();
    let mut random = Random::new(3);
    let (theta, omega) = (random.around_zero(n, 3.0), random.around_zero(n, 2.0));
    let mut alpha = vec![f64::NAN; n];
    model.accelerations_into(0.5, &theta, &omega, &mut alpha);
    model.set_threads(std::num::NonZeroUsize::new(2).unwrap());
    let mut threaded = vec![f64::NAN; n];
    model.accelerations_into(0.5, &theta, &omega, &mut threaded);
    assert!(alpha.iter().zip(&threaded).all(|(a, b)| a == b));

    let exact = ManyParameters {
        g: 9.8125,
        links: 2.0,
        bodies: 3.0,
        per_lever: 7.0,
    };
    let wide = |numbers: &[f64]| -> Vec<Double> {
        numbers.iter().copied().map(Double::from_f64).collect()
    };
    let mut doubles = vec![Double::from_f64(0.0); n];
    Many::<Double>::from_parameters_unchecked(ManyParameters {
        g: Double::from_f64(exact.g),
        links: Double::from_f64(exact.links),
        bodies: Double::from_f64(exact.bodies),
        per_lever: Double::from_f64(exact.per_lever),
    })
    .accelerations_into(
        Double::from_f64(0.5),
        &wide(&theta),
        &wide(&omega),
        &mut doubles,
    );
    let largest = alpha.iter().fold(0.0, |max: f64, x| max.max(x.abs()));
    for (alpha, double) in alpha.iter().zip(&doubles) {
        assert!((alpha - double.to_f64()).abs() < 1e-10 * largest);
    }
    // The drive reaches the root.
    let mut later = vec![f64::NAN; n];
    model.accelerations_into(0.75, &theta, &omega, &mut later);
    assert!((later[0] - alpha[0]).abs() > 0.1);
    assert_eq!(model.drive(0.0), [-0.0, 0.0, 2.0]);
}

/// Each demand adds its own code and nothing else.
#[test]
fn loops_have_only_what_their_scene_asks_for() {
    let code = |more: &str| {
        let text = format!(
            "#[branched_pendulum(gravity = 9.8, code = loops, emit(energies), {more})] \
             struct Sample;"
        );
        source::stages_of(&text).tokens().to_string()
    };
    let straight = "a: rod(mass = 1, length = 1) [ b: rod(mass = 1, length = 1) ]";
    let bent = "a(mass = 1, com = (0.5, 0.1), inertia = 1, joint = 1) [
        b(mass = 1, com = (0.5, 0.2), inertia = 1, joint = 1) [ c: rod(mass = 1, length = 1) ] ]";
    let attached = "a: rod(mass = 1, length = 1) [ b: rod(mass = 1, length = 1), \
                    c: rod(mass = 1, length = 1, at = 0.5) ]";
    let words = [
        "time : T",
        "drive",
        "root_drive",
        "TORQUE : bool = true",
        "lateral_moment",
        "JOINTS : bool = true",
        "type Sums < T : :: branched_pendulum :: Scalar > = [T ; 9]",
    ];
    let drive = "drive(torque = cos(t), x = sin(t))";
    let cases = [
        (straight.to_owned(), vec![]),
        (format!("{straight}, {drive}"), vec![0, 1, 2, 3]),
        (
            format!("{straight}, drive(torque = cos(t))"),
            vec![0, 1, 2, 3],
        ),
        (format!("{straight}, drive(y = t^2)"), vec![0, 1, 2]),
        (bent.to_owned(), vec![4]),
        (attached.to_owned(), vec![6]),
        (straight.replace("= 1) ]", "= 1, friction = 1) ]"), vec![5]),
    ];
    for (scene, expected) in cases {
        // `_time` is of every model.
        let code = code(&scene).replace("_time : T", "");
        let found = (0..words.len()).filter(|&word| code.contains(words[word]));
        assert_eq!(found.collect::<Vec<usize>>(), expected, "{scene}");
    }
}
