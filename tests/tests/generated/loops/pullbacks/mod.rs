//! Derivatives in reverse mode of trees in loops: in 31 digits against tangents of the same tree,
//! against the transposed program of the same tree written out, and against the tree at run time.

mod forms;

use branched_pendulum::Parametric;
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::{Double, Dual, Real, Scalar};
use branched_pendulum::system::functions::AccelerationsUnderTorquesPullback as Under;
use branched_pendulum::system::{At, Computes, Model, Workspace, functions};
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_trees::TreeDescription;

/// A tree in loops, the same one written out, and its text.
macro_rules! differentiated {
    ($loops:ident, $unrolled:ident, $text:ident: $($tree:tt)*) => {
        #[branched_pendulum(code = loops, emit(forces, gradient(accelerations)), $($tree)*)]
        struct $loops;

        #[branched_pendulum(code = unrolled, emit(forces, gradient(accelerations)), $($tree)*)]
        struct $unrolled;

        const $text: &str = stringify!($($tree)*);
    };
}

// All laws of friction, springs, lines and a guy, with children at several places.
differentiated!(TableLoops, TableUnrolled, TABLE:
    gravity = g,
    trunk(mass = m, com = (0.1, c), inertia = 1e-3, joint = l, spring = k, rest = 0.1 * g,
        friction(viscous = f, coulomb = b, static = 2 * b, stribeck = 3 * w, quadratic = f,
            width = w), drag = 0.1 * f) [
        arm(mass = 0.1 * m, com = (0.1, 0.01), inertia = 1e-3, joint = (0.2, 0.02 * l), spring = 0.01,
            at = (0.3 * l, c), friction(coulomb = 1e-2), drag(viscous = f, quadratic = b, width = 0.3)) [
            hand: rod(mass = 0.04, length = l / 2),
        ] * 2,
        tail: point(mass = 0.03 / m, length = 0.3, friction = f / 10),
    ],
    siblings(arm, spring = 2 * k, friction(viscous = f, coulomb = 0.1 * b, width = w)),
    siblings(arm, at = (0.15, c), spring = 5, rest = 0.1 * l, friction = f),
    between(hand_1, hand_2, at = 0.2 * l, repulsion = 1e-3 * b, exponent = 3),
    between(tail, hand_2, spring = 0.05, rest = -0.3 * l),
    between(trunk, tail, at = each((0.1, 0.1), 0.2 * l), spring = 2 * k),
    guy(hand_1, at = l / 3, to = (0.5, -l), spring = k, rest = 0.1 * l, friction = 0.1 * f),
    drive(torque = 0.4 * b * cos(3 * w * t))
);
// Generations with offsets, a drive that moves the pivot, and runs of siblings.
differentiated!(RuleLoops, RuleUnrolled, RULE:
    gravity = 9.8 * g,
    tree: generations(count = 3, branching = 2, mass = m, com = (0.1 * l, c), inertia = 1e-3,
        joint = (l, 0.1 * c), mass_ratio = 0.5, length_ratio = r,
        friction(viscous = f, coulomb = 0.1 * f), spring = k),
    siblings(tree_2, spring = 0.3 * k),
    siblings(tree_3, spring = 0.02, friction(viscous = 1e-3, quadratic = 0.1 * f, width = 0.2)),
    between(tree_1, tree_3_2_1, spring = 0.1, rest = 0.4 * r),
    drive(torque = 0.4 * b * cos(3 * t), x = 0.2 * b * sin(5 * w * t), y = 0.1 * cos(4 * w * t))
);
// A tree without friction and springs that stands and is shaken.
differentiated!(StandingLoops, StandingUnrolled, STANDING:
    gravity = -g,
    trunk: rod(mass = m, length = l) [
        arm(mass = 0.1, com = (0.1 * l, c), inertia = 1e-3, joint = 0.2) [
            hand: point(mass = 0.04, length = l / 2) * 2,
        ],
    ],
    drive(x = 0.2 * b * sin(5 * w * t), y = 0.1 * b * cos(4 * w * t))
);
/// A rule whose code is loops because it has many links.
#[branched_pendulum(
    gravity = g,
    tree: generations(count = 6, branching = 2, shape = rod, mass = m, length = l, mass_ratio = 0.5,
        length_ratio = r, friction = f),
    siblings(tree_6, spring = k),
    emit(forces, gradient(accelerations)),
)]
struct Large;

const LARGE: &str = "gravity = g, tree: generations(count = 6, branching = 2, shape = rod, mass = m, \
    length = l, mass_ratio = 0.5, length_ratio = r, friction = f), siblings(tree_6, spring = k)";

/// A rule that is computed in blocks.
#[branched_pendulum(
    gravity = g,
    tree: generations(count = 14, branching = 2, shape = rod, mass = m, length = l, mass_ratio = 0.5,
        length_ratio = r, friction(viscous = 1e-4, coulomb = 1e-4)),
    emit(forces, gradient(accelerations)),
)]
struct Blocks;

/// Arguments and weights of a pullback.
struct Point<T> {
    time: T,
    theta: Vec<T>,
    omega: Vec<T>,
    torques: Vec<T>,
    weights: Vec<T>,
}

impl<T: Copy> Point<T> {
    fn random(links: usize, random: &mut Random) -> Point<f64> {
        Point {
            time: random.between(-3.0, 3.0),
            theta: random.around_zero(links, 2.0),
            omega: random.around_zero(links, 3.0),
            torques: random.around_zero(links, 0.3),
            weights: random.around_zero(links, 1.0),
        }
    }

    fn map<S>(&self, convert: impl Fn(T) -> S) -> Point<S> {
        let all = [&self.theta, &self.omega, &self.torques, &self.weights];
        let all = all.map(|own| own.iter().map(|&value| convert(value)).collect());
        let [theta, omega, torques, weights] = all;
        Point {
            time: convert(self.time),
            theta,
            omega,
            torques,
            weights,
        }
    }

    /// The point for a model with the links in another order.
    fn in_order(&self, order: &[usize]) -> Self {
        Self {
            time: self.time,
            theta: in_order(&self.theta, order),
            omega: in_order(&self.omega, order),
            torques: in_order(&self.torques, order),
            weights: in_order(&self.weights, order),
        }
    }

    /// Derivatives by angles, angular velocities, torques and parameters.
    fn pulled_back<M>(&self, model: &M, parameters: usize) -> [Vec<T>; 4]
    where
        T: Scalar,
        M: Computes<Under, T>,
    {
        let nan = T::from_f64(f64::NAN);
        let links = vec![nan; self.theta.len()];
        let mut slopes = [links.clone(), links.clone(), links, vec![nan; parameters]];
        let given: [&[T]; 4] = [&self.theta, &self.omega, &self.torques, &self.weights];
        let [by_theta, by_omega, by_torques, by_parameters] = &mut slopes;
        Computes::<Under, T>::compute_with(
            model,
            &mut Workspace::new(),
            At::time(self.time),
            &given,
            &mut [by_theta, by_omega, by_torques, by_parameters],
        );
        slopes
    }
}

type On<P, S> = <P as Model<f64>>::Of<S>;
type Tangent = Dual<Double, 1>;

fn double(value: f64) -> Double {
    Double::from_f64(value)
}

fn sum(terms: impl IntoIterator<Item = Double>) -> Double {
    terms.into_iter().fold(double(0.0), |sum, term| sum + term)
}

fn product(a: &[Double], b: &[f64]) -> Double {
    sum(a.iter().zip(b).map(|(&a, &b)| a * double(b)))
}

/// Largest difference of two lists, relative to the largest number.
fn apart<T: Real>(found: &[T], expected: &[T]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let size = expected
        .iter()
        .fold(0.0_f64, |size, value| size.max(value.to_f64().abs()));
    let pairs = found.iter().zip(expected);
    let errors = pairs.map(|(&found, &expected)| {
        assert!(found.is_finite());
        (found - expected).to_f64().abs()
    });
    let largest = errors.fold(0.0, f64::max);
    if largest == 0.0 { 0.0 } else { largest / size }
}

/// Compares ⟨w, J v⟩ by tangents with ⟨Jᵀ w, v⟩ for random v and w; returns the largest error relative
/// to the sum of the sizes of all terms.
fn against_tangents<P>(random: &mut Random, states: usize) -> f64
where
    P: Parametric<f64>,
    On<P, Double>: Computes<Under, Double>,
    On<P, Tangent>: Computes<functions::AccelerationsUnderTorques, Tangent>,
{
    let parameters = P::PARAMETERS.len();
    let mut worst = 0.0_f64;
    for _ in 0..states {
        let values: Vec<f64> = (0..parameters).map(|_| random.between(0.6, 1.4)).collect();
        let model = P::with_parameters(|index| double(values[index]));
        let links = model.links();
        let point = Point::<f64>::random(links, random);
        let directions = [links, links, links, parameters];
        let directions = directions.map(|length| random.around_zero(length, 1.0));

        let dual = |value: f64, tangent: f64| Dual {
            value: double(value),
            tangents: [double(tangent)],
        };
        let moved = |values: &[f64], tangents: &[f64]| -> Vec<Tangent> {
            let pairs = values.iter().zip(tangents);
            pairs
                .map(|(&value, &tangent)| dual(value, tangent))
                .collect()
        };
        let [by_theta, by_omega, by_torques, by_parameters] = &directions;
        let varied = P::with_parameters(|index| dual(values[index], by_parameters[index]));
        let mut alpha = vec![dual(f64::NAN, f64::NAN); links];
        varied.accelerations_under_into(
            dual(point.time, 0.0),
            &moved(&point.theta, by_theta),
            &moved(&point.omega, by_omega),
            &moved(&point.torques, by_torques),
            &mut alpha,
        );
        let tangents: Vec<Double> = alpha.iter().map(|own| own.tangents[0]).collect();
        let forward = product(&tangents, &point.weights);
        let slopes = point.map(double).pulled_back(&model, parameters);
        let backward = slopes.iter().zip(&directions);
        let backward: Vec<Double> = backward.map(|(own, by)| product(own, by)).collect();
        let sizes = backward.iter().chain([&forward]);
        let size: f64 = sizes.map(|own| own.to_f64().abs()).sum();
        let error = (forward - sum(backward)).to_f64().abs() / size;
        assert!(error.is_finite(), "{error} of {size}");
        worst = worst.max(error);
    }
    worst
}

#[test]
fn pullbacks_are_transposed_tangents() {
    let mut random = Random::new(41);
    let worst = [
        against_tangents::<TableLoops>(&mut random, 50),
        against_tangents::<RuleLoops>(&mut random, 50),
        against_tangents::<StandingLoops>(&mut random, 50),
        against_tangents::<Large>(&mut random, 50),
        against_tangents::<Blocks>(&mut random, 1),
    ];
    println!("{worst:?}");
    assert!(worst.iter().all(|own| *own < 1e-24), "{worst:?}");
}

fn name_of<T: Scalar>(model: &impl Model<T>, link: usize) -> String {
    model.link_name(link).expect("a link").to_string()
}

fn in_order<T: Copy>(values: &[T], order: &[usize]) -> Vec<T> {
    order.iter().map(|&place| values[place]).collect()
}

/// Compares the derivatives of a tree in loops with those of the tree at run time and, if it is given,
/// of code written out. Returns the largest error in 31 digits, and that of the derivatives in `f64`.
fn against_others<P, U>(random: &mut Random, text: &str) -> [f64; 2]
where
    P: Parametric<f64>,
    U: Parametric<f64>,
    On<P, f64>: Computes<Under, f64>,
    On<P, Double>: Computes<Under, Double>,
    On<U, Double>: Computes<Under, Double>,
{
    let names = P::PARAMETERS;
    assert_eq!(U::PARAMETERS, names);
    let description = TreeDescription::parse(text).expect(text);
    let listed: Vec<&str> = description.parameters().collect();
    assert_eq!(listed, names);
    let [mut worst, mut of_rounding] = [0.0_f64; 2];
    for _ in 0..20 {
        let values: Vec<f64> = names.iter().map(|_| random.between(0.6, 1.4)).collect();
        let named = names.iter().copied().zip(values.iter().copied());
        let named: Vec<(&str, f64)> = named.collect();
        let tree = description.tree::<Double>(&named).expect(text);
        let loops = P::with_parameters(|index| double(values[index]));
        let plain = P::with_parameters(|index| values[index]);
        let unrolled = U::with_parameters(|index| double(values[index]));
        let links = loops.links();
        let point = Point::<f64>::random(links, random);
        let found = point.map(double).pulled_back(&loops, names.len());
        let rounded = point.pulled_back(&plain, names.len());
        for (rounded, found) in rounded.iter().zip(&found) {
            let found: Vec<f64> = found.iter().map(|own| own.to_f64()).collect();
            of_rounding = of_rounding.max(apart(rounded, &found));
        }

        let by_name = |name: &dyn Fn(usize) -> String| {
            let own: Vec<String> = (0..links).map(|link| name_of(&loops, link)).collect();
            let find = |name| own.iter().position(|other| *other == name);
            let places = (0..links).map(|link| find(name(link)).expect("the same links"));
            places.collect::<Vec<usize>>()
        };
        let of_tree = by_name(&|link| name_of(&tree, link));
        let other = point.in_order(&of_tree).map(double);
        let slopes = tree.pullback().accelerations_pullback(
            other.time,
            [&other.theta, &other.omega],
            Some(&other.torques),
            &other.weights,
        );
        let at_run_time = [
            slopes.theta,
            slopes.omega,
            slopes.torques,
            slopes.parameters,
        ];
        let of_code = by_name(&|link| name_of(&unrolled, link));
        let other = point.in_order(&of_code).map(double);
        let written_out = other.pulled_back(&unrolled, names.len());
        for (order, expected) in [(of_tree, at_run_time), (of_code, written_out)] {
            let [theta, omega, torques, parameters] = &found;
            let own = [theta, omega, torques].map(|own| in_order(own, &order));
            for (found, expected) in own.iter().chain([parameters]).zip(&expected) {
                worst = worst.max(apart(found, expected));
            }
        }
    }
    [worst, of_rounding]
}

#[test]
fn pullbacks_agree_with_code_written_out_and_with_trees_at_run_time() {
    let mut random = Random::new(43);
    let errors = [
        against_others::<TableLoops, TableUnrolled>(&mut random, TABLE),
        against_others::<RuleLoops, RuleUnrolled>(&mut random, RULE),
        against_others::<StandingLoops, StandingUnrolled>(&mut random, STANDING),
        // 63 links take long to derive one by one.
        against_others::<Large, Large>(&mut random, LARGE),
    ];
    println!("{errors:?}");
    for [worst, of_rounding] in errors {
        assert!(worst < 1e-24, "{worst:e}");
        assert!(of_rounding < 1e-12, "{of_rounding:e}");
    }
}
