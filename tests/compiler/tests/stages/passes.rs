//! Programs with and without each pass say the same.

use branched_pendulum_codegen::functions::{Argument, Purpose};

use branched_pendulum_codegen::Stages;
use branched_pendulum_codegen::program::{Pass, Program, lower};
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_compiler_tests::source::scene;

const SCENES: [&str; 10] = [
    "blades",
    "chain",
    "driven",
    "driven_series",
    "nested",
    "observed",
    "offset",
    "paper",
    "triplet",
    "unequal",
];

/// The program of a scene, which is derived once: passes are asked for behind that.
fn program(stages: &Stages, off: Pass) -> Program {
    lower(Some(off), &stages.scene, &stages.mechanics).expect("a fixture has few values")
}

/// Outputs of all entry points at some states.
fn values(program: &Program) -> Vec<(String, Vec<f64>)> {
    let mut random = Random::new(29);
    let parameters: Vec<f64> = (0..20).map(|_| random.between(0.3, 0.9)).collect();
    let mut values = Vec::new();
    for _ in 0..5 {
        let numbers: [[f64; 16]; 2] = [random.array(-1.0, 1.0), random.array(-3.0, 3.0)];
        let time = random.between(-5.0, 5.0);
        let input = |argument: Argument, index: usize| match argument {
            Argument::Time => time,
            Argument::Theta | Argument::Coordinates | Argument::Absolute => numbers[0][index],
            Argument::Actions => 1e-2 * (2.0 + numbers[0][index]),
            _ => numbers[1][index],
        };
        for entry in &program.entries {
            // Lists the partners of its sines too, which differ where their angles do.
            if entry.purpose == Purpose::TaylorCoefficients {
                continue;
            }
            let outputs = program.evaluate(f64::sin_cos, &entry.name, &parameters, input);
            values.push((entry.name.clone(), outputs.expect("the entry is there")));
        }
    }
    values
}

/// Values of well-conditioned states differ by roundings.
#[test]
fn passes_keep_the_values() {
    for name in SCENES {
        let stages = scene(name);
        let with = values(&stages.program);
        for pass in Pass::ALL {
            let program = program(&stages, pass);
            assert_eq!(program.verify(), Ok(()), "{name} without {}", pass.name());
            for ((entry, with), (_, without)) in with.iter().zip(values(&program)) {
                let size = with
                    .iter()
                    .fold(0.0, |size: f64, value| size.max(value.abs()));
                for (with, without) in with.iter().zip(without) {
                    let error = (with - without).abs();
                    assert!(
                        error <= 1e-11 * size,
                        "{name}::{entry} without {}: {with} and {without}",
                        pass.name()
                    );
                }
            }
        }
    }
}
