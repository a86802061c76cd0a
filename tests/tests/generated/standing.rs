//! Trees that stand, gravity below zero: each against the same tree in the words of one that
//! hangs, with angles π − θ and what is across the other way, in every form of tree.

// Rest angles of descriptions are numbers.
#![allow(clippy::approx_constant)]

use std::f64::consts::PI;

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Double;
use branched_pendulum::system::{LinkPoint, Workspace};
use branched_pendulum::{ScaleBudget, Scales};
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_trees::PendulumTree;

/// One tree in both words, written out and in loops, and its text as it stands.
macro_rules! twins {
    ($written:ident, $loops:ident, $hanging:ident, $text:ident: {$($standing:tt)*} {$($mirrored:tt)*}) => {
        #[branched_pendulum(gravity = -9.80665, code = unrolled, $($standing)*,
            emit(energies, forces, positions))]
        struct $written;

        #[branched_pendulum(gravity = -9.80665, code = loops, $($standing)*,
            emit(energies, forces, positions))]
        struct $loops;

        #[branched_pendulum(gravity = 9.80665, code = unrolled, $($mirrored)*,
            emit(energies, forces, positions))]
        struct $hanging;

        const $text: &str = concat!("gravity = -9.80665, ", stringify!($($standing)*));
    };
}

twins!(Lift, LiftLoops, HangingLift, LIFT: {
    rod: rod(mass = 0.1, length = 0.3) [ tip: rod(mass = 0.05, length = 0.2) ],
    drive(y = 4.903325 * t * t)
} {
    rod: rod(mass = 0.1, length = 0.3) [ tip: rod(mass = 0.05, length = 0.2) ],
    drive(y = 4.903325 * t * t)
});

twins!(Shrub, ShrubLoops, HangingShrub, SHRUB: {
    trunk(mass = 0.4, com = (0.2, 0.03), inertia = 2e-3, joint = (0.45, -0.02), spring = 3,
        rest = 0.1, friction = 0.01) [
        bough(mass = 0.1, com = (0.12, 0.01), inertia = 1e-3, at = (0.3, -0.04),
            joint = (0.25, 0.03), spring = 0.5, rest = 0.4) [
            twig: rod(mass = 0.03, length = 0.15) * 2
        ],
        shoot: rod(mass = 0.05, length = 0.2, drag = 1e-3)
    ],
    drive(torque = 0.3 * cos(2 * t), x = 0.1 * sin(3 * t), y = 0.05 * t^2 + 0.02 * cos(5 * t))
} {
    trunk(mass = 0.4, com = (0.2, -0.03), inertia = 2e-3, joint = (0.45, 0.02), spring = 3,
        rest = 3.14159265358979323846 - 0.1, friction = 0.01) [
        bough(mass = 0.1, com = (0.12, -0.01), inertia = 1e-3, at = (0.3, 0.04),
            joint = (0.25, -0.03), spring = 0.5, rest = -0.4) [
            twig: rod(mass = 0.03, length = 0.15) * 2
        ],
        shoot: rod(mass = 0.05, length = 0.2, drag = 1e-3)
    ],
    drive(torque = -0.3 * cos(2 * t), x = 0.1 * sin(3 * t), y = 0.05 * t^2 + 0.02 * cos(5 * t))
});

twins!(Reed, ReedLoops, HangingReed, REED: {
    stem: point(mass = 0.2, length = 0.4, spring = 2) [
        blade: rod(mass = 0.1, length = 0.3, spring = 0.4) [
            ear: disc(mass = 0.02, length = 0.05, radius = 0.03, spring = 0.01)
        ]
    ],
    drive(y = 0.01 * cos(40 * t))
} {
    stem: point(mass = 0.2, length = 0.4, spring = 2, rest = 3.14159265358979323846) [
        blade: rod(mass = 0.1, length = 0.3, spring = 0.4) [
            ear: disc(mass = 0.02, length = 0.05, radius = 0.03, spring = 0.01)
        ]
    ],
    drive(y = 0.01 * cos(40 * t))
});

/// A rod in a lift that accelerates upwards with g.
#[branched_pendulum(
    gravity = -9.80665,
    rod: rod(mass = 0.1, length = 0.3),
    drive(y = 4.903325 * t * t),
    emit(positions),
)]
struct Rod;

const ROD: &str =
    "gravity = -9.80665, rod: rod(mass = 0.1, length = 0.3), drive(y = 4.903325 * t * t)";

#[branched_pendulum(
    gravity = -9.80665,
    code = loops,
    crown: generations(count = 3, branching = 2, mass = 0.12, com = (0.14, 0.02), inertia = 1e-3,
        joint = (0.3, 0.05), mass_ratio = 0.5, length_ratio = 0.7),
    drive(x = 0.03 * sin(2 * t), y = 0.02 * cos(5 * t)),
    emit(energies, forces, positions, budget(parseval, scales)),
)]
struct Crown;

const CROWN: &str = "gravity = -9.80665, code = loops,
    crown: generations(count = 3, branching = 2, mass = 0.12, com = (0.14, 0.02), inertia = 1e-3,
        joint = (0.3, 0.05), mass_ratio = 0.5, length_ratio = 0.7),
    drive(x = 0.03 * sin(2 * t), y = 0.02 * cos(5 * t))";

#[branched_pendulum(
    gravity = 9.80665,
    code = loops,
    crown: generations(count = 3, branching = 2, mass = 0.12, com = (0.14, -0.02), inertia = 1e-3,
        joint = (0.3, -0.05), mass_ratio = 0.5, length_ratio = 0.7),
    drive(x = 0.03 * sin(2 * t), y = 0.02 * cos(5 * t)),
    emit(energies, forces, positions, budget(parseval, scales)),
)]
struct HangingCrown;

/// What a form of a tree says of a state, in the order: accelerations; points and their
/// velocities of every kind; torques of forces there; energies, power of the drive.
struct Said {
    accelerations: Vec<f64>,
    places: Vec<f64>,
    torques: Vec<f64>,
    kinetic: f64,
    potential: f64,
    drive_power: f64,
}

struct Given {
    time: f64,
    theta: Vec<f64>,
    omega: Vec<f64>,
    torques: Vec<f64>,
    forces: Vec<[f64; 2]>,
}

impl Given {
    fn random(random: &mut Random, links: usize) -> Self {
        Self {
            time: random.between(0.0, 2.0),
            theta: random.around_zero(links, 4.0),
            omega: random.around_zero(links, 6.0),
            torques: random.around_zero(links, 0.3),
            forces: (0..links).map(|_| random.array(-2.0, 2.0)).collect(),
        }
    }

    /// The same in the words of a tree that hangs.
    fn mirrored(&self) -> Self {
        let opposite = |values: &[f64]| values.iter().map(|value| -value).collect();
        Self {
            time: self.time,
            theta: self.theta.iter().map(|angle| PI - angle).collect(),
            omega: opposite(&self.omega),
            torques: opposite(&self.torques),
            forces: self.forces.clone(),
        }
    }
}

/// What a model says; `$array` turns slices to what its functions take.
macro_rules! said {
    ($model:expr, $given:expr, $array:expr) => {{
        let (model, given): (_, &Given) = ($model, $given);
        let (theta, omega, torques) = (&given.theta[..], &given.omega[..], &given.torques[..]);
        let mut said = Said {
            accelerations: vec![0.0; theta.len()],
            places: Vec::new(),
            torques: Vec::new(),
            kinetic: Energy::kinetic_energy_of(model, theta, omega),
            potential: Energy::potential_energy_of(model, theta),
            drive_power: model.drive_power(given.time, &$array(theta), &$array(omega)),
        };
        let alpha = &mut said.accelerations;
        model.accelerations_under_into(given.time, theta, omega, torques, alpha);
        for point in LinkPoint::ALL {
            let mut pairs = vec![[0.0; 2]; theta.len()];
            model.points_into(point, theta, &mut pairs);
            said.places.extend(pairs.concat());
            model.point_velocities_into(point, theta, omega, &mut pairs);
            said.places.extend(pairs.concat());
            let mut torques = vec![0.0; theta.len()];
            model.point_torques_into(point, theta, &given.forces, &mut torques);
            said.torques.extend(torques);
        }
        said
    }};
}

fn said_at_run_time(tree: &PendulumTree, given: &Given) -> Said {
    let (theta, omega) = (&given.theta[..], &given.omega[..]);
    let mut accelerations = vec![0.0; theta.len()];
    tree.accelerations_under_into(given.time, theta, omega, &given.torques, &mut accelerations);
    let places = LinkPoint::ALL.map(|point| {
        let velocities = tree.point_velocities(point, theta, omega);
        [tree.points(point, theta), velocities].concat().concat()
    });
    let torques = LinkPoint::ALL.map(|point| tree.point_torques(point, theta, &given.forces));
    Said {
        accelerations,
        places: places.concat(),
        torques: torques.concat(),
        kinetic: tree.kinetic_energy_of(theta, omega),
        potential: tree.potential_energy_of(theta),
        drive_power: tree.drive_power(given.time, theta, omega),
    }
}

fn close(found: &[f64], expected: &[f64], sign: f64, what: &str) {
    assert_eq!(found.len(), expected.len());
    let size = expected.iter().fold(1.0_f64, |size, v| size.max(v.abs()));
    for (found, expected) in found.iter().zip(expected) {
        let error = (found - sign * expected).abs();
        assert!(error < 1e-11 * size, "{what}: {found} {expected}");
    }
}

/// Asserts that both say the same of one tree; `constant` is what their potential energies
/// differ by.
fn same(standing: &Said, hanging: &Said, constant: f64, form: &str) {
    let what = |part: &str| format!("{part}, {form}");
    let (own, other) = (standing, hanging);
    close(
        &own.accelerations,
        &other.accelerations,
        -1.0,
        &what("accelerations"),
    );
    close(&own.places, &other.places, 1.0, &what("places"));
    close(&own.torques, &other.torques, -1.0, &what("torques"));
    close(
        &[own.kinetic],
        &[other.kinetic],
        1.0,
        &what("kinetic energy"),
    );
    close(
        &[own.potential],
        &[other.potential + constant],
        1.0,
        &what("potential energy"),
    );
    close(
        &[own.drive_power],
        &[other.drive_power],
        1.0,
        &what("power of the drive"),
    );
}

/// Compares all forms of a pair of twins.
macro_rules! agree {
    ($written:ident, $loops:ident, $hanging:ident, $text:ident) => {{
        let (written, loops, hanging) = ($written::new(), $loops::new(), $hanging::new());
        let tree = PendulumTree::parse($text).expect("it is right");
        let links = $written::LINKS;
        let mut random = Random::new(links as u64);
        let mut constant = None;
        for _ in 0..30 {
            let given = Given::random(&mut random, links);
            let array =
                |values: &[f64]| -> [f64; $written::LINKS] { values.try_into().expect("as many") };
            let other = said!(&hanging, &given.mirrored(), array);
            let own = said!(&written, &given, array);
            let constant = *constant.get_or_insert(own.potential - other.potential);
            same(&own, &other, constant, "written out");
            let own = said!(&loops, &given, <[f64]>::to_vec);
            same(&own, &other, constant, "in loops");
            same(
                &said_at_run_time(&tree, &given),
                &other,
                constant,
                "at run time",
            );
        }
    }};
}

#[test]
fn a_tree_that_stands_is_one_that_hangs_turned_over() {
    agree!(Lift, LiftLoops, HangingLift, LIFT);
    agree!(Shrub, ShrubLoops, HangingShrub, SHRUB);
    agree!(Reed, ReedLoops, HangingReed, REED);
}

/// By rule, with the powers of the drive by scale.
#[test]
fn generations_that_stand_are_those_that_hang_turned_over() {
    let (standing, hanging) = (Crown::new(), HangingCrown::new());
    let tree = PendulumTree::parse(CROWN).expect("it is right");
    let mut random = Random::new(5);
    let mut constant = None;
    for _ in 0..30 {
        let given = Given::random(&mut random, 7);
        let mirrored = given.mirrored();
        let other = said!(&hanging, &mirrored, <[f64]>::to_vec);
        let own = said!(&standing, &given, <[f64]>::to_vec);
        let constant = *constant.get_or_insert(own.potential - other.potential);
        same(&own, &other, constant, "by rule");
        let at_run_time = said_at_run_time(&tree, &given);
        same(&at_run_time, &other, constant, "by rule at run time");
        let budget = |budget: &ScaleBudget<f64>| -> Vec<f64> {
            (0..3).map(|scale| budget.drive_power(scale)).collect()
        };
        let workspace = &mut Workspace::new();
        let mut scales = ScaleBudget::new();
        standing.budget_by_scale(
            workspace,
            given.time,
            &given.theta,
            &given.omega,
            &mut scales,
        );
        let own = budget(&scales);
        hanging.budget_by_scale(
            workspace,
            mirrored.time,
            &mirrored.theta,
            &mirrored.omega,
            &mut scales,
        );
        close(&own, &budget(&scales), 1.0, "powers by scale");
        let scales = tree.budget_by_scale(given.time, [&given.theta, &given.omega, &[]]);
        close(
            &budget(&scales.expect("it is by rule")),
            &own,
            1.0,
            "powers by scale at run time",
        );
        let total: f64 = own.iter().sum();
        assert!(
            (total - standing.drive_power(given.time, &given.theta, &given.omega)).abs() < 1e-12
        );
    }
}

/// Ends are above their pivots, and what starts upwards is heavier.
#[test]
fn what_stands_falls_twice_as_fast_in_a_lift() {
    let alpha = 2.0 * 1.5 * 9.80665 / 0.3 * 0.1_f64.sin();
    let tree = PendulumTree::parse(ROD).expect("it is right");
    let [written] = Rod::new().accelerations(0.0, &[0.1], &[0.0]);
    for found in [written, tree.accelerations(0.0, &[0.1], &[0.0])[0]] {
        assert!((found - alpha).abs() < 1e-12, "{found} {alpha}");
    }
    assert_eq!(Rod::new().ends(&[0.0]), [[0.0, 0.3]]);
    assert_eq!(tree.points(LinkPoint::End, &[0.0]), [[0.0, 0.3]]);
    // At rest accelerations are proportional to gravity.
    let theta = [0.1, -0.4];
    let (still, _) = LIFT.rsplit_once(',').expect("the drive is the last entry");
    let still = PendulumTree::parse(still).expect("it is right");
    let still = still.accelerations(0.0, &theta, &[0.0; 2]);
    let mut loops = [0.0; 2];
    LiftLoops::new().accelerations_into(0.0, &theta, &[0.0; 2], &mut loops);
    let twice: Vec<f64> = still.iter().map(|alpha| 2.0 * alpha).collect();
    close(&loops, &twice, 1.0, "in a lift");
    let wide = branched_pendulum::Model::cast(&LiftLoops::new(), Double::from_f64);
    let zero = Double::from_f64(0.0);
    let mut ends = [[zero; 2]; 2];
    wide.points_into(LinkPoint::End, &[zero; 2], &mut ends);
    assert_eq!(ends[0].map(|value| value.to_f64()), [0.0, 0.3]);
    assert_eq!(ends[1].map(|value| value.to_f64()), [0.0, 0.5]);
    // It leans to positive x.
    assert!(Rod::new().ends(&[0.1])[0][0] > 0.0);
    let (stands, hangs) = (Lift::new().stands(), HangingLift::new().stands());
    assert!(stands && Positions::stands(&&LiftLoops::new()) && !hangs);
    assert!(Crown::new().stands());
}

/// U is Σ m g y but for a constant, and the torques of weights are −∂U/∂θ: by differences.
#[test]
fn weights_do_the_work_that_the_potential_loses() {
    let model = Shrub::new();
    let masses: Vec<f64> = (0..5)
        .map(|link| model.properties_of(link).expect("it has five").mass)
        .collect();
    let mut random = Random::new(9);
    // The springs' share.
    let springs = |theta: &[f64; 5]| {
        0.5 * 3.0 * (theta[0] - 0.1).powi(2) + 0.5 * 0.5 * (theta[1] - theta[0] - 0.4).powi(2)
    };
    let heights = |theta: &[f64; 5]| -> f64 {
        let centres = model.centres(theta).into_iter().zip(&masses);
        centres.map(|([_, y], mass)| 9.80665 * mass * y).sum()
    };
    let rest = heights(&[0.0; 5]);
    for _ in 0..20 {
        let theta: [f64; 5] = random.array(-3.0, 3.0);
        let weight = model.potential_energy(&theta) - springs(&theta);
        assert!((weight - (heights(&theta) - rest)).abs() < 1e-13);
        let weights: [[f64; 2]; 5] = std::array::from_fn(|link| [0.0, -9.80665 * masses[link]]);
        let torques = model.centre_torques(&theta, &weights);
        for (link, torque) in torques.into_iter().enumerate() {
            let [more, less] = [1e-5, -1e-5].map(|step| {
                let mut theta = theta;
                theta[link] += step;
                heights(&theta)
            });
            assert!((torque + (more - less) / 2e-5).abs() < 1e-8, "{link}");
        }
        // A force beside the end of the trunk, as on its pivot and as a couple.
        let (force, arm) = ([0.3, -0.2], model.ends(&theta)[0]);
        let mut forces = [[0.0; 2]; 5];
        forces[0] = force;
        let couple = arm[1] * force[0] - arm[0] * force[1];
        let found = model.pivot_torques(&theta, &forces)[0] + couple;
        assert!((found - model.end_torques(&theta, &forces)[0]).abs() < 1e-15);
    }
}

mod parameters {
    use branched_pendulum::prelude::*;
    use branched_pendulum_trees::TreeDescription;

    #[branched_pendulum(gravity = g, rod: rod(mass = 0.1, length = 0.3), emit(positions))]
    struct Hanging;

    #[branched_pendulum(gravity = -g, rod: rod(mass = 0.1, length = 0.3), emit(positions))]
    struct Standing;

    #[branched_pendulum(gravity = -2 * g / k, rod: rod(mass = 0.1, length = 0.3), emit(positions))]
    struct Planet;

    /// A parameter does not turn a tree over.
    #[test]
    fn are_refused_where_they_turn_gravity_round() {
        let hanging = |g| Hanging::new(HangingParameters { g });
        let error = hanging(-9.8).unwrap_err().to_string();
        assert_eq!(
            error,
            "gravity is -9.8, must be finite and not negative: for a tree that stands up write \
             `gravity = -g`"
        );
        let standing = |g| Standing::new(StandingParameters { g });
        let error = standing(-9.8).unwrap_err().to_string();
        assert_eq!(
            error,
            "gravity is 9.8, must be finite and not positive: for a tree that hangs write `gravity = g`"
        );
        assert!(Planet::new(PlanetParameters { g: 1.6, k: -2.0 }).is_err());
        assert!(Planet::new(PlanetParameters { g: 1.6, k: 2.0 }).is_ok());
        // Without weight there is still an upward vertical.
        for g in [0.0, 9.8] {
            assert_eq!(hanging(g).unwrap().ends(&[0.0]), [[0.0, -0.3]]);
            assert_eq!(standing(g).unwrap().ends(&[0.0]), [[0.0, 0.3]]);
        }
        for (text, value, accepted) in [
            ("gravity = g", -9.8, false),
            ("gravity = g", 0.0, true),
            ("gravity = -g", -9.8, false),
            ("gravity = -g", 9.8, true),
            ("gravity = -g - 1", 0.0, true),
            ("gravity = -g - 1", -2.0, false),
            ("gravity = -(g / 2)^2", -3.0, true),
        ] {
            let text = format!("{text}, rod: rod(mass = 0.1, length = 0.3)");
            let description = TreeDescription::parse(&text).unwrap();
            let tree = description.tree::<f64>(&[("g", value)]);
            assert_eq!(tree.is_ok(), accepted, "{text} at {value}");
            if let Err(error) = tree {
                assert!(error.to_string().contains("for a tree that"), "{error}");
            }
        }
    }
}
