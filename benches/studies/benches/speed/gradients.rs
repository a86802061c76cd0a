//! Cost of derivatives in reverse mode.
//!
//! - One pullback of the accelerations (derivatives by 3 angles, 3 velocities and 11 parameters)
//!   in evaluations of the accelerations.
//! - The derivatives of a cost at the end of a motion by its start and by all parameters, in runs
//!   of the same motion, and in runs that carry a tangent (dual numbers) for each of the 17
//!   directions.
//!
//! The first two also for the tree that a program reads (without tangents).
//!
//! The medians of the ratios of each turn are printed.

use std::hint::black_box;

use branched_pendulum::Parametric;
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Dual;
use branched_pendulum::system::{PullbackOde, PullbackWorkspace, Workspace};
use branched_pendulum_timing::{Pass, Table, in_turns};
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

/// Tolerances of the motions.
const TOLERANCES: [f64; 3] = [1e-6, 1e-9, 1e-12];

/// Prints the cost of a pullback in evaluations.
fn print_pullback(name: &str, mut evaluate: impl FnMut(), mut pull_back: impl FnMut()) {
    let mut passes: [Pass<'_>; 2] = [
        Box::new(|| (0..EVALUATIONS).for_each(|_| evaluate())),
        Box::new(|| (0..EVALUATIONS).for_each(|_| pull_back())),
    ];
    let times = in_turns(ROUNDS, &mut passes);
    let ratio = times[1].ratio_to(&times[0]);
    println!("{name}: one pullback {ratio:.2} evaluations");
}

/// Returns a pass that integrates over 10 s.
fn motion<'a>(method: &'a Dop853<f64>, ode: &'a impl Ode<f64>, start: &'a State<f64>) -> Pass<'a> {
    Box::new(move || {
        let _ = black_box(method.run(ode, start, 10.0));
    })
}

/// Returns a row for one tolerance: the number of steps, and the time of the derivatives of an
/// angle after 10 s over the times of other passes.
fn gradient<const N: usize>(
    tolerance: f64,
    method: &Dop853<f64>,
    ode: &impl PullbackOde<f64>,
    start: &State<f64>,
    others: [Pass<'_>; N],
) -> Vec<String> {
    let end = |_: usize, state: &[f64], slopes: &mut [f64]| {
        slopes[1] = 1.0;
        state[1]
    };
    let gradient = || method.gradient(ode, PARAMETERS, start, &[10.0], end);
    let steps = gradient().map_or(0, |found| found.steps);
    let mut passes: Vec<Pass<'_>> = others.into();
    passes.push(Box::new(|| drop(black_box(gradient()))));
    let times = in_turns(ROUNDS, &mut passes);
    let ratios = times[..N].iter().map(|other| times[N].ratio_to(other));
    let ratios = ratios.map(|ratio| format!("{ratio:.2}"));
    [format!("{tolerance:e}"), steps.to_string()]
        .into_iter()
        .chain(ratios)
        .collect()
}

pub(crate) fn run() {
    let paper = Paper::<f64>::with_parameters(value);
    let dual = Paper::<f64>::with_parameters(|index| Dual::variable(value(index), STATE + index));
    let tangents = Tangents(dual);
    let ode = AbsoluteAngles(&paper);
    let (theta, omega, weights) = ([0.4, -0.3, 0.5], [0.2, 1.0, -0.7], [1.0, -0.5, 0.25]);
    print_pullback(
        "written out",
        || {
            black_box(paper.accelerations(&black_box(theta), &omega));
        },
        || {
            black_box(paper.accelerations_pullback(&black_box(theta), &omega, &weights));
        },
    );
    let start = State::new(0.0, [theta, omega].concat());
    let mut with_tangents = start.clone();
    for index in 0..STATE {
        let unit = (0..DIRECTIONS).map(|k| f64::from(u8::from(k == index)));
        with_tangents.values.extend(unit);
    }
    let in_tangents = format!("in runs with {DIRECTIONS} tangents");
    let table = Table::new(["tolerance", "steps", "gradient, in runs", &in_tangents]);
    let rows = TOLERANCES.map(|tolerance| {
        let method = Dop853::new(Options::with_tolerance(tolerance));
        let others = [
            motion(&method, &ode, &start),
            motion(&method, &tangents, &with_tangents),
        ];
        gradient(tolerance, &method, &ode, &start, others)
    });
    println!("{}", rows.into_iter().fold(table, Table::row));
    at_run_time(&start);
}

/// Prints the same for the tree that a program reads.
fn at_run_time(start: &State<f64>) {
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
    print_pullback(
        "at run time",
        || plain.rates_with(&mut workspace, 0.0, black_box(&start.values), &mut rates),
        || {
            let (state, by) = (black_box(&start.values), &mut by_state);
            pullback.add_pullback(&mut back, 0.0, state, &weights, by, &mut by_parameters);
        },
    );
    let table = Table::new(["tolerance", "steps", "gradient, in runs"]);
    let rows = TOLERANCES.map(|tolerance| {
        let method = Dop853::new(Options::with_tolerance(tolerance));
        let others = [motion(&method, &plain, start)];
        gradient(tolerance, &method, &pullback, start, others)
    });
    println!("{}", rows.into_iter().fold(table, Table::row));
}
