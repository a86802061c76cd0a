//! Trajectories one by one and several at once in vector registers.
//! `benches/peers/heyoka_ensemble.py` measures the same starts.

use std::hint::black_box;
use std::num::NonZeroUsize;

use branched_pendulum::prelude::*;
use branched_pendulum_studies::scenes::{
    BranchedDouble, DampedBranchedDouble, DampedBranchedDoubleParameters,
};
pub(crate) use branched_pendulum_studies::work_precision::reference::near_threshold;
use branched_pendulum_timing::{Contender, compared};

/// Order of the Taylor series: with it they are as fast as with the default order for a tolerance
/// of 1e-9, and the errors are smaller.
pub(crate) const ORDER: usize = 18;

/// Largest friction coefficient of the second ensemble, in N m s.
const FRICTION: f64 = 1e-3;

/// Number of trajectories.
const COUNT: u32 = 10_000;

/// Number of turns.
const ROUNDS: usize = 5;

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
    let of_starts = vec![
        contender!(
            "Dop853, one by one",
            alone.integrate(&dop853, &system, &starts, END)
        ),
        contender!(
            "Dop853 in lanes",
            alone.integrate_in_lanes(&dop853, &system, &starts, END)
        ),
        contender!(
            "Verner98 in lanes",
            alone.integrate_in_lanes(&verner98, &system, &starts, END)
        ),
        contender!(
            "Taylor in lanes",
            alone.integrate_in_lanes(&taylor, &system, &starts, END)
        ),
    ];
    println!(
        "{COUNT} starts over {END} s at 1e-9, one thread: a trajectory\n{}",
        compared(ROUNDS, of_starts)
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
    println!(
        "{COUNT} friction coefficients\n{}",
        compared(ROUNDS, of_frictions)
    );
}
