use core::num::NonZeroUsize;
use core::ops::ControlFlow;

use crate::ensemble::Ensemble;
use crate::integrate::lanes::tests::{assert_every_fault, stop_of_both};
use crate::integrate::lanes::{Task, integrate};
use crate::integrate::{Dop853, InputError, IntegrationError, Options, Solution, StopReason};
use crate::scalar::{InstructionSet, Lane, Scalar};
use crate::system::{AbsoluteAngles, Pendulum, Rescale, State};

/// Two coupled rods, driven; no answer where the second stands higher than
/// `wall`.
struct Walled<T> {
    wall: T,
    drive: T,
}

fn walled<T: Scalar>() -> Walled<T> {
    Walled {
        wall: T::from_f64(7.0),
        drive: T::from_f64(0.3),
    }
}

impl<T: Scalar> Pendulum<T> for Walled<T> {
    const LINKS: usize = 2;
    const LINK_NAMES: &'static [&'static str] = &["first", "second"];

    fn accelerations_into(&self, time: T, theta: &[T], omega: &[T], alpha: &mut [T]) {
        T::accelerate(self, time, theta, omega, alpha);
    }
}

impl<T: Scalar> Rescale<T> for Walled<T> {
    type Of<S: Scalar> = Walled<S>;

    fn rescale<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Walled<S> {
        Walled {
            wall: convert(self.wall),
            drive: convert(self.drive),
        }
    }

    #[inline(always)]
    fn evaluate(
        &self,
        time: T,
        theta: impl Fn(usize) -> T,
        omega: impl Fn(usize) -> T,
        mut alpha: impl FnMut(usize, T),
    ) {
        let coupling = T::from_f64(3.0) * (theta(1) - theta(0)).sin_cos().0;
        let drive = self.drive * (T::from_f64(2.0) * time).sin_cos().1;
        let height = self.wall - theta(1);
        alpha(
            0,
            coupling + drive - T::from_f64(9.0) * theta(0).sin_cos().0,
        );
        alpha(
            1,
            -coupling
                - T::from_f64(0.01) * omega(1)
                - T::from_f64(7.0) * theta(1).sin_cos().0 * height.sqrt() / self.wall.sqrt(),
        );
    }
}

const END: f64 = 8.0;

type End<T> = Result<Solution<T>, IntegrationError<T>>;

fn starts<T: Lane>() -> Vec<State<T>> {
    (0..43)
        .map(|i| {
            let first = 0.02 * f64::from(i);
            State::at_rest(
                T::from_f64(0.05 * f64::from(i % 4)),
                &[T::from_f64(first), T::from_f64(-0.5 * first)],
            )
        })
        .collect()
}

fn ends<T: Lane>(
    instructions: InstructionSet,
    options: &Options<T>,
    starts: &[State<T>],
    end: T,
    pendulum: &Walled<T>,
) -> Vec<End<T>> {
    let method = Dop853::new(options.clone());
    let task = Task {
        instructions,
        method: &method,
        pendulum,
        starts,
        times: &[],
        end: Some(end),
    };
    let mut queue = 0..starts.len();
    let mut ends = vec![None; starts.len()];
    integrate(
        &task,
        || queue.next(),
        |index, outcome| assert!(ends[index].replace(outcome.end).is_none()),
    );
    ends.into_iter().map(Option::unwrap).collect()
}

fn plain<T: Lane>(options: &Options<T>, start: &State<T>, end: T, pendulum: &Walled<T>) -> End<T> {
    let go_on = |_: &mut crate::integrate::DenseStep<'_, T>| ControlFlow::Continue(());
    Dop853::new(options.clone()).integrate(&AbsoluteAngles(pendulum), start, end, go_on)
}

/// Debug texts are as many digits as it takes: equal bits.
fn assert_same<T: Lane>(a: &[End<T>], b: &[End<T>]) {
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(b) {
        assert_eq!(format!("{a:?}"), format!("{b:?}"));
    }
}

fn neither_place_nor_neighbours_matter<T: Lane>(tolerance: f64) {
    let options = Options::with_tolerance(T::from_f64(tolerance));
    let end = T::from_f64(END);
    let mut starts = starts::<T>();
    // Bad neighbours: no number, far beyond the common range of sine and cosine,
    // beyond the wall.
    starts[3].values[0] = T::NAN;
    starts[11].values[0] = T::from_f64(1e9);
    starts[12].values[1] = T::from_f64(8.0);
    for set in InstructionSet::ALL {
        let together = ends(set, &options, &starts, end, &walled());
        let alone: Vec<_> = starts
            .iter()
            .flat_map(|start| ends(set, &options, std::slice::from_ref(start), end, &walled()))
            .collect();
        assert_same(&together, &alone);
        let reversed: Vec<_> = starts.iter().rev().cloned().collect();
        let mut reversed = ends(set, &options, &reversed, end, &walled());
        reversed.reverse();
        assert_same(&together, &reversed);
        assert!(together.iter().filter(|end| end.is_ok()).count() >= 40);
    }
    let [_, avx2, avx512] =
        InstructionSet::ALL.map(|set| ends(set, &options, &starts, end, &walled()));
    assert_same(&avx2, &avx512);
}

#[test]
fn bits_depend_on_the_start_alone() {
    neither_place_nor_neighbours_matter::<f64>(1e-9);
    neither_place_nor_neighbours_matter::<f32>(1e-4);
}

#[test]
fn bits_do_not_depend_on_threads_and_progress_counts_all() {
    let (starts, model) = (starts::<f64>(), walled());
    let method = Dop853::new(Options::with_tolerance(1e-9));
    let widest = InstructionSet::widest();
    let one = ends(widest, method.options(), &starts, END, &walled());
    for count in [1, 2, 5, 100] {
        let done = std::sync::atomic::AtomicUsize::new(0);
        let count_done = |_: usize| {
            done.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        };
        let many = Ensemble::new()
            .threads(NonZeroUsize::new(count).unwrap())
            .progress(&count_done)
            .integrate_in_lanes(&method, &model, &starts, END);
        assert_same(&one, &many);
        assert_eq!(done.into_inner(), starts.len());
    }
}

/// Both methods keep the tolerance, and their step-size controls see the same
/// errors but for rounding.
#[test]
fn the_plain_method_is_met_to_the_tolerance() {
    let basic = Options::with_tolerance(1e-9);
    let per_component = crate::integrate::Tolerance::PerComponent(vec![1e-12, 1e-9, 1e-8, 1e-10]);
    for options in [
        basic.clone(),
        Options {
            beta: 0.04,
            compensated: true,
            ..basic.clone()
        },
        Options {
            initial_step: Some(0.3),
            max_step: Some(0.2),
            ..basic.clone()
        },
        Options {
            absolute: per_component,
            ..basic
        },
    ] {
        for end in [END, -3.0] {
            let starts = starts::<f64>();
            let lanes = ends(InstructionSet::widest(), &options, &starts, end, &walled());
            for (start, lane) in starts.iter().zip(lanes) {
                let (lane, plain) = (
                    lane.unwrap(),
                    plain(&options, start, end, &walled()).unwrap(),
                );
                assert_eq!(
                    (lane.state.time, lane.report.stop),
                    (end, StopReason::EndReached)
                );
                for (a, b) in lane.state.values.iter().zip(&plain.state.values) {
                    assert!((a - b).abs() < 1e-7, "{start:?}: {a} {b}");
                }
                let (lane, plain) = (lane.report, plain.report);
                assert!(
                    lane.accepted.abs_diff(plain.accepted) <= 2,
                    "{lane} {plain}"
                );
                let rejected = lane.evaluations - 12 * lane.accepted - 11 * lane.rejected;
                assert_eq!(rejected, if options.initial_step.is_some() { 1 } else { 2 });
            }
        }
    }
}

/// Everything that can go wrong, among trajectories that go well: the errors of
/// the plain method.
#[test]
fn errors_are_those_of_the_plain_method() {
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
            initial_step: Some(-1.0),
            ..basic
        },
    ] {
        for end in [END, f64::INFINITY] {
            let lanes = ends(InstructionSet::widest(), &options, &starts, end, &walled());
            for (index, (start, lane)) in starts.iter().zip(&lanes).enumerate() {
                let plain = plain(&options, start, end, &walled());
                seen.extend(stop_of_both(index, lane, &plain));
            }
        }
    }
    assert_every_fault(&seen);
}

/// The place of a failure is one where the rates have no answer.
#[test]
fn a_failure_says_where() {
    let mut starts = starts::<f64>();
    starts[5].values[3] = 60.0;
    starts[30].values[1] = 9.0;
    let options = Options::with_tolerance(1e-9);
    let ends = ends(InstructionSet::widest(), &options, &starts, END, &walled());
    for (index, end) in ends.iter().enumerate() {
        match end {
            Ok(_) => assert!(index != 5 && index != 30),
            Err(IntegrationError::NonFinite {
                time, values, last, ..
            }) => {
                let mut alpha = [0.0; 2];
                let (theta, omega) = values.split_at(2);
                walled().accelerations_into(*time, theta, omega, &mut alpha);
                assert!(alpha.iter().any(|alpha| !alpha.is_finite()), "{values:?}");
                assert!(*time >= last.time && *time < last.time + 1.0);
                assert!((index == 5) == (last.time > starts[index].time), "{last:?}");
            }
            Err(error) => panic!("{error}"),
        }
    }
}

#[test]
fn a_component_that_stays_zero_needs_no_absolute_tolerance() {
    let options = Options {
        absolute: crate::integrate::Tolerance::Uniform(0.0),
        ..Options::with_tolerance(1e-9)
    };
    let still = Walled {
        drive: 0.0,
        ..walled()
    };
    let start = State::at_rest(0.0, &[0.0, 0.0]);
    let widest = InstructionSet::widest();
    let starts = [start.clone()];
    let rest = ends(widest, &options, &starts, 1.0, &still)
        .remove(0)
        .unwrap();
    assert_eq!(rest, plain(&options, &start, 1.0, &still).unwrap());
    assert_eq!(rest.state.values, [0.0; 4]);
    let no_tolerance = Options {
        relative: crate::integrate::Tolerance::Uniform(0.0),
        ..options
    };
    let refused = ends(
        InstructionSet::widest(),
        &no_tolerance,
        &[start],
        1.0,
        &walled(),
    );
    let error = IntegrationError::Input(InputError::NoTolerance { component: 0 });
    assert_eq!(refused, [Err(error)]);
}
