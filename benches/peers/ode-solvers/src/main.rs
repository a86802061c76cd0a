//! Times of Dop853 of the crate `ode_solvers` for the motions of `integration-speed`,
//! with our emitted accelerations, beside our methods in the same program.

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use branched_pendulum::prelude::*;
use branched_pendulum::system::TaylorOde;
use branched_pendulum_studies::integration_speed::measure::{ERRORS, Point, points, time_for};
use branched_pendulum_studies::scenes::{BranchedDouble, Rods};
use branched_pendulum_studies::work_precision::reference::{Problem, Tree, problems};
use ode_solvers::dop_shared::OutputType;
use ode_solvers::{SVector, System};

const REPEATS: usize = 25;
const END: f64 = 10.0;

struct Accelerated<'p, P>(&'p P);

impl<P: Pendulum<f64>, const N: usize> System<f64, SVector<f64, N>> for Accelerated<'_, P> {
    fn system(&self, time: f64, state: &SVector<f64, N>, rates: &mut SVector<f64, N>) {
        let (theta, omega) = state.as_slice().split_at(N / 2);
        let (turning, alpha) = rates.as_mut_slice().split_at_mut(N / 2);
        turning.copy_from_slice(omega);
        self.0.accelerations_into(time, theta, omega, alpha);
    }
}

/// As `points` of `integration-speed` measures ours.
fn theirs<P: Pendulum<f64>, const N: usize>(
    pendulum: &P,
    problem: &Problem,
) -> Result<Vec<Point>, Box<dyn Error>> {
    let mut start = SVector::<f64, N>::zeros();
    start.as_mut_slice()[..N / 2].copy_from_slice(&problem.start);
    let mut found = Vec::new();
    for third in 6..=48 {
        let tolerance = 10.0_f64.powf(f64::from(-third) / 3.0);
        let mut point = Point {
            error: f64::NAN,
            micros: f64::INFINITY,
        };
        for _ in 0..REPEATS {
            // The defaults of `ode_solvers`, but for more steps and ends alone.
            let clock = Instant::now();
            let mut method = ode_solvers::Dop853::from_param(
                Accelerated(pendulum),
                0.0,
                problem.end,
                problem.end,
                black_box(start),
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
            let ended = method.integrate();
            let micros = clock.elapsed().as_secs_f64() * 1e6;
            if ended.is_err() {
                // A tolerance that it refuses.
                break;
            }
            point.micros = point.micros.min(micros);
            let end = method.y_out().last().ok_or("no state at the end")?;
            let pairs = end.iter().zip(&problem.expected);
            point.error = pairs.fold(0.0, |worst, (a, b)| (a - b).abs().max(worst));
        }
        found.push(point);
    }
    Ok(found)
}

fn ours<O: TaylorOde<f64>>(ode: &O, problem: &Problem) -> Result<(), Box<dyn Error>> {
    let options = |tolerance| Options {
        compensated: true,
        ..Options::with_tolerance(tolerance)
    };
    print(
        problem,
        "Taylor",
        &points(ode, problem, REPEATS, |t| Taylor::new(options(t)))?,
    );
    print(
        problem,
        "Dop853",
        &points(ode, problem, REPEATS, |t| Dop853::new(options(t)))?,
    );
    Ok(())
}

fn print(problem: &Problem, method: &str, points: &[Point]) {
    print!("{:38}", format!("{}, {method}", problem.name));
    for error in ERRORS {
        match time_for(points, error) {
            Some(micros) => print!("{micros:>9.0}"),
            None => print!("{:>9}", "-"),
        }
    }
    println!();
}

fn main() -> Result<(), Box<dyn Error>> {
    print!("{:38}", "microseconds to an error of");
    ERRORS.iter().for_each(|error| print!("{error:>9.0e}"));
    println!();
    for problem in &problems(&[END])? {
        let found = match problem.tree {
            Tree::Paper => theirs::<_, 6>(&BranchedDouble::new(), problem)?,
            Tree::Rods => theirs::<_, 14>(&Rods::new(), problem)?,
        };
        print(problem, "Dop853 of ode_solvers", &found);
        match problem.tree {
            Tree::Paper => ours(&AbsoluteAngles(&BranchedDouble::new()), problem)?,
            Tree::Rods => ours(&AbsoluteAngles(&Rods::new()), problem)?,
        }
    }
    Ok(())
}
