//! Frames in real time.

use branched_pendulum::Pendulum;
use branched_pendulum::integrate::{Frames, InputError, longest_sub_step};
use branched_pendulum::prelude::*;
use branched_pendulum::system::{Computes, OdeFn, UnderTorques, functions};

use crate::scenes::{Branched, Free, Tree, branched};

/// The classical Runge–Kutta method is stable for all decaying rates of a size up to
/// 2.61.
#[test]
fn sub_steps_are_far_within_the_limit_of_stability() {
    let growth = |real: f64, imaginary: f64| {
        let oscillator = OdeFn::new(2, |_: f64, y: &[f64], rates: &mut [f64]| {
            rates[0] = real * y[0] - imaginary * y[1];
            rates[1] = imaginary * y[0] + real * y[1];
        });
        let start = State::new(0.0, vec![0.1, 0.0]);
        let mut frames = Frames::new(&oscillator, &start, 1.0).unwrap();
        frames.advance(1.0);
        10.0 * frames.state()[0].hypot(frames.state()[1])
    };
    for angle in 0..=90 {
        let (sine, cosine) = f64::from(angle).to_radians().sin_cos();
        for size in [0.5, 1.0, 2.0, 2.61] {
            assert!(growth(-size * cosine, size * sine) <= 1.0, "{angle} {size}");
        }
    }
    assert!(growth(-1.45, 2.2) > 1.0 && growth(-2.8, 0.0) > 1.0);
}

/// Sub-steps that nothing limits are steps of the method itself, to the last bit.
#[test]
fn sub_steps_are_those_of_the_runge_kutta_method() {
    let swing = OdeFn::new(2, |time: f64, y: &[f64], rates: &mut [f64]| {
        rates[0] = y[1];
        rates[1] = 0.1 * time - 9.0 * y[0].sin() - 0.01 * y[1];
    });
    let start = State::new(0.5, vec![0.7, -0.3]);
    let mut frames = Frames::new(&swing, &start, 0.03).unwrap();
    // Frames of as many sub-steps each.
    let mut stepper = Rk4::new(0.03).start(&swing, &start).unwrap();
    for frame in 1..=20 {
        frames.set_state(stepper.time(), stepper.state()).unwrap();
        frames.advance(0.03);
        stepper.step().unwrap();
        assert_eq!(frames.state(), stepper.state(), "{frame}");
    }
    assert_eq!(frames.limited(), 0);
}

/// The bound is not below the rates at any angles that were not looked at.
#[test]
fn the_sub_step_knows_springs_and_friction() {
    #[branched_pendulum(
        gravity = 0,
        reed: rod(mass = 0.1, length = 0.1, spring = spring, friction = friction)
    )]
    struct Oscillator;
    let inertia = 0.1 * 0.1 * 0.1 / 3.0;
    for (spring, friction) in [(30.0, 0.0), (0.0, 1.0), (30.0, 1.0), (0.0, 0.0)] {
        let model = Oscillator::new(OscillatorParameters { spring, friction }).unwrap();
        let (square, half): (f64, f64) = (spring / inertia, 0.5 * friction / inertia);
        let expected = (1.0 / (half + (half * half + square).sqrt())).min(0.01);
        let found: f64 = longest_sub_step(&model);
        assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
    }
    // Two and a half times as long, it is still stable.
    let model = Oscillator::new(OscillatorParameters {
        spring: 30.0,
        friction: 1.0,
    })
    .unwrap();
    let step: f64 = longest_sub_step(&model);
    for (factor, stable) in [(2.5, true), (3.0, false)] {
        let start = State::at_rest(0.0, &[1e-6]);
        let mut frames = Frames::new(AbsoluteAngles(&model), &start, factor * step).unwrap();
        (0..1000).for_each(|_| frames.advance(factor * step));
        assert_eq!(frames.state()[0].abs() < 1e-6, stable, "{factor}");
    }
}

/// The same second at 30, 60 and 144 frames, and at the tolerance of an adaptive method.
#[test]
fn motion_does_not_depend_on_the_rate_of_frames() {
    let model = Tree::new();
    let start = State::at_rest(0.0, &[0.8, 0.3, 0.5, 1.0, 0.4, 0.1, 0.2]);
    let method = Dop853::new(Options::with_tolerance(1e-11));
    let exact = method.run(&AbsoluteAngles(&model), &start, 1.0).unwrap();
    fn second<T: Real, P: Pendulum<T>>(model: &P, angles: &[f64], rate: u32) -> Vec<f64> {
        let angles: Vec<T> = angles.iter().map(|&angle| T::from_f64(angle)).collect();
        let start = State::at_rest(T::ZERO, &angles);
        let sub_step = longest_sub_step(model);
        let mut frames = Frames::new(AbsoluteAngles(model), &start, sub_step).unwrap();
        (0..rate).for_each(|_| frames.advance(T::from_f64(1.0 / f64::from(rate))));
        assert!((frames.time() - 1.0).abs() < 1e-7);
        assert_eq!(frames.limited(), 0);
        frames.state().iter().map(|value| value.to_f64()).collect()
    }
    let single = Tree::<f32>::default();
    for rate in [30, 60, 144] {
        let states = [
            second::<f64, _>(&model, start.positions(), rate),
            second::<f32, _>(&single, start.positions(), rate),
        ];
        for state in states {
            for (found, exact) in state.iter().zip(&exact.state.values).take(7) {
                assert!((found - exact).abs() < 5e-4, "{rate}: {found} {exact}");
            }
        }
    }
}

fn energy<T: Real, P: Energy<T>>(model: &P, state: &[T]) -> f64 {
    let (theta, omega) = state.split_at(model.links());
    (model.kinetic_energy_of(theta, omega) + model.potential_energy_of(theta)).to_f64()
}

/// Wild motion without friction, for ten minutes in both precisions: where rates are
/// limited energy is lost, and none comes from nowhere.
#[test]
fn energy_does_not_rise_by_itself() {
    fn highest<T: Real, P: Energy<T>>(model: &P, lift: f64, share: f64) -> f64 {
        let angles: Vec<T> = (0..model.links()).map(|_| T::from_f64(lift)).collect();
        let start = State::at_rest(T::ZERO, &angles);
        let step = T::from_f64(share) * longest_sub_step(model);
        let mut frames = Frames::new(AbsoluteAngles(model), &start, step).unwrap();
        let first = energy(model, frames.state());
        let mut highest = 0.0_f64;
        for _ in 0..36_000 {
            frames.advance(T::from_f64(1.0 / 60.0));
            highest = highest.max(energy(model, frames.state()) / first);
        }
        highest
    }
    for lift in [1.5, 3.0] {
        for highest in [
            highest::<f64, _>(&Free::new(), lift, 1.0),
            highest::<f32, _>(&Free::<f32>::default(), lift, 1.0),
            highest::<f64, _>(&branched(0.0), lift, 1.0),
            // Without the limit of a hundredth of a second.
            highest::<f64, _>(&Free::new(), lift, 1.5),
        ] {
            assert!(highest < 1.0001, "{lift}: {highest}");
        }
    }
}

/// Hits of any size, of finite and other torques, in both precisions.
#[test]
fn no_hit_makes_a_state_that_is_not_finite() {
    fn hit<T: Real, P: Energy<T> + Computes<functions::AccelerationsUnderTorques, T>>(model: &P) {
        let start = State::at_rest(T::ZERO, &[T::from_f64(0.1); 3]);
        let step = longest_sub_step(model);
        for torque in [1.0, 1e3, 1e6, 1e30, 3e38, f64::INFINITY, f64::NAN] {
            for link in 0..3 {
                let mut frames =
                    Frames::new(UnderTorques::of(model, vec![T::ZERO; 3]), &start, step).unwrap();
                frames.ode_mut().torques_mut()[link] = T::from_f64(torque);
                for frame in 0..120 {
                    if frame == 10 {
                        frames.ode_mut().torques_mut()[link] = T::ZERO;
                    }
                    frames.advance(T::from_f64(1.0 / 60.0));
                    assert!(frames.state().iter().all(|value| value.is_finite()));
                    let rates = frames.state().iter().skip(3);
                    let largest = rates.fold(T::ZERO, |size, rate| size.max(rate.abs()));
                    assert!(largest <= frames.largest_rate() * T::from_f64(1.000_001));
                }
                assert!(frames.limited() > 0 || torque < 1e3);
            }
        }
    }
    hit::<f64, _>(&branched(1e-4));
    hit::<f32, _>(&branched(1e-4).cast(|value: f64| value as f32));
}

#[test]
fn frames_that_are_none_change_nothing_and_long_ones_are_cut() {
    let model: Branched = branched(0.0);
    let start = State::at_rest(0.0, &[0.5, 0.2, 0.1]);
    let mut frames = Frames::new(AbsoluteAngles(&model), &start, 0.005).unwrap();
    for duration in [0.0, -1.0, f64::NAN, f64::NEG_INFINITY] {
        frames.advance(duration);
        assert_eq!((frames.time(), frames.state()), (0.0, &start.values[..]));
    }
    frames.advance(f64::INFINITY);
    assert_eq!(frames.time(), 1.0);
    assert!(matches!(
        frames.set_state(0.0, &[f64::NAN; 6]),
        Err(InputError::StartValue { component: 0, .. })
    ));
    assert!(matches!(
        frames.set_state(0.0, &[0.0; 3]),
        Err(InputError::Dimension {
            expected: 6,
            found: 3
        })
    ));
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = Frames::new(AbsoluteAngles(&model), &start, step);
        assert!(matches!(
            refused,
            Err(InputError::Step {
                name: "longest",
                ..
            })
        ));
    }
}
