//! `benches/instructions/run.sh`: instruction counts of evaluations and steps, measured by
//! valgrind. Unlike times they are exactly repeatable, so that a change of a few per cent is
//! visible even on a busy machine.
//!
//! valgrind emulates a processor with AVX2 if the machine has it, and never AVX-512. Code that is
//! chosen by the machine's features is therefore counted in its AVX2 version, whose registers
//! contain half as many numbers. A division counts as much as a product, and waiting counts
//! nothing; `cargo bench` and the program `evaluation-speed` measure time.

#![expect(missing_docs, reason = "of what gungraun's macros define")]

use std::hint::black_box;

use branched_pendulum::Pendulum;
use branched_pendulum::batch::Batch;
use branched_pendulum::prelude::*;
use branched_pendulum::system::Workspace;
use branched_pendulum_trees::PendulumTree;
use gungraun::prelude::*;

/// The paper's pendulum.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ],
    emit(energies, symmetric, taylor, transfer(exact)),
)]
struct BranchedDouble;

/// Full binary trees of rods.
macro_rules! trees {
    ($($name:ident: $generations:literal generations, $solve:ident, $code:ident;)*) => {
        $(#[branched_pendulum(
            gravity = 9.80665,
            solve = $solve,
            rod: generations(count = $generations, branching = 2, shape = rod, mass = 0.12,
                length = 0.3, mass_ratio = 0.5, length_ratio = 0.7, code = $code),
            emit(energies),
        )]
        struct $name;)*
    };
}

trees! {
    Factorized7: 3 generations, factorization, unrolled;
    Recursive7: 3 generations, recursion, unrolled;
    Factorized15: 4 generations, factorization, unrolled;
    Recursive15: 4 generations, recursion, unrolled;
    Factorized31: 5 generations, factorization, unrolled;
    Recursive31: 5 generations, recursion, unrolled;
    Factorized127: 7 generations, factorization, unrolled;
    Recursive127: 7 generations, recursion, unrolled;
    Loops127: 7 generations, recursion, loops;
    Loops1023: 10 generations, recursion, loops;
}

/// Number of passes in one count; the printed count is divided by it.
const PASSES: usize = 64;

/// Function whose instructions are counted: [`PASSES`] evaluations, states or steps.
type Passes = Box<dyn FnMut()>;

/// Runs the function once, so that processor features are detected and memory is allocated before
/// counting.
fn warm(mut passes: impl FnMut() + 'static) -> Passes {
    passes();
    Box::new(passes)
}

/// Returns the angle of a link in a state, in rad.
fn angle(link: usize, state: usize) -> f64 {
    ((7 * link + state) % 64) as f64 / 11.0 - 3.0
}

/// Returns angles and angular velocities of states.
fn states(links: usize) -> Vec<[Vec<f64>; 2]> {
    let of =
        |state| [1.0, 2.0].map(|scale| (0..links).map(|link| scale * angle(link, state)).collect());
    (0..PASSES).map(of).collect()
}

/// Creates a function that evaluates the accelerations of states one by one.
fn one_by_one<M: Pendulum<f64> + 'static>(model: M) -> Passes {
    let (states, mut alpha) = (states(model.links()), vec![0.0; model.links()]);
    let mut workspace = Workspace::new();
    warm(move || {
        for [theta, omega] in black_box(&states) {
            model.accelerations_with(&mut workspace, 0.0, theta, omega, &mut alpha);
            black_box(&mut alpha);
        }
    })
}

/// Creates a function that evaluates the accelerations of a tree that is built at run time.
fn run_time_tree(text: &str) -> Passes {
    let tree = PendulumTree::parse(text).expect("a tree");
    let (states, mut alpha) = (states(tree.links()), vec![0.0; tree.links()]);
    let mut workspace = Workspace::new();
    warm(move || {
        for [theta, omega] in black_box(&states) {
            tree.accelerations_with(&mut workspace, 0.0, theta, omega, &mut alpha);
            black_box(&mut alpha);
        }
    })
}

/// Description of the paper's pendulum and of the rods, for trees at run time.
const PAPER: &str = "gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ]";
const RODS: &str = "gravity = 9.80665,
    rod: generations(count = 7, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7)";

/// Creates a function that evaluates the accelerations of several states at once, in vector
/// registers.
fn in_lanes<M: Pendulum<f64> + 'static>(model: M) -> Passes {
    let columns = |scale: f64| -> Vec<Vec<f64>> {
        let column = |link| {
            (0..PASSES)
                .map(|state| scale * angle(link, state))
                .collect()
        };
        (0..model.links()).map(column).collect()
    };
    let (theta, omega, mut alpha) = (columns(1.0), columns(2.0), columns(0.0));
    warm(move || {
        let (theta, omega) = (black_box(&theta), black_box(&omega));
        let done = Batch::new(&model).accelerations(0.0, theta, omega, black_box(&mut alpha));
        done.expect("columns of one length");
    })
}

/// Evaluates kinetic and potential energy.
fn both_energies<M: Energy<f64> + 'static>(model: M) -> Passes {
    let (states, mut workspace) = (states(model.links()), Workspace::new());
    warm(move || {
        for [theta, omega] in black_box(&states) {
            black_box(model.kinetic_energy_with(&mut workspace, theta, omega));
            black_box(model.potential_energy_with(&mut workspace, theta));
        }
    })
}

/// Creates a function that evaluates sine and cosine of the standard library.
fn sines() -> Passes {
    let angles: Vec<f64> = (0..PASSES).map(|state| angle(0, state)).collect();
    warm(move || {
        for angle in black_box(&angles) {
            black_box(angle.sin_cos());
        }
    })
}

/// Creates a function that evaluates the exact energy transfer W of the paper's pendulum from
/// velocities.
fn exact_transfer() -> Passes {
    let model = BranchedDouble::new();
    let state = |state| [1.0, 2.0].map(|scale| [0, 1, 2].map(|link| scale * angle(link, state)));
    let states: Vec<[[f64; 3]; 2]> = (0..PASSES).map(state).collect();
    warm(move || {
        for [coordinates, rates] in black_box(&states) {
            black_box(model.transfer_exact_from_rates(coordinates, rates));
        }
    })
}

/// Creates a function that makes steps of the paper's pendulum at a tolerance of 1e-9.
fn steps_of<M>(method: &M) -> Passes
where
    M: Integrator<f64, AbsoluteAngles<BranchedDouble>> + 'static,
{
    let start = State::at_rest(0.0, &[0.8, 1e-3, -1e-3]);
    let stepper = method.start(AbsoluteAngles(BranchedDouble::new()), &start);
    let mut stepper = stepper.expect("a start that is a number");
    warm(move || {
        for _ in 0..PASSES {
            black_box(stepper.step().expect("steps of this motion"));
        }
    })
}

fn tolerance() -> Options<f64> {
    Options::with_tolerance(1e-9)
}

#[library_benchmark]
#[bench::paper(one_by_one(BranchedDouble::new()))]
#[bench::factorized_7(one_by_one(Factorized7::new()))]
#[bench::recursive_7(one_by_one(Recursive7::new()))]
#[bench::factorized_15(one_by_one(Factorized15::new()))]
#[bench::recursive_15(one_by_one(Recursive15::new()))]
#[bench::factorized_31(one_by_one(Factorized31::new()))]
#[bench::recursive_31(one_by_one(Recursive31::new()))]
#[bench::factorized_127(one_by_one(Factorized127::new()))]
#[bench::recursive_127(one_by_one(Recursive127::new()))]
#[bench::loops_127(one_by_one(Loops127::new()))]
#[bench::loops_1023(one_by_one(Loops1023::new()))]
#[bench::run_time_paper(run_time_tree(PAPER))]
#[bench::run_time_127(run_time_tree(RODS))]
fn accelerations(mut passes: Passes) -> Passes {
    passes();
    passes
}

#[library_benchmark]
#[bench::paper(in_lanes(BranchedDouble::new()))]
#[bench::factorized_7(in_lanes(Factorized7::new()))]
#[bench::recursive_7(in_lanes(Recursive7::new()))]
#[bench::factorized_15(in_lanes(Factorized15::new()))]
#[bench::recursive_15(in_lanes(Recursive15::new()))]
#[bench::factorized_31(in_lanes(Factorized31::new()))]
#[bench::recursive_31(in_lanes(Recursive31::new()))]
#[bench::recursive_127(in_lanes(Recursive127::new()))]
#[bench::loops_127(in_lanes(Loops127::new()))]
#[bench::loops_1023(in_lanes(Loops1023::new()))]
fn batch(mut passes: Passes) -> Passes {
    passes();
    passes
}

#[library_benchmark]
#[bench::paper(both_energies(BranchedDouble::new()))]
#[bench::recursive_7(both_energies(Recursive7::new()))]
#[bench::recursive_15(both_energies(Recursive15::new()))]
#[bench::recursive_31(both_energies(Recursive31::new()))]
#[bench::recursive_127(both_energies(Recursive127::new()))]
#[bench::loops_127(both_energies(Loops127::new()))]
#[bench::loops_1023(both_energies(Loops1023::new()))]
fn energies(mut passes: Passes) -> Passes {
    passes();
    passes
}

#[library_benchmark]
#[bench::sine_and_cosine_of_the_system(sines())]
#[bench::exact_transfer(exact_transfer())]
#[bench::step_of_dop853(steps_of(&Dop853::new(tolerance())))]
#[bench::step_of_verner98(steps_of(&Verner98::new(tolerance())))]
#[bench::step_of_taylor(steps_of(&Taylor::new(tolerance())))]
fn others(mut passes: Passes) -> Passes {
    passes();
    passes
}

library_benchmark_group!(
    name = counts,
    benchmarks = [accelerations, batch, energies, others]
);

main!(library_benchmark_groups = counts);
