//! The Taylor series method, on equations whose coefficients are known.

use branched_pendulum::integrate::{Crossing, Event, InputError};
use branched_pendulum::prelude::*;
use branched_pendulum::system::TaylorOde;
use branched_pendulum::taylor::{self, Connectivity, KnownOrder, LinkConstants, Quad, Start};

/// θ'' = −sin θ, by the recurrences that emitted code consists of.
pub(crate) struct Mathematical;

impl Connectivity<1> for Mathematical {
    const PARENTS: [usize; 1] = [0];
    const LATERAL: bool = false;
}

impl<T: Scalar> Ode<T> for Mathematical {
    fn dimension(&self) -> usize {
        2
    }

    fn rates(&self, _time: T, y: &[T], rates: &mut [T]) {
        rates.copy_from_slice(&[y[1], -y[0].sin_cos().0]);
    }
}

impl<T: Scalar> TaylorOde<T> for Mathematical {
    fn workspace(&self, order: usize) -> usize {
        taylor::workspace(1, order)
    }

    fn taylor(&self, _time: T, y: &[T], coefficients: &mut [T], work: &mut [Quad<T>]) {
        let (coefficients, _) = coefficients.as_chunks_mut::<1>();
        let (coefficients, _) = coefficients.as_chunks_mut::<2>();
        let (sin, cos) = y[0].sin_cos();
        let start = Start {
            theta: &[y[0]],
            omega: &[y[1]],
            sines: [sin],
            cosines: [cos],
            bias: [T::from_f64(0.0)],
        };
        let one = T::from_f64(1.0);
        let zero = T::from_f64(0.0);
        let constants = LinkConstants {
            inertias: [one],
            moments: [[zero; 2]],
            attachments: [[zero; 2]],
            weights: [one],
            lateral_weights: [zero],
        };
        taylor::expand::<T, Self, 1, 1, _>(
            &start,
            &constants,
            coefficients,
            work,
            None::<fn(&KnownOrder<T, 1>) -> [T; 1]>,
        );
    }
}

/// y' = y², which is infinite after 1/y.
struct Explosion;

impl Ode<f64> for Explosion {
    fn dimension(&self) -> usize {
        1
    }

    fn rates(&self, _time: f64, y: &[f64], rates: &mut [f64]) {
        rates[0] = y[0] * y[0];
    }
}

impl TaylorOde<f64> for Explosion {
    fn workspace(&self, _order: usize) -> usize {
        0
    }

    fn taylor(&self, _time: f64, y: &[f64], coefficients: &mut [f64], _work: &mut [Quad<f64>]) {
        let mut coefficient = y[0];
        for out in coefficients {
            *out = coefficient;
            coefficient *= y[0];
        }
    }
}

/// y' = 3 t²: a polynomial, exactly its own series.
struct Cubic;

impl Ode<f64> for Cubic {
    fn dimension(&self) -> usize {
        1
    }

    fn rates(&self, time: f64, _y: &[f64], rates: &mut [f64]) {
        rates[0] = 3.0 * time * time;
    }
}

impl TaylorOde<f64> for Cubic {
    fn workspace(&self, _order: usize) -> usize {
        0
    }

    fn taylor(&self, time: f64, y: &[f64], coefficients: &mut [f64], _work: &mut [Quad<f64>]) {
        let known = [y[0], 3.0 * time * time, 3.0 * time, 1.0];
        for (k, out) in coefficients.iter_mut().enumerate() {
            *out = known.get(k).copied().unwrap_or(0.0);
        }
    }
}

fn method(tolerance: f64) -> Taylor<f64> {
    Taylor::new(Options::with_tolerance(tolerance))
}

/// 4 K(sin(θ₀/2)), by the arithmetic-geometric mean.
fn period(amplitude: f64) -> f64 {
    let (mut a, mut b) = (1.0, (amplitude / 2.0).cos());
    for _ in 0..10 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    core::f64::consts::TAU / a
}

#[test]
fn a_pendulum_is_back_after_its_period() {
    for amplitude in [0.1, 1.0, 3.0] {
        let start = State::at_rest(0.0, &[amplitude]);
        let end = method(1e-15)
            .run(&Mathematical, &start, period(amplitude))
            .unwrap();
        assert!((end.state.values[0] - amplitude).abs() < 1e-14, "{end:?}");
        assert!(end.state.values[1].abs() < 1e-14, "{end:?}");
    }
}

/// The polynomial between the ends of a step is as good as the ends.
#[test]
fn dense_output_is_the_polynomial() {
    let start = State::at_rest(0.0, &[2.0]);
    let times: Vec<f64> = (0..=1000).map(|i| 0.01 * f64::from(i)).collect();
    let mut sampled = Vec::new();
    let solution = method(1e-14)
        .sample(&Mathematical, &start, &times, |_, y| {
            sampled.push([y[0], y[1]])
        })
        .unwrap();
    assert!(solution.report.accepted < 40, "{}", solution.report);
    let mut worst = 0.0_f64;
    for [angle, velocity] in &sampled {
        let energy = 0.5 * velocity * velocity - angle.cos();
        worst = worst.max((energy + 2.0_f64.cos()).abs());
    }
    assert_eq!(sampled.len(), times.len());
    assert!(worst < 1e-13, "{worst:e}");
}

/// The local error of order p is h^(p+1).
#[test]
fn order_is_as_asked_for() {
    for order in [4, 7, 12] {
        let start = State::new(0.0, vec![1.0, 0.4]);
        let error = |step: f64| {
            // One step of that length, whatever its error.
            let loose = Options {
                initial_step: Some(step),
                ..Options::with_tolerance(1e30)
            };
            let found = Taylor::new(loose).with_order(order);
            let found = found.run(&Mathematical, &start, step).unwrap();
            assert_eq!(found.report.accepted, 1);
            let exact = method(1e-16).run(&Mathematical, &start, step);
            (found.state.values[0] - exact.unwrap().state.values[0]).abs()
        };
        let measured = (error(0.8) / error(0.4)).log2();
        let expected = (order + 1) as f64;
        assert!((measured - expected).abs() < 0.7, "{order}: {measured}");
    }
}

#[test]
fn tighter_tolerances_give_smaller_errors() {
    let start = State::at_rest(0.0, &[2.5]);
    let mut last = f64::INFINITY;
    for tolerance in [1e-3, 1e-6, 1e-9, 1e-12] {
        let end = method(tolerance).run(&Mathematical, &start, period(2.5));
        let error = (end.unwrap().state.values[0] - 2.5).abs();
        assert!(
            error < 10.0 * tolerance && error < last,
            "{tolerance}: {error:e}"
        );
        last = error;
    }
}

#[test]
fn single_precision() {
    let start = State::at_rest(0.0_f32, &[1.0]);
    let end = Taylor::new(Options::with_tolerance(1e-7_f32))
        .run(&Mathematical, &start, period(1.0) as f32)
        .unwrap();
    assert!((end.state.values[0] - 1.0).abs() < 1e-6, "{end:?}");
}

#[test]
fn a_polynomial_is_integrated_in_one_step() {
    let end = method(1e-12)
        .run(&Cubic, &State::new(-1.0, vec![-1.0]), 7.0)
        .unwrap();
    assert_eq!(end.state.values, [343.0]);
    assert_eq!(end.report.accepted, 1);
}

#[test]
fn events_are_located_to_rounding() {
    let amplitude = 2.0;
    let start = State::at_rest(0.0, &[amplitude]);
    let position = |_time: f64, y: &[f64]| y[0];
    let crossings = [Event::new(Crossing::Falling, &position)];
    let mut times = Vec::new();
    method(1e-15)
        .integrate_with_events(&Mathematical, &start, 30.0, &crossings, |found| {
            times.push(found.time);
            ControlFlow::Continue(())
        })
        .unwrap();
    let period = period(amplitude);
    assert_eq!(times.len(), 4);
    for (count, time) in times.iter().enumerate() {
        let expected = (count as f64 + 0.25) * period;
        assert!((time - expected).abs() < 1e-13, "{time} {expected}");
    }
}

/// A run continues with the steps it would have made.
#[test]
fn a_stopped_run_continues_bit_for_bit() {
    let start = State::at_rest(0.0, &[2.0]);
    let method = method(1e-13);
    let whole = method.run(&Mathematical, &start, 20.0).unwrap();
    let mut steps = 0;
    let part = method
        .integrate(&Mathematical, &start, 20.0, |_| {
            steps += 1;
            if steps == 7 {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        })
        .unwrap();
    assert_eq!(part.report.stop, StopReason::StoppedByObserver);
    let rest = method.run(&Mathematical, &part.state, 20.0).unwrap();
    assert_eq!(rest.state, whole.state);
    assert_eq!(
        part.report.accepted + rest.report.accepted,
        whole.report.accepted
    );
}

/// Steps shrink before a singularity, and the run says where it stands.
#[test]
fn an_explosion_ends_with_an_error_and_the_last_state() {
    let start = State::new(0.0, vec![1.0]);
    let error = method(1e-10).run(&Explosion, &start, 2.0).unwrap_err();
    let last = error.last_state().unwrap();
    assert!((last.time - 1.0).abs() < 1e-9, "{error}");
    assert!(last.values[0].is_finite());
    assert!(matches!(
        error,
        IntegrationError::StepTooSmall { .. } | IntegrationError::NonFinite { .. }
    ));
}

#[test]
fn coefficients_that_are_not_finite_are_reported_at_once() {
    // The square of 1e200 is not.
    let start = State::new(0.5, vec![1e200]);
    let error = method(1e-10).run(&Explosion, &start, 2.0).unwrap_err();
    let IntegrationError::NonFinite {
        time,
        values,
        last,
        report,
    } = error
    else {
        panic!("{error}");
    };
    assert_eq!((time, values), (0.5, vec![1e200]));
    assert_eq!(last, start);
    assert_eq!((report.stop, report.accepted), (StopReason::NonFinite, 0));
}

#[test]
fn requests_without_sense_are_refused() {
    let start = State::at_rest(0.0, &[1.0]);
    let order = method(1e-10).with_order(2).run(&Mathematical, &start, 1.0);
    let expected = InputError::Order {
        order: 2,
        smallest: 3,
        largest: 100,
    };
    assert_eq!(order.unwrap_err(), expected.into());
    let tolerance = method(f64::NAN).run(&Mathematical, &start, 1.0);
    assert!(matches!(
        tolerance,
        Err(IntegrationError::Input(InputError::Tolerance { .. }))
    ));
    let limited = Options {
        step_limit: 3,
        ..Options::with_tolerance(1e-10)
    };
    let limit = Taylor::new(limited).run(&Mathematical, &start, 100.0);
    let Err(IntegrationError::StepLimit {
        limit: 3,
        last,
        report,
    }) = limit
    else {
        panic!("{limit:?}");
    };
    assert!(last.time > 0.0);
    assert_eq!(report.accepted, 3);
    let nothing = method(1e-10).run(&Mathematical, &start, 0.0).unwrap();
    assert_eq!((nothing.state, nothing.report.evaluations), (start, 0));
}

/// An option without effect is no option.
#[test]
fn a_controller_without_use_is_refused() {
    let start = State::at_rest(0.0, &[1.0]);
    let options = Options {
        beta: 0.04,
        ..Options::with_tolerance(1e-10)
    };
    let refused = Taylor::new(options).run(&Mathematical, &start, 1.0);
    let expected = InputError::BetaUnused { value: 0.04 };
    assert_eq!(refused.unwrap_err(), expected.into());
}
