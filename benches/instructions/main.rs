//! Evaluates a scene so often that an instruction counter can tell what once costs:
//! `instructions SCENE KIND STATES`. `run.sh` writes `scenes.rs` and counts.

mod scenes;

use branched_pendulum::batch::Batch;
use branched_pendulum::Cast;
use std::hint::black_box;
use std::process::ExitCode;

/// States of one batch.
const STATES: usize = 64;

/// Evaluates the accelerations so many times.
type Run = fn(&str, usize) -> bool;

fn run<const N: usize, P: Cast<f64>>(model: P, kind: &str, times: usize) -> bool {
    let angle = |link: usize, state: usize| (link * 7 + state) as f64 % 6.0 - 3.0;
    let columns = |scale: f64| -> Vec<Vec<f64>> {
        let column = |link| (0..STATES).map(|state| scale * angle(link, state)).collect();
        (0..N).map(column).collect()
    };
    match kind {
        "one" => {
            let theta: [f64; N] = std::array::from_fn(|link| angle(link, 0));
            let omega = theta.map(|angle| 2.0 * angle);
            let mut alpha = [0.0; N];
            for _ in 0..times {
                model.accelerations_into(0.0, black_box(&theta), black_box(&omega), &mut alpha);
                black_box(&alpha);
            }
            true
        }
        "batch" => {
            let (theta, omega) = (columns(1.0), columns(2.0));
            let mut alpha = columns(0.0);
            (0..times / STATES).all(|_| {
                let (theta, omega) = (black_box(&theta), black_box(&omega));
                Batch::new(&model).accelerations(0.0, theta, omega, black_box(&mut alpha)).is_ok()
            })
        }
        // What the standard library takes for the same angles.
        "sines" => {
            let theta: [f64; N] = std::array::from_fn(|link| angle(link, 0));
            for _ in 0..times {
                let theta = black_box(&theta);
                black_box(theta.map(f64::sin_cos));
            }
            true
        }
        _ => false,
    }
}

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().collect();
    let [_, scene, kind, times] = words.as_slice() else {
        return ExitCode::FAILURE;
    };
    let found = scenes::SCENES.iter().find(|(name, _)| name == scene);
    match (found, times.parse()) {
        (Some((_, run)), Ok(times)) if run(kind, times) => ExitCode::SUCCESS,
        _ => ExitCode::FAILURE,
    }
}
