//! `cargo bench --bench reductions`: what smaller models of the same motion save.
//!
//! - One evaluation of a tree of 2²⁰ − 1 links whose copies move in phase: a chain of
//!   twenty.
//! - Growth G of the antiphase mode of the paper's pendulum within 10 s of a release from
//!   each of 1,701 angles from 5° to 90°, G the largest |θ_d(t)|/θ_d(0) at 201 times: from
//!   small differences beside the in-phase motion, and from trajectories of the whole
//!   tree. Of both the cheapest setting counts of which the errors meet the goal.
//!
//! Both ways run in lanes on one thread and take turns, and the least of their times
//! counts.

use std::hint::black_box;
use std::num::NonZeroUsize;
use std::time::{Duration, Instant};

use branched_pendulum::integrate::IntegrationError;
use branched_pendulum::prelude::*;
use branched_pendulum::system::{LaneOde, TransverseOde};
use branched_pendulum_examples::solvers::scenes::Ideal;

/// 2²⁰ − 1 rods in phase.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 20, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7),
    in_phase(tree),
)]
struct Generations;

/// The paper's pendulum, its children in phase.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ],
    in_phase(child),
    emit(transverse),
)]
struct InPhase;

/// Rounds of turns.
const ROUNDS: usize = 7;

/// Angles of release.
const ANGLES: u32 = 1701;

/// Angles up to which accuracy is judged: beyond, differences of any size that rounding
/// allows grow out of the linear range of the whole tree within 10 s.
const JUDGED: f64 = 42.0;

/// Most that nine of ten errors of ln G may be.
const GOAL: f64 = 1e-3;

/// Degrees of each release.
fn degrees() -> impl Iterator<Item = f64> {
    (0..ANGLES).map(|i| 5.0 + 0.05 * f64::from(i))
}

/// ln G of every release of a system, by the component of the difference that
/// `difference` reads of a state; NaN where a trajectory fails.
fn growths<O: LaneOde<f64> + Sync>(
    system: &O,
    starts: &[State<f64>],
    tolerance: f64,
    difference: impl Fn(&[f64]) -> f64,
) -> Vec<f64> {
    let times: Vec<f64> = (0..=200).map(|i| 0.05 * f64::from(i)).collect();
    let method = Dop853::new(Options::with_tolerance(tolerance));
    let ensemble = Ensemble::new().threads(NonZeroUsize::MIN);
    let samples = ensemble.sample_in_lanes(&method, system, starts, &times);
    let growth = |(samples, start): (&branched_pendulum::ensemble::Samples<f64>, &State<f64>)| {
        let reached: Result<_, &IntegrationError<f64>> = samples.end.as_ref();
        let sizes = samples.states().map(|state| difference(state).abs());
        match reached {
            Ok(_) => (sizes.fold(0.0, f64::max) / difference(&start.values).abs()).ln(),
            Err(_) => f64::NAN,
        }
    };
    samples.iter().zip(starts).map(growth).collect()
}

/// By small differences beside the in-phase motion.
fn by_differences(tolerance: f64) -> Vec<f64> {
    let system = TransverseOde::new(InPhase::new(), 0).expect("one pair of copies");
    let starts: Vec<State<f64>> = degrees()
        .map(|angle| State::at_rest(0.0, &[angle.to_radians(), 0.0, 1.0]))
        .collect();
    growths(&system, &starts, tolerance, |state| state[2])
}

/// By the whole tree, with differences of the size `size` at the start.
fn by_the_whole_tree(size: f64, tolerance: f64) -> Vec<f64> {
    let starts: Vec<State<f64>> = degrees()
        .map(|angle| State::at_rest(0.0, &[angle.to_radians(), size, -size]))
        .collect();
    let system = AbsoluteAngles(Ideal::new());
    growths(&system, &starts, tolerance, |state| {
        0.5 * (state[1] - state[2])
    })
}

/// The error that nine of ten angles stay below, among those that are judged.
fn error(found: &[f64], exact: &[f64]) -> f64 {
    let pairs = found.iter().zip(exact).zip(degrees());
    let judged = pairs.filter(|(_, angle)| *angle <= JUDGED);
    let mut errors: Vec<f64> = judged.map(|((a, b), _)| (a - b).abs()).collect();
    errors.sort_by(f64::total_cmp);
    errors[errors.len() * 9 / 10]
}

fn time_of(pass: &mut dyn FnMut()) -> Duration {
    let clock = Instant::now();
    pass();
    clock.elapsed()
}

/// Time of one evaluation of the chain, s.
fn evaluation() -> f64 {
    const STATES: usize = 1000;
    let model = Generations::new();
    let state = |i: usize| -> [f64; 20] {
        std::array::from_fn(|link| ((7 * i + 13 * link) % 64) as f64 / 32.0 - 1.0)
    };
    let states: Vec<[[f64; 20]; 2]> = (0..STATES).map(|i| [state(i), state(i + 5)]).collect();
    let mut least = Duration::MAX;
    for _ in 0..40 {
        least = least.min(time_of(&mut || {
            for [theta, omega] in black_box(&states) {
                let mut alpha = [0.0; 20];
                model.accelerations_into(0.0, theta, omega, &mut alpha);
                black_box(&mut alpha);
            }
        }));
    }
    least.as_secs_f64() / STATES as f64
}

fn main() {
    println!(
        "accelerations of 20 generations in phase: {:.0} ns",
        1e9 * evaluation()
    );
    let exact = by_differences(1e-13);
    let decades = || (3..14).map(|digits| 10.0_f64.powi(-digits));
    let tolerance = decades().find(|&tolerance| error(&by_differences(tolerance), &exact) < GOAL);
    // Small differences need small tolerances, large ones are not small.
    let mut whole: Option<(Duration, f64, f64)> = None;
    for size in [1e-2, 1e-3, 1e-4, 1e-5] {
        for tolerance in decades() {
            let clock = Instant::now();
            let found = by_the_whole_tree(size, tolerance);
            let time = clock.elapsed();
            if error(&found, &exact) < GOAL {
                if whole.is_none_or(|(least, ..)| time < least) {
                    whole = Some((time, size, tolerance));
                }
                break;
            }
        }
    }
    let (Some(tolerance), Some((_, size, whole_tolerance))) = (tolerance, whole) else {
        println!("no setting meets the goal");
        return;
    };
    let mut least = [Duration::MAX; 2];
    let mut differences = || drop(black_box(by_differences(tolerance)));
    let mut trajectories = || drop(black_box(by_the_whole_tree(size, whole_tolerance)));
    let mut ways: [&mut dyn FnMut(); 2] = [&mut differences, &mut trajectories];
    for _ in 0..ROUNDS {
        for (least, way) in least.iter_mut().zip(ways.iter_mut()) {
            *least = (*least).min(time_of(*way));
        }
    }
    let [differences, trajectories] = least.map(|time| time.as_secs_f64());
    println!(
        "growth curve of {ANGLES} angles, errors of ln G below {GOAL:e} up to {JUDGED}°:\n  \
         small differences, tolerance {tolerance:e}: {:.1} ms\n  \
         whole tree, θ_d(0) = {size:e}, tolerance {whole_tolerance:e}: {:.1} ms\n  \
         ratio {:.1}",
        1e3 * differences,
        1e3 * trajectories,
        trajectories / differences
    );
}
