//! The first figures of speed.

use std::hint::black_box;
use std::num::NonZeroUsize;

use branched_pendulum::batch::Batch;
use branched_pendulum::prelude::*;
use branched_pendulum_studies::scenes::{BranchedDouble, Rods, ThirtyOneRods};
use branched_pendulum_timing::{Contender, compared};

use super::ensembles::{ORDER, near_threshold};

/// Number of turns.
const ROUNDS: usize = 40;

/// Number of states in one pass.
const STATES: usize = 256;

/// Number of trajectories that are integrated in lanes.
const STARTS: u32 = 64;

/// Returns the angle of a link in a state, in rad.
fn angle(state: usize, link: usize) -> f64 {
    ((7 * state + 13 * link) % 64) as f64 / 32.0 - 1.0
}

/// Creates a contender that evaluates accelerations of states one by one.
fn one_by_one<const N: usize>(
    name: &str,
    model: impl Pendulum<f64> + 'static,
) -> Contender<'static> {
    let state = |state: usize| -> [[f64; N]; 2] {
        [
            std::array::from_fn(|link| angle(state, link)),
            std::array::from_fn(|link| 3.0 * angle(state, link + 5)),
        ]
    };
    let states: Vec<[[f64; N]; 2]> = (0..STATES).map(state).collect();
    Contender::new(name, STATES as f64, move || {
        for [theta, omega] in black_box(&states) {
            let mut alpha = [0.0; N];
            model.accelerations_into(0.0, theta, omega, &mut alpha);
            black_box(&mut alpha);
        }
    })
}

pub(crate) fn run() {
    let start = State::at_rest(0.0, &[0.8, 1e-3, -1e-3]);
    let starts = near_threshold(STARTS);
    let (paper, ode) = (BranchedDouble::new(), AbsoluteAngles(BranchedDouble::new()));
    let options = || Options::with_tolerance(1e-9);
    let dop853 = Dop853::new(options());
    let taylor = Taylor::new(options()).with_order(ORDER);
    let alone = Ensemble::new().threads(NonZeroUsize::MIN);
    let column = |link| (0..STATES).map(|state| angle(state, link)).collect();
    let angles: [Vec<f64>; 3] = std::array::from_fn(column);
    let mut alpha = angles.clone();
    let evaluations = vec![
        one_by_one::<3>("paper", BranchedDouble::new()),
        one_by_one::<7>("7 rods", Rods::new()),
        one_by_one::<31>("31 rods", ThirtyOneRods::new()),
        Contender::new("paper, batch", STATES as f64, || {
            let mut batch = Batch::new(&paper);
            let _ = black_box(batch.accelerations(0.0, &angles, &angles, &mut alpha));
        }),
    ];
    println!(
        "Accelerations of a state\n{}",
        compared(ROUNDS, evaluations)
    );
    let motions = vec![
        Contender::new("Dop853", 1.0, || {
            let _ = black_box(dop853.run(&ode, &start, 10.0));
        }),
        Contender::new("Taylor", 1.0, || {
            let _ = black_box(taylor.run(&ode, &start, 10.0));
        }),
        Contender::new("Dop853 in lanes", f64::from(STARTS), || {
            black_box(alone.integrate_in_lanes(&dop853, &ode, &starts, 10.0));
        }),
    ];
    println!(
        "Motion of the paper's pendulum over 10 s at 1e-9\n{}",
        compared(ROUNDS, motions)
    );
}
