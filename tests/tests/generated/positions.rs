//! Where links are, in every form of tree: against vectors summed by the tests
//! themselves, against differences, and against powers.

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Double;
use branched_pendulum::system::{LinkPoint, OdeFn, UnderTorques};
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_compiler_tests::source;
use branched_pendulum_tests::bodies::{bodies_of, point};
use branched_pendulum_tests::oracle::Tree;
use branched_pendulum_tests::oracle::points::Place;
use branched_pendulum_tests::scenes::branch::{Branch, BranchParameters};

/// One tree in loops and written out, and its text for the tests' own route.
macro_rules! forms {
    ($loops:ident, $unrolled:ident, $text:ident: $($tree:tt)*) => {
        #[branched_pendulum(gravity = 9.80665, code = loops, emit(positions), $($tree)*)]
        struct $loops;

        #[branched_pendulum(gravity = 9.80665, code = unrolled, emit(positions), $($tree)*)]
        struct $unrolled;

        const $text: &str = stringify!($($tree)*);
    };
}

forms!(BushLoops, Bush, BUSH:
limb: rod(mass = 0.4, length = 0.5) [
    bough(mass = 0.1, com = (0.12, 0.01), inertia = 1e-3, at = (0.3, -0.02),
        joint = (0.25, 0.03)) [
        twig: rod(mass = 0.03, length = 0.15) * 2,
        leaf(mass = 0.01, com = (0.02, 0.005), inertia = 1e-6, at = (0.1, 0.02)),
    ] * 2,
    shoot: point(mass = 0.05, length = 0.2),
]);

forms!(GroveLoops, Grove, GROVE:
    tree: generations(count = 4, branching = 3, mass = 0.12, com = (0.14, 0.02),
        inertia = 1e-3, joint = (0.3, 0.05), mass_ratio = 0.5, length_ratio = 0.7));

/// The links in plain numbers, and their ends.
fn oracle(text: &str) -> (Tree, Vec<[f64; 2]>) {
    let text =
        format!("#[branched_pendulum(gravity = 9.80665, code = unrolled, {text})] struct Sample;");
    let scene = source::stages_of(&text).scene;
    let ends = scene.links.iter().map(|link| point(&link.end));
    (bodies_of(&scene), ends.collect())
}

/// Index in the model of each link of the tree written out, by name.
fn order<P: Pendulum<f64>>(model: &P, names: &[&str]) -> Vec<usize> {
    let own = model.link_names();
    let find = |name: &&str| own.iter().position(|other| other == *name);
    names
        .iter()
        .map(|name| find(name).expect("it has that link"))
        .collect()
}

fn close(found: &[f64], expected: &[f64], what: &str) {
    let size = expected.iter().fold(1.0_f64, |size, v| size.max(v.abs()));
    for (found, expected) in found.iter().zip(expected) {
        assert!(
            (found - expected).abs() < 1e-14 * size,
            "{what}: {found} {expected}"
        );
    }
}

/// Data, points, velocities and torques of a model whose links stand at `order`.
fn agrees<P: Positions<f64>>(model: &P, tree: &Tree, ends: &[[f64; 2]], order: &[usize]) {
    let links = tree.links.len();
    assert_eq!(model.links(), links);
    for (link, (expected, &end)) in tree.links.iter().zip(ends).enumerate() {
        let found = model.properties_of(order[link]).expect("it has that link");
        assert_eq!(found.parent, expected.parent.map(|parent| order[parent]));
        let numbers = [found.mass, found.inertia, found.length()];
        close(
            &numbers,
            &[expected.mass, expected.inertia, end[0].hypot(end[1])],
            "data",
        );
        let found = [found.centre, found.pivot, found.end].concat();
        close(
            &found,
            &[expected.com, expected.pivot, end].concat(),
            "places",
        );
        let mut children: Vec<usize> = (0..links)
            .filter(|&child| tree.links[child].parent == Some(link))
            .map(|child| order[child])
            .collect();
        children.sort_unstable();
        assert!(model.children(order[link]).eq(children));
    }
    assert_eq!(model.properties_of(links), None);
    let mut random = Random::new(3);
    for _ in 0..20 {
        let theta = random.around_zero(links, 4.0);
        let omega = random.around_zero(links, 9.0);
        let forces: Vec<[f64; 2]> = (0..links).map(|_| random.array(-3.0, 3.0)).collect();
        let placed = |numbers: &[f64]| {
            let mut own = vec![0.0; links];
            for (&place, &number) in order.iter().zip(numbers) {
                own[place] = number;
            }
            own
        };
        let (own_theta, own_omega) = (placed(&theta), placed(&omega));
        let mut own_forces = vec![[0.0; 2]; links];
        for (&place, &force) in order.iter().zip(&forces) {
            own_forces[place] = force;
        }
        for point in LinkPoint::ALL {
            let mut points = vec![[0.0; 2]; links];
            let mut velocities = vec![[0.0; 2]; links];
            let mut torques = vec![0.0; links];
            model.points_into(point, &own_theta, &mut points);
            model.point_velocities_into(point, &own_theta, &own_omega, &mut velocities);
            model.point_torques_into(point, &own_theta, &own_forces, &mut torques);
            let mut expected_torques = vec![0.0; links];
            let mut power = 0.0;
            for link in 0..links {
                let place = Place {
                    link,
                    place: match point {
                        LinkPoint::Pivot => [0.0; 2],
                        LinkPoint::Centre => tree.links[link].com,
                        LinkPoint::End => ends[link],
                    },
                };
                let own = order[link];
                close(&points[own], &tree.position(place, &theta), "position");
                let velocity = tree.velocity(place, &theta, &omega);
                close(&velocities[own], &velocity, "velocity");
                let of_force = tree.torques(place, &theta, forces[link]);
                for (sum, torque) in expected_torques.iter_mut().zip(of_force) {
                    *sum += torque;
                }
                power += velocity[0] * forces[link][0] + velocity[1] * forces[link][1];
            }
            close(&torques, &placed(&expected_torques), "torques");
            let of_torques: f64 = torques.iter().zip(&own_omega).map(|(q, w)| q * w).sum();
            assert!((of_torques - power).abs() < 1e-12 * (1.0 + power.abs()));
            moves_as_it_says(model, point, &own_theta, &own_omega, &velocities);
        }
    }
    let mut short = vec![[0.0; 2]; links - 1];
    model.points_into(LinkPoint::End, &vec![0.0; links], &mut short);
    assert!(short.concat().iter().all(|value| value.is_nan()));
}

/// Velocities against differences of positions.
fn moves_as_it_says<P: Positions<f64>>(
    model: &P,
    point: LinkPoint,
    theta: &[f64],
    omega: &[f64],
    velocities: &[[f64; 2]],
) {
    const STEP: f64 = 1e-4;
    let at = |time: f64| {
        let theta: Vec<f64> = theta.iter().zip(omega).map(|(q, w)| q + time * w).collect();
        let mut points = vec![[0.0; 2]; theta.len()];
        model.points_into(point, &theta, &mut points);
        points
    };
    // Of fourth order.
    let [far, near] = [2.0, 1.0].map(|steps| (at(steps * STEP), at(-steps * STEP)));
    for (link, velocity) in velocities.iter().enumerate() {
        for axis in 0..2 {
            let slope = |(plus, minus): &(Vec<[f64; 2]>, Vec<[f64; 2]>)| {
                plus[link][axis] - minus[link][axis]
            };
            let difference = (8.0 * slope(&near) - slope(&far)) / (12.0 * STEP);
            assert!(
                (velocity[axis] - difference).abs() < 1e-9,
                "{point:?} of {link}"
            );
        }
    }
}

#[test]
fn all_forms_know_where_their_links_are() {
    let (tree, ends) = oracle(BUSH);
    let names = Bush::LINK_NAMES;
    agrees(&Bush::new(), &tree, &ends, &order(&Bush::new(), names));
    agrees(
        &BushLoops::new(),
        &tree,
        &ends,
        &order(&BushLoops::new(), names),
    );
    let (tree, ends) = oracle(GROVE);
    let names = Grove::LINK_NAMES;
    agrees(&Grove::new(), &tree, &ends, &order(&Grove::new(), names));
    agrees(
        &GroveLoops::new(),
        &tree,
        &ends,
        &order(&GroveLoops::new(), names),
    );
}

#[test]
fn parameters_and_other_numbers_come_along() {
    let model = Branch::new(BranchParameters {
        twig_mass: 0.03,
        twig_length: 0.2,
    });
    let model = model.unwrap();
    let twig = model.properties_of(2).unwrap();
    assert_eq!(
        (twig.mass, twig.length(), twig.parent),
        (0.03, 0.2, Some(1))
    );
    assert_eq!(model.along_end_twig(), 0.2);
    // A link that says no joint ends at its centre of mass.
    let shoot = model.properties_of(4).unwrap();
    assert_eq!(shoot.end, shoot.centre);
    let precise = branched_pendulum::Model::cast(&model, Double::from_f64);
    let theta = [0.3, -0.2, 0.7, 1.1, -2.0];
    let more = precise.ends(&theta.map(Double::from_f64));
    for (end, more) in model.ends(&theta).concat().into_iter().zip(more.concat()) {
        assert!((Double::from_f64(end) - more).to_f64().abs() < 1e-15);
    }
    let loops = branched_pendulum::Model::cast(&GroveLoops::new(), |x| x as f32);
    let last = GroveLoops::LINKS - 1;
    assert_eq!(loops.properties_of(last).unwrap().mass, 0.015);
}

/// Ten seconds of wind that drags at the ends of all links: the energy that it brings,
/// less what friction takes, is what the branch has more.
#[test]
fn wind_on_all_links_balances_the_energy() {
    let model = Branch::new(BranchParameters {
        twig_mass: 0.03,
        twig_length: 0.2,
    });
    let model = model.unwrap();
    let torques = |time: f64, theta: &[f64; 5], omega: &[f64; 5]| {
        let speed = 4.0 + 2.0 * (3.0 * time).sin();
        let drag = |[x, y]: [f64; 2]| [0.3 * (speed - x), -0.3 * y];
        let wind = model.end_velocities(theta, omega).map(drag);
        model.end_torques(theta, &wind)
    };
    // Angles, momenta, energy brought in.
    let ode = OdeFn::new(11, |time: f64, state: &[f64], rates: &mut [f64]| {
        let theta: &[f64; 5] = state[..5].try_into().unwrap();
        let momenta: &[f64; 5] = state[5..10].try_into().unwrap();
        let [omega, slopes] = model.canonical_rates(theta, momenta);
        let torques = torques(time, theta, &omega);
        let friction = friction_power(&omega);
        rates[..5].copy_from_slice(&omega);
        let mut power = friction;
        for link in 0..5 {
            rates[5 + link] = slopes[link] + torques[link];
            power += torques[link] * omega[link];
        }
        rates[10] = power;
    });
    let start = State::new(0.0, vec![0.0; 11]);
    let energy = |state: &[f64]| {
        let (theta, momenta) = (state[..5].try_into().unwrap(), &state[5..10]);
        let omega = model.velocities(theta, momenta.try_into().unwrap());
        model.kinetic_energy(theta, &omega) + model.potential_energy(theta)
    };
    let method = Dop853::new(Options::with_tolerance(1e-12));
    let end = method.run(&ode, &start, 10.0);
    let end = end.unwrap().state.values;
    let brought = end[10];
    assert!(energy(&end) > 0.05);
    assert!((energy(&end) - energy(&start.values) - brought).abs() < 1e-10);

    // The same motion in angles and angular velocities.
    let blown = UnderTorques::new(
        &model,
        |time: f64, theta: &[f64], omega: &[f64], out: &mut [f64]| {
            let (theta, omega) = (theta.try_into().unwrap(), omega.try_into().unwrap());
            out.copy_from_slice(&torques(time, theta, omega));
        },
    );
    let start = State::at_rest(0.0, &[0.0; 5]);
    let found = method.run(&blown, &start, 10.0);
    let found = found.unwrap().state.values;
    let omega = model.velocities(end[..5].try_into().unwrap(), end[5..10].try_into().unwrap());
    for (found, expected) in found.iter().zip(end[..5].iter().chain(&omega)) {
        assert!((found - expected).abs() < 1e-8, "{found} {expected}");
    }
}

/// −c ω² of the limb's pivot, −k ω² of the twigs.
fn friction_power(omega: &[f64; 5]) -> f64 {
    -1e-3 * omega[0] * omega[0] - 1e-4 * (omega[2] * omega[2] + omega[3] * omega[3])
}
