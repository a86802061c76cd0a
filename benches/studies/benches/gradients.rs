//! `cargo bench --bench gradients`: cost of derivatives in reverse mode.
//!
//! - One pullback of the accelerations (derivatives by 3 angles, 3 velocities and 11 parameters)
//!   in evaluations of the accelerations.
//! - The derivatives of a cost at the end of a motion by its start and by all parameters, in runs
//!   of the same motion, and in runs that carry a tangent (dual numbers) for each of the 17
//!   directions.
//!
//! The first two also for the tree that a program reads (without tangents).
//!
//! All candidates take turns; the medians of the ratios of each turn are printed.

use std::hint::black_box;
use std::time::Instant;

use branched_pendulum::Parametric;
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Dual;
use branched_pendulum::system::{PullbackOde, PullbackWorkspace, Workspace};
use branched_pendulum_trees::{PendulumTree, TreeDescription};

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

/// Number of evaluations in a turn.
const EVALUATIONS: usize = 100_000;

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
    println!(
        "written out: one pullback {:.2} evaluations",
        median(pullback)
    );

    let cases = [1e-6, 1e-9, 1e-12];
    println!("| tolerance | steps | gradient, in runs | in runs with {DIRECTIONS} tangents |");
    println!("|---|---:|---:|---:|");
    for tolerance in cases {
        let method = Dop853::new(Options::with_tolerance(tolerance));
        let (mut by_run, mut by_tangents, mut steps) = (Vec::new(), Vec::new(), 0);
        for _ in 0..ROUNDS {
            let run = seconds(|| method.run(&ode, &start, 10.0));
            let gradient = seconds(|| steps = steps_of_gradient(&method, &ode, &start));
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
    at_run_time(&start, cases);
}

/// Computes the derivatives of an angle after 10 s; returns the number of steps.
fn steps_of_gradient(
    method: &Dop853<f64>,
    ode: &impl PullbackOde<f64>,
    start: &State<f64>,
) -> usize {
    let end = |_: usize, state: &[f64], slopes: &mut [f64]| {
        slopes[1] = 1.0;
        state[1]
    };
    let found = method.gradient(ode, PARAMETERS, start, &[10.0], end);
    found.map_or(0, |found| found.steps)
}

/// Prints the same for the tree that a program reads.
fn at_run_time(start: &State<f64>, tolerances: [f64; 3]) {
    const TEXT: &str = "gravity = g,
        parent(mass = m_p, com = c_p, inertia = i_p, joint = j, friction = f_p) [
            child(mass = m_c, com = c_c, inertia = i_c, friction = f_c, spring = s) * 2
        ]";
    let description = TreeDescription::parse(TEXT).expect("a tree");
    let tree: PendulumTree = description.tree(&VALUES).expect("all values");
    let (plain, pullback) = (AbsoluteAngles(&tree), tree.pullback());
    let (mut workspace, mut back) = (Workspace::new(), PullbackWorkspace::new());
    let (mut rates, weights) = ([0.0; STATE], [0.0, 0.0, 0.0, 1.0, -0.5, 0.25]);
    let (mut by_state, mut by_parameters) = ([0.0; STATE], [0.0; PARAMETERS]);
    let mut ratios = Vec::new();
    for _ in 0..ROUNDS {
        let one = seconds(|| {
            for _ in 0..EVALUATIONS {
                let state = black_box(&start.values);
                plain.rates_with(&mut workspace, 0.0, state, &mut rates);
            }
        });
        let all = seconds(|| {
            for _ in 0..EVALUATIONS {
                let state = black_box(&start.values);
                let by = (&mut by_state, &mut by_parameters);
                pullback.add_pullback(&mut back, 0.0, state, &weights, by.0, by.1);
            }
        });
        ratios.push(all / one);
    }
    println!(
        "at run time: one pullback {:.2} evaluations",
        median(ratios)
    );
    println!("| tolerance | steps | gradient, in runs |");
    println!("|---|---:|---:|");
    for tolerance in tolerances {
        let method = Dop853::new(Options::with_tolerance(tolerance));
        let (mut by_run, mut steps) = (Vec::new(), 0);
        for _ in 0..ROUNDS {
            let run = seconds(|| method.run(&plain, start, 10.0));
            let gradient = seconds(|| steps = steps_of_gradient(&method, &pullback, start));
            by_run.push(gradient / run);
        }
        println!("| {tolerance:e} | {steps} | {:.2} |", median(by_run));
    }
}
