//! Runs that go backwards in time are runs of the mirrored equations forwards, bit for bit:
//! y' = f(t, y) and y' = −f(−t, y). And a step that an end cuts short is no guide to the next.

use std::rc::Rc;

use branched_pendulum::integrate::{Crossing, Event};
use branched_pendulum::prelude::*;
use branched_pendulum::system::{RatesOnly, TaylorOde};
use branched_pendulum::taylor::Quad;

use crate::problems::{Problem, bell, driven_oscillator, kepler, watch};
use crate::taylor::Mathematical;

const START: f64 = -1.75;
const END: f64 = 4.25;

/// Equations, or the same with time turned round.
#[derive(Clone)]
struct Motion {
    ode: Rc<dyn TaylorOde<f64>>,
    mirrored: bool,
}

impl Ode<f64> for Motion {
    fn dimension(&self) -> usize {
        self.ode.dimension()
    }

    fn rates(&self, time: f64, state: &[f64], rates: &mut [f64]) {
        if self.mirrored {
            self.ode.rates(-time, state, rates);
            rates.iter_mut().for_each(|rate| *rate = -*rate);
        } else {
            self.ode.rates(time, state, rates);
        }
    }
}

impl TaylorOde<f64> for Motion {
    fn has_series(&self) -> bool {
        self.ode.has_series()
    }

    fn workspace(&self, order: usize) -> usize {
        self.ode.workspace(order)
    }

    fn taylor(&self, time: f64, state: &[f64], rows: &mut [f64], work: &mut [Quad<f64>]) {
        if self.mirrored {
            self.ode.taylor(-time, state, rows, work);
            let odd = rows.chunks_exact_mut(state.len()).skip(1).step_by(2);
            odd.flatten().for_each(|number| *number = -*number);
        } else {
            self.ode.taylor(time, state, rows, work);
        }
    }
}

/// All that can be asked of a run, with times that are turned round by `direction`.
fn account(
    method: &impl Integrator<f64, Motion>,
    ode: &Motion,
    values: &[f64],
    direction: f64,
) -> Vec<f64> {
    let (start, end) = (
        State::new(direction * START, values.to_vec()),
        direction * END,
    );
    let mut numbers = Vec::new();
    let note = |numbers: &mut Vec<f64>, time: f64, state: &[f64]| {
        numbers.push(direction * time);
        numbers.extend_from_slice(state);
    };
    let mut inside = vec![0.0; values.len()];
    let run = method
        .integrate(ode, &start, end, |step| {
            note(&mut numbers, step.end_time(), step.end());
            let time = step.start_time() + 0.3 * (step.end_time() - step.start_time());
            assert!(step.contains(time));
            step.eval(time, &mut inside).unwrap();
            note(&mut numbers, time, &inside);
            step.derivative(time, &mut inside).unwrap();
            inside.iter_mut().for_each(|rate| *rate *= direction);
            note(&mut numbers, time, &inside);
            ControlFlow::Continue(())
        })
        .unwrap();
    let Report {
        accepted,
        rejected,
        evaluations,
        shortest_step,
        longest_step,
        next_step,
        stop: _,
    } = run.report;
    numbers.extend([accepted, rejected, evaluations].map(|count| count as f64));
    numbers.extend([shortest_step, longest_step, next_step]);
    let times = [-1.75, -1.75, -1.7, -1.0, 0.0, 0.01, 3.0, 3.0, 4.25].map(|time| direction * time);
    method
        .sample(ode, &start, &times, |time, state| {
            note(&mut numbers, time, state)
        })
        .unwrap();
    let kept = method.trajectory(ode, &start, end).unwrap();
    for time in times {
        note(&mut numbers, time, &kept.at(time).unwrap());
    }
    assert!(kept.at(end + direction).is_err() && kept.at(start.time - direction).is_err());
    let level = |_: f64, state: &[f64]| state[0] - 0.45;
    let clock = |time: f64, state: &[f64]| (direction * 3.0 * time).sin() - state[1];
    let events = [
        Event::new(Crossing::Either, &level),
        Event::new(Crossing::Rising, &clock),
        Event::new(Crossing::Falling, &clock).with_terminal(2),
    ];
    method
        .integrate_with_events(ode, &start, end, &events, |found| {
            numbers.push(found.event as f64 + if found.rising { 0.5 } else { 0.0 });
            note(&mut numbers, found.time, found.state);
            ControlFlow::Continue(())
        })
        .unwrap();
    let mut stepper = method.start(ode.clone(), &start).unwrap();
    for part in 1..=20 {
        let stop = direction * (START + 0.1 * f64::from(part));
        while let Some(step) = stepper.step_to(stop).unwrap() {
            note(&mut numbers, step.end_time(), step.end());
        }
    }
    for _ in 0..7 {
        stepper.advance(direction * 0.07).unwrap();
        note(&mut numbers, stepper.time(), stepper.state());
    }
    let mut resumed = method
        .resume(ode.clone(), &stepper.checkpoint().unwrap())
        .unwrap();
    for stepper in [&mut stepper, &mut resumed] {
        stepper.step().unwrap();
        note(&mut numbers, stepper.time(), stepper.state());
        // And the other way.
        stepper.advance(direction * -0.4).unwrap();
        note(&mut numbers, stepper.time(), stepper.state());
    }
    numbers
}

fn is_mirrored(
    method: &impl Integrator<f64, Motion>,
    ode: impl TaylorOde<f64> + 'static,
    values: &[f64],
) {
    let ode: Rc<dyn TaylorOde<f64>> = Rc::new(ode);
    for mirrored in [false, true] {
        let account = |mirrored, direction| {
            let ode = ode.clone();
            account(method, &Motion { ode, mirrored }, values, direction)
        };
        let forwards = account(mirrored, 1.0);
        assert!(forwards.iter().all(|number| number.is_finite()));
        assert_eq!(forwards, account(!mirrored, -1.0));
    }
}

fn are_mirrored(method: &impl Integrator<f64, Motion>) {
    is_mirrored(method, RatesOnly(driven_oscillator()), &[0.3, -0.2]);
    is_mirrored(method, RatesOnly(bell()), &[0.3, 0.7]);
    is_mirrored(method, RatesOnly(kepler::<f64>()), &[0.6, 0.1, 0.05, 1.4]);
}

#[test]
fn backwards_is_forwards_mirrored() {
    let options = || Options {
        beta: 0.02,
        compensated: true,
        max_step: Some(0.9),
        ..Options::with_tolerance(1e-8)
    };
    are_mirrored(&Dop853::new(Options::with_tolerance(1e-6)));
    are_mirrored(&Dop853::new(options()));
    are_mirrored(&Dopri5::new(options()));
    are_mirrored(&Verner98::new(options()));
    are_mirrored(&Rk4::new(0.03));
    are_mirrored(&Gauss::new(GaussOrder::Six, 0.06));
    are_mirrored(&Gauss::for_animation(0.05));
}

#[test]
fn series_backwards_are_series_forwards_mirrored() {
    for compensated in [false, true] {
        let method = Taylor::new(Options {
            compensated,
            ..Options::with_tolerance(1e-12)
        });
        is_mirrored(&method, Mathematical, &[2.3, 0.4]);
    }
}

/// Ends of steps of a run that goes far, and how many were rejected before each.
fn ends(
    method: &impl Integrator<f64, Problem<f64>>,
    start: &State<f64>,
    direction: f64,
) -> Vec<(f64, u64)> {
    let mut ends = vec![(start.time, 0)];
    method
        .integrate(&driven_oscillator(), start, direction * 1e3, |step| {
            ends.push((step.end_time(), step.report().rejected));
            match ends.len() {
                30.. => ControlFlow::Break(()),
                _ => ControlFlow::Continue(()),
            }
        })
        .unwrap();
    ends
}

/// A run that ends a little behind the end of one of its own steps, and goes on.
fn goes_on_as_planned(method: &impl Integrator<f64, Problem<f64>>) {
    for direction in [1.0, -1.0] {
        let start = State::new(0.5 * direction, vec![0.3, -0.2]);
        let own = ends(method, &start, direction);
        let mut checked = 0;
        // The first ones are so short that the rounding of times counts.
        for number in 8..own.len() - 1 {
            let [(earlier, rejected), (before, _), (after, with)] =
                [own[number - 1], own[number], own[number + 1]];
            let planned = after - before;
            // What was tried before may reach the end too: steps a hundredth longer do.
            if rejected != with || (before - earlier).abs() > 2.5 * planned.abs() {
                continue;
            }
            checked += 1;
            for part in [0.03, 0.05, 0.08] {
                let end = before + part * planned;
                let run = method
                    .integrate(&driven_oscillator(), &start, end, watch)
                    .unwrap();
                assert_eq!(run.report.accepted as usize, number + 1);
                let next = run.report.next_step / planned.abs();
                assert!((next - 1.0).abs() < 1e-12, "{number} {part}: {next}");
                let mut stepper = method.start(driven_oscillator(), &start).unwrap();
                while stepper.step_to(end).unwrap().is_some() {}
                let rejected = stepper.report().rejected;
                let step = stepper.step().unwrap();
                let length = (step.end_time() - step.start_time()) / planned;
                // From its other start the step may be too long after all.
                let too_long = step.report().rejected > rejected && length > 0.5;
                assert!(
                    (length - 1.0).abs() < 1e-12 || too_long,
                    "{number} {part}: {length}"
                );
            }
        }
        assert!(checked > 15, "{checked}");
    }
}

#[test]
fn the_step_after_a_cut_one_is_the_planned_one() {
    let options = || Options::with_tolerance(1e-9);
    goes_on_as_planned(&Dop853::new(options()));
    goes_on_as_planned(&Dopri5::new(options()));
    goes_on_as_planned(&Verner98::new(options()));
}

#[test]
fn a_series_tells_the_step_that_it_had_planned() {
    let method = Taylor::new(Options::with_tolerance(1e-12));
    for direction in [1.0, -1.0] {
        let start = State::new(0.0, vec![2.3, 0.4]);
        let next_after = |end: f64| {
            let run = method
                .integrate(&Mathematical, &start, direction * end, watch)
                .unwrap();
            (run.report.accepted, run.report.next_step)
        };
        let planned = next_after(1e-3);
        assert!(planned.0 == 1 && planned.1 > 0.1, "{planned:?}");
        assert_eq!(next_after(1e-2), planned);
    }
}
