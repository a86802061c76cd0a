//! Events: found to rounding, in order, each once; by every method.

use core::f64::consts::{FRAC_PI_2, PI};

use branched_pendulum::integrate::{Crossing, Event};
use branched_pendulum::prelude::*;

use crate::problems::{Problem, harmonic, watch};

/// y = cos t, y' = −sin t.
fn start() -> State<f64> {
    State::at_rest(0.0, &[1.0])
}

fn dop853() -> Dop853<f64> {
    Dop853::new(Options::with_tolerance(1e-13))
}

/// Times, with the direction, of the crossings of a function on [`harmonic`].
fn crossings(
    method: &impl Integrator<f64, dyn Ode<f64>>,
    end: f64,
    event: Event<'_, f64>,
) -> Vec<(f64, bool)> {
    let mut found = Vec::new();
    let ode: &dyn Ode<f64> = &harmonic();
    method
        .integrate_with_events(ode, &start(), end, &[event], |crossing| {
            found.push((crossing.time, crossing.rising));
            ControlFlow::Continue(())
        })
        .unwrap();
    found
}

fn assert_crossings(found: &[(f64, bool)], expected: &[(f64, bool)], tolerance: f64) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!(
            (found.0 - expected.0).abs() < tolerance,
            "{found:?} {expected:?}"
        );
        assert_eq!(found.1, expected.1);
    }
}

#[test]
fn every_method_finds_the_zeros_of_a_cosine() {
    let position = |_time: f64, y: &[f64]| y[0];
    let event = || Event::new(Crossing::Either, &position);
    let zeros: Vec<_> = (0..6)
        .map(|k| (FRAC_PI_2 + PI * f64::from(k), k % 2 == 1))
        .collect();
    let options = || Options::with_tolerance(1e-13);
    assert_crossings(&crossings(&dop853(), 18.0, event()), &zeros, 1e-12);
    assert_crossings(
        &crossings(&Dopri5::new(options()), 18.0, event()),
        &zeros,
        1e-11,
    );
    assert_crossings(
        &crossings(&Verner98::new(options()), 18.0, event()),
        &zeros,
        1e-12,
    );
    assert_crossings(&crossings(&Rk4::new(1e-3), 18.0, event()), &zeros, 1e-11);
    let gauss = Gauss::new(GaussOrder::Eight, 0.02);
    assert_crossings(&crossings(&gauss, 18.0, event()), &zeros, 1e-10);
}

#[test]
fn directions() {
    let position = |_time: f64, y: &[f64]| y[0];
    let falling = crossings(&dop853(), 9.0, Event::new(Crossing::Falling, &position));
    assert_crossings(
        &falling,
        &[(FRAC_PI_2, false), (5.0 * FRAC_PI_2, false)],
        1e-12,
    );
    let rising = crossings(&dop853(), 9.0, Event::new(Crossing::Rising, &position));
    assert_crossings(&rising, &[(3.0 * FRAC_PI_2, true)], 1e-12);
    // Backwards the cosine falls first too.
    let back = crossings(&dop853(), -5.0, Event::new(Crossing::Falling, &position));
    assert_crossings(&back, &[(-FRAC_PI_2, false)], 1e-12);
}

#[test]
fn a_zero_is_located_to_rounding() {
    let clock = |time: f64, _y: &[f64]| time - 2.0_f64.sqrt();
    let found = crossings(&dop853(), 5.0, Event::new(Crossing::Rising, &clock));
    let [(time, true)] = found[..] else {
        panic!("{found:?}");
    };
    // Behind the zero, and next to it.
    let zero = 2.0_f64.sqrt();
    assert!(time >= zero && time <= zero.next_up(), "{time:e}");
}

#[test]
fn several_events_in_one_step_come_in_order() {
    let late = |time: f64, _y: &[f64]| time - 0.31;
    let early = |time: f64, _y: &[f64]| time - 0.29;
    // Two zeros of one function, between two others.
    let twice = |time: f64, _y: &[f64]| (time - 0.295) * (time - 0.305);
    let events = [
        Event::new(Crossing::Either, &late),
        Event::new(Crossing::Either, &twice).with_checks(200),
        Event::new(Crossing::Either, &early),
    ];
    let options = Options {
        initial_step: Some(1.0),
        ..Options::with_tolerance(1e-3)
    };
    let straight = Problem::new(1, |_time: f64, _y: &[f64], rates: &mut [f64]| {
        rates[0] = 1.0
    });
    let mut found = Vec::new();
    let solution = Dop853::new(options)
        .integrate_with_events(
            &straight,
            &State::new(0.0, vec![0.0]),
            1.0,
            &events,
            |event| {
                assert!((event.state[0] - event.time).abs() < 1e-15);
                found.push((event.event, event.rising));
                ControlFlow::Continue(())
            },
        )
        .unwrap();
    assert_eq!(solution.report.accepted, 1);
    assert_eq!(found, [(2, true), (1, false), (1, true), (0, true)]);
}

#[test]
fn a_run_that_stops_at_an_event_goes_on_from_there() {
    let position = |_time: f64, y: &[f64]| y[0];
    let events = [Event::new(Crossing::Either, &position)];
    let (mut state, mut times) = (start(), Vec::new());
    loop {
        let solution = dop853()
            .integrate_with_events(&harmonic(), &state, 10.0, &events, |event| {
                times.push(event.time);
                ControlFlow::Break(())
            })
            .unwrap();
        state = solution.state;
        if solution.report.stop == StopReason::EndReached {
            break;
        }
        assert_eq!(solution.report.stop, StopReason::StoppedByEvent);
        assert_eq!(times.last(), Some(&state.time));
        assert!(state.values[0].abs() < 1e-15);
    }
    assert_eq!(times.len(), 3, "{times:?}");
    assert_eq!(state.time, 10.0);
    assert!((state.values[0] - 10.0_f64.cos()).abs() < 1e-11);
}

#[test]
fn a_run_ends_at_the_occurrence_that_is_asked_for() {
    let position = |_: f64, y: &[f64]| y[0];
    let velocity = |_: f64, y: &[f64]| y[1];
    let run = |numbers: [u32; 2], end: f64| {
        let events = [
            Event::new(Crossing::Either, &position).with_terminal(numbers[0]),
            Event::new(Crossing::Rising, &velocity).with_terminal(numbers[1]),
        ];
        let mut counts = [0; 2];
        let solution = dop853()
            .integrate_with_events(&harmonic(), &start(), end, &events, |found| {
                counts[found.event] += 1;
                ControlFlow::Continue(())
            })
            .unwrap();
        (counts, solution.state.time, solution.report.stop)
    };
    // Zeros of the position at π/2 + kπ; the velocity rises at π + 2πk, backwards at −2πk.
    for (numbers, end, counts, time) in [
        ([1, 0], 20.0, [1, 0], 0.5 * PI),
        ([2, 0], 20.0, [2, 1], 1.5 * PI),
        ([5, 2], 20.0, [3, 2], 3.0 * PI),
        ([5, 9], 20.0, [5, 2], 4.5 * PI),
        ([3, 0], -20.0, [3, 1], -2.5 * PI),
        ([0, 2], -20.0, [4, 2], -4.0 * PI),
    ] {
        let (found, stopped, stop) = run(numbers, end);
        assert_eq!((found, stop), (counts, StopReason::StoppedByEvent));
        assert!((stopped - time).abs() < 1e-11, "{stopped} {time}");
    }
    for numbers in [[0, 0], [7, 4]] {
        assert_eq!(run(numbers, 20.0), ([6, 3], 20.0, StopReason::EndReached));
    }
}

/// A step of length one, seen in eight places.
fn in_one_step(direction: f64, function: &dyn Fn(f64) -> f64) -> Vec<(f64, bool)> {
    let straight = Problem::new(1, |_: f64, _: &[f64], rates: &mut [f64]| rates[0] = 1.0);
    let options = Options {
        initial_step: Some(1.0),
        ..Options::with_tolerance(1e-3)
    };
    let along = |time: f64, _: &[f64]| function(direction * time);
    let mut found = Vec::new();
    let solution = Dop853::new(options)
        .integrate_with_events(
            &straight,
            &State::new(0.0, vec![0.0]),
            direction,
            &[Event::new(Crossing::Either, &along)],
            |event| {
                found.push((direction * event.time, event.rising));
                ControlFlow::Continue(())
            },
        )
        .unwrap();
    assert_eq!(solution.report.accepted, 1);
    found
}

#[test]
fn a_function_leaves_a_zero_to_a_side() {
    for direction in [1.0, -1.0] {
        let found = |function: &dyn Fn(f64) -> f64| in_one_step(direction, function);
        // From the start, as a line, a square, a cube: back before the first place looked at.
        for power in 1..=3 {
            let up = |t: f64| t.powi(power) * (0.07 - t);
            assert_crossings(&found(&up), &[(0.07, false)], 1e-15);
            let down = |t: f64| -up(t);
            assert_crossings(&found(&down), &[(0.07, true)], 1e-15);
            let away = |t: f64| t.powi(power) * (t - 0.4) * (t - 0.6);
            assert_crossings(&found(&away), &[(0.4, false), (0.6, true)], 1e-15);
        }
        // From a place that is looked at: through it, and touching it.
        let through = |t: f64| (t - 0.25) * (0.3 - t);
        assert_crossings(&found(&through), &[(0.25, true), (0.3, false)], 1e-15);
        let touched = |t: f64| (t - 0.25).powi(2) * (0.3 - t);
        assert_crossings(&found(&touched), &[(0.25, false), (0.3, false)], 1e-15);
        assert_crossings(&found(&|_| 0.0), &[], 0.0);
    }
}

#[test]
fn an_event_at_the_start_is_not_reported() {
    let velocity = |_time: f64, y: &[f64]| y[1];
    let found = crossings(&dop853(), 4.0, Event::new(Crossing::Either, &velocity));
    assert_crossings(&found, &[(PI, true)], 1e-12);
}

#[test]
fn a_function_without_a_value_is_an_error() {
    let broken = |time: f64, _y: &[f64]| (1.0 - time).sqrt();
    let events = [Event::new(Crossing::Either, &broken)];
    let error = dop853()
        .integrate_with_events(&harmonic(), &start(), 5.0, &events, |_| {
            ControlFlow::Continue(())
        })
        .unwrap_err();
    let IntegrationError::Event {
        event: 0,
        time,
        last,
        ..
    } = &error
    else {
        panic!("{error:?}");
    };
    assert!(*time > 1.0 && last.time >= *time);
    assert!(
        error
            .to_string()
            .starts_with("the function of event 0 is NaN at t = 1.")
    );
}

#[test]
fn events_do_not_change_the_steps() {
    let position = |_time: f64, y: &[f64]| y[0];
    let events = [Event::new(Crossing::Either, &position)];
    let plain = dop853()
        .integrate(&harmonic(), &start(), 9.0, watch)
        .unwrap();
    let searched = dop853()
        .integrate_with_events(&harmonic(), &start(), 9.0, &events, |_| {
            ControlFlow::Continue(())
        })
        .unwrap();
    assert_eq!(plain.state, searched.state);
    assert_eq!(plain.report.accepted, searched.report.accepted);
}

/// Functions that are zero at one time but for rounding, which hides on which side they are
/// just behind it: all of them are visited at one time, and none again after it.
#[test]
fn crossings_that_rounding_cannot_order_are_visited_at_once() {
    let phases = [0.3, 1.1, 2.4];
    for (phase, sign) in phases.into_iter().flat_map(|own| [(own, 1.0), (own, -1.0)]) {
        let (sin, cos) = f64::sin_cos(phase);
        // sin(phase − t) or its negative, times an odd factor, with a rounding of its own.
        let functions: Vec<_> = (0..40)
            .map(|k| {
                let factor = sign * f64::from(2 * k + 3);
                move |_: f64, y: &[f64]| (factor * y[0]) * sin + (factor * y[1]) * cos
            })
            .collect();
        let function = |k: usize| Event::new(Crossing::Either, &functions[k]);
        let events: Vec<_> = (0..functions.len()).map(function).collect();
        for (begin, end) in [(phase - 0.7, phase + 0.9), (phase + 0.7, phase - 0.9)] {
            let at = |time: f64| State::new(time, vec![time.cos(), -time.sin()]);
            let mut visits = vec![0; events.len()];
            let mut times = Vec::new();
            let solution = dop853()
                .integrate_with_events(&harmonic(), &at(begin), end, &events, |found| {
                    visits[found.event] += 1;
                    times.push(found.time);
                    match times.len() == events.len() {
                        true => ControlFlow::Break(()),
                        false => ControlFlow::Continue(()),
                    }
                })
                .unwrap();
            assert_eq!(visits, vec![1; events.len()], "{phase} {sign} from {begin}");
            for time in &times {
                assert!((time - phase).abs() < 1e-11, "{time} {phase} from {begin}");
            }
            assert_eq!(solution.report.stop, StopReason::StoppedByEvent);
            let again = dop853().integrate_with_events(
                &harmonic(),
                &solution.state,
                end,
                &events,
                |found| -> ControlFlow<()> { panic!("{} again at {}", found.event, found.time) },
            );
            assert_eq!(again.unwrap().state.time, end);
        }
    }
}

/// Functions whose signs about their common zero are those of rounding errors are visited at one time
/// next to it, forwards and backwards, and not at the end of the step.
#[test]
fn rough_crossings_at_one_time_are_visited_there() {
    for zero in [0.7, -0.4, 2.2] {
        let functions: Vec<_> = (0..20)
            .map(|k| {
                let noise = move |time: f64| 4e-14 * (f64::from(k + 1) * 1e15 * time).sin();
                move |time: f64, _: &[f64]| time - zero + noise(time)
            })
            .collect();
        let function = |k: usize| Event::new(Crossing::Either, &functions[k]);
        let events: Vec<_> = (0..functions.len()).map(function).collect();
        for (begin, end) in [(zero - 0.7, zero + 0.9), (zero + 0.7, zero - 0.9)] {
            let at = State::new(begin, vec![begin.cos(), -begin.sin()]);
            let mut visits = vec![0; events.len()];
            dop853()
                .integrate_with_events(&harmonic(), &at, end, &events, |found| {
                    visits[found.event] += 1;
                    let off = (found.time - zero).abs();
                    assert!(off < 1e-11, "{off} from {begin}");
                    ControlFlow::Continue(())
                })
                .unwrap();
            assert_eq!(visits, vec![1; events.len()], "from {begin}");
        }
    }
}
