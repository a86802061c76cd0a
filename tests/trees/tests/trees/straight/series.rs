//! Taylor coefficients with straight springs, repulsions and dampers.

use branched_pendulum::ensemble::Ensemble;
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::{Double, Scalar};
use branched_pendulum::system::TaylorPendulum;
use branched_pendulum::taylor::Quad;
use branched_pendulum_trees::{PendulumTree, TreeDescription};

use super::super::plain::Numbers;
use super::{GUYED, StraightTree};

/// Order to which motions are expanded.
const ORDER: usize = 10;

/// Largest difference between the slope of the velocities' polynomials at a time and the
/// accelerations there.
fn residual(tree: &PendulumTree<Double>, coefficients: &[Double], time: f64) -> f64 {
    let links = tree.links();
    let time = Double::from_f64(time);
    let zero = Double::from_f64(0.0);
    let at = |first: usize| -> Vec<Double> {
        let place = |order: usize, link: usize| coefficients[2 * links * order + first + link];
        let value = |link| {
            let orders = (0..=ORDER).rev();
            orders.fold(zero, |sum, order| sum * time + place(order, link))
        };
        (0..links).map(value).collect()
    };
    let slope = |link: usize| {
        let orders = (1..=ORDER).rev();
        orders.fold(zero, |sum, order| {
            let own = coefficients[2 * links * order + links + link];
            sum * time + Double::from_f64(order as f64) * own
        })
    };
    let accelerations = tree.accelerations(time, &at(0), &at(links));
    let differences = accelerations.iter().enumerate();
    let differences = differences.map(|(link, own)| (*own - slope(link)).high().abs());
    differences.fold(0.0, f64::max)
}

/// The polynomials satisfy the equation of motion up to the power of the time that is left out: half
/// the time leaves a thousandth of the difference.
#[test]
fn coefficients_satisfy_the_equation_of_motion() {
    let mut numbers = Numbers(23);
    for _ in 0..100 {
        let text = StraightTree::random(&mut numbers).text(true);
        let description = TreeDescription::parse(&text).unwrap();
        let tree: PendulumTree<Double> = description.tree(&[]).unwrap();
        let links = tree.links();
        let mut state = |range: f64| -> Vec<Double> {
            let links = 0..links;
            links
                .map(|_| Double::from_f64(numbers.between(-range, range)))
                .collect()
        };
        let (theta, omega) = (state(3.0), state(6.0));
        let zero = Double::from_f64(0.0);
        let mut coefficients = vec![zero; 2 * links * (ORDER + 1)];
        let mut work = vec![Quad([zero; 4]); tree.taylor_workspace(ORDER)];
        tree.taylor_coefficients_into(zero, &theta, &omega, &mut coefficients, &mut work);
        // A fifth of the time in which the terms grow to one size.
        let rows = coefficients.chunks(2 * links).enumerate().skip(1);
        let fastest = rows.fold(0.0_f64, |fastest, (order, row)| {
            let size = row
                .iter()
                .fold(0.0_f64, |size, own| size.max(own.high().abs()));
            fastest.max(size.powf(1.0 / order as f64))
        });
        let [whole, half] = [0.2, 0.1].map(|part| residual(&tree, &coefficients, part / fastest));
        // Rounding of these numbers, of 106 bits.
        let rounding = 1e-27 * fastest * fastest;
        assert!(
            half < 4e-3 * whole + rounding && whole < 1e-5 * fastest * fastest,
            "{half:e} {whole:e} {fastest}: {text}"
        );
    }
}

/// A motion by series is that of a method that needs accelerations alone, in lanes as well, and the
/// energy stays.
#[test]
fn motions_by_series_are_those_by_accelerations() {
    let braked = GUYED.replace("rest = 0.3)", "rest = 0.3, friction = 0.2)");
    for (text, keeps) in [(GUYED, true), (braked.as_str(), false)] {
        let tree = PendulumTree::parse(text).unwrap();
        let links = tree.links();
        let start: Vec<f64> = (0..2 * links)
            .map(|place| (1.0 + place as f64).sin())
            .collect();
        let start = State::new(0.0, start);
        let system = AbsoluteAngles(&tree);
        let series = Taylor::new(Options::with_tolerance(1e-14));
        let method = Dop853::new(Options::with_tolerance(1e-14));
        let [by_series, by_accelerations] = [
            series.run(&system, &start, 1.0),
            method.run(&system, &start, 1.0),
        ]
        .map(|end| end.unwrap().state.values);
        for (one, other) in by_series.iter().zip(&by_accelerations) {
            assert!((one - other).abs() < 1e-9, "{one} {other}: {text}");
        }
        let cases = vec![(AbsoluteAngles(&tree), start.clone()); 5];
        for end in Ensemble::new().integrate_models_in_lanes(&series, &cases, 1.0) {
            let end = end.unwrap().state.values;
            for (one, other) in by_series.iter().zip(&end) {
                assert!((one - other).abs() < 1e-9, "{one} {other}: {text}");
            }
        }
        if keeps {
            let energy = |state: &State<f64>| tree.energy_of(state.positions(), state.velocities());
            let end = series.run(&system, &start, 10.0).unwrap().state;
            let drift = (energy(&end) - energy(&start)).abs();
            assert!(drift < 1e-10, "{drift:e}");
        }
    }
}

/// Where the ends of a line meet nothing is known of its direction.
#[test]
fn points_that_meet_have_no_coefficients() {
    let text = "gravity = 9.81, rod: rod(mass = 1, length = 0.5),
        guy(rod, at = 0.5, to = (0, -0.5), spring = 3, rest = 0.1)";
    let tree = PendulumTree::parse(text).unwrap();
    let mut coefficients = [0.0; 8];
    let mut work = vec![Quad([0.0; 4]); tree.taylor_workspace(3)];
    tree.taylor_coefficients_into(0.0, &[0.0], &[0.0], &mut coefficients, &mut work);
    assert!(
        coefficients[4..].iter().all(|own| own.is_nan()),
        "{coefficients:?}"
    );
}
