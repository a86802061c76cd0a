//! `cargo bench --bench reductions`: what smaller models of the same motion save.
//!
//! - One evaluation of a tree of 2²⁰ − 1 links whose copies move in phase: a chain of
//!   twenty.
//! - Growth G of the antiphase mode of the paper's pendulum within 10 s of a release from
//!   each of 1,701 angles from 5° to 90°, G² the ratio of its energies at the end and at
//!   the start: from small differences beside the in-phase motion, and from trajectories
//!   of the whole tree. For each goal of accuracy the cheapest setting of both counts:
//!   method, tolerance, and of the whole tree the size of the differences at the start.
//!
//! Both ways run in lanes on one thread and take turns, and the least of their times
//! counts.

use std::hint::black_box;
use std::num::NonZeroUsize;
use std::time::{Duration, Instant};

use branched_pendulum::Transverse;
use branched_pendulum::prelude::*;
use branched_pendulum::system::{LaneOde, TransverseOde};
use branched_pendulum_examples::scenes::BranchedDouble;

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

/// What nine of ten errors of ln G shall stay below.
const GOALS: [f64; 4] = [1e-3, 1e-5, 1e-7, 1e-9];

/// Degrees of each release.
fn degrees() -> impl Iterator<Item = f64> {
    (0..ANGLES).map(|i| 5.0 + 0.05 * f64::from(i))
}

/// A way to the curve.
#[derive(Clone, Copy, Debug)]
struct Setting {
    ninth_order: bool,
    tolerance: f64,
    /// Size of the differences at the start in the whole tree; none beside the in-phase
    /// motion.
    size: Option<f64>,
}

impl Setting {
    /// Settings from cheap to costly.
    fn all(size: Option<f64>) -> impl Iterator<Item = Self> {
        (6..30).flat_map(move |halves| {
            let tolerance = 10.0_f64.powf(-0.5 * f64::from(halves));
            [false, true].map(|ninth_order| Self {
                ninth_order,
                tolerance,
                size,
            })
        })
    }

    fn ends<O: LaneOde<f64> + Sync>(
        self,
        system: &O,
        starts: &[State<f64>],
    ) -> Vec<Option<State<f64>>> {
        let options = Options::with_tolerance(self.tolerance);
        let ensemble = Ensemble::new().threads(NonZeroUsize::MIN);
        let ends = match self.ninth_order {
            true => ensemble.integrate_in_lanes(&Verner98::new(options), system, starts, 10.0),
            false => ensemble.integrate_in_lanes(&Dop853::new(options), system, starts, 10.0),
        };
        ends.into_iter().map(|end| Some(end.ok()?.state)).collect()
    }

    /// ln G of every release; NaN where a trajectory fails.
    fn curve(self) -> Vec<f64> {
        let model = InPhase::new();
        let energy = |state: &State<f64>| {
            // Angles of the two links, difference; the same of velocities.
            let [theta, difference, rate] = match (self.size, state.values.as_slice()) {
                (None, &[parent, child, difference, _, _, rate]) => {
                    [[parent, child], [difference, 0.0], [rate, 0.0]]
                }
                (Some(_), &[parent, one, other, _, rate, other_rate]) => {
                    let half = |a: f64, b: f64| 0.5 * (a - b);
                    [
                        [parent, 0.5 * (one + other)],
                        [half(one, other), 0.0],
                        [half(rate, other_rate), 0.0],
                    ]
                }
                _ => [[f64::NAN; 2]; 3],
            };
            model.transverse_energy_of(0, &theta, &difference[..1], &rate[..1])
        };
        let start = |angle: f64| match self.size {
            None => State::at_rest(0.0, &[angle.to_radians(), 0.0, 1.0]),
            Some(size) => State::at_rest(0.0, &[angle.to_radians(), size, -size]),
        };
        let starts: Vec<State<f64>> = degrees().map(start).collect();
        let ends = match self.size {
            None => {
                let system = TransverseOde::new(InPhase::new(), 0).expect("one pair of copies");
                self.ends(&system, &starts)
            }
            Some(_) => self.ends(&AbsoluteAngles(BranchedDouble::new()), &starts),
        };
        let growth = |(start, end): (&State<f64>, &Option<State<f64>>)| match end {
            Some(end) => 0.5 * (energy(end) / energy(start)).ln(),
            None => f64::NAN,
        };
        starts.iter().zip(&ends).map(growth).collect()
    }
}

/// The error that nine of ten angles stay below, among those that are judged.
fn error(found: &[f64], exact: &[f64]) -> f64 {
    let pairs = found.iter().zip(exact).zip(degrees());
    let judged = pairs.filter(|(_, angle)| *angle <= JUDGED);
    let mut errors: Vec<f64> = judged.map(|((a, b), _)| (a - b).abs()).collect();
    errors.sort_by(f64::total_cmp);
    errors[errors.len() * 9 / 10]
}

/// The settings by method and size that first meet the goal, with the time of one run.
fn candidates(sizes: &[Option<f64>], exact: &[f64], goal: f64) -> Vec<(Duration, Setting)> {
    let mut found = Vec::new();
    for &size in sizes {
        for ninth_order in [false, true] {
            let mut settings =
                Setting::all(size).filter(|setting| setting.ninth_order == ninth_order);
            let mut time = Duration::MAX;
            let setting = settings.find(|setting| {
                let clock = Instant::now();
                let curve = setting.curve();
                time = clock.elapsed();
                error(&curve, exact) < goal
            });
            found.extend(setting.map(|setting| (time, setting)));
        }
    }
    found
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
    let reference = Setting {
        ninth_order: true,
        tolerance: 1e-14,
        size: None,
    };
    let exact = reference.curve();
    println!("growth curve of {ANGLES} angles; nine of ten errors of ln G up to {JUDGED}° below");
    let sizes = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6].map(Some);
    for goal in GOALS {
        let least = |sizes: &[Option<f64>]| {
            let found = candidates(sizes, &exact, goal).into_iter();
            found
                .min_by_key(|(time, _)| *time)
                .map(|(_, setting)| setting)
        };
        let (Some(small), whole) = (least(&[None]), least(&sizes)) else {
            println!("{goal:e}: by no setting");
            continue;
        };
        let Some(whole) = whole else {
            println!("{goal:e}: {small:?}, and by no setting of the whole tree");
            continue;
        };
        let mut times = [Duration::MAX; 2];
        for _ in 0..ROUNDS {
            for (time, setting) in times.iter_mut().zip([small, whole]) {
                *time = (*time).min(time_of(&mut || drop(black_box(setting.curve()))));
            }
        }
        let [own, other] = times.map(|time| 1e3 * time.as_secs_f64());
        println!(
            "{goal:e}: {own:.1} ms, whole tree {other:.1} ms, ratio {:.1} ({small:?}, {whole:?})",
            other / own
        );
    }
}
