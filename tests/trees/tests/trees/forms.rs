//! Forms of a described tree that it has as a model.

use branched_pendulum::integrate::Frames;
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::{Double, Scalar};
use branched_pendulum::system::{Action, CastAction, CastOde, PrescribedOde, UnderTorques};
use branched_pendulum_trees::{PendulumTree, TreeDescription};

use super::mechanics::{BENT, OMEGA, THETA, bent, near};

/// Rates in canonical variables are those of the motion in angles.
#[test]
fn canonical_rates_are_those_of_the_motion() {
    for tree in [bent(), bent().with("m", 0.3).unwrap()] {
        let momenta = tree.momenta(&THETA, &OMEGA);
        let (mut velocities, mut rates) = ([0.0; 5], [0.0; 5]);
        tree.canonical_rates_into(0.7, &THETA, &momenta, &mut velocities, &mut rates);
        for (own, omega) in velocities.iter().zip(OMEGA) {
            near(*own, omega, 1e-11);
        }
        // By central differences along the motion.
        let alpha = tree.accelerations(0.7, &THETA, &OMEGA);
        let step = 1e-5;
        let at = |side: f64| {
            let moved = |values: &[f64], rates: &[f64]| -> Vec<f64> {
                let pairs = values.iter().zip(rates);
                pairs
                    .map(|(value, rate)| value + side * step * rate)
                    .collect()
            };
            tree.momenta(&moved(&THETA, &OMEGA), &moved(&OMEGA, &alpha))
        };
        for ((more, less), rate) in at(1.0).iter().zip(at(-1.0)).zip(rates) {
            near((more - less) / (2.0 * step), rate, 1e-7);
        }
    }
    let mut answers = [[0.0; 5]; 2];
    let [q_rates, p_rates] = &mut answers;
    bent().canonical_rates_into(0.0, &THETA, &[0.0; 4], q_rates, p_rates);
    assert!(answers.as_flattened().iter().all(|rate| rate.is_nan()));
}

/// Many states in registers have the bits of each alone, whatever the form of the equations.
#[test]
fn batches_compute_what_one_state_computes() {
    let texts = [
        BENT,
        "gravity = 9.81, a: rod(mass = 0.1, length = m) [b: rod(mass = 0.2, length = 0.3) * 2]",
        "gravity = 9.81, tree: generations(count = 7, branching = 2, shape = rod, mass = m,
            length = 0.3, friction = 1e-3)",
        "gravity = 9.81, tree: generations(count = 4, branching = 2, shape = rod, mass = m,
            length = 0.3), siblings(tree_4, spring = 0.1, friction(coulomb = 0.01))",
        "gravity = 9.81, rod: rod(mass = m, length = 0.5), drive(torque = 0.03 * t, x = 0.5 * t^2)",
    ];
    for text in texts {
        let tree: PendulumTree = TreeDescription::parse(text)
            .unwrap()
            .tree(&[("m", 0.07)])
            .unwrap();
        let links = tree.links();
        let column = |link: usize, factor: f64| -> Vec<f64> {
            let number = |state: usize| (factor * (1 + link) as f64 + 0.1 * state as f64).sin();
            (0..21).map(number).collect()
        };
        let columns = |factor: f64| -> Vec<Vec<f64>> {
            (0..links).map(|link| column(link, factor)).collect()
        };
        let (theta, omega, torques) = (columns(1.3), columns(4.1), columns(0.7));
        let mut alpha = vec![vec![0.0; 21]; links];
        let mut under = alpha.clone();
        let mut batch = Batch::new(&tree);
        batch
            .accelerations(0.4, &theta, &omega, &mut alpha)
            .unwrap();
        let given = [&theta[..], &omega, &torques];
        batch.accelerations_under(0.4, given, &mut under).unwrap();
        for state in 0..21 {
            let row = |columns: &[Vec<f64>]| -> Vec<f64> {
                columns.iter().map(|column| column[state]).collect()
            };
            let (theta, omega, torques) = (row(&theta), row(&omega), row(&torques));
            let mut alone = vec![0.0; links];
            tree.accelerations_into(0.4, &theta, &omega, &mut alone);
            assert_eq!(row(&alpha), alone, "{text}");
            tree.accelerations_under_into(0.4, &theta, &omega, &torques, &mut alone);
            assert_eq!(row(&under), alone, "{text}");
        }
    }
}

/// Under torques, in double-double numbers and in frames.
#[test]
fn systems_of_a_tree_go_to_other_scalars() {
    let wind = |_: f64, _: &[f64], omega: &[f64], torques: &mut [f64]| {
        for (torque, omega) in torques.iter_mut().zip(omega) {
            *torque = 0.01 - 1e-3 * omega;
        }
    };
    let start = State::from_positions_and_velocities(0.0, &THETA, &OMEGA).unwrap();
    // Fixed steps have their order where friction does not jump.
    let text = BENT.replace("coulomb = 0.02, static = 0.03, stribeck = 0.8,", "");
    let text = text.replace("coulomb = 0.02, static = 0.05, stribeck = 0.3, ", "");
    assert!(!text.contains("coulomb"));
    let description = TreeDescription::parse(&text).unwrap();
    let smooth: PendulumTree = description.tree(&[("m", 0.07)]).unwrap();
    let pushed = UnderTorques::new(smooth, wind);
    let method = Dop853::new(Options::with_tolerance(1e-11));
    let end = method.run(&pushed, &start, 0.5);
    let end = end.unwrap().state;
    let steady = UnderTorques::of(bent(), Steady(0.02));
    let precise = steady.cast(Double::from_f64);
    let wide = start.values.iter().copied().map(Double::from_f64);
    let wide: Vec<Double> = wide.collect();
    let (mut rates, mut more) = ([0.0; 10], [Double::from_f64(0.0); 10]);
    steady.rates(0.3, &start.values, &mut rates);
    precise.rates(Double::from_f64(0.3), &wide, &mut more);
    for (rate, more) in rates.iter().zip(more) {
        near(*rate, more.high(), 1e-12);
    }
    let mut frames = Frames::new(pushed, &start, 1e-3).unwrap();
    for _ in 0..50 {
        frames.advance(0.01);
    }
    for (own, other) in frames.state().iter().zip(&end.values) {
        near(*own, *other, 1e-6);
    }
}

/// Trees whose constants alone would not tell them apart share no lanes: another drive, other
/// links that are held, another side that is up, another power of the distance.
#[test]
fn trees_that_differ_in_more_than_constants_share_no_lanes() {
    let tree = |gravity: f64, more: &str| {
        let rods = "a: rod(mass = 0.2, length = 0.3) [b: rod(mass = 0.1, length = 0.2)]";
        PendulumTree::parse(&format!("gravity = {gravity}, {rods}, {more}")).unwrap()
    };
    let start = State::at_rest(0.0, &[0.3, -0.2]);
    let method = Dop853::new(Options::with_tolerance(1e-9));
    let refused = |trees: [PendulumTree; 2]| {
        let releases = trees.map(|tree| (AbsoluteAngles(tree), start.clone()));
        let ends = Ensemble::new().integrate_models_in_lanes(&method, &releases, 0.5);
        assert!(ends[0].is_ok() && ends[1].is_err(), "{ends:?}");
    };
    let [sine, cosine] = ["sin", "cos"].map(|name| format!("drive(torque = 0.1 * {name}(3 * t))"));
    refused([tree(9.81, &sine), tree(9.81, &cosine)]);
    let lifted = "drive(y = 0.1 * sin(3 * t))";
    refused([tree(9.81, lifted), tree(-9.81, lifted)]);
    refused([tree(9.81, "prescribed(a)"), tree(9.81, "prescribed(b)")]);
    let [charge, magnet] = [1, 3].map(|exponent| {
        format!("guy(b, at = 0.2, to = (1, 0), repulsion = 1e-3, exponent = {exponent})")
    });
    refused([tree(9.81, &charge), tree(9.81, &magnet)]);
    // One tree, of which other sets are held.
    let tree = tree(9.81, "prescribed(a), prescribed(b)");
    let releases: Vec<_> = (0..2)
        .map(|set| (PrescribedOde::of(&tree, set, Still).unwrap(), start.clone()))
        .collect();
    let ends = Ensemble::new().integrate_models_in_lanes(&method, &releases, 0.5);
    assert!(ends[0].is_ok() && ends[1].is_err(), "{ends:?}");
}

/// Links that stay at an angle of 0.3 rad.
#[derive(Clone, Copy)]
struct Still;

impl<T: Scalar> Action<T> for Still {
    fn act(&self, _: T, _: &[T], _: &[T], values: &mut [T]) {
        values
            .as_chunks_mut()
            .0
            .fill([0.3, 0.0, 0.0].map(T::from_f64));
    }
}

impl<T: Scalar> CastAction<T> for Still {
    type Of<S: Scalar> = Still;

    fn cast<S: Scalar>(&self, _: impl Fn(T) -> S) -> Still {
        Still
    }
}

/// The same torque on all links.
#[derive(Clone, Copy)]
struct Steady<T>(T);

impl<T: Scalar> Action<T> for Steady<T> {
    fn act(&self, _: T, _: &[T], _: &[T], torques: &mut [T]) {
        torques.fill(self.0);
    }
}

impl<T: Scalar> CastAction<T> for Steady<T> {
    type Of<S: Scalar> = Steady<S>;

    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Steady<S> {
        Steady(convert(self.0))
    }
}

/// In lanes, trees of every form have the bits of single motions with constant steps, below and above
/// the number of links from which links are computed several at a time.
#[test]
fn motions_in_lanes_have_the_bits_of_single_ones() {
    let spring = ", spring = 0.02, friction = 1e-4";
    let law = ", friction(viscous = 1e-4, coulomb = 1e-3, width = 0.1)";
    let drive = "drive(torque = 0.1 * sin(3 * t))";
    let mut texts = vec![
        "gravity = 9.81, a: rod(mass = 0.1, length = 0.2) [b: rod(mass = 0.1, length = 0.2), c: rod(mass = 0.2, length = 0.1)], \
         between(a, b, spring = 0.1, friction = 1e-3)"
            .to_owned(),
    ];
    for generations in [1, 2, 3, 5, 6] {
        for (own, more) in [("", ""), (spring, ""), (law, ""), (spring, drive)] {
            texts.push(format!(
                "gravity = 9.81, rod: generations(count = {generations}, branching = 2, shape = rod, \
                 mass = 0.1, length = 0.2{own}), {more}"
            ));
        }
    }
    for text in texts {
        let tree = PendulumTree::parse(&text).unwrap_or_else(|error| panic!("{error}"));
        let links = tree.links() as u32;
        let start = |number: u32| {
            let angles = (0..links).map(|link| 0.3 + 0.1 * f64::from((7 * link + number) % 11));
            State::at_rest(0.0, &angles.collect::<Vec<f64>>())
        };
        let starts: Vec<State<f64>> = (0..5).map(start).collect();
        let (method, system) = (Rk4::new(1e-2), AbsoluteAngles(&tree));
        let ends = Ensemble::new().integrate_in_lanes(&method, &system, &starts, 0.2);
        for (start, end) in starts.iter().zip(ends) {
            let alone = method.run(&system, start, 0.2).unwrap().state;
            assert_eq!(end.unwrap().state, alone, "{text}");
        }
    }
}

/// The fastest method in lanes: Taylor series for few links at tight tolerances.
#[test]
fn the_choice_in_lanes_knows_size_and_tolerance() {
    let choice = |generations: u32, tolerance: f64| {
        let tree = PendulumTree::parse(&format!(
            "gravity = 9.81, rod: generations(count = {generations}, branching = 2, shape = rod, \
             mass = 0.1, length = 0.2)"
        ));
        Method::for_lanes(&AbsoluteAngles(tree.unwrap()), tolerance)
    };
    assert_eq!(choice(3, 1e-10), Method::Taylor);
    assert_eq!(choice(3, 1e-9), Method::Verner98);
    assert_eq!(choice(4, 1e-12), Method::Verner98);
    assert_eq!(choice(3, 1e-4), Method::Dop853);
}
