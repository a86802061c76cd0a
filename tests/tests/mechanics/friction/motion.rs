//! Trajectories with friction: energy, Taylor series, small differences, sectors.

use std::f64::consts::PI;

use branched_pendulum::Transverse;
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Dual;
use branched_pendulum::system::InPhaseMotion;
use branched_pendulum_compiler_tests::random::Random;

use crate::support::compile;

/// Two links with every law, by parameters.
#[branched_pendulum(
    gravity = 9.80665,
    arm: rod(mass = 0.3, length = 0.4,
        friction(viscous = viscous_arm, coulomb = coulomb_arm, static = static_arm,
            stribeck = stribeck, quadratic = quadratic_arm, width = width)) [
        hand: rod(mass = 0.1, length = 0.3,
            friction(viscous = viscous_hand, coulomb = coulomb_hand, quadratic = quadratic_hand,
                width = width),
            drag(viscous = 1e-4, quadratic = 1e-4))
    ],
    emit(energies, forces, taylor),
)]
struct Chain;

const PARAMETERS: ChainParameters<f64> = ChainParameters {
    viscous_arm: 1e-4,
    coulomb_arm: 2e-3,
    static_arm: 3e-3,
    stribeck: 0.4,
    quadratic_arm: 1e-4,
    width: 0.1,
    viscous_hand: 2e-4,
    coulomb_hand: 1e-3,
    quadratic_hand: 2e-4,
};

/// Compiled code and the interpreter agree to the bit.
#[test]
fn compiled_code_is_what_the_interpreter_computes() {
    let source = include_str!("motion.rs");
    let (_, rest) = source
        .split_once("#[branched_pendulum(")
        .expect("it is above");
    let (attribute, _) = rest.split_once(")]\nstruct Chain;").expect("it ends");
    let compiled = compile(attribute);
    let model = Chain::new(PARAMETERS).expect("friction is positive");
    let names = compiled.scene.parameters.iter();
    let values: Vec<f64> = names
        .map(|parameter| match parameter.name.as_str() {
            "viscous_arm" => PARAMETERS.viscous_arm,
            "coulomb_arm" => PARAMETERS.coulomb_arm,
            "static_arm" => PARAMETERS.static_arm,
            "stribeck" => PARAMETERS.stribeck,
            "quadratic_arm" => PARAMETERS.quadratic_arm,
            "width" => PARAMETERS.width,
            "viscous_hand" => PARAMETERS.viscous_hand,
            "coulomb_hand" => PARAMETERS.coulomb_hand,
            "quadratic_hand" => PARAMETERS.quadratic_hand,
            other => panic!("{other}"),
        })
        .collect();
    let mut random = Random::new(4);
    for _ in 0..100 {
        let [theta, omega] =
            [3.0, 5.0].map(|size: f64| [random.between(-size, size), random.between(-size, size)]);
        let found = compiled.evaluate_with(&values, "accelerations", &[&theta, &omega]);
        assert_eq!(model.accelerations(&theta, &omega).to_vec(), found);
        let found = compiled.evaluate_with(&values, "friction_power", &[&omega]);
        assert_eq!(model.friction_power(&omega), found[0]);
    }
}

/// ∫P dt is what the energy loses, the integral beside the motion as one more variable.
#[test]
fn the_energy_is_balanced_along_a_run() {
    use branched_pendulum::system::OdeFn;
    let model = Chain::new(PARAMETERS).expect("friction is positive");
    let ode = OdeFn::new(5, |_: f64, state: &[f64], rates: &mut [f64]| {
        let (theta, omega) = ([state[0], state[1]], [state[2], state[3]]);
        let alpha = model.accelerations(&theta, &omega);
        let power = model.friction_power(&omega);
        rates.copy_from_slice(&[omega[0], omega[1], alpha[0], alpha[1], power]);
    });
    let start = State::new(0.0, vec![1.2, -0.7, 0.0, 0.0, 0.0]);
    let energy = |state: &[f64]| {
        let (theta, omega) = ([state[0], state[1]], [state[2], state[3]]);
        model.kinetic_energy(&theta, &omega) + model.potential_energy(&theta)
    };
    let method = Dop853::new(Options::with_tolerance(1e-12));
    let end = method.run(&ode, &start, 20.0).expect("a smooth motion");
    let lost = energy(&start.values) - energy(&end.state.values);
    assert!(lost > 0.3 * energy(&start.values), "{lost}");
    let error = lost + end.state.values[4];
    assert!(error.abs() < 1e-10 * lost, "{error:e}");
}

#[test]
fn taylor_series_agree_with_dop853() {
    let model = Chain::new(PARAMETERS).expect("friction is positive");
    let system = AbsoluteAngles(&model);
    let start = State::at_rest(0.0, &[1.2, -0.7]);
    let span = 10.0;
    let taylor = Taylor::new(Options::with_tolerance(1e-13));
    let taylor = taylor.run(&system, &start, span).expect("a smooth motion");
    let dop853 = Dop853::new(Options::with_tolerance(1e-13));
    let dop853 = dop853.run(&system, &start, span).expect("a smooth motion");
    for (a, b) in taylor.state.values.iter().zip(&dop853.state.values) {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }
}

/// A rod that a hand swings to and fro.
#[branched_pendulum(
    gravity = 9.80665,
    rod: rod(mass = 0.2, length = 0.3,
        friction(coulomb = 0.02, static = breakaway, stribeck = 1.5, width = 0.1)),
    prescribed(rod),
    emit(energies),
)]
struct Swung;

/// The loop that the torque of a hand describes against the angle has the area ∮ D dθ, which
/// is the work of friction by its law. The work grows with the static friction; if that equals
/// the Coulomb friction, the law is Coulomb's.
#[test]
fn the_loop_of_a_driven_joint_has_the_area_of_its_law() {
    let (width, pace, samples) = (0.4_f64, 5.0_f64, 4000);
    let period = 2.0 * PI / pace;
    let mut areas = Vec::new();
    for breakaway in [0.02, 0.03, 0.05] {
        let model = Swung::new(SwungParameters { breakaway }).expect("friction is positive");
        let (mut area, mut expected) = (0.0, 0.0);
        for sample in 0..samples {
            let time = period * f64::from(sample) / f64::from(samples);
            let (sine, cosine) = (pace * time).sin_cos();
            let (theta, omega) = ([width * sine], [width * pace * cosine]);
            let alpha = [-width * pace * pace * sine];
            let (_, [torque]) = model.accelerations_prescribed_rod(&theta, &omega, &[0.0], &alpha);
            area += torque * omega[0] * period / f64::from(samples);
            let rate = omega[0];
            let excess = (breakaway - 0.02) / (1.0 + (rate / 1.5).powi(2));
            let law = (0.02 + excess) * rate / rate.hypot(0.1);
            expected += law * rate * period / f64::from(samples);
            let power = model.friction_power(&omega);
            assert!((power + law * rate).abs() < 1e-15, "{power} {law}");
        }
        assert!((area - expected).abs() < 1e-13, "{area} {expected}");
        areas.push(area);
    }
    assert!(areas.is_sorted() && areas[2] > 1.2 * areas[0], "{areas:?}");
    // Sharp friction would take 4 C times the amplitude.
    assert!(
        (areas[0] / (4.0 * 0.02 * width) - 1.0).abs() < 0.05,
        "{areas:?}"
    );
}

/// Parameters are generic in the scalar: slopes by dual numbers are differences of the
/// accelerations of neighbouring models.
#[test]
fn parameters_have_slopes() {
    let mut random = Random::new(3);
    for state in 0..20 {
        let theta = [random.between(-3.0, 3.0), random.between(-3.0, 3.0)];
        let size = [5.0, 0.1][state % 2];
        let omega = [random.between(-size, size), random.between(-size, size)];
        let dual = |value: f64, tangent: f64| Dual {
            value,
            tangents: [tangent],
        };
        let with = |h: f64| {
            let model = Chain::new(ChainParameters {
                coulomb_arm: PARAMETERS.coulomb_arm + h,
                static_arm: PARAMETERS.static_arm - 2.0 * h,
                stribeck: PARAMETERS.stribeck + 3.0 * h,
                width: PARAMETERS.width - h,
                quadratic_hand: PARAMETERS.quadratic_hand + 2.0 * h,
                ..PARAMETERS
            });
            let model = model.expect("friction is positive");
            model.accelerations(&theta, &omega)
        };
        let model = Chain::<Dual<f64, 1>>::from_parameters_unchecked(ChainParameters {
            viscous_arm: dual(PARAMETERS.viscous_arm, 0.0),
            coulomb_arm: dual(PARAMETERS.coulomb_arm, 1.0),
            static_arm: dual(PARAMETERS.static_arm, -2.0),
            stribeck: dual(PARAMETERS.stribeck, 3.0),
            quadratic_arm: dual(PARAMETERS.quadratic_arm, 0.0),
            width: dual(PARAMETERS.width, -1.0),
            viscous_hand: dual(PARAMETERS.viscous_hand, 0.0),
            coulomb_hand: dual(PARAMETERS.coulomb_hand, 0.0),
            quadratic_hand: dual(PARAMETERS.quadratic_hand, 2.0),
        });
        let still = |values: [f64; 2]| values.map(|value| dual(value, 0.0));
        let found = model.accelerations(&still(theta), &still(omega));
        let h = 1e-5;
        let (above, below) = (with(h), with(-h));
        for link in 0..2 {
            let slope = (above[link] - below[link]) / (2.0 * h);
            let found = found[link].tangents[0];
            assert!(
                (found - slope).abs() < 1e-6 * (1.0 + slope.abs()),
                "{found} {slope}"
            );
        }
    }
}

macro_rules! crown {
    ($name:ident $(, $entry:ident($($inside:tt)*))*) => {
        #[branched_pendulum(
            gravity = 9.80665,
            trunk: rod(mass = 0.4, length = 0.5, friction(coulomb = 1e-3)) [
                arm(mass = 0.2, com = (0.1, 0.02), inertia = 1.5e-3, joint = (0.25, -0.03),
                    friction(viscous = 2e-3, coulomb = 4e-3, static = 7e-3, stribeck = 0.5,
                        quadratic = 1e-4, width = 0.2),
                    drag(quadratic = 3e-4)) [
                    hand: rod(mass = 0.05, length = 0.12,
                        friction(coulomb = 1e-4), drag(quadratic = 1e-5)) * 2
                ] * 2
            ],
            $($entry($($inside)*)),*
        )]
        struct $name;
    };
}

crown!(Crown, emit(symmetric, energies, forces, budget(parseval)));
crown!(CrownInPhase, in_phase(all), emit(transverse));

/// Weights of the sectors on trunk, arm 1 with its hands, arm 2 with its hands.
const WEIGHTS: [[f64; 7]; 2] = [
    [0.0, 1.0, 1.0, 1.0, -1.0, -1.0, -1.0],
    [0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0],
];

/// dD/dw of (A/s + q s) w, A = C + ΔC/(1 + (w/ϖ)²).
fn slope([coulomb, quadratic, width, excess, stribeck]: [f64; 5], rate: f64) -> f64 {
    let speed = rate.hypot(width);
    let sum = 1.0 + (rate / stribeck).powi(2);
    let fall = -2.0 * excess * rate / (stribeck * sum).powi(2);
    (coulomb + excess / sum) * width * width / speed.powi(3)
        + fall * rate / speed
        + quadratic * (speed + rate * rate / speed)
}

/// −Σ (c + D′) (rate of the joint)² + D⁰′ (rate of the link)² over the copies under one link.
fn power_by_hand(sector: usize, omega: &[f64; 3], rate: &[f64]) -> f64 {
    let [trunk, arm, hand] = *omega;
    let joints = [
        2e-3 + slope([4e-3, 1e-4, 0.2, 3e-3, 0.5], arm - trunk),
        slope([1e-4, 0.0, 0.01, 0.0, 1.0], hand - arm),
    ];
    let ground = [
        slope([0.0, 3e-4, 0.01, 0.0, 1.0], arm),
        slope([0.0, 1e-5, 0.01, 0.0, 1.0], hand),
    ];
    let of_arm = |arm: f64| 2.0 * (joints[0] + ground[0]) * arm * arm;
    let of_hands = |copies: f64, arm: f64, hand: f64| {
        copies * (joints[1] * (hand - arm).powi(2) + ground[1] * hand * hand)
    };
    match *rate {
        [arm, hand] if sector == 0 => -of_arm(arm) - of_hands(4.0, arm, hand),
        [hand] => -of_hands(2.0, 0.0, hand),
        _ => f64::NAN,
    }
}

/// The equations of small differences and the power of friction on them, against
/// derivatives of the whole tree's accelerations and powers.
#[test]
fn small_differences_agree_with_the_whole_tree() {
    let model = CrownInPhase::new();
    let whole = Crown::<Dual<f64, 1>>::default();
    let mut random = Random::new(11);
    let sectors = <CrownInPhase as Transverse<f64>>::TRANSVERSE;
    for (number, sector) in sectors.iter().enumerate() {
        for state in 0..100 {
            let around = |random: &mut Random, size: f64| -> [f64; 3] {
                std::array::from_fn(|_| random.between(-size, size))
            };
            let theta = around(&mut random, 3.0);
            let omega = around(&mut random, [5.0, 0.2, 0.01][state % 3]);
            let alpha = model.accelerations(&theta, &omega);
            let (difference, rate) = (around(&mut random, 1.0), around(&mut random, 5.0));
            let [difference, rate] = [&difference, &rate].map(|x| &x[..sector.links]);
            // Trunk, arm, hand of each link of the whole tree.
            let places = [0, 1, 2, 2, 1, 2, 2];
            let dual = |values: &[f64; 3], slopes: &[f64]| -> [Dual<f64, 1>; 7] {
                std::array::from_fn(|link| {
                    let place: usize = places[link];
                    let own = place
                        .checked_sub(sector.first)
                        .and_then(|own| slopes.get(own));
                    Dual {
                        value: values[place],
                        tangents: [own.map_or(0.0, |slope| slope * WEIGHTS[number][link])],
                    }
                })
            };
            let expected = whole.accelerations(&dual(&theta, difference), &dual(&omega, rate));
            let motion = InPhaseMotion {
                theta: &theta,
                omega: &omega,
                alpha: &alpha,
            };
            let mut found = vec![0.0; sector.links];
            model.transverse_accelerations_into(number, 0.0, motion, difference, rate, &mut found);
            let largest = expected
                .iter()
                .fold(1.0_f64, |most, alpha| most.max(alpha.tangents[0].abs()));
            for link in 0..7 {
                let own = places[link]
                    .checked_sub(sector.first)
                    .and_then(|own| found.get(own));
                let found = own.map_or(0.0, |found| found * WEIGHTS[number][link]);
                let error = (found - expected[link].tangents[0]).abs();
                assert!(
                    error < 1e-10 * largest,
                    "{}, {link}: {error:e}",
                    sector.name
                );
            }
            let found = model.transverse_friction_power_along(number, motion, rate);
            let expected = power_by_hand(number, &omega, rate);
            assert!(
                (found - expected).abs() < 1e-12 * expected.abs(),
                "{found} {expected}"
            );
            assert!(model.transverse_friction_power_of(number, rate).is_nan());
        }
    }
}

/// With the definition whose energies sum to H, the powers of all sectors sum to the power
/// of friction.
#[test]
fn powers_of_sectors_sum_to_the_power_of_friction() {
    let model = Crown::new();
    let mut random = Random::new(12);
    for state in 0..100 {
        let theta: [f64; 7] = std::array::from_fn(|_| random.between(-3.0, 3.0));
        let size = [5.0, 0.2, 0.01][state % 3];
        let omega: [f64; 7] = std::array::from_fn(|_| random.between(-size, size));
        let budget = model.budget_parseval(&theta, &omega);
        let total: f64 = budget.powers.iter().sum();
        let expected = model.friction_power(&omega);
        assert!(
            (total - expected).abs() < 1e-12 * expected.abs(),
            "{total} {expected}"
        );
    }
}
