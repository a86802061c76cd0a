use core::ops::ControlFlow;
use std::mem::discriminant;

use super::{LaneMethod, Outcome, Task, integrate};
use crate::integrate::{
    DenseStep, Dop853, InputError, IntegrationError, Integrator, Options, Solution, StopReason,
    Taylor,
};
use crate::scalar::{InstructionSet, Lane, Scalar};
use crate::system::{AbsoluteAngles, Pendulum, Rescale, State, TaylorPendulum};
use crate::taylor::{self, Coupling, Known, Quad, Start, Tree};

/// Two lopsided links with friction; no answer where the second stands higher than
/// `wall`.
struct Lopsided<T> {
    wall: T,
}

const INERTIAS: [f64; 2] = [1.0, 0.6];
const ALONG: f64 = 0.3;
const ACROSS: f64 = 0.1;
const WEIGHTS: [f64; 2] = [9.0, 4.0];
const LATERAL: [f64; 2] = [0.5, -0.2];
const FRICTION: f64 = 0.02;

fn lopsided<T: Scalar>() -> Lopsided<T> {
    Lopsided {
        wall: T::from_f64(7.0),
    }
}

impl<T: Scalar> Lopsided<T> {
    /// Zero, or NaN beyond the wall.
    #[inline(always)]
    fn check(&self, angle: T) -> T {
        (self.wall - angle).sqrt() * T::from_f64(0.0)
    }
}

impl<T: Scalar> Pendulum<T> for Lopsided<T> {
    const LINKS: usize = 2;
    const LINK_NAMES: &'static [&'static str] = &["first", "second"];

    fn accelerations_into(&self, time: T, theta: &[T], omega: &[T], alpha: &mut [T]) {
        T::accelerate(self, time, theta, omega, alpha);
    }
}

impl<T: Scalar> Rescale<T> for Lopsided<T> {
    type Of<S: Scalar> = Lopsided<S>;

    fn rescale<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Lopsided<S> {
        Lopsided {
            wall: convert(self.wall),
        }
    }

    /// Σ_j M_ij α_j = Σ_j M'_ij ω_j² − …, M_01 = a cos(θ_0 − θ_1) + b sin(θ_0 − θ_1).
    #[inline(always)]
    fn evaluate(
        &self,
        _time: T,
        theta: impl Fn(usize) -> T,
        omega: impl Fn(usize) -> T,
        mut alpha: impl FnMut(usize, T),
    ) {
        let number = T::from_f64;
        let (sine, cosine) = (theta(0) - theta(1)).sin_cos();
        let mass = number(ALONG) * cosine + number(ACROSS) * sine;
        let turned = number(ACROSS) * cosine - number(ALONG) * sine;
        let mut torque = [mass; 2];
        for i in 0..2 {
            let (sine, cosine) = theta(i).sin_cos();
            torque[i] = -(number(WEIGHTS[i]) * sine)
                - number(LATERAL[i]) * cosine
                - number(FRICTION) * omega(i)
                - self.check(theta(1));
        }
        torque[0] = torque[0] + turned * omega(1) * omega(1);
        torque[1] = torque[1] - turned * omega(0) * omega(0);
        let [first, second] = INERTIAS.map(number);
        let determinant = first * second - mass * mass;
        alpha(0, (second * torque[0] - mass * torque[1]) / determinant);
        alpha(1, (first * torque[1] - mass * torque[0]) / determinant);
    }
}

impl<T: Scalar> TaylorPendulum<T> for Lopsided<T> {
    fn taylor_workspace(order: usize) -> usize {
        taylor::workspace(2, order)
    }

    #[inline(always)]
    fn taylor_coefficients_into(
        &self,
        _time: T,
        theta: &[T],
        omega: &[T],
        coefficients: &mut [T],
        work: &mut [Quad<T>],
    ) {
        let (Some(theta), Some(omega)) = (theta.first_chunk(), omega.first_chunk()) else {
            return;
        };
        let friction = T::from_f64(FRICTION);
        let (sines, cosines) = T::sin_cos_each(theta);
        let check = self.check(theta[1]);
        let start = Start {
            theta,
            omega,
            sines,
            cosines,
            bias: [friction * omega[0] + check, friction * omega[1] + check],
        };
        let tree = Tree {
            inertias: INERTIAS.map(T::from_f64),
            couplings: &[Coupling {
                links: [0, 1],
                cosine: T::from_f64(ALONG),
                sine: Some(T::from_f64(ACROSS)),
            }],
            weights: WEIGHTS.map(T::from_f64),
            lateral_weights: LATERAL.map(T::from_f64),
        };
        let (rows, _) = coefficients.as_chunks_mut::<2>();
        let (rows, _) = rows.as_chunks_mut::<2>();
        let bias = |known: &Known<T, 2>| known.omega.map(|omega| friction * omega);
        taylor::expand::<T, 2, 1, _>(&start, &tree, rows, work, Some(bias));
    }

    #[inline(always)]
    fn taylor_coefficients_of<S: Scalar>(
        pendulum: &Lopsided<S>,
        time: S,
        theta: &[S],
        omega: &[S],
        coefficients: &mut [S],
        work: &mut [Quad<S>],
    ) {
        pendulum.taylor_coefficients_into(time, theta, omega, coefficients, work);
    }
}

const END: f64 = 8.0;

fn starts<T: Lane>() -> Vec<State<T>> {
    (0..43)
        .map(|i| {
            let first = 0.02 * f64::from(i);
            State::at_rest(
                T::from_f64(0.0625 * f64::from(i % 4)),
                &[T::from_f64(first), T::from_f64(-0.5 * first)],
            )
        })
        .collect()
}

/// From each start through the times, or to the end.
fn outcomes<T: Lane, M: LaneMethod<Lopsided<T>, T>>(
    instructions: InstructionSet,
    method: &M,
    starts: &[State<T>],
    times: &[T],
    end: T,
) -> Vec<Outcome<T>> {
    let task = Task {
        instructions,
        method,
        pendulum: &lopsided(),
        starts,
        times,
        end: Some(end),
    };
    let mut queue = 0..starts.len();
    let mut outcomes = vec![None; starts.len()];
    integrate(
        &task,
        || queue.next(),
        |index, outcome| assert!(outcomes[index].replace(outcome).is_none()),
    );
    outcomes.into_iter().map(Option::unwrap).collect()
}

/// Debug texts are as many digits as it takes: equal bits.
fn assert_same<T: Lane>(a: &[Outcome<T>], b: &[Outcome<T>]) {
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(b) {
        assert_eq!(format!("{a:?}"), format!("{b:?}"));
    }
}

fn times<T: Lane>() -> Vec<T> {
    // From the latest start on, some in one step, some equal.
    [0.1875, 0.1875, 0.19, 0.191, 1.0, 2.5, 2.5, 7.0, 8.0, 8.0]
        .map(T::from_f64)
        .to_vec()
}

fn neither_place_nor_neighbours_matter<T: Lane, M: LaneMethod<Lopsided<T>, T>>(method: &M) {
    let (mut starts, times, end) = (starts::<T>(), times(), T::from_f64(END));
    // Bad neighbours: no number, far beyond the common range of sine and cosine,
    // beyond the wall, soon beyond the wall, behind the times.
    starts[3].values[0] = T::NAN;
    starts[11].values[0] = T::from_f64(1e9);
    starts[12].values[1] = T::from_f64(8.0);
    starts[13].values[3] = T::from_f64(60.0);
    starts[14].time = end;
    for set in InstructionSet::ALL {
        let together = outcomes(set, method, &starts, &times, end);
        let alone: Vec<_> = starts
            .iter()
            .flat_map(|start| outcomes(set, method, std::slice::from_ref(start), &times, end))
            .collect();
        assert_same(&together, &alone);
        let reversed: Vec<_> = starts.iter().rev().cloned().collect();
        let mut reversed = outcomes(set, method, &reversed, &times, end);
        reversed.reverse();
        assert_same(&together, &reversed);
        for (index, outcome) in together.iter().enumerate() {
            let bad = [3, 12, 13, 14].contains(&index);
            // At 1e9 rad a number may have too few digits for a step.
            assert!(outcome.end.is_ok() != bad || index == 11, "{index}");
        }
    }
    let [_, avx2, avx512] =
        InstructionSet::ALL.map(|set| outcomes(set, method, &starts, &times, end));
    assert_same(&avx2, &avx512);
}

#[test]
fn bits_depend_on_the_start_alone() {
    let double = Options::with_tolerance(1e-9);
    neither_place_nor_neighbours_matter(&Taylor::new(double.clone()));
    neither_place_nor_neighbours_matter(&Taylor::new(double.clone()).with_order(9));
    neither_place_nor_neighbours_matter(&Dop853::new(double));
    let single = Options::with_tolerance(1e-4_f32);
    neither_place_nor_neighbours_matter(&Taylor::new(single.clone()));
    neither_place_nor_neighbours_matter(&Dop853::new(single));
}

/// Steps, ends and samples are those of the plain method but for rounding.
fn the_plain_method_is_met<M>(method: &M, options: &Options<f64>)
where
    M: LaneMethod<Lopsided<f64>, f64>,
    for<'a> M: Integrator<f64, AbsoluteAngles<'a, Lopsided<f64>>>,
{
    let starts = starts::<f64>();
    let (forwards, model) = (times::<f64>(), lopsided());
    let backwards: Vec<f64> = forwards.iter().map(|time| -time).collect();
    for times in [forwards, backwards] {
        let end = *times.last().unwrap();
        let lanes = outcomes(InstructionSet::widest(), method, &starts, &times, end);
        for (start, lane) in starts.iter().zip(lanes) {
            let mut samples = Vec::new();
            let plain = method
                .sample(&AbsoluteAngles(&model), start, &times, |_, y| {
                    samples.extend_from_slice(y);
                })
                .unwrap();
            let lane_end = lane.end.unwrap();
            assert_eq!(lane_end.state.time, end);
            assert_eq!(lane_end.report.stop, StopReason::EndReached);
            assert_eq!(lane_end.state.values, lane.samples[samples.len() - 4..]);
            assert_eq!(lane.samples.len(), samples.len());
            for (a, b) in lane.samples.iter().zip(&samples) {
                assert!((a - b).abs() < 1e-7, "{start:?} {options:?}: {a} {b}");
            }
            let (lane, plain) = (lane_end.report, plain.report);
            assert!(
                lane.accepted.abs_diff(plain.accepted) <= 2,
                "{lane} {plain}"
            );
            assert!((lane.longest_step - plain.longest_step).abs() < 0.1 * plain.longest_step);
            assert!((lane.shortest_step - plain.shortest_step).abs() <= plain.longest_step);
        }
    }
}

#[test]
fn the_plain_methods_are_met_to_the_tolerance() {
    let basic = Options::with_tolerance(1e-9);
    for options in [
        basic.clone(),
        Options {
            compensated: true,
            initial_step: Some(0.01),
            max_step: Some(0.2),
            ..basic
        },
    ] {
        the_plain_method_is_met(&Taylor::new(options.clone()), &options);
        for order in [3, 4, 5, 6, 7] {
            let options = Options {
                // For steps that do not depend on the last digits.
                relative: crate::integrate::Tolerance::Uniform(1e-2),
                absolute: crate::integrate::Tolerance::Uniform(1e-2),
                max_step: Some(0.02),
                ..options.clone()
            };
            let taylor = Taylor::new(options.clone()).with_order(order);
            the_plain_method_is_met(&taylor, &options);
        }
        the_plain_method_is_met(&Dop853::new(options.clone()), &options);
    }
}

/// Both ends are of one kind, failures of the same and about the same time: why, if
/// they ran.
pub(in crate::integrate) fn stop_of_both(
    index: usize,
    lane: &Result<Solution<f64>, IntegrationError<f64>>,
    plain: &Result<Solution<f64>, IntegrationError<f64>>,
) -> Option<StopReason> {
    match (lane, plain) {
        (Ok(lane), Ok(plain)) => {
            assert_eq!(lane.state.time, plain.state.time);
            None
        }
        (Err(IntegrationError::Input(lane)), Err(IntegrationError::Input(plain))) => {
            // NaN is not itself.
            assert_eq!(format!("{lane:?}"), format!("{plain:?}"));
            None
        }
        (Err(lane), Err(plain)) => {
            assert_eq!(discriminant(lane), discriminant(plain), "{index}");
            let times = [lane, plain].map(|e| e.last_state().unwrap().time);
            let reports = [lane, plain].map(|e| *e.report().unwrap());
            let step = reports[1].longest_step;
            assert!((times[0] - times[1]).abs() <= step, "{index}: {times:?}");
            assert_eq!(reports[0].stop, reports[1].stop);
            Some(reports[0].stop)
        }
        (lane, plain) => panic!("{index}: {lane:?} but {plain:?}"),
    }
}

/// The faults that starts and options were chosen for have been seen.
pub(in crate::integrate) fn assert_every_fault(seen: &[StopReason]) {
    for stop in [
        StopReason::NonFinite,
        StopReason::StepLimit,
        StopReason::StepTooSmall,
    ] {
        assert!(seen.contains(&stop), "{stop}");
    }
}

/// Everything that can go wrong, among trajectories that go well.
#[test]
fn errors_of_the_series_are_those_of_the_plain_method() {
    let mut starts = starts::<f64>();
    starts[2].values[1] = 9.0; // No answer at the start.
    starts[5].values[3] = 60.0; // Runs beyond the wall.
    starts[6].values[0] = f64::NEG_INFINITY;
    starts[9].values.pop();
    starts[10].time = f64::NAN;
    starts[20].time = END;
    let basic = Options::with_tolerance(1e-9);
    let mut seen = Vec::new();
    for options in [
        basic.clone(),
        Options {
            step_limit: 20,
            ..basic.clone()
        },
        Options {
            min_step: 0.15,
            ..basic.clone()
        },
        Options {
            beta: 0.04,
            ..basic.clone()
        },
        Options {
            initial_step: Some(-1.0),
            ..basic
        },
    ] {
        let (method, model) = (Taylor::new(options), lopsided());
        for end in [END, f64::INFINITY] {
            let lanes = outcomes(InstructionSet::widest(), &method, &starts, &[], end);
            for (index, (start, lane)) in starts.iter().zip(&lanes).enumerate() {
                let go_on = |_: &mut DenseStep<'_, f64>| ControlFlow::Continue(());
                let plain = method.integrate(&AbsoluteAngles(&model), start, end, go_on);
                seen.extend(stop_of_both(index, &lane.end, &plain));
            }
        }
    }
    assert_every_fault(&seen);
    let no_order = Taylor::new(Options::with_tolerance(1e-9)).with_order(2);
    let refused = outcomes(InstructionSet::widest(), &no_order, &starts[..1], &[], END);
    assert!(matches!(
        refused[0].end,
        Err(IntegrationError::Input(InputError::Order { order: 2, .. }))
    ));
}

/// A trajectory that fails has samples up to its last good state.
#[test]
fn a_failure_keeps_its_samples() {
    let mut starts = starts::<f64>();
    starts[5].values[3] = 30.0;
    let times: Vec<f64> = (0..=400).map(|i| 0.1875 + 0.01 * f64::from(i)).collect();
    let options = Options::with_tolerance(1e-9);
    let end = *times.last().unwrap();
    let widest = InstructionSet::widest();
    let taylor = outcomes(widest, &Taylor::new(options.clone()), &starts, &times, end);
    let dop853 = outcomes(widest, &Dop853::new(options), &starts, &times, end);
    for outcomes in [taylor, dop853] {
        for (index, outcome) in outcomes.iter().enumerate() {
            let samples = outcome.samples.len() / 4;
            match &outcome.end {
                Ok(_) => assert_eq!((index == 5, samples), (false, times.len())),
                Err(error) => {
                    let last = error.last_state().unwrap();
                    let until = times.iter().filter(|time| **time <= last.time).count();
                    assert_eq!((index, samples), (5, until));
                    assert!(samples > 10 && samples < times.len(), "{samples}");
                }
            }
        }
    }
}
