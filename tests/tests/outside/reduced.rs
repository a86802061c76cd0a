//! Torques on whole trees and on the smaller ones that stand for them.

use branched_pendulum::prelude::*;
use branched_pendulum::system::UnderTorques;

/// One tree, whole and reduced.
macro_rules! grove {
    ($name:ident $(, $entry:ident($($inside:tt)*))*) => {
        #[branched_pendulum(
            gravity = 9.80665,
            limb: rod(mass = 0.4, length = 0.5, friction = 2e-2) [
                bough: rod(mass = 0.1, length = 0.3, friction = 1e-3) [
                    twig: rod(mass = 0.03, length = 0.2, drag = 1e-4) * 2
                ] * 3,
                hook(mass = 0.05, com = 0.1, inertia = 1e-4),
            ],
            emit(forces),
            $($entry($($inside)*)),*
        )]
        struct $name;
    };
}

grove!(Whole);
grove!(Reduced, in_phase(all), locked(hook, 0.7));
grove!(Stiff, locked(hook, 0.7));

/// Torques on all links of the whole tree, the same on copies.
fn on_whole(time: f64) -> [f64; 11] {
    let wave = |pace: f64| 0.02 * (pace * time).sin();
    let mut torques = [0.0; 11];
    for (link, name) in Whole::LINK_NAMES.iter().enumerate() {
        torques[link] = match name.split('_').next() {
            Some("limb") => 5.0 * wave(3.0),
            Some("bough") => wave(4.0),
            Some("twig") => 0.3 * wave(5.0),
            _ => wave(2.0),
        };
    }
    torques
}

#[test]
fn a_reduced_tree_moves_as_the_one_whose_joint_is_locked() {
    let (reduced, stiff) = (Reduced::new(), Stiff::new());
    let on_reduced = |time: f64, _: &[f64], _: &[f64], torques: &mut [f64]| {
        Reduced::WHOLE
            .torques(&on_whole(time), torques)
            .expect("all links");
    };
    let on_stiff = |time: f64, _: &[f64], _: &[f64], torques: &mut [f64]| {
        Stiff::WHOLE
            .torques(&on_whole(time), torques)
            .expect("all links");
    };
    let method = Dop853::new(Options::with_tolerance(1e-13));
    let mut ends = Vec::new();
    let small = State::from_positions_and_velocities(0.0, &[0.4, -0.3, 0.6], &[0.5, 1.0, -1.0]);
    let end = method
        .run(
            &UnderTorques::new(&reduced, on_reduced),
            &small.expect("as many"),
            5.0,
        )
        .expect("it goes on")
        .state;
    let mut whole = [0.0; 11];
    Reduced::WHOLE
        .angles(end.positions(), &mut whole)
        .expect("all links");
    ends.push(whole);
    let spread = |values: [f64; 3]| -> [f64; 10] {
        let names = Stiff::LINK_NAMES;
        std::array::from_fn(|link| match names[link].split('_').next() {
            Some("limb") => values[0],
            Some("bough") => values[1],
            _ => values[2],
        })
    };
    let large = State::from_positions_and_velocities(
        0.0,
        &spread([0.4, -0.3, 0.6]),
        &spread([0.5, 1.0, -1.0]),
    );
    let end = method
        .run(
            &UnderTorques::new(&stiff, on_stiff),
            &large.expect("as many"),
            5.0,
        )
        .expect("it goes on")
        .state;
    Stiff::WHOLE
        .angles(end.positions(), &mut whole)
        .expect("all links");
    ends.push(whole);
    for (reduced, whole) in ends[0].iter().zip(ends[1]) {
        assert!((reduced - whole).abs() < 1e-10, "{reduced} {whole}");
    }
}

/// On a link that stands for several, the torque is the sum of theirs.
#[test]
fn accelerations_are_those_of_the_whole_tree() {
    let (reduced, whole) = (Reduced::new(), Stiff::new());
    let torques = on_whole(0.4);
    let (mut of_reduced, mut of_whole) = ([0.0; 3], [0.0; 10]);
    Reduced::WHOLE
        .torques(&torques, &mut of_reduced)
        .expect("all links");
    Stiff::WHOLE
        .torques(&torques, &mut of_whole)
        .expect("all links");
    let boughs: f64 = 3.0 * torques[1];
    assert!((of_reduced[1] - boughs).abs() < 1e-16);
    let alpha = reduced.accelerations_under(&[0.3, 0.5, -0.2], &[1.0, 2.0, -3.0], &of_reduced);
    let names = Stiff::LINK_NAMES;
    let kind = |link: usize| match names[link].split('_').next() {
        Some("limb") => 0,
        Some("bough") => 1,
        _ => 2,
    };
    let theta: [f64; 10] = std::array::from_fn(|link| [0.3, 0.5, -0.2][kind(link)]);
    let omega: [f64; 10] = std::array::from_fn(|link| [1.0, 2.0, -3.0][kind(link)]);
    let expected = whole.accelerations_under(&theta, &omega, &of_whole);
    for (link, expected) in expected.iter().enumerate() {
        assert!((alpha[kind(link)] - expected).abs() < 1e-12 * expected.abs().max(1.0));
    }
}
