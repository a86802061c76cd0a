//! Limits in which the result is known: one rod, and a pivot that moves up and down.

use branched_pendulum::analysis::normal_form::{
    MotionSubspace, NormalForm, NormalFormOptions, Resonance, Tongues,
};
use branched_pendulum::prelude::*;
use branched_pendulum_trees::PendulumTree;

use super::{children, unchecked};

/// Product of two series with equally many terms.
fn product(one: &[f64], other: &[f64]) -> Vec<f64> {
    let term = |n: usize| (0..=n).map(|k| one[k] * other[n - k]).sum();
    (0..one.len()).map(term).collect()
}

/// Coefficients of ω/ω₀ by powers of J/(ω₀ I), from complete elliptic integrals: with x = sin²(A/2)
/// ω/ω₀ = π/2K and J = 8 ω₀ I/π · (E − (1 − x) K).
fn elliptic(terms: usize) -> Vec<f64> {
    let mut squares = vec![1.0];
    for n in 1..=terms {
        let n = n as f64;
        squares.push(squares[squares.len() - 1] * ((2.0 * n - 1.0) / (2.0 * n)).powi(2));
    }
    let first: Vec<f64> = squares[..terms].to_vec();
    let second = |n: usize| squares[n] / (1.0 - 2.0 * n as f64);
    let action: Vec<f64> = (0..terms)
        .map(|n| 4.0 * (second(n) - squares[n] + if n > 0 { squares[n - 1] } else { 0.0 }))
        .collect();
    let mut frequency = vec![1.0];
    for n in 1..terms {
        let sum: f64 = (1..=n).map(|k| first[k] * frequency[n - k]).sum();
        frequency.push(-sum);
    }
    let mut coefficients = Vec::new();
    let mut power: Vec<f64> = (0..terms).map(|n| f64::from(u8::from(n == 0))).collect();
    for n in 0..terms {
        let own = frequency[n] / power[n];
        for (left, term) in frequency.iter_mut().zip(&power) {
            *left -= own * term;
        }
        coefficients.push(own);
        power = product(&power, &action);
    }
    coefficients
}

#[test]
fn a_rod_has_the_expansion_of_the_elliptic_integral() {
    let tree = PendulumTree::parse("gravity = 9.81, rod: rod(mass = 2, length = 0.5)").unwrap();
    let known = elliptic(6);
    assert!((known[1] + 0.125).abs() < 1e-15, "{known:?}");
    for (order, degree) in [4, 6, 8, 10, 12].into_iter().enumerate() {
        let options = unchecked(degree);
        let form = NormalForm::new(&tree, &[0.0], &MotionSubspace::whole(1), options).unwrap();
        let linear = form.linear_frequencies_hz()[0];
        let unit = std::f64::consts::TAU * linear * tree.mass_matrix(&[0.0])[0][0];
        // The highest degree adds one power of the action.
        let [own] = form.frequencies_hz(&[unit])[..] else {
            panic!()
        };
        let coefficient = (own.value - own.before) / linear;
        let error = coefficient / known[order + 1] - 1.0;
        assert!(error.abs() < 1e-12, "{degree}: {coefficient} {known:?}");
    }
}

/// ω = ω₀ agm(1, cos(A/2)), through the action of a release.
#[test]
fn a_rod_has_the_frequency_of_its_amplitude() {
    let tree = PendulumTree::parse("gravity = 9.81, rod: rod(mass = 2, length = 0.5)").unwrap();
    for degree in [4, 8, 12] {
        let options = unchecked(degree);
        let form = NormalForm::new(&tree, &[0.0], &MotionSubspace::whole(1), options).unwrap();
        for amplitude in [0.05, 0.1, 0.2, 0.4_f64] {
            let (mut a, mut b) = (1.0, (0.5 * amplitude).cos());
            for _ in 0..8 {
                (a, b) = (0.5 * (a + b), (a * b).sqrt());
            }
            let exact = form.linear_frequencies_hz()[0] * a;
            let predicted = form.predict(&[amplitude], &[0.0]).unwrap().frequencies_hz[0];
            let error = (predicted.value / exact - 1.0).abs();
            // What is left is of the order of the first degree left out.
            let left_out = (0.5 * amplitude).powi(degree as i32);
            assert!(error < left_out + 1e-14, "{degree}, {amplitude}: {error:e}");
        }
    }
}

/// A heavy parent with its mass below the pivot and its joint beside it moves the pivot of the
/// children up and down, y = L A cos Ωt. Their difference obeys Mathieu's equation
/// δ̈ + ω² (1 + ε cos Ωt) δ = 0 with ε = L A Ω²/g, whose first tongue is |Ω − 2ω| < εω/2, with
/// the rate εω/4 in the middle.
#[test]
fn a_heavy_parent_leaves_mathieus_first_tongue() {
    let gravity = 9.81;
    let (joint, com, mass) = (0.2, 0.05, 0.1);
    // Of the children, rad/s, and of the parent near twice of it.
    let own = 7.0;
    // Inertia about the centre of mass, for a frequency.
    let inertia = |mass: f64, com: f64, frequency: f64| {
        mass * com * (gravity / (frequency * frequency) - com)
    };
    let tree = |parent: f64| {
        let (heavy, below) = (1e8, 0.01);
        let text = format!(
            "gravity = {gravity},
             parent(mass = {heavy}, com = {below}, inertia = {}, joint = (0, {joint})) [
                 child(mass = {mass}, com = {com}, inertia = {}) * 2 ]",
            inertia(heavy, below, parent),
            inertia(mass, com, own),
        );
        PendulumTree::parse(&text).unwrap()
    };
    let amplitude = 0.01;
    let start = State::at_rest(0.0, &[amplitude, 0.0, 0.0]);
    let predict = |parent: f64| {
        let options = NormalFormOptions {
            degree: 6,
            ..NormalFormOptions::default()
        };
        tree(parent)
            .normal_form(&children(), options)
            .unwrap()
            .predict(&start)
    };
    let epsilon = joint * amplitude * (2.0 * own).powi(2) / gravity;
    let width = 0.5 * epsilon * own;
    let samples: Vec<f64> = (-20..=20)
        .map(|k| 2.0 * own + 0.1 * width * f64::from(k))
        .collect();
    // In phase the children obey the same equation: below this rate their detuning is zero.
    let least = 0.01 * 0.25 * epsilon * own;
    let found = Tongues::along(&samples, least, predict);
    let [tongue] = found.tongues.as_slice() else {
        panic!("{found:?}")
    };
    let [from, to] = tongue.edges.map(|edge| edge.value);
    assert!(
        ((to - from) / (2.0 * width) - 1.0).abs() < 0.01,
        "{from} {to} {width}"
    );
    let rate = tongue.largest.growth_rate.value;
    assert!(
        (rate / (0.25 * epsilon * own) - 1.0).abs() < 0.01,
        "{rate} {}",
        0.25 * epsilon * own
    );
    let pump = Resonance {
        in_phase: vec![0, 1],
        differences: vec![-2],
    };
    assert_eq!(tongue.resonance(), Some(&pump));
}
