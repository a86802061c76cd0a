//! Models in loops, for many states: batches, trajectories in lanes, other scalars.

mod forced;

use branched_pendulum::Pendulum;
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::{Dual, InstructionSet, Lane, Lanes};
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::promised;

/// One subtree of 127 links.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 7, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7),
)]
struct Binary;

/// Above them there are links too.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 9, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.8),
)]
struct Deep;

/// A tree with all forces, in three subtrees.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 6, branching = 3, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.4, length_ratio = 0.8, friction = 1e-4, drag = 1e-4, spring = 0.01),
)]
struct Ternary;

/// The root's children are leaves.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 2, branching = 150, shape = rod, mass = 0.12, length = 0.3,
        friction = 1e-3),
)]
struct Star;

/// One link a generation, more than a subtree holds.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 200, branching = 1, shape = rod, mass = 0.02, length = 0.05,
        code = loops, spring = 0.02),
)]
struct Chain;

/// A tree in a table, 104 links.
#[branched_pendulum(
    gravity = 9.80665,
    code = loops,
    trunk: rod(mass = 0.12, length = 0.3) [
        left: generations(count = 6, branching = 2, shape = rod, mass = 0.12, length = 0.3,
            mass_ratio = 0.5, length_ratio = 0.7),
        right: generations(count = 4, branching = 3, shape = rod, mass = 0.12, length = 0.3,
            mass_ratio = 0.5, length_ratio = 0.7),
    ],
)]
struct Bush;

/// A tree in a table, with forces.
#[branched_pendulum(
    gravity = 9.80665,
    code = loops,
    trunk(mass = 0.2, com = -0.03, inertia = 1e-3, joint = -0.2, friction = 1e-4) [
        arm: rod(mass = 0.1, length = 0.25, spring = 0.01) [
            hand(mass = 0.04, com = 0.1, inertia = 0, drag = 2e-4),
            fork: generations(count = 3, branching = 2, shape = rod, mass = 0.02, length = 0.1,
                length_ratio = 0.8, friction = 1e-5),
        ] * 2,
        tail: point(mass = 0.03, length = 0.3, spring = 0.02),
    ],
)]
struct Sprung;

/// Springs and friction between siblings, in generations that are parts of subtrees and in one
/// above them.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 9, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.8),
    siblings(tree_9, spring = 1e-4, friction(viscous = 1e-6, coulomb = 1e-5)),
    siblings(tree_2, spring = 0.1, friction = 1e-4),
)]
struct Siblings;

/// The same in a table.
#[branched_pendulum(
    gravity = 9.80665,
    code = loops,
    trunk(mass = 0.2, com = -0.03, inertia = 1e-3, joint = -0.2, friction = 1e-4) [
        arm: rod(mass = 0.1, length = 0.25, spring = 0.01) [
            hand(mass = 0.04, com = 0.1, inertia = 1e-4, drag = 2e-4),
            fork: generations(count = 3, branching = 2, shape = rod, mass = 0.02, length = 0.1,
                length_ratio = 0.8),
        ] * 3,
        tail: point(mass = 0.03, length = 0.3),
    ],
    siblings(arm, spring = 0.1, friction = 1e-3),
    between(tail, hand_2, spring = 0.05, rest = 0.3, friction(quadratic = 1e-4)),
)]
struct Guyed;

/// Lines between points of siblings in the same generations, of cousins, and to the ground.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 9, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.8),
    siblings(tree_9, at = 0.02, spring = 1e-2, rest = 0.01, friction = 1e-5),
    siblings(tree_2, at = (0.2, 0.01), spring = 2, repulsion = 1e-3, exponent = 3),
    between(tree_3_1_1, tree_4_2_1_2, at = each(0.1, 0.2), spring = 1, rest = 0.2, friction = 1e-3),
    guy(tree_2_2, at = 0.2, to = (0.3, 0.2), spring = 3, rest = 0.1),
)]
struct Strung;

/// The same in a table.
#[branched_pendulum(
    gravity = 9.80665,
    code = loops,
    trunk(mass = 0.2, com = -0.03, inertia = 1e-3, joint = -0.2, friction = 1e-4) [
        arm: rod(mass = 0.1, length = 0.25, spring = 0.01) [
            hand(mass = 0.04, com = 0.1, inertia = 1e-4, drag = 2e-4),
            fork: generations(count = 3, branching = 2, shape = rod, mass = 0.02, length = 0.1,
                length_ratio = 0.8),
        ] * 3,
        tail: point(mass = 0.03, length = 0.3),
    ],
    siblings(arm, at = 0.2, spring = 3, rest = 0.1, friction = 1e-2),
    between(tail, hand_2, at = each(0.3, 0.1), repulsion = 1e-3, exponent = 2),
    guy(tail, at = 0.1, to = (0.3, -0.2), spring = 3),
)]
struct Moored;

/// Time at which driven trees are evaluated.
const TIME: f64 = 0.7;

/// Numbers of states: below, at and above the lanes of every register.
const COUNTS: [usize; 9] = [0, 1, 7, 8, 9, 15, 16, 17, 100];

fn columns<T: Lane>(random: &mut Random, links: usize, count: usize, size: f64) -> Vec<Vec<T>> {
    let mut column = || {
        let numbers = random.around_zero(count, size);
        numbers.into_iter().map(T::from_f64).collect()
    };
    (0..links).map(|_| column()).collect()
}

fn state<T: Copy>(columns: &[Vec<T>], state: usize) -> Vec<T> {
    columns.iter().map(|column| column[state]).collect()
}

/// One state alone: by the model's own loops, which fuse where the machine can; by
/// those of the model in numbers that never do for the build's own instructions.
fn alone<T: Lane, P: Pendulum<T>>(
    model: &P,
    plain: &P::Of<Lanes<T, 1>>,
    set: InstructionSet,
    theta: &[T],
    omega: &[T],
) -> Vec<T> {
    let (time, zero) = (T::from_f64(TIME), T::from_f64(0.0));
    if set > InstructionSet::Build {
        let mut alpha = vec![zero; theta.len()];
        model.accelerations_into(time, theta, omega, &mut alpha);
        return alpha;
    }
    let lanes = |numbers: &[T]| -> Vec<Lanes<T, 1>> {
        numbers.iter().map(|&number| Lanes([number])).collect()
    };
    let mut alpha = lanes(&vec![zero; theta.len()]);
    plain.accelerations_into(Lanes([time]), &lanes(theta), &lanes(omega), &mut alpha);
    alpha.into_iter().map(|Lanes([number])| number).collect()
}

fn batch_agrees<T: Lane, P: Pendulum<T>>(model: &P, bits: fn(&T) -> u64) {
    let (links, zero) = (model.links(), T::from_f64(0.0));
    let plain = model.cast(|number| Lanes([number]));
    let mut random = Random::new(11);
    for set in InstructionSet::ALL {
        if set > InstructionSet::widest() {
            if set == InstructionSet::Avx512 {
                println!("skipped: no {set}");
            } else {
                promised::or_skip(&set.to_string());
            }
            continue;
        }
        let mut batch = Batch::new(model).no_wider_than(set);
        for count in COUNTS {
            let mut theta: Vec<Vec<T>> = columns(&mut random, links, count, 3.0);
            let omega: Vec<Vec<T>> = columns(&mut random, links, count, 9.0);
            if count > 4 {
                // Beyond the common range of sine and cosine, and none at all.
                theta[1][2] = T::from_f64(1e9);
                theta[links - 1][4] = T::from_f64(f64::NAN);
            }
            let mut alpha = vec![vec![zero; count]; links];
            batch
                .accelerations(T::from_f64(TIME), &theta, &omega, &mut alpha)
                .unwrap();
            for i in 0..count {
                let own = state(&alpha, i);
                let expected = alone(model, &plain, set, &state(&theta, i), &state(&omega, i));
                assert_eq!(i == 4 && count > 4, !own[0].is_finite());
                if own[0].is_finite() {
                    let (own, expected): (Vec<_>, Vec<_>) = (
                        own.iter().map(bits).collect(),
                        expected.iter().map(bits).collect(),
                    );
                    assert_eq!(own, expected, "{links} links, state {i} of {count}, {set}");
                }
            }
        }
    }
}

macro_rules! batches_agree {
    ($($model:ident),*; f32 $($narrow:ident),*) => {
        $(batch_agrees::<f64, _>(&$model::<f64>::new(), |x| x.to_bits());)*
        $(batch_agrees::<f32, _>(&$narrow::<f32>::default(), |x| u64::from(x.to_bits()));)*
    };
}

#[test]
fn batches_of_generations_have_the_bits_of_single_states() {
    batches_agree!(Binary, Deep, Ternary, Star, Chain, Siblings, Strung;
        f32 Deep, Ternary, Siblings, Strung);
}

#[test]
fn batches_of_tables_have_the_bits_of_single_states() {
    batches_agree!(Bush, Sprung, Guyed, Moored; f32 Bush, Sprung, Guyed, Moored);
}

/// Trajectories in lanes end where the plain method does, but for rounding, and where
/// they end does not depend on the company.
fn lanes_meet_the_plain_method<P: Pendulum<f64> + Sync>(model: &P) {
    let mut random = Random::new(3);
    let starts: Vec<State<f64>> = (0..19)
        .map(|_| State {
            time: 0.0,
            values: random.around_zero(2 * model.links(), 0.4),
        })
        .collect();
    let (method, end) = (Dop853::new(Options::with_tolerance(1e-9)), 0.3);
    let lanes = Ensemble::new().integrate_in_lanes(&method, &AbsoluteAngles(model), &starts, end);
    let few =
        Ensemble::new().integrate_in_lanes(&method, &AbsoluteAngles(model), &starts[13..], end);
    assert_eq!(lanes[13..], few);
    let plain = Ensemble::new().integrate(&method, &AbsoluteAngles(model), &starts, end);
    for ((start, lane), plain) in starts.iter().zip(lanes).zip(plain) {
        let (lane, plain) = (lane.unwrap(), plain.unwrap());
        assert!(lane.report.accepted.abs_diff(plain.report.accepted) <= 2);
        let pairs = lane.state.values.iter().zip(&plain.state.values);
        let apart = pairs.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
        assert!(apart < 1e-6, "{apart:e}");
        let moved = lane.state.values.iter().zip(&start.values);
        let moved = moved.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
        assert!(moved > 0.1, "{moved:e}");
    }
}

#[test]
fn trajectories_of_large_trees_in_lanes() {
    lanes_meet_the_plain_method(&Binary::<f64>::new());
    lanes_meet_the_plain_method(&Bush::<f64>::new());
    lanes_meet_the_plain_method(&Guyed::<f64>::new());
}

/// ∂ω̇/∂θ of one link by dual numbers of a cast model, against differences.
fn derivatives_agree<P: Pendulum<f64>>(model: &P, link: usize) {
    let links = model.links();
    let mut random = Random::new(5);
    let (theta, omega) = (
        random.around_zero(links, 3.0),
        random.around_zero(links, 9.0),
    );
    let duals = model.cast(Dual::<f64, 1>::constant);
    let constant = |numbers: &[f64]| -> Vec<Dual<f64, 1>> {
        numbers
            .iter()
            .map(|&number| Dual::constant(number))
            .collect()
    };
    let mut varied = constant(&theta);
    varied[link] = Dual::variable(theta[link], 0);
    let omega_duals = constant(&omega);
    let mut alpha = constant(&omega);
    let time = Dual::constant(TIME);
    duals.evaluate(
        time,
        |i| varied[i],
        |i| omega_duals[i],
        |i, value| alpha[i] = value,
    );
    let shifted = |step: f64| {
        let mut theta = theta.clone();
        theta[link] += step;
        let mut alpha = vec![0.0; links];
        model.accelerations_into(TIME, &theta, &omega, &mut alpha);
        alpha
    };
    let (forwards, backwards, here) = (shifted(1e-5), shifted(-1e-5), shifted(0.0));
    let size = alpha
        .iter()
        .fold(0.0, |size: f64, alpha| size.max(alpha.tangents[0].abs()));
    let reach = here
        .iter()
        .fold(0.0, |size: f64, alpha| size.max(alpha.abs()));
    assert!(size > 0.0);
    for i in 0..links {
        let difference = (forwards[i] - backwards[i]) / 2e-5;
        assert!((alpha[i].value - here[i]).abs() < 1e-10 * reach);
        assert!(
            (alpha[i].tangents[0] - difference).abs() < 1e-6 * size,
            "{i}"
        );
    }
}

#[test]
fn dual_numbers_of_cast_models() {
    derivatives_agree(&Binary::<f64>::new(), 5);
    derivatives_agree(&Ternary::<f64>::new(), 5);
    derivatives_agree(&Sprung::<f64>::new(), 2);
    derivatives_agree(&Siblings::<f64>::new(), 300);
    derivatives_agree(&Guyed::<f64>::new(), 2);
}
