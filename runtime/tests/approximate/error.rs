//! The errors that models tell of themselves, against those that they have.

use branched_pendulum::approximate::{Approximation, Linear};
use branched_pendulum::prelude::*;

use crate::scenes::{Free, Reed, Tree, branched};

/// Ratio of the estimate to the largest error of an angle in the second that follows.
fn ratio<P>(model: &P, linear: &Linear, start: &[f64]) -> f64
where
    P: Pendulum<f64>,
{
    let n = model.links();
    let mut frames = linear.frames(1.0 / 60.0).unwrap();
    let estimate = frames.error(start);
    let times: Vec<f64> = (1..=60).map(|frame| f64::from(frame) / 60.0).collect();
    let mut state = start.to_vec();
    let mut worst = 0.0_f64;
    let method = Dop853::new(Options::with_tolerance(1e-11));
    let start = State::new(0.0, start.to_vec());
    method
        .sample(&AbsoluteAngles(model), &start, &times, |_, full| {
            frames.step(&mut state);
            for (a, b) in full.iter().zip(&state).take(n) {
                worst = worst.max((a - b).abs());
            }
        })
        .unwrap();
    estimate / worst
}

/// Least and largest ratio over states in disorder, from 0.6 to 35 degrees.
fn ratios<P: Pendulum<f64>>(model: &P, linear: &Linear) -> (f64, f64) {
    let n = model.links();
    let mut seed = 1.0_f64;
    let mut number = || {
        seed = (seed + 0.618_033_988_749_895) % 1.0;
        2.0 * (seed * 97.0).fract() - 1.0
    };
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    for amplitude in [0.01, 0.05, 0.2, 0.4, 0.6] {
        for with_rates in [0.0, 4.0] {
            for _ in 0..3 {
                let angles = linear.equilibrium().iter();
                let mut start: Vec<f64> = angles.map(|rest| rest + amplitude * number()).collect();
                start.extend((0..n).map(|_| with_rates * amplitude * number()));
                let ratio = ratio(model, linear, &start);
                (least, most) = (least.min(ratio), most.max(ratio));
            }
        }
    }
    (least, most)
}

#[test]
fn estimates_are_near_the_errors() {
    fn check<P: Pendulum<f64>>(name: &str, model: &P, linear: &Linear) {
        let (least, most) = ratios(model, linear);
        assert!(least > 0.8 && most < 12.0, "{name}: {least} {most}");
    }
    let model = branched(1e-4);
    check(
        "branched",
        &model,
        &Linear::about(&model, &[0.0; 3]).unwrap(),
    );
    let model = Tree::new();
    check("tree", &model, &Linear::about(&model, &[0.0; 7]).unwrap());
    let model = Free::new();
    check("free", &model, &Linear::about(&model, &[0.0; 4]).unwrap());
    let model = Reed::new();
    check("reed", &model, &Linear::about(&model, &[0.1, 0.5]).unwrap());
}

/// About an equilibrium with two equal sides errors grow with the square of the
/// amplitude, relative to it; about others with the amplitude.
#[test]
fn estimates_grow_with_the_amplitude() {
    let growth = |linear: &Linear| {
        let frames = linear.frames(0.01).unwrap();
        let n = linear.equilibrium().len();
        let validity = |amplitude: f64| {
            let mut state: Vec<f64> = linear.equilibrium().iter().map(|a| a + amplitude).collect();
            state.extend(vec![0.0; n]);
            frames.validity(&state)
        };
        (validity(1e-2) / validity(1e-3)).log10()
    };
    let even = growth(&Linear::about(&branched(0.0), &[0.0; 3]).unwrap());
    let odd = growth(&Linear::about(&Reed::new(), &[0.1, 0.5]).unwrap());
    assert!(
        (even - 2.0).abs() < 0.05 && (odd - 1.0).abs() < 0.2,
        "{even} {odd}"
    );
}

#[test]
fn at_the_equilibrium_there_is_no_error() {
    let linear = Linear::about(&Tree::new(), &[0.0; 7]).unwrap();
    let frames = linear.frames(0.01).unwrap();
    assert_eq!(
        (frames.error(&[0.0; 14]), frames.validity(&[0.0; 14])),
        (0.0, 0.0)
    );
}
