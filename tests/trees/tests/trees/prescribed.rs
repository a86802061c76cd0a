//! Links of a described tree whose motion is given.

use branched_pendulum::ensemble::Ensemble;
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Scalar;
use branched_pendulum::system::{Action, CastAction, PrescribedMotion, PrescribedOde, Workspace};
use branched_pendulum_trees::{PendulumTree, TreeDescription};

use super::mechanics::{BENT, OMEGA, THETA, bent, near};

/// The same links, some of them held.
fn held(sets: &str) -> PendulumTree {
    let description = TreeDescription::parse(&format!("{BENT}, {sets}")).unwrap();
    description.tree(&[("m", 0.07)]).unwrap()
}

/// Under the reactions as torques from outside the free tree moves as the one that is held;
/// links that are not held change nothing in the free tree.
#[test]
fn reactions_make_the_free_tree_move_so() {
    let (free, held) = (
        bent(),
        held("prescribed(bough), prescribed(twig_2, limb, shoot)"),
    );
    let place = |name: &str| free.names().iter().position(|known| known == name);
    let named =
        |names: &[&str]| -> Vec<usize> { names.iter().filter_map(|name| place(name)).collect() };
    let sets = [named(&["bough"]), named(&["twig_2", "limb", "shoot"])];
    for (number, set) in sets.iter().enumerate() {
        assert_eq!(held.prescribed_links(number), Some(set.as_slice()));
    }
    assert_eq!(held.prescribed_links(2), None);
    let (time, torques) = (0.7, [0.03, -0.02, 0.01, 0.0, 0.005]);
    let same = held.accelerations(time, &THETA, &OMEGA);
    assert_eq!(same, free.accelerations(time, &THETA, &OMEGA));
    for (number, set) in sets.iter().enumerate() {
        let prescribed = &[7.0, -40.0, 3.0][..set.len()];
        let motion = PrescribedMotion {
            theta: &THETA,
            omega: &OMEGA,
            torques: &torques,
            prescribed,
        };
        let (mut alpha, mut reactions) = (vec![0.0; 5], vec![0.0; set.len()]);
        let workspace = &mut Workspace::new();
        held.accelerations_prescribed_with(
            workspace,
            number,
            time,
            motion,
            &mut alpha,
            &mut reactions,
        );
        let mut all = torques;
        for ((&link, &given), reaction) in set.iter().zip(prescribed).zip(&reactions) {
            assert_eq!(alpha[link], given);
            all[link] += reaction;
        }
        let mut answer = vec![0.0; 5];
        free.accelerations_under_with(workspace, time, &THETA, &OMEGA, &all, &mut answer);
        for (own, other) in alpha.iter().zip(&answer) {
            near(*own, *other, 1e-11);
        }
    }
}

/// A tree of one link that a torque drives: m L²/3 α = τ − m g L/2 sin θ + R.
#[test]
fn a_single_link_is_held_against_its_drive() {
    let text =
        "gravity = 9.81, rod: rod(mass = 0.3, length = 0.4), drive(torque = 0.1), prescribed(rod)";
    let tree = PendulumTree::parse(text).unwrap();
    let motion = PrescribedMotion {
        theta: &[0.5],
        omega: &[1.0],
        torques: &[0.02],
        prescribed: &[2.0],
    };
    let (mut alpha, mut reaction) = ([0.0], [0.0]);
    tree.accelerations_prescribed_into(0, 0.0, motion, &mut alpha, &mut reaction);
    let weight = 0.3 * 9.81 * 0.2 * 0.5_f64.sin();
    near(
        reaction[0],
        0.3 * 0.4 * 0.4 / 3.0 * 2.0 + weight - 0.12,
        1e-14,
    );
}

/// Lanes go along with one trajectory; of sets that are not there and of other lengths there
/// are no numbers.
#[test]
fn held_trees_in_lanes() {
    let tree = held("prescribed(bough)");
    let start = State::from_positions_and_velocities(0.0, &THETA, &OMEGA).unwrap();
    let course = Swing {
        from: THETA[1],
        rate: OMEGA[1],
    };
    assert!(PrescribedOde::of(tree.clone(), 1, course).is_none());
    assert!(PrescribedOde::of(bent(), 0, course).is_none());
    let system = PrescribedOde::of(tree.clone(), 0, course).unwrap();
    let method = Dop853::new(Options::with_tolerance(1e-11));
    let lanes =
        Ensemble::new().integrate_in_lanes(&method, &system, std::slice::from_ref(&start), 0.8);
    let plain = method.run(&system, &start, 0.8);
    let (lane, plain) = (lanes[0].as_ref().unwrap(), plain.unwrap());
    for (own, other) in lane.state.values.iter().zip(&plain.state.values) {
        near(*own, *other, 1e-8);
    }
    let mut reactions = [0.0; 2];
    system.reactions_into(0.0, &start.values, &mut reactions);
    assert!(reactions.iter().all(|reaction| reaction.is_nan()));
    system.reactions_into(0.0, &start.values, &mut reactions[..1]);
    assert!(reactions[0].is_finite());
}

/// An angle that grows evenly.
#[derive(Clone, Copy, Debug)]
struct Swing<T> {
    from: T,
    rate: T,
}

impl<T: Scalar> Action<T> for Swing<T> {
    fn act(&self, time: T, _: &[T], _: &[T], values: &mut [T]) {
        for own in values.as_chunks_mut().0 {
            *own = [self.rate * time + self.from, self.rate, T::from_f64(0.0)];
        }
    }
}

impl<T: Scalar> CastAction<T> for Swing<T> {
    type Of<S: Scalar> = Swing<S>;

    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Swing<S> {
        Swing {
            from: convert(self.from),
            rate: convert(self.rate),
        }
    }
}
