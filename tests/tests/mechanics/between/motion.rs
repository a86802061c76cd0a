//! Motions of emitted models: the energy against the work of friction, and series.

use branched_pendulum::prelude::*;
use branched_pendulum::system::OdeFn;
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_trees::TreeDescription;

/// An uncle and a nephew, cousins, siblings, and a link and its grandparent, coupled by every
/// law.
#[branched_pendulum(
    gravity = 9.80665,
    trunk: rod(mass = 0.4, length = 0.3) [
        left: rod(mass = 0.2, length = 0.25) [leaf: rod(mass = 0.1, length = 0.2) * 2],
        right: rod(mass = 0.15, length = 0.35) [tip: rod(mass = 0.1, length = 0.15)],
    ],
    between(left, tip, spring = 0.3, rest = 0.4, friction = viscous),
    between(leaf_1, tip, spring = 0.1, friction(coulomb = coulomb, width = 0.2)),
    siblings(leaf, spring = 0.05, friction(quadratic = quadratic)),
    between(trunk, tip, spring = 0.2, rest = -0.3,
        friction(viscous = viscous, coulomb = coulomb, quadratic = quadratic, width = 0.3)),
    emit(energies, forces, taylor),
)]
struct Grove;

const LINKS: usize = 6;

fn start() -> State<f64> {
    let mut random = Random::new(8);
    let values = [
        random.around_zero(LINKS, 2.0),
        random.around_zero(LINKS, 4.0),
    ];
    State::new(0.0, values.concat())
}

/// ∫P dt is what the energy loses, the integral beside the motion as one more variable: by
/// each law alone, by all, and by none.
#[test]
fn the_energy_is_balanced_along_a_run() {
    let none = GroveParameters {
        viscous: 0.0,
        coulomb: 0.0,
        quadratic: 0.0,
    };
    let all = GroveParameters {
        viscous: 2e-3,
        coulomb: 4e-3,
        quadratic: 1e-3,
    };
    for (parameters, least) in [
        (none, 0.0),
        (
            GroveParameters {
                coulomb: 0.0,
                quadratic: 0.0,
                ..all
            },
            0.05,
        ),
        (
            GroveParameters {
                viscous: 0.0,
                quadratic: 0.0,
                ..all
            },
            0.05,
        ),
        (
            GroveParameters {
                viscous: 0.0,
                coulomb: 0.0,
                ..all
            },
            0.05,
        ),
        (all, 0.1),
    ] {
        let model = Grove::new(parameters).expect("friction is not negative");
        let ode = OdeFn::new(2 * LINKS + 1, |_: f64, state: &[f64], rates: &mut [f64]| {
            let theta: [f64; LINKS] = std::array::from_fn(|link| state[link]);
            let omega: [f64; LINKS] = std::array::from_fn(|link| state[LINKS + link]);
            rates[..LINKS].copy_from_slice(&omega);
            rates[LINKS..2 * LINKS].copy_from_slice(&model.accelerations(&theta, &omega));
            rates[2 * LINKS] = model.friction_power(&omega);
        });
        let energy = |state: &[f64]| {
            let theta: [f64; LINKS] = std::array::from_fn(|link| state[link]);
            let omega: [f64; LINKS] = std::array::from_fn(|link| state[LINKS + link]);
            model.kinetic_energy(&theta, &omega) + model.potential_energy(&theta)
        };
        let mut start = start();
        start.values.push(0.0);
        let method = Dop853::new(Options::with_tolerance(1e-14));
        let end = method.run(&ode, &start, 5.0);
        let end = end.expect("a smooth motion").state.values;
        let lost = energy(&start.values) - energy(&end);
        assert!(lost >= least * energy(&start.values) - 1e-9, "{lost}");
        let error = lost + end[2 * LINKS];
        assert!(error.abs() < 1e-10, "{error:e} of {lost}");
    }
}

#[test]
fn taylor_series_are_those_of_dop853() {
    let parameters = GroveParameters {
        viscous: 2e-3,
        coulomb: 4e-3,
        quadratic: 1e-3,
    };
    let model = Grove::new(parameters).expect("friction is positive");
    let system = AbsoluteAngles(&model);
    let options = || Options::with_tolerance(1e-13);
    let by_series = Taylor::new(options()).run(&system, &start(), 2.0);
    let by_stages = Dop853::new(options()).run(&system, &start(), 2.0);
    let [by_series, by_stages] = [by_series, by_stages].map(|end| end.expect("smooth").state);
    for (a, b) in by_series.values.iter().zip(&by_stages.values) {
        assert!((a - b).abs() < 1e-8, "{a} {b}");
    }
}

/// The text of the model, read at run time with the same values.
#[test]
fn emitted_code_agrees_with_the_tree_at_run_time() {
    let source = include_str!("motion.rs");
    let (_, rest) = source
        .split_once("#[branched_pendulum(")
        .expect("it is above");
    let (text, _) = rest.split_once(")]\nstruct Grove;").expect("it ends");
    let description = TreeDescription::parse(text).expect("the compiler takes it");
    let values = [("viscous", 2e-3), ("coulomb", 4e-3), ("quadratic", 1e-3)];
    let tree = description.tree(&values).expect("the model takes them");
    let model = Grove::new(GroveParameters {
        viscous: 2e-3,
        coulomb: 4e-3,
        quadratic: 1e-3,
    })
    .expect("friction is positive");
    let mut random = Random::new(9);
    for _ in 0..100 {
        let [theta, omega] = [3.0, 5.0].map(|size| random.around_zero(LINKS, size));
        let own = tree.accelerations(0.0, &theta, &omega);
        let fixed = |values: &[f64]| -> [f64; LINKS] { std::array::from_fn(|link| values[link]) };
        let (theta, omega) = (fixed(&theta), fixed(&omega));
        let emitted = model.accelerations(&theta, &omega);
        let size = own.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
        for (own, emitted) in own.iter().zip(emitted) {
            assert!((own - emitted).abs() < 1e-11 * size, "{own} {emitted}");
        }
        let (own, emitted) = (
            tree.friction_power(&theta, &omega),
            model.friction_power(&omega),
        );
        assert!((own / emitted - 1.0).abs() < 1e-13, "{own} {emitted}");
        let (own, emitted) = (
            tree.potential_energy_of(&theta),
            model.potential_energy(&theta),
        );
        assert!(
            (own - emitted).abs() < 1e-13 * (1.0 + emitted.abs()),
            "{own} {emitted}"
        );
    }
}
