//! Trajectories one by one and several at once in vector registers.
//! `benches/peers/heyoka_ensemble.py` measures the same starts.

use std::hint::black_box;
use std::num::NonZeroUsize;

use branched_pendulum::prelude::*;
use branched_pendulum_studies::scenes::{
    BranchedDouble, DampedBranchedDouble, DampedBranchedDoubleParameters,
};
pub(crate) use branched_pendulum_studies::work_precision::reference::near_threshold;
use branched_pendulum_timing::{Contender, Table, compared, least};
use branched_pendulum_trees::PendulumTree;

/// Order of the Taylor series: with it they are as fast as with the default order for a tolerance
/// of 1e-9, and the errors are smaller.
pub(crate) const ORDER: usize = 18;

/// Description of the paper's pendulum, for a tree that is read at run time.
const PAPER: &str = "gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ]";

/// Largest friction coefficient of the second ensemble, in N m s.
const FRICTION: f64 = 1e-3;

/// Number of trajectories.
const COUNT: u32 = 10_000;

/// Number of turns.
const ROUNDS: usize = 5;

/// Tolerances at which the methods in lanes are compared by their errors.
const TOLERANCES: [f64; 6] = [1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12];

/// The errors are those of every start whose index is a multiple of this number.
const CHECKED: usize = 100;

/// Duration of a trajectory, s.
const END: f64 = 10.0;

/// Returns copies of the paper's pendulum with friction coefficients from zero to 1e-3 N m s in
/// every pivot, each with its release from 50°.
fn frictions() -> Vec<(AbsoluteAngles<DampedBranchedDouble>, State<f64>)> {
    let release = |index: u32| {
        let friction = FRICTION * f64::from(index) / f64::from(COUNT - 1);
        let model = DampedBranchedDouble::new(DampedBranchedDoubleParameters {
            friction_root: friction,
            friction_children: friction,
        });
        let start = State::at_rest(0.0, &[50_f64.to_radians(), 1e-3, -1e-3]);
        (AbsoluteAngles(model.expect("valid friction")), start)
    };
    (0..COUNT).map(release).collect()
}

/// Prints, for several tolerances, the time of each method in lanes and the median of its errors.
/// The error of a trajectory is the largest difference of all angles (rad) and velocities (rad/s) at
/// the end from `Taylor` at a tolerance of 1e-16.
fn compare_errors(system: &AbsoluteAngles<BranchedDouble>, starts: &[State<f64>]) {
    let alone = Ensemble::new().threads(NonZeroUsize::MIN);
    let checked: Vec<State<f64>> = starts.iter().step_by(CHECKED).cloned().collect();
    let exact = Taylor::new(Options::with_tolerance(1e-16));
    macro_rules! ends {
        ($solutions:expr) => {{
            let ends = $solutions.into_iter();
            let ends = ends.map(|end| end.expect("a regular motion").state.values);
            ends.collect::<Vec<Vec<f64>>>()
        }};
    }
    let expected = ends!(alone.integrate(&exact, system, &checked, END));
    let mut table = Table::new(["tolerance, method", "µs for a trajectory", "median error"]);
    for tolerance in TOLERANCES {
        let options = || Options::with_tolerance(tolerance);
        macro_rules! row {
            ($name:literal, $method:expr) => {{
                let method = $method;
                let pass = || {
                    black_box(alone.integrate_in_lanes(&method, system, starts, END));
                };
                let time = least(3, pass);
                let found = ends!(alone.integrate_in_lanes(&method, system, &checked, END));
                let mut errors: Vec<f64> = found.iter().zip(&expected).map(difference).collect();
                errors.sort_by(f64::total_cmp);
                table = table.row([
                    format!("{tolerance:e}, {}", $name),
                    format!("{:.1}", 1e6 * time / f64::from(COUNT)),
                    format!("{:.1e}", errors[errors.len() / 2]),
                ]);
            }};
        }
        row!("Dop853", Dop853::new(options()));
        row!("Verner98", Verner98::new(options()));
        row!("Taylor", Taylor::new(options()).with_order(ORDER));
    }
    println!("{COUNT} starts over {END} s in lanes, one thread\n{table}");
}

/// Returns the largest difference between two states.
fn difference((found, expected): (&Vec<f64>, &Vec<f64>)) -> f64 {
    let differences = found
        .iter()
        .zip(expected)
        .map(|(one, other)| (one - other).abs());
    differences.fold(0.0, f64::max)
}

pub(crate) fn run() {
    let system = AbsoluteAngles(BranchedDouble::new());
    let (starts, releases) = (near_threshold(COUNT), frictions());
    let alone = Ensemble::new().threads(NonZeroUsize::MIN);
    let options = || Options::with_tolerance(1e-9);
    let dop853 = Dop853::new(options());
    let verner98 = Verner98::new(options());
    let taylor = Taylor::new(options()).with_order(ORDER);
    macro_rules! contender {
        ($name:literal, $run:expr) => {
            Contender::new($name, f64::from(COUNT), || drop(black_box($run)))
        };
    }
    macro_rules! in_lanes {
        ($system:expr) => {
            [
                contender!(
                    "Dop853 in lanes",
                    alone.integrate_in_lanes(&dop853, $system, &starts, END)
                ),
                contender!(
                    "Verner98 in lanes",
                    alone.integrate_in_lanes(&verner98, $system, &starts, END)
                ),
                contender!(
                    "Taylor in lanes",
                    alone.integrate_in_lanes(&taylor, $system, &starts, END)
                ),
            ]
        };
    }
    let mut of_starts = vec![contender!(
        "Dop853, one by one",
        alone.integrate(&dop853, &system, &starts, END)
    )];
    of_starts.extend(in_lanes!(&system));
    println!(
        "{COUNT} starts over {END} s at 1e-9, one thread: a trajectory\n{}",
        compared(ROUNDS, of_starts)
    );
    let tree = PendulumTree::parse(PAPER).expect("a valid description");
    let tree = AbsoluteAngles(&tree);
    println!(
        "the same starts of a tree that is read at run time\n{}",
        compared(ROUNDS, in_lanes!(&tree).into())
    );
    let of_frictions = vec![
        contender!(
            "Dop853, one by one",
            alone.map(&releases, |_, (system, start)| {
                dop853.run(system, start, END)
            })
        ),
        contender!(
            "Dop853 in lanes",
            alone.integrate_models_in_lanes(&dop853, &releases, END)
        ),
        contender!(
            "Verner98 in lanes",
            alone.integrate_models_in_lanes(&verner98, &releases, END)
        ),
        contender!(
            "Taylor in lanes",
            alone.integrate_models_in_lanes(&taylor, &releases, END)
        ),
    ];
    compare_errors(&system, &starts);
    println!(
        "{COUNT} friction coefficients\n{}",
        compared(ROUNDS, of_frictions)
    );
}
