//! Savings by smaller models of the same motion.
//!
//! - One evaluation of a tree of 2²⁰ − 1 links whose copies move in phase: a chain of twenty.
//! - Growth G of the antiphase mode of the paper's pendulum within 10 s of a release from each of
//!   1,701 angles from 5° to 90°, where G² is the ratio of its energies at the end and at the
//!   start. Three ways are compared: small differences along the in-phase motion; trajectories of
//!   the whole tree in absolute angles that start with a difference; and trajectories in symmetric
//!   coordinates, in which a difference may be arbitrarily small. For each accuracy the cheapest
//!   setting of each way counts: method, tolerance, and in absolute angles the size of the initial
//!   differences.
//!
//! All ways run in lanes on one thread.

use std::hint::black_box;
use std::num::NonZeroUsize;

use branched_pendulum::integrate::LaneMethod;
use branched_pendulum::prelude::*;
use branched_pendulum::system::{CastOde, TransverseOde};
use branched_pendulum::{Pendulum, Transverse};
use branched_pendulum_studies::scenes::BranchedDouble;
use branched_pendulum_timing::{Contender, compared, least};

/// A full binary tree of 2²⁰ − 1 rods, with all copies in phase.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 20, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7),
    in_phase(tree),
)]
struct Generations;

/// The paper's pendulum with its children in phase.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ],
    in_phase(child),
    emit(transverse),
)]
struct InPhase;

/// Number of turns.
const ROUNDS: usize = 7;

/// Number of release angles.
const ANGLES: u32 = 1701;

/// Rule by which errors of ln G are judged: the largest angle of release (in degrees), and the
/// fraction of releases whose errors must stay below a limit.
struct Judgement {
    limit: f64,
    share: f64,
    goals: &'static [f64],
}

/// Rules for the regular motions, and for the whole curve. Above 46° most in-phase motions are
/// chaotic, and G reaches 1e29; a fifth of the angles is left out there, since no tolerance gives
/// correct digits.
const JUDGEMENTS: [Judgement; 2] = [
    Judgement {
        limit: 42.0,
        share: 0.9,
        goals: &[1e-3, 1e-5, 1e-7, 1e-9],
    },
    Judgement {
        limit: 90.0,
        share: 0.8,
        goals: &[1e-2, 1e-4, 1e-6],
    },
];

/// Returns the release angles, in degrees.
fn degrees() -> impl Iterator<Item = f64> {
    (0..ANGLES).map(|i| 5.0 + 0.05 * f64::from(i))
}

/// A method of computing the growth curve.
#[derive(Clone, Copy, Debug, PartialEq)]
enum GrowthMethod {
    /// Small differences along the in-phase motion.
    Small,
    /// The whole tree in absolute angles, with initial differences of this size.
    Absolute(f64),
    /// The whole tree in symmetric coordinates.
    Symmetric,
}

/// Size of a difference that is a separate component of the state: even after growing by 1e29 its
/// effect on the other components is below rounding errors, and it does not affect the choice of
/// steps.
const TINY: f64 = 1e-100;

/// Sizes of initial differences in absolute angles: with smaller ones the difference loses its
/// digits, with larger ones it acts back on the in-phase motion.
const SIZES: [f64; 10] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11];

#[derive(Clone, Copy, Debug, PartialEq)]
enum Order {
    Eight,
    Nine,
    /// Taylor series whose order depends on the tolerance; only in absolute angles.
    Taylor,
}

/// A method of computing the growth curve, with its integrator and tolerance.
#[derive(Clone, Copy, Debug)]
struct Setting {
    way: GrowthMethod,
    order: Order,
    tolerance: f64,
}

impl Setting {
    /// Returns ln G of every release; NaN if a trajectory fails.
    fn curve(self) -> Vec<f64> {
        let model = InPhase::new();
        let energy = |state: &State<f64>| {
            let &[_, a, b, _, da, db] = state.values.as_slice() else {
                return f64::NAN;
            };
            let [difference, rate] = match self.way {
                GrowthMethod::Absolute(_) => [0.5 * (a - b), 0.5 * (da - db)],
                _ => [b, db],
            };
            model.transverse_energy_of(0, &[0.0; 2], &[difference], &[rate])
        };
        let start = |angle: f64| {
            let angle = angle.to_radians();
            State::at_rest(
                0.0,
                &match self.way {
                    GrowthMethod::Absolute(size) => [angle, size, -size],
                    _ => [angle, 0.0, TINY],
                },
            )
        };
        let starts: Vec<State<f64>> = degrees().map(start).collect();
        let ends = match self.way {
            GrowthMethod::Small => {
                let system = TransverseOde::new(InPhase::new(), 0).expect("one pair of copies");
                self.by_pairs(&system, &starts)
            }
            GrowthMethod::Symmetric => {
                self.by_pairs(&SymmetricCoordinates(BranchedDouble::new()), &starts)
            }
            GrowthMethod::Absolute(_) => {
                let system = AbsoluteAngles(BranchedDouble::new());
                match self.order {
                    Order::Taylor => ends(&Taylor::new(self.options()), &system, &starts),
                    _ => self.by_pairs(&system, &starts),
                }
            }
        };
        let growth = |(start, end): (&State<f64>, &Option<State<f64>>)| match end {
            Some(end) => 0.5 * (energy(end) / energy(start)).ln(),
            None => f64::NAN,
        };
        starts.iter().zip(&ends).map(growth).collect()
    }

    fn options(self) -> Options<f64> {
        Options::with_tolerance(self.tolerance)
    }

    fn by_pairs<O>(self, system: &O, starts: &[State<f64>]) -> Vec<Option<State<f64>>>
    where
        O: CastOde<f64> + Sync,
    {
        match self.order {
            Order::Nine => ends(&Verner98::new(self.options()), system, starts),
            _ => ends(&Dop853::new(self.options()), system, starts),
        }
    }
}

fn ends<M, O>(method: &M, system: &O, starts: &[State<f64>]) -> Vec<Option<State<f64>>>
where
    M: LaneMethod<O, f64>,
    O: CastOde<f64> + Sync,
{
    let ensemble = Ensemble::new().threads(NonZeroUsize::MIN);
    let ends = ensemble.integrate_in_lanes(method, system, starts, 10.0);
    ends.into_iter().map(|end| Some(end.ok()?.state)).collect()
}

/// Returns the error below which the required fraction of the judged releases stays.
fn error(found: &[f64], exact: &[f64], judgement: &Judgement) -> f64 {
    let pairs = found.iter().zip(exact).zip(degrees());
    let judged = pairs.filter(|(_, angle)| *angle <= judgement.limit);
    let mut errors: Vec<f64> = judged.map(|((a, b), _)| (a - b).abs()).collect();
    errors.sort_by(f64::total_cmp);
    errors[(errors.len() as f64 * judgement.share) as usize]
}

/// Returns the cheapest setting that meets a goal, comparing the first sufficient setting of each
/// method and integrator. If none meets it, returns the smallest error.
fn cheapest(
    ways: &[GrowthMethod],
    exact: &[f64],
    judgement: &Judgement,
    goal: f64,
) -> Result<Setting, f64> {
    let (mut best, mut nearest) = (None, f64::INFINITY);
    for &way in ways {
        for order in [Order::Eight, Order::Nine, Order::Taylor] {
            if order == Order::Taylor && !matches!(way, GrowthMethod::Absolute(_)) {
                continue;
            }
            for halves in 6..29 {
                let setting = Setting {
                    way,
                    order,
                    tolerance: 10.0_f64.powf(-0.5 * f64::from(halves)),
                };
                let found = error(&setting.curve(), exact, judgement);
                nearest = nearest.min(found);
                if found < goal {
                    let time = least(3, || drop(black_box(setting.curve())));
                    if best.is_none_or(|(least, _)| time < least) {
                        best = Some((time, setting));
                    }
                    break;
                }
            }
        }
    }
    best.map(|(_, setting)| setting).ok_or(nearest)
}

/// Returns the time of one evaluation of the chain, in s.
fn evaluation() -> f64 {
    const STATES: usize = 1000;
    let model = Generations::new();
    let state = |i: usize| -> [f64; 20] {
        std::array::from_fn(|link| ((7 * i + 13 * link) % 64) as f64 / 32.0 - 1.0)
    };
    let states: Vec<[[f64; 20]; 2]> = (0..STATES).map(|i| [state(i), state(i + 5)]).collect();
    let seconds = least(40, || {
        for [theta, omega] in black_box(&states) {
            let mut alpha = [0.0; 20];
            model.accelerations_into(0.0, theta, omega, &mut alpha);
            black_box(&mut alpha);
        }
    });
    seconds / STATES as f64
}

pub(crate) fn run() {
    println!(
        "accelerations of 20 generations in phase: {:.0} ns",
        1e9 * evaluation()
    );
    let reference = Setting {
        way: GrowthMethod::Small,
        order: Order::Nine,
        tolerance: 1e-14,
    };
    let exact = reference.curve();
    for judgement in &JUDGEMENTS {
        let Judgement {
            limit,
            share,
            goals,
        } = judgement;
        println!(
            "growth curve of {ANGLES} angles; {share} of the errors of ln G up to {limit}° below"
        );
        for &goal in *goals {
            compare(&exact, judgement, goal);
        }
    }
}

/// Prints the costs of the three ways for a goal, and the cheapest settings.
fn compare(exact: &[f64], judgement: &Judgement, goal: f64) {
    let ways = [
        ("small differences", vec![GrowthMethod::Small]),
        (
            "absolute angles",
            SIZES.map(GrowthMethod::Absolute).to_vec(),
        ),
        ("symmetric coordinates", vec![GrowthMethod::Symmetric]),
    ];
    let mut contenders = Vec::new();
    for (name, ways) in ways {
        match cheapest(&ways, exact, judgement, goal) {
            Ok(setting) => {
                let pass = move || drop(black_box(setting.curve()));
                contenders.push(Contender::new(format!("{name}, {setting:?}"), 1.0, pass));
            }
            Err(nearest) => println!("{name}: by no setting; the nearest {nearest:.1e}"),
        }
    }
    println!("below {goal:e}\n{}", compared(ROUNDS, contenders));
}
