//! Truncated forms of W are what they say: their error falls with the order of
//! their first missing term, and orders that must vanish do.

use branched_pendulum_compiler_tests::random::Random;

use crate::support::{Compiled, compile};

const PAIR: &str = "gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ],
    emit(transfer(angle = 1, angle = 2, angle = 3, angle = 4, amplitude = 2, amplitude = 3,
        amplitude = 4, amplitude = 6, amplitude = 8, exact))";

const TRIPLE: &str = "gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 3
    ],
    emit(transfer(amplitude = 2, amplitude = 3, amplitude = 4, amplitude = 5, exact))";

/// In-phase states with sizes as in the paper's experiment, and unit
/// directions of the differences and their momenta.
struct State {
    q: Vec<f64>,
    p: Vec<f64>,
}

fn states(differences: usize, count: usize) -> Vec<State> {
    let mut random = Random::new(11);
    (0..count)
        .map(|_| {
            let mut q = vec![random.between(-1.0, 1.0), random.between(-2.0, 2.0)];
            let mut p = vec![random.between(-0.08, 0.08), random.between(-0.02, 0.02)];
            for _ in 0..differences {
                q.push(random.between(-1.0, 1.0));
                p.push(random.between(-8e-3, 8e-3));
            }
            State { q, p }
        })
        .collect()
}

impl State {
    fn scaled(&self, angles: f64, momenta: f64) -> (Vec<f64>, Vec<f64>) {
        let scale = |values: &[f64], factor: f64| -> Vec<f64> {
            let part = |(i, x): (usize, &f64)| if i < 2 { *x } else { factor * x };
            values.iter().enumerate().map(part).collect()
        };
        (scale(&self.q, angles), scale(&self.p, momenta))
    }
}

/// rms over states of the difference between two forms of W.
fn rms(scene: &Compiled, states: &[State], forms: [&str; 2], angles: f64, momenta: f64) -> f64 {
    let squares = states.iter().map(|state| {
        let (q, p) = state.scaled(angles, momenta);
        let total = |form: &str| scene.evaluate(form, &[&q, &p]).iter().sum::<f64>();
        (total(forms[0]) - total(forms[1])).powi(2)
    });
    (squares.sum::<f64>() / states.len() as f64).sqrt()
}

/// log2 of the factor by which halving ε reduces the error of a form.
fn fall(scene: &Compiled, states: &[State], forms: [&str; 2], epsilon: f64, fixed: bool) -> f64 {
    let momenta = |epsilon: f64| if fixed { 1.0 } else { epsilon };
    let coarse = rms(scene, states, forms, epsilon, momenta(epsilon));
    let fine = rms(scene, states, forms, epsilon / 2.0, momenta(epsilon / 2.0));
    (coarse / fine).log2()
}

/// Between two copies odd orders vanish: the error of order N is of order N+2.
#[test]
fn amplitude_orders_of_a_pair() {
    let scene = compile(PAIR);
    let states = states(1, 60);
    // Where the error of the form is well above rounding.
    for (order, epsilon) in [(2, 0.02), (4, 0.05), (6, 0.1), (8, 0.1)] {
        let form = format!("transfer_amplitude_{order}");
        let fall = fall(&scene, &states, [&form, "transfer_exact"], epsilon, false);
        let expected = f64::from(order + 2);
        assert!((fall - expected).abs() < 0.1, "order {order}: {fall}");
    }
}

/// Two derivations of one result: order 3 comes from the series of the
/// velocities, order 2 from Poisson brackets, and the third order vanishes.
#[test]
fn series_and_brackets_agree() {
    let scene = compile(PAIR);
    let states = states(1, 60);
    let forms = ["transfer_amplitude_3", "transfer_amplitude_2"];
    let size = rms(
        &scene,
        &states,
        ["transfer_exact", "transfer_amplitude_8"],
        0.5,
        0.5,
    );
    assert!(size > 0.0);
    let difference = rms(&scene, &states, forms, 0.5, 0.5);
    let scale = states
        .iter()
        .map(|state| {
            let (q, p) = state.scaled(0.5, 0.5);
            let parts = scene.evaluate("transfer_amplitude_2", &[&q, &p]);
            parts.iter().map(|w| w.abs()).sum::<f64>()
        })
        .fold(0.0, f64::max);
    assert!(difference < 1e-13 * scale, "{difference} of {scale}");
}

/// Between three copies there are odd orders too.
#[test]
fn amplitude_orders_of_a_triple() {
    let scene = compile(TRIPLE);
    let states = states(2, 200);
    for place in ["_d1", "_d2"] {
        for (order, epsilon) in [(2, 0.01), (3, 0.02), (4, 0.03), (5, 0.05)] {
            let form = format!("transfer_amplitude_{order}{place}");
            let exact = format!("transfer_exact{place}");
            let fall = fall(&scene, &states, [&form, &exact], epsilon, false);
            let expected = f64::from(order + 1);
            assert!((fall - expected).abs() < 0.2, "{form}: {fall}");
        }
    }
}

/// With the momenta untouched, K through order n leaves an error of order n in
/// its slope, and so in W.
#[test]
fn angle_orders_of_a_pair() {
    let scene = compile(PAIR);
    let states = states(1, 60);
    for order in 1..=4 {
        let form = format!("transfer_angle_{order}");
        let fall = fall(&scene, &states, [&form, "transfer_exact"], 0.01, true);
        assert!((fall - f64::from(order)).abs() < 0.1, "{form}: {fall}");
    }
}
