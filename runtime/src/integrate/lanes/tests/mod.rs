//! Methods in lanes, tested on one small pendulum.

mod agreement;
mod backwards;
mod bits;
mod endings;
mod failures;
mod fixed;
mod model;
mod models;

use self::model::{Lopsided, LopsidedOde, lopsided};
use super::{Cases, Ending, LaneMethod, Outcome, Task, integrate};
use crate::integrate::{
    Dop853, Dopri5, Gauss, GaussOrder, IntegrationError, Integrator, Options, Rk4, Solution,
    Solver, Taylor, Verner98,
};
use crate::scalar::{InstructionSet, Lane};
use crate::system::{AbsoluteAngles, State};

const END: f64 = 8.0;

type End<T> = Result<Solution<T>, IntegrationError<T>>;

/// Something to do with each of the methods.
trait Each<T: Lane> {
    fn each<M>(&mut self, method: &M)
    where
        M: LaneMethod<LopsidedOde<T>, T>,
        M: Integrator<T, LopsidedOde<T>>;
}

/// Does it with all methods, with these options or with fixed steps.
fn with_each<T: Lane>(options: &Options<T>, work: &mut impl Each<T>) {
    with_mirrored(options, work);
    work.each(&Gauss {
        solver: Solver::Newton,
        ..gauss(GaussOrder::Six, options.step_limit)
    });
}

/// Does it with one method of each kind. This is enough for `f32`: the pairs differ in their tables
/// alone, and each method is compiled once more for every scalar and every set of instructions.
fn with_each_kind<T: Lane>(options: &Options<T>, work: &mut impl Each<T>) {
    work.each(&Dop853::new(options.clone()));
    work.each(&Taylor::new(options.clone()));
    work.each(&rk4(options.step_limit));
    work.each(&gauss(GaussOrder::Six, options.step_limit));
}

/// Does it with all methods whose bits backwards are those forwards. Newton's method takes
/// differences in one direction.
fn with_mirrored<T: Lane>(options: &Options<T>, work: &mut impl Each<T>) {
    with_pairs(options, work);
    work.each(&Taylor::new(options.clone()));
    work.each(&rk4(options.step_limit));
    work.each(&gauss(GaussOrder::Four, options.step_limit));
}

/// Does it with all methods of fixed steps.
fn with_fixed_steps<T: Lane>(step_limit: u64, work: &mut impl Each<T>) {
    work.each(&rk4(step_limit));
    for order in [
        GaussOrder::Two,
        GaussOrder::Four,
        GaussOrder::Six,
        GaussOrder::Eight,
    ] {
        for solver in [Solver::FixedPoint, Solver::Newton] {
            work.each(&Gauss {
                solver,
                ..gauss(order, step_limit)
            });
        }
    }
    // Steps that are halved, and an iteration that ends at a tolerance.
    work.each(&Gauss {
        iteration_limit: 12,
        ..Gauss::new(GaussOrder::Six, T::from_f64(0.3))
    });
    work.each(&Gauss::for_animation(T::from_f64(0.1)));
}

// Steps that are no divisors of the times, and limits beyond which some trajectories need not
// go.

fn rk4<T: Lane>(step_limit: u64) -> Rk4<T> {
    let method = Rk4::new(T::from_f64(0.007));
    Rk4 {
        step_limit: step_limit.max(500),
        ..method
    }
}

fn gauss<T: Lane>(order: GaussOrder, step_limit: u64) -> Gauss<T> {
    let method = Gauss::new(order, T::from_f64(0.037));
    Gauss {
        step_limit: step_limit.max(100),
        ..method
    }
}

/// Does it with all pairs.
fn with_pairs<T: Lane>(options: &Options<T>, work: &mut impl Each<T>) {
    work.each(&Dopri5::new(options.clone()));
    work.each(&Dop853::new(options.clone()));
    work.each(&Verner98::new(options.clone()));
}

/// As many that no register divides them.
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

fn times<T: Lane>() -> Vec<T> {
    // From the latest start on, some in one step, some equal.
    [0.1875, 0.1875, 0.19, 0.191, 1.0, 2.5, 2.5, 7.0, 8.0, 8.0]
        .map(T::from_f64)
        .to_vec()
}

/// Options that trajectories keep or fail by, and an error of each kind.
fn strict_options() -> Vec<Options<f64>> {
    let basic = Options::with_tolerance(1e-9);
    vec![
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
    ]
}

/// Every case through the times, and to the end.
fn outcomes<T: Lane, M: LaneMethod<LopsidedOde<T>, T>>(
    instructions: InstructionSet,
    method: &M,
    cases: Cases<'_, LopsidedOde<T>, T>,
    times: &[T],
    end: T,
) -> Vec<Outcome<T>> {
    outcomes_until(instructions, method, cases, times, end, &[])
}

/// The same, or to where an ending is met.
fn outcomes_until<T: Lane, M: LaneMethod<LopsidedOde<T>, T>>(
    instructions: InstructionSet,
    method: &M,
    cases: Cases<'_, LopsidedOde<T>, T>,
    times: &[T],
    end: T,
    endings: &[Ending<'_, T>],
) -> Vec<Outcome<T>> {
    let count = cases.len();
    let task = Task {
        instructions,
        method,
        cases,
        times,
        end: Some(end),
        endings,
    };
    let mut queue = 0..count;
    let mut outcomes = vec![None; count];
    integrate(&task, &mut || queue.next(), &mut |index, outcome| {
        assert!(outcomes[index].replace(outcome).is_none())
    });
    outcomes.into_iter().map(Option::unwrap).collect()
}

/// The end by the plain method.
fn plain<M>(method: &M, model: &LopsidedOde<f64>, start: &State<f64>, end: f64) -> End<f64>
where
    M: Integrator<f64, LopsidedOde<f64>>,
{
    method.run(model, start, end)
}

/// Debug texts are as many digits as it takes: equal bits.
fn assert_same<T: Lane>(a: &[Outcome<T>], b: &[Outcome<T>]) {
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(b) {
        assert_eq!(format!("{a:?}"), format!("{b:?}"));
    }
}
