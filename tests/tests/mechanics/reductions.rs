//! Reduced trees against the whole ones that they stand for.

use std::f64::consts::PI;

use branched_pendulum::prelude::*;
use branched_pendulum::{WholeTree, system::WholeLengthError};
use branched_pendulum_compiler_tests::random::Random;

/// One tree: whole, or with some of its joints and copies held together.
macro_rules! crown {
    ($name:ident $(, $reduction:ident($($inside:tt)*))*) => {
        #[branched_pendulum(
            gravity = 9.80665,
            trunk: rod(mass = 0.4, length = 0.5, friction = 1e-3)[
                arm(mass = 0.2, com = (0.1, 0.02), inertia = 1.5e-3, joint = (0.25, -0.03),
                    friction = 2e-4, drag = 3e-4)[
                    hand: rod(mass = 0.05, length = 0.12, spring = 4e-3, friction = 1e-5) * 3,
                    finger(mass = 0.03, com = (0.04, 0.01), inertia = 2e-5, joint = 0.08,
                        at = (0.2, 0.04), drag = 1e-6)[
                        nail: rod(mass = 0.01, length = 0.03, drag = 1e-6, spring = 2e-3,
                            rest = 0.7)
                    ] * 2
                ] * 2,
                tail: disc(mass = 0.1, length = 0.1, radius = 0.03, at = 0.3)
            ],
            drive(torque = 0.05 * sin(3 * t), x = 0.01 * cos(5 * t)),
            emit(energies, momenta),
            $($reduction($($inside)*)),*
        )]
        struct $name;
    };
}

crown!(Crown);
crown!(ArmsInPhase, in_phase(arm));
crown!(HandsInPhase, in_phase(hand));
crown!(AllInPhase, in_phase(all));
crown!(FingersLocked, locked(finger, 0.4), locked(tail, -0.2));
crown!(FingersLockedInPhase, in_phase(finger), locked(finger, 0.4));

/// Number of links of [`Crown`].
const WHOLE: usize = 18;

/// Copies on copies, in whose joints nothing is lost: reductions of reductions.
macro_rules! rack {
    ($name:ident $(, $reduction:ident($($inside:tt)*))*) => {
        #[branched_pendulum(
            gravity = 9.80665,
            trunk: rod(mass = 0.4, length = 0.5, friction = 1e-3)[
                arm(mass = 0.2, com = (0.1, 0.02), inertia = 1.5e-3, joint = (0.25, -0.03),
                    drag = 3e-4)[
                    hand: rod(mass = 0.05, length = 0.12, spring = 4e-3, friction = 1e-5) * 3,
                    finger(mass = 0.03, com = (0.04, 0.01), inertia = 2e-5, joint = 0.08,
                        at = (0.2, 0.04), drag = 1e-6)[
                        nail: rod(mass = 0.01, length = 0.03, spring = 2e-3, rest = 0.7) * 2
                    ] * 2
                ] * 2,
                tail: disc(mass = 0.1, length = 0.1, radius = 0.03, at = 0.3)
            ],
            drive(torque = 0.05 * sin(3 * t), x = 0.01 * cos(5 * t)),
            emit(energies, momenta),
            $($reduction($($inside)*)),*
        )]
        struct $name;
    };
}

rack!(Rack);
rack!(NailsInPhaseOnArms, in_phase(arm), in_phase(nail));
rack!(
    FingersLockedInArms,
    locked(arm, 0.3),
    locked(finger, 0.4),
    locked(tail, -0.2)
);
rack!(
    FingersInPhaseInArms,
    in_phase(finger),
    locked(arm, 0.3),
    locked(finger, 0.4)
);
rack!(
    NailsInPhaseInArms,
    in_phase(nail),
    locked(arm, 0.3),
    locked(finger, 0.4)
);

/// Number of links of [`Rack`].
const OF_RACK: usize = 22;

/// Generations on each of several copies.
macro_rules! bush {
    ($name:ident $(, $reduction:ident($($inside:tt)*))*) => {
        #[branched_pendulum(
            gravity = 9.80665,
            trunk: rod(mass = 0.4, length = 0.5, friction = 1e-3)[
                limb: rod(mass = 0.2, length = 0.3, drag = 2e-4)[
                    bough: generations(count = 2, branching = 2, shape = rod, mass = 0.1,
                        length = 0.2, mass_ratio = 0.4, length_ratio = 0.8, friction = 1e-5)
                ] * 3
            ],
            drive(torque = 0.05 * sin(3 * t), x = 0.01 * cos(5 * t)),
            emit(energies, momenta),
            $($reduction($($inside)*)),*
        )]
        struct $name;
    };
}

bush!(Bush);
bush!(BoughsInPhase, in_phase(bough));
bush!(LimbsInPhase, in_phase(limb));
bush!(BushInPhase, in_phase(all));
bush!(LimbsLocked, locked(limb, -0.6));
bush!(BoughsInPhaseOnLimbs, in_phase(bough), locked(limb, -0.6));

/// A reduced model's state and that of the whole tree.
struct Expanded {
    theta: Vec<f64>,
    omega: Vec<f64>,
    whole_theta: Vec<f64>,
    whole_omega: Vec<f64>,
}

fn expanded(tree: WholeTree, links: usize, random: &mut Random) -> Expanded {
    let theta = random.around_zero(links, PI);
    let omega = random.around_zero(links, 10.0);
    let [mut whole_theta, mut whole_omega] = [(); 2].map(|()| vec![0.0; tree.links()]);
    tree.angles(&theta, &mut whole_theta).expect("all links");
    tree.velocities(&omega, &mut whole_omega)
        .expect("all links");
    Expanded {
        theta,
        omega,
        whole_theta,
        whole_omega,
    }
}

/// The largest difference between two lists, of the largest value.
fn apart(left: &[f64], right: &[f64]) -> f64 {
    assert_eq!(left.len(), right.len());
    let largest = left.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let pairs = left.iter().zip(right);
    pairs.fold(0.0_f64, |most, (a, b)| most.max((a - b).abs())) / largest
}

/// Kinetic energy, differences of potential energy and momenta are those of the whole
/// tree.
fn same_lagrangian<M: Energy<f64>, W: Energy<f64>>(
    (model, momenta): (&M, impl Fn(&[f64], &[f64]) -> Vec<f64>),
    (whole, whole_momenta): (&W, impl Fn(&[f64], &[f64]) -> Vec<f64>),
    tree: WholeTree,
) {
    let mut random = Random::new(5);
    let links = model.links();
    let mut zero = None;
    for _ in 0..200 {
        let state = expanded(tree, links, &mut random);
        let (theta, omega) = (&state.theta[..], &state.omega[..]);
        let kinetic = model.kinetic_energy_of(theta, omega);
        let expected = whole.kinetic_energy_of(&state.whole_theta, &state.whole_omega);
        assert!((kinetic - expected).abs() <= 1e-13 * expected);

        let potential = model.potential_energy_of(theta);
        let offset = potential - whole.potential_energy_of(&state.whole_theta);
        let first = *zero.get_or_insert(offset);
        assert!(
            (offset - first).abs() <= 1e-13 * potential,
            "{offset} {first}"
        );

        // p = ∂K/∂ω, and the angles of several links move with one.
        let parts = whole_momenta(&state.whole_theta, &state.whole_omega);
        let mut sums = vec![0.0; links];
        let mut part = parts.iter();
        tree.for_each(|link, _| sums[link] += part.next().expect("all links"));
        assert!(apart(&momenta(theta, omega), &sums) < 1e-13);
    }
}

macro_rules! momenta {
    ($model:expr) => {
        |theta: &[f64], omega: &[f64]| {
            let at = |values: &[f64]| values.try_into().expect("all links");
            $model.momenta(&at(theta), &at(omega)).to_vec()
        }
    };
}

macro_rules! check_lagrangian {
    ($whole:ident: $($name:ident),* $(,)?) => {
        let whole = $whole::new();
        $({
            let model = $name::new();
            let of_whole = (&whole, momenta!(whole));
            same_lagrangian((&model, momenta!(model)), of_whole, $name::WHOLE);
        })*
    };
}

#[test]
fn energies_and_momenta_are_those_of_the_whole_tree() {
    check_lagrangian!(
        Crown: ArmsInPhase,
        HandsInPhase,
        AllInPhase,
        FingersLocked,
        FingersLockedInPhase,
    );
    check_lagrangian!(
        Rack: NailsInPhaseOnArms,
        FingersLockedInArms,
        FingersInPhaseInArms,
        NailsInPhaseInArms,
    );
    check_lagrangian!(
        Bush: BoughsInPhase,
        LimbsInPhase,
        BushInPhase,
        LimbsLocked,
        BoughsInPhaseOnLimbs,
    );
}

/// Friction, drag, springs, the torque and the motion of the root's pivot included.
#[test]
fn copies_in_phase_stay_so() {
    fn check<M: Pendulum<f64>, W: Pendulum<f64>>(model: &M, whole: &W, tree: WholeTree) {
        let mut random = Random::new(6);
        for _ in 0..200 {
            let state = expanded(tree, model.links(), &mut random);
            let mut alpha = vec![0.0; model.links()];
            model.accelerations_into(0.3, &state.theta, &state.omega, &mut alpha);
            let mut found = vec![0.0; whole.links()];
            tree.velocities(&alpha, &mut found).expect("all links");
            let mut expected = vec![0.0; whole.links()];
            let (theta, omega) = (&state.whole_theta, &state.whole_omega);
            whole.accelerations_into(0.3, theta, omega, &mut expected);
            assert!(
                apart(&expected, &found) < 1e-11,
                "{}",
                apart(&expected, &found)
            );
        }
    }
    let (crown, rack, bush) = (Crown::new(), Rack::new(), Bush::new());
    check(&ArmsInPhase::new(), &crown, ArmsInPhase::WHOLE);
    check(&HandsInPhase::new(), &crown, HandsInPhase::WHOLE);
    check(&AllInPhase::new(), &crown, AllInPhase::WHOLE);
    check(&NailsInPhaseOnArms::new(), &rack, NailsInPhaseOnArms::WHOLE);
    check(&BoughsInPhase::new(), &bush, BoughsInPhase::WHOLE);
    check(&LimbsInPhase::new(), &bush, LimbsInPhase::WHOLE);
    check(&BushInPhase::new(), &bush, BushInPhase::WHOLE);
}

#[test]
fn links_stand_for_as_many_as_move_alike() {
    let mut counts = [0; 7];
    AllInPhase::WHOLE.counts(&mut counts[..6]);
    assert_eq!(counts[..6], [1, 2, 6, 4, 4, 1]);
    assert_eq!(AllInPhase::WHOLE.links(), WHOLE);
    // The trunk with its tail, two arms with their fingers, six hands, four nails.
    assert_eq!(FingersLocked::LINKS, 13);
    let mut angles = [0.0; WHOLE];
    let mut given: Vec<f64> = (0..13).map(f64::from).collect();
    given[0] = 0.5;
    FingersLocked::WHOLE
        .angles(&given, &mut angles)
        .expect("all links");
    assert_eq!(
        angles,
        [
            0.5, //
            1.0, 2.0, 3.0, 4.0, 1.4, 5.0, 1.4, 6.0, // the first arm
            7.0, 8.0, 9.0, 10.0, 7.4, 11.0, 7.4, 12.0, // the second
            0.3,
        ]
    );
    let error = AllInPhase::WHOLE.angles(&[0.0; 5], &mut [0.0; WHOLE]);
    assert!(matches!(
        error,
        Err(WholeLengthError {
            given: 5,
            model: 6,
            ..
        })
    ));
}

/// Copies that hang from copies of links that are locked on copies of locked links: each has
/// a link of its own.
#[test]
fn copies_on_locked_copies_are_told_apart() {
    // The trunk with its tail and arms and their fingers, six hands, eight nails.
    assert_eq!(FingersLockedInArms::LINKS, 15);
    let mut angles = [0.0; OF_RACK];
    let mut given: Vec<f64> = (0..15).map(f64::from).collect();
    given[0] = 0.5;
    let tree = FingersLockedInArms::WHOLE;
    tree.angles(&given, &mut angles).expect("all links");
    let (arm, finger) = (0.5 + 0.3, 0.5 + (0.3 + 0.4));
    assert_eq!(
        angles,
        [
            0.5, //
            arm, 1.0, 2.0, 3.0, finger, 7.0, 8.0, finger, 9.0, 10.0, // the first arm
            arm, 4.0, 5.0, 6.0, finger, 11.0, 12.0, finger, 13.0, 14.0, // the second
            0.3,
        ]
    );
    let count = |tree: WholeTree, links: usize| {
        let mut counts = vec![0; links];
        tree.counts(&mut counts);
        counts
    };
    let mut own = vec![1; 15];
    own[0] = 8;
    assert_eq!(count(tree, 15), own);
    // Nails of both fingers of an arm as one.
    let in_phase = FingersInPhaseInArms::WHOLE;
    let links = FingersInPhaseInArms::LINKS;
    let counts = count(in_phase, links);
    assert_eq!(counts.iter().sum::<usize>(), OF_RACK);
    assert_eq!(counts.iter().filter(|&&count| count == 2).count(), 4);
}

#[branched_pendulum(
    gravity = 9.80665,
    stem(mass = 0.2, com = 0.1, inertia = 1e-3, joint = 0.3, drag = 1e-4)[
        bob(mass = 0.1, com = 0.05, inertia = 1e-4, joint = 0.1, drag = 2e-4)[
            tip: rod(mass = 0.1, length = 0.2)
        ]
    ],
    locked(bob, 0)
)]
struct LockedByName;

#[branched_pendulum(
    gravity = 9.80665,
    stem(mass = 0.3, com = (0.2 * 0.1 + 0.1 * 0.35) / 0.3, joint = 0.4, drag = 3e-4,
        inertia = 1e-3 + 1e-4 + 0.2 * 0.1 / 0.3 * 0.25^2)[
        tip: rod(mass = 0.1, length = 0.2)
    ]
)]
struct CombinedByHand;

#[test]
fn a_locked_joint_is_the_combined_body_to_the_last_bit() {
    let (locked, combined) = (LockedByName::new(), CombinedByHand::new());
    let mut random = Random::new(7);
    for _ in 0..1000 {
        let [theta, omega] = [PI, 10.0].map(|most| {
            let values = random.around_zero(2, most);
            [values[0], values[1]]
        });
        let (found, expected) = (
            locked.accelerations(&theta, &omega),
            combined.accelerations(&theta, &omega),
        );
        assert_eq!(found.map(f64::to_bits), expected.map(f64::to_bits));
    }
}

/// Twenty generations: 2^20 − 1 links.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 20, branching = 2, shape = rod, mass = 0.4, length = 0.5,
        mass_ratio = 0.4, length_ratio = 0.8, friction = 1e-4),
    in_phase(tree),
    emit(energies)
)]
struct Chain;

/// Seven generations in loops, and in phase.
macro_rules! seven {
    ($name:ident $(, $reduction:ident($($inside:tt)*))*) => {
        #[branched_pendulum(
            gravity = 9.80665,
            tree: generations(count = 7, branching = 2, shape = rod, mass = 0.4,
                length = 0.5, mass_ratio = 0.4, length_ratio = 0.8, friction = 1e-4),
            $($reduction($($inside)*)),*
        )]
        struct $name;
    };
}

seven!(Seven);
seven!(SevenInPhase, in_phase(tree));

#[test]
fn a_million_links_are_a_chain() {
    assert_eq!(Chain::LINKS, 20);
    assert_eq!(Chain::WHOLE.links(), (1 << 20) - 1);
    let theta: Vec<f64> = (0..20).map(f64::from).collect();
    let mut whole = vec![f64::NAN; Chain::WHOLE.links()];
    Chain::WHOLE.angles(&theta, &mut whole).expect("all links");
    for (link, angle) in whole.iter().enumerate() {
        assert_eq!(*angle, f64::from((link + 1).ilog2()));
    }
}

/// Over 10 s, of which the root's friction is felt.
#[test]
fn the_motion_in_phase_is_that_of_the_tree_in_loops() {
    let start: Vec<f64> = (0..7).map(|link| 0.3 + 0.02 * f64::from(link)).collect();
    let mut whole = vec![0.0; 127];
    SevenInPhase::WHOLE
        .angles(&start, &mut whole)
        .expect("all links");
    let solver = Dop853::new(Options::with_tolerance(1e-13));
    let reduced = AbsoluteAngles(&SevenInPhase::new());
    let reduced = solver
        .run(&reduced, &State::at_rest(0.0, &start), 10.0)
        .expect("a regular motion");
    let full = AbsoluteAngles(&Seven::new());
    let full = solver
        .run(&full, &State::at_rest(0.0, &whole), 10.0)
        .expect("a regular motion");
    SevenInPhase::WHOLE
        .angles(&reduced.state.values[..7], &mut whole)
        .expect("all links");
    let worst = apart(&full.state.values[..127], &whole);
    assert!(worst < 1e-12, "{worst:e}");
}
