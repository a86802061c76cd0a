//! `cargo bench`: quick measurement of the speed after a change, in a few seconds.
//! `evaluation-speed` and `integration-speed` measure everything.
//!
//! Cases are timed alternately, so that a change of the processor's clock affects all of them, and
//! the shortest time counts, since disturbances only lengthen a run.

use std::hint::black_box;
use std::time::{Duration, Instant};

use branched_pendulum::batch::Batch;
use branched_pendulum::prelude::*;
use branched_pendulum_studies::integration_speed::ensemble::{ORDER, near_threshold};
use branched_pendulum_studies::scenes::{BranchedDouble, Rods, ThirtyOneRods};

/// Number of turns.
const ROUNDS: usize = 40;

/// Number of states in one pass.
const STATES: usize = 256;

/// A case: its name, the unit of its time, and the number of units in one pass.
struct Case {
    name: &'static str,
    unit: &'static str,
    per_pass: f64,
    pass: Box<dyn FnMut()>,
    least: Duration,
}

fn case(
    name: &'static str,
    unit: &'static str,
    per_pass: f64,
    pass: impl FnMut() + 'static,
) -> Case {
    Case {
        name,
        unit,
        per_pass,
        pass: Box::new(pass),
        least: Duration::MAX,
    }
}

/// Creates a case that evaluates accelerations of states one by one.
fn one_by_one<const N: usize>(name: &'static str, model: impl Pendulum<f64> + 'static) -> Case {
    let states: Vec<([f64; N], [f64; N])> = (0..STATES)
        .map(|state| {
            let angle = |link: usize| ((7 * state + 13 * link) % 64) as f64 / 32.0 - 1.0;
            (
                std::array::from_fn(angle),
                std::array::from_fn(|link| 3.0 * angle(link + 5)),
            )
        })
        .collect();
    case(name, "ns a state", STATES as f64, move || {
        for (theta, omega) in black_box(&states) {
            let mut alpha = [0.0; N];
            model.accelerations_into(0.0, theta, omega, &mut alpha);
            black_box(&mut alpha);
        }
    })
}

fn main() {
    let start = State::at_rest(0.0, &[0.8, 1e-3, -1e-3]);
    let starts = near_threshold(64);
    let from = start.clone();
    let dop853 = move || {
        let method = Dop853::new(Options::with_tolerance(1e-9));
        let _ = black_box(method.run(&AbsoluteAngles(&BranchedDouble::new()), &from, 10.0));
    };
    let taylor = move || {
        let method = Taylor::new(Options::with_tolerance(1e-9)).with_order(ORDER);
        let _ = black_box(method.run(&AbsoluteAngles(&BranchedDouble::new()), &start, 10.0));
    };
    let lanes = move || {
        let method = Dop853::new(Options::with_tolerance(1e-9));
        let ensemble = Ensemble::new().threads(std::num::NonZeroUsize::MIN);
        black_box(ensemble.integrate_in_lanes(
            &method,
            &AbsoluteAngles(BranchedDouble::new()),
            &starts,
            10.0,
        ));
    };
    let angle = |state: usize| (state % 64) as f64 / 32.0 - 1.0;
    let angles: [Vec<f64>; 3] = std::array::from_fn(|link| {
        (0..STATES)
            .map(|state| angle(7 * state + 13 * link))
            .collect()
    });
    let mut alpha: [Vec<f64>; 3] = std::array::from_fn(|_| vec![0.0; STATES]);
    let batch = move || {
        let model = BranchedDouble::new();
        let _ = black_box(Batch::new(&model).accelerations(0.0, &angles, &angles, &mut alpha));
    };
    let mut cases = [
        one_by_one::<3>("accelerations, paper", BranchedDouble::new()),
        one_by_one::<7>("accelerations, 7 rods", Rods::new()),
        one_by_one::<31>("accelerations, 31 rods", ThirtyOneRods::new()),
        case(
            "accelerations, paper, batch",
            "ns a state",
            STATES as f64,
            batch,
        ),
        case("10 s at 1e-9, Dop853", "µs", 1e3, dop853),
        case("10 s at 1e-9, Taylor", "µs", 1e3, taylor),
        case("10 s at 1e-9, Dop853 in lanes", "µs a run", 64e3, lanes),
    ];
    for _ in 0..ROUNDS {
        for case in &mut cases {
            let clock = Instant::now();
            (case.pass)();
            case.least = case.least.min(clock.elapsed());
        }
    }
    for case in &cases {
        let time = case.least.as_secs_f64() * 1e9 / case.per_pass;
        println!("{:32} {time:>9.2} {}", case.name, case.unit);
    }
}
