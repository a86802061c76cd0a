//! Runs that stop at an event and go on, forwards or back: no event is told twice, none is
//! lost, however many come at one time.

use core::f64::consts::{FRAC_PI_2, PI};

use branched_pendulum::integrate::{Crossing, Event};
use branched_pendulum::prelude::*;

use crate::problems::harmonic;

/// y = cos t, y' = −sin t.
fn start() -> State<f64> {
    State::at_rest(0.0, &[1.0])
}

fn dop853() -> Dop853<f64> {
    Dop853::new(Options::with_tolerance(1e-13))
}

/// Tells of each event when it came in a run of parts: a part ends at each occurrence of
/// the event `last`, and the next one starts there. The second result holds, for each such
/// end, how many events were told there.
fn stop_and_go(
    method: &impl Integrator<f64, dyn Ode<f64>>,
    start: State<f64>,
    end: f64,
    events: &[Event<'_, f64>],
    last: usize,
) -> (Vec<Vec<f64>>, Vec<usize>) {
    let ode: &dyn Ode<f64> = &harmonic();
    let mut events = events.to_vec();
    events[last] = events[last].with_terminal(1);
    let (mut state, mut reported, mut at_stops) =
        (start, vec![Vec::new(); events.len()], Vec::new());
    for _ in 0..100 {
        let mut times = Vec::new();
        let solution = method
            .integrate_with_events(ode, &state, end, &events, |found| {
                reported[found.event].push(found.time);
                times.push(found.time);
                ControlFlow::Continue(())
            })
            .unwrap();
        state = solution.state;
        if solution.report.stop == StopReason::EndReached {
            return (reported, at_stops);
        }
        assert_eq!(times.last(), Some(&state.time));
        at_stops.push(times.iter().filter(|time| **time == state.time).count());
    }
    panic!("an event is told again and again at {}", state.time);
}

#[test]
fn all_events_at_the_time_of_the_last_are_told_there() {
    // Zeros of one time, which rounding finds at several.
    let plain = |_: f64, y: &[f64]| y[0];
    let scaled = |_: f64, y: &[f64]| -0.7 * y[0];
    let shifted = |_: f64, y: &[f64]| (y[0] + 3.0) - 3.0;
    let turned = |_: f64, y: &[f64]| (3.0 * y[0]).sin() + 0.1 * y[0];
    let squared = |_: f64, y: &[f64]| 1.0 - y[1].powi(2) - y[0] * (y[0] - 1.0);
    type Zero = dyn Fn(f64, &[f64]) -> f64;
    let functions: [&Zero; 4] = [&plain, &scaled, &shifted, &turned];
    let events = functions.map(|function| Event::new(Crossing::Either, function));
    fn check(method: &impl Integrator<f64, dyn Ode<f64>>, events: &[Event<'_, f64>], error: f64) {
        for direction in [1.0, -1.0] {
            for last in 0..events.len() {
                let (reported, at_stops) =
                    stop_and_go(method, start(), 16.0 * direction, events, last);
                assert_eq!(at_stops, [events.len(); 5]);
                for times in reported {
                    let zeros = (0..5).map(|k| direction * (FRAC_PI_2 + PI * f64::from(k)));
                    assert_eq!(times.len(), 5, "{times:?}");
                    for (time, zero) in times.iter().zip(zeros) {
                        assert!((time - zero).abs() < error, "{time} {zero}");
                    }
                }
            }
        }
    }
    let options = || Options::with_tolerance(1e-13);
    check(&dop853(), &events, 1e-11);
    check(&Dopri5::new(options()), &events, 1e-10);
    check(&Verner98::new(options()), &events, 1e-11);
    check(&Rk4::new(1e-2), &events, 1e-6);
    check(&Gauss::new(GaussOrder::Eight, 0.1), &events, 1e-8);
    // By energy, but for its error: each is told once, at its own time.
    let both = [events[0], Event::new(Crossing::Either, &squared)];
    for last in [0, 1] {
        let (reported, _) = stop_and_go(&dop853(), start(), 16.0, &both, last);
        assert_eq!([reported[0].len(), reported[1].len()], [5, 5]);
    }
}

#[test]
fn times_a_few_units_of_rounding_apart_are_one() {
    for (zero, direction) in [(0.7, 1.0), (3.3, 1.0), (-0.7, -1.0), (-11.0, -1.0)] {
        let unit = f64::EPSILON * f64::abs(zero);
        for apart in 0..40 {
            let later = zero + direction * unit * f64::from(apart);
            let first = |time: f64, _: &[f64]| time - zero;
            let second = |time: f64, _: &[f64]| later - time;
            let events = [&first as &dyn Fn(f64, &[f64]) -> f64, &second]
                .map(|function| Event::new(Crossing::Either, function));
            for last in [0, 1] {
                let (reported, at_stops) =
                    stop_and_go(&dop853(), start(), 12.0 * direction, &events, last);
                let numbers = [reported[0].len(), reported[1].len()];
                assert_eq!(numbers, [1, 1], "{zero} {apart} {last}: {reported:?}");
                if apart < 4 {
                    assert_eq!(at_stops, [2]);
                }
            }
        }
    }
}

#[test]
fn a_run_turns_back_at_an_event() {
    fn check(method: &impl Integrator<f64, dyn Ode<f64>>) {
        let ode: &dyn Ode<f64> = &harmonic();
        let position = |_: f64, y: &[f64]| y[0];
        for crossing in [Crossing::Either, Crossing::Rising, Crossing::Falling] {
            let events = [Event::new(crossing, &position)];
            let run = |state: &State<f64>, end: f64| {
                let mut times = Vec::new();
                let events = [events[0].with_terminal(if end > 0.0 { 2 } else { 0 })];
                let solution = method
                    .integrate_with_events(ode, state, end, &events, |found| {
                        times.push(found.time);
                        ControlFlow::Continue(())
                    })
                    .unwrap();
                (times, solution.state)
            };
            let (there, turn) = run(&start(), 20.0);
            assert_eq!(there.len(), 2);
            // What rises falls on the way back, and the zero of the turn is none of its own.
            let (back, _) = run(&turn, -1.0);
            let between = match crossing {
                Crossing::Either => there[0],
                _ => 0.5 * (there[0] + there[1]),
            };
            assert!((back[0] - between).abs() < 1e-6, "{there:?} {back:?}");
            assert_eq!(back.len(), if turn.time > 9.0 { 2 } else { 1 });
        }
    }
    let options = || Options::with_tolerance(1e-11);
    check(&Dop853::new(options()));
    check(&Dopri5::new(options()));
    check(&Verner98::new(options()));
    check(&Rk4::new(1e-2));
    check(&Gauss::new(GaussOrder::Eight, 0.1));
}
