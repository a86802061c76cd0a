//! Links whose motion is handed over, against the free tree under the torques that they
//! say to take.

use branched_pendulum::prelude::*;
use branched_pendulum::system::{PrescribedMotion, PrescribedOde, UnderTorques};
use branched_pendulum_compiler_tests::random::Random;

/// By one of the solves, or in a loop.
macro_rules! branch {
    ($name:ident, $how:ident = $value:ident) => {
        #[branched_pendulum(
                    gravity = 9.80665,
                    $how = $value,
                    limb: rod(mass = 0.4, length = 0.5, friction = 2e-2) [
                        bough(mass = 0.1, com = (0.12, 0.01), inertia = 1e-3, at = (0.3, -0.02),
                            joint = (0.25, 0.03), spring = 0.1, friction = 1e-3) [
                            twig: rod(mass = 0.03, length = 0.2, drag = 1e-4) * 2
                        ],
                        shoot(mass = 0.05, com = 0.1, inertia = 1e-4),
                    ],
                    drive(torque = 0.2 * cos(3 * t), y = 0.01 * cos(4 * t)),
                    prescribed(limb),
                    prescribed(twig_2, bough),
                    prescribed(shoot, limb, bough, twig_1, twig_2),
                    emit(energies),
                )]
        pub(super) struct $name;
    };
}

branch!(Factorized, solve = factorization);
branch!(Recursive, solve = recursion);
branch!(Looped, code = loops);

const LINKS: usize = 5;

/// Sets of links with their numbers.
pub(super) fn sets<P: Prescribed<f64>>(model: &P) -> impl Iterator<Item = (usize, &[usize])> {
    (0..).map_while(|number| Some((number, model.prescribed_links(number)?)))
}

fn names_of_second<P: Prescribed<f64>>(model: &P) -> Vec<String> {
    let (names, links) = (model.link_names(), model.prescribed_links(1));
    let links = links.unwrap_or_default().iter();
    links.map(|&link| names[link].clone()).collect()
}

/// The free tree under Q and the reactions has the accelerations that the prescribed one
/// has, the given ones among them.
pub(super) fn reactions_make_the_free_tree_move_so<P: Prescribed<f64>>(model: &P, states: usize) {
    let mut random = Random::new(2);
    for (number, set) in sets(model) {
        for _ in 0..states {
            let time = random.between(0.0, 9.0);
            let theta = random.around_zero(model.links(), 3.0);
            let omega = random.around_zero(model.links(), 9.0);
            let torques = random.around_zero(model.links(), 0.3);
            let prescribed = random.around_zero(set.len(), 50.0);
            let motion = PrescribedMotion {
                theta: &theta,
                omega: &omega,
                torques: &torques,
                prescribed: &prescribed,
            };
            let (mut alpha, mut reactions) = (vec![0.0; model.links()], vec![0.0; set.len()]);
            model.accelerations_prescribed_into(number, time, motion, &mut alpha, &mut reactions);
            let mut all = torques.clone();
            for ((&link, reaction), given) in set.iter().zip(&reactions).zip(&prescribed) {
                assert_eq!(alpha[link], *given);
                all[link] += reaction;
            }
            let mut free = vec![0.0; model.links()];
            model.accelerations_under_into(time, &theta, &omega, &all, &mut free);
            let size = free.iter().fold(1.0_f64, |size, a| size.max(a.abs()));
            for (alpha, free) in alpha.iter().zip(free) {
                assert!(
                    (alpha - free).abs() < 1e-10 * size,
                    "{set:?}: {alpha} {free}"
                );
            }
            // No answer for what does not fit.
            let motion = PrescribedMotion {
                prescribed: &[],
                ..motion
            };
            model.accelerations_prescribed_into(number, time, motion, &mut alpha, &mut reactions);
            assert!(alpha.iter().chain(&reactions).all(|value| value.is_nan()));
        }
    }
}

#[test]
fn the_free_tree_moves_so_under_the_reactions() {
    reactions_make_the_free_tree_move_so(&Factorized::new(), 100);
    reactions_make_the_free_tree_move_so(&Recursive::new(), 100);
    reactions_make_the_free_tree_move_so(&Looped::new(), 100);
    assert_eq!(sets(&Factorized::new()).count(), 3);
    for names in [
        names_of_second(&Factorized::new()),
        names_of_second(&Looped::new()),
    ] {
        assert_eq!(names, ["twig_2", "bough"]);
    }
}

macro_rules! agree {
    ($one:expr, $other:expr) => {{
        let (one, other) = ($one, $other);
        let mut random = Random::new(12);
        for _ in 0..100 {
            let [theta, omega, torques] = [3.0, 9.0, 0.3].map(|size| random.array(-size, size));
            let given: [f64; 2] = random.array(-50.0, 50.0);
            let (alpha, reactions) = one
                .accelerations_prescribed_twig_2_and_bough(0.3, &theta, &omega, &torques, &given);
            let (same, same_reactions) = other
                .accelerations_prescribed_twig_2_and_bough(0.3, &theta, &omega, &torques, &given);
            let size = alpha
                .iter()
                .fold(1.0_f64, |size: f64, a: &f64| size.max(a.abs()));
            for (a, b) in alpha.iter().zip(same) {
                assert!((a - b).abs() < 1e-11 * size);
            }
            for (a, b) in reactions.iter().zip(same_reactions) {
                assert!((a - b).abs() < 1e-11 * size);
            }
        }
    }};
}

#[test]
fn both_solves_and_the_loop_agree() {
    agree!(Factorized::new(), Recursive::new());
    agree!(Recursive::new(), Looped::new());
}

/// Swings a link to and fro from where it hangs.
fn hand(time: f64, course: &mut [[f64; 3]]) {
    let (width, pace) = (0.4, 2.5);
    let (sine, cosine) = (pace * time).sin_cos();
    course[0] = [
        width * sine,
        pace * width * cosine,
        -pace * pace * width * sine,
    ];
}

fn start() -> State<f64> {
    let [angle, rate, _] = {
        let mut course = [[0.0; 3]];
        hand(0.0, &mut course);
        course[0]
    };
    State::from_positions_and_velocities(
        0.0,
        &[angle, 0.3, -0.2, 0.5, 0.1],
        &[rate, 0.5, 0.0, 1.0, -1.0],
    )
    .expect("as many")
}

/// Trajectory of the free tree under the reaction, and the energy that the hand gives.
macro_rules! trajectories_and_the_work_of_the_hand {
    ($model:expr) => {{
        let model = $model;
        let held = PrescribedOde::new(&model, 0, hand).expect("it has that set");
        assert!(PrescribedOde::new(&model, 3, hand).is_none());
        let method = Dop853::new(Options::with_tolerance(1e-12));
        let end = method.run(&held, &start(), 4.0).expect("it goes on").state;
        let mut course = [[0.0; 3]];
        hand(end.time, &mut course);
        assert!((end.values[0] - course[0][0]).abs() < 1e-9);
        assert!((end.values[LINKS] - course[0][1]).abs() < 1e-9);
        // The torque of the hand by the state at hand, on the free tree.
        let pushed = UnderTorques::new(
            &model,
            |time: f64, theta: &[f64], omega: &[f64], torques: &mut [f64]| {
                let mut course = [[0.0; 3]];
                hand(time, &mut course);
                fn arrays(values: &[f64]) -> &[f64; LINKS] {
                    values.try_into().expect("all links")
                }
                let (_, [reaction]) = model.accelerations_prescribed_limb(
                    time,
                    arrays(theta),
                    arrays(omega),
                    &[0.0; LINKS],
                    &[course[0][2]],
                );
                torques.fill(0.0);
                torques[0] = reaction;
            },
        );
        let same = method
            .run(&pushed, &start(), 4.0)
            .expect("it goes on")
            .state;
        for (held, pushed) in end.values.iter().zip(&same.values) {
            assert!((held - pushed).abs() < 1e-9, "{held} {pushed}");
        }
        // Work of the hand, the drive and friction.
        let work = branched_pendulum::system::OdeFn::new(
            2 * LINKS + 1,
            |time: f64, state: &[f64], rates: &mut [f64]| {
                let state = &state[..2 * LINKS];
                held.rates(time, state, &mut rates[..2 * LINKS]);
                let arrays = |from: usize| -> [f64; LINKS] {
                    state[from..from + LINKS].try_into().expect("all links")
                };
                let (theta, omega) = (arrays(0), arrays(LINKS));
                let mut reaction = [0.0];
                held.reactions_into(time, state, &mut reaction);
                rates[2 * LINKS] = reaction[0] * omega[0]
                    + model.drive_power(time, &theta, &omega)
                    + model.friction_power(&omega);
            },
        );
        let mut with_work = start();
        with_work.values.push(0.0);
        let method = Dop853::new(Options::with_tolerance(1e-13));
        let end = method
            .run(&work, &with_work, 10.0)
            .expect("it goes on")
            .state;
        let energy = |values: &[f64]| {
            let arrays = |from: usize| -> [f64; LINKS] {
                values[from..from + LINKS].try_into().expect("all links")
            };
            model.kinetic_energy(&arrays(0), &arrays(LINKS)) + model.potential_energy(&arrays(0))
        };
        let (before, after) = (energy(&with_work.values), energy(&end.values));
        let error = after - before - end.values[2 * LINKS];
        assert!(error.abs() < 1e-10 * before.max(after), "{error:e}");
    }};
}

#[test]
fn trajectories_and_the_work_of_the_hand() {
    trajectories_and_the_work_of_the_hand!(Factorized::new());
    trajectories_and_the_work_of_the_hand!(Looped::new());
}

#[branched_pendulum(
    gravity = 9.80665,
    beam: rod(mass = 0.4, length = 0.5) [
        stick: rod(mass = 0.1, length = 0.3, drag = 1e-3)
    ],
    prescribed(beam),
)]
struct Held;

#[branched_pendulum(gravity = 9.80665, stick: rod(mass = 0.1, length = 0.3, drag = 1e-3))]
struct Alone;

/// Links that hang from one at rest hang from the ground; the hand carries the weights.
#[test]
fn a_link_held_at_rest_is_ground() {
    let (held, alone) = (Held::new(), Alone::new());
    let (theta, omega) = ([0.7, 0.4], [0.0, 3.0]);
    let (alpha, [torque]) = held.accelerations_prescribed_beam(&theta, &omega, &[0.0; 2], &[0.0]);
    let expected = alone.accelerations(&[0.4], &[3.0])[0];
    assert_eq!(alpha[0], 0.0);
    assert!((alpha[1] - expected).abs() < 1e-13 * expected.abs());
    // Both hanging still.
    let (_, [still]) =
        held.accelerations_prescribed_beam(&[0.7, 0.0], &[0.0; 2], &[0.0; 2], &[0.0]);
    let weights = 9.80665 * (0.4 * 0.25 + 0.1 * 0.5) * 0.7_f64.sin();
    assert!((still - weights).abs() < 1e-14);
    assert!(torque.is_finite() && torque != still);
}

/// A motion of a link that stands for two is that of both, and takes the torque of both.
#[branched_pendulum(
    gravity = 9.80665,
    beam: rod(mass = 0.4, length = 0.5) [
        stick: rod(mass = 0.1, length = 0.3) * 2
    ],
    in_phase(stick),
    prescribed(stick),
)]
struct InPhase;

#[branched_pendulum(
    gravity = 9.80665,
    code = loops,
    beam: rod(mass = 0.4, length = 0.5) [
        stick: rod(mass = 0.1, length = 0.3) * 2
    ],
    in_phase(stick),
    prescribed(stick),
)]
struct InPhaseLooped;

#[branched_pendulum(
    gravity = 9.80665,
    beam: rod(mass = 0.4, length = 0.5) [
        stick: rod(mass = 0.1, length = 0.3) * 2
    ],
    prescribed(stick_1, stick_2),
)]
struct Whole;

#[test]
fn copies_in_phase_are_held_together() {
    let (theta, omega) = ([0.7, 0.4], [1.0, 3.0]);
    let (alpha, [torque]) =
        InPhase::new().accelerations_prescribed_stick(&theta, &omega, &[0.0; 2], &[5.0]);
    let (looped, [same]) =
        InPhaseLooped::new().accelerations_prescribed_stick(&theta, &omega, &[0.0; 2], &[5.0]);
    let [one, other] = [
        InPhase::new().accelerations(&theta, &omega),
        InPhaseLooped::new().accelerations(&theta, &omega),
    ];
    assert!((0..2).all(|link| (one[link] - other[link]).abs() < 1e-12));
    let error = (alpha[0] - looped[0]).abs().max((torque - same).abs());
    assert!(error < 1e-12, "{alpha:?} {looped:?} {torque} {same}");
    let (whole, [one, other]) = Whole::new().accelerations_prescribed_stick_1_and_stick_2(
        &[0.7, 0.4, 0.4],
        &[1.0, 3.0, 3.0],
        &[0.0; 3],
        &[5.0; 2],
    );
    assert!((alpha[0] - whole[0]).abs() < 1e-12);
    assert!((torque - (one + other)).abs() < 1e-13);
}
