//! The energy of the linear model: that of the full one to second order, kept without
//! friction, and told by modes.

use branched_pendulum::approximate::{Approximation, Linear};

use crate::scenes::{Free, branched};

#[test]
fn without_friction_the_energy_stays() {
    let linear = Linear::about(&Free::new(), &[0.0; 4]).unwrap();
    let mut frames = linear.frames(1.0 / 60.0).unwrap();
    let mut state = [0.1, -0.2, 0.3, 0.1, 1.0, -1.0, 0.0, 2.0];
    let start = linear.energy(&state);
    frames.set_state(&state);
    // An hour, each frame of which may round once.
    let hour = 60 * 3600;
    for _ in 0..hour {
        frames.advance();
    }
    frames.state_into(&mut state);
    let change = linear.energy(&state) / start - 1.0;
    assert!(change.abs() < f64::from(hour) * f64::EPSILON, "{change:e}");
}

#[test]
fn friction_takes_and_never_gives() {
    let linear = Linear::about(&branched(1e-3), &[0.0; 3]).unwrap();
    let mut frames = linear.frames(1.0 / 60.0).unwrap();
    let mut state = [0.1, -0.2, 0.3, 1.0, -1.0, 0.5];
    let mut before = linear.energy(&state);
    for _ in 0..1000 {
        frames.step(&mut state);
        let energy = linear.energy(&state);
        assert!(energy < before);
        before = energy;
    }
}

#[test]
fn the_energy_is_that_of_the_full_model_to_second_order() {
    let model = Free::new();
    let linear = Linear::about(&model, &[0.0; 4]).unwrap();
    let error = |size: f64| {
        let theta = [0.1, -0.2, 0.3, 0.1].map(|angle: f64| size * angle);
        let omega = [1.0, -1.0, 0.0, 2.0].map(|rate: f64| size * rate);
        let full = model.kinetic_energy(&theta, &omega) + model.potential_energy(&theta);
        let linear = linear.energy(&[theta, omega].concat());
        (linear / full - 1.0).abs()
    };
    assert!(error(1e-3) < 1e-6);
    let order = (error(0.1) / error(0.01)).log10();
    assert!((order - 2.0).abs() < 0.1, "{order}");
}

#[test]
fn modes_that_are_dropped_tell_their_energy() {
    let linear = Linear::about(&Free::new(), &[0.0; 4]).unwrap();
    let frequencies = linear.frequencies_hz();
    let state = [0.1, -0.2, 0.3, 0.1, 1.0, -1.0, 0.0, 2.0];
    let mut parts = Vec::new();
    for kept in 0..=4 {
        let highest = if kept == 0 {
            0.0
        } else {
            frequencies[kept - 1]
        };
        let slow = linear.truncate(highest);
        let frames = slow.frames::<f64>(0.01).unwrap();
        assert_eq!((slow.frequencies_hz().len(), frames.modes()), (kept, kept));
        assert_eq!(slow.energy(&state), linear.energy(&state));
        parts.push(slow.dropped_energy(&state));
        // Where all is dropped, nothing is right; where nothing is, the full linear
        // model's error is left.
        let validity = frames.validity(&state);
        assert!((kept == 0) == (validity == 1.0), "{validity}");
    }
    assert!((parts[0] / linear.energy(&state) - 1.0).abs() < 1e-14);
    assert!(
        parts.is_sorted_by(|a, b| a > b) && parts[4] == 0.0,
        "{parts:?}"
    );
    // What is kept moves as it does with the others: there is no friction here.
    let (mut full, mut slow) = (
        linear.frames(0.01).unwrap(),
        linear.truncate(frequencies[1]).frames(0.01).unwrap(),
    );
    let mut state = state;
    let mut kept = state;
    slow.set_state(&state);
    slow.state_into(&mut kept);
    for _ in 0..100 {
        full.step(&mut state);
        slow.step(&mut kept);
    }
    slow.set_state(&state);
    let mut expected = [0.0; 8];
    slow.state_into(&mut expected);
    for (kept, expected) in kept.iter().zip(expected) {
        assert!((kept - expected).abs() < 1e-12, "{kept} {expected}");
    }
}
