//! Links whose motion is handed over in trees by rule, in blocks, on threads and in lanes.

use std::num::NonZeroUsize;

use branched_pendulum::Scalar;
use branched_pendulum::prelude::*;
use branched_pendulum::system::{Action, CastAction, PrescribedMotion, PrescribedOde};
use branched_pendulum_compiler_tests::random::Random;

use super::prescribed::{reactions_make_the_free_tree_move_so, sets};

/// Four generations, with all that acts in joints; units are parameters.
macro_rules! rule {
    ($name:ident, $code:ident) => {
        #[branched_pendulum(
            gravity = 9.80665,
            code = $code,
            tree: generations(count = 4, branching = 2, mass = m, com = 0.1, inertia = 1e-3,
                joint = (0.2, 0.01), mass_ratio = 0.6, length_ratio = 0.8, friction = 1e-3, spring = 0.02),
            drive(torque = 0.2 * cos(3 * t), x = 0.01 * cos(4 * t)),
            prescribed(tree_1),
            prescribed(tree_4_2_1_2, tree_2_1, tree_3_2_2),
        )]
        struct $name;
    };
}

rule!(WrittenOut, unrolled);
rule!(InLoops, loops);

fn written_out() -> WrittenOut<f64> {
    WrittenOut::new(WrittenOutParameters { m: 0.3 }).expect("a mass")
}

fn in_loops() -> InLoops<f64> {
    InLoops::new(InLoopsParameters { m: 0.3 }).expect("a mass")
}

const LINKS: usize = 15;

/// The place of each link of the loops in the tree that is written out.
fn places() -> [usize; LINKS] {
    std::array::from_fn(|link| {
        let model = in_loops();
        let name = model.link_name(link).expect("a link").to_string();
        let mut names = WrittenOut::LINK_NAMES.iter();
        names.position(|known| *known == name).expect("its name")
    })
}

#[test]
fn sets_name_the_same_links() {
    let (written, looped) = (written_out(), in_loops());
    assert_eq!(sets(&written).count(), 2);
    for (set, looped) in sets(&looped) {
        let written = written.prescribed_links(set).expect("it has that set");
        let links: Vec<usize> = looped.iter().map(|&link| places()[link]).collect();
        assert_eq!(written, links);
    }
    assert_eq!(looped.prescribed_links(2), None);
}

#[test]
fn trees_by_rule_move_as_written_out() {
    let (written, looped, places) = (written_out(), in_loops(), places());
    let in_order = |values: &[f64]| -> Vec<f64> { places.map(|place| values[place]).to_vec() };
    let mut random = Random::new(41);
    for (number, set) in sets(&looped) {
        for _ in 0..100 {
            let time = random.between(0.0, 9.0);
            let [theta, omega, torques] =
                [3.0, 9.0, 0.3].map(|size| random.around_zero(LINKS, size));
            let prescribed = random.around_zero(set.len(), 50.0);
            let motion = PrescribedMotion {
                theta: &theta,
                omega: &omega,
                torques: &torques,
                prescribed: &prescribed,
            };
            let mut expected = (vec![0.0; LINKS], vec![0.0; prescribed.len()]);
            written.accelerations_prescribed_into(
                number,
                time,
                motion,
                &mut expected.0,
                &mut expected.1,
            );
            let [theta, omega, torques] = [&theta, &omega, &torques].map(|values| in_order(values));
            let motion = PrescribedMotion {
                theta: &theta,
                omega: &omega,
                torques: &torques,
                prescribed: &prescribed,
            };
            let mut found = (vec![0.0; LINKS], vec![0.0; prescribed.len()]);
            looped.accelerations_prescribed_into(number, time, motion, &mut found.0, &mut found.1);
            let pairs = found.0.iter().zip(in_order(&expected.0));
            let pairs: Vec<_> = pairs.map(|(&a, b)| (a, b)).collect();
            let reactions = found.1.iter().copied().zip(expected.1);
            for pairs in [pairs, reactions.collect()] {
                let size = pairs.iter().fold(1.0_f64, |size, (a, _)| size.max(a.abs()));
                for (a, b) in pairs {
                    assert!((a - b).abs() < 1e-11 * size, "{set:?}: {a} {b}");
                }
            }
        }
    }
    reactions_make_the_free_tree_move_so(&looped, 20);
}

/// What acts between links is no part of the reactions.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 4, branching = 2, mass = 0.3, com = 0.1, inertia = 1e-3,
        joint = (0.2, 0.01), mass_ratio = 0.6, length_ratio = 0.8, code = loops),
    siblings(tree_4, spring = 0.05,
        friction(viscous = 1e-3, coulomb = 1e-2, static = 2e-2, stribeck = 0.4)),
    between(tree_1, tree_4_2_1_2, spring = 0.1, rest = 0.5),
    prescribed(tree_1),
    prescribed(tree_4_2_1_2, tree_2_1, tree_3_2_2),
)]
struct CoupledInLoops;

#[test]
fn links_are_held_among_coupled_ones() {
    reactions_make_the_free_tree_move_so(&CoupledInLoops::new(), 50);
}

/// In blocks, one above the other.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 17, branching = 2, mass = 0.1, com = 0.1, inertia = 1e-3,
        joint = 0.2, mass_ratio = 0.7, length_ratio = 0.9, friction = 1e-3, friction_ratio = 0.5),
    prescribed(tree_1, tree_2_2, tree_6_1_1_2_1_2, tree_17_1_1_1_1_1_1_1_1_1_1_1_1_1_1_1_1,
        tree_17_2_2_2_2_2_2_2_2_2_2_2_2_2_2_2_2, tree_13_1_2_1_2_1_2_1_2_1_2_1_2),
)]
struct Blocks;

#[test]
fn links_are_held_in_blocks_and_on_threads() {
    let mut model = Blocks::new();
    reactions_make_the_free_tree_move_so(&model, 2);
    let links = Blocks::LINKS;
    let set = model.prescribed_links(0).expect("it has that set").to_vec();
    let last = links - 1;
    assert_eq!((set[0], set[4]), (0, last));
    let mut random = Random::new(42);
    let [theta, omega, torques] = [3.0, 9.0, 0.1].map(|size| random.around_zero(links, size));
    let prescribed = random.around_zero(set.len(), 5.0);
    let motion = PrescribedMotion {
        theta: &theta,
        omega: &omega,
        torques: &torques,
        prescribed: &prescribed,
    };
    let mut on = |threads: usize| {
        model.set_threads(NonZeroUsize::new(threads).expect("some threads"));
        let (mut alpha, mut reactions) = (vec![0.0; links], vec![0.0; set.len()]);
        model.accelerations_prescribed_into(0, 0.0, motion, &mut alpha, &mut reactions);
        (alpha, reactions)
    };
    let bits = |(alpha, reactions): (Vec<f64>, Vec<f64>)| {
        let all = alpha.into_iter().chain(reactions);
        all.map(f64::to_bits).collect::<Vec<u64>>()
    };
    assert_eq!(bits(on(1)), bits(on(3)));
}

/// Swings links to and fro.
#[derive(Clone, Copy)]
struct Hands<T> {
    width: T,
    pace: T,
}

impl<T: Scalar> Action<T> for Hands<T> {
    #[inline(always)]
    fn act(&self, time: T, _: &[T], _: &[T], values: &mut [T]) {
        let (courses, _) = values.as_chunks_mut();
        for (link, course) in courses.iter_mut().enumerate() {
            let pace = self.pace * T::from_f64(1.0 + 0.2 * link as f64);
            let (sine, cosine) = (pace * time).sin_cos();
            let angle = self.width * sine;
            *course = [angle, self.width * pace * cosine, -(pace * pace * angle)];
        }
    }
}

impl<T: Scalar> CastAction<T> for Hands<T> {
    type Of<S: Scalar> = Hands<S>;

    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Hands<S> {
        Hands {
            width: convert(self.width),
            pace: convert(self.pace),
        }
    }
}

fn lanes_meet_the_plain_method<P>(model: impl Fn() -> P)
where
    P: Prescribed<f64> + Sync,
{
    let mut random = Random::new(43);
    let releases: Vec<_> = (0..11)
        .map(|i| {
            let hands = Hands {
                width: 0.05 * f64::from(i),
                pace: 2.0 + 0.1 * f64::from(i),
            };
            let held = PrescribedOde::of(model(), 1, hands).expect("it has that set");
            let mut values = random.around_zero(2 * model().links(), 0.4);
            let links = values.len() / 2;
            let mut courses = vec![[0.0; 3]; held.prescribed_links().len()];
            hands.act(0.0, &[], &[], courses.as_flattened_mut());
            for (&link, [angle, rate, _]) in held.prescribed_links().iter().zip(courses) {
                (values[link], values[links + link]) = (angle, rate);
            }
            (held, State::new(0.0, values))
        })
        .collect();
    let method = Dop853::new(Options::with_tolerance(1e-11));
    let lanes = Ensemble::new().integrate_models_in_lanes(&method, &releases, 1.0);
    for ((held, start), lane) in releases.iter().zip(lanes) {
        let plain = method.run(held, start, 1.0);
        let (lane, plain) = (lane.unwrap().state, plain.unwrap().state);
        for (lane, plain) in lane.values.iter().zip(&plain.values) {
            assert!((lane - plain).abs() < 1e-8, "{lane} {plain}");
        }
    }
}

#[test]
fn trajectories_of_held_trees_in_lanes() {
    lanes_meet_the_plain_method(written_out);
    lanes_meet_the_plain_method(in_loops);
    lanes_meet_the_plain_method(super::prescribed::Looped::<f64>::new);
}
