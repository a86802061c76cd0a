//! `cargo bench --bench gradients`: cost of derivatives in reverse mode.
//!
//! - One pullback of the accelerations (derivatives by 3 angles, 3 velocities and 11 parameters)
//!   in evaluations of the accelerations.
//! - The derivatives of a cost at the end of a motion by its start and by all parameters, in runs
//!   of the same motion, and in runs that carry a tangent (dual numbers) for each of the 17
//!   directions.
//!
//! All candidates take turns; the medians of the ratios of each turn are printed.

use std::hint::black_box;
use std::time::Instant;

use branched_pendulum::Parametric;
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Dual;

/// The paper's pendulum, with a name for each constant.
#[branched_pendulum(
    gravity = g,
    parent(mass = m_p, com = c_p, inertia = i_p, joint = j, friction = f_p) [
        child(mass = m_c, com = c_c, inertia = i_c, friction = f_c, spring = s) * 2
    ],
    emit(gradient(accelerations)),
)]
struct Paper;

const PARAMETERS: usize = 11;

const VALUES: [(&str, f64); PARAMETERS] = [
    ("g", 9.80665),
    ("m_p", 0.12880),
    ("c_p", 0.084),
    ("i_p", 1.88e-3),
    ("j", 0.27),
    ("f_p", 4e-4),
    ("m_c", 0.10531),
    ("c_c", 0.043),
    ("i_c", 0.516e-3),
    ("f_c", 7e-5),
    ("s", 1e-3),
];

/// Components of the start state.
const STATE: usize = 6;

const DIRECTIONS: usize = STATE + PARAMETERS;

/// Number of turns.
const ROUNDS: usize = 15;

/// Returns the value of the parameter with an index.
fn value(index: usize) -> f64 {
    let name = <Paper as Parametric<f64>>::PARAMETERS[index];
    let known = VALUES.iter().find(|(known, _)| *known == name);
    known.expect("every parameter has a value").1
}

/// The motion together with its tangents: the state, then for each component its derivatives.
struct Tangents(Paper<Dual<f64, DIRECTIONS>>);

impl Ode<f64> for Tangents {
    fn dimension(&self) -> usize {
        STATE * (1 + DIRECTIONS)
    }

    fn rates(&self, _: f64, state: &[f64], rates: &mut [f64]) {
        let dual = |index: usize| Dual {
            value: state[index],
            tangents: std::array::from_fn(|k| state[STATE + DIRECTIONS * index + k]),
        };
        let theta = std::array::from_fn(dual);
        let omega = std::array::from_fn(|link| dual(3 + link));
        let alpha = self.0.accelerations(&theta, &omega);
        for (index, rate) in omega.into_iter().chain(alpha).enumerate() {
            rates[index] = rate.value;
            rates[STATE + DIRECTIONS * index..][..DIRECTIONS].copy_from_slice(&rate.tangents);
        }
    }
}

/// Returns the seconds that a piece of work takes.
fn seconds<R>(mut work: impl FnMut() -> R) -> f64 {
    let start = Instant::now();
    black_box(work());
    start.elapsed().as_secs_f64()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn main() {
    let paper = Paper::<f64>::with_parameters(value);
    let dual = Paper::<f64>::with_parameters(|index| Dual::variable(value(index), STATE + index));
    let tangents = Tangents(dual);
    let ode = AbsoluteAngles(&paper);
    let (theta, omega, weights) = ([0.4, -0.3, 0.5], [0.2, 1.0, -0.7], [1.0, -0.5, 0.25]);
    let start = State::new(0.0, [theta, omega].concat());
    let mut with_tangents = start.clone();
    for index in 0..STATE {
        let unit = (0..DIRECTIONS).map(|k| f64::from(u8::from(k == index)));
        with_tangents.values.extend(unit);
    }
    const EVALUATIONS: usize = 100_000;
    let mut pullback = Vec::new();
    for _ in 0..ROUNDS {
        let one = seconds(|| {
            for _ in 0..EVALUATIONS {
                let theta = black_box(theta);
                black_box(paper.accelerations(&theta, &omega));
            }
        });
        let all = seconds(|| {
            for _ in 0..EVALUATIONS {
                let theta = black_box(theta);
                black_box(paper.accelerations_pullback(&theta, &omega, &weights));
            }
        });
        pullback.push(all / one);
    }
    println!("one pullback: {:.2} evaluations", median(pullback));

    let end = |_: usize, state: &[f64], slopes: &mut [f64]| {
        slopes[1] = 1.0;
        state[1]
    };
    println!("| tolerance | steps | gradient, in runs | in runs with {DIRECTIONS} tangents |");
    println!("|---|---:|---:|---:|");
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let method = Dop853::new(Options::with_tolerance(tolerance));
        let (mut by_run, mut by_tangents, mut steps) = (Vec::new(), Vec::new(), 0);
        for _ in 0..ROUNDS {
            let run = seconds(|| method.run(&ode, &start, 10.0));
            let gradient = seconds(|| {
                let found = method.gradient(&ode, PARAMETERS, &start, &[10.0], end);
                steps = found.map_or(0, |found| found.steps);
            });
            let forward = seconds(|| method.run(&tangents, &with_tangents, 10.0));
            by_run.push(gradient / run);
            by_tangents.push(gradient / forward);
        }
        println!(
            "| {tolerance:e} | {steps} | {:.2} | {:.2} |",
            median(by_run),
            median(by_tangents)
        );
    }
}
