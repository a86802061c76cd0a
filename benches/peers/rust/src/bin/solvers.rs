//! Times of ODE solvers of other crates (Dop853 of `ode_solvers`, Tsit45 of `diffsol`) for the
//! motions of `work-precision`, with our emitted accelerations, and of our methods in the same
//! program.

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use branched_pendulum::prelude::*;
use branched_pendulum::system::TaylorOde;
use branched_pendulum_peers::measure::{ERRORS, Point, points, time_for};
use branched_pendulum_peers::scenes::{BranchedDouble, Rods};
use branched_pendulum_peers::work_precision::reference::{Problem, papers, rods};
use diffsol::{NalgebraMat, OdeBuilder, OdeSolverMethod, OdeSolverStopReason, Vector};
use ode_solvers::dop_shared::OutputType;
use ode_solvers::{SVector, System};

/// Number of times that each contender runs, alternating with the others, and number of repetitions
/// each time.
const ROUNDS: usize = 5;
const REPEATS: usize = 5;

type Measured = Result<Vec<Point>, Box<dyn Error>>;
/// A method, with its name.
type Contender<'a> = (&'static str, Box<dyn Fn() -> Measured + 'a>);

/// Measures a method like [`points`]. `run` returns the time (µs) and the
/// state at the end for a tolerance, or `None` if the method refuses the tolerance.
fn scan(problem: &Problem, run: impl Fn(f64) -> Option<(f64, Vec<f64>)>) -> Measured {
    let point = |third: i32| {
        let tolerance = 10.0_f64.powf(f64::from(-third) / 3.0);
        let mut point = Point {
            error: f64::NAN,
            micros: f64::INFINITY,
        };
        for _ in 0..REPEATS {
            let Some((micros, end)) = run(black_box(tolerance)) else {
                break;
            };
            point.micros = point.micros.min(micros);
            let pairs = end.iter().zip(&problem.expected);
            point.error = pairs.fold(0.0, |worst, (a, b)| (a - b).abs().max(worst));
        }
        point
    };
    Ok((6..=48).map(point).collect())
}

struct Accelerated<'p, P>(&'p P);

impl<P: Pendulum<f64>> Accelerated<'_, P> {
    fn write(&self, time: f64, state: &[f64], rates: &mut [f64]) {
        let (theta, omega) = state.split_at(state.len() / 2);
        let (turning, alpha) = rates.split_at_mut(state.len() / 2);
        turning.copy_from_slice(omega);
        self.0.accelerations_into(time, theta, omega, alpha);
    }
}

impl<P: Pendulum<f64>, const N: usize> System<f64, SVector<f64, N>> for Accelerated<'_, P> {
    fn system(&self, time: f64, state: &SVector<f64, N>, rates: &mut SVector<f64, N>) {
        self.write(time, state.as_slice(), rates.as_mut_slice());
    }
}

/// Runs `ode_solvers` with its default options, except for a higher limit on steps and output at
/// the end only.
fn ode_solvers<P: Pendulum<f64>, const N: usize>(
    pendulum: &P,
    problem: &Problem,
    tolerance: f64,
) -> Option<(f64, Vec<f64>)> {
    let mut start = SVector::<f64, N>::zeros();
    start.as_mut_slice()[..N / 2].copy_from_slice(&problem.start);
    let clock = Instant::now();
    let mut method = ode_solvers::Dop853::from_param(
        Accelerated(pendulum),
        0.0,
        problem.end,
        problem.end,
        start,
        tolerance,
        tolerance,
        0.9,
        0.0,
        0.333,
        6.0,
        problem.end,
        0.0,
        1_000_000,
        u32::MAX,
        OutputType::Sparse,
    );
    method.integrate().ok()?;
    let micros = clock.elapsed().as_secs_f64() * 1e6;
    Some((micros, method.y_out().last()?.as_slice().to_vec()))
}

/// Runs the only explicit method of `diffsol`, with its default options. Parts that are built once
/// for a problem are not timed.
fn diffsol<P: Pendulum<f64>>(
    pendulum: &P,
    problem: &Problem,
    tolerance: f64,
) -> Option<(f64, Vec<f64>)> {
    let n = problem.start.len();
    let system = Accelerated(pendulum);
    let built = OdeBuilder::<NalgebraMat<f64>>::new()
        .rtol(tolerance)
        .atol([tolerance])
        .rhs(|state: &[f64], _: &[f64], time: f64, rates: &mut [f64]| {
            system.write(time, state, rates)
        })
        .init(
            |_: &[f64], _: f64, state: &mut [f64]| {
                state.fill(0.0);
                state[..n].copy_from_slice(&problem.start);
            },
            2 * n,
        )
        .build()
        .ok()?;
    let clock = Instant::now();
    let mut solver = built.tsit45().ok()?;
    solver.set_stop_time(problem.end).ok()?;
    while !matches!(solver.step().ok()?, OdeSolverStopReason::TstopReached) {}
    let micros = clock.elapsed().as_secs_f64() * 1e6;
    Some((micros, solver.state().y.clone_as_vec()))
}

fn contenders<'a, const N: usize, P: Pendulum<f64>, O: TaylorOde<f64>>(
    pendulum: &'a P,
    ode: &'a O,
    problem: &'a Problem,
) -> [Contender<'a>; 5] {
    let options = |tolerance| Options {
        compensated: true,
        ..Options::with_tolerance(tolerance)
    };
    [
        (
            "Taylor",
            Box::new(move || Ok(points(ode, problem, REPEATS, |t| Taylor::new(options(t)))?)),
        ),
        (
            "Dop853",
            Box::new(move || Ok(points(ode, problem, REPEATS, |t| Dop853::new(options(t)))?)),
        ),
        (
            "Dopri5",
            Box::new(move || Ok(points(ode, problem, REPEATS, |t| Dopri5::new(options(t)))?)),
        ),
        (
            "Dop853 of ode_solvers",
            Box::new(move || scan(problem, |t| ode_solvers::<P, N>(pendulum, problem, t))),
        ),
        (
            "Tsit45 of diffsol",
            Box::new(move || scan(problem, |t| diffsol(pendulum, problem, t))),
        ),
    ]
}

fn compare(problem: &Problem, contenders: &[Contender]) -> Result<(), Box<dyn Error>> {
    let mut best: Vec<Vec<Point>> = Vec::new();
    for round in 0..ROUNDS {
        for (number, (_, measure)) in contenders.iter().enumerate() {
            let found = measure()?;
            if round == 0 {
                best.push(found);
                continue;
            }
            for (best, found) in best[number].iter_mut().zip(&found) {
                best.micros = best.micros.min(found.micros);
            }
        }
    }
    for ((name, _), points) in contenders.iter().zip(&best) {
        print!("{:42}", format!("{}, {name}", problem.name));
        for error in ERRORS {
            match time_for(points, error) {
                Some(micros) => print!("{micros:>9.0}"),
                None => print!("{:>9}", "-"),
            }
        }
        println!();
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    print!("{:42}", "microseconds to an error of");
    ERRORS.iter().for_each(|error| print!("{error:>9.0e}"));
    println!();
    let (paper, seven) = (BranchedDouble::new(), Rods::new());
    for problem in &papers()? {
        compare(
            problem,
            &contenders::<6, _, _>(&paper, &AbsoluteAngles(&paper), problem),
        )?;
    }
    let problem = &rods()?;
    compare(
        problem,
        &contenders::<14, _, _>(&seven, &AbsoluteAngles(&seven), problem),
    )
}
