//! Small differences beside in-phase motions, against the whole tree.

use std::f64::consts::PI;

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Dual;
use branched_pendulum::system::{InPhaseMotion, TransverseOde, TransverseSector};
use branched_pendulum::{Transverse, WholeTree};
use branched_pendulum_compiler_tests::random::Random;

/// One tree, whole and in phase.
macro_rules! crown {
    ($name:ident $(, $entry:ident($($inside:tt)*))*) => {
        #[branched_pendulum(
            gravity = 9.80665,
            trunk: rod(mass = 0.4, length = 0.5, friction = 1e-3)[
                arm(mass = 0.2, com = (0.1, 0.02), inertia = 1.5e-3, joint = (0.25, -0.03),
                    friction = 2e-3, drag = 3e-3)[
                    hand: rod(mass = 0.05, length = 0.12, spring = 4e-3, rest = 0.2,
                        friction = 1e-4) * 3,
                    finger(mass = 0.03, com = (0.04, 0.01), inertia = 2e-5, joint = 0.08,
                        at = (0.2, 0.04), drag = 1e-4)[
                        nail: rod(mass = 0.01, length = 0.03, drag = 1e-6)
                    ] * 2
                ] * 2
            ],
            siblings(arm, spring = 0.05, friction = 1e-3),
            siblings(hand, spring = 2e-3, friction(coulomb = 1e-4, quadratic = 1e-5, width = 20)),
            siblings(finger, spring = 1e-3, friction(viscous = 1e-5, quadratic = 1e-6, width = 20)),
            drive(torque = 0.05 * sin(3 * t), x = 0.01 * cos(5 * t)),
            $($entry($($inside)*)),*
        )]
        struct $name;
    };
}
pub(super) use crown;

crown!(Crown, emit(energies));
crown!(InPhase, in_phase(all), emit(transverse, energies));
crown!(ArmsInPhase, in_phase(arm), emit(transverse));

/// Weight of each link of [`Crown`] in a difference of a sector, by the numbers of its
/// copies: those of the first holder.
fn weights(sector: &TransverseSector) -> Vec<f64> {
    let link = |name: &str| -> (String, Vec<usize>) {
        let mut words = name.split('_');
        let node = words.next().expect("a name").to_owned();
        (
            node,
            words.map(|word| word.parse().expect("a number")).collect(),
        )
    };
    let names = Crown::LINK_NAMES.iter();
    let weight = |name: &&str| {
        let (node, copies) = link(name);
        match (sector.name, node.as_str(), copies.as_slice()) {
            ("arm", "arm" | "hand" | "finger" | "nail", [arm, ..]) => [1.0, -1.0][arm - 1],
            ("hand", "hand", [1, hand]) => [1.5_f64.sqrt(), -1.5_f64.sqrt(), 0.0][hand - 1],
            ("finger", "finger" | "nail", [1, finger]) => [1.0, -1.0][finger - 1],
            _ => 0.0,
        }
    };
    names.map(weight).collect()
}

const WHOLE: usize = 17;

struct Sample {
    theta: Vec<f64>,
    omega: Vec<f64>,
    alpha: Vec<f64>,
    difference: Vec<f64>,
    rate: Vec<f64>,
}

impl Sample {
    fn new<M: Pendulum<f64>>(model: &M, sector: &TransverseSector, random: &mut Random) -> Self {
        let theta = random.around_zero(model.links(), PI);
        let omega = random.around_zero(model.links(), 5.0);
        let mut alpha = vec![0.0; model.links()];
        model.accelerations_into(0.7, &theta, &omega, &mut alpha);
        Self {
            theta,
            omega,
            alpha,
            difference: random.around_zero(sector.links, 1.0),
            rate: random.around_zero(sector.links, 5.0),
        }
    }

    fn motion(&self) -> InPhaseMotion<'_, f64> {
        InPhaseMotion {
            theta: &self.theta,
            omega: &self.omega,
            alpha: &self.alpha,
        }
    }
}

/// The accelerations of the motion in phase and those of the differences, formed together.
fn together<M: Transverse<f64>>(model: &M, number: usize, sample: &Sample) -> Vec<f64> {
    let mut both = vec![0.0; model.links() + sample.difference.len()];
    let motion = [&sample.theta[..], &sample.omega];
    let differences = [&sample.difference[..], &sample.rate];
    model.transverse_motion_into(number, 0.7, motion, differences, &mut both);
    both
}

/// The derivative of the whole tree's accelerations along the difference, by dual
/// numbers, is the second derivative of the difference times the weights.
fn agrees_with_the_whole_tree<M: Transverse<f64>>(model: &M, tree: WholeTree) -> Vec<&'static str> {
    let whole = Crown::<Dual<f64, 1>>::default();
    let mut random = Random::new(11);
    for (number, sector) in M::TRANSVERSE.iter().enumerate() {
        let weights = weights(sector);
        assert!(weights.iter().any(|weight| *weight != 0.0));
        let mut places = Vec::new();
        tree.for_each(|link, _| places.push(link));
        for _ in 0..100 {
            let sample = Sample::new(model, sector, &mut random);
            let dual = |values: &[f64], slopes: &[f64]| -> [Dual<f64, 1>; WHOLE] {
                std::array::from_fn(|link| {
                    let place = places[link];
                    let slope = place
                        .checked_sub(sector.first)
                        .and_then(|own| slopes.get(own))
                        .map_or(0.0, |slope| slope * weights[link]);
                    Dual {
                        value: values[place],
                        tangents: [slope],
                    }
                })
            };
            let theta = dual(&sample.theta, &sample.difference);
            let omega = dual(&sample.omega, &sample.rate);
            let expected = whole.accelerations(Dual::from_f64(0.7), &theta, &omega);
            let mut found = vec![0.0; sector.links];
            model.transverse_accelerations_into(
                number,
                0.7,
                sample.motion(),
                &sample.difference,
                &sample.rate,
                &mut found,
            );
            let largest = expected
                .iter()
                .fold(0.0_f64, |m, x| m.max(x.tangents[0].abs()));
            let both = together(model, number, &sample);
            for (own, other) in both.iter().zip(sample.alpha.iter().chain(&found)) {
                assert!(
                    (own - other).abs() <= 1e-12 * largest.max(other.abs()),
                    "{own} {other}"
                );
            }
            for (link, expected) in expected.iter().enumerate() {
                let own = places[link].checked_sub(sector.first);
                let found = own
                    .and_then(|own| found.get(own))
                    .map_or(0.0, |x| x * weights[link]);
                let error = (found - expected.tangents[0]).abs();
                assert!(
                    error <= 1e-10 * largest,
                    "{}, {link}: {error:e}",
                    sector.name
                );
            }
        }
    }
    M::TRANSVERSE.iter().map(|sector| sector.name).collect()
}

#[test]
fn differences_are_those_of_the_whole_tree() {
    let all = agrees_with_the_whole_tree(&InPhase::new(), InPhase::WHOLE);
    assert_eq!(all, ["arm", "hand", "finger"]);
    let arms = agrees_with_the_whole_tree(&ArmsInPhase::new(), ArmsInPhase::WHOLE);
    assert_eq!(arms, ["arm"]);
}

/// Kinetic energy against that of the whole tree, where the differences alone move;
/// the rate of the energy along the motion, by dual numbers.
#[test]
fn energies_and_transfers() {
    let (model, whole) = (InPhase::new(), Crown::new());
    let wide = InPhase::<Dual<f64, 1>>::default();
    let mut random = Random::new(12);
    for (number, sector) in <InPhase as Transverse<f64>>::TRANSVERSE.iter().enumerate() {
        let weights = weights(sector);
        for _ in 0..100 {
            let sample = Sample::new(&model, sector, &mut random);
            let Sample {
                theta,
                omega,
                difference,
                rate,
                ..
            } = &sample;
            let mut whole_theta = [0.0; WHOLE];
            InPhase::WHOLE
                .angles(theta, &mut whole_theta)
                .expect("all links");
            let mut spread = vec![0.0; theta.len()];
            spread[sector.first..sector.first + sector.links].copy_from_slice(rate);
            let mut whole_rate = [0.0; WHOLE];
            InPhase::WHOLE
                .velocities(&spread, &mut whole_rate)
                .expect("all links");
            for (rate, weight) in whole_rate.iter_mut().zip(&weights) {
                *rate *= weight;
            }
            let still = vec![0.0; sector.links];
            let kinetic = model.transverse_energy_of(number, theta, &still, rate);
            let expected = whole.kinetic_energy(&whole_theta, &whole_rate);
            assert!(
                (kinetic - expected).abs() <= 1e-12 * expected,
                "{}",
                sector.name
            );

            let mut second = vec![0.0; sector.links];
            let motion = sample.motion();
            model.transverse_accelerations_into(number, 0.7, motion, difference, rate, &mut second);
            let dual = |values: &[f64], slopes: &[f64]| -> Vec<Dual<f64, 1>> {
                let pairs = values.iter().zip(slopes);
                let pair = |(&value, &slope): (&f64, &f64)| Dual {
                    value,
                    tangents: [slope],
                };
                pairs.map(pair).collect()
            };
            let energy = wide.transverse_energy_of(
                number,
                &dual(theta, omega),
                &dual(difference, rate),
                &dual(rate, &second),
            );
            let transfer = model.transverse_transfer_of(number, 0.7, motion, difference, rate);
            let friction = model.transverse_friction_power_of(number, rate);
            assert!(friction < 0.0);
            let error = (energy.tangents[0] - transfer - friction).abs();
            let size = transfer.abs() + friction.abs() + energy.value;
            assert!(error <= 1e-11 * size, "{}: {error:e}", sector.name);
        }
    }
}

/// Differences of a sector at the end of the span, which were 1.
fn differences<M: Transverse<f64>>(model: &M, sector: usize, start: &[f64], span: f64) -> Vec<f64> {
    let ode = TransverseOde::new(model, sector).expect("a sector");
    let links = ode.differences();
    let mut angles = start.to_vec();
    angles.extend(vec![1.0; links]);
    let method = Dop853::new(Options::with_tolerance(1e-12));
    let end = method
        .run(&ode, &State::at_rest(0.0, &angles), span)
        .expect("a regular motion");
    end.state.positions()[start.len()..].to_vec()
}

/// Asserts that differences of the whole tree, small at first, end as those of the
/// linear equations. `pattern` has the weight of each link of the whole tree.
fn grows_alike<M: Transverse<f64>, W: Pendulum<f64>>(
    (model, whole): (&M, &W),
    tree: WholeTree,
    sector: usize,
    start: &[f64],
    pattern: &[f64],
) {
    const SIZE: f64 = 1e-5;
    let linear = differences(model, sector, start, 10.0);
    let mut angles = vec![0.0; tree.links()];
    tree.angles(start, &mut angles).expect("all links");
    for (angle, weight) in angles.iter_mut().zip(pattern) {
        *angle += SIZE * weight;
    }
    let method = Dop853::new(Options::with_tolerance(1e-13));
    let end = method
        .run(&AbsoluteAngles(whole), &State::at_rest(0.0, &angles), 10.0)
        .expect("a regular motion");
    let first = M::TRANSVERSE[sector].first;
    let mut places = Vec::new();
    tree.for_each(|link, _| places.push(link));
    let largest = linear.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
    for (own, expected) in linear.iter().enumerate() {
        // Half the difference between the two signs.
        let of = |sign: f64| -> f64 {
            let links = places.iter().zip(pattern).zip(end.state.positions());
            let mut links = links.filter(|((place, e), _)| **place == first + own && **e == sign);
            *links.next().expect("a copy of that sign").1
        };
        let found = 0.5 * (of(1.0) - of(-1.0)) / SIZE;
        let error = (found - expected).abs() / largest;
        assert!(
            error < 1e-5,
            "{sector}, {own}: {found} {expected}, {error:e}"
        );
    }
}

macro_rules! paper {
    ($name:ident $(, $entry:ident($($inside:tt)*))*) => {
        #[branched_pendulum(
            gravity = 9.80665,
            parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
                child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
            ],
            $($entry($($inside)*)),*
        )]
        struct $name;
    };
}
pub(super) use paper;

paper!(Paper);
paper!(PaperInPhase, in_phase(child), emit(transverse));

/// Below, in and above the tongue of instability, 10 s.
#[test]
fn the_antiphase_mode_grows_as_in_the_whole_pendulum() {
    let models = (&PaperInPhase::new(), &Paper::new());
    for degrees in [20.0_f64, 39.5, 43.5, 44.5, 46.3] {
        let start = [degrees.to_radians(), 0.0];
        grows_alike(models, PaperInPhase::WHOLE, 0, &start, &[0.0, 1.0, -1.0]);
    }
}

macro_rules! fifteen {
    ($name:ident $(, $entry:ident($($inside:tt)*))*) => {
        #[branched_pendulum(
            gravity = 9.80665,
            tree: generations(count = 4, branching = 2, shape = rod, mass = 0.3, length = 0.4,
                mass_ratio = 0.5, length_ratio = 0.7),
            $($entry($($inside)*)),*
        )]
        struct $name;
    };
}
pub(super) use fifteen;

fifteen!(Fifteen);
fifteen!(FifteenInPhase, in_phase(tree), emit(transverse));

#[test]
fn every_sector_of_fifteen_links_grows_as_in_the_whole_tree() {
    let models = (&FifteenInPhase::new(), &Fifteen::new());
    for (sector, known) in <FifteenInPhase as Transverse<f64>>::TRANSVERSE
        .iter()
        .enumerate()
    {
        assert_eq!(known.name, format!("tree_{}", sector + 2));
        assert_eq!((known.copies, known.holders), (2, 1 << sector));
        let names = Fifteen::LINK_NAMES.iter();
        let weight = |name: &&str| {
            let numbers: Vec<usize> = name.split('_').filter_map(|n| n.parse().ok()).collect();
            // Its generation, then the number of each copy on the way to it.
            match numbers[1..].get(sector) {
                Some(copy) if numbers[1..=sector].iter().all(|&n| n == 1) => [1.0, -1.0][copy - 1],
                _ => 0.0,
            }
        };
        let pattern: Vec<f64> = names.map(weight).collect();
        for angle in [0.2, 0.6] {
            grows_alike(models, FifteenInPhase::WHOLE, sector, &[angle; 4], &pattern);
        }
    }
}
